# SPDX-License-Identifier: LGPL-2.1-or-later
"""Makes a mountain side with a release area, and a case that runs on it.

scree-mountain 1 results/mountain_1
scree results/mountain_1/case.prm

Writes terrain.asc (heights, m), release.asc (thickness of the soil, measured vertically, m) and case.prm into the folder. The same seed makes the
same mountain. It is a concave valley head: height A exp(-(d/s)^1.4) over the distance d from the head, with a parabolic cross section and random
roughness whose amplitude falls as k^-1.7 with the wavenumber k. At a spacing of 10 m, `rough` relief has second differences of 3 to 5 m (RMS), as
measured mountain sides have; `smooth` relief has no wavelength below 150 m.
"""

import pathlib
from typing import NamedTuple

import numpy as np

from scree.command import Command
from scree.results import write_raster
from scree.variants import set_entries


class Size(NamedTuple):
    """Extent of the raster and of the release area, m."""
    width: float
    length: float
    relief: float      # from the valley floor to the head
    half_width: float  # of the release, across the slope
    half_length: float  # along the slope
    thickness: float   # in its middle


SIZES = {"large": Size(1100, 1700, 900, 130, 150, 40), "small": Size(600, 900, 460, 65, 75, 22)}  # 1.2 and 0.17 million m^3


def roughness(rng, shape, spacing, shortest):
    """Random heights with the standard deviation 1; wavelengths from `shortest` to 600 m."""
    rows, columns = shape
    wavenumber = np.hypot(np.fft.fftfreq(columns, spacing)[None, :], np.fft.fftfreq(rows, spacing)[:, None])
    inside = (wavenumber > 1 / 600) & (wavenumber < 1 / shortest)
    amplitude = np.where(inside, np.where(inside, wavenumber, 1.) ** -1.7, 0.)
    heights = np.real(np.fft.ifft2(amplitude * np.exp(2j * np.pi * rng.random(shape))))
    return heights / heights.std()


def without_ground(rng, missing, heights, spacing, size):
    """Heights with nan where ground is missing: a round hole in the path, an island of ground in a ring, or an irregular edge of the raster."""
    y, x = np.indices(heights.shape) * spacing
    centre = size.width * rng.uniform(0.4, 0.6), size.length * rng.uniform(0.5, 0.62)
    distance = np.hypot(x - centre[0], y - centre[1]) / size.half_width
    edge = size.width / 2 * (0.8 + 0.1 * np.sin(2 * np.pi * (rng.uniform(1, 3) * y / size.length + rng.random())))
    gaps = {"none": np.zeros(heights.shape, bool), "hole": distance < rng.uniform(0.3, 0.6), "island": (distance > 0.3) & (distance < 0.7),
            "edge": np.abs(x - size.width / 2) > edge}
    return np.where(gaps[missing], np.nan, heights)


def make(seed, size, spacing, rim, relief, feature, missing="none"):
    """Heights and release thickness on a grid whose first row is the southern one, m."""
    rng = np.random.default_rng(seed)
    shape = int(size.length / spacing) + 1, int(size.width / spacing) + 1
    y, x = np.indices(shape) * spacing
    middle = size.width / 2
    heights = 300 + size.relief * np.exp(-((size.length - y) / (0.41 * size.length)) ** 1.4) + 0.055 * size.width * ((x - middle) / middle) ** 2
    heights += 9 * roughness(rng, shape, spacing, 2.5 * spacing if relief == "rough" else 150.)
    if feature == "gully":  # a meandering channel from below the release to the valley
        bed = middle + 0.05 * size.width * np.sin(2 * np.pi * y / (0.35 * size.length))
        heights -= 0.8 * size.thickness * np.exp(-((x - bed) / (0.03 * size.width)) ** 2) * np.clip(4 * (0.75 - y / size.length), 0, 1)
    elif feature == "cliff":  # a step as high as the release is thick, over two cells
        heights += size.thickness * 0.5 * (np.tanh((y - 0.62 * size.length) / spacing) - 1)
    shift = 0.6 * np.array([size.half_width, 0.7 * size.half_length]) * rng.uniform(-1, 1, 2)
    centre = middle + shift[0], 0.81 * size.length + shift[1]
    distance = ((x - centre[0]) / size.half_width) ** 2 + ((y - centre[1]) / size.half_length) ** 2
    thickness = size.thickness * np.clip(1 - distance, 0, None)
    if rim == "cut":
        thickness[thickness < size.thickness / 8] = 0
    heights = without_ground(rng, missing, heights, spacing, size)
    return heights, np.where(np.isnan(heights), 0, thickness)


def saturated_region(heights, thickness, spacing):
    """Expression of half an ellipsoid over the ground, with place, axes and thickness of a release and the mean slope below it."""
    y, x = np.indices(heights.shape) * spacing
    inside = thickness > 0
    x, y, z, weight = x[inside], y[inside], heights[inside], thickness[inside] / thickness.sum()
    x_mean, y_mean = (weight * x).sum(), (weight * y).sum()
    across, along = np.sqrt(6 * (weight * (x - x_mean) ** 2).sum()), np.sqrt(6 * (weight * (y - y_mean) ** 2).sum())
    level, slope_x, slope_y = np.linalg.lstsq(np.stack([np.ones(x.size), x - x_mean, y - y_mean], 1), z, rcond=None)[0]
    plane = f"{level:.4g} + {slope_x:.4g}*(x - {x_mean:.4g}) + {slope_y:.4g}*(y - {y_mean:.4g})"
    return (f"((x - {x_mean:.4g})/{across:.4g})^2 + ((y - {y_mean:.4g})/{along:.4g})^2 + "
            f"((z - ({plane}))/{thickness.max():.4g})^2 < 1")


# Entries of a saturated slide besides.
WATER = {**{f"Boundaries/Water/{face}": "drained" for face in ("Left", "Right", "Front", "Back")}, "Water/Points per cell": 3,
         "Water/Hydraulic conductivity": "1e-3  # m/s"}


def case_text(heights, thickness, spacing, cell, is_saturated=False):
    """A slide to rest: the entries of mountain.prm with the numbers of this mountain."""
    release = f"set Region           = {saturated_region(heights, thickness, spacing)}" if is_saturated else "set Thickness        = release.asc"
    lower = [cell, cell, cell * np.floor(np.nanmin(heights) / cell - 1)]
    upper = [(n - 1) * spacing for n in heights.shape[::-1]] + [np.nanmax(heights + thickness) + 5 * cell]
    upper = [low + cell * np.floor((high - low - (cell if axis < 2 else 0)) / cell) for axis, (low, high) in enumerate(zip(lower, upper))]
    lower, upper = (", ".join(f"{value:g}" for value in place) for place in (lower, upper))
    text = pathlib.Path(__file__).with_suffix(".prm").read_text(encoding="utf-8").format(release=release, lower=lower, upper=upper, cell=cell)
    return set_entries(text, WATER if is_saturated else {}).rstrip("\n") + "\n"


def make_case(folder, seed, size="large", spacing=10., cell=10., rim="thin", relief="rough", feature="none", missing="none",
              is_saturated=False):
    """Writes the rasters and the case into a folder; returns heights and thickness, m."""
    for name, length in (("spacing", spacing), ("cell", cell)):
        if length <= 0:
            raise ValueError(f"--{name} {length:g}: write a length above 0")
    heights, thickness = make(seed, SIZES[size], spacing, rim, relief, feature, missing)
    folder.mkdir(parents=True, exist_ok=True)
    write_raster(folder / "terrain.asc", np.where(np.isnan(heights), -9999, heights), spacing)
    write_raster(folder / "release.asc", thickness, spacing)
    (folder / "case.prm").write_text(case_text(heights, thickness, spacing, cell, is_saturated), encoding="utf-8")
    return heights, thickness


def _make_case(arguments):
    heights, thickness = make_case(**vars(arguments))
    print(f"Wrote {arguments.folder}: release {thickness.sum() * arguments.spacing**2:.0f} m^3, heights {np.nanmin(heights):.0f} to {np.nanmax(heights):.0f} m")


def main():
    parser = Command("scree-mountain", __doc__)
    parser.add_argument("seed", type=int, help="number that decides the roughness and the place of the release")
    parser.add_argument("folder", type=pathlib.Path, help="where the files go; it is made if it does not exist")
    parser.add_argument("--size", choices=SIZES, default="large", help="1.1 km by 1.7 km with 1.2 million m^3 (large) or 0.6 km by 0.9 km with 0.17 (small)")
    parser.add_argument("--spacing", type=float, default=10., help="of the rasters, m; default %(default)g")
    parser.add_argument("--cell", type=float, default=10., help="cell size of the case, m; default %(default)g")
    parser.add_argument("--rim", choices=("thin", "cut"), default="thin", help="the release thins out to nothing, or ends at an eighth of its thickness")
    parser.add_argument("--relief", choices=("rough", "smooth"), default="rough", help="wavelengths from 2.5 spacings on, or none below 150 m; default: rough")
    parser.add_argument("--feature", choices=("none", "gully", "cliff"), default="none", help="a channel below the release, or a step in the slope; default: none")
    parser.add_argument("--missing", choices=("none", "hole", "island", "edge"), default="none",
                        help="ground without heights: a hole in the path, a ring around an island, an irregular edge of the raster; default: none")
    parser.add_argument("--saturated", dest="is_saturated", action="store_true", help="soil with separate points of water, half an ellipsoid as large as the release")
    parser.run(_make_case)

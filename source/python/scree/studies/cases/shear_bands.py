# SPDX-License-Identifier: LGPL-2.1-or-later
"""The text of its section: doc/studies/intro/shear_bands.md."""

import numpy as np

from scree.studies import NoChart, Study, Variant

BIAXIAL, BANK = "biaxial test", "bank"
LENGTHS = {BIAXIAL: 0.1, BANK: 0.5}  # m
SIZES = {BIAXIAL: (0.1, 0.05, 0.025, 0.0125), BANK: (0.25, 6 / 36, 0.125)}  # m
LOAD, WIDTH, FRONT, PEAK = "load at 1 %, kPa", "width of the band, m", "front 90 %, m", "peak load, kPa"
NS = "ns per point and step"


def biaxial(size, length):
    entries = {"Mesh/Cell size": f"{size:g}", "Soil/Mohr-Coulomb/Nonlocal length": f"{length:g}",
               "Output/Interval": 0.6}
    return Variant({"scene": BIAXIAL, "h": size, "length": length}, entries)


def bank(size, length):
    return Variant({"scene": BANK, "h": size, "length": length}, {
        "Mesh/Cell size": f"{size:.15g}", "Mesh/Upper corner": "20, 7", "Soil/Mohr-Coulomb/Cohesion": 4e3,
        "Soil/Mohr-Coulomb/Softening strain": 0.1, "Soil/Mohr-Coulomb/Tension cut-off": 0,
        "Soil/Mohr-Coulomb/Residual cohesion": 500,
        "Soil/Mohr-Coulomb/Nonlocal length": f"{length:g}", "Output/Interval": 5}, "prm/slopes/first_slope.prm")


def band_width(points, size):
    """Of the columns of cells from a quarter to three quarters of the width."""
    strain = np.maximum(points.arrays["softening_strain"].ravel(), 0.)
    widths = []
    for left in np.arange(0.25, 0.7499, size):
        inside = (points.positions[:, 0] >= left) & (points.positions[:, 0] < left + size)
        heights = np.round(points.positions[inside, 1] / size - 0.5).astype(int)
        count = np.bincount(heights)
        mean = np.bincount(heights, strain[inside]) / np.maximum(count, 1)
        widths.append(np.sum(mean) * size / np.max(mean))
    return np.mean(widths) * np.cos(np.pi / 4)


def measure(run):
    found = {LOAD: np.nan, PEAK: np.nan, WIDTH: np.nan, FRONT: np.nan, NS: run.cost[NS]}
    if run.labels["scene"] == BANK:
        front = run.statistics("Front 90 % (m)")
        return {**found, FRONT: front[-1] - front[0]}
    shortening = -run.statistics("Obstacle Platen displacement y (m)") / 2
    impulse = run.statistics("Obstacle Platen impulse y (N s)")
    first, last = (np.interp(part, shortening, run.time) for part in (0.0095, 0.0105))
    return {**found, LOAD: (np.interp(last, run.time, impulse) - np.interp(first, run.time, impulse)) / (last - first)
            / 1e3,
            PEAK: np.max(run.statistics("Obstacle Platen force y (N)")) / 1e3,
            WIDTH: band_width(run.points(), run.labels["h"])}


def group(rows, scene, with_length):
    return rows.where(lambda row: row["scene"] == scene and (row["length"] > 0) == with_length).from_coarse()


def verdict(rows, claim):
    own, averaged = group(rows, BIAXIAL, False), group(rows, BIAXIAL, True)
    loads = averaged.where(lambda row: row["h"] <= row["length"] / 2 * 1.0001).span[LOAD]
    apart, coarse, fine, smooth = loads.high / loads.low - 1, own[0], own[-1], averaged[-1]
    claim = claim.shared(coarse=coarse, fine=fine, smooth=smooth)
    claims = [
        claim("loads", apart <= 0.02, quick=False, worst=True, apart=apart),
        claim("without", fine[LOAD] < 0.9 * coarse[LOAD]),
        claim("width", fine[WIDTH] < smooth[WIDTH], quick=False, cells=fine[WIDTH] / fine["h"],
              lengths=smooth[WIDTH] / smooth["length"])]
    without, banks = group(rows, BANK, False), group(rows, BANK, True)
    if len(banks) > 1:
        change, change_without = (of[-1][FRONT] / of[-2][FRONT] - 1 for of in (banks, without))
        claims += [claim("bank", abs(change) <= 0.03, quick=False, worst=True, change=change,
                         change_without=change_without),
                   claim("front", True, quick=False, without=without[-1][FRONT], front=banks[-1][FRONT])]
    cost = [f"{100 * (row[NS] / other[NS] - 1):.0f} % at l/h = {row['length'] / row['h']:.0f}"
            for row in averaged for other in own.where(h=row["h"])]
    return [*claims, claim("cost", True, cost=cost)]


def table(rows):
    forms = {PEAK: ".2f", LOAD: ".2f", WIDTH: ".3f", FRONT: ".2f", NS: ".0f"}
    return [("scene", "h (m)", "l (m)", *forms),
            *((row["scene"], f"{row['h']:.4g}", f"{row['length']:g}",
               *(f"{row[name]:{form}}" if np.isfinite(row[name]) else "-" for name, form in forms.items()))
              for scene in (BIAXIAL, BANK) for with_length in (False, True) for row in group(rows, scene, with_length))]


STUDY = Study(
    "prm/softening/biaxial.prm",
    variants=[variant(size, length) for scene, variant in ((BIAXIAL, biaxial), (BANK, bank))
              for length in (0., LENGTHS[scene]) for size in SIZES[scene] if length > 0 or size != 0.0125],
    chart=NoChart(), quick=lambda labels: labels["scene"] == BIAXIAL and labels["h"] > 0.04)

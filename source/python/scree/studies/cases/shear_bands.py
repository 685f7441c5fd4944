# SPDX-License-Identifier: LGPL-2.1-or-later
"""The text of its section: doc/studies/intro/shear_bands.md."""

import numpy as np

from scree.studies.charts import Curves
from scree.studies.study import Claim, Study, Variant

BIAXIAL, BANK = "biaxial test", "bank"
LENGTHS = {BIAXIAL: 0.1, BANK: 0.5}  # m
SIZES = {BIAXIAL: (0.1, 0.05, 0.025, 0.0125), BANK: (0.25, 6 / 36, 0.125)}  # m
LOAD, WIDTH, FRONT, PEAK = "load at 1 %, kPa", "width of the band, m", "front 90 %, m", "peak load, kPa"
NS = "ns per point and step"


def biaxial(size, length):
    return Variant({"scene": BIAXIAL, "h": size, "length": length}, {"Mesh/Cell size": f"{size:g}", "Soil/Mohr-Coulomb/Nonlocal length": f"{length:g}",
                                                                     "Output/Interval": 0.6})


def bank(size, length):
    return Variant({"scene": BANK, "h": size, "length": length}, {
        "Mesh/Cell size": f"{size:.15g}", "Mesh/Upper corner": "20, 7", "Soil/Mohr-Coulomb/Cohesion": 4e3, "Soil/Mohr-Coulomb/Softening strain": 0.1,
        "Soil/Mohr-Coulomb/Tension cut-off": 0, "Soil/Mohr-Coulomb/Residual cohesion": 500,
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
    return {**found, LOAD: (np.interp(last, run.time, impulse) - np.interp(first, run.time, impulse)) / (last - first) / 1e3,
            PEAK: np.max(run.statistics("Obstacle Platen force y (N)")) / 1e3, WIDTH: band_width(run.points(), run.labels["h"])}


def group(rows, scene, with_length):
    return sorted((row for row in rows if row["scene"] == scene and (row["length"] > 0) == with_length), key=lambda row: -row["h"])


def verdict(rows):
    own, averaged = group(rows, BIAXIAL, False), group(rows, BIAXIAL, True)
    fine = [row for row in averaged if row["h"] <= row["length"] / 2 * 1.0001]
    loads = max(row[LOAD] for row in fine) / min(row[LOAD] for row in fine) - 1
    claims = [
        Claim(f"Biaxial test with the length: the loads at 1 % with cells of at most l/2 part by {100 * loads:.1f} %. Bound: 2 %.", loads <= 0.02, quick=False, worst=True),
        Claim(f"Without the length, the load falls from {own[0][LOAD]:.1f} to {own[-1][LOAD]:.1f} kPa from cells of {own[0]['h']:g} m to {own[-1]['h']:g} m.",
              own[-1][LOAD] < 0.9 * own[0][LOAD]),
        Claim(f"The band is {own[-1][WIDTH] / own[-1]['h']:.1f} cells wide without the length, and {averaged[-1][WIDTH] / averaged[-1]['length']:.2f} l with it "
              f"(h = {averaged[-1]['h']:g} m).", own[-1][WIDTH] < averaged[-1][WIDTH], quick=False)]
    without, banks = group(rows, BANK, False), group(rows, BANK, True)
    if len(banks) > 1:
        change, change_without = (of[-1][FRONT] / of[-2][FRONT] - 1 for of in (banks, without))
        claims.append(Claim(f"Bank with the length: the front changes by {100 * change:+.1f} % from 36 to 48 cells, without it by {100 * change_without:+.1f} %. Bound: 3 %.",
                            abs(change) <= 0.03, quick=False, worst=True))
        claims.append(Claim(f"The length changes the front of the bank with 48 cells from {without[-1][FRONT]:.2f} to {banks[-1][FRONT]:.2f} m.", True, quick=False))
    cost = [f"{100 * (row[NS] / other[NS] - 1):.0f} % at l/h = {row['length'] / row['h']:.0f}" for row in averaged for other in own if other["h"] == row["h"]]
    claims.append(Claim("Processor time that the average adds to a run: " + ", ".join(cost) + ".", True))
    return claims


def table(rows):
    def text(value, digits):
        return f"{value:.{digits}f}" if np.isfinite(value) else "-"
    return [("scene", "h (m)", "l (m)", PEAK, LOAD, WIDTH, FRONT, NS),
            *((row["scene"], f"{row['h']:.4g}", f"{row['length']:g}", text(row[PEAK], 2), text(row[LOAD], 2), text(row[WIDTH], 3), text(row[FRONT], 2), text(row[NS], 0))
              for scene in (BIAXIAL, BANK) for with_length in (False, True) for row in group(rows, scene, with_length))]


def draw(figure, rows):
    scenes = [scene for scene in (BIAXIAL, BANK) if group(rows, scene, True)]
    for axes, scene in zip(np.atleast_1d(figure.subplots(1, len(scenes))), scenes):
        quantity = LOAD if scene == BIAXIAL else FRONT
        for with_length, name in ((False, "without a length"), (True, f"l = {LENGTHS[scene]:g} m")):
            of = group(rows, scene, with_length)
            axes.plot([row["h"] for row in of], [row[quantity] for row in of], f"C{int(with_length)}o-", markersize=4, label=name)
        axes.set(xlabel="h (m)", ylabel=quantity.replace(", ", " (") + ")", title=scene, xlim=(0, None),
                 ylim=(0, 1.25 * max(row[quantity] for row in rows if row["scene"] == scene)))
        axes.legend()


STUDY = Study(title="Shear bands and cell size", question="Does the strength of softening soil depend on the cells?",
              advice="Give softening soil a `Nonlocal length` and cells of at most half of it.", base="prm/softening/biaxial.prm",
              variants=[variant(size, length) for scene, variant in ((BIAXIAL, biaxial), (BANK, bank)) for length in (0., LENGTHS[scene]) for size in SIZES[scene]
                        if length > 0 or size != 0.0125],
              measure=measure, verdict=verdict, table=table, chart=Curves(draw), quick=lambda labels: labels["scene"] == BIAXIAL and labels["h"] > 0.04)

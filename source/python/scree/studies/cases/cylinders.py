# SPDX-License-Identifier: LGPL-2.1-or-later
"""The text of its section: doc/studies/intro/cylinders.md."""

import math

import numpy as np

from scree.studies import Limit, NoChart, Study, Variant, volume_below, whole_cells
from scree.studies.cases.run_out_limits import DIAMETER, REPOSE, TRIAXIAL, WITH, WITHOUT, WIDTH

SIZES = {1: (8, 12, 16), 2: (8, 12)}
TREATMENTS = ((REPOSE, WITH), (TRIAXIAL, WITH), (TRIAXIAL, WITHOUT))
RUN_OUT = "run-out"


def measured(aspect):
    return 1.24 * aspect if aspect < 1.7 else 1.6 * math.sqrt(aspect)


def variant(aspect, cells, kind, friction):
    reach, height = 1 + 1.5 * measured(aspect), aspect + 0.25
    time = 8 * math.sqrt(aspect / 9.81)
    return Variant({"a": float(aspect), "cells": cells, "angle": kind, "friction": friction}, {
        **whole_cells(1 / cells, (reach, reach, height)),
        "Soil/Region": f"x^2 + y^2 < 1 && z < {aspect}", "Soil/Points per cell": 3,
        "Soil/Mohr-Coulomb/Young's modulus": f"{1e6 * aspect:g}",
        "Soil/Mohr-Coulomb/Friction angle": 31, "Soil/Mohr-Coulomb/Friction angle kind": kind, "Transfer/PIC rate": 1,
        "Soil/Mohr-Coulomb/Grain diameter": DIAMETER if friction == WITH else 0, "End time": f"{time:.4f}",
        "Output/Interval": f"{time / 4:.4f}", "Output/Graphics": "points"})


def measure(run):
    points = run.points()
    radius, volume = np.hypot(points.positions[:, 0], points.positions[:, 1]), points.arrays["volume"].ravel()
    order = np.argsort(radius)
    mass = np.cumsum(points.arrays["mass"].ravel()[order])
    within = volume_below(radius, volume, 3)
    places = np.arange(1., radius.max() + WIDTH, 0.01)
    depths = [(within(place + WIDTH) - within(place)) / (math.pi / 4 * ((place + WIDTH) ** 2 - place ** 2))
              for place in places]
    front = places[np.flatnonzero(np.array(depths) > 0.02)[-1]] + WIDTH / 2 - 1
    return {RUN_OUT: front, "run-out, 99 %": np.interp(0.99 * mass[-1], mass, radius[order]) - 1,
            "height": np.percentile(points.positions[radius < 0.1, 2], 99)}


def group(rows, aspect, kind, friction):
    """From the largest cells to the smallest."""
    return rows.where(a=aspect, angle=kind, friction=friction).from_coarse()


def table(rows):
    found = [("a", "angle read as", "friction", *(f"{cells} cells" for cells in SIZES[1]), "at h = 0", "measured")]
    for aspect in SIZES:
        for treatment in TREATMENTS:
            of = group(rows, aspect, *treatment)
            if len(of) == len(SIZES[aspect]):
                cells = [f"{run_out:.2f}" for run_out in of.values[RUN_OUT]] + ["-"] * (len(SIZES[1]) - len(of))
                found.append((aspect, *treatment, *cells, f"{Limit(of, RUN_OUT):.2f}", f"{measured(aspect):.2f}"))
    return found


def verdict(rows, claim):
    claims = []
    if not all(len(group(rows, aspect, *treatment)) == len(sizes)
               for aspect, sizes in SIZES.items() for treatment in TREATMENTS):
        slower = [group(rows, 1, *treatment)[0][RUN_OUT] for treatment in TREATMENTS]
        return [claim("short", slower == sorted(slower))]
    for kind, friction in TREATMENTS:
        values = {aspect: Limit(group(rows, aspect, kind, friction), RUN_OUT).value for aspect in SIZES}
        off = [value / measured(aspect) - 1 for aspect, value in values.items()]
        told = ", ".join(f"{value:.2f} for a = {aspect} (measured {measured(aspect):.2f}, {100 * part:+.0f} %)"
                         for (aspect, value), part in zip(values.items(), off))
        claims.append(claim("run-out", max(map(abs, off)) < 0.1, quick=False, worst=kind == REPOSE, kind=kind,
                            friction=friction, values=told))
    return claims


STUDY = Study(
    "prm/benchmarks/mohr_coulomb_column_3d.prm",
    variants=[variant(aspect, cells, *treatment) for aspect in SIZES for treatment in TREATMENTS
              for cells in SIZES[aspect]],
    chart=NoChart(), quick=lambda labels: labels["cells"] == 8 and labels["a"] == 1)

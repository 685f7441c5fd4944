# SPDX-License-Identifier: LGPL-2.1-or-later
"""Columns of glass beads collapse in a viscous liquid (Rondon, Pouliquen & Aussillous 2011): loose beads fast and far, dense ones late and less far.

Plan, fixed before the runs:

- Loose: 6 cm x 4.8 cm, volume fraction 0.55. Dense: 6 cm x 4.2 cm, 0.60. Beads of 0.225 mm, liquid of 0.012 Pa s (`prm/columns/submerged_beads.prm`).
- Soil: Nor-Sand with a critical volume fraction of 0.582 and a friction coefficient of 0.425 in simple shear (Pailha & Pouliquen 2009); stiffness and hardening are assumed.
- Drag after Ergun from the diameter; the viscosity of separated beads after Krieger & Dougherty. No entry is fitted to the collapse.
- Dilatancy multiplier -4.5 (default), and -2.2, which corresponds to the dilatancy of 4.09 times the volume fraction of Pailha & Pouliquen.
- Cells of 3 mm, 16 in 4.8 cm; added after the results: 8 in 4.8 cm.
- Quantities: front where the beads are 0.02 H deep; pressure in excess of the hydrostatic one at the base, 2 cm from the wall.

Bounds: the pressure rises in loose beads and falls in dense ones; the largest change is within a factor of 1.5 of the measured one; the way of the front at the
end of the record is within 10 %.
"""

import numpy as np

from scree import results
from scree.studies.cases.run_out_limits import front_of_depth
from scree.studies.charts import Curves, name_lines
from scree.studies.study import Claim, Study, Variant, reference_rows

LOOSE, DENSE = "loose", "dense"
LENGTH, HEIGHTS = 0.06, {LOOSE: 0.048, DENSE: 0.042}  # m
TIMES = {LOOSE: 6., DENSE: 10.}  # s
PACKINGS = {LOOSE: {}, DENSE: {"Soil/Region": "x < 0.06 && y < 0.042", "Soil/Initial porosity": 0.4, "Soil/Nor-Sand/Initial specific volume": 1.667,
                               "Mesh/Upper corner": "0.24, 0.06"}}
SHOWN = (0.5, 1., 1.5, 2., 3., 4., 5., 6., 8., 10.)  # s, in the chart
WAY, PRESSURE = "way of the front (cm)", "largest change of pressure (Pa)"


def variant(packing, dilatancy, cells=16):
    size = 0.048 / cells
    return Variant({"packing": packing, "dilatancy": dilatancy, "cells": cells},
                   {**PACKINGS[packing], "Mesh/Cell size": size, "Soil/Nor-Sand/Dilatancy multiplier": dilatancy, "End time": TIMES[packing],
                    "Output/Interval": 0.1, "Output/Graphics": "points", "Probes/Places": f"gauge: 0.02, {size / 2}"})


def measured(packing, quantity):
    rows = [row for row in reference_rows("rondon_2011") if (row["packing"], row["quantity"]) == (packing, quantity)]
    return np.array([float(row["time_s"]) for row in rows]), np.array([float(row["value"]) for row in rows])


def front(points, height):
    return front_of_depth(points, 0.02 * height, LENGTH / 2, height / 16, height / 200)


def measure(run):
    height = HEIGHTS[run.labels["packing"]]
    columns = results.read_table(run.folder / "probe_gauge")
    time, pressure = columns["Time (s)"], columns["Pore pressure (Pa)"]
    excess = np.where(time > 0.05, pressure - pressure[0], 0.)
    largest = np.argmax(np.abs(excess))
    times = results.read_times(run.folder)
    way = {time: 100 * (front(run.points(time), height) - LENGTH) for time in times}
    shown = {key: value for moment in SHOWN if moment <= times[-1] + 1e-9
             for key, value in ((f"way at {moment:g} s", np.interp(moment, times, list(way.values()))),
                                (f"pressure at {moment:g} s", np.mean(excess[np.abs(time - moment) < 0.25])))}
    return {WAY: way[times[-1]], "half of it at (s)": next(time for time in times if way[time] >= way[times[-1]] / 2),
            PRESSURE: excess[largest], "at (s)": time[largest], **{name: shown.get(name, np.nan) for moment in SHOWN
                                                                    for name in (f"way at {moment:g} s", f"pressure at {moment:g} s")}}


def of(rows, packing, cells=16):
    """The run with the default dilatancy."""
    return next((row for row in rows if (row["packing"], row["dilatancy"], row["cells"]) == (packing, -4.5, cells)), None)


def measured_values(packing):
    """(way of the front at the end in cm, largest change of pressure in Pa, time of half the way in s) of the experiment."""
    (time, place), (_, pressure) = measured(packing, "front"), measured(packing, "pressure")
    way = place - 100 * LENGTH
    return way[-1], pressure[np.argmax(np.abs(pressure))], np.interp(way[-1] / 2, way, time)


def table(rows):
    found = [["packing", "dilatancy multiplier", "cells in 4.8 cm", "way of the front (cm)", "measured", "half of its own way at (s)", "half of the measured way at (s)", "largest change of pressure (Pa)", "measured"]]
    for row in rows:
        way, pressure, half = measured_values(row["packing"])
        found.append([row["packing"], f"{row['dilatancy']:g}", f"{row['cells']:g}", f"{row[WAY]:.1f}", f"{way:.1f}", f"{row['half of it at (s)']:.1f}", f"{half:.1f}",
                      f"{row[PRESSURE]:+.0f}", f"{pressure:+.0f}"])
    return found


def verdict(rows):
    loose, dense = of(rows, LOOSE), of(rows, DENSE)
    if loose is None or dense is None:
        return [Claim("The pressure below loose beads rises.", all(row[PRESSURE] > 0 for row in rows if row["packing"] == LOOSE))]
    claims = [Claim(f"The pressure below loose beads rises by {loose[PRESSURE]:.0f} Pa, and falls below dense ones by {-dense[PRESSURE]:.0f} Pa.",
                    loose[PRESSURE] > 0 > dense[PRESSURE], quick=False)]
    ways, pressures = ({row["packing"]: row[name] / measured_values(row["packing"])[number] for row in (loose, dense)} for number, name in enumerate((WAY, PRESSURE)))
    longer = {packing: sorted(100 * row[WAY] / measured_values(packing)[0] - 100 for row in rows if row["packing"] == packing and row["cells"] == 16) for packing in (LOOSE, DENSE)}
    claims.insert(0, Claim(f"The front moves {longer[LOOSE][0]:.0f} to {longer[LOOSE][-1]:.0f} % farther than measured in loose beads and {longer[DENSE][0]:.0f} to "
                           f"{longer[DENSE][-1]:.0f} % in dense ones; half of its way takes twice the measured time. Bound: 10 %.",
                           max(abs(way - 1) for way in ways.values()) < 0.1, quick=False, worst=True))
    claims.append(Claim(f"The largest change of pressure is {pressures[LOOSE]:.2f} (loose) and {pressures[DENSE]:.2f} (dense) of the measured one. Bound: a factor of 1.5.",
                        all(1 / 1.5 < pressure < 1.5 for pressure in pressures.values()), quick=False))
    return claims


def draw(figure, rows):
    for axes, quantity, name, label in zip(figure.subplots(1, 2), ("front", "pressure"), ("way", "pressure"), ("way of the front (cm)", "excess pressure (Pa)")):
        for packing, color in ((LOOSE, "C0"), (DENSE, "C1")):
            time, value = measured(packing, quantity)
            axes.plot(time, value - (100 * LENGTH if quantity == "front" else 0), "o", color=color, markersize=4)
            row = of(rows, packing)
            if row:
                axes.plot(SHOWN, [row[f"{name} at {moment:g} s"] for moment in SHOWN], color=color, label=packing)
        axes.set(xlabel="t (s); points: measured", ylabel=label)
        name_lines(axes)


STUDY = Study(title="Beads in a viscous liquid", question="Do loose and dense grains collapse under water as in the experiment?",
              advice="Trust the sign of the change of pressure and its size within a factor of 1.5. Do not use the run-out.",
              base="prm/columns/submerged_beads.prm", variants=[variant(packing, dilatancy) for packing in (LOOSE, DENSE) for dilatancy in (-4.5, -2.2)] + [variant(packing, -4.5, 8) for packing in (LOOSE, DENSE)],
              measure=measure, verdict=verdict, table=table, quick=lambda labels: labels["cells"] == 8 and labels["packing"] == LOOSE, quick_entries={"End time": 1.}, chart=Curves(draw))

# SPDX-License-Identifier: LGPL-2.1-or-later
"""The text of its section: doc/studies/intro/porous_dam_break.md."""

import numpy as np

from scree.studies import RunCurves, Study, axis, mean_depth, product, reference_rows, tabled

DEPTH = 0.35  # m, of the water before the break
FACES, POROSITY = (0.3, 0.59), 0.49  # of the rock, m and -
TIMES = ("0.35", "0.75", "1.15", "1.55", "1.95")  # s
VOLUME = "largest volume error"


def measured(time):
    """Places and heights of the surface, m."""
    rows = [row for row in reference_rows("lin_1998_porous_dam_break") if row["time_s"] == time]
    return np.array([[float(row["x_m"]), float(row["z_m"])] for row in rows]).T


def surface(run, time, x):
    """Height of the water at some places, m: its volume over the width of a cell, and over the porosity in the rock."""
    water, h = run.points(float(time), "water"), run.labels["h"]
    cells = h * np.arange(round(float(run.entries["Mesh/Upper corner"].split(",")[0]) / h) + 1)
    centres = (cells[1:] + cells[:-1]) / 2
    depth = mean_depth(water.positions[:, 0], water.arrays["volume"], cells[:-1], cells[1:])
    return np.interp(x, centres, depth / np.where((centres > FACES[0]) & (centres < FACES[1]), POROSITY, 1))


def label(time):
    return f"rms at {time} s"


def measure(run):
    found = {}
    for time in TIMES:
        x, z = measured(time)
        found[label(time)] = np.sqrt(np.mean((surface(run, time, x) - z)**2)) / DEPTH
    return {**found, VOLUME: np.max(run.statistics("Volume error (-)"))}


def verdict(rows, claim):
    largest = {time: max(rows.values[label(time)]) for time in TIMES}
    latest = max(largest, key=largest.get)
    return [claim("surface", largest[latest] < 0.05, largest=largest[latest], time=latest, least=min(largest.values())),
            claim("volume", rows.largest[VOLUME] < 0.015, quick=False, values=rows.values[VOLUME])]


table = tabled({"h (m)": "{[h]:g}", "points of water per axis": "{[points]:g}", **{f"RMS at {time} s (% of the depth)": f"{{[{label(time)}]:.1f %}}" for time in TIMES},
                VOLUME: f"{{[{VOLUME}]:.3f}}"})


def curves(run):
    x = np.linspace(0, 0.89, 90)
    return {f"{time} s, h = {run.labels['h']:g} m, {run.labels['points']}": (x, 100 * surface(run, time, x)) for time in TIMES}


def draw(figure, found, _):
    for plot, time in zip(figure.subplots(2, 3, sharex=True, sharey=True).flat, TIMES):
        plot.axvspan(*FACES, color="0.9")
        for colour, (name, line) in enumerate((name, line) for name, line in found.items() if name.startswith(time) and name.endswith("4")):
            plot.plot(*line, f"C{colour}-", linewidth=1.2, label=name.split(", ")[1] if time == TIMES[0] else "_")
        x, z = measured(time)
        plot.plot(x, 100 * z, "k.", markersize=4, label="measured" if time == TIMES[0] else "_")
        plot.set_title(f"{time} s", fontsize=9)
    figure.axes[0].legend(fontsize=8)
    figure.axes[5].axis("off")
    figure.supxlabel("x (m); grey: crushed rock", fontsize=9)
    figure.supylabel("height of the water (cm)", fontsize=9)


def size(h):
    return {"Mesh/Cell size": h, **({"Mesh/Upper corner": "0.9, 0.4"} if h == 0.02 else {})}


def points(number):
    return axis("points", "Water/Points per cell", [number])


STUDY = Study(
    "prm/seepage/porous_dam_break.prm", chart=RunCurves(curves, draw, 4.2), entries={"Output/Graphics": "points"},
    variants=product(axis("h", size, [0.02, 0.01, 0.005]), points(4)) + product(axis("h", size, [0.01]), points(6)),
    quick=lambda labels: labels["h"] == 0.02)

# SPDX-License-Identifier: LGPL-2.1-or-later
"""A column of water collapses on a dry floor: front and height against the experiment of Martin & Moyce 1952 (n^2 = 2).

The column is a = 1 m wide and 2 a high; floor and walls are smooth.
Front: Z = x/a over T = t sqrt(2 g/a), with x of the farthest point of water.
Height: H = y/(2 a) at the wall over Y = t sqrt(g/a), with y of the highest water within a/10 of the wall.
The experiment (`doc/studies/reference/martin_moyce_1952_*.csv`) has a = 57 mm.
The residual is the RMS of computed minus measured over the measured times.

The gate, the wetting and the friction of floor and walls of the experiment are not modelled.
A delay of the motion is fitted to the front by least squares.
The residuals after it are given separately: of the front and, with the same delay, of the height.
"""
import math

import numpy as np

from scree.studies.charts import RunCurves
from scree.studies.study import Claim, Study, axis, reference_rows

WIDTH, GRAVITY = 1., 9.81  # a, m; m/s^2
HEIGHT_ZONE = 0.1 * WIDTH


def experiment(name):
    """Columns of a table: dimensionless time and length."""
    return np.array([list(row.values()) for row in reference_rows(f"martin_moyce_1952_{name}")], dtype=float).T


def front(run):
    """T and Z."""
    return run.time * math.sqrt(2 * GRAVITY / WIDTH), run.statistics("Water tip (m)") / WIDTH


def height(run):
    """Y and H, of the pictures up to the last measured time but one."""
    cell = float(run.entries["Mesh/Cell size"])
    times, heights = [], []
    for time in np.arange(0, float(run.entries["End time"]) + 1e-9, float(run.entries["Output/Interval"])):
        water = run.points(time, "water")
        near = water.positions[water.positions[:, 0] < HEIGHT_ZONE]
        times.append(water.time * math.sqrt(GRAVITY / WIDTH))
        heights.append((np.max(near[:, 1]) + cell / 8) / (2 * WIDTH))  # points of 4 a cell: half a spacing below their surface
    return np.array(times), np.array(heights)


def residuals(curve, measured, delay):
    """Computed, `delay` later, minus measured, at the measured times that the run covers."""
    covered = measured[0] <= curve[0][-1] + delay
    return np.interp(measured[0][covered] - delay, *curve) - measured[1][covered]


def rms(values):
    return math.sqrt(np.mean(values**2))


def fitted_delay(fronts):
    """In T; in Y it is sqrt(2) times shorter."""
    return min(np.arange(0, 1, 0.005), key=lambda delay: rms(residuals(fronts, experiment("front"), delay)))


def measure(run):
    CHART.keep(run)
    fronts, heights = front(run), height(run)
    delay = fitted_delay(fronts)
    return {"rms of Z": rms(residuals(fronts, experiment("front"), 0)), "delay (T)": delay,
            "rms of Z, delayed": rms(residuals(fronts, experiment("front"), delay)),
            "rms of H": rms(residuals(heights, experiment("height"), 0)),
            "rms of H, delayed": rms(residuals(heights, experiment("height"), delay / math.sqrt(2))),
            "mean of H": np.mean(residuals(heights, experiment("height"), 0)),
            "Z at T = 2.98": np.interp(2.98, *fronts), "H at Y = 2": np.interp(2, *heights),
            "largest volume error": np.max(run.statistics("Volume error (-)"))}


def verdict(rows):
    finest, coarsest = min(rows, key=lambda row: row["h"]), max(rows, key=lambda row: row["h"])
    measured = dict(zip(*experiment("front")))[2.98]
    change = max(rows, key=lambda row: row["rms of Z"])["rms of Z"] - finest["rms of Z"]
    milliseconds = 1e3 * finest["delay (T)"] * math.sqrt(0.05715 / (2 * GRAVITY))
    return [
        Claim(f"The front is {100 * (finest['Z at T = 2.98'] / measured - 1):.0f} % ahead of the experiment: Z = {finest['Z at T = 2.98']:.2f} instead of {measured:.2f} at T = 2.98, "
              f"RMS of Z {finest['rms of Z']:.2f}.",
              holds=all(row["Z at T = 2.98"] > 1.05 * measured for row in rows)),
        Claim(f"The height at the wall follows the experiment, without any fit: RMS of H {finest['rms of H']:.3f} at h = {finest['h']:g} m, "
              f"{coarsest['rms of H']:.3f} at {coarsest['h']:g} m.", holds=all(row["rms of H"] < 0.02 for row in rows)),
        Claim(f"A delay by T = {finest['delay (T)']:.3g} ({milliseconds:.0f} ms of the experiment) reduces the RMS of the front to "
              f"{finest['rms of Z, delayed']:.3f}, "
              f"but increases that of the height from {finest['rms of H']:.3f} to {finest['rms of H, delayed']:.3f}. A late opening of the gate would retard the whole column. "
              "It does not explain the front if both tables count from the same moment: the retardation acts on the front alone.",
              holds=all(row["rms of Z, delayed"] < 0.2 * row["rms of Z"] and row["rms of H, delayed"] > 2 * row["rms of H"] for row in rows)),
        Claim(f"The cell size does not explain it: from h = {coarsest['h']:g} to {finest['h']:g} m the front's residual falls by {change:.2f} of "
              f"{coarsest['rms of Z']:.2f}.",
              holds=change < 0.25 * coarsest["rms of Z"]),
    ]


def draw(figure, runs):
    fronts, heights = figure.subplots(1, 2)
    for index, run in enumerate(runs):
        style = {"color": f"C{index}", "linewidth": 1.2, "label": f"h = {run.labels['h']:g} m"}
        fronts.plot(*front(run), **style)
        heights.plot(*height(run), **style)
    fronts.plot(*experiment("front"), "ko", markersize=4, label="Martin & Moyce 1952")
    heights.plot(*experiment("height"), "ko", markersize=4, label="Martin & Moyce 1952")
    finest = runs[-1]
    delay = fitted_delay(front(finest))
    fronts.plot(front(finest)[0] + delay, front(finest)[1], "k:", linewidth=1, label=f"h = {finest.labels['h']:g} m, later by T = {delay:.3g}")
    heights.plot(height(finest)[0] + delay / math.sqrt(2), height(finest)[1], "k:", linewidth=1, label="the same")
    fronts.set(xlabel=r"$T = t\sqrt{2g/a}$", ylabel="front $Z = x/a$", xlim=(0, 3.5), ylim=(1, 5))
    heights.set(xlabel=r"$Y = t\sqrt{g/a}$", ylabel="height at the wall $H = y/2a$", xlim=(0, 4.5), ylim=(0, 1.02))
    for axes in (fronts, heights):
        axes.grid(alpha=0.3)
        axes.legend(fontsize="small")


CHART = RunCurves(draw, size=(10, 4.5))
STUDY = Study(title="Dam break against the experiment of Martin & Moyce", base="prm/water/dam_break.prm",
              entries={"End time": 1.35, "Mesh/Upper corner": "10, 2.4", "Output/Graphics": "points"},
              variants=axis("h", lambda h: {"Mesh/Cell size": h, "Time step/Maximum time step": 0.04 * h}, [0.1, 0.05, 0.025]),
              quick=lambda labels: labels["h"] >= 0.05, measure=measure, verdict=verdict, chart=CHART)

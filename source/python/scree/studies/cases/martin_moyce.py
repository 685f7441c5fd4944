# SPDX-License-Identifier: LGPL-2.1-or-later
"""The text of its section: doc/studies/intro/martin_moyce.md."""
import math

import numpy as np

from scree.pictures.tables import name_lines
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


def table(rows):
    return [("h (m)", "Z at T = 2.98", "RMS of Z", "fitted delay (T)", "RMS of Z, delayed", "RMS of H", "RMS of H, delayed"),
            *((f"{row['h']:g}", *(f"{row[name]:.3g}" for name in ("Z at T = 2.98", "rms of Z", "delay (T)", "rms of Z, delayed", "rms of H", "rms of H, delayed")))
              for row in rows)]


def compared(rows):
    finest, (times, fronts), (late, heights) = min(rows, key=lambda row: row["h"]), experiment("front"), experiment("height")
    return [(f"dam break, front x/a at T = 2.98, h = {finest['h']:g} m", "-", np.interp(2.98, times, fronts), finest["Z at T = 2.98"]),
            (f"dam break, height y/(2 a) at Y = 2, h = {finest['h']:g} m", "-", np.interp(2, late, heights), finest["H at Y = 2"])]


def curves(run):
    return {f"{name}, {run.labels['h']:g} m": points for name, points in (("front", front(run)), ("height", height(run)))}


def draw(figure, found, _):
    plots = dict(zip(("front", "height"), figure.subplots(1, 2)))
    sizes = sorted({float(name.split(", ")[1].split()[0]) for name in found})
    delay = fitted_delay(found[f"front, {sizes[0]:g} m"])
    for name, plot in plots.items():
        for size, style in ((sizes[0], "C0-"), (sizes[-1], "C1-")):
            plot.plot(*found[f"{name}, {size:g} m"], style, linewidth=1.5, label=f"h = {size:g} m" if name == "front" else "_")
        times, values = found[f"{name}, {sizes[0]:g} m"]
        plot.plot(times + delay / (1 if name == "front" else math.sqrt(2)), values, "C0:", linewidth=1.2, label=f"h = {sizes[0]:g} m,\nlater by T = {delay:.3g}" if name == "front" else "_")
        plot.plot(*experiment(name), "ko", markersize=4)
    plots["front"].set(xlabel="T = t (2 g/a)^0.5", ylabel="front Z = x/a", xlim=(0, 3.5), ylim=(1, 5))
    plots["height"].set(xlabel="Y = t (g/a)^0.5; dots: measured", ylabel="height at the wall H = y/(2 a)", xlim=(0, 4.5), ylim=(0, 1.02))
    name_lines(plots["front"])


CHART = RunCurves(curves, draw, 3.4)
STUDY = Study(title="Dam break of Martin & Moyce",
              question="Does a dam break follow the measured front and height?",
              advice="Expect a front 12 % ahead of an experiment with a gate and a dry rough floor.",
              base="prm/water/dam_break.prm",
              entries={"End time": 1.35, "Mesh/Upper corner": "10, 2.4", "Output/Graphics": "points"},
              variants=axis("h", lambda h: {"Mesh/Cell size": h, "Time step/Maximum time step": 0.04 * h}, [0.1, 0.05, 0.025]),
              quick=lambda labels: labels["h"] >= 0.05, measure=measure, verdict=verdict, chart=CHART, table=table, compared=compared)

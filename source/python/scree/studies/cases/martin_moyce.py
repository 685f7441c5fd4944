# SPDX-License-Identifier: LGPL-2.1-or-later
"""The text of its section: doc/studies/intro/martin_moyce.md."""
import math

import numpy as np

from scree.pictures.tables import name_lines
from scree.studies import RunCurves, Study, axis, reference_rows, tabled

WIDTH, GRAVITY = 1., 9.81  # a, m; m/s^2
HEIGHT_ZONE = 0.1 * WIDTH
LATE = "Z at T = 2.98"


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
        # points of 4 a cell: half a spacing below their surface
        heights.append((np.max(near[:, 1]) + cell / 8) / (2 * WIDTH))
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
            LATE: np.interp(2.98, *fronts), "H at Y = 2": np.interp(2, *heights)}


def verdict(rows, claim):
    finest, coarsest = rows.with_smallest("h"), rows.with_largest("h")
    measured = dict(zip(*experiment("front")))[2.98]
    change = rows.largest["rms of Z"] - finest["rms of Z"]
    claim = claim.shared(finest=finest, coarsest=coarsest)
    return [
        claim("front", all(front > 1.05 * measured for front in rows.values[LATE]), measured=measured,
              ahead=finest[LATE] / measured - 1),
        claim("height", all(rms < 0.02 for rms in rows.values["rms of H"])),
        claim("delay", all(row["rms of Z, delayed"] < 0.2 * row["rms of Z"]
                           and row["rms of H, delayed"] > 2 * row["rms of H"] for row in rows),
              milliseconds=1e3 * finest["delay (T)"] * math.sqrt(0.05715 / (2 * GRAVITY))),
        claim("mesh", change < 0.25 * coarsest["rms of Z"], change=change)]


table = tabled({"h (m)": "{[h]:g}", LATE: "{[Z at T = 2.98]:.3g}", "RMS of Z": "{[rms of Z]:.3g}",
                "fitted delay (T)": "{[delay (T)]:.3g}",
                "RMS of Z, delayed": "{[rms of Z, delayed]:.3g}", "RMS of H": "{[rms of H]:.3g}",
                "RMS of H, delayed": "{[rms of H, delayed]:.3g}", "H at Y = 2, measured 0.5": "{[H at Y = 2]:.3f}"})


def curves(run):
    return {f"{name}, {run.labels['h']:g} m": points
            for name, points in (("front", front(run)), ("height", height(run)))}


def draw(figure, found, _):
    plots = dict(zip(("front", "height"), figure.subplots(1, 2)))
    sizes = sorted({float(name.split(", ")[1].split()[0]) for name in found})
    delay = fitted_delay(found[f"front, {sizes[0]:g} m"])
    for name, plot in plots.items():
        for size, style in ((sizes[0], "C0-"), (sizes[-1], "C1-")):
            plot.plot(*found[f"{name}, {size:g} m"], style, linewidth=1.5,
                      label=f"h = {size:g} m" if name == "front" else "_")
        times, values = found[f"{name}, {sizes[0]:g} m"]
        late = times + delay / (1 if name == "front" else math.sqrt(2))
        plot.plot(late, values, "C0:", linewidth=1.2,
                  label=f"h = {sizes[0]:g} m,\nlater by T = {delay:.3g}" if name == "front" else "_")
        plot.plot(*experiment(name), "ko", markersize=4)
    plots["front"].set(xlabel="T = t (2 g/a)^0.5", ylabel="front Z = x/a", xlim=(0, 3.5), ylim=(1, 5))
    plots["height"].set(xlabel="Y = t (g/a)^0.5; dots: measured", ylabel="height at the wall H = y/(2 a)",
                        xlim=(0, 4.5), ylim=(0, 1.02))
    name_lines(plots["front"])


STUDY = Study(
    "prm/water/dam_break.prm",
    entries={"End time": 1.35, "Mesh/Upper corner": "10, 2.4", "Output/Graphics": "points"},
    variants=axis("h", lambda h: {"Mesh/Cell size": h, "Time step/Maximum time step": 0.04 * h}, [0.1, 0.05, 0.025]),
    quick=lambda labels: labels["h"] >= 0.05, chart=RunCurves(curves, draw, 3.4))

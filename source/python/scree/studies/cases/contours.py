# SPDX-License-Identifier: LGPL-2.1-or-later
"""The text of its section: doc/studies/intro/contours.md."""
import numpy as np

from scree import results
from scree.pictures import fields, plane
from scree.studies import Pictures, Study, axis, filled, product

VOLUMES = {"dense": 1.629, "loose": 1.736}
TITLES = {"none": "no stabilisation", "standard": "F-bar", "modified": "modified F-bar",
          "projected": "projected F-bar"}
SHOWN = 0.4  # s
EARLY, END = f" to {SHOWN:g} s", " to the end"
DOUBLED, TENTH = "largest effective stress doubled at (s)", "a tenth of the released energy gained at (s)"
FIELD, LARGEST = "mean_effective_stress", 20.  # kPa, end of the colours: about the weight of 2 m of soil, K0


def first_time(time, true):
    """nan: never."""
    return time[np.argmax(true)] if np.any(true) else np.nan


def measure(run):
    time, potential = run.time, run.statistics("Potential energy (J)")
    oscillation, largest, dissipation = map(run.statistics, ("Stress oscillation (-)", "Largest effective stress (Pa)",
                                                             "Numerical dissipation (J)"))
    gained = np.maximum.accumulate(dissipation) - dissipation
    released = np.maximum(potential[0] - potential, 1e-9)
    columns = {DOUBLED: first_time(time, largest > 2 * largest[0]),
               TENTH: first_time(time, (gained > 0.1 * released) & (time > 0.1))}
    for name, chosen in ((EARLY, time <= SHOWN * (1 + 1e-9)), (END, time >= 0)):
        columns.update({"oscillation" + name: np.trapz(oscillation[chosen], time[chosen]) / np.ptp(time[chosen]),
                        "largest effective stress (kPa)" + name: 1e-3 * np.max(largest[chosen]),
                        "energy gained over released" + name: np.max(gained[chosen]) / released[chosen][-1],
                        "front 99.5 % (m)" + name: run.statistics("Front 99.5 % (m)")[chosen][-1],
                        "steps" + name: run.statistics("Step")[chosen][-1]})
    return columns


def verdict(rows, claim):
    of = {f_bar: rows.where({"F-bar": f_bar}) for f_bar in TITLES}
    names = "oscillation", "largest effective stress (kPa)", "energy gained over released"
    oscillation, largest, gained = (name + EARLY for name in names)

    def below(column, smaller, larger):
        """Whether a column is smaller with one F-bar than with another in each slope."""
        return np.all(np.array(of[smaller].values[column]) < np.array(of[larger].values[column]))

    def times(f_bar, column):
        return ["-" if np.isnan(time) else f"{time:.2f}" for time in of[f_bar].values[column]]

    def dense(f_bar, column):
        """From coarse to fine."""
        return of[f_bar].where(soil="dense").from_coarse().values[column]

    smooth, rough = dense("projected", oscillation), dense("standard", oscillation)
    claim = claim.shared(shown=SHOWN, slopes=[f"{row['soil']} {row['h']:g} m" for row in of["projected"]],
                         largest={f_bar: found.values[largest] for f_bar, found in of.items()})
    claims = [
        claim("oscillation", below(oscillation, "projected", "modified") and below(oscillation, "modified", "none")
              and below(oscillation, "modified", "standard")),
        claim("largest", below(largest, "projected", "standard") and below(largest, "modified", "standard"), doubled={f_bar: times(f_bar, DOUBLED) for f_bar in TITLES}),
        claim("gain", np.all(np.diff(dense("standard", gained)) > 0) and dense("standard", gained)[-1] > 0.1
              and max(np.max(of[f_bar].values[gained]) for f_bar in ("modified", "projected")) < 0.005, quick=False,
              worst=True, gained=[f"{part:.0%}" for part in of["standard"].values[gained]],
              tenth=times("standard", TENTH),
              most={f_bar: np.max(found.values[gained]) for f_bar, found in of.items()}),
        claim("mesh", np.all(np.diff(smooth) < 0) and rough[-1] > rough[0], quick=False, coarse=smooth[0],
              fine=smooth[-1])]
    late = rows.where(lambda row: row["end"] > SHOWN)
    if late:
        found = {name: " / ".join(filled(form, late.where({"F-bar": f_bar}).values[name + END]) for f_bar in TITLES)
                 for name, form in (("oscillation", "{:.3f}"), ("steps", "{:.0f}"))}
        calm = all(value < 0.06 for value in late.where({"F-bar": "projected"}).values["oscillation" + END])
        claims.append(claim("end", calm, **found))
    return claims


def table(rows):
    def value_of(like, f_bar):
        row = rows.first({"soil": like["soil"], "h": like["h"], "F-bar": f_bar})
        return row["oscillation" + EARLY] if row else np.nan
    return [("oscillation of p', slope and cell size", *TITLES.values()),
            *((f"{row['soil']}, {row['h']:g} m", *(f"{value_of(row, f_bar):.3f}" for f_bar in TITLES))
              for row in rows.where({"F-bar": "projected"}))]


def draw(figure, runs):
    lines = list(dict.fromkeys((run.labels["soil"], run.labels["h"]) for run in runs))
    plots = figure.subplots(len(lines), len(TITLES), sharex=True, sharey=True, squeeze=False)
    for run in runs:
        box = results.read_box(run.folder)
        plot = plots[lines.index((run.labels["soil"], run.labels["h"])), list(TITLES).index(run.labels["F-bar"])]
        drawn = plane.draw_points(plot, run.points(SHOWN), box._replace(upper=np.array([4.4, 2.1])), FIELD,
                                  (0., LARGEST))
        plot.set_ylabel(f"{run.labels['soil']}, {run.labels['h']:g} m\n{plot.get_ylabel()}")
        plot.label_outer()
    for plot, title in zip(plots[0], TITLES.values()):
        plot.set_title(title, fontsize="medium")
    figure.colorbar(drawn, ax=plots, label=f"{fields.field_label(FIELD)}, t = {SHOWN:g} s", extend="max", aspect=40)


def slopes(cell_size, soils, end):
    return product(axis("h", "Mesh/Cell size", [cell_size]),
                   axis("soil", lambda soil: {"Soil/Nor-Sand/Initial specific volume": VOLUMES[soil]}, soils),
                   axis("F-bar", "Stabilisation/F-bar", list(TITLES)), axis("end", "End time", [end]))


STUDY = Study(
    "prm/slopes/slope_dense.prm", needs_end=False,
    entries={"Output/Graphics": "points", "Output/Interval": 0.1, "Output/Statistics interval": 0.02},
    variants=slopes(0.1, ["dense"], SHOWN) + slopes(0.05, ["dense"], 1) + slopes(0.05, ["loose"], SHOWN)
    + slopes(0.025, ["dense"], SHOWN), quick=lambda labels: labels["h"] == 0.1, chart=Pictures(draw, 5.5), default={"F-bar": "projected"})

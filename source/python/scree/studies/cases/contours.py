# SPDX-License-Identifier: LGPL-2.1-or-later
"""The text of its section: doc/studies/intro/contours.md."""
import numpy as np

from scree import results
from scree.pictures import fields, plane
from scree.studies.charts import Pictures
from scree.studies.study import Claim, Study, axis, product

VOLUMES = {"dense": 1.629, "loose": 1.736}
TITLES = {"none": "no stabilisation", "standard": "F-bar", "modified": "modified F-bar"}
SHOWN = 0.4  # s
FIELD, LARGEST = "mean_effective_stress", 20.  # kPa, end of the colours: about the weight of 2 m of soil, K0


def first_time(time, true):
    """nan: never."""
    return time[np.argmax(true)] if np.any(true) else np.nan


def measure(run):
    time, oscillation, largest, dissipation = run.time, *map(run.statistics, ("Stress oscillation (-)", "Largest effective stress (Pa)", "Numerical dissipation (J)"))
    gained = np.maximum.accumulate(dissipation) - dissipation
    released = np.maximum(run.statistics("Potential energy (J)")[0] - run.statistics("Potential energy (J)"), 1e-9)
    columns = {"largest effective stress doubled at (s)": first_time(time, largest > 2 * largest[0]),
               "a tenth of the released energy gained at (s)": first_time(time, (gained > 0.1 * released) & (time > 0.1))}
    for name, chosen in ((f" to {SHOWN:g} s", time <= SHOWN * (1 + 1e-9)), (" to the end", time >= 0)):
        columns.update({"oscillation" + name: np.trapz(oscillation[chosen], time[chosen]) / np.ptp(time[chosen]),
                        "largest effective stress (kPa)" + name: 1e-3 * np.max(largest[chosen]),
                        "energy gained over released" + name: np.max(gained[chosen]) / released[chosen][-1],
                        "front 99.5 % (m)" + name: run.statistics("Front 99.5 % (m)")[chosen][-1],
                        "steps" + name: run.statistics("Step")[chosen][-1]})
    return columns


def verdict(rows):
    def each(f_bar, column, form="{:.2f}", chosen=rows):
        return ", ".join("-" if np.isnan(row[column]) else form.format(row[column]) for row in chosen if row["F-bar"] == f_bar)

    def of(f_bar, column):
        return np.array([row[column] for row in rows if row["F-bar"] == f_bar])

    def dense(f_bar, column):
        """From coarse to fine."""
        chosen = [row for row in rows if row["F-bar"] == f_bar and row["soil"] == "dense"]
        return [row[column] for row in sorted(chosen, key=lambda row: -row["h"])]

    oscillation, largest, gained = (f"{name} to {SHOWN:g} s" for name in ("oscillation", "largest effective stress (kPa)", "energy gained over released"))
    order = ", ".join(f"{row['soil']} {row['h']:g} m" for row in rows if row["F-bar"] == "modified")
    doubled, late = "largest effective stress doubled at (s)", [row for row in rows if row["end"] > SHOWN]
    claims = [
        Claim(f"The oscillation of p' up to {SHOWN:g} s is smallest with modified F-bar.",
              holds=np.all(of("modified", oscillation) < of("none", oscillation)) and np.all(of("modified", oscillation) < of("standard", oscillation))),
        Claim(f"Largest p' up to {SHOWN:g} s, kPa ({order}): modified {each('modified', largest, '{:.0f}')}; none {each('none', largest, '{:.0f}')}; F-bar "
              f"{each('standard', largest, '{:.0f}')}. It has doubled since the start at {each('none', doubled)} s (-: not) without stabilisation. With F-bar it has at "
              f"{each('standard', doubled)} s.",
              holds=np.all(of("modified", largest) < of("standard", largest))),
        Claim(f"Standard F-bar gains energy, the more the finer the mesh: by {SHOWN:g} s {each('standard', gained, '{:.0%}')} of the released energy ({order}). A tenth is "
              f"gained at {each('standard', 'a tenth of the released energy gained at (s)')} s (-: not). Modified F-bar gains at most {np.max(of('modified', gained)):.2%}.",
              holds=np.all(np.diff(dense("standard", gained)) > 0) and dense("standard", gained)[-1] > 0.1 and np.all(of("modified", gained) < 0.005),
              quick=False, worst=True),
        Claim("In the dense slope (0.1, 0.05, 0.025 m) finer cells reduce the oscillation clearly with modified F-bar only, from "
              f"{dense('modified', oscillation)[0]:.3f} to {dense('modified', oscillation)[-1]:.3f}; with F-bar it grows.",
              holds=np.all(np.diff(dense("modified", oscillation)) < 0) and dense("standard", oscillation)[-1] > dense("standard", oscillation)[0],
              quick=False),
    ]
    if late:
        found = [" / ".join(each(f_bar, f"{name} to the end", form, late) for f_bar in TITLES)
                 for name, form in (("oscillation", "{:.3f}"), ("steps", "{:.0f}"))]
        claims.append(Claim(f"By 1 s (dense, 0.05 m) the oscillation is {found[0]} without stabilisation / with F-bar / with modified F-bar. The runs "
                            f"have taken {found[1]} time steps: peaks of stress shorten them.",
                            holds=all(row["oscillation to the end"] < 0.06 for row in late if row["F-bar"] == "modified")))
    return claims


def table(rows):
    def value_of(like, f_bar):
        return next((row[f"oscillation to {SHOWN:g} s"] for row in rows if (row["soil"], row["h"], row["F-bar"]) == (like["soil"], like["h"], f_bar)), np.nan)
    return [("oscillation of p', slope and cell size", *TITLES.values()),
            *((f"{row['soil']}, {row['h']:g} m", *(f"{value_of(row, f_bar):.3f}" for f_bar in TITLES)) for row in rows if row["F-bar"] == "modified")]


def draw(figure, runs):
    lines = list(dict.fromkeys((run.labels["soil"], run.labels["h"]) for run in runs))
    plots = figure.subplots(len(lines), len(TITLES), sharex=True, sharey=True, squeeze=False)
    for run in runs:
        box = results.read_box(run.folder)
        plot = plots[lines.index((run.labels["soil"], run.labels["h"])), list(TITLES).index(run.labels["F-bar"])]
        drawn = plane.draw_points(plot, run.points(SHOWN), box._replace(upper=np.array([4.4, 2.1])), FIELD, (0., LARGEST))
        plot.label_outer()
        plot.text(0.97, 0.9, f"{run.labels['soil']}, {run.labels['h']:g} m", transform=plot.transAxes, ha="right", va="top", fontsize=9)
    for plot, title in zip(plots[0], TITLES.values()):
        plot.set_title(title, fontsize="medium")
    figure.colorbar(drawn, ax=plots, label=f"{fields.field_label(FIELD)}, t = {SHOWN:g} s", extend="max", aspect=40)


def slopes(cell_size, soils, end):
    return product(axis("h", "Mesh/Cell size", [cell_size]), axis("soil", lambda soil: {"Soil/Nor-Sand/Initial specific volume": VOLUMES[soil]}, soils),
                   axis("F-bar", "Stabilisation/F-bar", list(TITLES)), axis("end", "End time", [end]))


STUDY = Study(title="Stress in the dry slopes",
              question="Which stabilisation gives a smooth stress in a dry slope?",
              advice="Do not use standard F-bar. The default since these runs is the projected one.",
              base="prm/slopes/slope_dense.prm", needs_end=False,
              entries={"Output/Graphics": "points", "Output/Interval": 0.1, "Output/Statistics interval": 0.02},
              variants=slopes(0.1, ["dense"], SHOWN) + slopes(0.05, ["dense"], 1) + slopes(0.05, ["loose"], SHOWN) + slopes(0.025, ["dense"], SHOWN),
              quick=lambda labels: labels["h"] == 0.1, measure=measure, verdict=verdict, table=table,
              chart=Pictures(draw, 5.5))

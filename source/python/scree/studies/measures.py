# SPDX-License-Identifier: LGPL-2.1-or-later
"""What several studies measure in a run, and the shared definition of the states of a stability map.

A `run` is that of study.py.
"""

import math
import pathlib
import re

import numpy as np

from scree import results

# Bounds of the stability maps, the same in all of them. A column of their tables has the name of its bound; what a map takes for the
# unit of p and for "error" stands in its introduction, which cannot move a bound.
BOUNDS = {
    "gain": 0.005,  # largest fall of the numerical dissipation over the energy that the run had to release, or the map's own unit
    "smallest J": 0.1,  # V/V_0 of a soil point
    "largest J": 10.,
    "oscillation of p": 0.1,  # over the map's unit of p
    "oscillation of p'": 0.2,  # over the mean of p', or the map's own unit
    "error": 0.01,
}
DECIDING = {"J out of bounds": ("largest J",), "energy gain": ("gain",), "oscillating": ("oscillation of p", "oscillation of p'"),
            "wrong": ("error",)}  # state -> columns with an upper bound that it depends on


def classify(run, measured=None, energy=None):
    """State of a run and what it follows from, as columns: {"state", "gain", "smallest J", "largest J", **measured}.

    `measured`: what else the study measures, by names of BOUNDS. `energy`, J, replaces the released one as the unit of "gain" where next to
    none is released. Raises ValueError if the program refused the case.
    """
    if re.search(r"\.prm, line \d+: ", run.log):
        raise ValueError(run.log)
    smallest, largest = volume_ratios(run)
    columns = {"gain": energy_gain(run, energy), "smallest J": smallest, "largest J": largest, **(measured or {})}
    return {"state": state_of(columns, run.ended, run.ended and not is_finite(run)), **columns}


def state_of(columns, ended, broken=False):
    """State that follows from the columns named in BOUNDS, the first of these that holds; what a study does not measure decides nothing:

    - "blow-up": more energy came from nothing than the run had to release ("gain" > 1), or a number is not finite (`broken`)
    - "J out of bounds": before that, V/V_0 of a soil point left its bounds, in a row of statistics, in a picture, or in the message
      that the run stopped with (`volume_ratios`)
    - "blow-up", too: the program stopped for another reason, the time limit included
    - "energy gain", "oscillating" (of p or p'; a number that is not finite oscillates), "wrong" ("error"): the column is above its bound
    - "stable": none of these
    """
    if columns["gain"] > 1 or broken:
        return "blow-up"
    if columns.get("smallest J", 1.) < BOUNDS["smallest J"] or columns.get("largest J", 1.) > BOUNDS["largest J"]:
        return "J out of bounds"
    if not ended:
        return "blow-up"
    return next((state for state in ("energy gain", "oscillating", "wrong")
                 if any(name in columns and not columns[name] <= BOUNDS[name] for name in DECIDING[state])), "stable")


def share_of_defaults(rows):
    """The headline of a map: how many of the cells with the program's defaults are stable and in which states the others are, with the worst
    number of the cells that did not blow up; where all are stable, the number that is nearest to its bound."""
    defaults = rows.where(default=True)
    standing = defaults.where(lambda row: row["state"] != "blow-up")

    def worst(name):
        return max(finite(standing, name), default=-math.inf)

    def told(name):
        return f"{name} up to {worst(name):{'.0f' if worst(name) > 100 else '.2g'}}, bound {BOUNDS[name]:g}"

    others = []
    for state in ("blow-up", *DECIDING):
        beyond = "".join(f" ({told(name)})" for name in DECIDING.get(state, ()) if worst(name) > BOUNDS[name])
        others += [f"{state} in {found.n}{beyond}"] if (found := defaults.where(state=state)) else []
    if not others:
        names = [name for columns in DECIDING.values() for name in columns]
        others = ["nearest to its bound: " + told(max(names, key=lambda name: worst(name) / BOUNDS[name]))]
    listed = ", ".join(others)
    return f"{stable_of(defaults)} default cells are stable. {listed[0].upper()}{listed[1:]}."


def finite(rows, name):
    return [row[name] for row in rows if math.isfinite(row.get(name, math.nan))]


def stable_of(rows):
    return f"{rows.where(state='stable').n} of {rows.n}"


def map_table(rows):
    """How many cells are in each state and the worst number of each bound, for the cells with the defaults and for the
    others."""
    groups = {"defaults": rows.where(default=True), "other options": rows.where(default=False)}
    groups = {name: chosen for name, chosen in groups.items() if chosen}

    def worst(chosen, name):
        values = finite(chosen, name)
        return f"{(min if name == 'smallest J' else max)(values):.2g}" if values else "-"
    return [("quantity, worst of all cells", *groups, "bound"), ("stable cells", *map(stable_of, groups.values()), "all"),
            *((name, *(worst(chosen, name) for chosen in groups.values()), f"{BOUNDS[name]:g}")
              for name in BOUNDS if name in rows[0])]


def has_rows(run):
    """Whether the run came to its first row of statistics."""
    return any(len(values) for values in run.columns.values())


def is_finite(run):
    """Whether all that the file statistics holds is finite; False without a row."""
    columns = run.columns.values()
    return has_rows(run) and all(np.all(np.isfinite(values)) for values in columns)


def released_energy(run):
    """Energy that a run had to turn into motion or loss, J: largest fall of the potential energy, kinetic and elastic energy at the start,
    largest work of the load."""
    if not has_rows(run):
        return 0.
    potential, kinetic, elastic = (run.statistics(f"{kind} energy (J)") for kind in ("Potential", "Kinetic", "Elastic"))
    load = run.columns.get("Load work (J)", 0.)  # only scenes with a load have it
    return float(potential[0] - np.nanmin(potential) + kinetic[0] + elastic[0] + np.nanmax(np.abs(load)))


def energy_gain(run, energy=None):
    """Largest fall of the numerical dissipation from a row to a later one over `energy`, J, by default the released one."""
    scale = released_energy(run) if energy is None else energy
    if not has_rows(run) or scale <= 0:
        return 0.
    dissipation = run.statistics("Numerical dissipation (J)")
    fall = np.max(np.maximum.accumulate(dissipation) - dissipation)
    return float(fall / scale) if np.isfinite(fall) else np.inf


def mean_depth(places, volumes, low, high):
    """Of a plane deposit from `low` to `high` (numbers or arrays), averaged, m; of points at these places, as if their volume were at the point."""
    order = np.argsort(places)
    places, below = places[order], np.cumsum(volumes.ravel()[order])
    return (np.interp(high, places, below) - np.interp(low, places, below, left=0.)) / (high - low)


def lost_energy(run):
    """Numerical dissipation over the fall of the potential energy, both from start to end."""
    potential = run.statistics("Potential energy (J)")
    return run.statistics("Numerical dissipation (J)")[-1] / (potential[0] - potential[-1])


def mean_oscillation(run, column="p oscillation (-)"):
    """Time mean of an oscillation of the statistics over its rows after the first; 0 without such rows."""
    values = run.statistics(column) if has_rows(run) else []
    return float(np.mean(values[1:])) if len(values) > 1 else 0.


def volume_ratios(run):
    """Smallest and largest J = V/V_0 of a soil point in all rows and pictures, and in the error message; (1, 1) without any.

    Rows of scenes with water tell the largest porosity n = 1 - (1 - n_0)/J; above 1 it is that of a negative volume. Pictures
    tell volume over mass, of which that of a body's points at the start is the unit.
    """
    ratios = [1., *(float(ratio) for ratio in re.findall(r"det dF .*, J ([-+.\deinfa]+[\dfn])", run.log))]
    porosity = run.columns.get("Largest porosity (-)", [])
    if len(porosity):
        with np.errstate(divide="ignore"):
            ratios.extend((1 - porosity[0]) / (1 - porosity))
    if (pathlib.Path(run.folder) / "solution" / "points.pvd").exists():
        units = {}
        for time in results.read_times(run.folder):
            points = results.read_points(run.folder, time)
            for body in np.unique(points.arrays.get("body", [])):
                chosen = points.arrays["body"] == body
                specific = points.arrays["volume"][chosen] / points.arrays["mass"][chosen]
                ratios.extend(specific / units.setdefault(body, np.median(specific)))
    return float(np.min(ratios)), float(np.max(ratios))


def roughness(points, cell_size, field):
    """Rms of a field of `points` (of a picture) about the planes fitted to the points of each cell and the eight around it, in the field's unit.

    What `p oscillation` tells in parts of the mean of p, which means little where p is near 0.
    """
    cells = np.floor(points.positions[:, :2] / cell_size).astype(int)
    values, squares = points.arrays[field], 0.
    for cell in np.unique(cells, axis=0):
        near = np.max(np.abs(cells - cell), axis=1) <= 1
        own = np.all(cells == cell, axis=1)
        plane = [np.column_stack([np.ones(np.sum(chosen)), points.positions[chosen, :2]]) for chosen in (near, own)]
        squares += np.sum((values[own] - plane[1] @ np.linalg.lstsq(plane[0], values[near], rcond=None)[0]) ** 2)
    return float(np.sqrt(squares / len(values)))


def pressure_scatter(run):
    """Time mean of the roughness of p over the mean p at the start, from the pictures of a run in 2D."""
    cell_size = float(run.entries["Mesh/Cell size"])
    pictures = [run.points(time, "water") for time in results.read_times(run.folder, "water")]
    if len(pictures) < 2:
        return 0.
    return float(np.mean([roughness(points, cell_size, "pressure") for points in pictures[1:]]) / np.mean(pictures[0].arrays["pressure"]))

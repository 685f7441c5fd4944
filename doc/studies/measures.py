# SPDX-License-Identifier: LGPL-2.1-or-later
"""What several studies measure in a run, and the shared definition of the states of a stability map.

A `run` is that of study.py.
"""

import math
import pathlib
import re

import numpy as np

import closed_forms
import render

# Part of an error message of scree -> cause, in short.
CAUSES = {
    "the stable step has fallen": "step fell",
    "a point moves at": "speed",
    "is not a number": "strain not a number",
    "cannot follow its deformation": "deformation of a step",
    "left the box": "left the box",
    "did not converge": "pressure solver",
    "nothing sets the level": "no level of p",
}


def classify(run, oscillation=0.1, column="p oscillation (-)", scatter=None, gain=0.005, energy=None, volume_ratio=(0.1, 10.), error=0.,
             tolerance=math.inf):
    """State of a run, the first of these that holds:

    - "blow-up": more energy came from nothing than the run had to release (`energy_gain` > 1), or a number is not finite
    - "J out of bounds": before that, V/V_0 of a soil point left `volume_ratio`, in a row of statistics, in a picture, or in the
      message that the run stopped with (`volume_ratios`)
    - "blow-up", too: the program stopped for another reason, the time limit included (`cause` tells which)
    - "energy gain": the numerical dissipation fell by more than `gain` of the energy that the run had to release
    - "oscillating": the time mean of `column` of the statistics, without the state at the start, or the study's own `scatter` in its
      place, is above `oscillation`
    - "wrong": quiet, but the study's own `error` is above `tolerance`
    - "stable": none of these

    `gain` is that of the scene tests. `oscillation` depends on the scene: p' of points without stabilisation scatters by .7 of its
    mean in a collapse, p of a saturated slope by .02. `energy`, J, replaces the released one where there is next to none (rest).
    Raises ValueError if the program refused the case.
    """
    if re.search(r"\.prm, line \d+: ", run.log):
        raise ValueError(run.log)
    gained = energy_gain(run, energy)
    if gained > 1 or (run.ended and not is_finite(run)):
        return "blow-up"
    smallest, largest = volume_ratios(run)
    if not volume_ratio[0] <= smallest <= largest <= volume_ratio[1]:
        return "J out of bounds"
    if not run.ended:
        return "blow-up"
    if gained > gain:
        return "energy gain"
    if (mean_oscillation(run, column) if scatter is None else scatter) > oscillation:
        return "oscillating"
    return "stable" if error <= tolerance else "wrong"


def cause(run):
    """Why a run stopped, in short; "-" for one that ended."""
    if run.ended:
        return "-"
    if run.exit_code == 124:
        return "time limit"
    return next((short for message, short in CAUSES.items() if message in run.log), f"exit code {run.exit_code}")


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
        for time in render.read_times(run.folder):
            points = render.read_points(run.folder, time)
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


def hydrostatic_error(run, surface):
    """Rms over the water's points of the last picture of p - rho_w g depth below `surface`, m, over rho_w g times the cell size."""
    water = run.points(None, "water")
    exact = closed_forms.hydrostatic_pressure(water.positions[:, 1], surface)
    cell = float(run.entries["Mesh/Cell size"])
    return float(np.sqrt(np.mean((water.arrays["pressure"] - exact)**2)) / (1000 * closed_forms.GRAVITY * cell))


def pressure_scatter(run):
    """Time mean of the roughness of p over the mean p at the start, from the pictures of a run in 2D."""
    cell_size = float(run.entries["Mesh/Cell size"])
    pictures = [run.points(time, "water") for time in render.read_times(run.folder, "water")]
    if len(pictures) < 2:
        return 0.
    return float(np.mean([roughness(points, cell_size, "pressure") for points in pictures[1:]]) / np.mean(pictures[0].arrays["pressure"]))

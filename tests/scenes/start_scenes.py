# SPDX-License-Identifier: LGPL-2.1-or-later
"""start_scenes.py SCREE SCENE: states at the start, as scenes.py: drained settling, water tables, unit weights.

Bounds are fractions of closed forms (1 % in level layers, 5 % under slopes), fixed before the first run.
"""

import math
import re

import numpy as np

from scree.results import read_points

from scene_tools import WATER, check, log_of, main, run

# A level layer, 8 m deep, in a box 2 m wide.
LAYER = {"Mesh/Upper corner": "2, 10", "Mesh/Cell size": "0.25", "Soil/Region": "y < 8", "Soil/Dry unit weight": "16e3",
         "Soil/Saturated unit weight": "20e3", "Output/Graphics": "points", "Output/Interval": "0.1", "End time": "0.1"}


def settled(name):
    """Ratio of unbalanced force to weight at the release, from a run's log."""
    return float(re.search(r"Settled for .* in \d+ steps; unbalanced force over weight (\S+?)[.,] ?Released", log_of(name)).group(1))


def check_layer(label, name, table, cell, bound=0.01):
    """Effective vertical stress (means of cells) and pore pressure of the layer with its table, at the start and after 0.1 s.

    The weight above a point is that of the rows of points above it, whatever they have settled.
    """
    dry, wet, depth, width = 16e3, 20e3, 8., 2.
    spacing = cell / 3  # of the points
    n_row = round(width / spacing)
    for time in (0, 0.1):
        soil, water = read_points(name, time), read_points(name, time, "water")
        from_top = np.argsort(-soil.positions[:, 1])
        stress = -soil.arrays["stress"][from_top, 4].reshape(-1, 3 * n_row).mean(axis=1)  # of each row of cells
        y = depth - cell * (np.arange(len(stress)) + 0.5)
        exact = dry * (depth - np.maximum(y, table)) + (wet - WATER) * np.maximum(0., table - y)
        below = y < depth - 1
        check("%s, t = %g s: largest error of the effective stress over that of the place" % (label, time),
              np.max(np.abs(stress / exact - 1)[below]), 0, bound, 0.01 if bound > 0.01 else None)
        error = water.arrays["pressure"] - WATER * (table - water.positions[:, 1])
        check("%s, t = %g s: largest error of p over rho g H" % (label, time), np.max(np.abs(error)) / (WATER * table), 0, bound)


def drained_layer(scree):
    """A saturated layer settles drained, from no stress and from K0: effective stress and pressure within 1 % of the closed form (1.07 % from
    no stress)."""
    for start in ("none", "K0"):
        run(scree, "slopes/phreatic", "layer", {**LAYER, "Water/Phreatic surface": "8", "Soil/Initial state/Type": start,
                                                "Settling/Maximum time": "20"})
        check("saturated layer from %s: unbalanced force over weight" % start, settled("layer"), 0, 1e-3)
        check_layer("saturated layer from " + start, "layer", 8., 0.25, 0.011 if start == "none" else 0.01)


def water_table(scree):
    """A water table inside a layer, on a face of the cells and within a cell: the stress on both sides within 1 %."""
    for table in (4., 4.1):
        run(scree, "slopes/phreatic", "table", {**LAYER, "Water/Phreatic surface": "%g" % table, "Settling/Maximum time": "20"})
        check("water table at %g m: unbalanced force over weight" % table, settled("table"), 0, 1e-3)
        check_layer("water table at %g m" % table, "table", table, 0.25)


def drained_slope(scree):
    """A slope with a water table comes to rest, and its pore pressure after the release is the held one within 5 %."""
    run(scree, "slopes/phreatic", "slope", {"Mesh/Cell size": "1", "End time": "0.1", "Output/Graphics": "points"})
    check("slope with a water table: unbalanced force over weight", settled("slope"), 0, 1e-3)
    before, after = (read_points("slope", time, "water") for time in (0, 0.1))
    # Within 0.1 s the water seeps by millimetres: the nearest point is the same one.
    nearest = [np.argmin(np.sum((before.positions - place)**2, axis=1)) for place in after.positions]
    change = after.arrays["pressure"] - before.arrays["pressure"][nearest]
    check("slope with a water table: largest change of p within 0.1 s over rho g H", np.max(np.abs(change)) / (10 * WATER), 0, 0.05)


def reservoir(scree):
    """A reservoir before a slope with the table at its level: hydrostatic, also at the waterline and after the release, within 1 %."""
    run(scree, "slopes/phreatic", "reservoir", {
        "Mesh/Cell size": "1", "End time": "0.1", "Output/Graphics": "points", "Water/Phreatic surface": "8", "Water/Reservoir level": "8"})
    check("reservoir: unbalanced force over weight", settled("reservoir"), 0, 1e-3)
    for time in (0, 0.1):
        water = read_points("reservoir", time, "water")
        error = water.arrays["pressure"] - WATER * (8 - water.positions[:, 1])
        check("reservoir, t = %g s: largest error of p over rho g H" % time, np.max(np.abs(error)) / (8 * WATER), 0, 0.01)


def dry_slope_at_rest(scree):
    """A dry Mohr-Coulomb slope of 2:1 with 32 degrees settles and stays at rest: largest speed within 0.5 s below 5 mm/s."""
    table = run(scree, "slopes/first_slope", "dry", {
        "Mesh/Cell size": "1", "Mesh/Upper corner": "50, 16", "Soil/Region": "y < if(x < 10, 4, if(x < 30, 4 + (x - 10)/2, 14))",
        "Soil/Mohr-Coulomb/Friction angle": "32", "Soil/Mohr-Coulomb/Cohesion": "0", "Soil/Mohr-Coulomb/Tension cut-off": "0",
        "Soil/Initial state/K0": "auto",
        "Boundaries/Bottom": "fixed", "Settling/Maximum time": "10", "End time": "0.5"})
    check("dry slope: unbalanced force over weight", settled("dry"), 0, 1e-3)
    speed = math.sqrt(2 * max(table["Kinetic energy (J)"]) / table["Mass (kg)"][0])
    check("dry slope: largest root mean square speed, m/s", speed, 0, 5e-3)


if __name__ == "__main__":
    main(globals())

# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the scenes share: running variants of the cases in prm/, reading their statistics, checking bounds."""

import math
import os
import subprocess
import sys

import numpy as np

from scree.closed_forms import GRAVITY
from scree.results import read_checks, read_points, read_statistics
from scree.variants import write_variant

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
WATER = 1000 * GRAVITY  # unit weight of water, N/m^3
NO_STRESS = {"Soil/Initial state/Type": "none", "Soil/Initial state/K0": "auto"}
failures = []


def run(scree, case, name, entries, may_stop=False):
    """Statistics of a variant of prm/`case`.prm, as {column: values}."""
    target = name + ".prm"
    write_variant(os.path.join(ROOT, "prm", case + ".prm"), target,
                  {"Output directory": name, "Output/Graphics": "none", "Output/Screen": "nothing",
                   "Output/Statistics interval": "0.02", "Output/Checkpoint interval": "0", **entries})
    result = subprocess.run([scree, target], capture_output=True, text=True)
    if result.returncode != 0 and not may_stop:
        sys.exit(name + " stopped: " + result.stderr)
    table = read_statistics(name)
    if not may_stop:
        check_books(name, table, entries)
    return table


def log_of(run_folder):
    with open(os.path.join(run_folder, "log.txt"), encoding="utf-8") as file:
        return file.read()


def check_of(run_folder, name):
    """What a run has found in a check of itself."""
    return next(found for found in read_checks(run_folder) if found.name == name)


def largest_gain(run_folder):
    """The largest energy gain of all steps over the released energy, as the log names it."""
    return float(check_of(run_folder, "largest energy gain").value.split()[0]) / 100


def pictures(entries=None):
    """Entries of a run whose points are looked at."""
    return {"Output/Graphics": "points", **(entries or {})}


def nudged_gravity(nudge):
    """Gravity of a plane scene, changed by `nudge` times 1e-6 of it: water that breaks does so in another way then."""
    return "0, -9.8100%d" % nudge


def gravity_entry(vector):
    return ", ".join("%.15g" % component for component in vector)


def at(table, column, time):
    """The value of the row nearest to `time`."""
    return table[column][np.argmin(np.abs(table["Time (s)"] - time))]


def slope_of(table, values, start):
    """Least-squares slope over time from `start` s on."""
    chosen = table["Time (s)"] >= start - 1e-9
    return np.polyfit(table["Time (s)"][chosen], values[chosen], 1)[0]


def turns(table):
    """The rows before the momentum along x changes its sign, without the first five, and the times at which it is 0, s."""
    time, momentum = table["Time (s)"], table["Momentum x (N s)"]
    rows = 5 + np.flatnonzero(momentum[5:-1] * momentum[6:] < 0)
    return rows, time[rows] - momentum[rows] * np.diff(time)[rows] / np.diff(momentum)[rows]


def mean_load(table):
    """Force on the platen between shortenings of 0.95 and 1.05 %, over the width of 1 m, kPa."""
    shortening = -table["Obstacle Platen displacement y (m)"] / 2
    time, impulse = table["Time (s)"], table["Obstacle Platen impulse y (N s)"]
    first, last = (np.interp(part, shortening, time) for part in (0.0095, 0.0105))
    return (np.interp(last, time, impulse) - np.interp(first, time, impulse)) / (last - first) / 1e3


def mean_oscillation(table):
    """Time mean of the stress oscillation, without the state at rest before the release."""
    return np.mean(table["Stress oscillation (-)"][1:])


def largest_fall(values):
    """By how much a column falls below what it was in a row before."""
    return np.max(np.maximum.accumulate(values) - values)


def released(table):
    """What gravity released, J."""
    return table["Potential energy (J)"][0] - min(table["Potential energy (J)"])


def fraction_within(coordinate, mass, part):
    """The coordinate below which this part of the mass lies."""
    order = np.argsort(coordinate)
    return coordinate[order][np.searchsorted(np.cumsum(mass[order]), part * mass.sum())]


def ways(run_folder):
    """How far each soil point has come between the first and the last picture, m."""
    first, last = (read_points(run_folder, time) for time in (0., None))
    order = [np.argsort(points.arrays["id"]) for points in (first, last)]
    return np.linalg.norm(last.positions[order[1]] - first.positions[order[0]], axis=1)


def rms(values):
    return math.sqrt(np.mean(np.square(values)))


def check(what, value, lowest, highest, asked=None):
    """Whether a value is within bounds; `asked` is the distance from the exact value that was asked for, where it is missed."""
    good = lowest <= value <= highest
    missed = "" if asked is None else " (%g was asked)" % asked
    print("%-62s %12.5g  in [%g, %g]%s%s" % (what, value, lowest, highest, missed, "" if good else "  <-- FAILED"))
    if not good:
        failures.append(what)


def check_gain(name, table, most=1e-3, over=None, asked=None):
    """No energy from nothing: the largest gain over the change of the potential energy, or over `over`, J, that which was released or entered."""
    scale = np.ptp(table["Potential energy (J)"]) if over is None else over
    check(name + ": largest gain of energy over released energy", largest_fall(table["Numerical dissipation (J)"]) / scale, 0, most, asked)


def check_books(name, table, entries):
    """Of every run: the mass of soil and of water is that of the start and what has entered, less what was lost; momentum is that
    of all impulses, where weight is the largest force; each return of the laws is resolved. The mass of single-point water follows the pores."""
    single = entries.get("Water/Point sets") == "single"
    total = 0
    of_water = 0.5 if single else 1e-12  # the former is ours
    for column, word, bound in (("Mass (kg)", "Mass", 1e-12), ("Water mass (kg)", "Water", of_water)):
        if column in table and np.any(table[column]):
            lost, entered = (sum(table.get(f"{word} {way} (kg)", 0) for way in ways) for ways in (("lost", "removed"), ("entered", "added")))
            total += np.max(table[column] + lost)
            book = np.abs(table[column] - table[column][0] + lost - entered)
            check(f"{name}: {column} beside its book, relative", np.max(book) / (np.max(entered) or table[column][0]), 0, bound)
    if not single and "Surface load/Traction" in entries:  # larger than weights
        check(name + ": momentum balance", float(check_of(name, "momentum balance").value.split(",")[0]), 0, 1e-8)
    elif not single:
        residual = np.max(table["Momentum residual (N s)"])
        check(name + ": momentum residual over weight times time", residual / (total * GRAVITY * table["Time (s)"][-1]), 0, 1e-11)
    check(name + ": unresolved returns", table.get("Unresolved", [0])[-1], 0, 0)


def check_fall(name, table, most=0.005, asked=None):
    """No energy from nothing, in a scene whose soil and water move at the start."""
    check_gain(name, table, most, released(table) + table["Kinetic energy (J)"][0], asked)


def check_balances(name, table, gain=0.005):
    """No energy from nothing, to `gain` of what gravity released; no point lost."""
    check_gain(name, table, gain, released(table))
    check(name + ": points lost", table["Points lost"][-1], 0, 0)


def main(scenes):
    """Runs the scene that the command line names, out of a module's globals()."""
    scenes[sys.argv[2]](os.path.abspath(sys.argv[1]))
    sys.exit("failed: " + ", ".join(failures) if failures else 0)

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Stages of one case: level ground, 4 m high, from which soil is dug and on which a fill is laid (case_tools.py)."""

import re
import shutil
import subprocess
import sys

from case_tools import SCREE, check, log_of, rows_of, run
from scree.variants import set_entries

GRAVITY, DENSITY = 9.81, 1600
CASE = set_entries("", {
    "End time": 0.1, "Output directory": "results", "Bodies": "Soil, Fill", "Mesh/Upper corner": "6, 6", "Mesh/Cell size": 0.5,
    "Soil/Region": "y < 4", "Soil/Points per cell": 2, "Soil/Dry unit weight": DENSITY * GRAVITY, "Soil/Initial porosity": 0.4, "Soil/Material": "Mohr-Coulomb",
    "Soil/Mohr-Coulomb/Cohesion": 1e4, "Soil/Mohr-Coulomb/Tension cut-off": 1e4, "Soil/Mohr-Coulomb/Friction angle": 30, "Soil/Initial state/Type": "K0",
    "Fill/Region": "y > 4 && y < 5 && x > 3", "Fill/Points per cell": 2, "Fill/Dry unit weight": DENSITY * GRAVITY, "Fill/Initial porosity": 0.4, "Fill/Material": "Mohr-Coulomb",
    "Fill/Mohr-Coulomb/Cohesion": 1e4, "Fill/Mohr-Coulomb/Tension cut-off": 1e4, "Fill/Mohr-Coulomb/Friction angle": 30,
    "Boundaries/Bottom": "fixed", "Settling/Maximum time": 10, "Output/Statistics interval": 0.05, "Output/Graphics": "none",
    "Stage Dig/Remove": "x < 2 && y > 3", "Stage Lay/Add": "Fill", "Stage Lay/Duration": 0.2})
DUG, LAID = 2 * DENSITY, 3 * DENSITY  # kg/m


def last(folder):
    return {name: float(value) for name, value in rows_of(folder / "statistics.csv")[-1].items()}


def books():
    """What is dug and laid is booked, the ground carries it, and no check fails."""
    folder = run("books", CASE)
    rows = rows_of(folder / "statistics.csv")
    first, end, text = {k: float(v) for k, v in rows[0].items()}, last(folder), " ".join(log_of(folder).split())
    check(abs(end["Mass removed (kg)"] / DUG - 1) < 1e-12 and abs(end["Mass added (kg)"] / LAID - 1) < 1e-12, f"{end['Mass removed (kg)']}, {end['Mass added (kg)']} kg")
    check(abs(end["Mass (kg)"] - (first["Mass (kg)"] - DUG + LAID)) < 1e-9 * end["Mass (kg)"], "the mass is not that of the stages")
    check(abs(end["Time (s)"] - 0.3) < 1e-12 and text.count("Settled for") == 3, "times of the stages")
    check("Stage Dig, from t = 0.1 to 0.1 s Removed soil 3200 kg/m" in text and "Stage Lay, from t = 0.1 to 0.3 s Added soil 4800 kg/m" in text, text[-3000:])
    check("fault:" not in text, "a check fails")
    again = last(run("again", (folder / "parameters.prm").read_text(encoding="utf-8")))
    check(abs(again["Mass (kg)"] - end["Mass (kg)"]) < 1e-9 * end["Mass (kg)"], "parameters.prm is another case")
    moving = rows_of(run("moving", set_entries(CASE, {"Stage Dig/Settling/Maximum time": 0, "Stage Dig/Duration": 0.2, "Stage Dig/Remove": "x < 2 && y > 2"})) / "statistics.csv")
    begun = [row for row in moving if abs(float(row["Time (s)"]) - 0.1) < 1e-12]
    check(len(begun) == 2 and float(begun[1]["Mass removed (kg)"]) > 0, "a stage has no row of its start")
    energy = [float(row["Numerical dissipation (J)"]) for row in moving if 0.1 < float(row["Time (s)"]) < 0.3]
    check(min(energy) > -1e-3 * max(float(row["Kinetic energy (J)"]) for row in moving), f"a stage that begins without settling gains energy: {energy} J")


def goes_on():
    """A run that was stopped within a stage goes on to the same end; one that was stopped at its start begins it again."""
    whole = last(run("whole", set_entries(CASE, {"Output/Checkpoint interval": 0.05})))
    folder = run("part", set_entries(CASE, {"Output/Checkpoint interval": 0.05}))
    checkpoints = sorted((folder / "checkpoint").iterdir(), key=lambda path: int(path.name.split("-")[1]))
    check(len(checkpoints) > 1, f"{len(checkpoints)} checkpoints")
    shutil.rmtree(checkpoints[-1])
    end = last(run("part", CASE, "--resume"))
    text = log_of(folder)
    check("Resumed at t = " in text, "the run does not go on")
    for name, value in whole.items():
        check(abs(end[name] - value) <= 1e-9 * max(1., abs(value)), f"{name}: {end[name]}, not {value}")


def search():
    """A search of the factor after a stage lists the pictures of its trials, and no others."""
    folder = run("search", set_entries(CASE, {"Output/Graphics": "points", "Safety/Tolerance": 0.2}), "--safety")
    for trial in ("rests", "fails"):
        solution = folder / "safety" / trial / "solution"
        listed = re.findall(r'file="([^"]+)"', (solution / "points.pvd").read_text(encoding="utf-8"))
        check(listed and all((solution / name).exists() for name in listed), f"{trial}: {listed}")


def refusals():
    """Names entry, value and remedy before anything runs."""
    for entries, words in (({"Stage Lay/Add": "Fil"}, 'entry "Bodies" lists Soil, Fill'),
                           ({"Stage Lay/Fill": "y"}, "there is no such entry"),
                           ({"Stage Dig/Add": "Fill"}, "adds this body already"),
                           ({"Fill/Initial state/Type": "K0"}, "adds this body"),
                           ({"Stage Dig/Mesh/Cell size": 0.25}, "a stage cannot change that"),
                           ({"Stage Dig/Soil/Mohr-Coulomb/Young's modulus": 3e6}, "a stage cannot change that"),
                           ({"Soil/Mohr-Coulomb/Friction angle": "30 + depth", "Soil/Initial state/K0": 1, "Stage Dig/Soil/Mohr-Coulomb/Cohesion": 2e4}, "a stage cannot change that"),
                           ({"Fill/Region": "y > 2 && y < 5"}, "is full of other soil"),
                           ({"Stage Dig/Remove": "y > 0"}, "no soil is left"),
                           ({"Stage Dig/Remove": "y > 9"}, "no point is there"),
                           ({"Stage Dig/Remove": "y >"}, 'subsection Stage Dig, entry "Remove"'),
                           ({"Soil/Material": "Herschel-Bulkley", "Soil/Herschel-Bulkley/Yield stress": 1e5, "Stage Dig/Soil/Herschel-Bulkley/Yield stress": 2e5},
                            "a stage cannot change that"),
                           ({"Stage/Remove": "y > 9"}, "A stage has a name"),
                           ("subsection Stage A/B\nend\n", "divides names"),
                           ("subsection Stage Dig\nend\n", "stands in this file before")):
        with open("case.prm", "w", encoding="utf-8") as file:
            file.write(f"{CASE}\n{entries}" if isinstance(entries, str) else set_entries(CASE, entries))
        done = subprocess.run([SCREE, "case.prm"], capture_output=True, text=True, check=False)
        check(done.returncode == 1 and words in " ".join(done.stderr.split()), f"{entries}: {done.stderr}")


{"books": books, "goes_on": goes_on, "refusals": refusals, "search": search}[sys.argv[3]]()

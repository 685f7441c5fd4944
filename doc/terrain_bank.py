#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs slides on mountains of doc/mountain.py and tells the worst numbers of each, as a table.

/usr/bin/python3 doc/terrain_bank.py build/scree results/bank --seeds 1-8 --cell 10 --cell 20 --method FLIP --method TPIC

The columns: fastest point over the 99.9 % quantile of the speeds, depth of a point below the bed over the cell size, points lost, mass over that
of the map less one, largest fall of the numerical dissipation over the released energy, largest p' over rho g H, smallest V/V_0. What misses its
bound has a star.
"""

import argparse
import itertools
import pathlib
import re
import subprocess
import sys

import numpy as np

from variants import write_variant

MOUNTAIN = pathlib.Path(__file__).resolve().parent / "mountain.py"
BULK_DENSITY = 2650 * (1 - 0.4)  # of the case, kg/m^3
BOUNDS = {"speed": 1.5, "depth": 0.1, "lost": 0, "mass": 5e-3, "energy": 1e-4}


def columns_of(file):
    """The statistics of a run, {column: values}."""
    names, rows = [], []
    for line in open(file, encoding="utf-8"):
        if line.startswith("#"):
            names.append(line.split(":", 1)[1].strip())
        elif line.strip():
            rows.append([float(word) for word in line.split()])
    return {name: np.array(values) for name, values in zip(names, zip(*rows))}


def map_volume(file):
    """The volume of an ESRI ASCII grid of thickness, m^3."""
    lines = pathlib.Path(file).read_text(encoding="utf-8").split("\n")
    spacing = float(next(line.split()[1] for line in lines if line.startswith("cellsize")))
    return np.loadtxt(lines[6:]).clip(0).sum() * spacing ** 2


def numbers_of(folder, run, cell):
    """What the bounds are about, from log and statistics of a run."""
    log = (folder / run / "log.txt").read_text(encoding="utf-8")
    found = re.search(r"Checks +fastest point (\S+) times.*?smallest V/V_0 ([^;]+);.*?largest p' (\S+) of.*?deepest point (\S+) m", log)
    table = columns_of(folder / run / "statistics")
    potential, dissipation = table["Potential energy (J)"], table["Numerical dissipation (J)"]
    return {"speed": float(found[1]), "depth": float(found[4]) / cell, "lost": table["Points lost"][-1],
            "mass": abs(table["Mass (kg)"][0] / (BULK_DENSITY * map_volume(folder / "release.asc")) - 1),
            "energy": np.max(np.maximum.accumulate(dissipation) - dissipation) / (potential[0] - potential.min()),
            "p'": float(found[3]), "V/V_0": float(found[2])}


def run_case(scree, folder, seed, mountain=(), cell=10., entries=None, n_ranks=1):
    """Makes a mountain and runs its case; returns the worst numbers."""
    folder = pathlib.Path(folder)
    subprocess.run([sys.executable, MOUNTAIN, str(seed), folder, "--cell", f"{cell:g}", *mountain], check=True)
    write_variant(str(folder / "case.prm"), str(folder / "run.prm"), {"Output directory": "run", "Output/Graphics": "none", "Output/Screen": "nothing",
                                                                       "Output/Checkpoint interval": "0", **(entries or {})})
    ranks = ["mpirun", "-n", str(n_ranks)] if n_ranks > 1 else []
    done = subprocess.run([*ranks, scree, "run.prm"], cwd=folder, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"{folder}: {done.stderr}")
    return numbers_of(folder, "run", cell)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("scree", type=pathlib.Path)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--seeds", default="1-8", help="such as 1-8")
    parser.add_argument("--size", default="large")
    parser.add_argument("--cell", type=float, action="append")
    parser.add_argument("--method", action="append", help="FLIP, TPIC, ...")
    parser.add_argument("--end", type=float, default=60., help="s")
    parser.add_argument("--ranks", type=int, default=1)
    arguments = parser.parse_args()
    first, last = (int(word) for word in arguments.seeds.split("-"))
    variants = {"thin, rough": [], "cut-off rim": ["--rim", "cut"], "smooth": ["--relief", "smooth"], "gully": ["--feature", "gully"],
                "cliff": ["--feature", "cliff"]}
    print("| seed | mountain | cell, m | method | " + " | ".join([*BOUNDS, "p'", "V/V_0"]) + " |\n" + "|---" * (6 + len(BOUNDS)) + "|")
    for seed, (name, options), cell, method in itertools.product(range(first, last + 1), variants.items(), arguments.cell or [10.], arguments.method or ["FLIP"]):
        numbers = run_case(arguments.scree.resolve(), arguments.folder / f"{seed}_{name.replace(', ', '_').replace(' ', '_')}_{cell:g}_{method}", seed,
                           ["--size", arguments.size, *options], cell, {"End time": f"{arguments.end:g}", "Transfer/Method": method}, arguments.ranks)
        print(f"| {seed} | {name} | {cell:g} | {method} | " +
              " | ".join(f"{value:.3g}" + (" *" if value > BOUNDS.get(key, np.inf) else "") for key, value in numbers.items()) + " |", flush=True)


if __name__ == "__main__":
    main()

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs slides on mountains of scree-mountain and tells the worst numbers of each, as a table.

scree-terrain-bank results/bank --seeds 1-8 --cell 10 --cell 20 --method FLIP --method TPIC

The columns: fastest point over the largest 99.9 % quantile of the speeds, depth of a point below the bed over the cell size, points lost, mass over that
of the map less one, largest energy gain of any channel over the released energy, largest stress over rho g H, smallest V/V_0. What misses its
bound has a star.
"""

import itertools
import pathlib
import re
import subprocess

import numpy as np

from scree import command, results
from scree.mountain import SIZES, make_case
from scree.variants import write_variant

BULK_DENSITY = 2650 * (1 - 0.4)  # of the case, kg/m^3
BOUNDS = {"speed": 1.5, "depth": 0.1, "lost": 0, "mass": 5e-3, "energy": 1e-4}

MOUNTAINS = {"thin, rough": {}, "cut-off rim": {"rim": "cut"}, "smooth": {"relief": "smooth"}, "gully": {"feature": "gully"}, "cliff": {"feature": "cliff"},
             "hole": {"missing": "hole"}, "island": {"missing": "island"}, "missing edge": {"missing": "edge"}}


def numbers_of(folder, run, cell, is_of_map):
    """What the bounds are about, from log and statistics of a run."""
    wanted = ("fastest point", "deepest point", "largest energy gain", "largest stress", "smallest V/V_0")
    found = {check.name: float(check.value.split()[0]) for check in results.read_checks(folder / run) if check.name.startswith(wanted)}
    table, release = results.read_statistics(folder / run), results.read_raster(folder / "release.asc")
    return {"speed": found["fastest point"], "depth": found["deepest point"] / cell, "lost": table["Points lost"][-1],
            "mass": abs(table["Mass (kg)"][0] / (BULK_DENSITY * release.values.clip(0).sum() * release.width**2) - 1) if is_of_map else np.nan,
            "energy": max(gain for name, gain in found.items() if name.startswith("largest energy gain")) / 100,
            "stress": found["largest stress"], "V/V_0": found["smallest V/V_0"]}


def run_case(scree, folder, seed, mountain=None, cell=10., entries=None, n_ranks=1):
    """Makes a mountain (`mountain`: arguments of make_case) and runs its case; returns the worst numbers."""
    folder = pathlib.Path(folder)
    make_case(folder, seed, cell=cell, **(mountain or {}))
    write_variant(str(folder / "case.prm"), str(folder / "run.prm"), {"Output directory": "run", "Output/Graphics": "none", "Output/Screen": "nothing",
                                                                       "Output/Checkpoint interval": "0", **(entries or {})})
    ranks = ["mpirun", "-n", str(n_ranks)] if n_ranks > 1 else []
    done = subprocess.run([*ranks, scree, "run.prm"], cwd=folder, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise ValueError(f"{folder}: {done.stderr.strip()}")
    return numbers_of(folder, "run", cell, not (mountain or {}).get("is_saturated"))


def write_table(arguments):
    """Runs the slides that the command line asks for, and prints a row each."""
    scree = arguments.program or command.needed("scree")
    if not re.fullmatch(r"\d+-\d+", arguments.seeds):
        raise ValueError(f"--seeds {arguments.seeds}: write the first and the last, such as 1-8")
    first, last = map(int, arguments.seeds.split("-"))
    print("| seed | mountain | cell, m | method | " + " | ".join([*BOUNDS, "stress", "V/V_0"]) + " |\n" + "|---" * (6 + len(BOUNDS)) + "|")
    for seed, name, cell, method in itertools.product(range(first, last + 1), arguments.mountain or MOUNTAINS, arguments.cell or [10.], arguments.method or ["FLIP"]):
        numbers = run_case(pathlib.Path(scree).resolve(), arguments.folder / f"{seed}_{name.replace(', ', '_').replace(' ', '_')}_{cell:g}_{method}", seed,
                           {"size": arguments.size, "is_saturated": arguments.saturated, **MOUNTAINS[name]}, cell, {"End time": f"{arguments.end:g}", "Transfer/Method": method}, arguments.ranks)
        print(f"| {seed} | {name} | {cell:g} | {method} | " +
              " | ".join(f"{value:.3g}" + (" *" if value > BOUNDS.get(key, np.inf) else "") for key, value in numbers.items()) + " |", flush=True)


def main():
    parser = command.Command("scree-terrain-bank", __doc__)
    parser.add_argument("folder", type=pathlib.Path, help="where the run folders go")
    parser.add_argument("--program", type=pathlib.Path, help="default: scree of the build, or of the PATH")
    parser.add_argument("--mountain", choices=MOUNTAINS, action="append", help="may be given several times; default: all")
    parser.add_argument("--seeds", default="1-8", help="first and last seed of the mountains; default 1-8")
    parser.add_argument("--size", choices=SIZES, default="large", help="of the mountains; default large")
    parser.add_argument("--cell", type=float, action="append", help="cell size, m; may be given several times; default 10")
    parser.add_argument("--method", action="append", help="of the transfer: FLIP, TPIC, ...; may be given several times; default FLIP")
    parser.add_argument("--end", type=float, default=60., help="end time, s; default 60")
    parser.add_argument("--saturated", action="store_true", help="slides of soil with separate points of water")
    parser.add_argument("--ranks", type=int, default=1, help="of each run; default 1")
    parser.run(write_table)

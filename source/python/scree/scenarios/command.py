# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs a case many times with other values of its entries, and tells what follows from all runs.

scree-scenarios study.toml --dry-run
scree-scenarios study.toml

The study, a file in TOML, names the base case, the parameters with their distributions, the sampling and thresholds. Its folder gets runs.csv with a
row for each run, maps of the probability that a threshold is exceeded, pictures, and report.html. The same command goes on with what is missing: runs
that have failed are tried again, and the evaluation goes on without those that fail. Snakemake starts the runs.
"""

import os
import pathlib

from scree.command import Command, aligned
from scree.scenarios import page, runs, study


def _show(one, n_cores, n_ranks):
    """What would run, and how long it would take."""
    verdicts = runs.verdicts(one)
    names = ["run", *(parameter.label for parameter in one.parameters), "verdict"]
    rows = [[number, *map(str, row), verdicts[number].word] for number, row in zip(one.numbers, one.rows)]
    print(aligned(names, rows, len(names)))
    n_left = sum(verdict.word != "finished" for verdict in verdicts.values())
    seconds, source = runs.estimate(one)
    print(f"{n_left} of {len(rows)} runs to do, {runs.duration(seconds)} each ({source}); "
          f"on {n_cores} cores {runs.duration(n_left * seconds / max(1, n_cores // n_ranks))}. Folder {one.folder}")


def _run(arguments):
    if arguments.cores is not None and arguments.cores < 1 or arguments.ranks < 1:
        raise ValueError("--cores and --ranks: write numbers of at least 1")
    one = study.read(arguments.study)
    n_cores = arguments.cores or (0 if arguments.profile else len(os.sched_getaffinity(0)))
    if arguments.dry_run:
        _show(one, max(n_cores, 1), arguments.ranks)
        return 0
    with runs.only_one(one):
        is_interrupted = False
        if not arguments.evaluate:
            runs.prepare(one, arguments.ranks)
            is_interrupted = runs.start(one, n_cores, arguments.ranks, arguments.profile)
        done = page.write_all(one)
    for is_good, label, text in page.summary(one, done):
        print(f"{label:12}{text}" if is_good else f"{label:12}{text}.")
    for number, verdict in done.verdicts.items():
        if verdict.word == "failed":
            print(f"Run {number}    {verdict.message}")
    if not done.numbers:
        raise ValueError(f"{one.folder}: no run has ended well: there is nothing to evaluate")
    print(f"Results     {one.folder}: report.html, runs.csv, maps" if one.thresholds else f"Results     {one.folder}: report.html, runs.csv")
    if is_interrupted:
        print("The same command goes on.")
    return 3 if is_interrupted else 0


def main():
    parser = Command("scree-scenarios", __doc__)
    parser.add_argument("study", type=pathlib.Path, help="file of the study, such as prm/terrain/mountain_scenarios.toml")
    parser.add_argument("--dry-run", action="store_true", help="list the runs and estimate their time; nothing is written")
    parser.add_argument("--evaluate", action="store_true", help="start no run, and evaluate those that are there")
    parser.add_argument("--cores", type=int, help="cores for all runs together; default: all")
    parser.add_argument("--ranks", type=int, default=1, help="ranks (mpirun) of each run; default 1")
    parser.add_argument("--profile", type=pathlib.Path, help="folder with a profile of Snakemake, for instance for a cluster with Slurm")
    parser.run(_run)

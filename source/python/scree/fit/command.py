# SPDX-License-Identifier: LGPL-2.1-or-later
"""Fits entries of a law to tables of laboratory tests.

scree-element --fit tests.toml

The file, in TOML, names the tests, each with the case of its path for scree-element and a table in CSV, and the free entries with start and bounds.
Its folder gets report.txt, parameters.csv, residuals.csv, fitted.prm with entries to paste into a case, fit.png with tests and law, and the cases of the
tests with the fitted entries. scree-fit is the same command.
"""

import os
import pathlib
import tempfile

from scree.command import Command
from scree.fit import page, problem, runs, solution


def _fit(arguments):
    n_cores = arguments.cores if arguments.cores is not None else len(os.sched_getaffinity(0))
    if n_cores < 1:
        raise ValueError("--cores: write a number of at least 1")
    one = problem.read(arguments.file)
    one.folder.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(prefix="scree_fit_") as folder:
        paths = runs.Runs(one, folder, n_cores)
        print(f"{one.file}: {len(one.tests)} tests, {one.n_values} values, {len(one.parameters)} free entries", flush=True)
        found = solution.solve(one, paths, lambda line: print(line, flush=True))
        report = page.write_all(one, paths, found)
    print(f"\n{report}\n\nResults  {one.folder}: report.txt, parameters.csv, residuals.csv, fitted.prm, fit.png, cases")


def main():
    parser = Command("scree-fit", __doc__)
    parser.add_argument("file", type=pathlib.Path, metavar="FILE.toml", help="tests and free entries, such as prm/element/sand_fit.toml")
    parser.add_argument("--cores", type=int, help="processes at a time; default: all cores. The result does not depend on it")
    parser.run(_fit)

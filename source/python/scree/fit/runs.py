# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs of scree-element, in parallel processes of several paths each."""

import concurrent.futures
import os
import pathlib
import shutil
import subprocess

import numpy as np

from scree import command, results, variants

TIME_LIMIT = 300.  # s, for the paths of a process


class Runs:
    """Paths of the tests of a fit with trial values of its parameters."""

    def __init__(self, problem, folder, n_cores):
        self.problem, self.folder, self.n_cores = problem, pathlib.Path(folder), n_cores
        self.program = command.needed("scree-element")
        # The cases of the tests with the entries that all runs share.
        self.texts = {test.name: variants.set_entries(variants.read_case(test.case, self.folder), test.entries) for test in problem.tests}
        self.n_runs, self.failures = 0, []

    def case(self, test, values, output):
        """The case of a test with trial values."""
        tried = {parameter.entry: value for parameter, value in zip(self.problem.parameters, values)}
        return variants.set_entries(self.texts[test.name], {**tried, "Output directory": output}) + "\n"

    def tables(self, trials):
        """For each trial, a list of values, the tables of all tests: {column: values}, or the message of a run that fails."""
        wanted = [(test, values) for values in trials for test in self.problem.tests]
        files = []
        for number, (test, values) in enumerate(wanted):
            files.append(self.folder / f"run_{number:05d}.prm")
            files[-1].write_text(self.case(test, values, str(files[-1].with_suffix(""))), encoding="utf-8")
        n_processes = min(self.n_cores, len(files))
        with concurrent.futures.ThreadPoolExecutor(n_processes) as pool:
            told = "".join(pool.map(self._call, [files[first::n_processes] for first in range(n_processes)]))
            # What a process that died did not come to, one by one.
            left = [[file] for file in files if not (file.with_suffix("") / "table.txt").exists() and str(file) not in told]
            told += "".join(pool.map(self._call, left))
        found = [self._table(file, test, values, told) for file, (test, values) in zip(files, wanted)]
        n_tests = len(self.problem.tests)
        return [found[first:first + n_tests] for first in range(0, len(found), n_tests)]

    def _call(self, files):
        """What a process says of the paths that fail."""
        environment = {**os.environ, "OMP_NUM_THREADS": "1", "DEAL_II_NUM_THREADS": "1"}
        try:
            done = subprocess.run([self.program, *map(str, files)], capture_output=True, text=True, errors="replace", check=False, env=environment,
                                  timeout=TIME_LIMIT)
        except subprocess.TimeoutExpired:
            return ""
        return done.stderr

    def _table(self, file, test, values, told):
        self.n_runs += 1
        table, message = None, "the program died or took too long"
        try:
            table = results.read_element_table(file.with_suffix("") / "table.txt")
            if not all(np.isfinite(column).all() for column in table.values()):
                table, message = None, "a result is not a finite number"
        except (OSError, ValueError):
            lines = [line for line in told.splitlines() if str(file) in line]
            message = lines[0].removeprefix("scree-element: ").replace(str(file), test.name).rstrip(".") if lines else message
        shutil.rmtree(file.with_suffix(""), ignore_errors=True)
        file.unlink()
        if table is None:
            self.failures.append((test.name, list(values), message))
            return message
        return table

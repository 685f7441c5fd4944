# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs variants of cases for the scripts that compare them, each once: a run that is there already is not repeated."""

import os
import pathlib
import re
import shutil
import subprocess

import numpy as np

import render
import variants

ROOT = pathlib.Path(__file__).resolve().parent.parent


def add_arguments(parser, results, time_limit=7200.):
    """The options that all these scripts have; `results` is the folder of the runs within ROOT/results."""
    parser.add_argument("--program", type=pathlib.Path, default=ROOT / "build" / "scree")
    parser.add_argument("--results", type=pathlib.Path, default=ROOT / "results" / results)
    parser.add_argument("--time-limit", type=float, default=time_limit,
                        help="longest time of a run, s of the clock on the wall; default %(default)g")
    parser.add_argument("--again", action="store_true", help="repeat runs that are there already")


def resolve(arguments):
    """Absolute paths, since scree is started in ROOT; raises FileNotFoundError without the program."""
    arguments.results = arguments.results.resolve()
    arguments.program = arguments.program.resolve()
    if not arguments.program.exists():
        raise FileNotFoundError(f"{arguments.program} is not there: build it, or name it with --program.")


def run_variant(base, name, entries, arguments, ranks=2):
    """Runs `base` with other `entries` unless the same run is there; returns (run folder, exit code).

    The case is `name`.prm next to the run folder `name`. The exit code is that of scree, 124 after the time limit.
    """
    folder = arguments.results / name
    prm, exit_code, log = (arguments.results / (name + suffix) for suffix in (".prm", ".exit_code", ".log"))
    before = prm.read_text(encoding="utf-8") if prm.exists() else None
    arguments.results.mkdir(parents=True, exist_ok=True)
    variants.write_variant(base, prm, {**entries, "Output directory": folder})
    if arguments.again or not exit_code.exists() or prm.read_text(encoding="utf-8") != before:
        exit_code.unlink(missing_ok=True)
        shutil.rmtree(folder, ignore_errors=True)
        exit_code.write_text(str(_run_scree(prm, log, arguments, ranks)), encoding="utf-8")
    return folder, int(exit_code.read_text(encoding="utf-8"))


def _run_scree(prm, log, arguments, ranks):
    environment = dict(os.environ, OMPI_MCA_rmaps_base_oversubscribe="1", DEAL_II_NUM_THREADS="1", OMP_NUM_THREADS="1")
    if os.geteuid() == 0:
        environment.update(OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
    print(f"Running {prm}", flush=True)
    launcher = ["mpirun", "-np", str(ranks)] if ranks > 1 else []
    command = ["timeout", f"{arguments.time_limit:g}", *launcher, arguments.program, prm]
    with open(log, "w", encoding="utf-8") as output:
        code = subprocess.run(command, cwd=ROOT, env=environment, stdout=output, stderr=subprocess.STDOUT,
                              check=False).returncode
    if code != 0:
        print(f"  ended with {code}; its output is in {log}")
    return code


def stopped_at(folder, exit_code):
    """Time of the last row of statistics, s, of a run that ended with an error (nan: there is none); None of one that did not."""
    if exit_code == 0:
        return None
    if not (folder / "statistics").exists():
        return np.nan
    times = render.column(render.read_statistics(folder), "^time")
    return times[-1] if times is not None and len(times) else np.nan


def core_seconds(folder, ranks):
    """Wall time of the steps, from the table at the end of log.txt, times ranks, s; nan if the run has not come to its end."""
    log = folder / "log.txt"
    total = re.findall(r"^\s*total\s+([\d.]+)", log.read_text(encoding="utf-8"), re.MULTILINE) if log.exists() else []
    return ranks * float(total[-1]) if total else np.nan

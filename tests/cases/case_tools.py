# SPDX-License-Identifier: LGPL-2.1-or-later
"""What scripts of several tests share: SCRIPT SCREE LAUNCHER TEST, where TEST is a function of the script that works in the current
folder and LAUNCHER is "mpirun -np" or alike."""

import csv
import pathlib
import subprocess
import sys

from scree.variants import set_entries

HERE = pathlib.Path(__file__).resolve().parent

SCREE, LAUNCHER = sys.argv[1], sys.argv[2].split()


def run(folder, case, *options, ranks=1):
    """Runs a case, its text or {"Mesh/Cell size": 0.1, ...}, in a folder; returns its run folder."""
    pathlib.Path(folder).mkdir(exist_ok=True)
    text = case if isinstance(case, str) else set_entries("", {"Output directory": "results", **case})
    pathlib.Path(folder, "case.prm").write_text(text, encoding="utf-8")
    command = [*LAUNCHER, str(ranks)] if ranks > 1 else []
    subprocess.run([*command, SCREE, "case.prm", *options], cwd=folder, check=True, stdout=subprocess.DEVNULL)
    return pathlib.Path(folder, "results")


def rows_of(file):
    """The rows of a table with commas, each with its values by column."""
    with open(file, encoding="utf-8", newline="") as table:
        return list(csv.DictReader(table))


def log_of(folder):
    return (folder / "log.txt").read_text(encoding="utf-8")


def check(fact, text):
    if not fact:
        sys.exit("FAILED: " + text)

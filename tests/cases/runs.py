# SPDX-License-Identifier: LGPL-2.1-or-later
"""runs.py SCREE LAUNCHER TEST CASE ARGUMENT...: runs of a short case that must agree (compare_statistics.py).

Each test is a function below, whose arguments are numbers or "none" (case_tools.py).
"""

import csv
import math
import os
import re
import shutil
import subprocess
import sys

from scree.variants import read_case, read_entries, set_entries

from case_tools import HERE, LAUNCHER, SCREE, check, log_of, rows_of, run
from compare_statistics import compare

CASE = os.path.join(os.environ["SHORT_CASES"], sys.argv[4])


def fresh(folder, text, ranks):
    """The run folder of a case that begins at the start. A record.csv is a period of a sine along the first axis."""
    shutil.rmtree(folder, ignore_errors=True)
    if "record.csv" in text:
        os.mkdir(folder)
        rest = ", 0" * (2 if "Dimension = 3" in text else 1)
        with open(os.path.join(folder, "record.csv"), "w", encoding="utf-8") as record:
            record.writelines(f"{0.01 * i}, {2 * math.sin(0.08 * math.pi * i)}{rest}\n" for i in range(26))
    return run(folder, text, ranks=ranks)


def go_on(folder, text, ranks):
    """The run folder of a copy of a run, which goes on from its checkpoint."""
    shutil.rmtree("resumed", ignore_errors=True)
    shutil.copytree(folder, "resumed")
    results = run("resumed", text, "--resume", ranks=ranks)
    check("Resumed" in log_of(results), f"{folder} on {ranks} ranks does not resume")
    return results


def statistics(*folders):
    return [str(folder / "statistics.csv") for folder in folders]


def check_end(results, name):
    """The last row of the statistics of a case on one rank is its row of ends.csv, which has nothing in columns that it does not have."""
    wanted, = (row for row in rows_of(HERE / "ends.csv") if row.pop("case") == name)
    wanted = {column: value for column, value in wanted.items() if value}
    for file, row in (("wanted.csv", wanted), ("end.csv", rows_of(results / "statistics.csv")[-1])):
        with open(file, "w", encoding="utf-8") as table:
            writer = csv.DictWriter(table, row)
            writer.writeheader()
            writer.writerow(row)
    compare(("wanted.csv", "end.csv"), 1e-6)


def write_ends():
    """Writes ends.csv anew after a change that is meant: SHORT_CASES=build/tests/cases python3 tests/cases/runs.py build/scree "" write_ends all."""
    names = [row["case"] for row in rows_of(HERE / "ends.csv")]
    rows = [rows_of(fresh(name, read_case(os.path.join(os.environ["SHORT_CASES"], f"{name}.prm")), 1) / "statistics.csv")[-1] for name in names]
    with open(HERE / "ends.csv", "w", encoding="utf-8") as table:
        writer = csv.DictWriter(table, ["case", *dict.fromkeys(column for row in rows for column in row)], lineterminator="\n")
        writer.writeheader()
        writer.writerows({"case": name, **{column: f"{float(value):.9g}" for column, value in row.items()}} for name, row in zip(names, rows))


def restart(same, other, ranks=2):
    """After some hundred steps, the end is that of ends.csv, and all statistics of one rank and of two (or `ranks`) agree to `other`. A run that goes on from its checkpoint ends as if
    it had not stopped, to `same` on as many ranks (points keep their order), and to `other` on more or fewer (sums have another order).

    `other` is far above rounding, which grows with the steps, and far below anything that a lost point or node would do. The newest checkpoint of the
    cases is at 0.09 s; the end is no checkpoint. Without `same` ("none") nothing goes on. Three ranks are not run beside two: one of them has two
    neighbours, and the run that goes on on two ranks is compared, too.
    """
    text = read_case(CASE + ".prm")
    one, several = (fresh(str(n), text, n) for n in (1, int(ranks)))
    check_end(one, os.path.basename(CASE))
    compare(statistics(one, several), other)
    if same is not None:
        for before, after, tolerance in ((one, 1, same), (several, 1, other), (one, 2, other)):
            compare(statistics(before, go_on(before.parent, text, after)), tolerance)


def thin_3d_is_2d(tolerance):
    """A slice in 3D, one cell thick between smooth walls (CASE_3d), is the plane strain run (CASE_2d) at the end, per metre of thickness. In the plane the
    points are the same; cell averages are, too."""
    plane, space = (fresh(f"{dim}d", read_case(f"{CASE}_{dim}d.prm"), dim - 1) for dim in (2, 3))
    check_end(plane, f"{os.path.basename(CASE)}_2d")
    compare(statistics(plane, space), tolerance, 0.1)


def follows_points(tolerance):
    """Fine cells that follow the points change nothing but time and memory: two and three ranks agree with one; a box of twice the height and width takes
    no more fine cells."""
    text = read_case(CASE + ".prm")
    around = fresh("around", text, 1)
    check(re.search("followed the points [1-9] times", log_of(around)), "the fine cells stay where they are")
    for ranks in (2, 3):
        compare(statistics(around, fresh(str(ranks), text, ranks)), tolerance)
    corner = ", ".join(str(2 * float(x)) for x in read_entries(CASE + ".prm")["Mesh/Upper corner"].split(","))
    wide = fresh("wide", set_entries(text, {"End time": 0.002, "Mesh/Upper corner": corner}), 1)
    cells = [re.search(r"^Mesh +([0-9e+.]+) cells of .* m around the points", log_of(results), re.MULTILINE)[1] for results in (around, wide)]
    check(cells[0] == cells[1], f"fine cells: {cells[0]}, in a wide box {cells[1]}")


def messages(most_messages, most_bytes):
    """A run on two ranks sends no more messages and bytes than these. (Times depend on what else a machine does; these do not.)"""
    subprocess.run(["mpicc", "-shared", "-fPIC", "-O2", "-o", "count_mpi.so", HERE.parents[1] / "doc" / "studies" / "count_mpi.c"], check=True)
    done = subprocess.run([*LAUNCHER, "2", "env", "LD_PRELOAD=./count_mpi.so", SCREE, CASE + ".prm"], capture_output=True, text=True, check=True)
    (found, n_bytes), = re.findall(r"^mpi: ranks 2 messages (\d+) \d+ bytes (\d+) ", done.stderr, re.MULTILINE)
    print(f"{found} messages and {n_bytes} bytes")
    check(int(found) <= most_messages and int(n_bytes) <= most_bytes, f"{found} messages and {n_bytes} bytes; at most {most_messages:g} and {most_bytes:g}")


globals()[sys.argv[3]](*(None if word == "none" else float(word) for word in sys.argv[5:]))

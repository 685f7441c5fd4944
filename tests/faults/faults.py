# SPDX-License-Identifier: LGPL-2.1-or-later
"""faults.py FOLDER [NUMBER...]: do tests find faults? The faults of faults.table, by their place in it from 1 on, or all of them.

Copies the sources to FOLDER with all faults in them, each of which acts if the variable SCREE_FAULT has its number, so that one build serves
them all, and runs the tests of the table, an expression of ctest, with each: one at least must fail. By hand only: python3 tests/faults/faults.py /tmp/faults
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
HEAD = '#include <cstdlib>\ninline const int scree_fault = std::getenv("SCREE_FAULT") ? std::atoi(std::getenv("SCREE_FAULT")) : 0;\n'
folder = pathlib.Path(sys.argv[1]).resolve()
faults = [[part.strip() for part in line.split(" | ")] for line in (ROOT / "tests/faults/faults.table").read_text(encoding="ascii").splitlines()
          if not line.startswith("#")]

shutil.copytree(ROOT, folder, ignore=shutil.ignore_patterns(".git", "build*"), dirs_exist_ok=True)
(folder / "include/scree/fault.h").write_text("#pragma once\n" + HEAD, encoding="ascii")
for number, (name, right, wrong, _) in enumerate(faults, 1):
    file = folder / name
    text = file.read_text(encoding="utf-8")
    if text.count(right) != 1:
        sys.exit(f"{name} has {right!r} {text.count(right)} times. Write the line as it is now.")
    text = text.replace(right, f"(scree_fault == {number} ? ({wrong}) : ({right}))")
    file.write_text(text if "scree/fault.h" in text else "#include <scree/fault.h>\n" + text, encoding="utf-8")

build = folder / "build"
subprocess.run(["cmake", "-S", folder, "-B", build, "-GNinja", "-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"], check=True)
subprocess.run(["ninja", "-C", build, "-j2", "test_programs"], check=True)
missed = []
for number in map(int, sys.argv[2:]) if sys.argv[2:] else range(1, len(faults) + 1):
    done = subprocess.run(["ctest", "--test-dir", build, "-FA", ".", "-R", f"^({faults[number - 1][3]})($|\\.)"], capture_output=True, text=True, check=False,
                          env={**os.environ, "SCREE_FAULT": str(number)})
    found = re.findall(r"(\S+) \.+\*\*\*", done.stdout)
    print(f"{number}, {faults[number - 1][0]}: found by {', '.join(found) or 'no test'}", flush=True)
    missed += [] if found else [number]
sys.exit(f"not found: {missed}" if missed else 0)

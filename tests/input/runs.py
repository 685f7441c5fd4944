# SPDX-License-Identifier: LGPL-2.1-or-later
"""runs.py FUZZ SCREE COUNT: starts the program with random wrong cases, for a step at most.

Each run must end by itself, well or with one error: exit code 0 or 1, and no stack trace. `FUZZ` writes the cases.
"""

import pathlib
import shutil
import subprocess
import sys

SHORT = "\nset End time = 1e-9\nsubsection Output\n  set Graphics = none\nend\nsubsection Settling\n  set Maximum time = 0\nend\n"


def fault_of(scree, folder):
    """What is wrong with how the program received the case of a folder; empty: nothing."""
    case = folder / "case.prm"
    # Where the end of the file is open or wrong, the last statements do not read either: then nothing runs long.
    case.write_bytes(case.read_bytes() + SHORT.encode())
    try:
        run = subprocess.run([scree, case.name], cwd=folder, capture_output=True, timeout=60, check=False)
    except subprocess.TimeoutExpired:
        return "it hangs"
    error = run.stderr.decode(errors="replace")
    if run.returncode == 0:
        return error and f"it ends well, but says {error}"
    if run.returncode != 1:
        return f"exit code {run.returncode}: {error}"
    lines = error.strip().split("\n")
    if not lines[0].startswith("scree: ") or "----" in error:
        return f"no error in words: {error}"
    return ""


def main():
    fuzz, scree, count = sys.argv[1:]
    folders = pathlib.Path("cases")
    shutil.rmtree(folders, ignore_errors=True)
    subprocess.run([fuzz, count, str(folders)], check=True, capture_output=True)
    faults = 0
    for folder in sorted(folders.iterdir(), key=lambda path: int(path.name)):
        fault = fault_of(scree, folder)
        if fault:
            faults += 1
            print(f"{folder}: {fault}")
    print(f"{count} runs, of them wrong {faults}")
    sys.exit(faults > 0)


if __name__ == "__main__":
    main()

#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""sizes.py ROOT: no folder below ROOT (its headers and sources, without subfolders) has more than 3000 lines, no file more than 400, no function
more than 60."""

import collections
import pathlib
import re
import sys

LINES_OF_FOLDER, LINES_OF_FILE, LINES_OF_FUNCTION = 3000, 400, 60
NO_FUNCTION = re.compile(r"\b(if|for|while|switch|namespace|struct|class|enum|else|do)\b")


def functions(lines):
    """(first line, number of lines between the braces) of the functions, whose braces stand alone on their lines."""
    for first, line in enumerate(lines):
        before = lines[first - 1].strip() if first else ""
        if line.strip() == "{" and re.search(r"(\)|const|override|noexcept)$", before) and not NO_FUNCTION.search(before.split("(")[0]):
            end = line.replace("{", "}")
            last = next(number for number in range(first, len(lines)) if lines[number].startswith(end))
            yield first + 1, last - first - 1


def main():
    root = pathlib.Path(sys.argv[1])
    of_folder, n_functions, faults = collections.Counter(), 0, []
    for base in (root / "source", root / "include" / "scree"):
        for file in sorted(base.rglob("*.cc")) + sorted(base.rglob("*.h")):
            lines = file.read_text(encoding="utf-8").splitlines()
            of_folder[file.parent.relative_to(base)] += len(lines)
            if len(lines) > LINES_OF_FILE:
                faults.append(f"{file.relative_to(root)} has {len(lines)} lines; {LINES_OF_FILE} at most.")
            for first, length in functions(lines):
                n_functions += 1
                if length > LINES_OF_FUNCTION:
                    faults.append(f"{file.relative_to(root)}, line {first}: this function has {length} lines; {LINES_OF_FUNCTION} at most.")
    faults += [f"folder {folder} has {n} lines; {LINES_OF_FOLDER} at most." for folder, n in of_folder.items() if n > LINES_OF_FOLDER]
    print(f"{len(of_folder)} folders, {sum(of_folder.values())} lines, {n_functions} functions of several lines; largest folder {max(of_folder.values())}.")
    sys.exit("\n".join(faults) or n_functions < 1000)


if __name__ == "__main__":
    main()

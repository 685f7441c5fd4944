#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Reads and edits parameter files in deal.II's text format.

python3 doc/variants.py BASE.prm TARGET.prm "Stabilisation/F-bar = none" "Output directory = results/x" ...
"""

import re
import sys


def _lines(text):
    """Yields (indices of the lines of one statement, statement without comment), backslash continuations joined."""
    indices, statement = [], ""
    for index, line in enumerate(text.split("\n")):
        indices.append(index)
        statement += re.sub(r"(?<!\\)#.*", "", line).strip()
        if statement.endswith("\\"):
            statement = statement[:-1].rstrip() + " "
            continue
        yield indices, statement.strip()
        indices, statement = [], ""


def _entry(statement):
    """(name, value) of `set name = value`, else None."""
    match = re.match(r"set\s+([^=]*?)\s*=\s*(.*)$", statement, re.IGNORECASE)
    return match and (match.group(1), match.group(2))


def _subsection(statement):
    match = re.match(r"subsection\s+(.*)$", statement, re.IGNORECASE)
    return match and match.group(1)


def read_entries(prm):
    """All entries of a file: {"Mesh/Cell size": "0.05", "End time": "12", ...}."""
    entries, path = {}, []
    with open(prm, encoding="utf-8") as file:
        for _, statement in _lines(file.read()):
            if _subsection(statement):
                path.append(_subsection(statement))
            elif statement.lower() == "end":
                path.pop()
            elif _entry(statement):
                name, value = _entry(statement)
                entries["/".join(path + [name])] = value
    return entries


def set_entry(text, key, value):
    """`text` with one entry changed where it stands, or added to its subsection, or added at the end."""
    *wanted, wanted_name = key.split("/")
    lines = text.split("\n")
    path, replacements, ends = [], [], {}  # ends: subsection path -> index of its last `end`
    for indices, statement in _lines(text):
        if _subsection(statement):
            path.append(_subsection(statement))
        elif statement.lower() == "end":
            ends[tuple(path)] = indices[0]
            path.pop()
        elif _entry(statement) and path == wanted and _entry(statement)[0] == wanted_name:
            replacements.append(indices)

    if replacements:
        for indices in reversed(replacements):
            head = lines[indices[0]].split("=", 1)[0]
            lines[indices[0]:indices[-1] + 1] = [f"{head}= {value}"]
        return "\n".join(lines)

    # The innermost subsection that exists takes the missing ones.
    depth = len(wanted)
    while depth > 0 and tuple(wanted[:depth]) not in ends:
        depth -= 1
    missing = wanted[depth:]
    block = [f"subsection {name}" for name in missing] + [f"set {wanted_name} = {value}"] + ["end"] * len(missing)
    level = depth
    for number, line in enumerate(block):
        level -= line == "end"
        block[number] = "  " * level + line
        level += line.startswith("subsection")
    position = ends[tuple(wanted[:depth])] if depth > 0 else len(lines)
    lines[position:position] = block
    return "\n".join(lines)


def write_variant(base_prm, target_prm, entries):
    """Writes `base_prm` with other values to `target_prm`.

    `entries`: {"Stabilisation/F-bar": "none", "Output directory": "results/none"}; the name of an entry follows those
    of its subsections, separated by "/". An entry that is not in the file is added.
    """
    with open(base_prm, encoding="utf-8") as file:
        text = file.read().rstrip("\n")
    for key, value in entries.items():
        text = set_entry(text, key, value)
    with open(target_prm, "w", encoding="utf-8") as file:
        file.write(text + "\n")


if __name__ == "__main__":
    if len(sys.argv) < 4 or not all("=" in argument for argument in sys.argv[3:]):
        sys.exit(__doc__)
    write_variant(sys.argv[1], sys.argv[2],
                  dict([part.strip() for part in argument.split("=", 1)] for argument in sys.argv[3:]))

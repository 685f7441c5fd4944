#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Reads and edits parameter files in deal.II's text format.

/usr/bin/python3 doc/variants.py BASE.prm TARGET.prm "Stabilisation/F-bar = none" "Output directory = results/x" ...

Paths of files in BASE.prm are changed so that TARGET.prm finds the same files; those on the command line count from TARGET.prm.
Entries that BASE.prm does not have are looked up in what the program lists: build/scree, or scree of the PATH.
"""

import difflib
import os
import pathlib
import re
import shutil
import subprocess
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


def _entries_of(text):
    """All entries of a text: {"Mesh/Cell size": "0.05", "End time": "12", ...}. Throws a ValueError at an "end" too many."""
    entries, path = {}, []
    for _, statement in _lines(text):
        if _subsection(statement):
            path.append(_subsection(statement))
        elif statement.lower() == "end":
            if not path:
                raise ValueError('an "end" closes no subsection')
            path.pop()
        elif _entry(statement):
            name, value = _entry(statement)
            entries["/".join(path + [name])] = value
    return entries


def read_entries(prm):
    """All entries of a file: {"Mesh/Cell size": "0.05", "End time": "12", ...}."""
    with open(prm, encoding="utf-8-sig") as file:
        return _entries_of(file.read())


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


def file_named(prm, value):
    """The file that an entry of the case `prm` names, whose path counts from the case; None if that is no file."""
    file = pathlib.Path(prm).parent / value
    return file if value and os.path.isfile(file) else None


def move_paths(text, base_prm, target_prm):
    """The text of the case `base_prm` for one that lies where `target_prm` does: paths of includes and of files that entries name, too."""
    lines = text.split("\n")
    for indices, statement in _lines(text):
        value = _entry(statement)[1] if _entry(statement) else (re.match(r"include\s+(.*)$", statement, re.IGNORECASE) or [None, ""])[1]
        file = file_named(base_prm, value)
        if file and not os.path.isabs(value):
            moved = os.path.relpath(file.resolve(), pathlib.Path(target_prm).resolve().parent)
            head = re.match(r"[^=]*= *" if _entry(statement) else r"\s*\S+ ", lines[indices[0]]).group(0)
            lines[indices[0]:indices[-1] + 1] = [head + moved] + [""] * (len(indices) - 1)
    return "\n".join(lines)


def write_variant(base_prm, target_prm, entries):
    """Writes `base_prm` with other values to `target_prm`. The new case finds the files that `base_prm` names.

    `entries`: {"Stabilisation/F-bar": "none", "Output directory": "results/none"}; the name of an entry follows those
    of its subsections, separated by "/". An entry that is not in the file is added. Paths among them count from `target_prm`.
    """
    with open(base_prm, encoding="utf-8-sig") as file:
        text = move_paths(file.read().rstrip("\n"), base_prm, target_prm)
    for key, value in entries.items():
        text = set_entry(text, key, value)
    with open(target_prm, "w", encoding="utf-8") as file:
        file.write(text + "\n")


def _program(name):
    """The path of scree or scree-element: built or installed beside this file, or on the PATH; else None."""
    root = pathlib.Path(__file__).resolve().parents[1]
    beside = [root / "build" / name, root.parents[1] / "bin" / name]
    return next((str(path) for path in beside if os.access(path, os.X_OK)), shutil.which(name))


def known_entries(base):
    """The entries that a case like `base` may have, where bodies have its names; None if no program is there to ask."""
    is_element = "Path" in base  # a case of scree-element
    program = _program("scree-element" if is_element else "scree")
    if program is None:
        return None
    listed = subprocess.run([program, "--help" if is_element else "--print-parameters"], capture_output=True, text=True, check=True).stdout
    known = set(_entries_of(listed))
    if not is_element:
        of_a_body = [name.split("/", 1)[1] for name in known if name.startswith("Soil/")]
        bodies = [name.strip() for name in base.get("Bodies", "Soil").split(",")]
        known = {name for name in known if not name.startswith("Soil/")} | {f"{body}/{name}" for body in bodies for name in of_a_body}
    return known


def check_entries(base, entries):
    """Throws a ValueError at an entry that is neither in the case `base`, with its values, nor known to the program."""
    unsure = [key for key in entries if key not in base]
    known = known_entries({**base, **entries}) if unsure else set()
    for key in unsure:
        if known is None:
            print(f'variants.py: no program is there to ask whether there is an entry "{key}".', file=sys.stderr)
        elif key not in known:
            close = difflib.get_close_matches(key, known | set(base), 1) or [name for name in sorted(known) if name.split("/")[-1] == key]
            raise ValueError(f'there is no entry "{key}".' + (f' Did you mean "{close[0]}"?' if close else ""))


def main(arguments):
    if len(arguments) < 3:
        sys.exit(__doc__)
    base, target, *texts = arguments
    try:
        for text in texts:
            if "=" not in text:
                raise ValueError(f'"{text}" has no "=": write "SUBSECTION/ENTRY = VALUE"')
        entries = dict([part.strip() for part in text.split("=", 1)] for text in texts)
        if os.path.exists(target) and os.path.samefile(base, target):
            raise ValueError(f"{target} is the case itself: write another name")
        check_entries(read_entries(base), entries)
        write_variant(base, target, entries)
    except (OSError, ValueError, subprocess.CalledProcessError) as error:
        sys.exit(f"variants.py: {error}")


if __name__ == "__main__":
    main(sys.argv[1:])

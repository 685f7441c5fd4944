# SPDX-License-Identifier: LGPL-2.1-or-later
"""Writes a case with other values of its entries.

scree-variant BASE.prm TARGET.prm "Stabilisation/F-bar = none" "Output directory = results/x" ...

What BASE.prm includes is written into TARGET.prm, and paths of files are changed so that it finds the same files; those on the command line count
from TARGET.prm. Entries that BASE.prm does not have are looked up in what the program lists: build/scree, or scree of the PATH.
"""

import difflib
import functools
import os
import pathlib
import re
import subprocess
import sys

from scree.command import Command, program


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
    """All entries of a file and of what it includes: {"Mesh/Cell size": "0.05", "End time": "12", ...}."""
    return _entries_of(read_case(prm))


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
    depth = next(depth for depth in range(len(wanted), -1, -1) if depth == 0 or tuple(wanted[:depth]) in ends)
    missing = list(enumerate(wanted))[depth:]
    position = ends.get(tuple(wanted[:depth]), len(lines))
    lines[position:position] = [*("  " * level + f"subsection {name}" for level, name in missing), "  " * len(wanted) + f"set {wanted_name} = {value}",
                                *("  " * level + "end" for level, _ in reversed(missing))]
    return "\n".join(lines)


def set_entries(text, entries):
    """`text` with other values of several entries, {"Mesh/Cell size": 0.05, "End time": 12}; without text, a case of these entries."""
    for key, value in entries.items():
        text = set_entry(text, key, f"{value:.12g}" if isinstance(value, float) else value)
    return text


def file_named(prm, value):
    """The file that an entry of the case `prm` names, whose path counts from the case; None if that is no file."""
    file = pathlib.Path(prm).parent / value
    return file if value and os.path.isfile(file) else None


def read_case(prm, folder=None, includers=()):
    """The text of a case with its included files in their place. Paths of files that entries name count from `folder`, by default that of the case."""
    prm = pathlib.Path(prm)
    folder = prm.parent if folder is None else pathlib.Path(folder)
    if prm.resolve() in includers:
        raise ValueError(f"{prm}: files include each other in a loop")
    lines = prm.read_text(encoding="utf-8-sig").rstrip("\n").split("\n")
    for indices, statement in reversed(list(_lines("\n".join(lines)))):
        included, entry = re.match(r"include\s+(.*)$", statement, re.IGNORECASE), _entry(statement)
        if included:
            lines[indices[0]:indices[-1] + 1] = read_case(prm.parent / included.group(1), folder, (*includers, prm.resolve())).split("\n")
        elif entry and not os.path.isabs(entry[1]) and folder != prm.parent and file_named(prm, entry[1]):
            moved = os.path.relpath(file_named(prm, entry[1]).resolve(), folder.resolve())
            lines[indices[0]:indices[-1] + 1] = [re.match(r"[^=]*= *", lines[indices[0]]).group(0) + moved]
    return "\n".join(lines)


def write_variant(base_prm, target_prm, entries):
    """Writes `base_prm` with other values to `target_prm`. The new case finds the files that `base_prm` names.

    `entries`: {"Stabilisation/F-bar": "none", "Output directory": "results/none"}; the name of an entry follows those
    of its subsections, separated by "/". An entry that is not in the file is added. Paths among them count from `target_prm`.
    """
    text = set_entries(read_case(base_prm, pathlib.Path(target_prm).parent), entries)
    pathlib.Path(target_prm).write_text(text + "\n", encoding="utf-8")


@functools.lru_cache
def _listed(asked, option):
    """The entries that a program lists."""
    return frozenset(_entries_of(subprocess.run([asked, option], capture_output=True, text=True, check=True).stdout))


def known_entries(base):
    """The entries that a case like `base` may have, where bodies have its names; None if no program is there to ask."""
    is_element = "Path" in base  # a case of scree-element
    asked = program("scree-element" if is_element else "scree")
    if asked is None:
        return None
    known = _listed(asked, "--help" if is_element else "--print-parameters")
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
            print(f'scree-variant: no program is there to ask whether there is an entry "{key}".', file=sys.stderr)
        elif key not in known:
            close = difflib.get_close_matches(key, known | set(base), 1) or [name for name in sorted(known) if name.split("/")[-1] == key]
            raise ValueError(f'there is no entry "{key}".' + (f' Did you mean "{close[0]}"?' if close else ""))


def _write_variant(arguments):
    base, target = arguments.base, arguments.target
    for text in arguments.entries:
        if "=" not in text:
            raise ValueError(f'"{text}" has no "=": write "SUBSECTION/ENTRY = VALUE"')
    entries = dict([part.strip() for part in text.split("=", 1)] for text in arguments.entries)
    if os.path.exists(target) and os.path.samefile(base, target):
        raise ValueError(f"{target} is the case itself: write another name")
    check_entries(read_entries(base), entries)
    write_variant(base, target, entries)


def main():
    parser = Command("scree-variant", __doc__)
    parser.add_argument("base", metavar="BASE.prm", help="the case to start from")
    parser.add_argument("target", metavar="TARGET.prm", help="the case that is written")
    parser.add_argument("entries", metavar="ENTRY = VALUE", nargs="+", help='with its subsections, such as "Mesh/Cell size = 0.1"')
    parser.run(_write_variant)

# SPDX-License-Identifier: LGPL-2.1-or-later
"""tables.py FOLDER TABLE [BASES...]: writes each case of a table into a folder, as NAME.prm; what they start from may stand in the other tables.

A table consists of blocks, with the lines of a block indented:

  base plain: Soil/Region = y < 0.5                     entries that cases start from, which are no case themselves

  case column from plain: End time = 0.1 | Mesh/Upper corner = 3, 2 | /Cell size = 0.1
    Soil/Material = linear elastic                      these entries, then the others of "plain", which may be a case, too

Entries stand behind the colon and in the lines of the block, with " | " between them; "/ENTRY" is of the subsection of the one before it, and
"Soil/" alone an empty subsection.
"""

import dataclasses
import pathlib
import re
import sys


MARKS = "|!$?="  # of lines that are no entries


@dataclasses.dataclass
class Block:
    """A block of a table: its kind, the words of its first line, that line's place, its entries, and its lines of another kind (errors.py)."""
    kind: str
    name: str
    base: str
    place: str
    parts: list
    lines: list

    def add(self, line):
        """Adds a line, or what stands behind the colon of the first one."""
        for part in [line] if self.kind == "file" or line[0] in MARKS else line.split(" | "):
            (self.lines if self.kind == "file" or part[0] in MARKS else self.parts).append(part)


def blocks(table):
    """Yields the blocks of a table."""
    block = None
    for number, line in enumerate(table.read_text(encoding="ascii").splitlines(), start=1):
        place = f"{table.name}, line {number}"
        if header := re.fullmatch(r"(base|file|case) ([^\s:]+)(?: from ([^\s:]+))?(?:: (.*))?", line):
            if block:
                yield block
            block = Block(header[1], header[2], header[3] or "", place, [], [])
            if header[1] == "file" and header[4]:
                block.lines += [text if block.base else "| " + text for text in header[4].split(" | ")]
            elif header[4]:
                block.add(header[4])
        elif line.startswith("  ") and block:
            block.add(line[2:])
        elif line and not line.startswith("#"):
            raise SystemExit(f"{place}: {line!r} begins no block. Write base, file or case, or indent the line.")
    if block:
        yield block


def entries(block, others):
    """The entries of a block: path and value, or None for an empty subsection; `others` has those of the blocks that it may start from, by name."""
    found, subsection = {}, ""
    for part in block.parts:
        path, equals, value = part.partition(" = ")
        path = subsection + path if path[0] == "/" else path
        subsection = path.rpartition("/")[0]
        if not (equals or part.endswith("/")) or path in found:
            raise SystemExit(f"{block.place}: {part!r} is no new entry. Write SUBSECTION/ENTRY = VALUE.")
        found[path] = value if equals else None
    if block.base and block.base not in others:
        raise SystemExit(f"{block.place}: there is no {block.base}. There are {', '.join(others)}.")
    return found | {path: value for path, value in others.get(block.base, {}).items() if path not in found}


def parameter_file(values):
    """A parameter file with these entries, and the line of each one and of each subsection in it."""
    tree = {}
    for path, value in values.items():
        *subsections, entry = path.split("/")
        level = tree
        for subsection in subsections:
            level = level.setdefault(subsection + "/", {})
        if entry:
            level[entry] = value
    text, at = [], {}

    def write(level, path):
        indent = "  " * path.count("/")
        for name, value in level.items():
            at[path + name] = len(text) + 1
            if isinstance(value, dict):
                text.append(f"{indent}subsection {name[:-1]}\n")
                write(value, path + name)
                text.append(f"{indent}end\n")
            else:
                text.append(f"{indent}set {name} = {value}\n")
    write(tree, "")
    return "".join(text).encode(), at


def main():
    folder, table, *others = map(pathlib.Path, sys.argv[1:])
    folder.mkdir(parents=True, exist_ok=True)
    known = {}
    for file in (*others, table):
        for block in blocks(file):
            known[block.name] = entries(block, known)
            if block.kind == "case" and file == table:
                (folder / f"{block.name}.prm").write_bytes(parameter_file(known[block.name])[0])


if __name__ == "__main__":
    main()

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs the cases of the tables beside this file: wrong input, and what a program must say about it; all in one process (messages.cc).

A table consists of blocks, with the lines of a block indented; base and case are those of tables.py:

  base plain: Soil/Region = y < 0.5           entries that cases start from

  file profile.csv: x, y | 0, 0.2             a file that cases name; long ones have each line by itself, after "| "

  file other.csv from profile.csv: 1| 0, 0.3  the same but for the lines of these numbers, of which one may follow the last

  case cell_size_zero from plain: Mesh/Cell size = 0    the file cell_size_zero.prm: these entries, then the others of the base
    ! subsection Mesh, entry "Cell size" = 0: write a number above 0.

A case of "| " lines has those as its file instead of entries, \\xHH is a byte of them.
"$ scree --resume valid.prm" in the place of an entry is a command line other than "scree NAME.prm".
"! TEXT" is all of standard error, with exit code 1: "scree: NAME.prm, line N: TEXT", where N is the line of the entry or
subsection that the text names, and without a line if the case does not contain it. "! scree..." is the whole message,
"! nothing" a run without an error. Of such a run's log "= TEXT" is a part of a line, and "? TEXT" one of a question, of which there are no others;
"? none" if there are none.
"""

import argparse
import pathlib
import re
import shlex
import shutil
import subprocess
import sys

from tables import blocks, entries, parameter_file

HERE = pathlib.Path(__file__).resolve().parent


def as_bytes(text):
    """The bytes of a text in which \\xHH is one."""
    return re.sub(rb"\\x([0-9a-f]{2})", lambda code: bytes.fromhex(code[1].decode()), text.encode())


def quoted(block):
    """The content of the "| " lines of a block."""
    return b"".join(as_bytes(line[2:]) + b"\n" for line in block.lines if line.startswith("|"))


class Case:
    """A case of a table: its file, its command line, and what standard error must be."""

    def __init__(self, block, bases):
        self.name, self.place = block.name, block.place
        self.content, at = (quoted(block), {}) if any(line[0] == "|" for line in block.lines) else parameter_file(entries(block, bases))
        command = [line[2:] for line in block.lines if line[0] == "$"] or [f"scree {self.name}.prm"]
        self.questions, self.logged = ([line[2:] for line in block.lines if line[0] == mark] for mark in "?=")
        said = ["nothing"] if self.questions or self.logged else [line[2:] for line in block.lines if line[0] == "!"]
        if len(command) != 1 or len(said) != 1:
            raise SystemExit(f"{self.place}: there are {len(said)} messages. A case has one: ! TEXT, or ! nothing")
        self.program, *self.arguments = shlex.split(command[0])
        self.expected = as_bytes(self.message(said[0], at)) if said[0] != "nothing" else b""
        self.code = 1 if self.expected else 0

    def message(self, text, at):
        """All of standard error, of a text as tables have it."""
        if text.startswith("scree"):
            return text + "\n"
        named = re.match(r'(?:subsection ([^,:]+)(?:, |:))?(?:entry "([^"]+)")?', text)
        line = at.get((named[1] + "/" if named[1] else "") + (named[2] or ""))
        return f"{self.program}: {self.name}.prm{f', line {line}' if line else ''}: {text}\n"

    def fault(self, codes, got, log):
        """What is not as expected, or ""."""
        asked = [line for line in log if re.search("Unusual value:|Base stronger", line)] if self.questions else []
        wanted = [text for text in self.questions if text != "none"]
        fault = "".join(f"the log does not have: {text}\n" for text in wanted + self.logged if not any(text in line for line in log))
        if len(asked) != len(wanted):
            fault += f"the log asks {asked}\n"
        if got != self.expected:
            fault += f"expected: {self.expected!r}\n     got: {got!r}\n"
        if set(codes) != {self.code}:
            fault += f"exit codes {codes}, expected {self.code}\n"
        return f"{self.name} ({self.place}):\n{fault}" if fault else ""


class Tables:
    """The blocks of all tables, each name once."""

    def __init__(self, tables):
        kinds = {"base": {}, "file": {}, "case": {}}
        for table in tables:
            for block in blocks(table):
                if block.name in kinds[block.kind]:
                    raise SystemExit(f"{block.place}: there is another {block.kind} {block.name}.")
                kinds[block.kind][block.name] = block
        bases = {}
        for name, block in kinds["base"].items():
            bases[name] = entries(block, bases)
        self.files = {}
        for name, block in kinds["file"].items():
            content = self.files[block.base].splitlines(keepends=True) if block.base else quoted(block)
            for line in block.lines if block.base else ():
                number, _, text = line.partition("| ")
                content[int(number) - 1:int(number)] = [as_bytes(text) + b"\n"]
            self.files[name] = b"".join(content) if block.base else content
        self.cases = {name: Case(block, bases) for name, block in sorted(kinds["case"].items())}
        self.refuse_unused({block.base for kind in ("base", "case") for block in kinds[kind].values()}, bases)

    def refuse_unused(self, used, bases):
        """Every base and every file belongs to a case."""
        texts = b"\n".join([case.content for case in self.cases.values()] + list(self.files.values()))
        for name in bases:
            if name not in used:
                raise SystemExit(f"Nothing starts from base {name}.")
        for name in self.files:
            if not re.search(rb"(^|[^\w.])" + re.escape(name.encode()), texts) and pathlib.Path(name).suffix != ".prj":
                raise SystemExit(f"No case names file {name}.")

    def write(self, folder):
        """Writes all files of the cases into a new folder."""
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        for name, content in self.files.items():
            (folder / name).write_bytes(content)
        for case in self.cases.values():
            if case.content:
                (folder / f"{case.name}.prm").write_bytes(case.content)
        for file in HERE.glob("*.tif"):
            shutil.copy(file, folder)


def run_in_process(cases, folder, command):
    """Runs all cases one after the other in the processes of a command (messages.cc); yields their faults."""
    (folder / "list").write_text("".join("\t".join([case.name, case.program, *case.arguments]) + "\n" for case in cases), encoding="ascii")
    results = folder / "results"
    shutil.rmtree(results, ignore_errors=True)
    results.mkdir()
    code = subprocess.run([*command, folder / "list", folder / "cases", results], check=False).returncode
    if code:
        yield f"The program of all cases ended with exit code {code} in the last case above.\n"
    for case in cases:
        codes = results / f"{case.name}.codes"
        if not codes.exists():
            yield f"{case.name} ({case.place}) did not end.\n"
        else:
            got = b"".join(file.read_bytes() for file in sorted(results.glob(f"{case.name}.error.*")))
            log = results / f"{case.name}.log"
            yield case.fault([int(word) for word in codes.read_text().split()], got, log.read_text(encoding="utf-8").splitlines() if log.exists() else [])


def main():
    """Runs the cases that the command line asks for."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--command", type=shlex.split, required=True, help="the program of messages.cc, with its launcher")
    parser.add_argument("--folder", type=lambda text: pathlib.Path(text).resolve(), required=True, help="where the cases are written and run")
    parser.add_argument("--table", type=pathlib.Path, action="append", help="instead of all tables")
    parser.add_argument("name", nargs="*", help="of a case; none: all")
    options = parser.parse_args()

    tables = Tables(options.table or sorted(HERE.glob("*.table")))
    cases = [tables.cases[name] for name in options.name] or list(tables.cases.values())
    tables.write(options.folder / "cases")
    faults = list(filter(None, run_in_process(cases, options.folder, options.command)))
    print("\n".join(faults))
    print(f"{len(cases)} cases, {len(faults)} faults")
    sys.exit(1 if faults or not cases else 0)


if __name__ == "__main__":
    main()

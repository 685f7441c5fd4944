# SPDX-License-Identifier: LGPL-2.1-or-later
"""fuzz.py FUZZ SCREE COUNT STARTED: case files with random faults in entries, values, expressions, structure, bytes and included files.

FUZZ (fuzz.cc) reads COUNT of them, and the program SCREE is started with STARTED of these, for a step at most. Each must be accepted, or refused
with one error: no stack trace, no hang.
"""

import os
import pathlib
import random
import shutil
import subprocess
import sys

from scree.variants import known_entries, set_entries

MESH = {"End time": 1e-5, "Mesh/Cell size": 0.25}
BASES = [set_entries("", {**MESH, **entries}).strip() for entries in (
    {"Soil/Region": "y < 0.5"},
    {"Bodies": "Base, Cover", "Base/Region": "y < 0.5", "Base/Material": "Mohr-Coulomb", "Base/Initial velocity": "0; -x",
     "Cover/Region": "x < 0.5 && y >= 0.5 && y < 0.7", "Cover/Material": "linear elastic", "Surface load/Lower corner": "0, 0.7",
     "Surface load/Upper corner": "0.25, 0.7", "Surface load/Traction": "0; -100*t"},
    {"Soil/Region": "x < 0.5 && y < 0.5", "Soil/Initial state/Type": "K0", "Water/Region": "y < 0.6", "Water/Initial velocity": "-y; 0",
     "Water/Bulk modulus": 1e8, "Boundaries/Bottom": "friction 20", "Boundaries/Water/Right": "drained 100"},
    {"Soil/Region": "y < 0.5 && x < 0.7", "Bed/Type": "friction", "Bed/Friction angle": 20, "Bed/Level set expression": "y - 0.1*x",
     "Obstacle Wall/Type": "fixed", "Obstacle Wall/Level set expression": "0.7 - x", "Obstacle Wall/Velocity": "t; 0"},
    {"Soil/Material": "Mohr-Coulomb", "Soil/Initial porosity": 0.4, "Inflow Torrent/Body": "Soil", "Inflow Torrent/Saturated": "true",
     "Inflow Torrent/Region": "y < 0.3", "Inflow Torrent/Speed": "1 + t", "Inflow Torrent/Direction": "1, -0.2", "Inflow Spring/Body": "Water",
     "Inflow Spring/Face": "Bottom", "Inflow Spring/Region": "x > 0.5", "Inflow Spring/Speed": 2, "Inflow Spring/End time": 5e-6, "Water/Region": 0},
    {"Soil/Grain density": 2000, "Inflow Jet/Body": "Soil", "Inflow Jet/Face": "Right", "Inflow Jet/Section": 0.5, "Inflow Jet/Region": "y < 0.3",
     "Inflow Jet/Speed": "sin(t)^2"},
    {"Dimension": 3, "Gravity": "0, 0, -9.81", "Body force": "0; sin(t); 0", "Mesh/Lower corner": "0, 0, 0", "Mesh/Upper corner": "1, 1, 1",
     "Mesh/Cell size": 0.5, "Soil/Region": "z < 0.5", "Soil/Points per cell": 2, "Water/Point sets": "single", "Transfer/Method": "TPIC"})]
VALUES = ["0", "0.5", "0.3", "10", "1e3", "1e4", "-1", "1", "2", "3", "0.25", "0.1", "24", "1e-300", "1e-12", "1e6", "1e300", "-1e300", "nan", "inf", "1e999",
          "0,5", "1 m", "", "0x10", "1e", "{1}", "none", "same", "K0", "1, 1", "0, 0, 1", "1,1,", "-1, -1", "1e5, 1e5", "friction 24", "drained 1e", "open",
          "\u00b5", "#", "\\"]
PIECES = ["x", "y", "z", "t", "0.5", "0,5", "1", "0", "-", "+", "*", "/", "^", "<", ">", "=", "==", "&&", "||", "&", "(", ")", ",", ";", "if(", "log(", "sqrt(",
          "sin(", "max(", "pi", "e", " ", "nan", "1/0", "!", "?", ":", "rand()", "x < 0.5", "y < 0.5"]
BYTES = [b"\xef\xbb\xbf", b"\xff\xfe", b"\r", b"\0", b"\t", b"\xc2\xa0", b"\xe2\x80\x9c", b"\\", b"=", b"#", b"end\n", b"\n"]
INCLUDED = ["part.prm", "./part.prm", "case.prm", "missing.prm", ".", "", "/dev/zero"]
PARTS = ["", "set End time = 2e-5\n", "include case.prm\n", "include part.prm\n", "subsection Soil\n", "end\n", "\ufeffset End time = 2e-5\n", "set Ende = 1\n"]
# Where the end of the file is open or wrong, these statements do not read either: then nothing runs long.
SHORT = "\nset End time = 1e-9\nsubsection Output\n  set Graphics = none\nend\nsubsection Settling\n  set Maximum time = 0\nend\n"


def random_value(chance):
    return "".join(chance.choices(PIECES, k=chance.randint(1, 7))) if chance.random() < 1 / 8 else chance.choice(VALUES)


def change_entry(chance, lines, entries):
    """Another value for an entry that the case sets, or an entry that is there and the case does not set."""
    number = chance.randrange(len(lines))
    name, equals, _ = lines[number].partition("=")
    if equals:
        lines[number] = f"{name}= {random_value(chance)}"
    else:
        lines += set_entries("", {chance.choice(entries): random_value(chance)}).split("\n")


def change_expression(chance, lines):
    for number, line in enumerate(lines):
        if any(word in line for word in ("Region", "velocity", "Traction", "force")) and chance.random() < 0.5:
            place = chance.randrange(line.find("=") + 1, len(line) + 1)
            lines[number] = line[:place] + chance.choice(PIECES) + line[place:]


def change_structure(chance, lines):
    one, other = chance.randrange(len(lines)), chance.randrange(len(lines))
    kind = chance.randrange(3)
    if kind == 0:
        del lines[one]
    elif kind == 1:
        lines[one], lines[other] = lines[other], lines[one]
    else:
        lines.insert(one, lines[other])


def change_bytes(chance, content):
    one, other = chance.randrange(len(content)), chance.randrange(len(content))
    return chance.choice((content[:one] + content[one + chance.randint(1, 3):],
                          content[:one] + chance.choice(BYTES) + content[one:], chance.choice(BYTES) + content,
                          content[:one] + bytes([chance.randrange(256)]) + content[one + 1:], content[:one],
                          content[:one] + content[other:other + 1] + content[one + 1:]))


def random_case(chance, entries):
    """The contents of a case and of a file that it may include."""
    content, part = chance.choice(BASES).encode(), ""
    for _ in range(chance.choice((1, 1, 2))):
        lines, kind = content.decode(errors="surrogateescape").split("\n"), chance.randrange(10)
        if kind < 4:
            change_entry(chance, lines, entries)
        elif kind < 6:
            change_expression(chance, lines)
        elif kind < 7:
            change_structure(chance, lines)
        elif kind == 9:
            lines.insert(chance.randrange(len(lines) + 1), "include " + chance.choice(INCLUDED))
            part = chance.choice(PARTS)
        content = "\n".join(lines).encode(errors="surrogateescape")
        if kind in (7, 8) and content:
            content = change_bytes(chance, content)
    return content + b"\n", part


def fault_of(scree, folder):
    """What is wrong with how the program received the case of a folder; empty: nothing."""
    with open(folder / "case.prm", "ab") as file:
        file.write(SHORT.encode())
    try:
        run = subprocess.run([scree, "case.prm"], cwd=folder, capture_output=True, timeout=60, check=False)
    except subprocess.TimeoutExpired:
        return "it hangs"
    error = run.stderr.decode(errors="replace")
    if run.returncode == 0:
        return error and f"it ends well, but says {error}"
    if run.returncode != 1:
        return f"exit code {run.returncode}: {error}"
    return "" if error.startswith("scree: ") and "----" not in error else f"no error in words: {error}"


def main():
    fuzz, scree, count, n_started = *sys.argv[1:3], *map(int, sys.argv[3:])
    os.environ["SCREE_PROGRAMS"] = os.path.dirname(scree)
    chance, entries, folders = random.Random(20240229), sorted(known_entries({})), pathlib.Path("cases").resolve()
    shutil.rmtree(folders, ignore_errors=True)
    for number in range(count):
        folder = folders / str(number)
        folder.mkdir(parents=True)
        content, part = (BASES[number].encode() + b"\n", "") if number < len(BASES) else random_case(chance, entries)
        (folder / "case.prm").write_bytes(content)
        (folder / "part.prm").write_text(part, encoding="utf-8")
    judged = subprocess.run([fuzz, folders, str(count), str(len(BASES))], check=False).returncode
    faults = [f"{number}: {fault}" for number in range(n_started) for fault in [fault_of(scree, folders / str(number))] if fault]
    print("\n".join([*faults, f"{n_started} runs, of them wrong {len(faults)}"]))
    sys.exit(bool(judged or faults))


if __name__ == "__main__":
    main()

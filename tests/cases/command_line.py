# SPDX-License-Identifier: LGPL-2.1-or-later
"""command_line.py SCREE LAUNCHER TEST: what the programs print.

Each test is a function below (case_tools.py).
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys

from scree.results import read_table
from scree.variants import read_entries, set_entries

from case_tools import HERE, LAUNCHER, SCREE, check, log_of

ELEMENT = str(pathlib.Path(SCREE).with_name("scree-element"))


def printed(*command, wanted=0):
    """What a command prints; it ends with the wanted exit code."""
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    check(done.returncode == wanted, f"{command}: exit code {done.returncode}, {done.stderr}")
    return done.stdout


def refused(*command):
    """The error of a command."""
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    check(done.returncode == 1, f"accepted: {command}")
    return done.stderr


def require(text, *patterns):
    """Each pattern is a whole line of the text."""
    for pattern in patterns:
        check(re.search(f"^{pattern}$", text, re.MULTILINE), f"there is no line {pattern} in {text}")


def version():
    """Both programs print version, commit, libraries, compiler and build type, once on any number of ranks; -h is --help."""
    text, number = printed(SCREE, "--version"), r"\d+\.\d+\.\d+"
    wanted = (rf"Scree {number} \(commit ([0-9a-f]{{7,}}(-dirty)?|unknown)\)\ndeal\.II {number}, Trilinos {number}, p4est {number}, GDAL {number}\n"
              r"[A-Za-z]+ [0-9.]+, (Release|Debug)\n")
    check(re.fullmatch(wanted, text), text)
    # The commit that is checked out, although it may be younger than the build folder.
    asked = [subprocess.run(["git", "-C", HERE, "rev-parse", *options], capture_output=True, text=True, check=False) for options in
             (("--show-prefix",), ("--short", "HEAD"))]
    if asked[0].returncode == 0 and asked[0].stdout == "tests/cases/\n":
        check("(commit " + asked[1].stdout.strip() in text, f"{text} is not of commit {asked[1].stdout}")
    check(printed(*LAUNCHER, "2", SCREE, "--version") == text == printed(ELEMENT, "--version"), "two ranks or the other program print something else")
    for program in (SCREE, ELEMENT):
        text = printed(program, "--help")
        check(text == printed(program, "-h") and text.startswith(f"Usage: {pathlib.Path(program).name} "), text)


def print_parameters():
    """All entries, one subsection, those of a case, and the names of subsections."""
    def shown(*arguments):
        return printed(SCREE, *arguments, "--print-parameters")
    require(shown(), "subsection Mesh")
    step, nested = printed(SCREE, "--print-parameters", "Time step"), printed(SCREE, "--print-parameters", "Soil/Initial state")
    check("set Courant number" in step and len(re.findall("^ *subsection ", step, re.MULTILINE)) == 1, step)
    check("set K0 " in nested and "Courant number" not in nested, nested)
    names = shown("--sections")
    require(names, "Mesh", "Time step", "Soil", "Soil/Initial state", "Water/Pressure")
    for name in names.splitlines()[:5]:  # each name is one that prints
        check(re.search("^ *subsection ", printed(SCREE, "--print-parameters", name), re.MULTILINE), name)

    case = {"Bodies": "Sand", "End time": 2, "Mesh/Upper corner": "1, 1", "Mesh/Cell size": 0.125, "Sand/Region": "y < 0.5", "Sand/Grain density": 2611}
    pathlib.Path("case.prm").write_text(set_entries("", case) + "\n", encoding="utf-8")
    sand = printed(SCREE, "case.prm", "--print-parameters", "Sand")
    check(sand == printed(SCREE, "--print-parameters", "Sand", "case.prm") and re.search("Grain density *= 2611", sand), sand)
    # A subsection that the case does not have yet: the defaults, to be added.
    check(re.search("Hydraulic conductivity *= auto", printed(SCREE, "case.prm", "--print-parameters", "Water")), "no defaults of Water")
    require(shown("--sections", "case.prm"), "Sand/Initial state")


def screen():
    """The layout of the screen; log.txt has what it has, and details."""
    case = {"End time": 0.02, "Output directory": "results", "Mesh/Upper corner": "2, 1", "Mesh/Cell size": 0.125, "Soil/Region": "x < 1 && y < 0.5",
            "Output/Statistics interval": 0.005}
    pathlib.Path("case.prm").write_text(set_entries("", case) + "\n", encoding="utf-8")
    row = r" +0\.020000 +100 % +\d+ +[0-9.]+e-0\d +0\.\d+ +[0-9.e-]+ +0 s"
    for ranks, named in ((1, "1 rank"), (2, "2 ranks")):
        text = printed(*LAUNCHER, str(ranks), SCREE, "case.prm")
        print(text)
        check(re.match(rf"(Setting up case\.prm \.\.\.\s+)?Scree [0-9.]+ \((unknown|[0-9a-f]+(-dirty)?)\), {named} +20\d\d-[0-9-]+ [0-9:]+ \w+\nCase        case\.prm -> results\n"
                       r"Model       2D plane strain, dry, AFLIP \(PIC rate auto: [0-9.]+ 1/s\), [1-9]\d* soil points\nMesh        128 cells of 0\.125 m\n"
                       r"Memory      [1-9]\d* MB estimated\n", text), text)
        require(text, r" +time \(s\) +done +step +dt \(s\) +toe moved \(m\) +kinetic \(J\) +remaining", row,
                r"Finished    wall time [0-9.]+ s, [1-9]\d* steps, \d+ ns per point and step and core", r"Limits      time step limited by wave speed \(100 % of steps\)",
                r"Checks      resolution: Stress oscillation \d\.\d+ \(bound 0\.2\); what to do: .*",
                r" +within bounds: mass balance [0-9.e-]+; momentum balance [0-9.e-]+;.*",
                r"Results     results/solution/points\.pvd \(ParaView\), statistics\.csv, log\.txt")
        check("points of soil lost 0" in " ".join(text.split()) and not re.search(r"deal\.II|points to grid|Soil at", text), text)
        # Numbers end below the ends of their headings.
        check(len({len(line) for line in text.splitlines() if " time (s) " in line or re.fullmatch(row, line)}) == 1, text)
        check(max(map(len, text.splitlines())) <= 100, text)
        log = log_of(pathlib.Path("results"))
        rest = iter(log.splitlines())
        lines = [line for line in text.splitlines() if not line.startswith("Setting up ")]
        check(all(line in rest for line in lines), f"the screen is no excerpt of {log}")
        for detail in (r"Libraries   deal\.II.*", r"Compiler    \w+ [0-9.]+, (Release|Debug), flags .*-O\d.*", r"Process     \d+ on \S+ \(first rank\)",
                       r"In use      [1-9]\d+ MB at the start \(all ranks\)", ".*points to grid.*", "Soil at the end.*", "Largest memory.*"):
            require(log, detail)

    # Soil that falls out of the box exceeds a bound.
    pathlib.Path("case.prm").write_text(set_entries("", {**case, "End time": 0.5, "Soil/Region": "x > 1 && y < 0.5", "Boundaries/Right": "open"}), encoding="utf-8")
    text = printed(SCREE, "case.prm")
    require(text, r"            resolution: points of soil lost [1-9]\d* \(bound 0\);.*", "            within bounds: mass balance.*")
    found = re.search(r'a lower bound: (\S+) % of the soil has left the box, most of it through the wall x = 2 m \("Upper corner"\)', " ".join(text.split()))
    table = read_table(pathlib.Path("results/statistics.csv"))
    share = 100 * table["Mass lost (kg)"][-1] / table["Mass (kg)"][0]
    check(found and abs(float(found[1]) / share - 1) < 0.01, f"{share} % lost: {text}")


def new_case():
    """--new lists scenes and writes the case of each, which runs; no file is replaced without being asked. The program alone is enough."""
    shutil.rmtree("new", ignore_errors=True)
    pathlib.Path("new/sub").mkdir(parents=True)
    os.chdir("new")
    scree = shutil.copy(SCREE, pathlib.Path("copy").resolve())
    scenes = re.findall(r"^  ([a-z_]+) ", printed(scree, "--new"), re.MULTILINE)
    check(len(scenes) >= 12, f"scenes: {scenes}")
    for scene in scenes:
        check(f"Written: {scene}.prm" in printed(scree, "--new", scene), f"{scene} is not written")
        text, entries = pathlib.Path(f"{scene}.prm").read_text(encoding="utf-8"), read_entries(f"{scene}.prm")
        require(text, f"set Output directory = results/{scene}", "#.*")
        check(20 <= float(entries["End time"]) / float(entries["Output/Interval"]) <= 32.001, f"pictures of {scene}")
        pathlib.Path("short.prm").write_text(set_entries(text, {"End time": 0.2}), encoding="utf-8")
        require(printed(scree, "short.prm"), "Checks.*", r"Finished.* ([2-9]|[1-9]\d+) steps.*")
    check(pathlib.Path("mountain.asc").stat().st_size > 0, "the mountain has no raster")
    # The command that is named next is not refused: --advise is, where points enter.
    require(printed(scree, "--new", "debris_flow", "flow.prm", "--overwrite"), "Next: scree flow.prm")
    require(printed(scree, "--new", "slope", "bank.prm"), "Next: scree bank.prm --advise, then scree bank.prm")
    # A changed file stays; an equal one is no obstacle.
    printed(scree, "--new", "slope")
    mine = pathlib.Path("slope.prm").read_text(encoding="utf-8") + "# mine\n"
    pathlib.Path("slope.prm").write_text(mine, encoding="utf-8")
    check(re.search("slope.prm: the file exists.*--overwrite", refused(scree, "--new", "slope")), "a changed file is not named")
    check(pathlib.Path("slope.prm").read_text(encoding="utf-8") == mine, "a changed file is replaced")
    printed(scree, "--overwrite", "--new", "slope")
    check("mine" not in pathlib.Path("slope.prm").read_text(encoding="utf-8"), "--overwrite does not replace it")
    # Another name, and other ranks: one of them writes.
    printed(*LAUNCHER, "2", scree, "sub/bank.prm", "--new", "slope")
    require(pathlib.Path("sub/bank.prm").read_text(encoding="utf-8"), "set Output directory = results/bank")
    printed(scree, "--new", "terrain", "sub/hill.prm")
    check(pathlib.Path("sub/release.asc").stat().st_size > 0, "no raster beside the case")
    check("cannot be written" in refused(scree, "--new", "slope", "nowhere/slope.prm"), "a folder that is not there")


globals()[sys.argv[3]]()

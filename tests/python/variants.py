# SPDX-License-Identifier: LGPL-2.1-or-later
"""Cases and their variants: entries, includes, paths."""

import pathlib
import re

from scree.variants import read_case, read_entries, set_entry, write_variant

from test_tools import raises, run_tests


CASES = pathlib.Path(__file__).resolve().parents[2] / "prm"


def write(name, text):
    pathlib.Path(name).parent.mkdir(parents=True, exist_ok=True)
    pathlib.Path(name).write_text(text, encoding="utf-8")


def test_entries():
    text = "set End time = 2 # s\nSUBSECTION Mesh\n  set Cell size = \\\n    0.1\nend"
    write("case.prm", text)
    assert read_entries("case.prm") == {"End time": "2", "Mesh/Cell size": "0.1"}
    assert set_entry(text, "Mesh/Cell size", 0.2).endswith("  set Cell size = 0.2\nend")
    for key, value in (("Mesh/Upper corner", "1, 1"), ("Soil/Nor-Sand/M", "1.2"), ("Dimension", "2")):
        write("new.prm", set_entry(text, key, value))
        assert read_entries("new.prm") == {**read_entries("case.prm"), key: value}


def test_includes():
    """Later settings win; a variant holds what its base includes, and finds the files that base and included file name; what names no file
    stays as it is."""
    write("base/parts/bed.prm", "subsection Bed\n  set Profile = \\\n    bed.csv # corners\n  set Raster = none.asc\n  set Type = fixed\nend\n")
    write("base/parts/bed.csv", "0, 0\n1, 1\n")
    write("base/case.prm", "include parts/bed.prm\nsubsection Bed\n  set Type = friction\nend\n")
    assert read_entries("base/case.prm") == {"Bed/Profile": "parts/bed.csv", "Bed/Raster": "none.asc", "Bed/Type": "friction"}
    write("new/deep/variant.prm", "")
    write_variant("base/case.prm", "new/deep/variant.prm", {"Bed/Type": "free slip"})
    wanted = {"Bed/Profile": "../../base/parts/bed.csv", "Bed/Raster": "none.asc", "Bed/Type": "free slip"}
    assert read_entries("new/deep/variant.prm") == wanted
    assert "include" not in read_case("new/deep/variant.prm")
    write("loop.prm", "include loop.prm\n")
    raises("loop", read_case, "loop.prm")


def test_list_of_cases():
    """prm/README.md names each case once, in the section of its folder; each of them reads."""
    listed = re.sub(r"\n## .*", lambda found: found.group(0) + "@", (CASES / "README.md").read_text(encoding="utf-8")).split("@")
    found = {}
    for section in listed[1:]:
        folder = re.search(r"^In `(\w+)`", section, re.MULTILINE)
        for name in re.findall(r"^\| `(\w+)` \|", section, re.MULTILINE):
            found[name] = CASES / (folder.group(1) if folder else "") / f"{name}.prm"
    assert sorted(found.values()) == sorted(CASES.rglob("*.prm")), set(found.values()) ^ set(CASES.rglob("*.prm"))
    for case in found.values():
        assert "Output directory" in read_entries(case), case


def test_first_run():
    """The blocks of doc/first_run.md up to its run are the case that it writes, but for the comment at its head."""
    page = (CASES.parent / "doc" / "first_run.md").read_text(encoding="utf-8").split("\n## Run\n")[0]
    blocks = re.findall(r"```text\n( *(?:set|subsection) .*?)```", page, re.DOTALL)
    case = (CASES / "slopes" / "first_slope.prm").read_text(encoding="utf-8")
    wanted = [line for line in case.splitlines() if line and not line.startswith("#")]
    assert [line for line in "".join(blocks).splitlines() if line] == wanted


run_tests(globals())

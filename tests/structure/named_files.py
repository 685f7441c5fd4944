# SPDX-License-Identifier: LGPL-2.1-or-later
"""named_files.py ROOT: every entry below ROOT that names a file is declared by add_file_entry(), so that its path counts from the case and a
checkpoint knows its contents; and what it names is opened by open_file()."""

import pathlib
import re
import sys

# What is opened there is no file of an entry: cases, also those that --new writes, a raster's .prj, /proc, the run folder.
OPENED_ELSEWHERE = {"program/command_line.cc", "input/number_table.cc", "input/case_entries.cc", "input/input_file.cc", "geometry/raster.cc", "case/memory.cc"}


def faults(root):
    for path in sorted((root / "source").rglob("*.cc")):
        text, name = path.read_text(encoding="utf-8"), str(path.relative_to(root / "source"))
        for call in re.finditer(r"prm\.add_parameter\((.*?)\);", text, re.DOTALL):
            strings = " ".join(re.findall(r'"((?:[^"\\]|\\.)*)"', call.group(1)))
            if re.search(r"\b(file|STL|raster) (of|with)\b", strings, re.IGNORECASE):
                yield f"{name}, line {text[:call.start()].count(chr(10)) + 1}: this entry names a file. Declare it by add_file_entry()."
        if "std::ifstream in(" in text and name not in OPENED_ELSEWHERE and not name.startswith("io/"):
            yield f"{name}: a file is opened without open_file()."


def main():
    found = list(faults(pathlib.Path(sys.argv[1])))
    sys.exit("\n".join(found) or 0)


if __name__ == "__main__":
    main()

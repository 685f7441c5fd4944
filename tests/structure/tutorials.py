#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""tutorials.py ROOT FOLDER: what the pages of FOLDER quote exists in ROOT. Whether their commands run, tests/python/documented_commands.py tells.

- Each file of prm/ that it names is there.
- Each line `set ...` of a block ```text is in a case that the page names, apart from blanks and comments.
"""

import pathlib
import re
import sys

BLOCK = re.compile(r"^```(\w+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)


def statements(text):
    """The lines of a case or of a part of it, without comments and repeated blanks."""
    lines = (" ".join(line.split("#")[0].split()) for line in text.splitlines())
    return {line for line in lines if line.startswith(("set ", "include "))}


class Page:
    """A tutorial, with the cases that its text names and their lines."""

    def __init__(self, path, root):
        self.path, self.root, self.text = path, root, path.read_text(encoding="utf-8")
        self.cases = {name for name in re.findall(r"\bprm/[\w/.-]+\.prm\b", self.text) if (root / name).exists()}
        self.lines = set().union(*(statements((root / name).read_text(encoding="utf-8")) for name in self.cases))

    def blocks(self, kind):
        return [text for language, text in BLOCK.findall(self.text) if language == kind]

    def faults(self):
        for name in re.findall(r"\bprm/[\w/.-]+\.\w+\b", self.text):
            if not (self.root / name).exists():
                yield f"there is no file {name}"
        for block in self.blocks("text"):
            for line in sorted(statements(block) - self.lines):
                yield f"no case of the page has the line: {line}"


def main():
    root, folder = map(pathlib.Path, sys.argv[1:])
    pages = [Page(path, root) for path in sorted(folder.glob("*.md"))]
    found = [f"{page.path.name}: {fault}." for page in pages for fault in page.faults()]
    print(f"{len(pages)} pages")
    sys.exit("\n".join(found) or not pages)


if __name__ == "__main__":
    main()

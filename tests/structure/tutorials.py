#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""tutorials.py ROOT FOLDER: what the pages of FOLDER quote exists in ROOT. Whether its commands run, tests/python/documented_commands.py tells.

- Each case it names is in the repository, or an earlier scree-variant of the page has written it.
- Each run folder it names is the output directory of a case that the page names or writes.
- Each line `set ...` of a block ```text is in a case that the page names, apart from blanks and comments.
"""

import pathlib
import re
import shlex
import sys

BLOCK = re.compile(r"^```(\w+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)


def statements(text):
    """The lines of a case or of a part of it, without comments and repeated blanks."""
    lines = (" ".join(line.split("#")[0].split()) for line in text.splitlines())
    return {line for line in lines if line.startswith(("set ", "include "))}


def output_directories(lines):
    return {line.split("=")[1].strip().rstrip("/") for line in lines if line.startswith("set Output directory =")}


class Page:
    """A tutorial, with what its text names and what its commands have written so far."""

    def __init__(self, path, root):
        self.path, self.root, self.text = path, root, path.read_text(encoding="utf-8")
        self.cases = {name for name in re.findall(r"\bprm/[\w/.-]+\.prm\b", self.text) if (root / name).exists()}
        self.lines = set().union(*(statements((root / name).read_text(encoding="utf-8")) for name in self.cases))
        self.written, self.folders = set(), output_directories(self.lines)

    def blocks(self, kind):
        return [text for language, text in BLOCK.findall(self.text) if language == kind]

    def commands(self):
        for block in self.blocks("sh"):
            yield from filter(None, (line.strip() for line in block.replace("\\\n", " ").splitlines()))

    def faults_of(self, command):
        words = shlex.split(command, comments=True)
        if words[0] == "build/scree-variant":
            self.written.add(words[2])
            self.folders |= output_directories("set " + word for word in words[3:])
        for word in words[1:]:
            if word.endswith(".prm") and word not in self.written and not (self.root / word).exists():
                yield f"there is no case {word}"
            if word.startswith("results/") and re.sub(r"(/safety/(rests|fails))?/?$", "", word) not in self.folders:
                yield f"no case of the page writes {word}"

    def faults(self):
        for name in re.findall(r"\bprm/[\w/.-]+\.\w+\b", self.text):
            if not (self.root / name).exists():
                yield f"there is no file {name}"
        for command in self.commands():
            yield from self.faults_of(command)
        for block in self.blocks("text"):
            for line in sorted(statements(block) - self.lines):
                yield f"no case of the page has the line: {line}"


def main():
    root, folder = map(pathlib.Path, sys.argv[1:])
    pages = [Page(path, root) for path in sorted(folder.glob("*.md"))]
    n_commands, found = 0, []
    for page in pages:
        n_commands += len(list(page.commands()))
        found += [f"{page.path.name}: {fault}." for fault in page.faults()]
    print(f"{len(pages)} pages, {n_commands} commands")
    sys.exit("\n".join(found) or not n_commands)


if __name__ == "__main__":
    main()

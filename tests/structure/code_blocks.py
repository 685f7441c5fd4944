#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""code_blocks.py [--write] ROOT PAGE...: code blocks of pages are what the source says.

Before such a block stands a line `<!-- code: FILE FUNCTION -->`; the block has the definition of FUNCTION (as in `Simulation<dim>::advance`) from
FILE, without its indentation. --write puts the present definition in. Without FUNCTION the block is an excerpt of FILE: its lines stand there in
this order, whatever their indentation, and a line `...` stands for what is left out.
"""

import pathlib
import re
import sys

BLOCK = re.compile(r"<!-- code: (\S+) (\S+) -->\n```cpp\n(.*?)```\n", re.DOTALL)


EXCERPT = re.compile(r"<!-- code: (\S+) -->\n```cpp\n(.*?)```\n", re.DOTALL)


def missing_line(root, file, block):
    """The first line of an excerpt that FILE does not have behind those before it; None if it has all."""
    rest = iter([line.strip() for line in (root / file).read_text(encoding="utf-8").splitlines()])
    wanted = [line.strip() for line in block.splitlines()]
    return next((line for line in wanted if line not in ("", "...") and line not in rest), None)


def definition(root, file, function):
    """The lines of a function's definition, from its `template` or type to the brace that ends it."""
    lines = (root / file).read_text(encoding="utf-8").splitlines(keepends=True)
    for number, line in enumerate(lines):
        if function + "(" not in line or line.rstrip().endswith(";"):
            continue
        indent = line[:len(line) - len(line.lstrip())]
        last = next((end for end in range(number, len(lines)) if lines[end].rstrip() in (indent + "}", indent + "};")), None)
        if last is not None:
            first = number - 1 if lines[number - 1].lstrip().startswith("template") else number
            return "".join(each.removeprefix(indent) for each in lines[first:last + 1])
    sys.exit(f"{file} has no definition of {function}.")


def main():
    arguments = sys.argv[1:]
    write = "--write" in arguments
    root, *pages = (pathlib.Path(argument) for argument in arguments if argument != "--write")
    n_blocks, wrong = 0, []
    for page in pages:
        text = page.read_text(encoding="utf-8")
        for file, function, block in BLOCK.findall(text):
            n_blocks += 1
            code = definition(root, file, function)
            if block != code:
                wrong.append(f"{page.name}: {function} is not what {file} says (code_blocks.py --write mends it).")
                text = text.replace(f"{function} -->\n```cpp\n{block}", f"{function} -->\n```cpp\n{code}")
        for file, block in EXCERPT.findall(text):
            n_blocks += 1
            if (line := missing_line(root, file, block)) is not None:
                wrong.append(f"{page.name}: {file} has no line \"{line}\" there.")
        if write:
            page.write_text(text, encoding="utf-8")
    if not n_blocks:
        wrong.append("No code blocks were found.")
    sys.exit(0 if write else "\n".join(wrong) or 0)


if __name__ == "__main__":
    main()

#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""code_blocks.py [--write] ROOT PAGE...: code blocks of pages are what the source says.

Before such a block stands a line `<!-- code: FILE FUNCTION -->`; the block has the definition of FUNCTION (as in `Simulation<dim>::advance`) from
FILE, without its indentation. --write puts the present definition in.
"""

import pathlib
import re
import sys

BLOCK = re.compile(r"<!-- code: (\S+) (\S+) -->\n```cpp\n(.*?)```\n", re.DOTALL)


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
        if write:
            page.write_text(text, encoding="utf-8")
    if not n_blocks:
        wrong.append("No code blocks were found.")
    sys.exit(0 if write else "\n".join(wrong) or 0)


if __name__ == "__main__":
    main()

# SPDX-License-Identifier: LGPL-2.1-or-later
"""modules.py ROOT ORDER: every include of scree's own files below ROOT goes down the order of modules.

ORDER is a text (doc/developer/index.md) with a chain "a, b <- c <- d", lowest modules first, whose further lines begin with
"<-", and lines "e -> a, b" for modules beside it.
"""

import pathlib
import re
import sys


def read_order(text):
    """{module: the modules that it may know}."""
    known, below = {}, set()
    chain = re.search(r"^\w[\w, ]*(\s*<- [\w, ]+)+$", text, re.MULTILINE)
    if not chain:
        sys.exit("there is no chain \"a, b <- c\" with the order of the modules")
    for level in chain.group().split("<-"):
        modules = set(re.findall(r"\w+", level))
        known.update({module: set(below) for module in modules})
        below |= modules
    for module, others in re.findall(r"^(\w+) -> ([\w, ]+)$", text, re.MULTILINE):
        known[module] = set(re.findall(r"\w+", others))
    return known


def module_of(path, known):
    """A file's module: its folder; a file outside folders is its own, if the order names it, and else of "root"."""
    if len(path.parts) > 1:
        return path.parts[0]
    return path.stem if path.stem in known else "root"


def faults(root, known):
    for folder in ("include/scree", "source"):
        for file in sorted(file for file in (root / folder).rglob("*") if file.suffix in (".h", ".cc")):
            module = module_of(file.relative_to(root / folder), known)
            for number, line in enumerate(file.read_text(encoding="utf-8").splitlines(), 1):
                include = re.match(r'\s*#\s*include\s*[<"]scree/([^>"]+)', line)
                if not include:
                    continue
                other = module_of(pathlib.PurePath(include.group(1)), known)
                place, unknown = f"{file.relative_to(root)}, line {number}", {module, other} - set(known)
                if unknown:
                    yield f"{place}: the order does not know module {' and '.join(sorted(unknown))}"
                elif other != module and other not in known[module]:
                    yield f"{place}: {module} must not know {other} ({include.group(1)})"


def main():
    order = read_order(pathlib.Path(sys.argv[2]).read_text(encoding="utf-8"))
    found = list(faults(pathlib.Path(sys.argv[1]), order))
    print("\n".join(found) or "All includes go down the order of modules.")
    sys.exit(bool(found))


main()

#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""site.py ROOT [FOLDER]: links between the pages of ROOT hold; with FOLDER, Sphinx builds doc/ into it without a warning.

Links are those of doc/, prm/ and the texts at the top: their files exist, and so do the headings that they name.
Exit code 77: the links hold, but Sphinx or what conf.py needs is not installed.
"""

import importlib.util
import pathlib
import re
import subprocess
import sys

MODULES = ("sphinx", "myst_parser", "furo", "sphinxcontrib.bibtex")
# Not checked: texts that become part of a page elsewhere.
NOT_CHECKED = ("doc/parameters/intro/",)


def text_without_blocks(page):
    """A page without its blocks of code."""
    return re.sub(r"^(`{3,}).*?^\1`*$", "", page.read_text(encoding="utf-8"), flags=re.MULTILINE | re.DOTALL)


def text_without_code(page):
    """The same, and without code within lines."""
    return re.sub(r"`[^`\n]*`", "", text_without_blocks(page))


def anchors(page):
    """The anchors of a page's headings, as GitHub and MyST name them."""
    text = text_without_blocks(page)
    names = set(re.findall(r"^\(([\w-]+)\)=$", text, re.MULTILINE))
    for heading in re.findall(r"^#{1,6} +(.+?) *$", text, re.MULTILINE):
        plain = re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", heading).replace("`", "").lower()
        names.add(re.sub(r"\s", "-", re.sub(r"[^\w\s-]", "", plain)))
    return names


def dead_links(root):
    pages = sorted([*root.glob("*.md"), *root.glob("prm/**/*.md"), *root.glob("doc/**/*.md")])
    n_links = 0
    for page in pages:
        if str(page.relative_to(root)).startswith(NOT_CHECKED):
            continue
        for link in re.findall(r"\]\(([^)\s]+)\)", text_without_code(page)):
            if re.match(r"[a-z]+:", link):
                continue
            n_links += 1
            file, _, anchor = link.partition("#")
            target = page.parent / file if file else page
            if not target.exists():
                yield f"{page.relative_to(root)}: {link} does not exist."
            elif anchor and target.suffix == ".md" and anchor not in anchors(target):
                yield f"{page.relative_to(root)}: {link}: there is no such heading."
    print(f"{len(pages)} pages, {n_links} links")
    if not n_links:
        yield "There are no links."


def installed(module):
    try:
        return importlib.util.find_spec(module) is not None
    except ModuleNotFoundError:
        return False


def main():
    root, *folders = map(pathlib.Path, sys.argv[1:])
    faults = list(dead_links(root))
    if not folders:
        sys.exit("\n".join(faults) or 0)
    folder = folders[0]
    missing = [module for module in MODULES if not installed(module)]
    if missing and not faults:
        print(f"Skipped: Python has no {', '.join(missing)}. On Debian: the packages that tests/run.sh installs.")
        sys.exit(77)
    if not missing:
        built = subprocess.run([sys.executable, "-m", "sphinx", "-q", "-n", "-W", "--keep-going", "-b", "html", "-d", str(folder / "doctrees"),
                                str(root / "doc"), str(folder / "html")], capture_output=True, text=True, check=False)
        faults += built.stderr.splitlines() if built.returncode else []
        if not (folder / "html" / "index.html").exists():
            faults.append("There is no index.html.")
    sys.exit("\n".join(faults) or 0)


if __name__ == "__main__":
    main()

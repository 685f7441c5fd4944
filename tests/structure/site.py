#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""site.py ROOT [FOLDER]: links between the pages of ROOT hold; with FOLDER, Sphinx builds doc/ into it without a warning.

Links are those of doc/, prm/ and the texts at the top: their files exist, and so do the headings that they name.
The site is complete without a network. If chromium is installed, it shows some pages: without errors, with all equations and no wider
than the window; they are then in FOLDER/browser.png.
Exit code 77: the links hold, but Sphinx or what conf.py needs is not installed.
"""

import importlib.util
import json
import pathlib
import re
import shutil
import subprocess
import sys

# Words of other programs that the search finds on a page for users.
SEARCHED = ("retain", "pile", "excav", "runout", "permeabl", "uncertainti", "mont", "calibr")
MODULES = ("sphinx", "myst_parser", "sphinx_rtd_theme", "sphinxcontrib.bibtex")
MATHJAX = pathlib.Path("/usr/share/javascript/mathjax")
SHOWN = ("running", "theory/two_phases", "validation", "parameters/water")
WIDTHS = (1280, 400)
HEIGHT = 1200
# Not checked: texts that become part of a page elsewhere.
NOT_CHECKED = ("doc/parameters/intro/", "doc/studies/intro/")
# What a page says of itself; errors are those of scripts and of files that are not there.
REPORT = """<script>
const errors = [];
addEventListener("error", event => errors.push(event.message || event.target.src || event.target.href), true);
addEventListener("load", () => MathJax.Hub.Queue(() => {
  const equations = [...document.querySelectorAll(".math")], width = document.documentElement.scrollWidth;
  const raw = equations.filter(equation => !equation.querySelector("svg path, svg use"));
  if (raw.length > 0 || equations.length == 0) errors.push(raw.length + " of " + equations.length + " equations are raw");
  if (width > innerWidth) errors.push("the page is " + width + " pixels wide");
  parent.postMessage(document.title + ", " + innerWidth + " pixels: " + (errors.join(", ") || "complete"), "*");
}));
</script>
"""
# Pages side by side, and what they say.
WINDOW = """<!DOCTYPE html><body style="margin: 0">
<script>addEventListener("message", event => document.body.append(event.data, document.createElement("br")));</script>
"""


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


def build(root, source, folder):
    """Sphinx's complaints about a site of the pages in source."""
    built = subprocess.run([sys.executable, "-m", "sphinx", "-q", "-n", "-W", "--keep-going", "-b", "html", "-c", str(root / "doc"),
                            "-d", str(folder / "doctrees"), str(source), str(folder / "html")], capture_output=True, text=True, check=False)
    if built.returncode:
        yield from built.stderr.splitlines()
    elif not (folder / "html" / "index.html").exists():
        yield "There is no index.html."


def lost_text(root, folder):
    """A page with text that Markdown's extensions could take for something else."""
    page = folder / "source" / "index.md"
    page.parent.mkdir(parents=True, exist_ok=True)
    page.write_text("# Page\n\nA share of 5\n% of the mass.\n", encoding="utf-8")
    yield from build(root, page.parent, folder)
    if "% of the mass" not in (folder / "html" / "index.html").read_text(encoding="utf-8"):
        yield "A line of text that begins with % is not in its page."


def needs_network(site):
    for file in [*site.rglob("*.html"), *site.rglob("*.css")]:
        pattern = r"url\(['\"]?(?:/|https?:)[^)]*" if file.suffix == ".css" else r"<(?:script|link|img)[^>]* (?:src|href)=\"(?:/|https?:)[^\"]*"
        for found in re.findall(pattern, file.read_text(encoding="utf-8")):
            yield f"{file.relative_to(site)} needs a network or a server: {found}"


def not_searched(site):
    """Words of SEARCHED that the search does not find, and pages for developers that it does."""
    text = (site / "searchindex.js").read_text(encoding="utf-8")
    index = json.loads(text[text.index("(") + 1:text.rindex(")")])
    pages_of = {word: numbers if isinstance(numbers, list) else [numbers] for word, numbers in index["terms"].items()}
    for word in SEARCHED:
        if not any(found.startswith(word) for found in pages_of):
            yield f"The search does not find {word!r}."
    found = {index["docnames"][number] for numbers in pages_of.values() for number in numbers}
    yield from (f"The search finds {page}, a page for developers." for page in sorted(found) if page.startswith("developer/"))


def seen_in_browser(site, picture):
    browser = shutil.which("chromium")
    if not browser:
        print("Not seen in a browser: chromium is not installed.")
        return
    window = site / "window.html"
    with window.open("w", encoding="utf-8") as frames:
        frames.write(WINDOW)
        for page in SHOWN:
            text = (site / f"{page}.html").read_text(encoding="utf-8")
            (site / f"{page}.reporting.html").write_text(text.replace("<head>", "<head>" + REPORT, 1), encoding="utf-8")
            for width in WIDTHS:
                frames.write(f'<iframe src="{page}.reporting.html" style="border: 0; width: {width}px; height: {HEIGHT}px"></iframe>\n')
    shown = subprocess.run([browser, "--headless=new", "--no-sandbox", "--disable-gpu", "--hide-scrollbars", f"--user-data-dir={picture.parent / 'profile'}",
                            "--host-resolver-rules=MAP * ~NOTFOUND", "--virtual-time-budget=30000", f"--screenshot={picture}", "--dump-dom",
                            f"--window-size={sum(WIDTHS) + 20},{len(SHOWN) * HEIGHT + 200}", window.as_uri()],
                           capture_output=True, text=True, timeout=300, check=False)
    reports = re.findall(r"([^<>\n]* pixels: [^<>]*)<br>", shown.stdout)
    print("\n".join(reports))
    if sum(report.endswith(": complete") for report in reports) != len(SHOWN) * len(WIDTHS):
        yield f"Pages in a browser ({picture}): {reports or shown.stderr}"
    for file in [window, *site.rglob("*.reporting.html")]:
        file.unlink()


def main():
    root, *folders = map(pathlib.Path, sys.argv[1:])
    faults = list(dead_links(root))
    if not folders:
        sys.exit("\n".join(faults) or 0)
    folder = folders[0]
    missing = [module for module in MODULES if not installed(module)] + ([] if MATHJAX.is_dir() else ["libjs-mathjax"])
    if missing and not faults:
        print(f"Skipped: {', '.join(missing)} not installed. On Debian: the packages that tests/run.sh installs.")
        sys.exit(77)
    if not missing:
        faults += build(root, root / "doc", folder)
        faults += lost_text(root, folder / "lost_text")
    if not faults:
        faults += needs_network(folder / "html")
        faults += not_searched(folder / "html")
        faults += seen_in_browser(folder / "html", folder / "browser.png")
    sys.exit("\n".join(faults) or 0)


if __name__ == "__main__":
    main()

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Settings of Sphinx for the pages of this folder: cmake --build build --target site."""

import os
import pathlib
import re
import shutil

from docutils import nodes
from sphinx import addnodes

FOLDER = pathlib.Path(__file__).resolve().parent
VERSION = re.search(r"^project\(scree VERSION ([0-9.]+)", (FOLDER.parent / "CMakeLists.txt").read_text(encoding="utf-8"), re.MULTILINE)

project = "Scree"
author = "The Scree maintainers"
release = VERSION.group(1) if VERSION else ""

extensions = ["myst_parser", "sphinx.ext.mathjax", "sphinxcontrib.bibtex"]
myst_enable_extensions = ["dollarmath", "colon_fence", "html_image"]
myst_heading_anchors = 3
bibtex_bibfiles = ["references.bib"]
bibtex_default_style = "plain"
# Code in the pages is C++, shell, Python, cases of Scree (text) and nothing else.
highlight_language = "text"
# Texts that are parts of pages, data, and the former manual.
exclude_patterns = ["parameters/intro", "studies/reference"]

html_theme = "furo"
html_title = f"Scree {release}"
html_static_path = ["site.css"]
html_css_files = ["site.css"]
# Debian's MathJax where it is installed (libjs-mathjax), so that formulas show without a network; or else that of the network.
MATHJAX = pathlib.Path("/usr/share/javascript/mathjax")
MATHJAX_PARTS = ("MathJax.js", "config/TeX-AMS_CHTML.js", "extensions", "jax/element", "jax/input/TeX", "jax/output/CommonHTML", "fonts/HTML-CSS/TeX/woff")
if (MATHJAX / "MathJax.js").exists():
    html_static_path.append("mathjax.js")
    mathjax_path = "mathjax.js"
    mathjax2_config = {"tex2jax": {"processClass": "math|tex2jax_process|mathjax_process"}}
html_copy_source = False
html_show_copyright = False
html_show_sphinx = False


def keep_beside_contents(_, name, source):
    """Pages that their list links to and that do not stand in the contents: those of the studies, which scree-study writes."""
    if name.startswith("studies/") and name != "studies/pages/README":
        source[0] = "---\norphan: true\n---\n\n" + source[0]


def hand_out_files(app, tree):
    """Links to the list of cases go to its page here; to other files outside this folder become downloads; to folders, plain text."""
    page = pathlib.Path(app.env.doc2path(app.env.docname)).parent
    for link in list(tree.findall(addnodes.pending_xref)):
        is_page = link.get("refdomain") == "doc"  # MyST 2 and later name the page, and not its file
        target = FOLDER / (link["reftarget"] + ".md") if is_page else page / link["reftarget"].split("#")[0]
        if link.get("reftype") != "myst" or link["reftarget"].startswith("#") or not target.exists() or FOLDER in target.resolve().parents and target.suffix == ".md":
            continue
        if target.resolve() == FOLDER.parent / "prm" / "README.md":
            link["reftarget"] = "cases" if is_page else os.path.relpath(FOLDER / "cases.md", page)
        elif target.is_dir():
            link.replace_self(nodes.inline("", "", *link.children))
        else:
            link.replace_self(addnodes.download_reference("", "", *link.children, refdoc=app.env.docname, reftarget=os.path.relpath(target, page),
                                                          refdomain=None, reftype="myst", refexplicit=True, refwarn=False))


def copy_mathjax(app, _):
    """Puts the parts of Debian's MathJax that the pages use beside mathjax.js."""
    for part in MATHJAX_PARTS if "mathjax_path" in globals() else ():
        source, target = MATHJAX / part, pathlib.Path(app.outdir) / "_static" / "mathjax" / part
        if source.is_dir():
            shutil.copytree(source, target, dirs_exist_ok=True)
        elif source.exists():
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(source, target)


def setup(app):
    app.connect("build-finished", copy_mathjax)
    app.connect("source-read", keep_beside_contents)
    # Before Sphinx collects the files of a page, which it does with priority 500.
    app.connect("doctree-read", hand_out_files, priority=100)

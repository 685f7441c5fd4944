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
# Lines of a paragraph may begin with a percentage.
myst_disable_syntax = ["myst_line_comment"]
bibtex_bibfiles = [str(FOLDER / "references.bib")]
bibtex_default_style = "plain"
# Code in the pages is C++, shell, Python, cases of Scree (text) and nothing else.
highlight_language = "text"
# Texts that are parts of pages, data, and the former manual.
exclude_patterns = ["parameters/intro", "studies/intro", "studies/reference"]

# Equations without a network: MathJax 2 of Debian's package libjs-mathjax becomes part of the site. Elsewhere Sphinx links to the newest.
MATHJAX = pathlib.Path("/usr/share/javascript/mathjax")
MATHJAX_PARTS = ("MathJax.js", "extensions/*.js", "extensions/TeX/*.js", "jax/element/**/*.js", "jax/input/TeX/*.js", "jax/output/SVG/*.js",
                 "jax/output/SVG/autoload/*.js", "jax/output/SVG/fonts/TeX/**/*.js")
if MATHJAX.is_dir():
    mathjax_path = "mathjax/MathJax.js"
    mathjax2_config = {"jax": ["input/TeX", "output/SVG"], "extensions": ["tex2jax.js"], "TeX": {"extensions": ["AMSmath.js", "AMSsymbols.js"]},
                       "tex2jax": {"processClass": "math", "ignoreClass": "document"}}

# Debian's furo needs a web server.
html_theme = "sphinx_rtd_theme"
html_theme_options = {"navigation_depth": 3}
html_title = f"Scree {release}"
html_static_path = ["site.css"]
html_css_files = ["site.css"]
html_copy_source = False
html_show_copyright = False
html_show_sphinx = False


def copy_mathjax(app):
    if MATHJAX.is_dir() and app.builder.format == "html":
        for file in (file for part in MATHJAX_PARTS for file in MATHJAX.glob(part)):
            target = pathlib.Path(app.outdir) / "_static" / "mathjax" / file.relative_to(MATHJAX)
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(file, target)


def place_pages(_, name, source):
    """Studies, which scree-study writes, stand in their list and not in the contents; pages for developers are not searched."""
    if name.startswith("studies/") and name != "studies/pages/README":
        source[0] = "---\norphan: true\n---\n\n" + source[0]
    if name.startswith("developer/"):
        source[0] = "---\nnosearch: true\n---\n\n" + source[0]


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


def setup(app):
    app.connect("builder-inited", copy_mathjax)
    app.connect("source-read", place_pages)
    # Before Sphinx collects the files of a page, which it does with priority 500.
    app.connect("doctree-read", hand_out_files, priority=100)

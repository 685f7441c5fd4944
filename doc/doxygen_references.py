#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""doxygen_references.py FILE.bib: the page References for Doxygen, an entry a line, with the anchor that @source{key} in a docstring links to."""

import pathlib
import re
import sys
import unicodedata

ENTRY = re.compile(r"^@\w+\{([^,\s]+),(.*?)^\}", re.DOTALL | re.MULTILINE)
FIELD = re.compile(r"(\w+)\s*=\s*\{((?:[^{}]|\{(?:[^{}]|\{[^{}]*\})*\})*)\}")
ACCENTS = {'"': "\u0308", "'": "\u0301", "`": "\u0300", "^": "\u0302", "~": "\u0303"}
LETTERS = {"ae": "æ", "o": "ø", "aa": "å", "ss": "ß", "&": "&"}


def plain(text):
    """TeX as plain text: `M{\\"u}ller {DNA} 1--2` is Müller DNA 1-2."""
    text = re.sub(r"""\\(["'`^~])\{?(\w)\}?""", lambda found: unicodedata.normalize("NFC", found[2] + ACCENTS[found[1]]), text)
    text = re.sub(r"\\(ae|aa|ss|o|&)\b ?|\\(&)", lambda found: LETTERS[found[1] or found[2]], text)
    return re.sub(r"\s+", " ", re.sub(r"[{}]", "", text).replace("--", "-")).strip()


def line(key, field):
    authors = ", ".join(plain(author) for author in re.split(r"\s+and\s+", field.get("author", field.get("institution", ""))))
    where = plain(next((field[name] for name in ("journal", "booktitle", "publisher", "institution", "howpublished") if name in field), ""))
    numbers = ", ".join(plain(field[name]) for name in ("volume", "pages") if name in field)
    return f"- \\anchor ref_{key} **{key}** {authors} ({plain(field['year'])}). {plain(field['title'])}. {where} {numbers}".rstrip(" .") + "."


def main():
    entries = ENTRY.findall(pathlib.Path(sys.argv[1]).read_text(encoding="utf-8"))
    print("# References {#references}\n")
    for key, text in entries:
        print(line(key, dict(FIELD.findall(text))))


if __name__ == "__main__":
    main()

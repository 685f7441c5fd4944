# SPDX-License-Identifier: LGPL-2.1-or-later
"""The words of a study, from doc/studies/intro/NAME.md, and how they are filled with numbers.

The file has the title, the question and the advice, behind "## Text" the text of the section, and behind "## Claims" a
sentence for each claim, "- name: ...". In braces stand values as in f-strings: `{rows.largest[gain]:.2g}`. Of a list
all are written, of {name: value} "value (name)", and `:.1f %` writes a part as a percentage, `:.1f mm` a length in m as
a number of millimetres.
"""

import numbers
import pathlib
import re
import string
from typing import NamedTuple

from scree.command import ROOT
from scree.studies.rows import Span

FOLDER = ROOT / "doc" / "studies" / "intro"
FORM = re.compile(r"# (.+?)\n\n(.+?)\n\n(.+?)\n\n## Text\n\n(.+?)(?:\n\n## Claims\n\n(.+))?\n*\Z", re.DOTALL)
ITEM = re.compile(r"^- ([^:]+): (.+?)(?=\n- |\Z)", re.MULTILINE | re.DOTALL)


class Claim(NamedTuple):
    """A sentence of the verdict, its numbers taken from the table, and whether the table bears it out.

    With `quick` False it needs the whole study, and the short version does not check it. `worst`: it stands at the head
    of its section. `tabled`: the table of the section says the same; the sentence stands on the page only if it does
    not hold.
    """
    text: str
    holds: bool
    quick: bool = True
    worst: bool = False
    tabled: bool = False


class Filling(string.Formatter):
    def get_value(self, key, args, kwargs):
        return args[0] if key == "" else super().get_value(key, args, kwargs)

    def format_field(self, value, format_spec):
        if isinstance(value, dict):
            return ", ".join(f"{self.format_field(one, format_spec)} ({name})" for name, one in value.items())
        if isinstance(value, list):
            return ", ".join(self.format_field(one, format_spec) for one in value)
        for unit, factor, shown in (("%", 100, " %"), ("mm", 1e3, "")):
            if format_spec.endswith(" " + unit) and isinstance(value, (Span, numbers.Real)):
                scaled = Span(factor * value.low, factor * value.high) if isinstance(value, Span) else factor * value
                return format(scaled, format_spec.removesuffix(" " + unit)) + shown
        return format(value, format_spec)


filled = Filling().format


class Text(NamedTuple):
    """The words of a study; `sentences`: those of the claims, by name."""
    file: pathlib.Path
    title: str
    question: str
    advice: str
    introduction: str
    sentences: dict

    @classmethod
    def of(cls, name):
        """Reads those of a study by its name. Throws an OSError or a ValueError."""
        file = FOLDER / f"{name}.md"
        parts = FORM.match(file.read_text(encoding="utf-8"))
        if parts is None:
            raise ValueError(f"{file}: write title, question, advice, ## Text, ## Claims, with empty lines between them")
        *head, introduction, claims = parts.groups()
        sentences = {name: " ".join(words.split()) for name, words in ITEM.findall(claims or "")}
        return cls(file, *(" ".join(words.split()) for words in head), introduction, sentences)


class Claims:
    """claim(name, holds, values of the sentence) -> Claim; `shared` gives more values that all sentences may use."""

    def __init__(self, sentences, values=None):
        self.sentences, self.values = sentences, values or {}

    def shared(self, **values):
        return Claims(self.sentences, {**self.values, **values})

    def __call__(self, name, holds, quick=True, worst=False, tabled=False, **values):
        if name not in self.sentences:
            raise KeyError(f"No sentence for the claim {name}; there are: {', '.join(self.sentences) or 'none'}.")
        return Claim(filled(self.sentences[name], **self.values, **values), bool(holds), quick, worst, tabled)


def tabled(columns, by=None):
    """A function rows -> table, the first row is the head. `columns`: {head: cell}; in a cell `{[h]:g}` stands for the
    column h. by: the column that sorts the rows."""
    def table(rows):
        rows = sorted(rows, key=lambda row: row[by]) if by else rows
        return [tuple(columns), *(tuple(filled(cell, row) for cell in columns.values()) for row in rows)]
    return table

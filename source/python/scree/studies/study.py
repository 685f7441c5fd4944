# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a study is: variants of a case, a measure of each run, a chart and a verdict. doc/developer/index.md shows how
to write one."""

import atexit
import dataclasses
import functools
import importlib
import itertools
import math
import pathlib
import re
import subprocess
import tempfile
from typing import Any, Callable, NamedTuple

from scree import results
from scree import variants as prm_files
from scree.command import ROOT
from scree.studies.words import Claims, Text


class Variant(NamedTuple):
    """Labels: the columns that tell this run from others. Entries: {"Mesh/Cell size": 0.1}. Base: another case than the
    study's. Ranks: of this run."""
    labels: dict
    entries: dict
    base: str | None = None
    ranks: int = 1


def axis(label, entry, values):
    """One varied thing: its column, the entry of the .prm (or a function value -> entries), and its values."""
    def entries(value):
        return entry(value) if callable(entry) else {entry: value}
    return [Variant({label: value}, entries(value)) for value in values]


def transfer(method):
    """The entries of a method other than FLIP: none reads the PIC rate that a case of FLIP may set, and the program
    refuses it."""
    return {"Transfer/Method": method, "Transfer/PIC rate": "auto"}


def product(*axes):
    """All combinations of the variants of several axes; lists of variants add up with +."""
    return [Variant({name: value for part in parts for name, value in part.labels.items()},
                    {name: value for part in parts for name, value in part.entries.items()},
                    next((part.base for part in reversed(parts) if part.base), None), max(part.ranks for part in parts))
            for parts in itertools.product(*axes)]


def reference_rows(name):
    """The rows of a table of doc/studies/reference, {column: text}."""
    return results.read_rows(ROOT / "doc" / "studies" / "reference" / f"{name}.csv")


@functools.cache
def compiled(source, compiler, *flags):
    """The program or library that the compiler makes of a file of doc/studies; it is gone with the study."""
    folder = tempfile.TemporaryDirectory(prefix="scree_")
    atexit.register(folder.cleanup)
    target = pathlib.Path(folder.name) / pathlib.Path(source).stem
    subprocess.run([compiler, *flags, "-o", target, ROOT / "doc" / "studies" / source], check=True)
    return target


@dataclasses.dataclass(frozen=True)
class Study:
    """Variants of the case `base`, and the chart. A study is a module of scree.studies.cases with it as STUDY, and with

    measure(run): the columns of a run, {column: value};
    verdict(rows, claim): the claims on the Rows as the table holds them, by claim(name, holds, values of its sentence);
    table(rows): the table of its section, the first row is the head; a map has one without it;

    entries: common to all variants. reference: entries of a run made first, `run.reference` in the measure;
    quick_reference: that of the short version, if it is another one. quick(labels): whether a variant belongs to the
    short version. needs_end: a run that failed has no measures. options: of the program, such as --safety.
    default: the labels of the .prm's defaults, marked in the chart; a stability map needs them, {} if it compares no
    options, as its headline is the share of these cells that are stable. environment(): variables that it is run with.
    after(run, program): what else is to be made in a run's folder, right after it.
    """
    base: str
    variants: list
    chart: Any
    entries: dict = dataclasses.field(default_factory=dict)
    reference: dict | None = None
    quick_reference: dict | None = None
    quick: Callable = lambda labels: True
    needs_end: bool = True
    default: dict | None = None
    options: tuple = ()
    environment: Callable = dict
    after: Callable = lambda run, program: None
    table: Callable | None = None
    text: Text | None = None  # this and the following are set by study_of
    measure: Callable | None = None
    verdict: Callable | None = None


def study_of(name):
    """The study of a module of scree.studies.cases, with its words and functions; its verdict(rows) has a `claim`."""
    module, text = importlib.import_module(f"scree.studies.cases.{name}"), Text.of(name)
    return dataclasses.replace(
        module.STUDY, text=text, measure=module.measure,
        verdict=lambda rows: module.verdict(rows, Claims(text.sentences)),
        table=module.STUDY.table or getattr(module, "table", None))


class Run:
    """A finished run: its folder, what the program said, and what it cost."""

    def __init__(self, folder, labels, exit_code, core_seconds):
        self.folder = folder
        self.labels = labels
        self.exit_code = exit_code
        self.reference = None
        self._core_seconds = core_seconds

    @property
    def ended(self):
        return self.exit_code == 0

    @property
    def entries(self):
        """The entries of the variant's .prm, as text: {"Mesh/Cell size": "0.1"}."""
        return prm_files.read_entries(self.folder / "case.prm")

    @property
    def log(self):
        """What the program wrote on the screen, errors included, and into log.txt, which has more."""
        files = (self.folder / "screen.txt", self.folder / "log.txt")
        return "\n".join(file.read_text(encoding="utf-8", errors="replace") for file in files if file.exists())

    @functools.cached_property
    def columns(self):
        """The file `statistics.csv`, {"Time (s)": values, ...}: {} if the run broke before its first row."""
        return results.read_statistics(self.folder) if (self.folder / "statistics.csv").exists() else {}

    def statistics(self, name):
        """A column by its whole name; a KeyError lists the names if there is none. For one that not all runs have:
        `columns.get(name)`."""
        return results.column(self.columns, name)

    @property
    def time(self):
        return self.statistics("Time (s)")

    def points(self, time=None, collection="points"):
        """The points of the picture next to `time`, s (the last one without): positions (n, 3) and arrays by name."""
        return results.read_points(self.folder, time, collection)

    @property
    def cost(self):
        """Steps, core-seconds of the steps, ns per point and step; nan where the run did not come to its end.

        Core-seconds are processor time, which a busy machine disturbs less than the clock on the wall: that of the
        steps and the output, as the log tells it.
        """
        log = self.folder / "log.txt"
        text = log.read_text(encoding="utf-8") if log.exists() else ""
        of_steps = re.search(r"/ ([\d.e+-]+) point updates; processor time ([\d.e+-]+) s", text)
        if not of_steps:
            return {"steps": math.nan, "core-seconds": self._core_seconds, "ns per point and step": math.nan}
        updates, seconds = map(float, of_steps.groups())
        return {"steps": self.statistics("Step")[-1], "core-seconds": seconds,
                "ns per point and step": 1e9 * seconds / updates}

# SPDX-License-Identifier: LGPL-2.1-or-later
"""The rows of a study's table, and what is asked of them."""

from typing import NamedTuple


class Span(NamedTuple):
    """A smallest and a largest value; as text "0.1 to 0.3"."""
    low: float
    high: float

    @classmethod
    def of(cls, values):
        values = list(values)
        return cls(min(values), max(values))

    def __format__(self, form):
        return f"{self.low:{form}} to {self.high:{form}}"


class Lookup:
    """A function of a name as a table, which sentences can read: `{error[2 x 2 points]:.2g}`."""

    def __init__(self, function):
        self.function = function

    def __getitem__(self, name):
        return self.function(name)


class Rows(list):
    """Rows, each {column: value}: `rows.largest["gain"]`, in a sentence `{rows.largest[gain]:.2g}`."""

    n = property(len)
    # Of a column: its values in the order of the rows, the largest one, the smallest one, both.
    values = property(lambda self: Lookup(lambda name: [row[name] for row in self]))
    largest = property(lambda self: Lookup(lambda name: max(self.values[name])))
    smallest = property(lambda self: Lookup(lambda name: min(self.values[name])))
    span = property(lambda self: Lookup(lambda name: Span.of(self.values[name])))

    def where(self, labels=None, **more):
        """Those with these values in their columns, {column: value}, or of which a function is true."""
        if callable(labels):
            return Rows(filter(labels, self))
        wanted = {**(labels or {}), **more}
        return Rows(row for row in self if all(row[name] == value for name, value in wanted.items()))

    def first(self, labels=None, **more):
        """The first of them; None without one."""
        return next(iter(self.where(labels, **more)), None)

    def with_largest(self, name):
        return max(self, key=lambda row: row[name])

    def with_smallest(self, name):
        return min(self, key=lambda row: row[name])

    def from_coarse(self):
        """From the largest cells to the smallest. Rows with a number of cells only get h = 1/cells."""
        sized = ({"h": 1 / row["cells"], **row} if "cells" in row else row for row in self)
        return Rows(sorted(sized, key=lambda row: -row["h"]))

    def grouped(self, *names):
        """{values of these columns: rows from the largest cells to the smallest}."""
        found = {}
        for row in self.from_coarse():
            found.setdefault(tuple(row[name] for name in names), Rows()).append(row)
        return found

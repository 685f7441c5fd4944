# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the work-precision studies share: methods that differ from the defaults in one thing, and what they cost at equal error.

Rows have the columns "method" and "h", the cell size, and an error, which is nan where the run failed or blew up.
"""

import math
import re

import numpy as np

from scree.studies.rows import Lookup, Rows
from scree.studies.study import axis, product

DEFAULTS = "defaults"
# The options that studies compare, by their names: what stands in parentheses is the value of the entries.
OPTIONS = {"(linear)": ["Mesh/Basis"], "(single)-point": ["Water/Point sets"], "(no|standard|modified|projected) F-bar": ["Stabilisation/F-bar"],
           "(FLIP)": ["Transfer/Method"], r"PIC rate ([\d.]+)": ["Transfer/PIC rate"], r"Courant number ([\d.]+)": ["Time step/Courant number"],
           r"tolerance ([-\de]+)": ["Water/Pressure/Relative tolerance"], r"(\d) x \1 points": ["Soil/Points per cell", "Water/Points per cell"]}


def methods(*options, without="none"):
    """{name: entries} of the defaults and of options: names of OPTIONS, or {name: entries}. `without`: the body that the case does not have."""
    found = {DEFAULTS: {}}
    for option in options:
        found.update(option if isinstance(option, dict) else {option: _entries_of(option, without)})
    return found


def _entries_of(name, without):
    value, entries = next((match.group(1), entries) for pattern, entries in OPTIONS.items() if (match := re.fullmatch(pattern, name)))
    value = float(value) if value[0].isdigit() else {"no": "none"}.get(value, value)
    return {entry: value for entry in entries if not entry.startswith(without + "/")}


def variants(methods, mesh, sizes, names=None):
    """Methods, all or those of these names, on meshes; `mesh`: the entry of the cell size, or a function h -> entries."""
    return product(axis("method", methods.__getitem__, names or methods), axis("h", mesh, sizes))


def curve(rows, method=DEFAULTS, column="error"):
    """{h: row} of the runs of a method that have a number above 0 in the column, from the coarsest mesh on."""
    found = {row["h"]: row for row in rows if row["method"] == method and math.isfinite(row.get(column, math.nan)) and row[column] > 0}
    return dict(sorted(found.items(), reverse=True))


def at_finest(rows, method, column="error"):
    """The column on the finest mesh that a method has; nan without one."""
    found = list(curve(rows, method, column).values())
    return found[-1][column] if found else math.nan


def failed(rows, method):
    """The cell sizes at which a method has no error."""
    return sorted(row["h"] for row in rows if row["method"] == method and not math.isfinite(row.get("error", math.nan)))


def order(rows, method=DEFAULTS):
    """Order of convergence in h between the coarsest and the finest mesh; nan with one mesh."""
    found = curve(rows, method)
    if len(found) < 2:
        return math.nan
    coarse, *_, fine = found
    return math.log(found[coarse]["error"] / found[fine]["error"]) / math.log(coarse / fine)


class LimitFit:
    """The defaults' errors against their own run on a finer mesh h_r, as A (h^p - h_r^p): what a run lacks of the limit is A h^p, not its error.

    p: the order between 0.05 and 4 with the smallest rms deviation of log(error); `found` is False, and all is nan, where the meshes do not
    tell it: fewer than three of them, or p at an end of that range.
    """

    def __init__(self, rows, reference, method=DEFAULTS, column="error"):
        found = curve(rows, method, column)
        h, errors = np.array(list(found)), np.array([row[column] for row in found.values()])
        self.order = self.factor = math.nan
        if len(found) >= 3:
            orders = np.arange(0.05, 4.001, 0.01)
            logs = np.array([np.log(errors / (h**order - reference**order)) for order in orders])
            best = np.argmin(np.std(logs, axis=1))
            if 0 < best < len(orders) - 1:
                self.order, self.factor = float(orders[best]), float(np.exp(np.mean(logs[best])))
        self.reference = reference

    @property
    def found(self):
        return math.isfinite(self.order)

    def lack(self, h):
        """What the defaults lack of the limit with cells of size h."""
        return self.factor * h**self.order

    def against_limit(self, rows):
        """The rows with what the reference lacks added to their errors: right where all methods tend to one limit, and fall short of it as the
        reference does. Unchanged without a fit."""
        return Rows({**row, "error": row["error"] + self.lack(self.reference)} for row in rows) if self.found else rows


def ratio(rows, method, column="error", other=DEFAULTS):
    """Geometric mean over the common meshes of the column of a method over that of another."""
    own, base = curve(rows, method, column), curve(rows, other, column)
    logs = [math.log(own[h][column] / base[h][column]) for h in own.keys() & base.keys()]
    return math.exp(np.mean(logs)) if logs else math.nan


def ratios(rows, column="error"):
    """`ratio` of each method."""
    return Lookup(lambda method: ratio(rows, method, column))


def beside_defaults(rows):
    """Values for sentences: `error` and `time` of a method over those of the defaults, `finest`: its error on its finest mesh."""
    return {"error": ratios(rows), "time": ratios(rows, "core-seconds"), "finest": Lookup(lambda method: at_finest(rows, method))}


def cost_at_equal_error(rows, method):
    """How many times the defaults' core-seconds a method takes for the same error; below 1 it is better. nan with one mesh.

    The ratio of the times, times the ratio of the errors to the power s, where core-seconds ~ error^-s along the defaults' curve: what is
    lost in accuracy is paid for by the defaults' own rate of convergence. Both ratios are means over the meshes (`ratio`).
    """
    base = list(curve(rows).values())
    if len(base) < 2:
        return math.nan
    price = math.log(base[-1]["core-seconds"] / base[0]["core-seconds"]) / math.log(base[0]["error"] / base[-1]["error"])
    return ratio(rows, method, "core-seconds") * ratio(rows, method)**price


def other_methods(rows):
    """All methods but the defaults, in the order of the rows."""
    return list(dict.fromkeys(row["method"] for row in rows if row["method"] != DEFAULTS))


def costs(rows):
    """{method: cost_at_equal_error} of the other methods, the cheapest first; without those that failed on a mesh."""
    found = {method: cost_at_equal_error(rows, method) for method in other_methods(rows) if not failed(rows, method)}
    return dict(sorted(found.items(), key=lambda item: item[1]))


def table(rows, no_cost=()):
    """Error and time of each method over those of the defaults on the same meshes, and the cost at equal error; of the methods `no_cost`, which tend to
    another limit, and of those that fail, no cost."""
    found = costs(rows)
    order_of = [*found, *(method for method in other_methods(rows) if method not in found)]

    def cost(method):
        meshes = failed(rows, method)
        return "fails at h = " + ", ".join(f"{h:.2g}" for h in meshes) + " m" if meshes else "-" if method in no_cost or method not in found else f"{found[method]:.2g}"
    return [("method, each value over that of the defaults", "error", "time", "time at equal error"),
            *((method, f"{ratio(rows, method):.2g}", f"{ratio(rows, method, 'core-seconds'):.2g}", cost(method)) for method in order_of)]

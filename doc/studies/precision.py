# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the work-precision studies share: methods that differ from the defaults in one thing, and what they cost at equal error."""

import math

import numpy as np

DEFAULTS = "defaults"


def finished(rows, method, error="error"):
    """{h: row} of the runs of a method that have an error."""
    return {row["h"]: row for row in rows if row["method"] == method and math.isfinite(row.get(error, math.nan)) and row[error] > 0}


def price_of_accuracy(rows, error="error"):
    """s of core-seconds ~ error^-s along the defaults' curve, from its coarsest to its finest mesh."""
    curve = finished(rows, DEFAULTS, error)
    coarse, fine = curve[max(curve)], curve[min(curve)]
    return math.log(fine["core-seconds"] / coarse["core-seconds"]) / math.log(coarse[error] / fine[error])


def cost_at_equal_error(rows, method, error="error"):
    """How many times the defaults' core-seconds a method takes for the same error: the geometric mean over the meshes that both have.

    On each mesh the ratio of the times, times the ratio of the errors to the power s (`price_of_accuracy`): what is lost in
    accuracy is paid for by the defaults' own rate of convergence. Above 1 the defaults are better. nan without runs to compare.
    """
    own, base = finished(rows, method, error), finished(rows, DEFAULTS, error)
    common = sorted(own.keys() & base.keys())
    price = price_of_accuracy(rows, error)
    logs = [math.log(own[h]["core-seconds"] / base[h]["core-seconds"]) + price * math.log(own[h][error] / base[h][error]) for h in common]
    return math.exp(np.mean(logs)) if logs else math.nan


def costs(rows, error="error"):
    """{method: cost_at_equal_error} of all other methods, the cheapest first."""
    methods = dict.fromkeys(row["method"] for row in rows if row["method"] != DEFAULTS)
    found = {method: cost_at_equal_error(rows, method, error) for method in methods}
    return dict(sorted(((method, cost) for method, cost in found.items() if math.isfinite(cost)), key=lambda item: item[1]))


def order(rows, method=DEFAULTS, error="error"):
    """Order of convergence in h between the coarsest and the finest mesh."""
    curve = finished(rows, method, error)
    return math.log(curve[max(curve)][error] / curve[min(curve)][error]) / math.log(max(curve) / min(curve))


def ratio(rows, method, column, other=DEFAULTS):
    """Geometric mean over the common meshes of `column` of a method over that of another."""
    own, base = finished(rows, method, column), finished(rows, other, column)
    common = own.keys() & base.keys()
    return math.exp(np.mean([math.log(own[h][column] / base[h][column]) for h in common])) if common else math.nan


def listed(found):
    """"a 0.81, b 1.2": methods with their numbers."""
    return ", ".join(f"{method} {cost:.2g}" for method, cost in found.items())

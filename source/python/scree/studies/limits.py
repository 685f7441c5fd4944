# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the sizes of cells of one curve tell about h = 0, and lengths of deposits."""

import math

import numpy as np

from scree.studies.study import transfer

TRANSFERS = {"FLIP": {"Transfer/Method": "FLIP", "Transfer/PIC rate": 1}, "AFLIP": transfer("AFLIP"),
             "TPIC": transfer("TPIC")}
TIP, MASS, HEIGHT = "front 99 %", "front 90 %", "height"


def whole_cells(h, lengths):
    """Entries of cells of size h and of a box of whole cells that has these lengths, m."""
    corner = ", ".join(f"{math.ceil(round(length / h, 6)) * h:.12g}" for length in lengths)
    return {"Mesh/Cell size": f"{h:.12g}", "Mesh/Upper corner": corner}


def fit(h, values, order):
    """(value at h = 0, factor of h^order, rms deviation) by least squares."""
    matrix = np.column_stack([np.ones_like(h), h**order])
    solution = np.linalg.lstsq(matrix, values, rcond=None)[0]
    return *solution, np.sqrt(np.mean((matrix @ solution - values)**2))


class Limit:
    """The value of a column at h = 0, as the introduction of run_out defines it; `rows`: from the largest cells to the
    smallest."""

    def __init__(self, rows, name):
        h, values = (np.array(rows.values[key]) for key in ("h", name))
        first, second = fit(h, values, 1.), fit(h, values, 2.)
        self.value = (first[0] + second[0]) / 2
        self.uncertainty = abs(first[0] - second[0]) / 2 + max(first[2], second[2])
        self.h, self.values = h, values
        self.last_change = values[-1] / values[-2] - 1
        self.missing = 1 - values[0] / self.value
        self.spread = values.max() / values.min() - 1

    def __format__(self, form):
        """The limit and its uncertainty."""
        return f"{self.value:{form}} +- {self.uncertainty:{form}}"


def apart(limits):
    """Relative difference of several limits."""
    values = [limit.value for limit in limits.values()]
    return (max(values) - min(values)) / np.mean(values)


def halving_of(rows, name, cells):
    """Relative change of a column from this number of cells to twice as many."""
    return rows.first(cells=2 * cells)[name] / rows.first(cells=cells)[name] - 1


def volume_below(coordinate, volume, dim):
    """A function place -> volume of the points below a place; each point is a square, or cube, of its volume."""
    sides = volume ** (1 / dim)
    return lambda place: np.sum(volume * np.clip((place - coordinate) / sides + 0.5, 0., 1.))


def depth(points, low, high):
    """Of the plane deposit between places, averaged, in the unit of the places."""
    left_of = volume_below(points.positions[:, 0], points.arrays["volume"].ravel(), 2)
    return np.array([(left_of(end) - left_of(start)) / (end - start) for start,
                     end in zip(np.atleast_1d(low), np.atleast_1d(high))])


def front_of_depth(points, least, start, width, step):
    """The last place, each `step` from `start`, around which the deposit, averaged over `width`, is deeper than
    `least`."""
    places = np.arange(start, points.positions[:, 0].max() + width, step)
    return places[np.flatnonzero(depth(points, places, places + width) > least)[-1]] + width / 2

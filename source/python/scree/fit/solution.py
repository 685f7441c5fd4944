# SPDX-License-Identifier: LGPL-2.1-or-later
"""Least squares of a fit, with standard deviations, correlations and flags."""

import time
from typing import NamedTuple

import numpy as np
from scipy import optimize
from scipy.stats import qmc

from scree.fit import laboratory

STEP = 1e-4  # of differences, of the distance between the bounds
FAILED = 10.  # difference from all values of a test whose path fails, as a multiple of the largest
NEAR = 1e-2  # of the distance between the bounds: at the bound
FLOOR = 1e-10  # of eigenvalues, of the largest
POOR = 0.25  # rms difference that is flagged, of the largest value of a column
STRONG = 0.95  # correlation that is flagged
SEED = 1


class Solution(NamedTuple):
    """What was found. `sigma` and `correlation` are NaN for a parameter without influence. `laws`: for each test its table."""
    values: list
    sigma: np.ndarray
    correlation: np.ndarray
    flags: list
    laws: list
    cost: float
    start_cost: float
    n_evaluations: int
    seconds: float


class Fit:
    """The residuals of a problem as a function of the places of its parameters between their bounds."""

    def __init__(self, problem, runs, tell=print):
        self.problem, self.runs, self.tell = problem, runs, tell
        self.begin, self.n_iterations, self.known = time.monotonic(), 0, None

    def values(self, places):
        return [parameter.value(place) for parameter, place in zip(self.problem.parameters, places)]

    def of_tables(self, tables):
        """All residuals, and whether no path has failed."""
        parts = []
        for test, table in zip(self.problem.tests, tables):
            for column in test.columns:
                failed = isinstance(table, str)
                differences = np.full(len(column.values), FAILED) if failed else column.differences(laboratory.at_rows(column, test.coordinate, table,
                                                                                                                       test.strain))
                parts.append(np.sqrt(test.weight * column.weight * column.row_weights) * differences)
        return np.concatenate(parts), not any(isinstance(table, str) for table in tables)

    def many(self, places):
        """(residuals, whether no path has failed) at each of several places."""
        return [self.of_tables(tables) for tables in self.runs.tables([self.values(one) for one in places])]

    def residuals(self, places):
        residuals, _ = self.many([places])[0]
        self.known = (np.array(places), residuals)
        return residuals

    def jacobian(self, places):
        """By one-sided differences towards the farther bound; a side whose path fails gives way to the other one, and then to 0."""
        here = self.known[1] if self.known is not None and np.array_equal(self.known[0], places) else self.residuals(places)
        self.n_iterations += 1
        self.tell(f"{self.n_iterations:>10}{np.sum(here**2):>16.6g}{time.monotonic() - self.begin:>10.0f} s")
        steps = np.where(np.asarray(places) < 0.5, STEP, -STEP)
        columns = [None] * len(steps)
        for side in (1, -1):
            left = [number for number, column in enumerate(columns) if column is None]
            moved = [np.clip(places + side * steps[number] * (np.arange(len(steps)) == number), 0, 1) for number in left]
            for number, place, (residuals, is_good) in zip(left, moved, self.many(moved) if left else ()):
                way = place[number] - places[number]
                columns[number] = (residuals - here) / way if is_good and way else None
        return np.array([np.zeros(len(here)) if column is None else column for column in columns]).T

    def start(self):
        """The places to begin from, residuals there: the best of the given one and, with several starts, of a Latin hypercube."""
        parameters, n_starts = self.problem.parameters, self.problem.n_starts
        places = [np.array([parameter.place(parameter.start) for parameter in parameters])]
        if n_starts > 1:
            places += list(qmc.LatinHypercube(len(parameters), seed=SEED).random(n_starts - 1))
        tried = self.many(places)
        good = [number for number, (_, is_good) in enumerate(tried) if is_good]
        if not good:
            test, _, message = self.runs.failures[0]
            raise ValueError(f"{self.problem.file}: the start fails, test {test}: {message}. Change start or bounds of the parameters, or the case")
        best = min(good, key=lambda number: np.sum(tried[number][0]**2))
        return places[best], tried[best][0], tried[0][0]


def solve(problem, runs, tell=print):
    """Throws a ValueError if no start can be run."""
    fit = Fit(problem, runs, tell)
    place, residuals, given = fit.start()
    fit.known = (place, residuals)
    tell(f"{'iteration':>10}{'sum of squares':>16}{'elapsed':>12}")
    # Not where it began: least squares keeps within the bounds by a little.
    found = optimize.least_squares(fit.residuals, place, fit.jacobian, bounds=(0, 1), method="trf", x_scale="jac", xtol=1e-5, ftol=1e-5, gtol=1e-9,
                                   max_nfev=problem.n_evaluations)
    laws = runs.tables([fit.values(found.x)])[0]
    deviations, correlation = uncertainty(problem, found.fun, found.jac)
    values = fit.values(found.x)
    sigma = deviations * np.array([parameter.slope(place) for parameter, place in zip(problem.parameters, found.x)])
    flags = _flags(problem, laws, found, values, deviations, sigma, correlation)
    return Solution(values, sigma, correlation, flags, laws, float(np.sum(found.fun**2)), float(np.sum(given**2)), found.nfev, time.monotonic() - fit.begin)


def follow_up(differences):
    """By how much fewer independent readings there are than rows: (1 + r)/(1 - r) with the correlation r of neighbours (Bayley & Hammersley 1946), 1 to
    half the number of rows."""
    size = np.sum(differences**2)
    neighbours = np.sum(differences[1:] * differences[:-1]) / size if size > 0 else 0.
    neighbours = np.clip(neighbours, 0, 0.999)
    return float(np.clip((1 + neighbours) / (1 - neighbours), 1, max(1, len(differences) / 2)))


def uncertainty(problem, residuals, jacobian):
    """Standard deviations of the places and their correlations. The scatter of each column is that of its differences; rows weigh as in the fit."""
    n_parameters = jacobian.shape[1]
    active = np.flatnonzero(np.linalg.norm(jacobian, axis=0) > 1e-8 * max(1e-300, np.linalg.norm(jacobian)))
    sigma, correlation = np.full(n_parameters, np.nan), np.full((n_parameters, n_parameters), np.nan)
    if not active.size:
        return sigma, correlation
    used, scatter, first = jacobian[:, active], np.zeros(len(residuals)), 0
    for test in problem.tests:
        for column in test.columns:
            part = slice(first, first + len(column.values))
            weights = test.weight * column.weight * column.row_weights
            differences = np.divide(residuals[part], np.sqrt(weights), out=np.zeros(len(weights)), where=weights > 0)
            n_free = max(1., len(weights) * (1 - n_parameters / len(residuals)))
            scatter[part] = weights * np.sum(differences**2) / n_free * follow_up(differences)
            first = part.stop
    scale = np.linalg.norm(used, axis=0)
    normal = used.T @ used / np.outer(scale, scale)
    eigenvalues, vectors = np.linalg.eigh(normal)
    # Below the error of the differences nothing is known: a combination of entries that no test determines gets a large deviation.
    known = vectors * np.maximum(eigenvalues, FLOOR * eigenvalues[-1]) @ vectors.T
    spread = (used.T * scatter) @ used / np.outer(scale, scale) + np.mean(scatter) * (known - normal)
    inverse = np.linalg.inv(known)
    covariance, inverse = inverse @ spread @ inverse / np.outer(scale, scale), inverse / np.outer(scale, scale)
    deviations = np.sqrt(np.maximum(np.diag(covariance), 0))
    sigma[active] = deviations
    with np.errstate(invalid="ignore", divide="ignore"):
        # Without scatter, of data that the law meets to the last digit, that of the same scatter everywhere.
        given = covariance if (deviations > 0).all() else inverse
        size = np.sqrt(np.diag(given))
        correlation[np.ix_(active, active)] = np.clip(given / np.outer(size, size), -1, 1)
    return sigma, correlation


def _flags(problem, laws, found, values, deviations, sigma, correlation):
    """Sentences: what is not to be trusted."""
    flags = []
    if found.status == 0:
        flags.append(f'NOT CONVERGED after {found.nfev} evaluations. Write a larger "evaluations", or start closer')
    for test, table in zip(problem.tests, laws):
        for column in test.columns:
            differences = column.differences(laboratory.at_rows(column, test.coordinate, table, test.strain))
            if (rms := np.sqrt(np.sum(column.row_weights * differences**2))) > POOR:
                flags.append(f"MISFIT: the law misses {column.name} of {test.name} by {100 * rms:.3g} % of its "
                             + ("range" if column.is_strain else "values" if column.is_logarithmic else "largest value")
                             + " (rms). Look at fit.png, check the unit of the column, free other entries, or choose another law")
    for number, (parameter, value) in enumerate(zip(problem.parameters, values)):
        for bound, distance in (("low", found.x[number]), ("high", 1 - found.x[number])):
            if distance < NEAR and not np.isnan(sigma[number]):
                flags.append(f"AT A BOUND: {parameter.entry} = {value:.4g} is at {bound} = {getattr(parameter, bound):g}. Least squares would leave "
                             "the bounds: its sigma has no meaning")
        if np.isnan(sigma[number]):
            flags.append(f"NO INFLUENCE: {parameter.entry} does not change these tests. Hold it in [set]")
        elif deviations[number] > 0.25:
            flags.append(f"NOT DETERMINED: sigma of {parameter.entry}, {sigma[number]:.2g}, is above a quarter of the distance between its bounds")
    for one in range(len(values)):
        for other in range(one):
            if abs(correlation[one, other]) > STRONG:
                flags.append(f"CORRELATED: {problem.parameters[other].entry} and {problem.parameters[one].entry}, {correlation[one, other]:+.3f}. "
                             "The tests determine a combination of both: hold one of them, or add a test")
    return flags

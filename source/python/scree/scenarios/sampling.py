# SPDX-License-Identifier: LGPL-2.1-or-later
"""Distributions of parameters, and the designs that choose their values for each run."""

import itertools
from typing import NamedTuple

import numpy as np
from scipy import stats
from scipy.stats import qmc

SAMPLINGS = ("one at a time", "grid", "Latin hypercube", "Sobol")
KEYS = {"uniform": ("low", "high"), "normal": ("mean", "deviation"), "lognormal": ("mean", "deviation"), "triangular": ("low", "mode", "high"),
        "list": ("values",)}
LAWS = {"uniform": lambda low, high: stats.uniform(low, high - low), "normal": stats.norm,
        "triangular": lambda low, mode, high: stats.triang((mode - low) / (high - low), low, high - low),
        "lognormal": lambda mean, deviation: stats.lognorm(spread := np.sqrt(np.log(1 + (deviation / mean)**2)), scale=mean * np.exp(-spread**2 / 2))}
BOUNDS = ("low", "high")  # may cut off a normal or a lognormal distribution


class Distribution(NamedTuple):
    """A distribution with its numbers; `deviation` is the standard deviation, of a lognormal that of the value itself."""
    kind: str
    numbers: dict

    @property
    def is_list(self):
        return self.kind == "list"

    def quantile(self, probability):
        """The value below which lies `probability` (0 to 1); of a list the one in this part of it."""
        if self.is_list:
            values = self.numbers["values"]
            return values[min(int(probability * len(values)), len(values) - 1)]
        law = self._law()
        low, high = (law.cdf(self.numbers.get(name, infinite)) for name, infinite in (("low", -np.inf), ("high", np.inf)))
        return float(f"{law.ppf(low + probability * (high - low)):.6g}")

    def text(self):
        """In one line."""
        if self.is_list:
            return "one of " + ", ".join(map(str, self.numbers["values"]))
        return f"{self.kind}, " + ", ".join(f"{name} {value:g}" for name, value in self.numbers.items())

    def _law(self):
        return LAWS[self.kind](*(self.numbers[name] for name in KEYS[self.kind]))


def distribution_of(given):
    """The distribution that a study describes: a list of values, or {"distribution": ..., its numbers}. Throws a ValueError with what is wrong."""
    if isinstance(given, list):
        given = {"distribution": "list", "values": given}
    if not isinstance(given, dict):
        raise ValueError('write a list of values, or for instance { distribution = "uniform", low = 1, high = 2 }')
    kind = given.get("distribution")
    if kind not in KEYS:
        raise ValueError(f'there is no distribution "{kind}". Write one of: {", ".join(KEYS)}')
    numbers = {name: value for name, value in given.items() if name != "distribution"}
    allowed = KEYS[kind] + (BOUNDS if kind in ("normal", "lognormal") else ())
    for name in numbers:
        if name not in allowed:
            raise ValueError(f"{kind} has no {name}. It takes: {', '.join(allowed)}")
    for name in KEYS[kind]:
        if name not in numbers:
            raise ValueError(f"{kind} needs {name}. It takes: {', '.join(allowed)}")
    if kind == "list":
        if not isinstance(numbers["values"], list) or len(set(map(str, numbers["values"]))) < 2:
            raise ValueError("write at least two different values")
        return Distribution(kind, numbers)
    for name, value in numbers.items():
        if isinstance(value, bool) or not isinstance(value, (int, float)) or not np.isfinite(value):
            raise ValueError(f"{name} = {value} is not a number")
    _check_numbers(kind, numbers)
    return Distribution(kind, numbers)


def _check_numbers(kind, numbers):
    if not numbers.get("low", -np.inf) < numbers.get("high", np.inf):
        raise ValueError(f"low = {numbers['low']:g} is not below high = {numbers['high']:g}")
    if kind == "triangular" and not numbers["low"] <= numbers["mode"] <= numbers["high"]:
        raise ValueError(f"mode = {numbers['mode']:g} is not between low and high")
    if kind in ("normal", "lognormal") and numbers["deviation"] <= 0:
        raise ValueError(f"deviation = {numbers['deviation']:g}: the standard deviation is above 0")
    if kind == "lognormal" and numbers["mean"] <= 0:
        raise ValueError(f"mean = {numbers['mean']:g}: the mean of a lognormal distribution is above 0")
    law = Distribution(kind, numbers)._law()
    if law.cdf(numbers.get("high", np.inf)) - law.cdf(numbers.get("low", -np.inf)) < 0.01:
        raise ValueError("less than 1 % of the distribution lies between low and high")


def medians(distributions):
    """Of a list its first value."""
    return [one.numbers["values"][0] if one.is_list else one.quantile(0.5) for one in distributions]


def one_at_a_time(distributions, quantiles):
    """Rows of values: first all medians, then one parameter after the other at its other values."""
    base = medians(distributions)
    rows = [base]
    for number, one in enumerate(distributions):
        others = one.numbers["values"][1:] if one.is_list else [one.quantile(quantile) for quantile in quantiles]
        rows += [base[:number] + [value] + base[number + 1:] for value in others]
    return rows


def grid(distributions, levels):
    """All combinations of the values of lists, and of `levels` values of each other distribution, with equal probability each."""
    middles = (np.arange(levels) + 0.5) / levels
    return [list(row) for row in itertools.product(*(one.numbers["values"] if one.is_list else [one.quantile(middle) for middle in middles]
                                                     for one in distributions))]


def sampled(sampling, distributions, n_runs, seed):
    """`n_runs` rows by Latin hypercube or Sobol's sequence (scrambled). Twice as many of Sobol's begin with the same rows."""
    engine = {"Latin hypercube": qmc.LatinHypercube, "Sobol": qmc.Sobol}[sampling](len(distributions), seed=seed)
    return [[one.quantile(place) for one, place in zip(distributions, row)] for row in engine.random(n_runs)]

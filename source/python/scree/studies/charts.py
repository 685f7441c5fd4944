# SPDX-License-Identifier: LGPL-2.1-or-later
"""The kinds of charts of a study.

Each has `timed` (its runs are made one at a time), `keep(run)` (called for each new run) and `write`.
A chart is as wide as a page and shows at most five curves an axes, with their names beside them.
"""

import math

import matplotlib.colors
import matplotlib.patches
import matplotlib.pyplot as plt
import matplotlib.ticker
import numpy as np

from scree.pictures.tables import name_lines
from scree.results import read_rows, write_rows
from scree.studies.measures import BOUNDS, DECIDING

plt.rcParams.update({"svg.hashsalt": "scree", "svg.fonttype": "none", "font.size": 10, "axes.titlesize": 10, "axes.grid": True, "grid.alpha": 0.3,
                     "axes.axisbelow": True, "figure.constrained_layout.use": True, "figure.constrained_layout.w_pad": 0.1})

WIDTH = 8.  # inches: of a page, at a font of 10 points
NEAR = "stable, near a bound"
STATES = {"stable": "#5aa55a", NEAR: "#b5dbb0", "wrong": "#9ecae1", "oscillating": "#ffd966", "energy gain": "#f4a460",
          "J out of bounds": "#b08fc7", "blow-up": "#d9534f"}


def save(figure, target):
    """Writes target.svg."""
    figure.savefig(target.with_suffix(".svg"), metadata={"Date": None})
    plt.close(figure)


def _finite(row, *names):
    return all(isinstance(row.get(name), (int, float)) and math.isfinite(row[name]) for name in names)


def tick_axis(axis):
    """Several ticks with plain numbers on a logarithmic axis, however few decades it spans."""
    low, high = axis.get_view_interval()
    decades = math.log10(high / low)
    subs = (1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8) if decades < 0.7 else (1, 1.5, 2, 3, 5, 7) if decades < 1.3 else (1, 2, 5) if decades < 2.2 else (1, 3) if decades < 3 else (1,)
    axis.set_major_locator(matplotlib.ticker.LogLocator(subs=subs, numticks=20))
    axis.set_major_formatter(matplotlib.ticker.FuncFormatter(lambda value, _: f"{value:.6f}".rstrip("0").rstrip(".") if 0.9e-4 < value < 1e5 else f"{value:.0e}"))
    axis.set_minor_locator(matplotlib.ticker.NullLocator())


class NoChart:
    """Of a study whose table has all numbers; `timed` if times are compared."""

    def __init__(self, timed=False):
        self.timed = timed

    def keep(self, run):
        pass

    def write(self, rows, target):
        pass


class Curves(NoChart):
    """draw(figure, rows) on an empty figure as wide as a page and `height` inches high."""

    def __init__(self, draw, height=4., timed=False):
        super().__init__(timed)
        self.draw, self.height = draw, height

    def write(self, rows, target):
        figure = plt.figure(figsize=(WIDTH, self.height))
        self.draw(figure, rows)
        save(figure, target)


class WorkPrecision(Curves):
    """Error over core-seconds, both logarithmic: the `methods` of the column "method", {method: what it is called in the chart}, best with the
    defaults, the recommended one, the best and the worst. The meshes stand beside the first."""

    def __init__(self, methods, ylabel, annotate="h", unit=" m"):
        super().__init__(self._draw, 4.2, timed=True)
        self.methods, self.ylabel, self.annotate, self.unit = methods, ylabel, annotate, unit

    def _draw(self, figure, rows):
        axes = figure.subplots()
        for index, (method, name) in enumerate(self.methods.items()):
            group = [row for row in rows if row["method"] == method and _finite(row, "error", "core-seconds")]
            style = {"color": "k", "linewidth": 2, "zorder": 3} if index == 0 else {"color": f"C{index - 1}", "linewidth": 1.2}
            axes.plot([row["core-seconds"] for row in group], [row["error"] for row in group], marker="o", markersize=5, label=name, **style)
            for row in group if index == 0 else []:
                last = row is group[-1]
                axes.annotate(f"{self.annotate} = {row[self.annotate]:.3g}{self.unit}", (row["core-seconds"], row["error"]), textcoords="offset points",
                              xytext=(-5, -12) if last else (6, 5), ha="right" if last else "left", fontsize=8, color="0.2", zorder=4,
                              bbox={"facecolor": "w", "edgecolor": "none", "alpha": 0.75, "pad": 0.5})
        axes.set(xscale="log", yscale="log", xlabel="core-seconds of the time steps", ylabel=self.ylabel)
        axes.margins(0.05, 0.1)
        tick_axis(axes.xaxis)
        tick_axis(axes.yaxis)
        name_lines(axes)


class StabilityMap(Curves):
    """The state of each run, as colours (STATES) over `x` and `y`, one panel for each combination of the columns `panels`.

    Of two columns `panels` the first goes down, the second across.
    """

    def __init__(self, x, y, panels=(), xlabel=None, ylabel=None):
        super().__init__(self._draw)
        self.x, self.y, self.panels = x, y, panels
        self.xlabel, self.ylabel = xlabel or x, ylabel or y

    def write(self, rows, target):
        xs, ys = (list(dict.fromkeys(row[name] for row in rows)) for name in (self.x, self.y))
        keys = list(dict.fromkeys(tuple(row[name] for name in self.panels) for row in rows))
        # A line for each value of the first of two columns, a column for each of the second.
        lines, columns = (len({key[index] for key in keys}) for index in (0, 1)) if len(self.panels) == 2 else (1, len(keys))
        self.height = 1. + lines * (0.55 + 0.27 * max(len(ys), 3))
        self.grid = xs, ys, keys, lines, columns
        super().write(rows, target)

    def _draw(self, figure, rows):
        xs, ys, keys, lines, columns = self.grid
        figure.get_layout_engine().set(rect=(0, 0, 1, 1 - 0.32 / self.height))
        states = {id(row): _state(row) for row in rows}
        plots = figure.subplots(lines, columns, squeeze=False, sharex=True, sharey=True)
        for plot, key in zip(plots.flat, keys):
            for row in rows:
                if tuple(row[name] for name in self.panels) == key:
                    plot.add_patch(matplotlib.patches.Rectangle((xs.index(row[self.x]), ys.index(row[self.y])), 1, 1,
                                                                facecolor=STATES.get(states[id(row)], "0.8"), edgecolor="w"))
            plot.set(xlim=(0, len(xs)), ylim=(0, len(ys)))
            plot.set_xticks([index + 0.5 for index in range(len(xs))], list(map(_tick, xs)))
            plot.set_yticks([index + 0.5 for index in range(len(ys))], list(map(_tick, ys)))
            plot.tick_params(length=0, labelsize=9)
            plot.tick_params(axis="x", rotation=90 if columns * sum(0.085 * len(_tick(x)) + 0.1 for x in xs) > 6.4 else 0)
            plot.grid(False)
            plot.set_title(", ".join(f"{name} {_tick(value)}" if isinstance(value, float) else value for name, value in zip(self.panels, key)), fontsize=9)
        figure.supxlabel(self.xlabel, fontsize=10)
        figure.supylabel(self.ylabel, fontsize=10)
        present = [state for state in STATES if state in states.values()]
        figure.legend([matplotlib.patches.Patch(color=STATES[state]) for state in present], present, loc="upper center",
                      ncol=max(1, len(present)), fontsize=9, frameon=False, columnspacing=1., handlelength=1.2)


def _state(row):
    """The state of a cell; of a stable one also whether a number is above half of its bound."""
    near = row["state"] == "stable" and any(row.get(name, 0.) > 0.5 * BOUNDS[name] for names in DECIDING.values() for name in names)
    return NEAR if near else row["state"]


def _tick(value):
    return f"{value:g}" if isinstance(value, float) else str(value)


class RunCurves(Curves):
    """Curves that the table of the runs does not have: curves(run) returns {name: (x, y)}.

    They are kept in NAME_curves.csv, beside the table, and drawn by draw(figure, curves, rows).
    """

    def __init__(self, curves, draw, height=4.):
        super().__init__(draw, height)
        self.curves, self.found = curves, {}

    def keep(self, run):
        self.found.update(self.curves(run))

    def write(self, rows, target):
        table = target.with_name(f"{target.name}_curves.csv")
        if self.found:
            write_rows(table, ["curve", "x", "y"], ([name, f"{x:.4g}", f"{y:.4g}"] for name, points in self.found.items() for x, y in zip(*points)))
        if not table.exists():  # none of the runs of a short version has a curve
            return
        curves = {}
        for row in read_rows(table):
            curves.setdefault(row["curve"], []).append((float(row["x"]), float(row["y"])))
        figure = plt.figure(figsize=(WIDTH, self.height))
        self.draw(figure, {name: np.array(points).T for name, points in curves.items()}, rows)
        save(figure, target)


class Pictures(Curves):
    """Pictures of the runs themselves: draw(figure, runs). Without new runs (--page) the file stays as it is."""

    def __init__(self, draw, height, timed=False):
        super().__init__(draw, height, timed)
        self.runs = []

    def keep(self, run):
        self.runs.append(run)

    def write(self, rows, target):
        if self.runs:
            super().write(self.runs, target)

# SPDX-License-Identifier: LGPL-2.1-or-later
"""The kinds of charts of a study. Each has `timed` (its runs are made one at a time), `complete` (adds columns) and `write`."""

import math

import matplotlib.colors
import matplotlib.patches
import matplotlib.pyplot as plt

plt.rcParams.update({"svg.hashsalt": "scree", "svg.fonttype": "none", "font.size": 9})

STATES = {"stable": "#7fbf7f", "wrong": "#9ecae1", "oscillating": "#ffd966", "energy gain": "#f4a460",
          "J out of bounds": "#b08fc7", "blow-up": "#d9534f"}


def save(figure, target):
    """Writes target.svg."""
    figure.savefig(target.with_suffix(".svg"), metadata={"Date": None})
    plt.close(figure)


def _finite(row, *names):
    return all(isinstance(row.get(name), (int, float)) and math.isfinite(row[name]) for name in names)


def mark_pareto(rows, error, cost="core-seconds"):
    """Adds the column "Pareto": no other run is at least as good in both and better in one."""
    for row in rows:
        row["Pareto"] = _finite(row, error, cost) and not any(
            other[error] <= row[error] and other[cost] <= row[cost] and (other[error], other[cost]) != (row[error], row[cost])
            for other in rows if _finite(other, error, cost))


def excess_cost(rows, row, error, cost="core-seconds"):
    """How many times as long `row` takes as the fastest run that is at least as accurate; 1 on the front."""
    return row[cost] / min(other[cost] for other in rows if _finite(other, error, cost) and other[error] <= row[error])


class WorkPrecision:
    """Error over core-seconds, both logarithmic; a curve for each combination of the columns `curves`, runs `annotate`d by a column."""
    timed = True

    def __init__(self, error, curves, annotate, ylabel):
        self.error, self.curves, self.annotate, self.ylabel = error, curves, annotate, ylabel

    def complete(self, rows):
        mark_pareto(rows, self.error)

    def write(self, rows, title, target):
        figure, axes = plt.subplots(figsize=(11, 6), layout="constrained")
        shown = [row for row in rows if _finite(row, self.error, "core-seconds")]
        groups = {}
        for row in shown:
            groups.setdefault(tuple(row[name] for name in self.curves), []).append(row)
        for index, (key, group) in enumerate(groups.items()):
            label = ", ".join(f"{name} {value:g}" if isinstance(value, float) else str(value) for name, value in zip(self.curves, key))
            axes.plot([row["core-seconds"] for row in group], [row[self.error] for row in group], color=f"C{index % 10}",
                      marker="os^Dv<>"[index // 10 % 7], linestyle=["-", "--", ":"][index // 10 % 3], markersize=4, linewidth=1, label=label)
            for row in group:
                text = row[self.annotate]
                axes.annotate(f"{text:.3g}" if isinstance(text, float) else text, (row["core-seconds"], row[self.error]),
                              textcoords="offset points", xytext=(4, 3), fontsize="x-small", color="0.4")
        for column, style in (("Pareto", {"marker": "o", "markersize": 11, "markeredgecolor": "k", "label": "Pareto-optimal"}),
                              ("default", {"marker": "*", "markersize": 15, "markeredgecolor": "r", "label": "defaults"})):
            marked = [row for row in shown if row.get(column) is True]
            if marked:
                axes.plot([row["core-seconds"] for row in marked], [row[self.error] for row in marked], linestyle="none",
                          markerfacecolor="none", **style)
        axes.set(xscale="log", yscale="log", xlabel="core-seconds of the steps", ylabel=self.ylabel)
        axes.set_title(f"{title}; numbers: {self.annotate}", fontsize="medium")
        axes.grid(alpha=0.3, which="both")
        axes.legend(fontsize="x-small", loc="upper left", bbox_to_anchor=(1.01, 1.))
        save(figure, target)


class StabilityMap:
    """A heat map of the column `value` (a state of STATES) over `x` and `y`, one panel for each combination of the columns `panels`.

    Of two columns `panels` the first goes down, the second across. `number`: a column whose value is written into the cells.
    """
    timed = False

    def __init__(self, x, y, value="state", panels=(), number=None, xlabel=None, ylabel=None):
        self.x, self.y, self.value, self.panels, self.number = x, y, value, panels, number
        self.xlabel, self.ylabel = xlabel or x, ylabel or y

    def complete(self, rows):
        pass

    def write(self, rows, title, target):
        groups = {}
        for row in rows:
            groups.setdefault(tuple(row[name] for name in self.panels), []).append(row)
        xs, ys = (list(dict.fromkeys(row[name] for row in rows)) for name in (self.x, self.y))
        if len(self.panels) == 2:  # a line for each value of the first, a column for each of the second
            lines, columns = (len({key[index] for key in groups}) for index in (0, 1))
        else:
            columns = min(len(groups), 3 if len(xs) <= 8 else 2)
            lines = math.ceil(len(groups) / columns)
        figure, axes = plt.subplots(lines, columns, squeeze=False, layout="constrained",
                                    figsize=(max(5., columns * (0.8 + 0.62 * len(xs))), 1.1 + lines * (0.9 + 0.34 * len(ys))))
        for plot in axes.flat[len(groups):]:
            plot.axis("off")
        for plot, (key, group) in zip(axes.flat, groups.items()):
            for row in group:
                column, line = xs.index(row[self.x]), ys.index(row[self.y])
                plot.add_patch(matplotlib.patches.Rectangle((column, line), 1, 1, facecolor=STATES.get(row[self.value], "0.8"), edgecolor="w"))
                if self.number and _finite(row, self.number):
                    plot.text(column + 0.5, line + 0.5, f"{row[self.number]:.2g}", ha="center", va="center", fontsize=6)
            plot.set(xlim=(0, len(xs)), ylim=(0, len(ys)), xlabel=self.xlabel, ylabel=self.ylabel)
            plot.set_xticks([index + 0.5 for index in range(len(xs))], [_tick(value) for value in xs])
            plot.set_yticks([index + 0.5 for index in range(len(ys))], [_tick(value) for value in ys])
            plot.tick_params(length=0, labelsize=7)
            plot.set_title(", ".join(map(_tick, key)), fontsize="small")
        present = [state for state in STATES if any(row[self.value] == state for row in rows)]
        legend_height = 0.3 / figure.get_figheight()
        figure.get_layout_engine().set(rect=(0, legend_height, 1, 1 - legend_height))
        figure.legend([matplotlib.patches.Patch(color=STATES[state]) for state in present], present, loc="lower center",
                      ncol=max(1, len(present)), fontsize="small", frameon=False)
        figure.suptitle(title + (f"; numbers: {self.number}" if self.number else ""), fontsize="medium")
        save(figure, target)


def _tick(value):
    return f"{value:g}" if isinstance(value, float) else str(value)


class Curves:
    """Anything else: draw(figure, rows) on an empty figure of `size` inches; `timed` if times are compared."""

    def __init__(self, draw, size=(9, 6), timed=False):
        self.draw, self.size, self.timed = draw, size, timed

    def complete(self, rows):
        pass

    def write(self, rows, title, target):
        figure = plt.figure(figsize=self.size, layout="constrained")
        figure.suptitle(title, fontsize="medium")
        self.draw(figure, rows)
        save(figure, target)


class RunCurves(Curves):
    """Curves of the runs themselves, which `measure` hands over with `keep(run)`: draw(figure, runs). Without them (--page) the chart stays as it is."""

    def __init__(self, draw, size=(9, 6), timed=False):
        super().__init__(draw, size, timed)
        self.runs = []

    def keep(self, run):
        self.runs.append(run)

    def write(self, rows, title, target):
        if self.runs:
            super().write(self.runs, title, target)

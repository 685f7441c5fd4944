# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pictures of tables: the statistics of a run, and its probes."""

import pathlib
import re

import matplotlib.pyplot as plt
import numpy as np

from scree import results
from scree.pictures.panels import save_picture

# Panel, and the columns of the statistics that belong to it. A scene has some of them: water's, soil's, a load's.
PANELS = {
    "energy": ["Kinetic energy (J)", "Potential energy (J)", "Elastic energy (J)", "Energy of the averaging (J)", "Plastic dissipation (J)",
               "Wall dissipation (J)", "Bed dissipation (J)", "Numerical dissipation (J)", "Drag dissipation (J)", "Energy entered (J)", "Load work (J)"],
    "run-out": ["Toe displacement (m)", "Largest displacement (m)"],
    "front": ["Front 90 % (m)", "Front 99 % (m)", "Front 99.5 % (m)", "Water front 90 % (m)", "Water front 99 % (m)", "Water front 99.5 % (m)"],
    "force": [],  # on obstacles: their columns have names of the case
    "moment": [],
    "oscillation": ["Stress oscillation (-)", "p oscillation (-)"],
    "step size": ["Time step (s)"],
}
LEAST_ENERGY = 2e-3  # of the largest change of an energy; what is always below it is no line to see
DEFAULT_PANELS = ["energy", "run-out", "force"]
PREFIXES = {-9: "n", -6: "\u00b5", -3: "m", 0: "", 3: "k", 6: "M", 9: "G", 12: "T"}


def _columns(statistics, title):
    """{name: values} of a panel. Energies are changes since the start; columns without any value, and energies too small to see, are left out."""
    names = PANELS[title] or [name for name in statistics if re.match(rf"Obstacle .* {title} . \(", name)]
    columns = {name: statistics[name] for name in names if name in statistics and np.any(np.isfinite(statistics[name]))}
    if title in ("force", "moment"):
        columns = {name: values for name, values in columns.items() if np.any(values != 0)} or columns
    if title == "energy":
        columns = {name: values - values[np.isfinite(values)][0] for name, values in columns.items()}
        largest = max((np.nanmax(np.abs(values)) for values in columns.values()), default=0.)
        columns = {name: values for name, values in columns.items()
                   if np.nanmax(np.abs(values)) > LEAST_ENERGY * largest or name.startswith(("Kinetic", "Numerical"))}
    return columns


def _scaled(columns, unit):
    """Values between 1 and 1000 of a unit with a prefix, and that unit."""
    largest = max(np.nanmax(np.abs(values)) for values in columns.values())
    if unit == "-" or largest == 0 or not np.isfinite(largest):
        return columns, unit
    if unit == "m" and 1e-2 <= largest < 1e5:
        return columns, unit
    power = int(np.clip(3 * np.floor(np.log10(largest) / 3), -9, 12))
    return {name: values / 10. ** power for name, values in columns.items()}, PREFIXES[power] + unit


def name_lines(axes, size=9):
    """The names of the lines of `axes` in its right margin, each at the height of its line's last point, in its colour."""
    lines = [line for line in axes.get_lines() if not line.get_label().startswith("_")]
    axes.figure.canvas.draw()
    inverse, ends = axes.transAxes.inverted(), []
    for line in lines:
        shown = np.isfinite(line.get_xdata().astype(float)) & np.isfinite(line.get_ydata().astype(float))
        places = inverse.transform(axes.transData.transform(np.column_stack([line.get_xdata(), line.get_ydata()])[shown].astype(float)))
        inside = places[(places[:, 0] <= 1.001) & (places[:, 1] <= 1.001) & (places[:, 1] >= -0.001)]
        ends.append(inside[np.argmax(inside[:, 0])] if len(inside) else np.array([1., 1.]))
    names = [line.get_label() for line in lines]
    line_height = 1.25 * size / 72 * axes.figure.dpi / axes.get_window_extent().height
    heights = _spread([end[1] for end in ends], [line_height * (1 + name.count("\n")) for name in names])
    for line, end, name, height in zip(lines, ends, names, heights):
        axes.annotate(name, end, (1.04, height), "axes fraction", "axes fraction", fontsize=size, color=line.get_color(), va="center",
                      arrowprops={"arrowstyle": "-", "color": line.get_color(), "linewidth": 0.5, "alpha": 0.6, "shrinkA": 1, "shrinkB": 3})


def _spread(places, sizes):
    """Places moved apart as little as needed (least squares), so that intervals of these sizes about them do not overlap."""
    order, n = np.argsort(places), len(places)
    sizes = np.asarray(sizes)[order]
    below = np.cumsum(sizes) - sizes
    free = np.asarray(places)[order] - sizes / 2 - below  # of the bottoms, without what lies below: they only must not fall
    rising = [max(min(np.mean(free[low:high + 1]) for high in range(i, n)) for low in range(i + 1)) for i in range(n)]
    return (rising + below + sizes / 2)[np.argsort(order)]


def render_statistics(run, output, titles=None):
    """The columns of interest against time in one PNG, the usual panels or those of the titles; returns False when there is nothing to draw."""
    statistics = results.read_statistics(run)
    if not statistics:
        return False
    time = results.column(statistics, "Time (s)")
    for title in titles or []:
        if title not in PANELS:
            raise ValueError(f"--panels: there is no panel {title}; there are: {', '.join(PANELS)}.")
    defaults = [title if title != "run-out" or _columns(statistics, title) else "front" for title in DEFAULT_PANELS]  # water alone has fronts
    groups = {title: _columns(statistics, title) for title in titles or defaults}
    groups = {title: columns for title, columns in groups.items() if columns}
    if not groups or len(time) == 0:
        return False

    figure, axes = plt.subplots(len(groups), 1, figsize=(8.5, 0.6 + 2.6 * len(groups)), squeeze=False, sharex=True, layout="constrained")
    for panel, (title, columns) in zip(axes.flat, groups.items()):
        columns, unit = _scaled(columns, results.split_unit(next(iter(columns)))[1])
        if title not in ("front", "step size"):
            panel.axhline(0, color="0.6", lw=0.6)
        for name, values in columns.items():
            panel.plot(time, values, lw=1.3, label=_short(name))
        panel.set_ylabel(("change of energy" if title == "energy" else title) + f" ({unit})")
        panel.set_xlim(time[0], time[-1] if time[-1] > time[0] else time[0] + 1.)
        panel.grid(alpha=0.3)
    axes.flat[-1].set_xlabel("time (s)")
    for panel in axes.flat:
        name_lines(panel)
    save_picture(figure, output)
    return True


def _short(name):
    """A column's name without its unit, and without what its panel says."""
    return results.split_unit(name)[0].replace(" energy", "").replace("Obstacle ", "")


def _by_unit(columns):
    """{unit: columns} of names such as "Front (m)"."""
    groups = {}
    for name in columns:
        groups.setdefault(results.split_unit(name)[1], []).append(name)
    return groups


def render_probe(run, name, output):
    """A probe in one PNG: of a line, each quantity along it, a curve a time; of others, all columns against time."""
    table = results.read_table(pathlib.Path(run) / f"probe_{name}.csv")
    shown = [key for key in table if key not in ("Time (s)", "Distance (m)", "x (m)", "y (m)", "z (m)") and np.any(np.isfinite(table[key]))]
    if not shown:
        raise ValueError(f"probe_{name} has no numbers: there was never material.")
    is_line = "Distance (m)" in table
    groups = [(key, [key]) for key in shown] if is_line else list(_by_unit(shown).items())
    columns = 3 if is_line else 1
    rows = -(-len(groups) // columns)
    figure, axes = plt.subplots(rows, columns, figsize=(11 if is_line else 8, 0.6 + 2.3 * rows), squeeze=False, sharex=True,
                                layout="constrained")
    for panel in axes.flat[len(groups):]:
        panel.set_visible(False)
    times = np.unique(table["Time (s)"])
    for panel, (title, names) in zip(axes.flat, groups):
        if is_line:
            for i, time in enumerate(times):
                at = table["Time (s)"] == time
                panel.plot(table["Distance (m)"][at], table[title][at], color=plt.get_cmap("viridis")(i / max(1, len(times) - 1) * 0.9))
            panel.set_xlabel("distance (m)")
        else:
            for key in names:
                panel.plot(table["Time (s)"], table[key], label=results.split_unit(key)[0])
            panel.legend(fontsize="small", loc="best")
        panel.set_ylabel(title if is_line else f"({title})")
        panel.grid(alpha=0.3)
    if is_line:
        figure.suptitle(f"{name}, from t = {times[0]:.4g} s (dark) to {times[-1]:.4g} s (bright)", fontsize="medium")
    else:
        axes.flat[-1].set_xlabel("time (s)")
    save_picture(figure, output)

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pictures of a study: maps and profiles of probability, curve of exceedance, tornado, rank correlations, values of the runs."""

import textwrap

import matplotlib.pyplot as plt
import numpy as np

from scree import maps
from scree.pictures.panels import save_picture
from scree.scenarios import evaluation

LOW, HIGH = "#3b75af", "#c8553d"
UNITS = {"thickness": ("m", 1.), "speed": ("m/s", 1.), "pressure": ("kPa", 1e-3)}


def threshold_text(quantity, threshold):
    unit, factor = UNITS[quantity]
    return f"{quantity} above {factor * threshold:g} {unit}"


def draw_probabilities(run, probabilities, source, word, n_runs, output):
    """Maps of {(quantity, threshold): Raster} in 3D over the terrain of `run`; `source`: thickness of the release or None."""
    sheet = []
    for (quantity, threshold), raster in probabilities.items():
        text = threshold_text(quantity, threshold)
        kind = maps.Kind(text, "%", 100., "YlOrRd", (0.05, 1.))
        sheet.append(maps.Map(quantity, text[0].upper() + text[1:], kind, raster._replace(values=np.where(raster.values > 0, 100 * raster.values, np.nan))))
    notes = [f"{word}, from {n_runs} runs; no colour: in no run"] + (["dashed: outline of the release in all runs together"] if source else [])
    maps.render_sheet(run, sheet, source, notes, output)


def draw_nearest(run, event, output):
    """Largest thickness and deposit of a run in 3D over the terrain, with the outlines of what was observed."""
    observed = {name: area for name, area in (("largest_thickness", event.impact), ("thickness", event.deposit)) if area is not None}
    source = maps.release(run)
    notes = ["red: observed area"] + (["dashed: outline of the release"] if source else [])
    maps.render_sheet(run, [maps.read_map(run, name) for name in observed], source, notes, output, observed)


def draw_profiles(probabilities, word, n_runs, output):
    """Probabilities in 2D against x."""
    quantities = list(dict.fromkeys(quantity for quantity, _ in probabilities))
    figure, panels = plt.subplots(len(quantities), 1, figsize=(8, 0.7 + 2.1 * len(quantities)), squeeze=False, sharex=True, layout="constrained")
    for axes, quantity in zip(panels[:, 0], quantities):
        for (other, threshold), raster in probabilities.items():
            if other == quantity:
                x = raster.x + raster.width * (np.arange(raster.values.shape[1]) + 0.5)
                axes.step(x, 100 * raster.values[0], where="mid", label=threshold_text(quantity, threshold))
        axes.set(ylabel=f"{word}, %", ylim=(0, 105))
        axes.legend(fontsize=8)
        axes.grid(alpha=0.3)
    panels[-1, 0].set_xlabel("x (m)")
    panels[0, 0].set_title(f"from {n_runs} runs", fontsize=9, loc="left")
    save_picture(figure, output, 120)


def draw_exceedance(result, values, output):
    """The part of the runs that reach or exceed each value, and the quantiles."""
    sorted_values, part = evaluation.exceedance(values)
    figure, axes = plt.subplots(figsize=(6.5, 4), layout="constrained")
    x, y = np.concatenate([[sorted_values[0]], sorted_values]), np.concatenate([[1.], part])
    axes.step(np.append(x, x[-1]), 100 * np.append(y, 0.), where="pre", color=LOW, lw=1.6)
    margin = 0.06 * max(np.ptp(sorted_values), 1e-9 * abs(sorted_values[0]), 1e-12)
    axes.set_xlim(sorted_values[0] - margin, sorted_values[-1] + margin)
    for quantile, value in zip(evaluation.QUANTILES, evaluation.quantiles(values)):
        axes.plot([value, value], [0, 100 * (1 - quantile)], color="0.5", lw=0.8, ls="--")
        axes.annotate(f"{value:.4g}", (value, 100 * (1 - quantile)), textcoords="offset points", xytext=(5, 4), fontsize=8)
    axes.set(xlabel=result.label, ylabel="runs that reach or exceed it, %", ylim=(0, 108))
    axes.set_title(f"{len(values)} runs; dashed: 5, 25, 50, 75 and 95 % of the runs stay below", fontsize=9, loc="left")
    axes.grid(alpha=0.3)
    save_picture(figure, output, 120)


def _label(text):
    """A name of an entry in lines of at most 24 characters, broken at its subsections."""
    *path, name = text.split("/")
    return textwrap.fill(name, 24) + ("\n" + textwrap.shorten("/".join(path), 26) if path else "")


def draw_tornado(charts, output):
    """Bars of what each parameter alone changes; `charts`: {Result: (base, bars)}."""
    n_bars = max(len(bars) for _, bars in charts.values())
    figure, panels = plt.subplots(len(charts), 1, figsize=(7.5, len(charts) * (0.75 + 0.55 * n_bars)), squeeze=False, layout="constrained")
    for axes, (result, (base, bars)) in zip(panels[:, 0], charts.items()):
        for place, bar in enumerate(bars):
            for value, number in ((bar.values[0], bar.results[0]), (bar.values[-1], bar.results[-1])):
                axes.barh(place, number - base, left=base, height=0.6, color=LOW if number is bar.results[0] else HIGH, alpha=0.85)
            ends = sorted(((bar.results[0], bar.values[0]), (bar.results[-1], bar.values[-1])), key=lambda end: end[0])
            for (number, value), side in zip(ends, (-1, 1)):
                outer = min(number, base) if side < 0 else max(number, base)
                axes.annotate(_short(value), (outer, place), textcoords="offset points", xytext=(4 * side, 0), ha="right" if side < 0 else "left", va="center",
                              fontsize=8)
            for number in bar.results[1:-1]:
                axes.plot([number, number], [place - 0.3, place + 0.3], color="black", lw=0.8)
        axes.axvline(base, color="black", lw=1)
        axes.set_yticks(range(len(bars)), [_label(bar.label) for bar in bars], fontsize=8)
        axes.invert_yaxis()
        axes.margins(x=0.15)
        axes.set_xlabel(result.label)
        axes.set_title(f"base run {base:.4g}" + (f" {result.unit}" if result.unit != "-" else "") + "; blue: lowest value of the parameter, red: highest",
                       fontsize=9, loc="left")
        axes.grid(alpha=0.3, axis="x")
    save_picture(figure, output, 120)


def _short(value):
    return f"{value:.4g}" if isinstance(value, (int, float)) else textwrap.shorten(str(value), 20)


def draw_influences(charts, output):
    """Bars of rank correlations; `charts`: {Result: [Influence]}."""
    n_bars = max(len(bars) for bars in charts.values())
    figure, panels = plt.subplots(1, len(charts), figsize=(1.9 + 2.7 * len(charts), 1.1 + 0.5 * n_bars), squeeze=False, sharey=True, layout="constrained")
    labels = [one.label for one in next(iter(charts.values()))]
    for axes, (result, bars) in zip(panels[0], charts.items()):
        by_label = {one.label: one for one in bars}
        for place, label in enumerate(labels):
            if label in by_label:
                one = by_label[label]
                axes.barh(place, one.correlation, height=0.6, color=HIGH if one.correlation > 0 else LOW,
                          alpha=0.85 if abs(one.correlation) > one.bound else 0.35)
        axes.axvspan(-bars[0].bound, bars[0].bound, color="0.9", zorder=0)
        axes.axvline(0, color="black", lw=0.8)
        axes.set(xlim=(-1.05, 1.05), xlabel="rank correlation")
        axes.set_title(result.name, fontsize=9, loc="left")
        axes.grid(alpha=0.3, axis="x")
    panels[0, 0].set_yticks(range(len(labels)), [_label(label) for label in labels], fontsize=8)
    panels[0, 0].invert_yaxis()
    save_picture(figure, output, 120)


def draw_values(parameters, rows, result, values, output):
    """The result of each run against each parameter."""
    columns = 2 if len(parameters) == 4 else min(3, len(parameters))
    lines = -(-len(parameters) // columns)
    figure, panels = plt.subplots(lines, columns, figsize=(0.6 + 3 * columns, 2.8 * lines), squeeze=False, sharey=True, layout="constrained")
    for place, axes in enumerate(panels.flat):
        if place >= len(parameters):
            axes.set_axis_off()
            continue
        column = [row[place] for row in rows]
        axes.plot(column if all(isinstance(value, (int, float)) for value in column) else [_short(value) for value in column], values, "o", ms=4, color=LOW,
                  alpha=0.7)
        axes.set_xlabel(_label(parameters[place].label), fontsize=8)
        axes.tick_params(labelsize=8)
        axes.grid(alpha=0.3)
    for axes in panels[:, 0]:
        axes.set_ylabel(result.label, fontsize=8)
    save_picture(figure, output, 120)

# SPDX-License-Identifier: LGPL-2.1-or-later
"""The scene of a run before its first step: bodies, water, ground, walls, loads and probes in the box."""

import contextlib
import pathlib
import re
import sys

import matplotlib.colors
import matplotlib.patches
import matplotlib.patheffects
import matplotlib.path
import matplotlib.pyplot as plt
import numpy as np

from scree import expressions, results, variants
from scree.pictures import panels, plane, rigid

LOAD, PROBE = "#c0202a", "#7b2d8b"
WALL_STYLES = {"fixed": "-", "free slip": "--", "open": ":"}  # others, such as friction, have dots and dashes


class _Colours(tuple):
    """One colour a body, in place of the scale of a field."""
    name = "body"

    @property
    def mappable(self):
        return plt.cm.ScalarMappable(matplotlib.colors.Normalize(-0.5, len(self) - 0.5), matplotlib.colors.ListedColormap(self))


def _numbers(text):
    return [float(word) for word in text.replace(" to ", ",").split(",")]


def _draw_walls(axes, box, entries):
    middle, size = 0.5 * (box.lower + box.upper), np.max(box.upper - box.lower)
    for face, axis, end, default in (("Left", 0, box.lower, "free slip"), ("Right", 0, box.upper, "free slip"),
                                     ("Bottom", 1, box.lower, "fixed"), ("Top", 1, box.upper, "open")):
        wall, ends = entries.get(f"Boundaries/{face}", default), np.array([box.lower, box.upper])
        ends[:, axis] = end[axis]
        place = np.mean(ends, axis=0)
        place[axis] += 0.025 * size * np.sign(middle - end)[axis]
        inflows = [key.split("/")[0] for key, value in entries.items() if re.match("Inflow [^/]*/Face$", key) and value == face]
        axes.plot(*ends.T, color="0.1", lw=2.5, ls=WALL_STYLES.get(wall, "-."), clip_on=False, zorder=7)
        axes.text(*place, ", ".join([wall, *inflows]), rotation=90 * (axis == 0), ha="center", va="center", fontsize="x-small",
                  bbox={"facecolor": "white", "alpha": 0.7, "lw": 0, "pad": 1.5}, zorder=8)


def _draw_loads_and_probes(axes, box, entries):
    label = {"fontsize": "x-small", "xytext": (3, 3), "textcoords": "offset points", "zorder": 9}
    if entries.get("Surface load/Traction"):
        lower, upper = (np.array(_numbers(entries[f"Surface load/{end} corner"])[:2]) for end in ("Lower", "Upper"))
        axes.plot(*np.transpose([lower, upper]), color=LOAD, lw=4, zorder=8)
        axes.annotate(f"{entries['Surface load/Traction']} Pa", 0.5 * (lower + upper), color=LOAD, **label)
    for kind in ("Places", "Lines", "Verticals"):
        for probe in filter(str.strip, entries.get(f"Probes/{kind}", "").split(";")):
            name, _, place = probe.partition(":")
            ends = np.reshape(_numbers(place), (-1, 1 if kind == "Verticals" else 2))
            if kind == "Verticals":
                ends = np.column_stack([np.repeat(ends, 2), [box.lower[1], box.upper[1]]])
            axes.plot(*ends.T, color=PROBE, lw=1., ls="--", marker="x" if kind == "Places" else None, zorder=8)
            axes.annotate(name.strip(), ends[-1] - [0, 0.06 * (kind == "Verticals") * (box.upper[1] - box.lower[1])], color=PROBE, **label)


def _in_layer(drawing, layer, places):
    """Which places are in the areas of a layer."""
    corners, is_in = np.column_stack([place.ravel() for place in places]), np.zeros(places[0].size, bool)
    for rings in results.read_layer(drawing, layer):
        is_in |= np.bitwise_xor.reduce([matplotlib.path.Path(ring).contains_points(corners) for ring in rings])
    return is_in.reshape(places[0].shape)


def stage_areas(run, entries, places, is_soil):
    """Yields what stages remove from soil and add to it as (label, whether it is added, which places)."""
    for stage in dict.fromkeys(key.split("/")[0] for key in entries if key.startswith("Stage ")):
        parts = [("", stage, "Remove", "Remove layer")] + [(name.strip(), name.strip(), "Region", "Layer") for name in entries.get(f"{stage}/Add", "").split(",") if name.strip()]
        for body, subsection, expression, layer in parts:
            text, name = (entries.get(f"{subsection}/{entry}", "") for entry in (expression, layer))
            if not text and not name:
                continue
            try:
                mask = _in_layer(pathlib.Path(run) / entries["Drawing"], name, places) if name else np.broadcast_to(
                    expressions.evaluate(text, **dict(zip("xy", places))) != 0, is_soil.shape)
            except (RuntimeError, ValueError, KeyError) as error:
                print(f"scree-render: subsection {subsection} is not drawn: {error}.", file=sys.stderr)
                continue
            mask = mask & (is_soil != bool(body))
            is_soil = is_soil != mask
            yield stage.removeprefix("Stage ") + (f": {body}" if body else ": removed"), bool(body), mask


def _draw_stages(axes, run, box, entries, first):
    """What is removed with dashes, what is added with hatches, each with the name of its stage."""
    panel = plane.panel_of(axes, box, run, first.time)
    is_soil = plane.fill(first, box, panel.pixels, panel.is_open) > 0.5
    for label, is_added, mask in stage_areas(run, entries, np.meshgrid(*panel.pixels.centres), is_soil):
        mask &= panel.is_open
        if not mask.any():
            continue
        if is_added:
            axes.contourf(*panel.pixels.centres, mask, levels=[0.5, 1.5], colors="none", hatches=["//"], zorder=6)
        axes.contour(*panel.pixels.centres, mask, levels=[0.5], colors="0.1", linewidths=1.4, linestyles="-" if is_added else "--", zorder=6)
        row, column = np.argwhere(mask)[np.argmin(np.linalg.norm(np.argwhere(mask) - np.argwhere(mask).mean(axis=0), axis=1))]
        axes.text(panel.pixels.centres[0][column], panel.pixels.centres[1][row], label, ha="center", va="center", fontsize="x-small", zorder=9,
                  path_effects=[matplotlib.patheffects.withStroke(linewidth=2, foreground="white")])


def bodies(entries):
    """The bodies in the order of their numbers at the points: those that stages add come last."""
    names = [name.strip() for name in entries.get("Bodies", "Soil").split(",") if name.strip() not in ("", "none")]
    added = [name.strip() for key, value in entries.items() if key.startswith("Stage ") and key.endswith("/Add") for name in value.split(",")]
    return sorted(names, key=lambda name: added.index(name) if name in added else -1)


def render_scene(run, output, view=None):
    """The first picture of a run folder as a PNG; `view` in 3D: azimuth and elevation of the camera, degrees."""
    box, entries = results.read_box(run), variants.read_entries(pathlib.Path(run) / "parameters.prm")
    collection = next((name for name in ("points", "water") if panels.has_collection(run, name)), None)
    if collection is None:
        raise ValueError(f"{run} has no pictures of points: write another \"Graphics\" in subsection Output.")
    first = results.read_points(run, results.read_times(run, collection)[0], collection)
    if "body" not in first.arrays:
        first.arrays["body"] = np.zeros(len(first.positions))
    names = bodies(entries)
    shown = [number for number in range(len(names)) if np.any(np.round(first.arrays["body"]) == number)] if collection == "points" else []
    palette = plt.get_cmap("Set2" if len(names) <= 8 else "tab20")
    colours = _Colours([palette(number % palette.N) for number in range(len(names))] or [palette(2)])
    with contextlib.ExitStack() as stack:
        is_plane = box.dim == 2
        drawing = (panels._Plane if is_plane else panels._Space)(run, box, colours, collection, [first], stack, view, 1300)  # pylint: disable=protected-access
        figure, axes = plt.subplots(figsize=(10, np.clip(8.5 * drawing.ratio, 1.5, 10) + 1.2), layout="constrained")
        drawing.draw(axes, first, True)
        of_the_rest = axes.get_legend()
        if is_plane:
            _draw_walls(axes, box, entries)
            _draw_loads_and_probes(axes, box, entries)
            _draw_stages(axes, run, box, entries, first)
        patches = [matplotlib.patches.Patch(facecolor="0.45" if number in rigid.rigid_bodies(run) else colours[number], edgecolor="0.3",
                                            label=f"{names[number]} ({entries.get(names[number] + '/Material', 'Mohr-Coulomb')})") for number in shown]
        if patches:
            columns = 4 if len(patches) != 5 else 3
            axes.set_title("\n" * (-(-len(patches) // columns)), fontsize="small")  # room for the legend
            figure.legend(handles=patches, loc="upper center", ncols=columns, fontsize="small", frameon=False)
        if of_the_rest:
            of_the_rest.set_zorder(10)
        panels.save_picture(figure, output)

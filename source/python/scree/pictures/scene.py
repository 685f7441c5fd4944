# SPDX-License-Identifier: LGPL-2.1-or-later
"""The scene of a run before its first step: bodies, water, ground, walls, loads and probes in the box."""

import contextlib
import pathlib
import re

import matplotlib.colors
import matplotlib.patches
import matplotlib.pyplot as plt
import numpy as np

from scree import results, variants
from scree.pictures import panels, rigid

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
        patches = [matplotlib.patches.Patch(facecolor="0.45" if number in rigid.rigid_bodies(run) else colours[number], edgecolor="0.3",
                                            label=f"{names[number]} ({entries.get(names[number] + '/Material', 'Mohr-Coulomb')})") for number in shown]
        if patches:
            columns = 4 if len(patches) != 5 else 3
            axes.set_title("\n" * (-(-len(patches) // columns)), fontsize="small")  # room for the legend
            figure.legend(handles=patches, loc="upper center", ncols=columns, fontsize="small", frameon=False)
        if of_the_rest:
            of_the_rest.set_zorder(10)
        panels.save_picture(figure, output)

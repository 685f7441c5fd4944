# SPDX-License-Identifier: LGPL-2.1-or-later
"""Draws a run folder: its points at a few times, and its statistics against time.

scree-render results/quickstart --field deviatoric_stress --times 0,0.5,1

With --animate gif (or mp4, which needs ffmpeg) it makes a film of them instead: points.gif, water.gif.

Writes points.png, of the soil, water.png, of the water, and statistics.png into the run folder; what is asked for (--field, --times, --limits)
is part of a picture's name. --probe NAME draws a probe instead.
"""

import pathlib
import re
from typing import NamedTuple

import matplotlib
import matplotlib.animation
import matplotlib.collections
import matplotlib.pyplot as plt
import numpy as np

from scree import results, variants
from scree.command import Command


class Field(NamedTuple):
    """How a field is shown: its name in words, the unit, and the factor from SI to that unit."""
    label: str
    unit: str
    factor: float
    colours: str = "viridis"


FIELDS = {
    "mean_effective_stress": Field("mean effective stress", "kPa", 1e-3),
    "deviatoric_stress": Field("deviatoric stress", "kPa", 1e-3),
    "stress_ratio": Field("stress ratio", "", 1),
    "stress": Field("norm of the stress", "kPa", 1e-3),
    "velocity": Field("speed", "m/s", 1),
    "specific_volume": Field("specific volume", "", 1),
    "state_parameter": Field("state parameter", "", 1, "RdBu_r"),
    "plastic_shear_strain": Field("plastic shear strain", "", 1, "magma"),
    "mass": Field("mass", "kg", 1),
    "porosity": Field("porosity", "", 1),
    "pore_pressure": Field("pore pressure", "kPa", 1e-3),
    "seepage_velocity": Field("seepage velocity", "m/s", 1),
    "pressure": Field("pore pressure", "kPa", 1e-3),
}

DEFAULT_FIELDS = {"points": "mean_effective_stress", "water": "pressure"}  # of each collection


# Rigid ground ---------------------------------------------------------------------------------------------------------


def _expression(text, **variables):
    """The value of a case's expression where numpy and muParser agree but for the spelling."""
    text = re.sub(r"\bif\(", "where(", text.replace("^", "**").replace("&&", "&").replace("||", "|"))
    functions = {"where": np.where, "sqrt": np.sqrt, "abs": np.abs, "sin": np.sin, "cos": np.cos, "tan": np.tan, "exp": np.exp, "pi": np.pi,
                 "min": lambda *values: np.minimum.reduce(np.broadcast_arrays(*values)),
                 "max": lambda *values: np.maximum.reduce(np.broadcast_arrays(*values))}
    return eval(text, {"__builtins__": {}}, {**functions, **variables})  # pylint: disable=eval-used


def rigid_ground(run, x, y, time):
    """Level sets of bed and obstacles of a plane run at places and a time: positive in the open. Those that cannot be read are left out."""
    entries = variants.read_entries(pathlib.Path(run) / "parameters.prm")
    statistics = results.read_statistics(run) if (pathlib.Path(run) / "statistics").exists() else {}
    surfaces = []
    for key, kind in entries.items():
        subsection, _, name = key.rpartition("/")
        if name != "Type" or not re.match(r"(Bed|Obstacle .*)$", subsection) or kind == "none":
            continue
        ways = [f"{subsection} displacement {axis} (m)" for axis in "xy"]
        moved = [np.interp(time, statistics["Time (s)"], statistics[way]) if way in statistics else 0. for way in ways]
        profile = variants.file_named(pathlib.Path(run) / "parameters.prm", entries.get(subsection + "/Profile", ""))
        try:
            if profile:
                points = np.array([[float(word) for word in re.split(r"[,\s]+", line.strip())[:2]]
                                   for line in profile.read_text(encoding="utf-8").splitlines() if re.match(r"\s*[-+.0-9]", line)])
                surfaces.append(y - moved[1] - np.interp(x - moved[0], *points.T))
            else:
                surfaces.append(_expression(entries[subsection + "/Level set expression"], x=x - moved[0], y=y - moved[1]))
        except (SyntaxError, NameError, TypeError, ValueError):
            continue
    return surfaces


def draw_ground(axes, run, box, time):
    """Fills what is rigid in a plane picture."""
    x, y = np.meshgrid(*(np.linspace(box.lower[a], box.upper[a], 801) for a in range(2)))
    for surface in rigid_ground(run, x, y, time):
        axes.contourf(x, y, surface, levels=[-np.inf, 0], colors=["0.75"])


# Drawing --------------------------------------------------------------------------------------------------------------


def field_style(name):
    return FIELDS.get(name, Field(name.replace("_", " "), "", 1))


def field_label(name):
    style = field_style(name)
    return f"{style.label} ({style.unit})" if style.unit else style.label


def field_values(points, name):
    """A field in its display unit, one number a point; of a vector or tensor the norm."""
    if len(points.positions) == 0:
        return np.zeros(0)
    if name not in points.arrays:
        raise KeyError(f"No field {name}; there are: {', '.join(sorted(points.arrays))}.")
    values = field_style(name).factor * points.arrays[name]
    return values if values.ndim == 1 else np.linalg.norm(values, axis=1)


def colour_limits(values, name):
    """From the first to the 99th percentile: single points must not take the colours from all others."""
    values = values[np.isfinite(values)]
    if len(values) == 0:
        return 0., 1.
    low, high = np.percentile(values, [1, 99])
    if field_style(name).colours.startswith("RdBu"):
        high = max(abs(low), abs(high))
        low = -high
    elif 0 <= low < 0.3 * high:
        low = 0.
    return (low, high) if high > low else (low - 0.5, high + 0.5)


def point_sides(points, box):
    """Side of the square (or cube) with each point's volume, m."""
    if "volume" not in points.arrays:
        return np.full(len(points.positions), box.cell_size / 4)
    sides = np.maximum(points.arrays["volume"], 0) ** (1 / box.dim)
    # A point that flies alone keeps opening; its volume is no longer the room it fills.
    return np.minimum(sides, 1.3 * np.median(sides))


def draw_points(axes, points, box, name, limits):
    """Draws the points of one picture, coloured by a field; returns what a colour bar needs."""
    values = field_values(points, name)
    if box.dim == 3:
        return _draw_points_3d(axes, points, box, values, limits, field_style(name).colours)
    centres = points.positions[:, None, :2]
    # A little larger than the point, so that a stretched body does not look like a comb.
    half = 0.6 * point_sides(points, box)[:, None, None]
    corners = centres + half * np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) if len(values) else []
    squares = matplotlib.collections.PolyCollection(corners, array=values, cmap=field_style(name).colours,
                                                    linewidths=0, antialiased=False, rasterized=True)
    squares.set_clim(*limits)
    axes.add_collection(squares)
    axes.set_xlim(box.lower[0], box.upper[0])
    axes.set_ylim(box.lower[1], box.upper[1])
    axes.set_aspect("equal")
    axes.set_xlabel("x (m)")
    axes.set_ylabel("y (m)")
    return squares


def _draw_points_3d(axes, points, box, values, limits, colours):
    # Gravity's axis points up in the picture.
    order = [axis for axis in range(3) if axis != box.vertical] + [box.vertical]
    size = box.upper - box.lower
    inches_a_metre = 0.55 * axes.figure.get_figwidth() / len(axes.figure.axes) ** 0.5 / max(size)
    sides = point_sides(points, box) if len(values) else np.zeros(0)
    scatter = axes.scatter(*points.positions[:, order].T, c=values, cmap=colours, marker="s",
                           s=np.maximum(72 * sides * inches_a_metre, 0.5) ** 2, linewidths=0, depthshade=False)
    scatter.set_clim(*limits)
    setters = [(axes.set_xlim, axes.set_xlabel, axes.xaxis), (axes.set_ylim, axes.set_ylabel, axes.yaxis), (axes.set_zlim, axes.set_zlabel, axes.zaxis)]
    for axis, (set_limits, set_label, line) in zip(order, setters):
        set_limits(box.lower[axis], box.upper[axis])
        set_label(f"{'xyz'[axis]} (m)")
        line.get_major_locator().set_params(nbins=max(2, round(6 * size[axis] / max(size))))
    axes.set_box_aspect(size[order])
    axes.view_init(elev=25, azim=-60)
    return scatter


def panels(rows, columns, box, width=10.):
    """Figure and axes of rows x columns pictures of the box, without much white around them."""
    three_dimensional = box.dim == 3
    size = box.upper - box.lower
    ratio = 0.75 if three_dimensional else size[1] / size[0]
    height = rows * (ratio * (width - 1.5) / columns + 0.4) + 0.4
    return plt.subplots(rows, columns, figsize=(width, height), squeeze=False, layout="constrained",
                        sharex=not three_dimensional, sharey=not three_dimensional,
                        subplot_kw={"projection": "3d"} if three_dimensional else {})


def has_collection(run, collection):
    return (pathlib.Path(run) / "solution" / f"{collection}.pvd").exists()


def render_points(run, output, name, times=None, limits=None, collection="points"):
    """Panels of a few times (default: first, a quarter, half, last) in one PNG."""
    box = results.read_box(run)
    if times is None:
        available = results.read_times(run, collection)
        times = available[0] + np.array([0, 0.25, 0.5, 1]) * (available[-1] - available[0])
    else:
        times = results.pictures_at(run, times, collection)
    pictures = {picture.time: picture for picture in (results.read_points(run, time, collection) for time in times)}
    pictures = [pictures[time] for time in sorted(pictures)]
    if limits is None:
        limits = colour_limits(np.concatenate([field_values(points, name) for points in pictures]), name)

    size = box.upper - box.lower
    columns = 1 if box.dim == 2 and size[0] > 2 * size[1] else min(2, len(pictures))
    rows = -(-len(pictures) // columns)
    figure, axes = panels(rows, columns, box)
    for panel in axes.flat[len(pictures):]:
        panel.set_visible(False)
    for panel, points in zip(axes.flat, pictures):
        drawn = draw_points(panel, points, box, name, limits)
        panel.set_title(f"t = {points.time:.4g} s", fontsize="medium")
        if box.dim == 2:
            draw_ground(panel, run, box, points.time)
            panel.label_outer()
    figure.colorbar(drawn, ax=axes, label=field_label(name), extend="both", aspect=40, shrink=0.8, pad=0.02 if box.dim == 2 else 0.08)
    figure.savefig(output, dpi=150)
    plt.close(figure)


FILM_WRITERS = {"gif": ("pillow", "Pillow", "python3-pil"), "mp4": ("ffmpeg", "ffmpeg", "ffmpeg")}  # of matplotlib; program; Debian's package


def film_writer(kind, frames_per_second=10):
    """matplotlib's writer of a kind of film."""
    name, program, package = FILM_WRITERS[kind]
    if not matplotlib.animation.writers.is_available(name):
        other = next(one for one in FILM_WRITERS if one != kind)
        raise ValueError(f"--animate {kind}: {program} is missing. Install {package}, or write --animate {other}")
    return matplotlib.animation.writers[name](fps=frames_per_second)


def animate_points(run, output, name, kind, times=None, limits=None, collection="points"):
    """A film of all pictures, or of those at `times`, ten a second; colours are the same in all of them."""
    box, writer = results.read_box(run), film_writer(kind)
    available = results.read_times(run, collection)
    frames = available if times is None else results.pictures_at(run, times, collection)
    if limits is None:
        shown = [available[i] for i in np.unique(np.linspace(0, len(available) - 1, 5).astype(int))]
        limits = colour_limits(np.concatenate([field_values(results.read_points(run, time, collection), name) for time in shown]), name)
    figure, axes = panels(1, 1, box)
    panel = axes[0, 0]
    with writer.saving(figure, output, dpi=100):
        for number, time in enumerate(frames):
            panel.clear()
            drawn = draw_points(panel, results.read_points(run, time, collection), box, name, limits)
            panel.set_title(f"t = {time:.4g} s", fontsize="medium")
            if box.dim == 2:
                draw_ground(panel, run, box, time)
            if number == 0:
                figure.colorbar(drawn, ax=axes, label=field_label(name), extend="both", aspect=40, shrink=0.8, pad=0.02 if box.dim == 2 else 0.08)
            writer.grab_frame()
    plt.close(figure)


# Title of the panel, and the columns of the statistics that belong to it. A scene has some of them: water's, soil's, a load's.
STATISTICS_PANELS = {
    "energy": ["Kinetic energy (J)", "Potential energy (J)", "Elastic energy (J)", "Plastic dissipation (J)", "Wall dissipation (J)",
               "Numerical dissipation (J)", "Drag dissipation (J)", "Load work (J)"],
    "front": ["Front 90 % (m)", "Front 99 % (m)", "Front 99.5 % (m)", "Water front 90 % (m)", "Water front 99 % (m)", "Water front 99.5 % (m)"],
    "force": [],  # on obstacles: their columns have names of the case
    "moment": [],
    "oscillation": ["Stress oscillation (-)", "p oscillation (-)"],
    "step size": ["Time step (s)"],
}


def render_statistics(run, output, titles=None):
    """The columns of interest against time in one PNG, all panels or those of the titles; returns False when there is nothing to draw."""
    statistics = results.read_statistics(run)
    if not statistics:
        return False
    time = results.column(statistics, "Time (s)")
    groups = []
    for title in titles or STATISTICS_PANELS:
        if title not in STATISTICS_PANELS:
            raise ValueError(f"--panels: there is no panel {title}; there are: {', '.join(STATISTICS_PANELS)}.")
        names = STATISTICS_PANELS[title]
        names = names or [name for name in statistics if re.match(rf"Obstacle .* {title} . \(", name)]
        names = [name for name in names if name in statistics and np.any(np.isfinite(statistics[name]))]
        if names:
            groups.append((title, names))
    if not groups:
        return False

    figure, axes = plt.subplots(len(groups), 1, figsize=(8, 0.6 + 2.3 * len(groups)), squeeze=False, sharex=True,
                                layout="constrained")
    for panel, (title, names) in zip(axes.flat, groups):
        units = {match.group(1) for match in (re.search(r"\(([^()]*)\)\s*$", name) for name in names) if match}
        for name in names:
            panel.plot(time, statistics[name], label=_without_unit(name) if len(units) == 1 else name)
        panel.set_ylabel(f"{title} ({units.pop()})" if len(units) == 1 else title)
        panel.legend(fontsize="small", loc="best")
        panel.grid(alpha=0.3)
    axes.flat[-1].set_xlabel("time (s)")
    figure.savefig(output, dpi=150)
    plt.close(figure)
    return True


def _by_unit(columns):
    """{unit: columns} of names such as "Front (m)"."""
    groups = {}
    for name in columns:
        unit = re.search(r"\(([^()]*)\)\s*$", name)
        groups.setdefault(unit.group(1) if unit else "", []).append(name)
    return groups


def _without_unit(name):
    return re.sub(r"\s*\([^()]*\)\s*$", "", name)


def render_probe(run, name, output):
    """A probe in one PNG: of a line, each quantity along it, a curve a time; of others, all columns against time."""
    table = results.read_table(pathlib.Path(run) / f"probe_{name}")
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
                panel.plot(table["Time (s)"], table[key], label=_without_unit(key))
            panel.legend(fontsize="small", loc="best")
        panel.set_ylabel(title if is_line else f"({title})")
        panel.grid(alpha=0.3)
    if is_line:
        figure.suptitle(f"{name}, from t = {times[0]:.4g} s (dark) to {times[-1]:.4g} s (bright)", fontsize="medium")
    else:
        axes.flat[-1].set_xlabel("time (s)")
    figure.savefig(output, dpi=150)
    plt.close(figure)


def draw_probes(arguments):
    """Draws the probes that the command line names. Throws OSError or ValueError."""
    for name in arguments.probe.split(","):
        if not (arguments.run / f"probe_{name}").exists():
            there = sorted(path.name[len("probe_"):] for path in arguments.run.glob("probe_*") if not path.suffix)
            raise ValueError(f"{arguments.run} has no probe {name}; there are: {', '.join(there) or 'none'}.")
        output = _output(arguments, f"probe_{name}")
        render_probe(arguments.run, name, output)
        print(f"Wrote {output}")


def fields_of(run, collection):
    """The names of the arrays of a collection's last picture."""
    return results.read_points(run, None, collection).arrays


def _numbers(option, text, count=None):
    """The numbers of an option; None without it."""
    try:
        values = text and [float(word) for word in text.split(",")]
    except ValueError:
        values = []
    if text is not None and (not values or not np.all(np.isfinite(values)) or (count and len(values) != count)):
        raise ValueError(f"{option} {text}: write {count or ''} numbers, separated by commas, with a decimal point".replace("  ", " "))
    return values


def _collections(arguments):
    """What is to be drawn: {collection: field}."""
    wanted = [arguments.collection] if arguments.collection else [name for name in DEFAULT_FIELDS if has_collection(arguments.run, name)]
    if not arguments.field:
        return {name: DEFAULT_FIELDS[name] for name in wanted or ["points"]}
    available = {name: fields_of(arguments.run, name) for name in wanted or ["points"]}
    chosen = {name: arguments.field for name, fields in available.items() if arguments.field in fields}
    if not chosen:
        raise ValueError(f"No field {arguments.field}; there are: " +
                         "; ".join(f"{', '.join(sorted(fields))} ({name})" for name, fields in available.items()) + ".")
    return chosen


def _output(arguments, name, ending=".png"):
    """The file of a picture: what is asked for makes its name, so that no other picture is overwritten."""
    if arguments.output:
        output = arguments.output.with_name(arguments.output.stem + (f"_{name}" if name else "") + (arguments.output.suffix or ending))
        if ending != ".png" and output.suffix != ending:
            raise ValueError(f"{output}: a film of --animate {ending[1:]} ends with {ending}")
        if output.exists() and not arguments.force:
            raise ValueError(f"{output} is there already: write another name, or add --force.")
        return output
    asked = [f"{option}_{value}" if option != "field" else value
             for option, value in (("field", arguments.field), ("t", arguments.times), ("limits", arguments.limits)) if value]
    return arguments.run / ("_".join([name or "points"] + ([] if name.startswith("statistics") else asked)).replace(",", "_").replace(" ", "") + ending)


def draw(arguments):
    """Draws what the command line asks for. Throws OSError or ValueError."""
    times, limits = _numbers("--times", arguments.times), _numbers("--limits", arguments.limits, 2)
    chosen = _collections(arguments)
    only = len(chosen) == 1 and arguments.output
    if arguments.animate:
        for collection, field in chosen.items():
            output = _output(arguments, "" if only else collection, "." + arguments.animate)
            animate_points(arguments.run, output, field, arguments.animate, times, limits, collection)
            print(f"Wrote {output}")
        return
    outputs = {collection: _output(arguments, "" if only else collection) for collection in chosen}
    panels_of_statistics = arguments.panels.split(",") if arguments.panels else None
    statistics = _output(arguments, "_".join(["statistics"] + (panels_of_statistics or [])).replace(" ", "_"))
    for collection, output in outputs.items():
        render_points(arguments.run, output, chosen[collection], times, limits, collection)
        print(f"Wrote {output}")
    if (arguments.run / "statistics").exists() and render_statistics(arguments.run, statistics, panels_of_statistics):
        print(f"Wrote {statistics}")


def main():
    parser = Command("scree-render", __doc__)
    parser.add_argument("run", type=pathlib.Path, help="run folder, for instance results/quickstart")
    parser.add_argument("--probe", help="names of probes, separated by commas: a picture each of their lines or time series, and nothing else")
    parser.add_argument("--collection", choices=list(DEFAULT_FIELDS), help="points of the soil or of the water; default: both, a picture each")
    parser.add_argument("--field", help=f"{', '.join(FIELDS)} or any array of the file; default: mean_effective_stress, pressure of water")
    parser.add_argument("--times", help="times of pictures in s, separated by commas; default: first, 1/4, 1/2 and last")
    parser.add_argument("--panels", help=f"of the statistics, separated by commas: {', '.join(STATISTICS_PANELS)}; default: all")
    parser.add_argument("--limits", help="ends of the colour bar, in the unit it shows: low,high")
    parser.add_argument("--animate", choices=list(FILM_WRITERS), help="a film of all pictures (or those of --times) in place of the panels")
    parser.add_argument("--output", type=pathlib.Path, help="another file, which must not be there; default: in the run folder, named after what it shows")
    parser.add_argument("--force", action="store_true", help="overwrite the file of --output")
    parser.run(lambda arguments: draw_probes(arguments) if arguments.probe else draw(arguments))

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Draws the maps of a run over the shaded terrain, with the outline of the release.

scree-maps results/mountain_dry
scree-maps results/mountain_dry --maps largest_speed,deposit --times 5,10,20

Without --maps and --times it draws the largest thickness, speed and impact pressure, the arrival time and the deposit.
--times adds the thickness at the times of pictures. A map shows only places with soil: at least `Least thickness` of the case. In 2D it
draws the profiles instead. Writes maps.png into the run folder; the names of --maps and --times are part of the picture's name.
It prints the path of the run-out and the deposit, from the log.

"""

import pathlib
import re
import textwrap
from typing import NamedTuple

import matplotlib.colors
import matplotlib.patheffects
import matplotlib.pyplot as plt
import matplotlib.ticker
import matplotlib.transforms
import numpy as np
from matplotlib.font_manager import FontProperties
from mpl_toolkits.axes_grid1.anchored_artists import AnchoredSizeBar

from scree import results, terrain, variants
from scree.command import Command
from scree.pictures.panels import save_picture


class Kind(NamedTuple):
    """How a map is drawn: title, unit, factor from SI to that unit, colours and the part of them that is used."""
    title: str
    unit: str
    factor: float = 1.
    colours: str = "viridis_r"
    part: tuple = (0.02, 0.85)


KINDS = {
    "largest_thickness": Kind("Largest thickness", "m"),
    "largest_speed": Kind("Largest speed", "m/s", colours="plasma_r", part=(0.02, 0.8)),
    "largest_impact_pressure": Kind("Largest impact pressure", "kPa", 1e-3, "YlOrRd", (0.1, 1.)),
    "arrival_time": Kind("Arrival time", "s", colours="YlGnBu_r", part=(0.1, 0.9)),
    "deposit": Kind("Deposit", "m", colours="YlOrBr", part=(0.2, 0.95)),
    "thickness": Kind("Thickness", "m"),
    "mass": Kind("Mass per area", "kg/m^2"),
}
DEFAULT = ("largest_thickness", "largest_speed", "largest_impact_pressure", "arrival_time", "deposit")
TIME = re.compile(r"(?P<map>thickness|profile)_(?P<time>[-+.0-9e]+)s")
HALO = [matplotlib.patheffects.withStroke(linewidth=2, foreground="white")]


def map_files(run):
    """{name: file} of the maps of a run folder, in 3D rasters and in 2D tables; empty without maps."""
    folder = pathlib.Path(run) / "maps"
    return {path.stem: path for ending in ("tif", "csv", "asc") for path in sorted(folder.glob(f"*.{ending}"))}


def map_times(run):
    """{time in s: name} of the maps at the times of pictures."""
    timed = {name: TIME.fullmatch(name) for name in map_files(run)}
    return dict(sorted((float(match["time"]), name) for name, match in timed.items() if match))


def find_map(run, name):
    """The file of a map. `thickness_5s` is that at 5 s, however the number is written. Throws a ValueError that lists the maps if it is not there."""
    files, times, match = map_files(run), map_times(run), TIME.fullmatch(name)
    if not files:
        raise ValueError(f"{run} has no maps. Set \"Write = true\" in subsection Maps of Output, and run the case again")
    if name in files:
        return files[name]
    if match:
        wanted, tolerance = float(match["time"]), 1e-6 * max(map(abs, times), default=0.)
        found = [times[time] for time in times if abs(time - wanted) <= tolerance and times[time].startswith(match["map"] + "_")]
        if found:
            return files[found[0]]
        raise ValueError(f"{run} has no map at t = {wanted:g} s; there are {len(times)}, at {', '.join(f'{time:g}' for time in times)} s")
    raise ValueError(f"{run} has no map {name}; there are: {', '.join(one for one in files if not TIME.fullmatch(one))}, thickness_TIMEs")


def title_of(run, name, has_depletion=False):
    """The heading of a map: what it shows, and its time if it shows one."""
    match, kind = TIME.fullmatch(name), kind_of(name)
    if match:
        return f"{kind.title} at t = {float(match['time']):g} s"
    times = map_times(run)
    return kind.title + (" and depletion (blue)" if has_depletion else "") + (f", t = {max(times):g} s" if times and name in ("thickness", "mass", "deposit") else "")


def kind_of(name):
    match = TIME.fullmatch(name)
    key = match["map"] if match else name
    return KINDS.get(key, Kind(key.replace("_", " ").capitalize(), ""))


class Map(NamedTuple):
    """A map in the unit of its colour bar, nan where nothing is drawn."""
    name: str
    title: str
    kind: Kind
    raster: results.Raster


def least_thickness(run):
    """Entry `Least thickness`, m: thinner soil is not drawn."""
    return float(variants.read_entries(pathlib.Path(run) / "parameters.prm").get("Output/Maps/Least thickness", 0.))


def read_map(run, name):
    """A map without the places that had no soil."""
    raster, kind, least = results.read_raster(find_map(run, name)), kind_of(name), max(least_thickness(run), 1e-9)
    values = raster.values
    if name.startswith("thickness") or name in ("largest_thickness", "deposit"):
        shown = np.abs(values) >= least
    elif name == "arrival_time":
        shown = values >= 0
    elif name == "mass":
        shown = results.read_raster(find_map(run, "thickness")).values >= least
    else:
        shown = values > 0
    shown_values = np.where(shown, kind.factor * values, np.nan)
    return Map(name, title_of(run, name, name == "deposit" and np.any(shown_values < 0)), kind, raster._replace(values=shown_values))


def release(run):
    """The raster of the thickness at the first time, m; None if there was no soil yet."""
    times = map_times(run)
    first = times and results.read_raster(find_map(run, times[min(times)]))
    return first if times and np.any(first.values >= max(least_thickness(run), 1e-9)) else None


def window_of(run, maps, source):
    """(x, x, y, y) of the soil of all maps and the release, with a margin, within the box; m."""
    box, entries = results.read_box(run), variants.read_entries(pathlib.Path(run) / "parameters.prm")
    origin = results.local_origin(entries)[:2]
    lower, upper = box.lower[:2] + origin, box.upper[:2] + origin
    corners = []
    for raster, shown in [(one.raster, np.isfinite(one.raster.values)) for one in maps] + ([(source, source.values > 0)] if source else []):
        if np.any(shown):
            x, y = terrain.places(raster)
            x, y = x[shown.any(axis=0)], y[shown.any(axis=1)]
            corners += [(x.min(), y.min()), (x.max(), y.max())]
    if not corners:
        return lower[0], upper[0], lower[1], upper[1]
    low, high = np.min(corners, axis=0), np.max(corners, axis=0)
    middle, half = (low + high) / 2, (high - low) / 2
    half = np.maximum(half + 0.12 * half.max() + box.cell_size, 0.4 * half.max())  # not too slender a picture
    low, high = np.maximum(middle - half, lower), np.minimum(middle + half, upper)
    return low[0], high[0], low[1], high[1]


def range_of(maps):
    """Least and largest value of maps with one colour bar, and 0."""
    values = np.concatenate([np.zeros(1)] + [one.raster.values[np.isfinite(one.raster.values)] for one in maps])
    return values.min(), values.max()


def colours_of(kind, low, high):
    """Colour map and classes from `low` <= 0 to `high` >= 0, with bounds that are round numbers."""
    bounds = matplotlib.ticker.MaxNLocator(nbins=14 if low < 0 else 10, steps=[1, 2, 2.5, 5, 10]).tick_values(low, high if high > low else low + 1)
    bounds = bounds[np.searchsorted(bounds, low, "right") - 1:np.searchsorted(bounds, high if high > low else low + 1, "left") + 1]
    middles = (bounds[:-1] + bounds[1:]) / 2
    positive, negative = plt.get_cmap(kind.colours), plt.get_cmap("Blues")
    first, last = kind.part
    colours = [positive(first + (last - first) * middle / bounds[-1]) if middle > 0 else negative(0.25 + 0.7 * middle / bounds[0]) for middle in middles]
    return matplotlib.colors.ListedColormap(colours), bounds


def draw_map(axes, one, low, high, height):
    """One map without terrain, and its colour bar from `low` to `high` beside a panel of this height, inches."""
    colours, bounds = colours_of(one.kind, low, high)
    image = axes.imshow(np.ma.masked_invalid(one.raster.values), cmap=colours, norm=matplotlib.colors.BoundaryNorm(bounds, colours.N),
                        extent=one.raster.extent, interpolation="nearest", zorder=1)
    every = int(np.ceil(0.13 * len(bounds) / (0.9 * height)))  # inches of a number
    ticks = bounds[np.argmin(np.abs(bounds)) % every::every]  # with 0
    bar = axes.figure.colorbar(image, ax=axes, spacing="proportional", ticks=ticks, format="%g", shrink=0.9, aspect=0.9 * height / 0.13, pad=0.02).ax
    bar.tick_params(labelsize=8, length=2)
    bar.set_title(one.kind.unit, fontsize=8, loc="left", pad=4)
    values = one.raster.values[np.isfinite(one.raster.values)]
    lowest = f"{_number(values.min())} to" if len(values) and (values.min() < 0 or one.name == "arrival_time") else "up to"
    text = f"{lowest} {_number(values.max())} {one.kind.unit}" if len(values) else "no soil"
    axes.set_title(one.title, fontsize=9, loc="left", pad=14)
    axes.text(0, 1, text, fontsize=8, color="0.3", transform=axes.transAxes + matplotlib.transforms.ScaledTranslation(0, 3 / 72, axes.figure.dpi_scale_trans),
              va="bottom")


def _number(value):
    """Three digits, without an exponent."""
    return f"{value:.0f}" if abs(value) >= 100 else f"{value:.3g}"


def draw_release(axes, raster, least):
    x, y = terrain.places(raster)
    values = np.nan_to_num(raster.values)
    axes.contour(x, y, values, levels=[least], colors="white", linewidths=2.2, zorder=5)
    axes.contour(x, y, values, levels=[least], colors="black", linewidths=1.1, linestyles="--", zorder=6)


def draw_scale_bar(axes, window, width):
    """A bar of 1, 2 or 5 times a power of ten, about a quarter of the `width` of the panel in inches."""
    length = terrain.nice_length((window[1] - window[0]) * min(0.3, 1.5 / width))
    text = f"{length / 1000:g} km" if length >= 1000 else f"{length:g} m"
    axes.add_artist(AnchoredSizeBar(axes.transData, length, text, "lower left", label_top=True, size_vertical=0.03 * (window[1] - window[0]) / width,
                                    sep=3, borderpad=0.8, frameon=False, fontproperties=FontProperties(size=8))).txt_label._text.set_path_effects(HALO)


def draw_north(axes):
    axes.annotate("N", (0.935, 0.98), (0, -32), "axes fraction", "offset points", ha="center", fontsize=9, fontweight="bold", path_effects=HALO, zorder=8,
                  arrowprops={"arrowstyle": "-|>", "facecolor": "black", "shrinkA": 0, "shrinkB": 0})


def sheet_for(count, window):
    """Columns and rows of panels, and width and height of one in inches: as large as a page of 11 inches takes."""
    ratio = (window[3] - window[2]) / (window[1] - window[0])
    columns = min(count, 1 if ratio < 0.4 else 2 if ratio < 0.9 or (count == 4 and ratio < 1.6) else 4 if count == 4 else 3)
    width = min({1: 8.5, 2: 4.7, 3: 2.9, 4: 2.6}[columns], 6.5 / ratio)
    return columns, -(-count // columns), width, width * ratio


def coordinate_system(run):
    """The name of the system of coordinates of the maps, from the .prj file beside them; empty without one."""
    for file in sorted((pathlib.Path(run) / "maps").glob("*.prj")):
        name = re.search(r'\[\s*"([^"]+)"', file.read_text(encoding="utf-8"))
        return name.group(1) if name else ""
    return ""


def _finish(axes, window, width, is_outer):
    axes.set(xlim=window[:2], ylim=window[2:], aspect="equal")
    axes.ticklabel_format(useOffset=False, style="plain")
    axes.tick_params(labelsize=8, length=2)
    longest = max(len(f"{value:.0f}") for value in window)
    for axis, length in ((axes.xaxis, width), (axes.yaxis, 4.)):
        axis.set_major_locator(matplotlib.ticker.MaxNLocator(int(np.clip(length / (0.09 * longest + 0.25), 2, 8)), steps=[1, 2, 5, 10]))
    axes.set_xlabel("x (m)", fontsize=8, labelpad=1)
    if is_outer:
        axes.set_ylabel("y (m)", fontsize=8, labelpad=1)
        for label in axes.get_yticklabels():
            label.set(rotation=90, va="center")
    else:
        axes.set_yticklabels([])


def render_maps(run, names, output):
    """The maps of a run in 3D in one PNG. Throws OSError or ValueError."""
    maps, source, least = [read_map(run, name) for name in names], release(run), max(least_thickness(run), 1e-9)
    notes = ["dashed: outline of the release"] if source else []
    render_sheet(run, maps, source, notes + ([f"soil of at least {least:g} m"] if least > 1e-9 else []), output)


def render_sheet(run, maps, source, notes, output, observed=None):
    """Maps over the terrain of a run in one PNG; `source`: thickness of the release or None, `notes`: what stands below them.

    `observed`: {name of a map: raster}, whose areas above 0 get an outline.
    """
    least, areas = max(least_thickness(run), 1e-9), [Map("", "", Kind("", ""), area._replace(values=np.where(area.values > 0, 1., np.nan)))
                                                      for area in (observed or {}).values()]
    window = window_of(run, maps + areas, source)
    try:
        ground = terrain.ground(run, window)
    except (OSError, ValueError) as error:
        print(f"No terrain below the maps: {error}.")
        ground = None
    has_north = bool(variants.read_entries(pathlib.Path(run) / "parameters.prm").get("Bed/Raster"))
    columns, rows, width, height = sheet_for(len(maps), window)
    size = columns * (width + 0.75) + 0.6, rows * (height + 0.9) + 0.4
    figure, panels = plt.subplots(rows, columns, figsize=size, squeeze=False, layout="constrained")
    for panel in panels.flat[len(maps):]:
        panel.remove()
    for number, (panel, one) in enumerate(zip(panels.flat, maps)):
        # Thicknesses at several times have one scale.
        draw_map(panel, one, *range_of([other for other in maps if TIME.fullmatch(other.name)] if TIME.fullmatch(one.name) else [one]), height)
        if ground:
            terrain.draw_shade(panel, ground, 0.4, 0)
            terrain.draw_shade(panel, ground, 0.15, 2, one.raster)
            terrain.draw_contours(panel, ground, 3)
        if source:
            draw_release(panel, source, least)
        if observed and one.name in observed:
            area = observed[one.name]
            panel.contour(*terrain.places(area), np.nan_to_num(area.values) > 0, levels=[0.5], colors="#c00020", linewidths=1.4, zorder=7)
        _finish(panel, window, width, number % columns == 0)
        draw_scale_bar(panel, window, width)
        if has_north:
            draw_north(panel)
    if ground:
        notes = notes + [f"contours every {terrain.contour_step(ground):g} m"]
    if coordinate_system(run):
        notes = notes + [f"coordinates: {coordinate_system(run)}"]
    figure.supxlabel(textwrap.fill("; ".join(notes), int(15 * size[0])), fontsize=8, color="0.3", x=0.01, ha="left")
    save_picture(figure, output, 120)


def render_profiles(run, names, output):
    """The maps of a run in 2D, which are columns of a table, against x in one PNG."""
    times = map_times(run)
    table = read_profile(find_map(run, "profile"))
    first = read_profile(find_map(run, times[min(times)])) if times else {}
    figure, panels = plt.subplots(len(names), 1, figsize=(8, 0.6 + 1.8 * len(names)), squeeze=False, sharex=True, layout="constrained")
    for axes, name in zip(panels[:, 0], names):
        match, kind = TIME.fullmatch(name), kind_of(name)
        shown = read_profile(find_map(run, f"profile_{match['time']}s")) if match else table
        column = match["map"] if match else name
        if column not in shown:
            raise ValueError(f"{run} has no map {name}; there are: {', '.join(key for key in table if key != 'x')}, thickness_TIMEs")
        values = kind.factor * shown[column]
        axes.fill_between(table["x"], np.maximum(values, 0), step="mid", color="peru" if name == "deposit" else "tab:blue", alpha=0.6, lw=0)
        axes.fill_between(table["x"], np.minimum(values, 0), step="mid", color="steelblue", alpha=0.6, lw=0)
        for edge in _ends(table["x"], first.get("thickness", np.zeros(0)) >= max(least_thickness(run), 1e-9)):
            axes.axvline(edge, color="black", ls="--", lw=0.8)
        axes.set_title(title_of(run, name), fontsize=9, loc="left")
        axes.set_ylabel(kind.unit)
        axes.grid(alpha=0.3)
    panels[-1, 0].set_xlabel("x (m); dashed: ends of the release" if first else "x (m)")
    save_picture(figure, output, 120)


def read_profile(path):
    """{"x": values, "largest_thickness": values, ...} of a table of columns such as "largest thickness (m)"; SI units."""
    return {results.split_unit(name)[0].replace(" ", "_"): values for name, values in results.read_table(path).items()}


def _ends(x, inside):
    """x of the first and the last place that is inside; nothing without one."""
    half = (x[1] - x[0]) / 2
    return (x[inside][0] - half, x[inside][-1] + half) if np.any(inside) else ()


def default_maps(run):
    """The names of the maps that are drawn if none are asked for."""
    if results.read_box(run).dim == 2:
        there = read_profile(find_map(run, "profile"))
        return [name for name in DEFAULT if name in there]
    return [name for name in DEFAULT if name in map_files(run)]


def render(run, names, output):
    """The maps `names` of a run in one PNG. Throws OSError or ValueError."""
    (render_profiles if results.read_box(run).dim == 2 else render_maps)(run, names, output)


def _draw(arguments):
    names = arguments.maps.split(",") if arguments.maps else []
    try:
        names += [f"thickness_{float(word):.15g}s" for word in arguments.times.split(",")] if arguments.times else []
    except ValueError as error:
        raise ValueError(f"--times {arguments.times}: write numbers, separated by commas, with a decimal point") from error
    output = arguments.output or arguments.run / ("_".join(["maps"] + names) + ".png")
    render(arguments.run, names or default_maps(arguments.run), output)
    print(f"Wrote {output}")
    path = results.read_log(arguments.run).parts.get("Run-out")
    if path:
        print("Run-out: " + " ".join(path.split()))


def main():
    parser = Command("scree-maps", __doc__)
    parser.add_argument("run", type=pathlib.Path, help="run folder with a folder maps, for instance results/mountain_dry")
    parser.add_argument("--maps", help=f"separated by commas: {', '.join(KINDS)}, or any other of the folder without its ending")
    parser.add_argument("--times", help="times of pictures in s, separated by commas: the thickness at each")
    parser.add_argument("--output", type=pathlib.Path, help="picture; default: in the run folder, named after what it shows")
    parser.run(_draw)

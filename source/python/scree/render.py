# SPDX-License-Identifier: LGPL-2.1-or-later
"""Draws a run folder: its points at a few times, and its statistics against time.

scree-render results/quickstart --field deviatoric_stress --times 0,0.5,1

Writes points.png, of the soil, water.png, of the water, and statistics.png into the run folder; what is asked for (--field, --times, --limits)
is part of a picture's name. Instead of these, --scene draws the scene at the start (scene.png, as scree --show does), --animate makes films (points.gif and points.mp4), --probe NAME draws a probe, and --paraview
writes show_in_paraview.py, a state script for ParaView.

Plane runs: each pixel of the material has the colour of its nearest point. 3D runs: a surface around the material, with mean colours, and spheres
for single points; Debian needs the package xvfb for them.
"""

import pathlib

import numpy as np

from scree import results
from scree.command import Command
from scree.pictures.fields import FIELDS
from scree.pictures.panels import WRITERS, animate_points, has_collection, render_points
from scree.pictures.paraview import write_state
from scree.pictures.scene import render_scene
from scree.pictures.tables import DEFAULT_PANELS, PANELS, render_probe, render_statistics

DEFAULT_FIELDS = {"points": "mean_effective_stress", "water": "pressure"}  # of each collection, unless the soil slides


def default_field(run, collection):
    """The field of a picture: of soil of which 1 % has moved by more than a cell, displacement if it is written, or else speed."""
    first, last = (results.read_points(run, time, collection) for time in results.read_times(run, collection)[[0, -1]])
    if collection != "points" or "id" not in first.arrays:
        return DEFAULT_FIELDS[collection]
    _, before, after = np.intersect1d(first.arrays["id"], last.arrays["id"], return_indices=True)
    way = np.linalg.norm(last.positions[after] - first.positions[before], axis=1)
    if len(way) == 0 or np.percentile(way, 99) <= results.read_box(run).cell_size:
        return DEFAULT_FIELDS[collection]
    return "displacement" if "displacement" in last.arrays else "velocity"


def draw_probes(arguments):
    """Draws the probes that the command line names. Throws OSError or ValueError."""
    for name in arguments.probe.split(","):
        if not (arguments.run / f"probe_{name}.csv").exists():
            there = sorted(path.stem[len("probe_"):] for path in arguments.run.glob("probe_*.csv"))
            raise ValueError(f"{arguments.run} has no probe {name}; there are: {', '.join(there) or 'none'}.")
        output = _output(arguments, f"probe_{name}")
        render_probe(arguments.run, name, output)
        print(f"Wrote {output}")


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
    arguments.field = results.bare_name(arguments.field) if arguments.field else arguments.field
    if not arguments.field:
        return {name: default_field(arguments.run, name) for name in wanted or ["points"]}
    available = {name: results.read_points(arguments.run, None, name).arrays for name in wanted or ["points"]}
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


def _film_endings(kind):
    """The endings of the files of --animate: both kinds, if ffmpeg is there."""
    if kind in ("both", "mp4") and not WRITERS[".mp4"].isAvailable():
        if kind == "mp4":
            raise ValueError("--animate mp4: ffmpeg is missing. Install ffmpeg, or write --animate gif")
        print("No film .mp4: ffmpeg is missing. Install ffmpeg for it; in Debian: package ffmpeg.")
        kind = "gif"
    return list(WRITERS) if kind == "both" else ["." + kind]


def _draw_films(arguments, chosen, name_of, numbers):
    endings = _film_endings(arguments.animate)
    if arguments.output and len(endings) > 1:
        if arguments.output.suffix not in WRITERS and arguments.output.suffix:
            raise ValueError(f"{arguments.output}: a film ends with {' or '.join(WRITERS)}")
        # A name with an ending asks for this kind only.
        endings = [arguments.output.suffix] if arguments.output.suffix else endings
    for collection, field in chosen.items():
        outputs = [_output(arguments, name_of(collection), ending) for ending in endings]
        animate_points(arguments.run, outputs, field, *numbers[:2], collection, numbers[2])
        for output in outputs:
            print(f"Wrote {output}")


def draw(arguments):
    """Draws what the command line asks for. Throws OSError or ValueError."""
    if arguments.scene:
        output = _output(arguments, "" if arguments.output else "scene")
        render_scene(arguments.run, output, _numbers("--view", arguments.view, 2))
        print(f"Wrote {output}")
        return
    times, limits, view = _numbers("--times", arguments.times), _numbers("--limits", arguments.limits, 2), _numbers("--view", arguments.view, 2)
    chosen = _collections(arguments)
    only = len(chosen) == 1 and arguments.output

    def name_of(collection):
        return "" if only else collection

    if arguments.animate:
        _draw_films(arguments, chosen, name_of, (times, limits, view))
        return
    if arguments.paraview:
        output = arguments.output or arguments.run / "show_in_paraview.py"
        if arguments.output and output.exists() and not arguments.force:
            raise ValueError(f"{output} is there already: write another name, or add --force.")
        write_state(arguments.run, output, chosen, limits)
        print(f"Wrote {output}")
        return
    outputs = {collection: _output(arguments, name_of(collection)) for collection in chosen}
    panels_of_statistics = arguments.panels.split(",") if arguments.panels else None
    statistics = _output(arguments, "_".join(["statistics"] + (panels_of_statistics or [])).replace(" ", "_"))
    for collection, output in outputs.items():
        render_points(arguments.run, output, chosen[collection], times, limits, collection, view)
        print(f"Wrote {output}")
    if (arguments.run / "statistics.csv").exists() and render_statistics(arguments.run, statistics, panels_of_statistics):
        print(f"Wrote {statistics}")


def main():
    parser = Command("scree-render", __doc__)
    parser.add_argument("run", type=pathlib.Path, help="run folder, for instance results/quickstart")
    parser.add_argument("--probe", help="names of probes, separated by commas: a picture each of their lines or time series, and nothing else")
    parser.add_argument("--scene", action="store_true", help="the scene at the start and nothing else: bodies, water, ground, walls, loads, probes")
    parser.add_argument("--collection", choices=list(DEFAULT_FIELDS), help="points of the soil or of the water; default: both, a picture each")
    parser.add_argument("--field", help=f"{', '.join(FIELDS)} or any array of the file; default: of soil that slides displacement, "
                        "or velocity where it is not written, else mean_effective_stress; pressure of water")
    parser.add_argument("--times", help="times of pictures in s, separated by commas; default: first, 1/4, 1/2 and last")
    parser.add_argument("--panels", help=f"of the statistics, separated by commas: {', '.join(PANELS)}; default: {', '.join(DEFAULT_PANELS)}")
    parser.add_argument("--limits", help="ends of the colour bar, in the unit it shows: low,high")
    parser.add_argument("--view", help="of 3D runs: azimuth from the x axis and elevation of the camera, degrees, such as -60,32; "
                        "default: across the way of the material")
    parser.add_argument("--animate", nargs="?", const="both", choices=["gif", "mp4", "both"],
                        help="films of all pictures, or of those of --times, as GIF and MP4 or one of them; write it after the run folder")
    parser.add_argument("--paraview", action="store_true", help="show_in_paraview.py, which shows the points in ParaView with the colours of the picture")
    parser.add_argument("--output", type=pathlib.Path, help="another file, which must not be there; default: in the run folder, named after what it shows")
    parser.add_argument("--force", action="store_true", help="overwrite the file of --output")
    parser.run(lambda arguments: draw_probes(arguments) if arguments.probe else draw(arguments))

# SPDX-License-Identifier: LGPL-2.1-or-later
"""A state script for ParaView: `paraview --script=FILE`, or `pvpython FILE`. It uses paraview.simple only. Its name is that of no module."""

import pathlib

import numpy as np

from scree import results, terrain, variants
from scree.pictures import fields, plane

SCRIPT = pathlib.Path(__file__).with_name("paraview_state.txt")
# Of ParaView for matplotlib's colour maps, and whether it is to be inverted.
PRESETS = {"RdBu_r": ("Cool to Warm", False), "YlOrRd": ("Inferno (matplotlib)", True)}


def _camera(box, pictures):
    """Focus, position, upward direction and half height of the view."""
    shown = plane.fitted(box, pictures)
    lower, upper = np.pad(shown.lower, (0, 3 - box.dim)), np.pad(shown.upper, (0, 3 - box.dim))
    focus, size = 0.5 * (lower + upper), upper - lower
    if box.dim == 2:
        return focus, focus + [0, 0, 2 * max(size)], np.array([0., 1., 0.]), 0.55 * max(size[1], 0.6 * size[0])
    from scree.pictures import space  # pylint: disable=import-outside-toplevel
    order = space.axes_order(box)
    camera = space.camera_of(np.array([lower[order], upper[order]]), space.view_along(box, pictures))
    focus, towards, up = (np.empty(3) for _ in range(3))
    focus[order], towards[order], up[order] = camera.focus, camera.towards, camera.up
    return focus, focus + 3 * np.linalg.norm(size) * towards, up, camera.half_height


def write_ground(run, box, output):
    """Writes the ground of a run in 3D as a surface; returns whether there is one."""
    run = pathlib.Path(run)
    origin = results.local_origin(variants.read_entries(run / "parameters.prm"))
    try:
        ground = terrain.ground(run, tuple(side[axis] + origin[axis] for axis in range(2) for side in (box.lower, box.upper)))
    except (OSError, ValueError) as error:
        print(f"The script has no ground: {error}")
        return False
    if ground is None:
        return False
    x, y = terrain.places(ground)
    places = np.stack([*np.meshgrid(x - origin[0], y - origin[1]), np.nan_to_num(ground.values, nan=box.lower[2])], axis=-1).reshape(-1, 3)
    head = f"# vtk DataFile Version 3.0\nground\nASCII\nDATASET STRUCTURED_GRID\nDIMENSIONS {len(x)} {len(y)} 1\nPOINTS {len(places)} double"
    np.savetxt(output, places, "%.10g", header=head, comments="")
    return True


def write_state(run, output, chosen, limits=None):
    """Writes the script, and in 3D the ground beside it. `chosen`: {collection: field}."""
    box, shown, seen = results.read_box(run), [], []
    for collection, name in chosen.items():
        available = results.read_times(run, collection)
        pictures = [results.read_points(run, time, collection) for time in available[np.unique(np.linspace(0, len(available) - 1, 5).astype(int))]]
        style = fields.field_style(name)
        low, high = limits or fields.colour_limits(np.concatenate([fields.field_values(points, name) for points in pictures]), name)
        volumes = [points.arrays["volume"] for points in pictures if "volume" in points.arrays]
        radius = 0.6 * np.median(np.concatenate(volumes)) ** (1 / box.dim) if volumes else box.cell_size / 6
        preset = PRESETS.get(style.colours, ("Viridis (matplotlib)", False))
        limits_si = f"{low / style.factor:.6g}, {high / style.factor:.6g}"
        shown.append(f"show({collection + '.pvd'!r}, {name!r}, {limits_si}, {preset[0]!r}, {preset[1]}, {radius:.4g}, {style.label!r})")
        seen += pictures
    focus, position, up, scale = _camera(box, seen)
    output = pathlib.Path(output)
    ground = output.with_name(output.stem + "_ground.vtk")
    if box.dim == 3 and write_ground(run, box, ground):
        shown.append(f"show_ground({ground.name!r})")
    output.write_text(SCRIPT.read_text(encoding="utf-8").format(
        run=run, name=output.name, name_of_picture=output.stem + ".png", absolute=str(output.resolve()), shown="\n".join(shown),
        shape="Plain circle" if box.dim == 2 else "Sphere", interaction=f"{box.dim}D", focus=_list(focus), position=_list(position), up=_list(up),
        scale=scale), encoding="utf-8")


def _list(vector):
    return "[" + ", ".join(f"{value:.6g}" for value in vector) + "]"

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pictures of the points of a run at several times, and films of them."""

import contextlib
import pathlib

import matplotlib
import matplotlib.pyplot as plt
import numpy as np
import PIL.Image
from matplotlib import animation

from scree import results
from scree.pictures import fields, plane, rigid

FRAMES_PER_SECOND = 10


def has_collection(run, collection):
    return (pathlib.Path(run) / "solution" / f"{collection}.pvd").exists()


def other_points(run, time, collection):
    """The water of a picture of the soil, and the soil of one of the water; None if there is none, or no picture at that time."""
    other = "water" if collection == "points" else "points"
    if not has_collection(run, other) or not np.any(np.isclose(results.read_times(run, other), time, rtol=1e-6, atol=0.)):
        return None
    points = results.read_points(run, time, other)
    return points if len(points.positions) else None


class _Plane:
    """Panels of a plane run."""

    def __init__(self, run, frame_box, scale, collection, _pictures, _stack, _view, longest):
        self.run, self.box, self.scale, self.collection, self.longest = run, frame_box, scale, collection, longest
        self.structures = rigid.rigid_bodies(run) if collection == "points" else []
        size = frame_box.upper - frame_box.lower
        self.ratio = size[1] / size[0]

    def draw(self, axes, points, first):
        panel = plane.panel_of(axes, self.box, self.run, points.time, self.longest)
        other = other_points(self.run, points.time, self.collection)
        if other and self.collection == "points":
            plane.draw_water_around(panel, other)
        plane.draw_material(panel, points, self.scale, structures=self.structures)
        if other and self.collection == "water":
            plane.draw_outline(panel, other)
        plane.draw_ground(panel)
        if first and self.ratio < 1.5:
            plane.legend(axes, self.collection == "points" or other, other, self.collection, panel.surfaces, self.structures)


class _Space:
    """Panels of a 3D run."""

    def __init__(self, run, frame_box, scale, collection, pictures, stack, view, longest):
        from scree.pictures import space  # pylint: disable=import-outside-toplevel  # VTK's window is for 3D only
        self.run, self.scale, self.collection = run, scale, collection
        self.structures = rigid.rigid_bodies(run) if collection == "points" else []
        view = space.View(*view) if view else space.view_along(frame_box, pictures)
        self.scene = space.Scene(run, results.read_box(run), frame_box, view, stack, longest)
        self.ratio = self.scene.camera.height / self.scene.camera.width

    def draw(self, axes, points, _first):
        colours = self.scale.mappable.to_rgba(fields.field_values(points, self.scale.name))
        if self.structures and len(colours):
            colours[np.isin(np.round(points.arrays["body"]), self.structures)] = matplotlib.colors.to_rgba(plane.STRUCTURE)
        water = other_points(self.run, points.time, self.collection) if self.collection == "points" else None
        axes.imshow(self.scene.image(points, colours, water))
        axes.set_axis_off()
        self._draw_scale(axes)

    def _draw_scale(self, axes):
        """Three edges of a cube in a lower corner: directions of the axes, and a length to measure by."""
        camera, length = self.scene.camera, self.scene.scale_length
        arms = np.array([camera.pixel(camera.focus + length * unit) - camera.pixel(camera.focus) for unit in np.eye(3)])
        ends = np.vstack([arms, np.zeros((1, 2))])
        if camera.free_corner < 0:
            edge, left, align = 0.03 * camera.width, 0.03 * camera.width - ends[:, 0].min(), "left"
        else:
            edge, left, align = 0.97 * camera.width, 0.97 * camera.width - ends[:, 0].max(), "right"
        corner = np.array([left, 0.93 * camera.height - ends[:, 1].max()])
        for axis, arm in zip(self.scene.order, arms):
            axes.annotate("", corner + arm, corner, arrowprops={"arrowstyle": "-", "color": "0.1", "lw": 1.4, "shrinkA": 0, "shrinkB": 0})
            place = corner + arm * (1 + 0.018 * camera.width / max(np.hypot(*arm), 1))
            axes.text(*place, "xyz"[axis], fontsize="small", ha="center", va="center")
        axes.text(edge, 0.995 * camera.height, f"length of each line: {length:g} m", fontsize="x-small", va="bottom", ha=align)


def _pictures(run, times, collection):
    found = {picture.time: picture for picture in (results.read_points(run, time, collection) for time in times)}
    return [found[time] for time in sorted(found)]


def _fitted(run, box, pictures, collection):
    """The part of the box that the pictures and the water or soil around them reach."""
    others = [other_points(run, points.time, collection) for points in pictures]
    return plane.fitted(box, pictures + [points for points in others if points])


def _scale(pictures, name, limits):
    return fields.colour_scale(np.concatenate([fields.field_values(points, name) for points in pictures]), name, limits)


WIDTH, HEIGHT, BESIDE, ABOVE = 10., 12.5, 1.5, 0.4  # inches: figure, at most; colour bar with labels; title of a panel


def _layout(number, ratio):
    """Rows, columns and size in inches for panels of a ratio of height to width: as large as possible on a page."""
    for columns in range(1, number + 1):
        rows = -(-number // columns)
        width = (WIDTH - BESIDE) / columns
        is_rectangle = columns == 1 or (columns - 1) * rows < number
        if is_rectangle and ratio <= 0.6 * columns and rows * (ratio * width + ABOVE) + ABOVE <= HEIGHT:
            return rows, columns, (WIDTH, rows * (ratio * width + ABOVE) + ABOVE)
    # Tall panels side by side, narrower than the page.
    height = min(ratio * (WIDTH - BESIDE) / number, 0.7 * HEIGHT)
    return 1, number, (max(number * (height / ratio + 0.6) + BESIDE, 5.), height + 2 * ABOVE)


def _figure(number, ratio, is_plane):
    rows, columns, size = _layout(number, ratio)
    return plt.subplots(rows, columns, figsize=size, squeeze=False, layout="constrained", sharex=is_plane, sharey=is_plane)


def _colour_bar(figure, axes, scale):
    figure.colorbar(scale.mappable, ax=axes, label=fields.field_label(scale.name), extend=scale.extend, aspect=35, shrink=0.85, pad=0.02)


def _title(run, time):
    """The time of a picture; of a trial of --safety, which runs before the release, its factor and how it ended."""
    run = pathlib.Path(run)
    trials = run.parent / "safety.csv"
    if run.name not in ("rests", "fails") or not trials.exists():
        return f"t = {time:.4g} s"
    table = results.read_table(trials)
    # The folders have the trials beside the factor of safety.
    factors, rests = table["Factor (-)"], table["Rests (-)"]
    factor = np.max(factors[rests == 1]) if run.name == "rests" else np.min(factors[rests == 0])
    return f"strength divided by {factor:.4g}: the slope {run.name}"


def render_points(run, output, name, times=None, limits=None, collection="points", view=None):
    """Panels of a few times (default: first, a quarter, half, last) in one PNG. `view` in 3D: azimuth and elevation of the camera, degrees."""
    box = results.read_box(run)
    if times is None:
        available = results.read_times(run, collection)
        times = [*available[np.searchsorted(available, available[0] + np.array([0, 0.25, 0.5]) * np.ptp(available) * (1 - 1e-9))], available[-1]]
    else:
        times = results.pictures_at(run, times, collection)
    pictures = _pictures(run, times, collection)
    scale = _scale(pictures, name, limits)
    shown = _fitted(run, box, pictures, collection)
    is_plane = box.dim == 2
    with contextlib.ExitStack() as stack:
        drawing = (_Plane if is_plane else _Space)(run, shown, scale, collection, pictures, stack, view, 1300 if len(pictures) == 1 else 850)
        figure, axes = _figure(len(pictures), drawing.ratio, is_plane)
        for panel in axes.flat[len(pictures):]:
            panel.set_visible(False)
        for number, (panel, points) in enumerate(zip(axes.flat, pictures)):
            drawing.draw(panel, points, number == 0)
            panel.set_title(_title(run, points.time), fontsize="medium")
            if is_plane:
                panel.label_outer()
        _colour_bar(figure, axes, scale)
        save_picture(figure, output, 130 if is_plane else 105)


def save_picture(figure, output, dpi=130):
    figure.savefig(output, dpi=dpi)
    plt.close(figure)


class _Gif(animation.PillowWriter):
    """Frames with the colours of the middle of the film, without dithering, so that what rests costs nothing."""

    def _palette(self, frames):
        """256 colours, two thirds of them for what is coloured, although grey ground and paper cover more of the frames."""
        chosen = [frames[i] for i in np.unique(np.linspace(0, len(frames) - 1, 8).astype(int))]
        pixels = np.concatenate([np.asarray(image).reshape(-1, 3) for image in chosen])
        is_coloured = np.ptp(pixels.astype(int), axis=1) > 40
        random, sample = np.random.default_rng(0), []
        for group, number in ((pixels[is_coloured], 40000), (pixels[~is_coloured], 20000)):
            if len(group):
                sample.append(group[random.integers(len(group), size=number)])
        return PIL.Image.fromarray(np.concatenate(sample)[None]).quantize(256, method=0, kmeans=1)

    def finish(self):
        frames = [image.convert("RGB") for image in self._frames]
        palette, pause = self._palette(frames), 1000 // self.fps
        first, *others = (image.quantize(palette=palette, dither=0) for image in frames)
        first.save(self.outfile, save_all=True, append_images=others, duration=[pause] * len(others) + [1500], loop=0, optimize=False)


WRITERS = {".gif": _Gif, ".mp4": animation.FFMpegWriter}


def animate_points(run, outputs, name, times=None, limits=None, collection="points", view=None):
    """Films, a file per ending (.gif, .mp4) of `outputs`, of all pictures or of those at `times`. Colours are the same in all frames."""
    box = results.read_box(run)
    available = results.read_times(run, collection)
    frames = available if times is None else results.pictures_at(run, times, collection)
    sample = _pictures(run, [frames[i] for i in np.unique(np.linspace(0, len(frames) - 1, 9).astype(int))], collection)
    scale, shown = _scale(sample, name, limits), _fitted(run, box, sample, collection)
    writers = [WRITERS[output.suffix](FRAMES_PER_SECOND) for output in outputs]
    is_plane = box.dim == 2
    with contextlib.ExitStack() as stack:
        drawing = (_Plane if is_plane else _Space)(run, shown, scale, collection, sample, stack, view, 900)
        figure, axes = _figure(1, drawing.ratio, is_plane)
        panel = axes[0, 0]
        _colour_bar(figure, axes, scale)
        for writer, output in zip(writers, outputs):
            writer.setup(figure, output, 90)
        for number, time in enumerate(frames):
            panel.clear()
            drawing.draw(panel, results.read_points(run, time, collection), True)
            # Numbers of one width: the title stands still.
            panel.set_title(f"t = {time:.{_decimals(np.unique(np.round(frames, 9)))}f} s", fontsize="medium")
            if number == 0:
                figure.canvas.draw()
                figure.set_layout_engine("none")  # the panel stands still, too
            for writer in writers:
                writer.grab_frame()
        for writer in writers:
            writer.finish()
    plt.close(figure)


def _decimals(times):
    """Enough digits to write the times."""
    step = np.min(np.diff(times)) if len(times) > 1 else 1.
    return next((digits for digits in range(6) if abs(step * 10 ** digits - round(step * 10 ** digits)) < 1e-3 * step * 10 ** digits), 6)

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Points of a 3D run over the shaded ground, drawn by VTK into an image: a surface around them, and spheres for single points.

The projection is parallel, so that lengths can be measured in the image.
"""

import contextlib
import os
import shutil
import subprocess
from typing import NamedTuple

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints, vtkUnsignedCharArray
from vtkmodules.vtkCommonDataModel import vtkBox, vtkCellArray, vtkPolyData, vtkRectilinearGrid
from vtkmodules.vtkFiltersCore import vtkClipPolyData, vtkContourFilter, vtkElevationFilter, vtkPolyDataNormals
from vtkmodules.vtkFiltersSources import vtkCubeSource
from vtkmodules.vtkRenderingCore import vtkActor, vtkLight, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow
from vtkmodules.vtkRenderingOpenGL2 import vtkOpenGLSphereMapper

from scree import terrain
from scree.pictures import rigid
from scree.pictures.plane import blurred, point_sides

GROUND, STRUCTURE, FLOOR, WATER = (0.86, 0.83, 0.77), (0.50, 0.52, 0.56), (0.87, 0.87, 0.86), (0.45, 0.67, 0.86)
WIDTH_OF_FILL = 0.5  # cells; closes gaps of stretched material of one and a half cells
LEVEL = 0.4  # of the fill on the surface: thinner layers than at 1/2 have one, 0.13 cells outside of the material
LARGEST_LATTICE = 2_500_000  # nodes at which the ground is sampled
SUPERSAMPLING = 2


def _set(vtk_object, **values):
    """The object of VTK with other values: _set(vtkLight(), Intensity=0.3) calls SetIntensity(0.3)."""
    for name, value in values.items():
        getattr(vtk_object, "Set" + name)(*value if isinstance(value, (tuple, np.ndarray)) else (value,))
    return vtk_object


# A window of VTK that no screen shows. Debian's VTK draws by an X server only: where none is there, Xvfb is started for the time of the drawing.


@contextlib.contextmanager
def offscreen_window(width, height):
    """A vtkRenderWindow without a screen. Throws a ValueError if nothing can draw."""
    with contextlib.ExitStack() as stack:
        window = vtkRenderWindow()
        if window.IsA("vtkXOpenGLRenderWindow"):
            stack.enter_context(_x_server())
        _set(window, OffScreenRendering=1, MultiSamples=0, Size=(width, height))
        # Before the server ends: it would end this program, too.
        stack.callback(window.Finalize)
        yield window


@contextlib.contextmanager
def _x_server():
    """Xvfb, if it is installed; else the display of the desktop."""
    if shutil.which("Xvfb") is None:
        if not os.environ.get("DISPLAY"):
            raise ValueError("pictures of 3D runs need an X server. Install Xvfb; in Debian: package xvfb")
        yield
        return
    before = os.environ.get("DISPLAY")
    read_end, write_end = os.pipe()
    with subprocess.Popen(["Xvfb", "-displayfd", str(write_end), "-screen", "0", "64x64x24", "-nolisten", "tcp"],
                          pass_fds=[write_end], stderr=subprocess.DEVNULL) as server:
        os.close(write_end)
        with os.fdopen(read_end) as answer:
            number = answer.readline().strip()
        if not number:
            raise ValueError("Xvfb does not start. Does `Xvfb :99` start in a terminal?")
        os.environ["DISPLAY"] = ":" + number
        try:
            yield
        finally:
            server.terminate()
            os.environ.pop("DISPLAY")
            if before is not None:
                os.environ["DISPLAY"] = before


class View(NamedTuple):
    """Direction towards the camera, from the x axis (of the picture) and above the horizon, degrees."""
    azimuth: float = -60.
    elevation: float = 32.


class Camera(NamedTuple):
    """A parallel projection: focus, unit vectors to the right, up and to the camera (in the picture's axes), half the height, m; size in pixels.

    `lowest`: how far right of the middle the lowest corner of the frame is, m.
    """
    focus: np.ndarray
    right: np.ndarray
    up: np.ndarray
    towards: np.ndarray
    half_height: float
    width: int
    height: int
    lowest: float

    @property
    def free_corner(self):
        """-1 if the lower left corner of the image is free of ground, 1 if the lower right one is."""
        return -1 if self.lowest > 0 else 1

    def pixel(self, place):
        """Column and row, from the top, of a place in the picture's axes."""
        scale = 0.5 * self.height / self.half_height
        offset = np.asarray(place) - self.focus
        return np.array([0.5 * self.width + scale * offset @ self.right, 0.5 * self.height - scale * offset @ self.up])


def axes_order(box):
    """The axes of the run that are x, y and z of the picture, in which gravity points down."""
    return [(box.vertical + more) % 3 for more in (1, 2, 3)]


def view_along(box, pictures):
    """The camera looks across the way of the material, which goes to the right and to the front."""
    centres = [points.positions.mean(axis=0)[axes_order(box)[:2]] for points in pictures if len(points.positions)]
    way = centres[-1] - centres[0] if centres else np.zeros(2)
    if np.hypot(*way) < 0.02 * np.max(box.upper - box.lower):
        return View()
    return View(azimuth=np.degrees(np.arctan2(way[1], way[0])) - 60.)


def camera_of(frame, view, width=1000):
    """A camera that sees the frame, an array of its lower and upper corner in the picture's axes."""
    azimuth, elevation = np.radians([view.azimuth, view.elevation])
    towards = np.array([np.cos(elevation) * np.cos(azimuth), np.cos(elevation) * np.sin(azimuth), np.sin(elevation)])
    right = np.array([-np.sin(azimuth), np.cos(azimuth), 0.])
    up = np.cross(towards, right)
    corners = np.array([[frame[i][0], frame[j][1], frame[k][2]] for i in (0, 1) for j in (0, 1) for k in (0, 1)])
    low, high = ((extreme(corners @ right), extreme(corners @ up)) for extreme in (np.min, np.max))
    low = low[0], low[1] - 0.12 * (high[1] - low[1])  # room for the scale
    middle = 0.5 * (np.array(low) + high)
    extent = 1.06 * (np.array(high) - low)
    height = int(np.clip(width * extent[1] / extent[0], 0.3 * width, 1.1 * width))
    half_height = 0.5 * max(extent[1], extent[0] * height / width)
    centre = corners.mean(axis=0)
    return Camera(centre + (middle[0] - centre @ right) * right + (middle[1] - centre @ up) * up, right, up, towards, half_height, width, height,
                  corners[np.argmin(corners @ up)] @ right - middle[0])


def _lattice(box, run, lower, upper):
    """Coordinates along the picture's axes and the rigid surfaces at their nodes, indexed z, y, x."""
    spacing = max(0.25 * box.cell_size, (np.prod(upper - lower) / LARGEST_LATTICE) ** (1 / 3))
    numbers = np.maximum(np.ceil((upper - lower) / spacing - 1e-6).astype(int) + 1, 2)
    return [np.linspace(low, high, n) for low, high, n in zip(lower, upper, numbers)], spacing


def _contour(coordinates, values, level, outside, fields=()):
    """The closed surface where `values` at the nodes of a lattice are `level`, with normals. What is `outside` of the lattice closes it by planes.

    `fields`: arrays of the nodes by name, which are interpolated to the surface.
    """
    width = 1e-3 * (coordinates[0][1] - coordinates[0][0])
    coordinates = [np.concatenate([[line[0] - width], line, [line[-1] + width]]) for line in coordinates]
    lines = {f"{axis}Coordinates": numpy_to_vtk(line, deep=True) for axis, line in zip("XYZ", coordinates)}
    grid = _set(vtkRectilinearGrid(), Dimensions=tuple(map(len, coordinates)), **lines)
    grid.GetPointData().SetScalars(_array("level", np.pad(values, 1, constant_values=outside).ravel()))
    for name, field in dict(fields).items():
        grid.GetPointData().AddArray(_array(name, np.pad(field, 1, mode="edge").ravel()))
    contour = _set(vtkContourFilter(), InputData=grid, Value=(0, level), ComputeScalars=0, ComputeNormals=0)
    normals = _set(vtkPolyDataNormals(), InputConnection=contour.GetOutputPort(), FeatureAngle=35.)
    normals.Update()
    return normals.GetOutput()


def _array(name, values):
    values = np.ascontiguousarray(values, dtype=values.dtype if values.dtype == np.uint8 else np.float32)
    array = numpy_to_vtk(values, deep=True)
    array.SetName(name)
    return array


def _actor(mapper, colour=None, ambient=0.32, **properties):
    """`colour`: of all; without it the array "colour" of what the mapper draws."""
    mapper.SetScalarVisibility(colour is None)
    if colour is None:
        mapper.SetScalarModeToUsePointFieldData()
        mapper.SelectColorArray("colour")
        mapper.SetColorModeToDirectScalars()
    actor = _set(vtkActor(), Mapper=mapper)
    _set(actor.GetProperty(), Color=colour or (1., 1., 1.), Ambient=ambient, Diffuse=1. - ambient, **properties)
    return actor


def _surface(data, colour=None, ambient=0.32):
    return _actor(_set(vtkPolyDataMapper(), InputData=data), colour, ambient)


def _contour_lines(surface, heights):
    """Lines of equal height on the ground, but not on the planes that cut it."""
    bounds = np.array(surface.GetBounds()).reshape(3, 2)
    margin = 2e-3 * np.max(bounds[:2, 1] - bounds[:2, 0])
    inside = _set(vtkBox(), Bounds=(bounds + [[margin, -margin]] * 3).ravel())
    clipped = _set(vtkClipPolyData(), InputData=surface, ClipFunction=inside, InsideOut=1)
    elevation = _set(vtkElevationFilter(), InputConnection=clipped.GetOutputPort(), LowPoint=(0, 0, bounds[2, 0]), HighPoint=(0, 0, bounds[2, 1]),
                     ScalarRange=bounds[2])
    lines = _set(vtkContourFilter(), InputConnection=elevation.GetOutputPort())
    for number, height in enumerate(heights):
        lines.SetValue(number, height)
    mapper = _set(vtkPolyDataMapper(), InputConnection=lines.GetOutputPort(), RelativeCoincidentTopologyLineOffsetParameters=(0., -4.))
    mapper.SetResolveCoincidentTopologyToPolygonOffset()
    return _actor(mapper, (0.35, 0.32, 0.28), Opacity=0.45, LineWidth=1.2, Lighting=0)


class Scene:
    """Draws the points of a run at several times from one camera; close() ends it, as does leaving `with`."""

    def __init__(self, run, box, frame, view, stack, width=1000):
        """`frame` is the part of the box that is shown, `stack` a contextlib.ExitStack that closes the window."""
        self.run, self.box, self.order = run, box, axes_order(box)
        self.renderer = vtkRenderer()
        self.renderer.SetBackground(1, 1, 1)
        lower, upper = frame.lower[self.order], frame.upper[self.order]
        coordinates, self.spacing = _lattice(box, run, lower, upper)
        self.coordinates = self._without_depth(coordinates)
        self.ground = []
        self.moved = None
        self._draw_ground(0.)
        bounds = self._bounds_of_ground(lower, upper)
        self.camera = camera_of(bounds, view, width)
        self.scale_length = terrain.nice_length(0.17 * np.max((bounds[1] - bounds[0])[:2]))
        self.window = stack.enter_context(offscreen_window(SUPERSAMPLING * self.camera.width, SUPERSAMPLING * self.camera.height))
        self._set_view()
        self.window.AddRenderer(self.renderer)

    def _places(self, coordinates):
        z, y, x = np.meshgrid(*reversed(coordinates), indexing="ij", sparse=True)
        places = [None] * 3
        for axis, place in zip(self.order, (x, y, z)):
            places[axis] = place
        return places

    def _surfaces(self, coordinates, time):
        shape = [len(line) for line in reversed(coordinates)]
        return [surface._replace(level_set=np.broadcast_to(surface.level_set, shape))
                for surface in rigid.rigid_surfaces(self.run, self._places(coordinates), time)]

    def _without_depth(self, coordinates):
        """Layers far below the ground are not shown."""
        beds = [surface.level_set for surface in self._surfaces(coordinates, 0.) if surface.is_bed]
        if beds:
            lowest = int(np.argmax(np.any(beds[0] > 0, axis=(1, 2))))
            depth = int(np.ceil(0.04 * np.ptp(coordinates[0]) / self.spacing))
            coordinates = [*coordinates[:2], coordinates[2][max(0, lowest - depth):]]
        return coordinates

    def _draw_ground(self, time):
        """Bed, obstacles and, without a bed, the floor of the box; again if an obstacle has moved."""
        surfaces = self._surfaces(self.coordinates, time)
        moved = np.array([surface.displacement for surface in surfaces]) if surfaces else np.zeros(0)
        if self.moved is not None and np.allclose(moved, self.moved):
            return
        self.moved = moved
        for actor in self.ground:
            self.renderer.RemoveActor(actor)
        self.ground = []
        beds = [surface.level_set for surface in surfaces if surface.is_bed]
        for surface in surfaces:
            if beds and not surface.is_bed:
                # Only what stands out of the bed: two surfaces in one place would flicker.
                surface = surface._replace(level_set=np.maximum(surface.level_set, -beds[0]))
            bound = 2 * (self.coordinates[0][1] - self.coordinates[0][0])
            solid = _contour(self.coordinates, np.clip(surface.level_set, -bound, bound), 0., bound)
            if not solid.GetNumberOfPoints():
                continue
            self.ground.append(_surface(solid, GROUND if surface.is_bed else STRUCTURE))
            if surface.is_bed:
                low, high = self.coordinates[2][0], solid.GetBounds()[5]
                step = terrain.nice_length(max(high - low, 1e-9) / 8)
                self.ground.append(_contour_lines(solid, np.arange(np.ceil(low / step) + 1, high / step) * step))
        if not any(surface.is_bed for surface in surfaces):
            self.ground.append(self._floor())
        for actor in self.ground:
            self.renderer.AddActor(actor)

    def _floor(self):
        (x, y, z), cube = self.coordinates, vtkCubeSource()
        cube.SetBounds(x[0], x[-1], y[0], y[-1], z[0] - 0.02 * max(np.ptp(x), np.ptp(y)), z[0])
        cube.Update()
        return _surface(cube.GetOutput(), FLOOR)

    def _bounds_of_ground(self, lower, upper):
        bounds = np.array([actor.GetBounds() for actor in self.ground])
        top = max(np.max(bounds[:, 5]), min(upper[2], self.coordinates[2][-1]))
        return np.array([[lower[0], lower[1], np.min(bounds[:, 4])], [upper[0], upper[1], top]])

    def _set_view(self):
        seen = self.camera
        distance = 10 * seen.half_height * max(1., seen.width / seen.height)
        _set(self.renderer.GetActiveCamera(), ParallelProjection=1, ParallelScale=seen.half_height, FocalPoint=seen.focus,
             Position=seen.focus + distance * seen.towards, ViewUp=seen.up, ClippingRange=(0.2 * distance, 2 * distance))
        self.renderer.AutomaticLightCreationOff()
        # The sun stands left of the camera, high; a weak light from the camera fills the shades.
        for direction, intensity in ((seen.towards - 1.0 * seen.right + 0.9 * seen.up, 0.85), (seen.towards + 0.4 * seen.right, 0.35)):
            self.renderer.AddLight(_set(vtkLight(), Positional=False, Position=seen.focus + distance * direction, FocalPoint=seen.focus,
                                        Intensity=intensity))

    def _skin(self, points, colours):
        """The surface around the material, with the mean colours of what is below it, and which points are too few for one."""
        alone = np.ones(len(points.positions), dtype=bool)
        if not len(points.positions):
            return None, alone
        places = points.positions[:, self.order]
        limits = np.array([[line[end] for line in self.coordinates] for end in (0, -1)])
        inside = np.all((places >= limits[0]) & (places <= limits[1]), axis=1)
        if not np.any(inside):
            return None, alone
        margin = 2 * self.box.cell_size
        lower, upper = np.maximum(limits[0], places[inside].min(axis=0) - margin), np.minimum(limits[1], places[inside].max(axis=0) + margin)
        spacing = max(self.box.cell_size / 3, (np.prod(upper - lower) / LARGEST_LATTICE) ** (1 / 3))
        numbers = np.ceil((upper - lower) / spacing - 1e-6).astype(int)
        # Nodes in the middle of their cubes, but those beside a wall on it.
        coordinates = [low + (np.arange(n) + 0.5) * spacing for low, n in zip(lower, numbers)]
        for line, low, high in zip(coordinates, lower, upper):
            line[[0, -1]] = low, high
        index = tuple(np.clip(((places[inside, axis] - lower[axis]) / spacing).astype(int), 0, numbers[axis] - 1) for axis in (2, 1, 0))
        surfaces = self._surfaces(coordinates, points.time)
        is_open = np.all([surface.level_set > 0 for surface in surfaces], axis=0) if surfaces else np.ones(numbers[::-1])
        width = WIDTH_OF_FILL * self.box.cell_size / spacing

        def spread(weights):
            """The weights of the points, on the lattice."""
            shape = tuple(numbers[::-1])
            return blurred(np.bincount(np.ravel_multi_index(index, shape), weights, np.prod(shape)).reshape(shape), width)

        volumes = (point_sides(points, self.box)[inside] / spacing) ** 3
        filled = spread(volumes)
        colour = {f"colour {part}": spread(volumes * colours[inside, part]) / np.maximum(filled, 1e-12) for part in range(3)}
        filled = filled / np.maximum(blurred(is_open.astype(float), width), 0.25)
        if surfaces:
            # The surface ends half a node below the ground; cut faces must not cover those of the ground.
            filled = np.minimum(filled, LEVEL * (1.5 + np.min([surface.level_set for surface in surfaces], axis=0) / spacing))
        alone[inside] = filled[index] < 0.75 * LEVEL
        skin = _contour(coordinates, filled, LEVEL, 0., colour)
        if not skin.GetNumberOfPoints():
            return None, alone
        mean = np.stack([vtk_to_numpy(skin.GetPointData().GetArray(name)) for name in colour], axis=1)
        skin.GetPointData().AddArray(_array("colour", (255 * np.clip(mean, 0, 1) + 0.5).astype(np.uint8)))
        return skin, alone

    def _spheres(self, points, colours, chosen):
        """Single points, as large as their volume."""
        places = points.positions[chosen][:, self.order]
        cloud, nodes, cells = vtkPolyData(), vtkPoints(), vtkCellArray()
        nodes.SetData(numpy_to_vtk(np.ascontiguousarray(places, dtype=np.float32), deep=True))
        cloud.SetPoints(nodes)
        # The mapper takes its bounds from cells.
        cells.InsertNextCell(len(places), list(range(len(places))))
        cloud.SetVerts(cells)
        cloud.GetPointData().AddArray(_array("colour", (255 * colours[chosen, :3] + 0.5).astype(np.uint8)))
        cloud.GetPointData().AddArray(_array("radius", 0.62 * point_sides(points, self.box)[chosen]))
        return _actor(_set(vtkOpenGLSphereMapper(), InputData=cloud, ScaleArray="radius"), ambient=0.4)

    def _material(self, points, colours):
        skin, alone = self._skin(points, colours)
        limits = np.array([[line[end] for line in self.coordinates] for end in (0, -1)])
        alone &= np.all((points.positions[:, self.order] >= limits[0]) & (points.positions[:, self.order] <= limits[1]), axis=1)
        return ([_surface(skin, ambient=0.4)] if skin else []) + ([self._spheres(points, colours, alone)] if np.any(alone) else [])

    def _free_water(self, water):
        """The water outside of the soil, translucent."""
        free = water.arrays["inside_soil"] < 0.5 if "inside_soil" in water.arrays else np.ones(len(water.positions), dtype=bool)
        water = water._replace(positions=water.positions[free], arrays={name: values[free] for name, values in water.arrays.items()})
        skin, _ = self._skin(water, np.ones((len(water.positions), 4)))
        if not skin:
            return []
        return [_actor(_set(vtkPolyDataMapper(), InputData=skin), WATER, Opacity=0.5, BackfaceCulling=1)]

    def image(self, points, colours, water=None):
        """An RGB image (rows from the top) of the points, with a row of `colours` for each, and of the free `water` around them."""
        self._draw_ground(points.time)
        actors = self._material(points, colours) + (self._free_water(water) if water else [])
        for actor in actors:
            self.renderer.AddActor(actor)
        self.window.Render()
        height, width = self.camera.height, self.camera.width
        colour = vtkUnsignedCharArray()
        self.window.GetRGBACharPixelData(0, 0, SUPERSAMPLING * width - 1, SUPERSAMPLING * height - 1, 0, colour)
        pixels = vtk_to_numpy(colour).reshape(height, SUPERSAMPLING, width, SUPERSAMPLING, 4)
        image = pixels[..., :3].mean(axis=(1, 3))[::-1].astype(np.uint8)
        for actor in actors:
            self.renderer.RemoveActor(actor)
        return image

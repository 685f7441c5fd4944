# SPDX-License-Identifier: LGPL-2.1-or-later
"""pictures.py: how scree.pictures turns points into areas, surfaces and colours; on points made here, without a run."""

import contextlib
import pathlib
import shutil
import sys
from unittest import mock

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402

from scree import render  # noqa: E402
from scree.pictures import fields, panels, paraview, plane, rigid, scene  # noqa: E402
from scree.results import Box, Points  # noqa: E402

CELL = 0.1
PLANE = """set Local origin = 100, 200
subsection Bed
  set Type = fixed
  set Level set expression = if(x < 1 && y > -1, y - 0.1*x^2, max(y, 0))
end
subsection Obstacle Hill
  set Type = free slip
  set Raster = hill.asc
end
"""


def lattice(dim, stretch=1.):
    """Points of a block of 1 m per axis, three a cell; `stretch` pulls it along x."""
    line = (np.arange(30) + 0.5) / 30
    places = np.stack(np.meshgrid(*[line] * dim, indexing="ij"), axis=-1).reshape(-1, dim)
    positions = np.zeros((len(places), 3))
    positions[:, :dim] = places
    positions[:, 0] *= stretch
    arrays = {"volume": np.full(len(places), stretch / 30 ** dim), "plastic_shear_strain": positions[:, 0].copy()}
    return Points(0., positions, arrays)


def box(dim):
    return Box(np.zeros(dim), np.array([4., 2., 2.])[:dim], CELL, dim - 1)


def check_colours():
    strain, pressure = "plastic_shear_strain", "pressure"
    assert fields.colour_scale(np.zeros(9), strain)[1:] == (0., 1., "neither")
    assert fields.colour_scale(np.linspace(0.4, 1, 101), strain).low == 0.
    low = fields.colour_scale(np.append(np.linspace(0, 1, 999), -0.5), pressure)
    assert low.extend == "min" and fields.colour_scale(np.append(np.linspace(0, 1, 999), 9), strain).extend == "max"
    assert np.mean(fields.colour_scale(np.zeros(9), strain).mappable.to_rgba(0.)[:3]) > 0.85, "zero must be light"


def check_areas():
    """Stretched points leave no gaps, and the area is that of the points."""
    for stretch in (1., 2.5):
        points, pixels = lattice(2, stretch), plane.pixels_of(box(2), 400)
        filled = plane.fill(points, box(2), pixels, np.ones((pixels.ny, pixels.nx), dtype=bool))
        covered, nearest = plane._covered(points, box(2), pixels, filled)
        inside = np.zeros_like(covered)
        inside[:int(0.95 / pixels.width), :int(0.95 * stretch / pixels.width)] = True
        assert np.all(covered[inside]), f"stretch {stretch}: {np.sum(~covered[inside])} pixels are missing"
        area = np.sum(covered) * pixels.width ** 2
        assert abs(area / stretch - 1) < 0.02, f"stretch {stretch}: area {area}"
        x = np.meshgrid(*pixels.centres)[0]
        assert np.max(np.abs(points.positions[nearest, 0] - x)[covered]) < 0.6 * stretch / 30 + pixels.width
    shown = plane.fitted(box(2), [lattice(2)])
    assert np.allclose(shown.lower, 0.) and np.allclose(shown.upper, [1 - 0.5 / 30 + 0.3] * 2)
    figure, axes = plt.subplots()
    plane.draw_points(axes, lattice(2), box(2), "plastic_shear_strain", (0., 1.))
    plt.close(figure)


def check_ground(run):
    (run / "parameters.prm").write_text(PLANE, encoding="utf-8")
    (run / "hill.asc").write_text("ncols 3\nnrows 2\nxllcenter 100\nyllcenter 200\ncellsize 1\n3 4 5\n0 1 2\n", encoding="utf-8")
    places = [np.array([0.5, 0.1]), np.array([0.5, 0.1]), np.array([0.5, 0.1])]
    surfaces = {surface.name: surface.level_set for surface in rigid.rigid_surfaces(run, places, 0.)}
    assert np.allclose(surfaces["Bed"], [0.475, 0.099]), surfaces
    assert np.allclose(surfaces["Obstacle Hill"], [0.5 - (0.5 + 1.5), 0.1 - (0.1 + 0.3)]), surfaces


def check_title(run):
    """A trial of --safety has its factor: the largest at which the slope rests, the smallest at which it fails."""
    (run / "safety.csv").write_text("Factor (-),Rests (-),Displacement (m)\n1,1,0.1\n1.3,1,0.1\n1.4,0,0.2\n1.69,0,0.3\n", encoding="utf-8")
    assert panels._title(run / "rests", 0.) == "strength divided by 1.3: the slope rests"
    assert panels._title(run / "fails", 0.) == "strength divided by 1.4: the slope fails"
    assert panels._title(run, 2.5) == "t = 2.5 s"


def check_default_field():
    """Soil of which more than 1 % has moved by more than a cell is shown by its displacement, or without it by its speed."""
    rest = lattice(2)
    rest.arrays["id"] = np.arange(len(rest.positions))
    slid = rest._replace(positions=rest.positions + [2 * CELL, 0, 0] * (np.arange(len(rest.positions)) % 50 == 0)[:, None])
    told = slid._replace(arrays={**slid.arrays, "displacement": np.zeros((len(rest.positions), 3))})
    for last, field in ((rest, "mean_effective_stress"), (slid, "velocity"), (told, "displacement")):
        with mock.patch.multiple(render.results, read_times=lambda *_: np.array([0., 1.]), read_box=lambda *_: box(2),
                                 read_points=lambda run, time, collection, last=last: rest if time == 0 else last):
            assert render.default_field("run", "points") == field, field


def check_stages(run):
    """What stages remove is where soil is then, by expressions and by layers with holes; what they add is where none is."""
    (run / "drawing.csv").write_text("name,x,y\n" + "".join(f"pit,{x},{y}\n" for ring in (((1, 0), (3, 0), (3, 2), (1, 2), (1, 0)), ((1.5, 0.5), (2, 0.5), (2, 1), (1.5, 1)))
                                                           for x, y in ring), encoding="utf-8")
    entries = {"Drawing": "drawing.csv", "Stage Dig/Remove": "y > 0.5 && x < 1", "Stage Pit/Remove layer": "pit", "Stage Lay/Add": "Fill", "Fill/Region": "y > 0.5 && y < 2 && x < 1",
               "Stage Odd/Remove": "x < 1 ? 1 : 0", "Stage Last/Remove": "x < 1"}
    places = np.meshgrid((np.arange(80) + 0.5) / 20, (np.arange(40) + 0.5) / 20)
    found = {label: (is_added, np.sum(mask) / 400) for label, is_added, mask in scene.stage_areas(run, entries, places, places[1] < 1)}
    assert found == {"Dig: removed": (False, 0.5), "Pit: removed": (False, 1.75), "Lay: Fill": (True, 1.5), "Last: removed": (False, 2.)}, found


def check_paraview(run):
    """The ground beside the script for ParaView is that of the bed, in the coordinates of the points."""
    import vtk  # pylint: disable=import-outside-toplevel
    (run / "parameters.prm").write_text("set Dimension = 3\nset Local origin = 100, 200\n"
                                        "subsection Mesh\n  set Lower corner = 0, 0, 0\n  set Upper corner = 4, 2, 2\n  set Cell size = 0.1\nend\n"
                                        "subsection Bed\n  set Type = fixed\n  set Level set expression = z - 0.5 - 0.2*x\nend\n", encoding="utf-8")
    assert paraview.write_ground(run, box(3), run / "ground.vtk")
    reader = vtk.vtkStructuredGridReader()
    reader.SetFileName(str(run / "ground.vtk"))
    reader.Update()
    places = np.array([reader.GetOutput().GetPoint(i) for i in range(reader.GetOutput().GetNumberOfPoints())])
    assert len(places) == 80 * 40 and np.allclose(places[:, 2], 0.5 + 0.2 * places[:, 0], atol=1e-5), places
    assert np.allclose(places.min(axis=0)[:2], 0.025, atol=1e-6) and np.allclose(places.max(axis=0)[:2], [3.975, 1.975], atol=1e-6)


def check_space(run):
    """The colour of the points, the ground and white paper are in the image."""
    from scree.pictures import space  # pylint: disable=import-outside-toplevel
    (run / "parameters.prm").write_text("subsection Bed\n  set Type = fixed\n  set Level set expression = z - 0.05*x\nend\n", encoding="utf-8")
    points = lattice(3)
    with contextlib.ExitStack() as stack:
        view = space.Scene(run, box(3), box(3), space.view_along(box(3), [points]), stack, 300)
        image = view.image(points, np.tile([1., 0., 0., 1.], (len(points.positions), 1))).astype(int)
        empty = view.image(points._replace(positions=np.zeros((0, 3)), arrays={}), np.zeros((0, 4))).astype(int)
    is_red = image[..., 0] - image[..., 1] > 60
    assert 0.03 < np.mean(is_red) < 0.4, np.mean(is_red)
    assert np.mean(np.all(image == 255, axis=2)) > 0.2
    is_ground = (np.ptp(empty, axis=2) < 60) & (empty[..., 0] < 240)
    assert np.mean(is_ground) > 0.2, np.mean(is_ground)
    column, row = view.camera.pixel([0.5, 0.5, 1.])
    assert is_red[int(row), int(column)], "the middle of the top of the block is elsewhere"


def main():
    run = pathlib.Path("run")
    run.mkdir(exist_ok=True)
    check_colours()
    check_areas()
    check_ground(run)
    check_title(run)
    check_default_field()
    check_stages(run)
    check_paraview(run)
    if shutil.which("Xvfb"):
        check_space(run)
    else:
        print("No Xvfb: 3D pictures are not tested.")


if __name__ == "__main__":
    sys.exit(main())

# SPDX-License-Identifier: LGPL-2.1-or-later
"""What pictures of maps are made of: expressions, heights of the ground, files by time, places without soil, classes of colours."""

import pathlib
import shutil

import numpy as np

from scree import expressions, maps, terrain
from scree.variants import set_entries

from test_tools import raises, run_tests

CASE = {"Dimension": 3, "Gravity": "0, 0, -9.81", "Local origin": "1000, 2000", "Mesh/Lower corner": "0, 0, 0", "Mesh/Upper corner": "20, 10, 10",
        "Mesh/Cell size": 1, "Bed/Type": "friction", "Bed/Level set expression": "z - if(x < 10 && y > -1, 5 - x^2/25, 1)",
        "Output/Maps/Write": "true", "Output/Maps/Least thickness": 0.2}


def write(name, values):
    rows = "\n".join(" ".join(map(str, row)) for row in values)
    pathlib.Path("run/maps", name + ".asc").write_text("ncols 20\nnrows 10\nxllcorner 1000\nyllcorner 2000\ncellsize 1\nNODATA_value -9999\n" + rows,
                                                       encoding="utf-8")


def test_expressions():
    x = np.array([-1., 1.])
    np.testing.assert_allclose(expressions.evaluate("-x^2 + max(0, x, -3) - abs(x)", x=x), [-2, -1])
    np.testing.assert_allclose(expressions.evaluate("if(x > 0 || x < -2, sin(pi/2), 2e1)", x=x), [20, 1])
    raises("not supported", expressions.evaluate, "x.real")
    raises("not supported", expressions.evaluate, "__import__(1)")
    raises("cannot be evaluated", expressions.evaluate, "x ? 1 : 2")


def test_ground():
    ground = terrain.ground("run", (1000, 1020, 2000, 2010))
    x, _ = terrain.places(ground)
    x -= 1000
    np.testing.assert_allclose(ground.values, np.broadcast_to(np.where(x < 10, 5 - x ** 2 / 25, 1), ground.values.shape), atol=1e-12)
    assert terrain.contour_step(ground) == 0.5  # 4 m of height, about 12 contours


def test_maps():
    soil = np.zeros((10, 20))
    soil[2:4, 3:6] = [[0.1, 0.2, 3.], [0.1, 1., 2.]]
    write("thickness_00.0s", soil)
    write("thickness_12.5s", 2 * soil)
    write("thickness", 2 * soil)
    write("mass", 1500 * 2 * soil)
    write("deposit", soil - 2 * soil[:, ::-1])
    write("arrival_time", np.where(soil > 0, 0, -9999))
    write("largest_impact_pressure", 1e5 * soil)
    assert maps.map_times("run") == {0.: "thickness_00.0s", 12.5: "thickness_12.5s"}
    assert maps.find_map("run", "thickness_0s").name == "thickness_00.0s.asc"
    raises("no map at t = 12 s; there are 2, at 0, 12.5 s", maps.find_map, "run", "thickness_12s")
    raises("no map depth; there are: arrival_time, deposit, largest_impact_pressure, mass, thickness", maps.find_map, "run", "depth")
    for name, places in (("thickness_0s", 4), ("mass", 6), ("deposit", 10), ("arrival_time", 6), ("largest_impact_pressure", 6)):
        assert np.isfinite(maps.read_map("run", name).raster.values).sum() == places, name
    pressure = maps.read_map("run", "largest_impact_pressure")
    assert maps.range_of([pressure]) == (0., 300.) and pressure.kind.unit == "kPa"
    assert maps.title_of("run", "deposit", True) == "Deposit and depletion (blue), t = 12.5 s"
    colours, bounds = maps.colours_of(pressure.kind, 0., 300.)
    assert bounds[0] == 0. and bounds[-1] == 300. and colours.N == len(bounds) - 1  # nothing below 0
    assert 0. in maps.colours_of(pressure.kind, -3.3, 1.2)[1]
    window = maps.window_of("run", [maps.read_map("run", "thickness_0s")], maps.release("run"))
    assert 1000 <= window[0] < 1003 and 1006 < window[1] < 1010 and 2003 < window[2] < 2007 and 2008 < window[3] <= 2010, window
    assert maps.coordinate_system("run") == ""
    pathlib.Path("run/maps/deposit.prj").write_text('PROJCS["MGI / Austria GK West",GEOGCS["MGI"]]', encoding="utf-8")
    assert maps.coordinate_system("run") == "MGI / Austria GK West"
    maps.render("run", maps.default_maps("run"), "maps.png")
    assert pathlib.Path("maps.png").stat().st_size > 10000


shutil.rmtree("run", ignore_errors=True)
pathlib.Path("run/maps").mkdir(parents=True, exist_ok=True)
pathlib.Path("run/parameters.prm").write_text(set_entries("", CASE), encoding="utf-8")
run_tests(globals())

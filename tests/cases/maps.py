# SPDX-License-Identifier: LGPL-2.1-or-later
"""maps.py SCREE LAUNCHER TEST: the maps of a run: values of a block in flight, on one rank and two, and after a resume.

Each test is a function below (case_tools.py).
"""

import pathlib
import shutil
import sys

import numpy as np

from scree.results import read_raster, read_table

from case_tools import HERE, check, run

NAMES = ["thickness", "mass", "deposit", "largest_thickness", "largest_speed", "largest_impact_pressure", "scour_depth", "arrival_time"]
MAPS = """
subsection Output
  subsection Maps
    set Write           = true
    set Least thickness = 0.02
  end
end
"""
SCOUR = "subsection Probes\n  set Displacement = true\nend\n"
BLOCK = """
set Dimension = 3
set Gravity   = 0, 0, 0
set End time  = 0.1
set Output directory = results
subsection Mesh
  set Lower corner = 600000, 5100000, 1000
  set Upper corner = 600001.2, 5100000.8, 1000.8
  set Cell size    = 0.1
end
subsection Soil
  set Region           = x > 600000.2 && x < 600000.5 && y > 5100000.1 && y < 5100000.3 && z > 1000.2 && z < 1000.6
  set Material         = linear elastic
  set Grain density    = 2000
  set Initial velocity = 3; 0; 1
end
"""


def read_map(results, name):
    """Values of a map, rows from the south; nan where there is none."""
    return read_raster(results / "maps" / f"{name}.asc").values[::-1]


def read_profile(results):
    """Columns of the table of a plane run."""
    lines = (results / "maps" / "profile.csv").read_text(encoding="utf-8").splitlines()
    return dict(zip(lines[0].split(", "), np.array([[float(word) for word in line.split(",")] for line in lines[1:]]).T))


def close(values, wanted, what):
    difference = np.max(np.abs(np.asarray(values) - wanted))
    check(difference <= 1e-7 * max(1, np.max(np.abs(wanted))), f"{what}: differs by {difference}")


def block():
    """A block that flies with 3 m/s along x, and rises: 0.3 m in the run, to ground that it had not covered."""
    results = run("block", BLOCK + MAPS)
    raster = read_raster(results / "maps" / "thickness.asc")
    head = [*raster.values.shape[::-1], raster.x, raster.y, raster.width]
    check(head == [12, 8, 600000, 5100000, 0.1], f"head: {head}")
    # The half of a rim's column that is nearer to the neighbour gives it a quarter of its soil: an eighth in all.
    along_x, along_y = np.zeros(12), np.zeros(8)
    along_x[4:9] = 0.125, 0.875, 1, 0.875, 0.125
    along_y[:4] = 0.125, 0.875, 0.875, 0.125
    at_end = 0.4 * np.outer(along_y, along_x)
    at_start = np.roll(at_end, -3, axis=1)
    close(read_map(results, "thickness_0s"), at_start, "thickness at the start")
    close(raster.values[::-1], at_end, "thickness")
    close(read_map(results, "thickness_0.1s"), at_end, "thickness by its time")
    close(read_map(results, "mass"), 2000 * at_end, "mass")
    close(read_map(results, "deposit"), at_end - at_start, "deposit")
    largest, speed = read_map(results, "largest_thickness"), read_map(results, "largest_speed")
    arrival = read_map(results, "arrival_time")
    close(largest, np.maximum(at_start, at_end), "largest thickness of two samples")
    is_reached = largest >= 0.02
    close(speed[is_reached], np.sqrt(10), "largest speed")
    close(speed[~is_reached], 0, "largest speed where there was nothing")
    pressure = read_map(results, "largest_impact_pressure")
    close(pressure / 2e4, is_reached, "largest impact pressure over density times speed squared")
    close(arrival[at_start >= 0.02], 0, "arrival time at the source")
    close(arrival[is_reached & (at_start < 0.02)], 0.1, "arrival time")
    check(np.all(np.isnan(arrival[~is_reached])), "arrival where there was nothing")


def slide():
    """A block on an oblique bed: the maps hold its mass; two ranks and a resumed run have those of one that did not stop."""
    text = (HERE / "bed_short_3d.prm").read_text(encoding="utf-8") + MAPS
    text += "subsection Soil\n  set Initial velocity = 1; 0.3; -0.46\nend\n"  # along the bed
    text += SCOUR
    one = run("one", text)
    first = {name: read_map(one, name) for name in NAMES}
    statistics = read_table(one / "statistics")
    mass = next(values for name, values in statistics.items() if name.startswith("Mass (kg)"))[-1]
    check(abs(np.sum(first["mass"]) * 0.1**2 / mass - 1) <= 1e-7, "mass of the map and of the points")
    check(np.all(first["largest_thickness"] >= first["thickness"]), "largest thickness below the last one")
    check(np.nanmax(first["arrival_time"]) > 0.05, "nothing arrives after the checkpoint")
    check(np.nanmax(first["largest_speed"]) > 0.1, "nothing moves")
    check(np.nanmax(first["scour_depth"]) > 0.05, "nothing has left its place")

    def compare(results, what):
        for name in NAMES:
            values = read_map(results, name)
            check(np.array_equal(np.isnan(values), np.isnan(first[name])), f"{what}, {name}: nan elsewhere")
            close(np.nan_to_num(values), np.nan_to_num(first[name]), f"{what}, {name}")

    two = run("two", text, ranks=2)
    compare(two, "two ranks")
    for folder, ranks in (("one", 1), ("two", 1), ("two", 2)):
        shutil.rmtree(pathlib.Path(folder, "results", "maps"))
        compare(run(folder, text, "--resume", ranks=ranks), f"resumed from {folder} on {ranks}")


def scour():
    """A block flies over another at rest: it leaves a depth of scour at its start, and none where it comes to."""
    flying = BLOCK.replace("subsection Soil", "set Bodies = Rest, Flow\nsubsection Rest").replace("3; 0; 1", "0; 0; 0")
    flying = flying.replace("z > 1000.2 && z < 1000.6", "z > 1000.2 && z < 1000.4")
    flying += flying[flying.index("subsection Rest") :].replace("subsection Rest", "subsection Flow").replace("0; 0; 0", "3; 0; 0").replace(
        "z > 1000.2 && z < 1000.4", "z > 1000.6 && z < 1000.7"
    )
    along_x, along_y = np.zeros(12), np.zeros(8)
    along_x[1:6] = 0.125, 0.875, 1, 0.875, 0.125
    along_y[:4] = 0.125, 0.875, 0.875, 0.125
    for ranks in (1, 2):
        results = run(f"scour_{ranks}", flying + MAPS + SCOUR, ranks=ranks)
        # All that has left is the flow's layer of one cell, from where it was at the start.
        close(read_map(results, "scour_depth"), 0.1 * np.outer(along_y, along_x), "scour depth")


def profile():
    """The block in the plane: a table along x. It rises and flies with 3 m/s along x."""
    plane = BLOCK.replace("set Dimension = 3\n", "").replace("0, 0, 0", "0, 0")
    plane = plane.replace("600000, 5100000, 1000", "600000, 1000").replace("600001.2, 5100000.8, 1000.8", "600001.2, 1000.8")
    plane = plane.replace("y > 5100000.1 && y < 5100000.3 && z > 1000.2 && z < 1000.6", "y > 1000.2 && y < 1000.6").replace("3; 0; 1", "3; 1")
    for ranks in (1, 2):
        results = run(f"profile_{ranks}", plane + MAPS, ranks=ranks)
        table = read_profile(results)
        close(table["x (m)"], 600000 + 0.1 * (np.arange(12) + 0.5), "x")
        at_end = np.zeros(12)
        at_end[4:9] = 0.05, 0.35, 0.4, 0.35, 0.05
        at_start = np.roll(at_end, -3)
        close(table["thickness (m)"], at_end, "thickness")
        close(table["mass (kg/m^2)"], 2000 * at_end, "mass")
        close(table["deposit (m)"], at_end - at_start, "deposit")
        largest = np.maximum(at_start, at_end)
        close(table["largest thickness (m)"], largest, "largest thickness")
        close(table["largest speed (m/s)"], np.sqrt(10) * (largest > 0), "largest speed")
        close(table["largest impact pressure (Pa)"] / 2e4, largest > 0, "largest impact pressure over density times speed squared")
        arrival = np.where(at_start > 0, 0, np.where(at_end > 0, 0.1, np.nan))
        check(np.array_equal(np.isnan(table["arrival time (s)"]), np.isnan(arrival)), "arrival where there was nothing")
        close(np.nan_to_num(table["arrival time (s)"]), np.nan_to_num(arrival), "arrival time")
        check((results / "maps" / "profile_0s.csv").exists() and (results / "maps" / "profile_0.1s.csv").exists(), "profiles of their times")

    # Slowed down from 3 to 2 m/s: where it is at the start, that is its largest speed, and its largest pressure.
    table = read_profile(run("slowed", "set Body force = -10; 0\n" + plane + MAPS))
    speed = table["largest speed (m/s)"]
    close(speed[at_start >= 0.02], np.sqrt(10), "largest speed of what slows down")
    check(0 < np.min(speed[speed > 0]) < 3, "nothing is reached late")
    close(table["largest impact pressure (Pa)"] / 2000, speed**2, "largest impact pressure over density of what slows down")


{"block": block, "slide": slide, "scour": scour, "profile": profile}[sys.argv[3]]()

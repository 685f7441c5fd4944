# SPDX-License-Identifier: LGPL-2.1-or-later
"""maps.py SCREE LAUNCHER TEST: the maps of a run: values of a block in flight, on one rank and two, and after a resume; GeoTIFF.

Each test is a function below (case_tools.py).
"""

import os
import pathlib
import shutil
import sys

import numpy as np

from scree.maps import find_map
from scree.results import read_raster, read_table
from scree.variants import read_case, set_entries

from case_tools import check, log_of, rows_of, run

NAMES = ["thickness", "mass", "deposit", "largest_thickness", "largest_speed", "largest_impact_pressure", "arrival_time"]
MAPS = {"Output/Maps/Write": "true", "Output/Maps/Least thickness": 0.02}
BLOCK = {"Dimension": 3, "Gravity": "0, 0, 0", "End time": 0.1, "Mesh/Lower corner": "600000, 5100000, 1000",
         "Mesh/Upper corner": "600001.2, 5100000.8, 1000.8", "Soil/Points per cell": 4, "Soil/Material": "linear elastic", "Soil/Grain density": 2000,
         "Soil/Region": "x > 600000.2 && x < 600000.5 && y > 5100000.1 && y < 5100000.3 && z > 1000.2 && z < 1000.6",
         "Soil/Initial velocity": "3; 0; 1", **MAPS}


def read_map(results, name):
    """Values of a map, rows from the south; nan where there is none."""
    return read_raster(find_map(results, name)).values[::-1]


def close_map(results, name, wanted, soil, what):
    """The map has the values where there is soil, and none elsewhere."""
    values = read_map(results, name)
    check(np.array_equal(np.isnan(values), soil <= 0), f"{what}: values elsewhere than the soil")
    close(np.nan_to_num(values), np.where(soil > 0, wanted, 0), what)


def read_profile(results):
    """Columns of the table of a plane run."""
    rows = rows_of(results / "maps" / "profile.csv")
    return {name: np.array([float(row[name]) for row in rows]) for name in rows[0]}


def close(values, wanted, what):
    difference = np.max(np.abs(np.asarray(values) - wanted))
    check(difference <= 1e-7 * max(1, np.max(np.abs(wanted))), f"{what}: differs by {difference}")


def block():
    """A block that flies with 3 m/s along x, and rises: 0.3 m in the run, to ground that it had not covered."""
    results = run("block", BLOCK)
    raster = read_raster(results / "maps" / "thickness.asc")
    head = [*raster.values.shape[::-1], raster.x, raster.y, raster.width]
    check(head == [12, 8, 600000, 5100000, 0.1], f"head: {head}")
    # The half of a rim's column that is nearer to the neighbour gives it a quarter of its soil: an eighth in all.
    along_x, along_y = np.zeros(12), np.zeros(8)
    along_x[4:9] = 0.125, 0.875, 1, 0.875, 0.125
    along_y[:4] = 0.125, 0.875, 0.875, 0.125
    at_end = 0.4 * np.outer(along_y, along_x)
    at_start = np.roll(at_end, -3, axis=1)
    either = np.maximum(at_start, at_end)
    close_map(results, "thickness_0.0s", at_start, at_start, "thickness at the start")
    close_map(results, "thickness", at_end, at_end, "thickness")
    close_map(results, "thickness_0.1s", at_end, at_end, "thickness by its time")
    close_map(results, "mass", 2000 * at_end, at_end, "mass")
    close_map(results, "deposit", at_end - at_start, either, "deposit")
    close_map(results, "largest_thickness", either, either, "largest thickness of two samples")
    is_reached = either >= 0.02
    close_map(results, "largest_speed", np.sqrt(10) * is_reached, either, "largest speed, 0 where the soil was too thin")
    close_map(results, "largest_impact_pressure", 2e4 * is_reached, either, "largest impact pressure")
    arrival = read_map(results, "arrival_time")
    close(arrival[at_start >= 0.02], 0, "arrival time at the source")
    close(arrival[is_reached & (at_start < 0.02)], 0.1, "arrival time")
    check(np.all(np.isnan(arrival[~is_reached])), "arrival where there was nothing")


def slide():
    """A block on an oblique bed: the maps hold its mass; two ranks and a resumed run have those of one that did not stop."""
    text = set_entries(read_case(pathlib.Path(os.environ["SHORT_CASES"], "bed_short_3d.prm")), {**MAPS, "Soil/Initial velocity": "1; 0.3; -0.46"})  # along the bed
    one = run("one", text)
    first = {name: read_map(one, name) for name in NAMES}
    statistics = read_table(one / "statistics.csv")
    mass = next(values for name, values in statistics.items() if name.startswith("Mass (kg)"))[-1]
    check(abs(np.nansum(first["mass"]) * 0.1**2 / mass - 1) <= 1e-7, "mass of the map and of the points")
    there = ~np.isnan(first["thickness"])
    check(np.all(first["largest_thickness"][there] >= first["thickness"][there]), "largest thickness below the last one")
    check(np.nanmax(first["arrival_time"]) > 0.05, "nothing arrives after the checkpoint")
    check(np.nanmax(first["largest_speed"]) > 0.1, "nothing moves")

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


def profile():
    """The block in the plane: a table along x. It rises and flies with 3 m/s along x."""
    plane = {**BLOCK, "Dimension": 2, "Gravity": "0, 0", "Mesh/Lower corner": "600000, 1000", "Mesh/Upper corner": "600001.2, 1000.8",
             "Soil/Region": "x > 600000.2 && x < 600000.5 && y > 1000.2 && y < 1000.6", "Soil/Initial velocity": "3; 1"}
    for ranks in (1, 2):
        results = run(f"profile_{ranks}", plane, ranks=ranks)
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
        check((results / "maps" / "profile_0.0s.csv").exists() and (results / "maps" / "profile_0.1s.csv").exists(), "profiles of their times")

    # Slowed down from 3 to 2 m/s: where it is at the start, that is its largest speed, and its largest pressure.
    table = read_profile(run("slowed", {**plane, "Body force": "-10; 0"}))
    speed = table["largest speed (m/s)"]
    close(speed[at_start >= 0.02], np.sqrt(10), "largest speed of what slows down")
    check(0 < np.min(speed[speed > 0]) < 3, "nothing is reached late")
    close(table["largest impact pressure (Pa)"] / 2000, speed**2, "largest impact pressure over density of what slows down")


def geo_tiff():
    """The block's maps as GeoTIFF have the values and places of the ASCII grids, and the coordinate system of the case.
    A run in one format removes the maps of another."""
    results = run("geo_tiff", {**BLOCK, "Coordinate system": "EPSG:2056", "Output/Maps/Format": "ASCII grid and GeoTIFF"})
    check("Coordinate system of the maps: EPSG:2056" in log_of(results), "log")
    for name in ("thickness_0.0s", "thickness", "deposit", "arrival_time"):
        grid, tiff = (read_raster(results / "maps" / (name + ending)) for ending in (".asc", ".tif"))
        check(np.array_equal(np.isnan(grid.values), np.isnan(tiff.values)), f"{name}: nan elsewhere")
        close(np.nan_to_num(tiff.values), np.nan_to_num(grid.values), f"{name}: GeoTIFF and ASCII grid")
        close(np.array(tiff.extent), np.array(grid.extent), f"{name}: place")
        check("CH1903+_LV95" in (results / "maps" / f"{name}.prj").read_text(encoding="utf-8"), f"{name}: .prj")
    # The program reads its own map, with its system: a raster of another one does not go with it.
    shutil.copy(results / "maps" / "thickness_0.0s.tif", "release.tif")
    case = {**BLOCK, "Soil/Thickness": "../release.tif", "Bed/Type": "fixed", "Bed/Level set expression": "z - 1000.2", "Output/Maps/Format": "GeoTIFF"}
    del case["Soil/Region"]
    again = run("geo_tiff", case)
    check("Coordinate system of the maps: EPSG:2056" in log_of(again), "system of the raster")
    check(not list((again / "maps").glob("*.asc")) and not list((again / "maps").glob("*.prj")), "maps of the run before are left")
    first, second = (read_map(again, "thickness_0.0s"), read_raster("release.tif").values[::-1])
    check(abs(np.nansum(first) / np.nansum(second) - 1) < 0.05, "thickness of the soil from its own map")


globals()[sys.argv[3]]()

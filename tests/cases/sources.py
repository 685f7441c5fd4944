# SPDX-License-Identifier: LGPL-2.1-or-later
"""sources.py SCREE LAUNCHER TEST: bodies by maps: what they weigh, and where they are.

Each test is a function below (case_tools.py).
"""

import json
import pathlib
import sys

import numpy as np
from osgeo import gdal, ogr
from scipy.spatial import cKDTree

from scree.results import read_points, read_raster, read_statistics

from case_tools import check, log_of, run

SPACING, CORNER, COLUMNS, ROWS = 5., (1000., 2000.), 41, 33
DENSITY = 1500.
SLIDE = {"Dimension": 3, "Gravity": "0, 0, -9.81", "End time": 1e-3, "Mesh/Lower corner": "1010, 2010, 80", "Mesh/Upper corner": "1190, 2150, 230",
         "Mesh/Cell size": 5, "Bed/Type": "fixed", "Bed/Raster": "../bed.asc", "Soil/Material": "linear elastic", "Soil/Grain density": 1500,
         "Soil/Points per cell": 3, "Soil/Linear elastic/Young's modulus": 1e6, "Output/Graphics": "none", "Output/Maps/Write": "true"}
THICKNESS = {"Soil/Thickness": "../thickness.asc"}
LEVELS = {"Soil/Region": "z > 202.5 && z < 220"}


def write_raster(name, values):
    """Values by row with ascending y; nan where there is none."""
    with open(name, "w", encoding="utf-8") as file:
        file.write(f"ncols {COLUMNS}\nnrows {ROWS}\nxllcenter {CORNER[0]}\nyllcenter {CORNER[1]}\ncellsize {SPACING}\nNODATA_value -1\n")
        for row in np.nan_to_num(values, nan=-1.)[::-1]:
            file.write(" ".join("%.6f" % value for value in row) + "\n")


def mountain():
    """Heights of a rough slope and the thickness of a slide on it, m; writes them. The thickness is missing around it."""
    x, y = np.meshgrid(SPACING * np.arange(COLUMNS), SPACING * np.arange(ROWS))
    heights = 100 + 0.5 * x + 6 * np.sin(x / 17.) * np.cos(y / 23.)
    thickness = 20 * (1 - ((x - 90) / 50.)**2 - ((y - 80) / 40.)**2)
    thickness[thickness <= 0] = np.nan
    write_raster("bed.asc", heights)
    write_raster("thickness.asc", thickness)
    write_raster("upper.asc", heights + thickness)
    return heights, thickness


def mass_of(results):
    return read_statistics(results)["Mass (kg)"][0]


def weighs(name, entries, volume):
    """The run folder of a slide with these entries, which has the mass of an exact volume, m^3, within 1 %."""
    results = run(name, {**SLIDE, **entries})
    relative = mass_of(results) / (DENSITY * volume) - 1
    print(f"{name}: mass over the exact one - 1: {relative:.2e}")
    check(abs(relative) <= 0.01, f"{name}: {relative}")
    return results


def thickness():
    """A slide as thick as a map says weighs what the map holds, and lies where it says, on one rank and two."""
    _, values = mountain()
    results = weighs("thickness", THICKNESS, SPACING**2 * np.nansum(values))
    # The maps' columns are those of the mesh, whose middles lie between the raster's.
    seeded = read_raster(results / "maps" / "thickness_0.000s.asc").values[::-1]
    full = np.nan_to_num(values)
    there = 0.25 * (full[2:30, 2:38] + full[3:31, 2:38] + full[2:30, 3:39] + full[3:31, 3:39])
    difference = np.max(np.abs(np.nan_to_num(seeded) - there))
    print(f"largest difference of the thickness: {difference:.2e} m of 20 m")
    check(seeded.shape == there.shape and difference <= 1., f"thickness: {difference}")
    two = mass_of(run("two_ranks", {**SLIDE, **THICKNESS}, ranks=2))
    check(abs(two / mass_of(results) - 1) <= 1e-12, f"mass on two ranks: {two}")


def surfaces():
    """From the bed up to a surface there is as much soil as between them; within an outline only that of its place."""
    _, values = mountain()
    # Where a height is missing, so is the soil around it: whole squares count.
    corners = [values[j:ROWS - 1 + j, i:COLUMNS - 1 + i] for j in (0, 1) for i in (0, 1)]
    weighs("above", {"Soil/Upper surface": "../upper.asc"}, SPACING**2 * np.nansum(sum(corners) / 4))

    corners = np.array([(1040, 2040), (1150, 2052), (1120, 2120), (1083, 2080), (1050, 2131)], dtype=float)
    pathlib.Path("outline.csv").write_text("x, y\n" + "".join("%g, %g\n" % tuple(c) for c in np.vstack([corners, corners[:1]])), encoding="utf-8")
    x, y = corners.T
    area = 0.5 * abs(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)))
    weighs("outline", {**LEVELS, "Soil/Outline": "../outline.csv"}, area * 17.5)


def areas():
    """Areas have the thickness of their attribute, the larger one where they overlap, or one number; with a raster the log says what is not used."""
    mountain()
    thick = ((rectangle(1040, 2040, 40, 30), 1.), (rectangle(1100, 2060, 20, 40), 4.), (rectangle(1110, 2080, 30, 40), "2.5"))
    text = {"type": "FeatureCollection", "features": [{"type": "Feature", "properties": {"THICKNESS": value}, "geometry":
                                                       {"type": "Polygon", "coordinates": [ring.tolist()]}} for ring, value in thick]}
    pathlib.Path("thick.geojson").write_text(json.dumps(text), encoding="utf-8")
    pathlib.Path("plain.csv").write_text("x, y\n1040, 2040\n1060, 2040\n1060, 2060\n1040, 2060\n", encoding="utf-8")
    size = 40 * 30 + 20 * 40 + 30 * 40 - 10 * 20  # two have 10 m x 20 m in common
    of_attribute = 40 * 30 + 4 * 20 * 40 + 2.5 * (30 * 40 - 10 * 20)
    area = {"Soil/Outline": "../thick.geojson"}
    for name, entries, exact in (("attribute", {}, of_attribute), ("number", {"Soil/Thickness": 6}, 6. * size),
                                 ("with_region", {"Soil/Region": "x < 1090"}, 40. * 30)):
        results = weighs(name, {**area, **entries}, exact)
        is_asked = "attribute thickness of 1 to 4 m, which is not used beside \"Thickness\"" in log_of(results)
        check(is_asked == (name == "number"), log_of(results))
    # A box from the raster has room for the thickest area.
    boxless = {entry: value for entry, value in {**SLIDE, **area}.items() if "corner" not in entry}
    check(abs(mass_of(run("box", boxless)) / (DENSITY * of_attribute) - 1) <= 0.01, "with a box from the raster")
    log = log_of(run("cut", {**SLIDE, **area, **THICKNESS}))
    check("Unusual value: subsection Soil, entry \"Outline\"" in log and "not used beside \"Thickness\"" in log, log)
    # A region is not above the bed: it fills its outline up to a height of the map.
    log = log_of(run("high", {**SLIDE, "Soil/Outline": "../plain.csv", "Soil/Region": "z < 215"}))
    check("m high, more than half their width" in log, log)


def rectangle(x, y, width, height):
    """Its corners, counter-clockwise, the first one at the end again."""
    return np.array([(x, y), (x + width, y), (x + width, y + height), (x, y + height), (x, y)], dtype=float)


def outlines():
    """Areas of GeoJSON, GeoPackage and shapefile, several at once, with a hole and repeated corners, each with soil between two heights."""
    mountain()
    edge, hole, other, third = rectangle(1040, 2040, 60, 50), rectangle(1057, 2053, 20, 24), rectangle(1112, 2071, 33, 41), rectangle(1130, 2090, 25, 35)
    area, corner = 60 * 50 - 20 * 24 + 33 * 41, 15 * 22  # that two of them have in common

    def polygon(*rings):
        return [ring.tolist() for ring in rings]
    features = {"multi": [{"type": "MultiPolygon", "coordinates": [polygon(edge, hole), polygon(other)]}],
                "two": [{"type": "Polygon", "coordinates": polygon(np.repeat(edge, 2, axis=0), hole)}, {"type": "Polygon", "coordinates": polygon(other)}],
                "overlap": [{"type": "Polygon", "coordinates": polygon(one)} for one in (other, third)]}
    for name, geometries in features.items():
        text = {"type": "FeatureCollection", "features": [{"type": "Feature", "properties": {}, "geometry": one} for one in geometries]}
        pathlib.Path(f"{name}.geojson").write_text(json.dumps(text), encoding="utf-8")
    gdal.UseExceptions()
    for file, made_of in (("multi.gpkg", "multi.geojson"), ("shape.shp", "two.geojson")):
        gdal.VectorTranslate(file, made_of, options=["-a_srs", "EPSG:31254"])
    gdal.OpenEx("multi.gpkg", gdal.OF_UPDATE).CreateLayer("layer_styles", geom_type=ogr.wkbNone)  # as QGIS does
    for file, exact in (("multi.gpkg", area), ("two.geojson", area), ("shape.shp", area), ("overlap.geojson", 33 * 41 + 25 * 35 - corner)):
        weighs(f"in_{file}", {**LEVELS, "Soil/Outline": f"../{file}"}, exact * 17.5)
    slide = mass_of(run("cut", {**SLIDE, **THICKNESS, "Soil/Outline": "../two.geojson"}))
    check(0.2 < slide / mass_of(run("uncut", {**SLIDE, **THICKNESS})) < 0.8, f"a map of the thickness is not cut: {slide}")


def shifted():
    """The same slide far from the map's origin, with a local origin: the same statistics, and maps where the map has them."""
    def write_all(corner):
        global CORNER
        CORNER = corner
        mountain()
        outline = np.array([(50., 40.), (150., 50.), (130., 130.), (60., 110.)]) + corner
        pathlib.Path("outline.csv").write_text("".join("%.17g, %.17g\n" % tuple(place) for place in outline), encoding="utf-8")
    case = {**SLIDE, **THICKNESS, "Soil/Outline": "../outline.csv", "End time": 0.2, "Mesh/Lower corner": "10, 10, 80", "Mesh/Upper corner": "190, 150, 230",
            "Bed/Type": "friction", "Bed/Friction angle": 25, "Output/Graphics": "points and grid"}
    far = (2.6e6, 1.2e6)
    system = 'PROJCS["CH1903+_LV95"]'
    pathlib.Path("bed.prj").unlink(missing_ok=True)  # of the run before
    write_all((0., 0.))
    near = run("near", case)
    write_all(far)
    pathlib.Path("bed.prj").write_text(system, encoding="utf-8")
    moved = run("far", {**case, "Local origin": "%.17g, %.17g" % far})
    rows = [read_statistics(results) for results in (near, moved)]
    for name, values in rows[0].items():
        difference = np.max(np.abs(values - rows[1][name])) / max(np.max(np.abs(values)), 1e-9)
        check(difference <= 1e-9, f"{name}: {difference}")
    check(rows[0]["Mass (kg)"][0] > 0 and np.max(np.abs(rows[0]["Momentum x (N s)"])) > 0, "nothing moves")
    maps = [read_raster(results / "maps" / "largest_thickness.asc") for results in (near, moved)]
    check(maps[0].x == 10 and maps[1].x == 10 + far[0] and maps[1].y == 10 + far[1], f"maps: {maps[1].x}, {maps[1].y}")
    check(np.array_equal(maps[0].values, maps[1].values, equal_nan=True), "values of the map")
    check((moved / "maps" / "largest_thickness.prj").read_text(encoding="utf-8") == system, "system of coordinates")
    check(not (near / "maps" / "largest_thickness.prj").exists(), "system of coordinates from nowhere")
    check("Local origin: x = 0, y = 0 is 2600000, 1200000 m" in log_of(moved), "log")
    # Without it, places in pictures are exact, too.
    corners = {f"Mesh/{name}": "%.9g, %.9g, %.9g" % tuple(np.add(place, (*far, 0))) for name, place in (("Lower corner", (10, 10, 80)), ("Upper corner", (190, 150, 230)))}
    national = run("national", {**case, **corners})
    for collection, time in (("points", None), ("points", 0.), ("grid", None)):
        here, there = (read_points(results, time, collection).positions for results in (near, national))
        # Where the outline goes along lines of the sampling, rounding decides on some points.
        largest = np.quantile(cKDTree(here).query(there - [*far, 0.])[0], 0.99)
        print(f"{collection}: places differ by {largest:.1e} m")
        check(largest <= 1e-3, f"{collection}: places differ by {largest} m")


SECTION = {"Drawing": "../section.geojson", "Bodies": "Clay, Sand", "End time": 1e-9, "Mesh/Upper corner": "12, 6", "Mesh/Cell size": 0.5, "Output/Graphics": "points"}
BODY = {"Points per cell": 3, "Material": "linear elastic", "Grain density": 2500, "Initial porosity": 0.4, "Linear elastic/Young's modulus": 1e6}
DRAWN = {"clay": [(0, 0), (12, 0), (12, 3), (7.3, 2.2), (0, 1)], "sand": [(0, 1), (7.3, 2.2), (12, 3), (12, 5), (9, 5), (4, 3), (0, 3)],
         "hole": [(9.03, 0.61), (10.97, 0.61), (10.97, 1.71), (9.03, 1.307)], "water table": [(12, 4.1), (5.3, 2.1), (0, 1.7)]}
EXPRESSIONS = {"clay": "y < if(x < 7.3, 1 + 1.2/7.3*x, 2.2 + 0.8/4.7*(x - 7.3)) && (x > 9.03 && x < 10.97 && y > 0.61 && y < 1.307 + 0.403/1.94*(x - 9.03)) == 0",
               "sand": "y >= if(x < 7.3, 1 + 1.2/7.3*x, 2.2 + 0.8/4.7*(x - 7.3)) && y < if(x < 4, 3, if(x < 9, 3 + 0.4*(x - 4), 5))",
               "water table": "if(x < 5.3, 1.7 + 0.4/5.3*x, 2.1 + 2/6.7*(x - 5.3))"}


def draw(file, driver):
    """The section in a format of GDAL. The hole is a ring of the polygon, in DXF a line within a line, and one line is drawn twice."""
    is_dxf = driver == "DXF"
    data = ogr.GetDriverByName(driver).CreateDataSource(file)

    def add(name, geometry):
        feature = ogr.Feature(layer.GetLayerDefn())
        feature.SetField("Layer" if is_dxf else "name", name)
        feature.SetGeometry(geometry)
        layer.CreateFeature(feature)

    def line(corners, kind):
        result = ogr.Geometry(kind)
        for corner in corners:
            result.AddPoint_2D(*corner)
        return result
    layer = data.CreateLayer("section", geom_type=ogr.wkbUnknown)
    if not is_dxf:
        layer.CreateField(ogr.FieldDefn("name", ogr.OFTString))
    for name, corners in DRAWN.items():
        if name == "water table":
            add(name, line(corners, ogr.wkbLineString))
        elif is_dxf:
            for _ in range(1 + (name == "sand")):
                add(name.replace("hole", "clay"), line(corners + corners[:1], ogr.wkbLineString))
        elif name != "hole":
            polygon = ogr.Geometry(ogr.wkbPolygon)
            for ring in [corners] + [DRAWN["hole"]] * (name == "clay"):
                polygon.AddGeometry(line(ring + ring[:1], ogr.wkbLinearRing))
            add(name, polygon)


def section():
    """Layers and water table of a drawing in all formats: the points are those of expressions."""
    gdal.UseExceptions()
    bodies = {f"{name}/{entry}": value for name in ("Clay", "Sand") for entry, value in BODY.items()}
    by_layers = {**SECTION, **bodies, "Clay/Layer": "clay", "Sand/Layer": "sand", "Water/Phreatic layer": "water table", "Water/Air entry pressure": 3e3}
    by_text = {key: value for key, value in by_layers.items() if key != "Drawing" and not key.endswith("ayer")}
    by_text |= {"Clay/Region": EXPRESSIONS["clay"], "Sand/Region": EXPRESSIONS["sand"], "Water/Phreatic surface": EXPRESSIONS["water table"]}
    for level in (None, "4.6"):
        more = {} if level is None else {"Water/Reservoir level": f"if(x < 6, {level}, 0)"}
        exact = run(f"expressions_{level}", {**by_text, **more})
        for file, driver in (("section.geojson", "GeoJSON"), ("section.gpkg", "GPKG"), ("section.dxf", "DXF"), ("section.csv", "CSV")):
            pathlib.Path(file).unlink(missing_ok=True)
            if driver == "CSV":
                rows = [(name, *corner) for name, line in DRAWN.items() if name != "hole" for corner in line]
                rows += [("clay", *DRAWN["clay"][0])] + [("clay", *corner) for corner in DRAWN["hole"]]
                pathlib.Path(file).write_text("name,x,y\n" + "".join("%s,%.17g,%.17g\n" % row for row in rows), encoding="utf-8")
            else:
                draw(file, driver)
            drawn = run(f"by_{driver}_{level}", {**by_layers, **more, "Drawing": f"../{file}"})
            for collection in ("points", "water"):
                one, other = (read_points(results, 0., collection) for results in (exact, drawn))
                check(len(one.positions) == len(other.positions) > 1000, f"{file}, {collection}: {len(one.positions)} and {len(other.positions)} points")
                for name, here, there in (("places", one.positions, other.positions), ("volumes", one.arrays["volume"], other.arrays["volume"]),
                                          ("pressure", one.arrays.get("pressure", 0.), other.arrays.get("pressure", 0.))):
                    difference = np.max(np.abs(here - there)) / max(np.max(np.abs(here)), 1e-9)
                    check(difference <= 1e-9, f"{file}, {collection}: {name} differ by {difference}")


globals()[sys.argv[3]]()

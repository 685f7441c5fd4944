# SPDX-License-Identifier: LGPL-2.1-or-later
"""probes.py SCREE LAUNCHER TEST: what probes of every kind write, of a dry column that collapses on a rough floor and variants, on one rank and two,
and after a resume; drawn by scree.pictures.tables.

Each test is a function below (case_tools.py).
"""

import pathlib
import sys

import numpy as np
from vtkmodules.vtkIOXML import vtkXMLPUnstructuredGridReader

from scree.pictures.tables import render_probe
from scree.results import read_points, read_statistics, read_table, read_times

from case_tools import check, run

DRY = {"End time": 0.12, "Mesh/Upper corner": "1.6, 0.8", "Mesh/Cell size": 0.1, "Boundaries/Bottom": "friction 30",
       "Soil/Region": "x < 0.5 && y < 0.5", "Soil/Points per cell": 4, "Soil/Initial state/Type": "K0", "Soil/Initial state/K0": 0.683,
       "Output/Interval": 0.06, "Output/Statistics interval": 0.01, "Output/Checkpoint interval": 0.055, "Output/Screen": "nothing",
       "Output/Graphics": "points", "Probes/Places": "toe: 0.45, 0.03; far: 1.5, 0.7", "Probes/Lines": "base: 0, 0.02 to 1.6, 0.02; mid: 0.2, 0 to 0.2, 0.8",
       "Probes/Verticals": "crest: 0.1", "Probes/Front thickness": 0.05, "Probes/Wall forces": "true"}
WATER = {"Water/Region": "x < 0.7 && y < 0.4", "Water/Hydraulic conductivity": 5e-3, "Water/Pressure/Relative tolerance": 1e-12}
FILES = [f"probe_{name}.csv" for name in ("toe", "far", "base", "mid", "crest", "front")]


def data_in_vtk(picture):
    """The fields of a picture for ParaView as VTK reads them: {name with unit: array}."""
    reader = vtkXMLPUnstructuredGridReader()
    reader.SetFileName(str(picture))
    reader.Update()
    data = reader.GetOutput().GetPointData()
    return {data.GetArrayName(i): data.GetArray(i) for i in range(data.GetNumberOfArrays())}


def fields():
    """The fields of pictures: of dry soil, of soil with water, whose points are its own or those of the soil, and of water alone."""
    case = {"End time": 1e-3, "Mesh/Cell size": 0.25, "Soil/Region": "x < 0.5", "Soil/Material": "linear elastic",
            "Soil/Initial porosity": 0.4, "Output/Interval": 1e-3, "Output/Graphics": "points and grid"}
    scalars = ["mean_effective_stress [Pa]", "deviatoric_stress [Pa]", "stress_ratio", "mass [kg]", "volume [m^3]", "body"]
    dry = {"points": ["velocity [m/s]", "stress [Pa]", "displacement [m]", *scalars, "id"],
           "grid": ["velocity [m/s]", "density [kg/m^3]", "mean_effective_stress [Pa]"]}
    water = {"water": ["velocity [m/s]", "seepage_velocity [m/s]", "pressure [Pa]", "mass [kg]", "volume [m^3]", "porosity", "inside_soil"],
             "grid": ["velocity [m/s]", "water_velocity [m/s]", *dry["grid"][1:], "pressure [Pa]", "porosity", "saturation"]}
    wet = {**water, "points": [*dry["points"][:2], "seepage_velocity [m/s]", "displacement [m]", *scalars, "porosity", "pore_pressure [Pa]", "id"]}
    for name, entries, wanted in (("dry", {}, dry), ("double", {"Water/Region": "x < 0.7"}, wet),
                                  ("single", {"Water/Point sets": "single"}, wet), ("pure", {"Bodies": "none", "Water/Region": "x < 0.7"}, water)):
        entries = {key: value for key, value in {**case, **entries}.items() if name != "pure" or not key.startswith("Soil")}
        pictures = (run(f"fields_{name}", entries, ranks=2) / "solution").glob("*_00000.pvtu")
        found = {picture.name.split("_")[0]: list(data_in_vtk(picture)) for picture in pictures}
        check(found == wanted, f"{name}: {found}")


def fields_in_vtk(results):
    """VTK reads the files for ParaView with units in the names of fields, and names of components; the package strips the units."""
    wanted = {"velocity [m/s]": "X Y Z", "stress [Pa]": "XX XY XZ YX YY YZ ZX ZY ZZ", "displacement [m]": "X Y Z", "mass [kg]": "", "stress_ratio": "",
              "plastic_shear_strain": "", "image_pressure [Pa]": ""}
    found = data_in_vtk(results / "solution" / "points_00001.pvtu")
    check(set(wanted) <= set(found), f"fields {list(found)}")
    for label, components in wanted.items():
        n = found[label].GetNumberOfComponents()
        names = " ".join(found[label].GetComponentName(i) or "" for i in range(n)) if n > 1 else ""
        check(names == components, f"{label}: components {names}")
    arrays = read_points(results).arrays
    check(arrays.units["stress"] == "Pa", "unit of a field")


def compare(first, second, tolerance):
    """All tables of two run folders agree, to `tolerance` times the largest number of a column; nan stands in the same places."""
    for name in FILES:
        one, other = (read_table(folder / name) for folder in (first, second))
        check(list(one) == list(other), f"{name}: other columns")
        for column in one:
            a, b = one[column], other[column]
            check(a.shape == b.shape, f"{name}, {column}: {a.shape} and {b.shape}")
            check(np.array_equal(np.isnan(a), np.isnan(b)), f"{name}, {column}: nan elsewhere")
            scale = np.nanmax(np.abs(a), initial=1e-3)
            difference = np.nanmax(np.abs(a - b), initial=0) / scale
            check(difference <= tolerance, f"{name}, {column}: differs by {difference}")


def dry():
    """Walls give the momentum that gravity does not; points keep their numbers; places are nan where nothing is; the
    same on two ranks, and after a resume."""
    one = run("one", DRY)
    balance_of_momentum(one)
    toe, far = read_table(one / "probe_toe.csv"), read_table(one / "probe_far.csv")
    check(np.all(toe["Mean effective stress (Pa)"] > 0) and toe["Velocity x (m/s)"][-1] > 0.005, "the toe bears and slides")
    check(np.all(np.isnan(far["Velocity x (m/s)"])), "nothing is far off")
    crest, front = read_table(one / "probe_crest.csv"), read_table(one / "probe_front.csv")
    check(abs(crest["Surface height (m)"][0] - 0.5) < 1e-9 and crest["Surface height (m)"][-1] < 0.5, "the crest sinks")
    check(abs(crest["Thickness (m)"][0] - 0.5) < 1e-9, "thickness at the start")
    check(np.all(front["Rear (m)"] == 0) and front["Front (m)"][-1] > front["Front (m)"][0], "the front advances")
    base = read_table(one / "probe_base.csv")
    check(len(base["x (m)"]) == 3 * 33 and len(set(base["Time (s)"])) == 3, "33 places, of half a cell, in three pictures")
    check(np.allclose(base["x (m)"], np.tile(np.linspace(0, 1.6, 33), 3), atol=1e-9), "places from end to end of the line")
    check(np.allclose(base["Distance (m)"], base["x (m)"], atol=1e-9) and np.all(base["y (m)"] == 0.02), "distances from the first end")

    fields_in_vtk(one)
    for name in ("toe", "base"):
        render_probe(one, name, f"{name}.png")
        check(pathlib.Path(f"{name}.png").stat().st_size > 10000, f"a picture of {name}")
    stale = pathlib.Path("two", "results", "probe_stale.csv")
    stale.parent.mkdir(parents=True, exist_ok=True)
    stale.write_text("of an earlier run", encoding="utf-8")
    two = run("two", DRY, ranks=2)
    check(not stale.exists(), "a fresh run removes the probes of an earlier one")
    compare(one, two, 1e-6)
    for folder in (one, two):
        displacements(folder)
    files = [*FILES, "statistics.csv"]
    before = {name: (one / name).read_bytes() for name in files}
    run("one", DRY, "--resume")
    check(all((one / name).read_bytes() == before[name] for name in files), "a resumed run ends with the same files")
    displacements(one)


def balance_of_momentum(results, axes="xy"):
    """Change of momentum = weight minus force on the walls, row by row. Nothing else acts in a dry run."""
    rows = walls = read_statistics(results)
    time, weight = rows["Time (s)"], 9.81 * rows["Mass (kg)"][0]
    for axis, pull in zip(axes, [0.] * (len(axes) - 1) + [-weight]):
        force = sum(rows[column] for column in rows if column.endswith(f" soil {axis} (N)"))
        change = np.diff(rows[f"Momentum {axis} (N s)"]) / np.diff(time)
        check(force[0] == 0, "no force before time has passed")
        worst = np.max(np.abs(change - pull + force[1:])) / weight
        check(worst < 1e-9, f"momentum along {axis}: {worst} of the weight is missing")
    if axes != "xy":
        return
    check(np.all(walls["Bottom soil y (N)"][1:] < 0) and np.all(walls["Left soil x (N)"][1:] < 0), "walls are pushed outwards")
    friction = walls["Bottom soil x (N)"][1:]
    check(np.all(friction >= 0) and np.all(friction < 0.6 * -walls["Bottom soil y (N)"][1:]), "Coulomb's bound")


def edges():
    """The balance in 3D, with walls of all kinds that meet at edges and corners; a linear velocity at the start is that of each place with soil, also on
    walls and in corners, and a wedge has the thickness, height and front of its slope."""
    results = run("edges", {
        "Dimension": 3, "End time": 0.02, "Gravity": "0, 0, -9.81", "Mesh/Lower corner": "0, 0, 0", "Mesh/Upper corner": "0.6, 0.4, 0.6",
        "Boundaries/Left": "friction 20", "Boundaries/Front": "fixed", "Boundaries/Bottom": "friction 30",
        "Soil/Region": "x < 0.3 && z < 0.4", "Soil/Points per cell": 2, "Soil/Initial velocity": "-0.2; 0.1; 0",
        "Soil/Initial state/Type": "K0", "Soil/Initial state/K0": 0.683, "Output/Interval": 0.005, "Output/Graphics": "none",
        "Probes/Places": "toe: 0.1, 0.1, 0.1", "Probes/Verticals": "crest: 0.1, 0.2", "Probes/Front thickness": 0.1, "Probes/Wall forces": "true"})
    balance_of_momentum(results, "xyz")
    crest = read_table(results / "probe_crest.csv")
    check(abs(crest["Surface height (m)"][0] - 0.4) < 1e-9 and abs(crest["Thickness (m)"][0] - 0.4) < 1e-9, "height in 3D")
    check(abs(read_table(results / "probe_toe.csv")["Velocity x (m/s)"][0] + 0.2) < 1e-9, "velocity at the start")
    results = run("linear", {
        "Dimension": 3, "End time": 1e-6, "Gravity": "0, 0, -9.81", "Mesh/Lower corner": "-0.3, 0, 0", "Mesh/Upper corner": "0.9, 0.4, 0.8", "Mesh/Cell size": 0.1,
        "Soil/Region": "x < 0.7 && z < 0.3 + 0.25*(0.9 - x)", "Soil/Points per cell": 3, "Soil/Initial velocity": "1 + x + 2*y + 3*z; 2*x - z; y", "Output/Graphics": "none",
        "Probes/Places": "inside: 0.123, 0.11, 0.25; wall: 0.2, 0, 0; corner: -0.3, 0.4, 0; beside: 0.85, 0.1, 0.1; above: 0.1, 0.1, 0.75",
        "Probes/Verticals": "mid: 0.3, 0.37; left: -0.3, 0", "Probes/Front thickness": 0.4})
    for name, (x, y, z) in (("inside", (0.123, 0.11, 0.25)), ("wall", (0.2, 0, 0)), ("corner", (-0.3, 0.4, 0)), ("beside", (np.nan, 0, 0)), ("above", (np.nan, 0, 0))):
        found = [read_table(results / f"probe_{name}.csv")[f"Velocity {axis} (m/s)"][0] for axis in "xyz"]
        wanted = [1 + x + 2 * y + 3 * z, 2 * x - z, y] if name in ("inside", "wall", "corner") else 3 * [np.nan]
        check(np.allclose(found, wanted, atol=1e-9, equal_nan=True), f"{name}: {found}, not {wanted}")
    for name, x in (("mid", 0.3), ("left", -0.3)):
        table, wanted = read_table(results / f"probe_{name}.csv"), 0.3 + 0.25 * (0.9 - x)
        check(abs(table["Thickness (m)"][0] / wanted - 1) < 0.02 and abs(table["Surface height (m)"][0] - wanted) < 0.02, f"{name}: {table} for {wanted}")
    front = read_table(results / "probe_front.csv")
    check(abs(front["Front (m)"][0] - 0.5) < 0.02 and front["Rear (m)"][0] == -0.3, f"front of a thickness of 0.4 m: {front}")


def displacements(results):
    """Of each number in each picture, the place now minus the place at the start."""
    first = read_points(results, 0.)
    start = {number: place for number, place in zip(first.arrays["id"], first.positions)}
    check(len(start) == len(first.positions), "each point has its own number")
    for time in read_times(results):
        points = read_points(results, time)
        moved = points.positions - np.array([start[number] for number in points.arrays["id"]])
        worst = np.max(np.abs(moved - points.arrays["displacement"]))
        check(worst < 1e-6, f"displacement at {time} s: wrong by {worst} m")  # pictures have single precision
    check(np.max(np.abs(moved)) > 0.005, "something moves")


def water():
    """Both phases on one rank and two, with friction of the floor; water at rest: p, level, and forces on the walls."""
    short = {**DRY, "End time": 0.06, **WATER}
    one, two = run("one", short), run("two", short, ranks=2)
    compare(one, two, 1e-5)
    walls = read_statistics(one)
    friction = walls["Bottom soil x (N)"][1:] / -walls["Bottom soil y (N)"][1:]
    check(np.all(friction > 0.1) and np.all(friction < 0.6), f"friction of wet soil on the floor over its pressure: {friction}")

    still = run("still", {
        "End time": 0.02, "Bodies": "none", "Mesh/Upper corner": "0.4, 0.8", "Time step/Maximum time step": 2e-3, "Transfer/Method": "TPIC",
        "Water/Region": "y < 0.5", "Output/Interval": 0.01, "Probes/Places": "gauge: 0.13, 0.2", "Probes/Verticals": "crest: 0.1",
        "Probes/Lines": "base: 0, 0 to 0, 0.4; mid: 0.2, 0.1 to 0.2, 0.7", "Probes/Front thickness": 0.05, "Probes/Wall forces": "true"})
    weight = 1000 * 9.81
    gauge, base, walls = read_table(still / "probe_gauge.csv"), read_table(still / "probe_base.csv"), read_statistics(still)
    check(np.allclose(gauge["Pore pressure (Pa)"], 0.3 * weight, rtol=1e-4), "p in still water")  # 5e-5: points are no exact rule for the mass
    check(np.allclose(base["Pore pressure (Pa)"], (0.5 - base["y (m)"]) * weight, atol=5e-5 * weight), "p along the wall")
    crest = read_table(still / "probe_crest.csv")["Water level (m)"]
    check(np.allclose(crest, 0.5, atol=1e-6), f"water level {crest}")
    mid = read_table(still / "probe_mid.csv")
    check(np.array_equal(np.isnan(mid["Pore pressure (Pa)"]), mid["y (m)"] > 0.54), "nan above the water")
    for wall, sign, wanted in (("Left", -1, 0.125), ("Right", 1, 0.125), ("Bottom", -1, 0.2)):
        axis = "y" if wall == "Bottom" else "x"
        total = walls[f"{wall} pressure {axis} (N)"] + np.nan_to_num(walls[f"{wall} water {axis} (N)"])
        check(np.allclose(total, sign * wanted * weight, rtol=1e-3), f"{wall}: {total / weight}, not {sign * wanted}")


globals()[sys.argv[3]]()

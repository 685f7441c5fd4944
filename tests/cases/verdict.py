# SPDX-License-Identifier: LGPL-2.1-or-later
"""verdict.py SCREE LAUNCHER TEST: what a run says of its own motion, run-out, stress and volume.

Each test is a function below (case_tools.py).
"""

import re
import subprocess
import sys

import numpy as np

from scree import report
from scree.results import read_checks, read_log, read_table

from case_tools import SCREE, check, run

RUN = {"Output/Graphics": "none", "Soil/Material": "linear elastic", "Soil/Grain density": 1500}
# A slab on a plane of 30 degrees that falls along -y; it is 0.16 m thick normal to the plane, .8 of a cell.
SLAB = {**RUN, "Dimension": 3, "Gravity": "0, 0, -9.81", "End time": 0.5, "Mesh/Lower corner": "0, 0, 0", "Mesh/Upper corner": "2, 6, 4",
        "Mesh/Cell size": 0.2, "Output/Statistics interval": 0.1, "Output/Maps/Write": "true", "Boundaries/Bottom": "open",
        "Bed/Type": "free slip", "Bed/Level set expression": "(z - 0.3 - y*tan(pi/6))*cos(pi/6)", "Soil/Points per cell": 3,
        "Soil/Region": "x > 0.4 && x < 1.6 && y > 3.6 && y < 5.2 && z < 0.3 + y*tan(pi/6) + 0.16/cos(pi/6)",
        "Soil/Linear elastic/Young's modulus": 2e6}
LAYER = {**RUN, "End time": 0.02, "Mesh/Upper corner": "2, 1.2", "Output/Statistics interval": 0.01, "Soil/Region": "y < 1",
         "Soil/Points per cell": 2, "Soil/Linear elastic/Young's modulus": 1e7, "Soil/Initial state/Type": "K0"}


def log_of(results):
    """Parts of the log by their labels."""
    return read_log(results)


def layer(folder, **entries):
    return log_of(run(folder, {**LAYER, **entries}))


def found(results):
    """{name: Check} of a run."""
    return {one.name: one for one in read_checks(results)}


def beyond(results, kind):
    return sorted(one.name for one in read_checks(results) if one.is_exceeded and one.kind == kind)


def last_row(results):
    return {name: values[-1] for name, values in read_table(results / "statistics.csv").items()}


def slide():
    """A thin slab that slides along -y does not rest; its thickness and its path are known."""
    results = run("slide", SLAB)
    log, row = log_of(results), last_row(results)
    check(log.parts["Motion"].startswith("not at rest at the end, t = 0.5 s: failed soil moves at 2."), log.parts["Motion"])
    check(abs(row["Toe speed (m/s)"] / (9.81 * 0.5 * 0.5 * np.cos(np.pi / 6)) - 1) < 0.1, f"speed of the toe {row['Toe speed (m/s)']}")
    check(abs(row["Speed 99 % (m/s)"] / (9.81 * 0.5 * 0.5) - 1) < 0.1, f"speed {row['Speed 99 % (m/s)']}")
    check(abs(row["Moving thickness (cells)"] / 0.8 - 1) < 0.1, f"thickness {row['Moving thickness (cells)']}")
    check(re.search(r"resolution: thickness of the moving soil 0\.[78]\d* cells \(bound at least 3\); what to do: for thickness and stress, use cells of at most 0\.05\d+ m; the toe of dry soil is known to 5 cells, 1 m",
                   log.parts["Checks"].replace("\n", " ")), log.parts["Checks"])
    check(beyond(results, "fault") == [] and {"speed of failed soil at the end", "thickness of the moving soil"} <= set(beyond(results, "resolution")), str(found(results)))
    # The slab of 1.6 m along y has moved by s = g sin(30) t^2/2 = 0.613 m, its front by s cos(30) on the map.
    way = 9.81 * 0.5 * 0.5**2 / 2
    length, fall = 1.6 + way * np.cos(np.pi / 6), (1.6 + way * np.cos(np.pi / 6)) * np.tan(np.pi / 6)
    check(abs(row["Run-out length (m)"] - length) < 0.07, f"length {row['Run-out length (m)']} for {length}")
    for name, wanted in (("Toe", way * np.cos(np.pi / 6)), ("Largest", way)):
        check(abs(row[f"{name} displacement (m)"] / wanted - 1) < 0.02, f"{name} displacement {row[f'{name} displacement (m)']} for {wanted}")
    # The surface is known to half a cell of 0.2 m: 2.1 degrees.
    check(abs(row["Fall height (m)"] - fall) < 0.12, f"fall {row['Fall height (m)']} for {fall}")
    check(abs(row["Travel angle (degrees)"] - 30) < 2.5, f"angle {row['Travel angle (degrees)']}")
    gained = 0.16 / np.cos(np.pi / 6) * 1.2 * way * np.cos(np.pi / 6)
    check(abs(row["Deposit volume (m^3)"] / gained - 1) < 0.15, f"volume {row['Deposit volume (m^3)']} for {gained}")
    check(abs(row["Run-out H/L (-)"] - row["Fall height (m)"] / row["Run-out length (m)"]) < 1e-9, "H/L")
    check(log.parts["Run-out"].startswith("so far: H = "), log.parts["Run-out"])
    check('class="open"><b>Motion' in report.verdict(results, log) and 'open"><b>Checks' in report.verdict(results, log), "report")
    shown = subprocess.run([sys.executable, "-m", "scree", "maps", "slide/results", "--maps", "deposit"], capture_output=True, text=True, check=True).stdout
    check(re.search(r"^Run-out: so far: H = \S+ m, L = \S+ m, H/L = 0\.\d+, travel angle \S+ degrees; the toe has moved \S+ m, the soil at most \S+ m; deposit \S+ m\^2, \S+ m\^3$", shown, re.MULTILINE), shown)
    advice = subprocess.run([SCREE, "--advise", "slide/case.prm"], capture_output=True, text=True, check=True).stdout
    height = float(re.search(r"height H +(\S+) m", advice).group(1))
    check(abs(height / 0.16 - 1) < 0.1, f"--advise takes a height of {height} m for 0.16")


def rest():
    """A layer in equilibrium rests; the same in the row and on the report."""
    log = layer("rest")
    check(log.parts["Motion"].startswith("at rest at the end, t = 0.02 s: the soil moves at ") and "Run-out" not in log.parts, log.parts["Motion"])
    check('good"><b>Motion' in report.verdict("rest/results", log), "report")
    check("thickness" not in log.parts["Checks"] and not any(one.is_exceeded for one in read_checks("rest/results")), log.parts["Checks"])


def stress():
    """Passive earth pressure, with p' of 2.5 times the weight of the soil, is within bounds; the same in all directions is not."""
    passive = layer("passive", **{"Soil/Initial state/K0": 3.6})
    row = read_table("passive/results/statistics.csv")
    check(max(row["Largest effective stress (Pa)"]) > 2.2 * 1500 * 9.81 * 1.05, "p' is not passive")
    within = found("passive/results")["largest stress"]
    check(0.9 < float(within.value.split()[0]) < 1 and not within.is_exceeded and "largest stress" in passive.parts["Checks"], passive.parts["Checks"])
    layer("spike", **{"Soil/Initial state/Type": "isotropic", "Soil/Initial state/Pressure": 4e4})
    check(beyond("spike/results", "fault") == ["largest stress"] and found("spike/results")["largest stress"].remedy, str(found("spike/results")))


def single():
    """The stress of a single point is told apart, and is no fault: one of 3200 points begins with 2.6 times the weight of the soil."""
    spot = {f"Spot/{entry.removeprefix('Soil/')}": value for entry, value in LAYER.items() if entry.startswith("Soil/")}
    layer("spot", **{**spot, "Bodies": "Soil, Spot", "Soil/Points per cell": 4, "Spot/Points per cell": 4, "Spot/Initial state/Type": "isotropic",
                     "Spot/Initial state/Pressure": 4e4, "Spot/Region": "x > 1 && x < 1.02 && y > 0.5 && y < 0.52",
                     "Soil/Region": "y < 1 && (x < 1 || x > 1.02 || y < 0.5 || y > 0.52)"})
    checks = found("spot/results")
    all_points, point = (float(checks[name].value.split()[0]) for name in ("largest stress", "largest stress of a single point"))
    check(2.2 < point < 2.7 and 0.5 < all_points < 1.2 and not checks["largest stress"].is_exceeded, str(checks))
    check(checks["largest stress of a single point"].kind == "information", str(checks))


def volume():
    """A column that collapses with a constant dilation angle expands beyond sand; one without dilation does not."""
    law = "Soil/Mohr-Coulomb/"
    collapse = {"End time": 1, "Mesh/Upper corner": "4, 1.2", "Soil/Region": "x < 1 && y < 1", "Soil/Material": "Mohr-Coulomb", law + "Young's modulus": 1e7,
                law + "Friction angle": 45}
    log = layer("dilates", **collapse, **{law + "Dilation angle": 45})
    check("largest V/V_0 in contact" in beyond("dilates/results", "fault"), log.parts["Checks"])
    check("write a smaller dilation angle" in " ".join(log.text.split()), log.text)
    layer("does_not", **collapse)
    check("largest V/V_0 in contact" not in beyond("does_not/results", "fault"), str(found("does_not/results")))


def shrinkage():
    """A layer far too soft for its weight is compressed most at its base; the check says how far, and names a point there."""
    layer("soft", **{"End time": 0.4, "Soil/Linear elastic/Young's modulus": 1e4, "Soil/Initial state/Type": "none"})
    one = found("soft/results")["smallest V/V_0"]
    place = re.match(r"Soil, point \d+ at \(\S+, (\S+)\) m, t = \S+ s: it is compressed", one.place)
    check(one.is_exceeded and float(one.value) < 0.6 and place and float(place[1]) < 0.1, str(one))


def walls():
    """Soil that comes to a wall cuts off the run-out, and soil that slides down along one the slide; unless the box is longer or forces on walls are asked for."""
    column = {"End time": 0.8, "Mesh/Cell size": 0.1, "Output/Graphics": "none", "Output/Statistics interval": 0.1, "Soil/Region": "x < 0.5 && y < 1",
              "Soil/Points per cell": 2, "Soil/Material": "Mohr-Coulomb", "Soil/Grain density": 2650, "Soil/Mohr-Coulomb/Young's modulus": 1e6,
              "Soil/Mohr-Coulomb/Poisson's ratio": 0.3, "Soil/Mohr-Coulomb/Friction angle": 30}
    coming, along = "soil that has come to a wall of the box", "soil that has moved along a wall of the box"
    for name, length, forces, cut in ("short", 1, "false", [coming]), ("long", 4, "false", []), ("structure", 1, "true", []):
        results = run(name, {**column, "Mesh/Upper corner": f"{length}, 1.2", "Probes/Wall forces": forces})
        checks = found(results)
        check(beyond(results, "fault") == [] and [name for name in beyond(results, "resolution") if name == coming] == cut, str(checks))
        check((coming in checks) == (along in checks) == (forces == "false"), str(checks))
        if forces == "false":
            slid = re.match(r"Soil, point \d+ at \(0\.0\S*, \S+\) m, at the wall x = 0 m \(\"Lower corner\"\), t = \S+ s: it stood at this wall", checks[along].place)
            check(along in beyond(results, "resolution") and slid and 0.2 < float(checks[along].value.split()[0]) < 0.8 and checks[along].remedy, str(checks))
    one = found("short/results")[coming]
    check(re.match(r"0\.[4-9]\d* m", one.value) and re.match(r"Soil, point \d+ at \(0\.9\S*, \S+\) m, at the wall x = 1 m \(\"Upper corner\"\), t = ", one.place)
          and one.remedy.startswith("move the corner"), str(one))


def inflow():
    """Soil beside the face through which it has come in has not come to a wall."""
    results = run("inflow", {**RUN, "End time": 0.6, "Mesh/Upper corner": "6, 1", "Mesh/Cell size": 0.1, "Output/Statistics interval": 0.1, "Boundaries/Bottom": "friction 20",
                             "Boundaries/Right": "open", "Soil/Linear elastic/Young's modulus": 1e6, "Inflow Gate/Body": "Soil", "Inflow Gate/Face": "Left",
                             "Inflow Gate/Region": "y < 0.4", "Inflow Gate/Speed": 1})
    check(not any("wall" in name for kind in ("fault", "resolution") for name in beyond(results, kind)), str(found(results)))


def oscillation():
    """A layer whose bodies take turns in their pressure oscillates: the mean over time is beyond the bound of the stability maps, which is no fault."""
    stripes = {"Bodies": "Soft, Hard", "Mesh/Cell size": 0.2}
    for name, pressure, region in (("Soft", 1e3, "y < 1 && sin(5*pi*x) < 0"), ("Hard", 9e3, "y < 1 && sin(5*pi*x) >= 0")):
        stripes |= {f"{name}/Region": region, f"{name}/Initial state/Type": "isotropic", f"{name}/Initial state/Pressure": pressure,
                    **{f"{name}/{entry.removeprefix('Soil/')}": value for entry, value in LAYER.items() if entry.startswith("Soil/") and "Region" not in entry and "Initial" not in entry}}
    results = run("stripes", {**{entry: value for entry, value in LAYER.items() if not entry.startswith("Soil/")}, **stripes, "End time": 1e-3,
                              "Output/Statistics interval": 1e-4})
    table, one = read_table(results / "statistics.csv"), found(results)["Stress oscillation"]
    check(abs(float(one.value) / np.mean(table["Stress oscillation (-)"][1:]) - 1) < 0.01, f"{one.value} is not the mean over time")
    check(one.bound == "0.2" and "Stress oscillation" in beyond(results, "resolution"), str(one))


def voids():
    """A pond of drops that jam is higher than its volume, and the check says by how much; with as many points as in the soil it is not."""
    rain = {"Output/Graphics": "none", "End time": 4, "Mesh/Upper corner": "0.2, 0.6", "Mesh/Cell size": 0.05, "Transfer/Method": "TPIC", "Soil/Region": "y < 0.2",
            "Soil/Material": "rigid", "Soil/Points per cell": 3, "Soil/Initial porosity": 0.4, "Water/Region": "0", "Water/Hydraulic conductivity": 1e-9,
            "Water/Initial pressure": "none", "Rain/Rate": "if(t < 3, 0.07, 0)", "Output/Statistics interval": 0.5}
    for points, has_voids in ((4, True), (3, False)):
        results = run(f"rain_{points}", {**rain, "Water/Points per cell": points})
        share = last_row(results)["Void share (-)"]
        check((share > 0.1) == has_voids and ("Void share" in beyond(results, "resolution")) == has_voids, f"{points} points: {share}, {found(results)}")


def suction():
    """Where full pores end at the ground, on a face of the cells, suction is lost at once, and the check says so; below dry soil it stays."""
    ground = {"Output/Graphics": "none", "End time": 0.02, "Mesh/Upper corner": "0.5, 2.5", "Mesh/Cell size": 0.125, "Transfer/Method": "TPIC", "Soil/Region": "y < 2",
              "Soil/Points per cell": 4, "Soil/Material": "Mohr-Coulomb", "Soil/Grain density": 2650, "Soil/Initial porosity": 0.4,
              "Soil/Mohr-Coulomb/Young's modulus": 1e7, "Soil/Mohr-Coulomb/Friction angle": 30, "Soil/Initial state/Type": "K0", "Water/Phreatic surface": 0.5,
              "Water/Points per cell": 4, "Water/Hydraulic conductivity": 1e-5}
    name = "water with suction that has lost half of it at once"
    for entry, is_lost in ((29430, True), (9810, False)):
        results = run(f"entry_{entry}", {**ground, "Water/Air entry pressure": entry})
        check((name in beyond(results, "resolution")) == is_lost, str(found(results)))
    one = found("entry_29430/results")[name]
    check(0.03 < float(one.value.split()[0]) < 0.1 and re.match(r"Water at \(\S+, 1\.9\d*\) m, t = \S+ s: it has lost \S+ Pa", one.place), str(one))


# A block on a block, at 24.5 degrees with a contact friction of 25: it should hold.
BODY = {"Material": "linear elastic", "Points per cell": 2, "Grain density": 1500, "Linear elastic/Young's modulus": 1e7}
SLIP = {"End time": 0.6, "Gravity": "4.06814071046, -8.9267200673", "Mesh/Upper corner": "3, 0.8", "Mesh/Cell size": 0.05, "Output/Graphics": "none",
        "Output/Statistics interval": 0.1, "Body force": "-4.06814071046*max(0, 1 - t/0.2); 8.9267200673*max(0, 1 - t/0.2)", "Bodies": "Ground, Block",
        "Contact Base/Bodies": "Block, Ground", "Contact Base/Friction angle": 25, "Ground/Region": "y < 0.315",
        "Block/Region": "x > 0.4 && x < 1.4 && y > 0.315 && y < 0.615",
        **{f"{body}/{name}": value for body in ("Ground", "Block") for name, value in BODY.items()}}


def creep():
    """A block that slips slowly over another does not rest, whatever the checks say."""
    results = run("slip", SLIP)
    log, row = log_of(results), last_row(results)
    check(log.parts["Motion"].startswith("not at rest"), log.parts["Motion"])
    check(0.01 < row["Speed 99 % (m/s)"] < 1 and row["Mean speed (m/s)"] > 0.01, f"{row['Speed 99 % (m/s)']} m/s, {row['Mean speed (m/s)']} m/s in the mean")


globals()[sys.argv[3]]()

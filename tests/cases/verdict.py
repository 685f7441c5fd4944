# SPDX-License-Identifier: LGPL-2.1-or-later
"""verdict.py SCREE LAUNCHER TEST: what a run says of its own motion, run-out, stress and volume.

Each test is a function below (case_tools.py).
"""

import re
import subprocess
import sys

import numpy as np

from scree import report
from scree.results import read_table

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
    return report.read_log(results)


def layer(folder, **entries):
    return log_of(run(folder, {**LAYER, **entries}))


def last_row(results):
    return {name: values[-1] for name, values in read_table(results / "statistics").items()}


def slide():
    """A thin slab that slides along -y does not rest; its thickness and its path are known."""
    results = run("slide", SLAB)
    log, row = log_of(results), last_row(results)
    check(log.parts["Motion"].startswith("not at rest at the end, t = 0.5 s: 100 % of the mass"), log.parts["Motion"])
    check(abs(row["Speed 99 % (m/s)"] / (9.81 * 0.5 * 0.5) - 1) < 0.1, f"speed {row['Speed 99 % (m/s)']}")
    check(abs(row["Moving thickness (cells)"] / 0.8 - 1) < 0.1, f"thickness {row['Moving thickness (cells)']}")
    check(re.match(r"out of bounds: thickness of the moving soil 0\.[78]\d* cells \(bound at least 3: cells of at most 0\.05\d+ m\)", log.parts["Checks"].replace("\n", " ")), log.parts["Checks"])
    # The slab of 1.6 m along y has moved by s = g sin(30) t^2/2 = 0.613 m, its front by s cos(30) on the map.
    way = 9.81 * 0.5 * 0.5**2 / 2
    length, fall = 1.6 + way * np.cos(np.pi / 6), (1.6 + way * np.cos(np.pi / 6)) * np.tan(np.pi / 6)
    check(abs(row["Run-out length (m)"] - length) < 0.2, f"length {row['Run-out length (m)']} for {length}")
    check(abs(row["Fall height (m)"] - fall) < 0.2, f"fall {row['Fall height (m)']} for {fall}")
    check(abs(row["Travel angle (degrees)"] - 30) < 2, f"angle {row['Travel angle (degrees)']}")
    gained = 0.16 / np.cos(np.pi / 6) * 1.2 * way * np.cos(np.pi / 6)
    check(abs(row["Deposit volume (m^3)"] / gained - 1) < 0.15, f"volume {row['Deposit volume (m^3)']} for {gained}")
    check(abs(row["Run-out H/L (-)"] - row["Fall height (m)"] / row["Run-out length (m)"]) < 1e-9, "H/L")
    check(log.parts["Run-out"].startswith("so far: H = "), log.parts["Run-out"])
    check('class="open"><b>Motion' in report.verdict(results, log) and 'bad"><b>Checks' in report.verdict(results, log), "report")
    shown = subprocess.run([sys.executable, "-m", "scree", "maps", "slide/results", "--maps", "deposit"], capture_output=True, text=True, check=True).stdout
    check(re.search(r"^Run-out: so far: H = \S+ m, L = \S+ m, H/L = 0\.\d+, travel angle \S+ degrees; deposit \S+ m\^2, \S+ m\^3$", shown, re.MULTILINE), shown)
    advice = subprocess.run([SCREE, "--advise", "slide/case.prm"], capture_output=True, text=True, check=True).stdout
    height = float(re.search(r"height H +(\S+) m", advice).group(1))
    check(abs(height / 0.16 - 1) < 0.1, f"--advise takes a height of {height} m for 0.16")


def rest():
    """A layer in equilibrium rests; the same in the row and on the report."""
    log = layer("rest")
    check(log.parts["Motion"].startswith("at rest at the end, t = 0.02 s: 0 % of the mass") and "Run-out" not in log.parts, log.parts["Motion"])
    check('good"><b>Motion' in report.verdict("rest/results", log), "report")
    check("thickness" not in log.parts["Checks"] and "out of bounds" not in log.parts["Checks"], log.parts["Checks"])


def stress():
    """Passive earth pressure, with p' of 2.5 times the weight of the soil, is within bounds; the same in all directions is not."""
    passive = layer("passive", **{"Soil/Initial state/K0": 3.6})
    row = read_table("passive/results/statistics")
    check(max(row["Largest effective stress (Pa)"]) > 2.2 * 1500 * 9.81 * 1.05, "p' is not passive")
    check(re.search(r"largest stress 0\.9\d+ of", passive.parts["Checks"].replace("\n", " ")) and "out of bounds" not in passive.parts["Checks"],
          passive.parts["Checks"])
    spike = layer("spike", **{"Soil/Initial state/Type": "isotropic", "Soil/Initial state/Pressure": 4e4})
    check(re.match(r"out of bounds:.*largest stress 2\.\d+ of rho g H", spike.parts["Checks"].replace("\n", " ")), spike.parts["Checks"])


def volume():
    """A column that collapses with a constant dilation angle expands beyond sand; one without dilation does not."""
    law = "Soil/Mohr-Coulomb/"
    collapse = {"End time": 1, "Mesh/Upper corner": "4, 1.2", "Soil/Region": "x < 1 && y < 1", "Soil/Material": "Mohr-Coulomb", law + "Young's modulus": 1e7,
                law + "Friction angle": 45}
    tested = layer("dilates", **collapse, **{law + "Dilation angle": 45})
    check(re.search(r"largest V/V_0 in contact \S+ \(bound 1.5\)", tested.parts["Checks"].replace("\n", " ")), tested.parts["Checks"])
    check("write a smaller dilation angle" in tested.text, tested.text)
    steady = layer("does_not", **collapse)
    check(not re.search(r"in contact \S+ \(bound", steady.parts["Checks"].replace("\n", " ")), steady.parts["Checks"])


def shrinkage():
    """A layer far too soft for its weight is compressed most at its base; the check says how far, and names a point there."""
    soft = {"End time": 0.4, "Soil/Linear elastic/Young's modulus": 1e4, "Soil/Initial state/Type": "none"}
    checks = re.sub(r"\s+", " ", layer("soft", **soft).parts["Checks"])
    found = re.match(r"out of bounds: smallest V/V_0 (0\.[0-5]\d*) \(bound 0\.6\)[^:]* worst: Soil, point \d+ at \(\S+, (\S+)\) m, t = \S+ s: "
                     r"it is compressed to V/V_0 = (\S+)", checks)
    check(found and found[1] == found[3] and float(found[2]) < 0.1, checks)


def walls():
    """A column that collapses reaches the far wall, unless the box is longer or forces on walls are asked for; the wall beside it does not count."""
    column = {"End time": 0.8, "Mesh/Cell size": 0.1, "Output/Graphics": "none", "Output/Statistics interval": 0.1, "Soil/Region": "x < 0.5 && y < 1",
              "Soil/Points per cell": 2, "Soil/Material": "Mohr-Coulomb", "Soil/Grain density": 2650, "Soil/Mohr-Coulomb/Young's modulus": 1e6,
              "Soil/Mohr-Coulomb/Poisson's ratio": 0.3, "Soil/Mohr-Coulomb/Friction angle": 30}
    said = {}
    for name, length, forces in ("short", 1, "false"), ("long", 4, "false"), ("structure", 1, "true"):
        entries = {**column, "Mesh/Upper corner": f"{length}, 1.2", "Probes/Wall forces": forces}
        said[name] = re.sub(r"\s+", " ", log_of(run(name, entries)).parts["Checks"])
    check(re.search(r"soil has come (0\.[4-9]\d*) m to a wall of the box \(bound 0\).* worst: Soil, point \d+ at \(0\.9\S*, \S+\) m, "
                    r"at the wall x = 1 m \(\"Upper corner\"\), t = \S+ s: it has come \1 m", said["short"]), said["short"])
    check("soil has come 0 m to a wall of the box" in said["long"].partition("within bounds")[2], said["long"])
    check("a wall of the box" not in said["structure"], said["structure"])


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
    check(0.01 < row["Speed 99 % (m/s)"] < 1 and row["Moving part (-)"] > 0.2, f"{row['Speed 99 % (m/s)']} m/s, {row['Moving part (-)']} of the mass")


globals()[sys.argv[3]]()

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

BOX = """
set Dimension        = {dim}
set Gravity          = {gravity}
set End time         = {end}
set Output directory = results
subsection Mesh
  set Lower corner = {lower}
  set Upper corner = {corner}
  set Cell size    = {cell}
end
subsection Output
  set Graphics            = none
  set Statistics interval = {rows}
end
"""
# A slab on a plane of 30 degrees that falls along -y; it is 0.16 m thick normal to the plane, .8 of a cell.
SLAB = BOX.format(dim=3, lower="0, 0, 0", gravity="0, 0, -9.81", end=0.5, corner="2, 6, 4", cell=0.2, rows=0.1) + """
subsection Bed
  set Type                 = free slip
  set Level set expression = (z - 0.3 - y*tan(pi/6))*cos(pi/6)
end
subsection Boundaries
  set Bottom = open
end
subsection Soil
  set Region          = x > 0.4 && x < 1.6 && y > 3.6 && y < 5.2 && z < 0.3 + y*tan(pi/6) + 0.16/cos(pi/6)
  set Points per cell = 3
  set Material        = linear elastic
  set Grain density   = 1500
  subsection Linear elastic
    set Young's modulus = 2e6
  end
end
subsection Output
  subsection Maps
    set Write = true
  end
end
"""
LAYER = BOX.format(dim=2, lower="0, 0", gravity="0, -9.81", end=0.02, corner="2, 1.2", cell=0.1, rows=0.01) + """
subsection Soil
  set Region          = y < 1
  set Points per cell = 2
  set Material        = {law}
  set Grain density   = 1500
  subsection Mohr-Coulomb
    set Young's modulus = 1e7
    set Friction angle  = {friction}
    set Dilation angle  = {dilation}
    set Cohesion        = {cohesion}
  end
  subsection Linear elastic
    set Young's modulus = 1e7
  end
  subsection Initial state
    set Type = {start}
  end
  {more}
end
"""


def log_of(results):
    """Parts of the log by their labels."""
    return report.read_log(results)


def layer(folder, law="Mohr-Coulomb", friction=35, dilation=0, cohesion=0, start="K0", more="", entries=""):
    return log_of(run(folder, LAYER.format(law=law, friction=friction, dilation=dilation, cohesion=cohesion, start=start, more=more) + entries))


def last_row(results):
    return {name: values[-1] for name, values in read_table(results / "statistics").items()}


def slide():
    """A thin slab that slides along -y does not rest; its thickness and its path are known."""
    results = run("slide", SLAB)
    log, row = log_of(results), last_row(results)
    check(log.parts["Motion"].startswith("not at rest at the end, t = 0.5 s: 100 % of the mass"), log.parts["Motion"])
    check(abs(row["Speed 99 % (m/s)"] / (9.81 * 0.5 * 0.5) - 1) < 0.1, f"speed {row['Speed 99 % (m/s)']}")
    check(abs(row["Moving thickness (cells)"] / 0.8 - 1) < 0.1, f"thickness {row['Moving thickness (cells)']}")
    check(re.match(r"out of bounds: thickness of the moving soil 0\.[78]\d* cells \(bound at least 3", log.parts["Checks"].replace("\n", " ")), log.parts["Checks"])
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
    log = layer("rest", law="linear elastic")
    check(log.parts["Motion"].startswith("at rest at the end, t = 0.02 s: 0 % of the mass") and "Run-out" not in log.parts, log.parts["Motion"])
    check('good"><b>Motion' in report.verdict("rest/results", log), "report")
    check("thickness" not in log.parts["Checks"] and "out of bounds" not in log.parts["Checks"], log.parts["Checks"])


def stress():
    """Passive earth pressure, with p' of 2.5 times the weight of the soil, is within bounds; the same in all directions is not."""
    passive = layer("passive", law="linear elastic", more="subsection Initial state\n    set K0 = 3.6\n  end")
    row = read_table("passive/results/statistics")
    check(max(row["Largest effective stress (Pa)"]) > 2.2 * 1500 * 9.81 * 1.05, "p' is not passive")
    check(re.search(r"largest stress 0\.9\d+ of", passive.parts["Checks"].replace("\n", " ")) and "out of bounds" not in passive.parts["Checks"],
          passive.parts["Checks"])
    spike = layer("spike", law="linear elastic", start="isotropic", more="subsection Initial state\n    set Pressure = 4e4\n  end")
    check(re.match(r"out of bounds:.*largest stress 2\.\d+ of rho g H", spike.parts["Checks"].replace("\n", " ")), spike.parts["Checks"])


def volume():
    """A column that collapses with a constant dilation angle expands beyond sand; one without dilation does not."""
    collapse = "set End time = 1\nsubsection Mesh\n  set Upper corner = 4, 1.2\nend\nsubsection Soil\n  set Region = x < 1 && y < 1\nend\n"
    tested = layer("dilates", friction=45, dilation=45, entries=collapse)
    check(re.search(r"largest V/V_0 in contact \S+ \(bound 1.5\)", tested.parts["Checks"].replace("\n", " ")), tested.parts["Checks"])
    check("write a smaller dilation angle" in tested.text, tested.text)
    steady = layer("does_not", friction=45, entries=collapse)
    check(not re.search(r"in contact \S+ \(bound", steady.parts["Checks"].replace("\n", " ")), steady.parts["Checks"])


def shrinkage():
    """A layer far too soft for its weight is compressed most at its base; the check says how far, and names a point there."""
    soft = "set End time = 0.4\nsubsection Soil\n  subsection Linear elastic\n    set Young's modulus = 1e4\n  end\nend\n"
    checks = re.sub(r"\s+", " ", layer("soft", law="linear elastic", start="none", entries=soft).parts["Checks"])
    found = re.match(r"out of bounds: smallest V/V_0 (0\.[0-5]\d*) \(bound 0\.6\)[^:]* worst: Soil, point \d+ at \(\S+, (\S+)\) m, t = \S+ s: "
                     r"it is compressed to V/V_0 = (\S+)", checks)
    check(found and found[1] == found[3] and float(found[2]) < 0.1, checks)


# A block on a block, at 24.5 degrees with a contact friction of 25: it should hold.
SLIP = BOX.format(dim=2, lower="0, 0", gravity="4.06814071046, -8.9267200673", end=0.6, corner="3, 0.8", cell=0.05, rows=0.1) + """
set Body force = -4.06814071046*max(0, 1 - t/0.2); 8.9267200673*max(0, 1 - t/0.2)
set Bodies     = Ground, Block
subsection Contact Base
  set Bodies         = Block, Ground
  set Friction angle = 25
end
subsection Ground
  set Region          = y < 0.315
  set Material        = linear elastic
  set Points per cell = 2
  set Grain density   = 1500
  subsection Linear elastic
    set Young's modulus = 1e7
  end
end
subsection Block
  set Region          = x > 0.4 && x < 1.4 && y > 0.315 && y < 0.615
  set Material        = linear elastic
  set Points per cell = 2
  set Grain density   = 1500
  subsection Linear elastic
    set Young's modulus = 1e7
  end
end
"""


def creep():
    """A block that slips slowly over another does not rest, whatever the checks say."""
    results = run("slip", SLIP)
    log, row = log_of(results), last_row(results)
    check(log.parts["Motion"].startswith("not at rest"), log.parts["Motion"])
    check(0.01 < row["Speed 99 % (m/s)"] < 1 and row["Moving part (-)"] > 0.2, f"{row['Speed 99 % (m/s)']} m/s, {row['Moving part (-)']} of the mass")


{"slide": slide, "creep": creep, "rest": rest, "stress": stress, "volume": volume, "shrinkage": shrinkage}[sys.argv[3]]()

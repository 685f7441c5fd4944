# SPDX-License-Identifier: LGPL-2.1-or-later
"""The phases of a slope of 2:1, 10 m high on 5 m of its soil, with cells of 1 m: settling, release, slide."""

import re
import subprocess
import sys

from case_tools import HERE, check, log_of, rows_of, run
from scree.variants import read_case, set_entries

CASE = HERE.parents[1] / "prm/slopes/griffiths_lane.prm"
REGION = "y < 5 || y < 15 && y < 5 + (34 - x)/2"
DENSITY, GRAVITY, HEIGHT, FOUNDATION = 2000, 9.81, 10, 5
MODULUS = 1e7 * (1 - 0.3) / (1.3 * 0.4)  # Pa, oedometric
SETTLEMENT = DENSITY * GRAVITY * (HEIGHT + FOUNDATION - 1 / 3)**2 / (2 * MODULUS)  # m; points are half a spacing inside the soil


def slope(**entries):
    return set_entries(read_case(CASE), {"Mesh/Cell size": 1, "Mesh/Upper corner": "45, 17", "Soil/Region": REGION, "Output directory": "results",
                                         "Settling/Maximum time": 20, "End time": 3, **entries})


def fall(table, name="Potential energy (J)"):
    """From the first row to the last one, in m of the whole soil."""
    return (float(table[0][name]) - float(table[-1][name])) / (float(table[0]["Mass (kg)"]) * GRAVITY)


def weak():
    """A slope with a factor of safety of 0.75 comes to rest in another place: the checks report it, with a bound by the slope without its foundation."""
    folder = run("weak", slope(**{"Soil/Mohr-Coulomb/Friction angle": 11, "Soil/Mohr-Coulomb/Cohesion": 5250, "Soil/Initial state/K0": 0.81, "End time": 0.1}))
    text = " ".join(log_of(folder).split())
    found = re.search(r"fault: displacement while settling (\S+) m \(bound (\S+) m\); what to do: this slope does not stand: see --safety", text)
    check(found, f"the checks do not report that the slope has failed: {text[-1500:]}")
    moved, bound = map(float, found.groups())
    print(f"moved {moved:g} m, bound {bound:g} m")
    check(abs(bound / (0.02 * HEIGHT + SETTLEMENT) - 1) < 0.02, f"the bound is {bound} m")
    check(0.5 < moved < HEIGHT, f"the slope has moved by {moved} m")
    check("largest plastic shear strain of settling" in text and "Check: displacement while settling" in text, "lines are missing in the log")


def phases():
    """The strength factor acts from the release on: the slope settles with its full strength, then slides; so it does with --resume and another factor."""
    folder = run("slide", slope(**{"Safety/Strength factor": 1.8}))
    text = log_of(folder)
    check("does not stand" not in text and re.search(r"displacement while\s+settling", text), "the slope moves while it settles")
    check('Changed from here on: subsection Safety, entry "Strength factor" = 1.8, before 1.' in text, "the factor does not act at the release")
    slid = rows_of(folder / "statistics.csv")
    check(float(slid[0]["Time (s)"]) == 0 and float(slid[0]["Kinetic energy (J)"]) == 0, "the first row is not that of the release")
    stood = rows_of(run("slide", slope(**{"Safety/Strength factor": 1.2}), "--resume") / "statistics.csv")
    check(log_of(folder).count("Settled for") == 1 and 'entry "Strength factor" = 1.2' in log_of(folder), "the slope settles again")
    print(f"centre of mass falls by {fall(slid):g} m with 1.8 and by {fall(stood):g} m with 1.2")
    check(fall(slid) > 0.05 and fall(stood) < 0.2 * fall(slid), "the slide does not depend on the factor")
    later = {"Output/Checkpoint interval": 0.5, "End time": 1}
    run("late", slope(**{**later, "Safety/Strength factor": 1.8}))
    try:
        run("late", slope(**{**later, "Safety/Strength factor": 1.2}), "--resume")
    except subprocess.CalledProcessError:
        return
    check(False, "the factor changes after the release")


{"weak": weak, "phases": phases}[sys.argv[3]]()

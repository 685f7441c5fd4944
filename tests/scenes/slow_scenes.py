# SPDX-License-Identifier: LGPL-2.1-or-later
"""slow_scenes.py SCREE SCENE: scaled inertia, as scenes.py. Bounds were fixed before the first run."""

import numpy as np

from scree import closed_forms
from scree.results import read_points

from scene_tools import check, check_of, main, run

DAY = 86400.  # s


def motion_is_slow(name):
    """Whether the run itself says that its motion was slow."""
    return not check_of(name, "mean kinetic energy").is_exceeded


def similar(scree, case, name, end, entries, scaled_entries=None):
    """Inertia times 1e4 with conductivity over 100 is the same motion, 100 times slower: whatever the path, to rounding."""
    scaling = 1e4
    slower = scaling**0.5
    pictures = {"Output/Graphics": "points", **entries}
    run(scree, case, name, {**pictures, "End time": repr(end), "Output/Interval": repr(end), "Output/Statistics interval": repr(end / 10)})
    run(scree, case, name + "_scaled", {
        **pictures, **(scaled_entries or {}), "Time step/Mass scaling": repr(scaling), "End time": repr(end * slower),
        "Output/Interval": repr(end * slower), "Output/Statistics interval": repr(end * slower / 10)})
    plain, scaled = (read_points(one) for one in (name, name + "_scaled"))
    label = name + ", inertia times 1e4: "
    check(label + "largest distance to the points of the plain run, m", np.max(np.abs(plain.positions - scaled.positions)), 0, 1e-7)
    stress = np.max(np.abs(plain.arrays["stress"]))
    check(label + "largest difference of stress over the largest", np.max(np.abs(plain.arrays["stress"] - scaled.arrays["stress"])) / stress, 0, 1e-5)
    check(label + "velocities times 100 over those of the plain run",
          slower * np.linalg.norm(scaled.arrays["velocity"]) / np.linalg.norm(plain.arrays["velocity"]), 1 - 1e-5, 1 + 1e-5)


def mass_scaling(scree):
    """The scaled motion is the plain one, slower: dry, on a bed, with a load, and with water."""
    similar(scree, "columns/mohr_coulomb_collapse", "collapse", 0.3, {}, {"Transfer/PIC rate": "0.05"})
    similar(scree, "bed/settled_layer", "on_bed", 0.1, {"Settling/Maximum time": "0"})
    similar(scree, "consolidation/large_strain_consolidation", "mud", 5., {"Water/Pressure/Relative tolerance": "1e-11"}, {"Water/Hydraulic conductivity": "1e-4"})
    similar(scree, "consolidation/terzaghi", "load", 0.8829, {}, {"Water/Hydraulic conductivity": "1e-5"})


def terzaghi_days(scree):
    """A clay layer over 30 days: degree of consolidation within 1 %; and too large a scaling is told."""
    column = closed_forms.Terzaghi(2., 1e4, closed_forms.oedometric_modulus(3.6e6, 0.2), 4e-9)
    table = run(scree, "consolidation/terzaghi_days", "days", {"Output/Graphics": "points", "Output/Statistics interval": repr(DAY)})
    for day in (3, 9, 15, 30):
        soil = read_points("days", day * DAY)
        degree = -np.mean(soil.arrays["stress"][:, 4]) / column.load
        check("clay after %d days: degree of consolidation over the exact one" % day,
              degree / closed_forms.terzaghi_degree(day * DAY / column.time(1.)), 0.99, 1.01)
    check("clay: time steps", table["Step"][-1], 1, 3600)
    check("clay: momentum residual over load times time", max(table["Momentum residual (N s)"]) / (0.2 * column.load * 30 * DAY), 0, 1e-9)
    check("clay: the run calls its motion slow", motion_is_slow("days"), 1, 1)
    run(scree, "consolidation/terzaghi_days", "too_large", {"Time step/Mass scaling": "1e15", "Output/Statistics interval": repr(DAY)})
    check("clay, scaling of 1e15: the run calls its motion slow", motion_is_slow("too_large"), 0, 0)


def scaled_consolidation(scree):
    """A tenth of the time steps: degree of consolidation and settlement within 0.5 % of the runs with true inertia."""
    factors = (0.1, 0.3, 0.5, 1)
    stiff = closed_forms.Terzaghi(1., 1e6, closed_forms.oedometric_modulus(1e9, 0.2), 1e-5)
    rows = {repr(s): run(scree, "consolidation/terzaghi_slow", "slow_%g" % s, {
        "Output/Graphics": "points", "Output/Statistics interval": repr(stiff.time(0.1)), "Time step/Mass scaling": repr(s)}) for s in (1., 110.)}
    check("stiff column: time steps, scaled over plain", rows["110.0"]["Step"][-1] / rows["1.0"]["Step"][-1], 0, 0.1)
    for factor in factors:
        plain, scaled = (np.mean(read_points("slow_%g" % s, stiff.time(factor)).arrays["stress"][:, 4]) for s in (1., 110.))
        check("stiff column, T_v = %g: degree of consolidation, scaled over plain" % factor, scaled / plain, 0.995, 1.005)
    check("stiff column: the run calls its motion slow", motion_is_slow("slow_110"), 1, 1)


if __name__ == "__main__":
    main(globals())

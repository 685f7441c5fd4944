# SPDX-License-Identifier: LGPL-2.1-or-later
"""softening_scenes.py SCREE SCENE: clay with and without a strength that falls with strain, as scenes.py."""

import numpy as np

from scene_tools import check, largest_fall, main, mean_load, run


def biaxial(scree):
    """With a length of at least two cells, the load at 1 % does not depend on the cells; without one it falls with them (doc/studies/pages/soil_models.md)."""
    loads = {}
    for length in (0.2, 0):
        for cell in (0.1, 0.05):
            name = "length %g m, cells of %g m" % (length, cell)
            table = run(scree, "softening/biaxial", "biaxial", {"Mesh/Cell size": cell, "Soil/Mohr-Coulomb/Nonlocal length": length,
                                                                 "Output/Statistics interval": "0.005", "End time": "0.57"})
            loads[length, cell] = mean_load(table)
            check(name + ": largest load over 2 c, kPa", np.max(table["Obstacle Platen force y (N)"]) / 4e4, 0.97, 1.02)
            check(name + ": energy made over work of the platen",
                  largest_fall(table["Numerical dissipation (J)"]) / table["Obstacle Platen work (J)"][-1], 0, 5e-3)
            check(name + ": unresolved returns", table["Unresolved"][-1], 0, 0)
    check("load at 1 % with a length, small over large cells", loads[0.2, 0.05] / loads[0.2, 0.1], 0.98, 1.02)
    check("load at 1 % without, small over large cells", loads[0, 0.05] / loads[0, 0.1], 0, 0.9)


def vertical_cut(scree):
    """A vertical cut in clay of strength s_u whose weight grows slowly falls at gamma H = 3.776 s_u, where the bounds of limit analysis meet."""
    table = run(scree, "slopes/vertical_cut", "cut", {})
    time = table["Time (s)"]
    falls = np.min(time[(time > 2.3) & (table["Kinetic energy (J)"] > 2)], initial=np.inf)
    check("gamma H/s_u as it falls, over 3.776", 2000 * (8 + 0.5 * (falls - 2)) * 2 / 1e4 / 3.776, 0.96, 1.04)
    check("unresolved returns", table["Unresolved"][-1], 0, 0)


main(globals())

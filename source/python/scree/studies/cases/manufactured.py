# SPDX-License-Identifier: LGPL-2.1-or-later
"""The text of its section: doc/studies/intro/manufactured.md."""

import math

import numpy as np

from scree.studies import Study, WorkPrecision, transfer
from scree.studies.cases.bar import errors, relative
from scree.studies.precision import DEFAULTS, at_finest, beside_defaults, curve, methods, order, ratios, table, variants

AMPLITUDE, MODULUS, TIME = 0.1, 1e4, 0.6  # m, Pa, s
METHODS = methods("linear", "PIC rate 0", "PIC rate 5", {"TPIC": transfer("TPIC")}, "2 x 2 points", "3 x 3 points",
                  "6 x 6 points", "Courant number 0.3", "Courant number 0.9", "modified F-bar", without="Water")
DENSER = {"points as fine as cells^2": {}, "TPIC, points as fine as cells^2": METHODS["TPIC"]}


def denser_points(h):
    """As many points along a cell as keep their spacing in proportion to h^2."""
    return {"Mesh/Cell size": h, "Soil/Points per cell": round(0.5 / h)}


def body_force(x):
    """Dv/Dt + E/(rho_0 g) g' (1 + ln g) along the axis `x` ("x" or "y"), of X = x - A sin(pi x) sin(pi t) and g =
    dX/dx."""
    sine, cosine = f"(0.1*sin(pi*{x}))", f"(0.1*pi*cos(pi*{x}))"
    g, g_x, g_t = f"(1-{cosine}*sin(pi*t))", f"(pi*pi*{sine}*sin(pi*t))", f"(-pi*{cosine}*cos(pi*t))"
    n, n_x, n_t = f"(pi*{sine}*cos(pi*t))", f"(pi*{cosine}*cos(pi*t))", f"(-pi*pi*{sine}*sin(pi*t))"
    return f"{n_t}/{g}-{n}*{g_t}/{g}^2+{n}/{g}*({n_x}/{g}-{n}*{g_x}/{g}^2)+10/{g}*{g_x}*(1+ln({g}))"


def measure(run):
    points, step = run.points(), run.statistics("Time step (s)")[-1]
    x, y = points.positions[:, 0], points.positions[:, 1]
    computed = points.arrays["velocity"][:, 0]

    def stretch(z, time):
        return 1 / (1 - AMPLITUDE * math.pi * np.cos(math.pi * z) * math.sin(math.pi * time))

    def exact(z, time):
        return AMPLITUDE * math.pi * np.sin(math.pi * z) * math.cos(math.pi * time) * stretch(z, time)

    velocity = relative(computed, exact(x - computed * step / 2, TIME - step / 2))
    stress = MODULUS * np.log(stretch(x, TIME)) / (stretch(x, TIME) * stretch(y, TIME))
    return errors(run, velocity, relative(points.arrays["stress"][:, 0], stress))


def verdict(rows, claim):
    error, finest = ratios(rows), {name: at_finest(rows, name) for name in METHODS}
    *_, middle, fine = (row["error"] for row in curve(rows).values())
    few = [row["error"] for row in curve(rows, "2 x 2 points").values()]
    denser = order(rows, "points as fine as cells^2")
    claim = claim.shared(**beside_defaults(rows), fine=fine)
    return [
        claim("convergence", fine > 0.7 * middle and denser > 1, quick=False, middle=middle, order=denser),
        claim("basis", error["linear"] > 5),
        claim("points", error["3 x 3 points"] > 1.2 and few[-1] > few[0] and error["6 x 6 points"] > 0.7, quick=False,
              few_coarse=few[0], few_fine=few[-1]),
        claim("transfer", finest["TPIC"] < 0.9 * fine, quick=False,
              ratios={name: finest[name] / fine for name in ("TPIC", "PIC rate 0", "PIC rate 5")}),
        claim("step", finest["Courant number 0.9"] > 3 * fine, quick=False),
        claim("F-bar", 1.1 < error["modified F-bar"] < 2)]


STUDY = Study(
    "prm/dynamics/vibrating_bar.prm",
    entries={"End time": TIME, "Output/Interval": TIME, "Output/Statistics interval": 0, "Output/Graphics": "points",
             "Mesh/Upper corner": "1, 1", "Body force": f"{body_force('x')}; {body_force('y')}",
             "Soil/Initial velocity": "0.1*pi*sin(pi*x); 0.1*pi*sin(pi*y)", "Boundaries/Left": "free slip",
             "Boundaries/Right": "free slip", "Transfer/PIC rate": "auto", "Time step/Maximum time step": 1},
    variants=variants(METHODS, "Mesh/Cell size", [1 / 8, 1 / 16, 1 / 32, 1 / 64])
    + variants(DENSER, denser_points, [1 / 8, 1 / 16, 1 / 32]), default={"method": DEFAULTS},
    quick=lambda labels: labels["h"] > 0.05
    and labels["method"] in (DEFAULTS, "linear", "2 x 2 points", "modified F-bar"),
    table=lambda rows: [line[:3] for line in table(rows)],
    chart=WorkPrecision({DEFAULTS: "defaults", "TPIC, points as fine as cells^2": "TPIC, spacing h²\n(best)",
                         "TPIC": "TPIC", "2 x 2 points": "2 x 2 points", "linear": "linear (worst)"},
                        "error of velocity and stress against\nthe exact solution (-)", "cells", ""))

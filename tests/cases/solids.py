# SPDX-License-Identifier: LGPL-2.1-or-later
"""solids.py SCREE LAUNCHER TEST: bed, obstacle and bodies of triangles (STL) against the same by expressions and closed forms.

Each test is a function below (case_tools.py).
"""

import math
import struct
import sys

import numpy as np

from scree.results import read_statistics

from case_tools import HERE, check, run

FACES = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]  # of a box, outwards


def box(corners):
    """Triangles of a box with 8 corners, x first."""
    corners = np.asarray(corners, dtype=float)
    return [corners[[face[0], face[1 + i], face[2 + i]]] for face in FACES for i in (0, 1)]


def write_text(name, triangles):
    with open(name, "w", encoding="utf-8") as file:
        file.write("solid\n")
        for triangle in triangles:
            file.write("facet normal 0 0 0\nouter loop\n" + "".join("vertex %.17g %.17g %.17g\n" % tuple(corner) for corner in triangle) + "endloop\nendfacet\n")
        file.write("endsolid\n")


def write_binary(name, triangles):
    with open(name, "wb") as file:
        file.write(bytes(80) + struct.pack("<I", len(triangles)))
        for triangle in triangles:
            file.write(struct.pack("<12fH", 0, 0, 0, *np.ravel(triangle), 0))


def compare(one, other, bound):
    """The last rows of statistics, column by column; what is less than 1 (N, J, ...) as if it were 1."""
    first, second = (read_statistics(results) for results in (one, other))
    worst = 0.
    for name in first:
        a, b = first[name][-1], second[name][-1]
        difference = abs(a - b) / max(abs(a), abs(b), 1.)
        worst = max(worst, difference)
        check(difference <= bound, f"{name}: {a} and {b}")
    print(f"largest difference of a column: {worst:.1e}")


def plane():
    """A block that slides down a bed of triangles, binary or text, and meets a wall of triangles: as by expressions."""
    text = (HERE / "bed_short_3d.prm").read_text(encoding="utf-8")
    expression = "  set Level set expression = (0.4*x + 0.2*y + z - 0.97)/sqrt(1.2)\n"
    check(expression in text, "bed_short_3d.prm has another bed")
    text += "subsection Obstacle Wall\n  set Type = free slip\n%s  set Moment about = 1, 0, 0\nend\n"
    low, high = -6., 10.
    tops = [(x, y, 0.97 - 0.4 * x - 0.2 * y) for y in (low, high) for x in (low, high)]
    write_text("plane.stl", box([(x, y, -16.) for x, y, _ in tops] + tops))
    # Numbers that four bytes hold.
    write_binary("wall.stl", box([(x, y, z) for z in (low, high) for y in (low, high) for x in (0.90625, high)]))
    solids = text.replace(expression, "  set Closed surface = ../plane.stl\n") % "  set Closed surface = ../wall.stl\n"
    by_expressions = run("expressions", text % "  set Level set expression = 0.90625 - x\n")
    by_solids = run("solids", solids)
    compare(by_expressions, by_solids, 1e-9)
    statistics = read_statistics(by_solids)
    check(statistics["Obstacle Wall impulse x (N s)"][-1] > 0, "nothing hits the wall")
    compare(by_solids, run("two_ranks", solids, ranks=2), 1e-9)


BODY = """
set Dimension        = 3
set Gravity          = 0, 0, -9.81
set End time         = 1e-4
set Output directory = results
subsection Mesh
  set Lower corner = -1, -1, -1
  set Upper corner = 1, 1, 1
  set Cell size    = 0.125
end
subsection Soil
  set Closed surface  = ../body.stl
  set Material        = linear elastic
  set Points per cell = 2
  set Grain density   = 1500
  subsection Linear elastic
    set Young's modulus = 1e6
  end
end
subsection Output
  set Graphics = none
end
"""


def turned(corners):
    """Turned about two axes."""
    a, b = 0.5, 0.3
    about_z = np.array([[math.cos(a), -math.sin(a), 0], [math.sin(a), math.cos(a), 0], [0, 0, 1]])
    about_x = np.array([[1, 0, 0], [0, math.cos(b), -math.sin(b)], [0, math.sin(b), math.cos(b)]])
    return np.asarray(corners) @ (about_x @ about_z).T


def sphere(radius, n_divisions):
    """Triangles of an octahedron, divided and moved onto a sphere."""
    triangles = []
    for x in (-1., 1.):
        for y in (-1., 1.):
            for z in (-1., 1.):
                corners = [np.array([x, 0, 0]), np.array([0, y, 0]), np.array([0, 0, z])]
                triangles.append(corners if x * y * z > 0 else corners[::-1])
    for _ in range(n_divisions):
        finer = []
        for a, b, c in triangles:
            ab, bc, ca = ((p + q) / np.linalg.norm(p + q) for p, q in ((a, b), (b, c), (c, a)))
            finer += [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
        triangles = finer
    return [radius * np.array(triangle) for triangle in triangles]


def body():
    """Bodies of triangles, alone, with a Region and on a bed, weigh what their volume says; one of them on two ranks, too."""
    brick = box(turned([(x, y, z) for z in (-0.3, 0.2) for y in (-0.4, 0.5) for x in (-0.6, 0.55)]))
    ball = sphere(0.7, 4)
    volume_of = lambda triangles: sum(np.linalg.det(np.array(triangle)) for triangle in triangles) / 6
    upper = "  set Closed surface  = ../body.stl\n  set Region = z > 0\n"
    bed = "subsection Bed\n  set Type = fixed\n  set Level set expression = (z + 0.4*x)/sqrt(1.16)\nend\n"
    for name, triangles, part, text in (("brick", brick, 1., BODY), ("ball", ball, 1., BODY),
                                        ("half", ball, 0.5, BODY.replace("  set Closed surface  = ../body.stl\n", upper)),
                                        ("on_bed", ball, 0.5, BODY + bed)):
        write_binary("body.stl", triangles)
        exact = 1500 * part * volume_of(triangles)
        for ranks in (1, 2) if name == "brick" else (1,):
            mass = read_statistics(run(f"{name}_{ranks}", text, ranks=ranks))["Mass (kg)"][0]
            print(f"{name}, {ranks} rank(s): mass over the exact one - 1: {mass / exact - 1:.2e}")
            check(abs(mass / exact - 1) <= 0.01, f"{name}: {mass / exact - 1}")


{"plane": plane, "body": body}[sys.argv[3]]()

# SPDX-License-Identifier: LGPL-2.1-or-later
"""contact_scenes.py SCREE SCENE: bodies that slide on each other, as scenes.py.

Bounds are from closed forms; they stood before the runs did.
"""

import math

import numpy as np

from scree.closed_forms import GRAVITY
from scree.results import read_points

from bed_scenes import Plane
from scene_tools import check, check_gain, largest_fall, main, pictures, run, slope_of

OFFSETS = (0, 0.3, 0.8)  # of the interface in its cells
LENGTH, HEIGHT, MASS = 1., 0.3, 450.  # of the block, m and kg


def run_block(scree, name, plane, angle, entries):
    """Statistics of a block on ground below a plane, with an angle of friction, and its velocity along the plane if the ground rests, m/s."""
    down, normal = plane.along(plane.down), plane.along(plane.normal)
    region = "%s > 0 && %s < %g && %s > 0.1 && %s < %g" % (normal, normal, HEIGHT, down, down, 0.1 + LENGTH)
    forces = plane.entries()
    table = run(scree, "contact/block_on_ground", name,
                {"Gravity": forces["Gravity"], "Body force": forces["Body force"], "Ground/Region": normal + " < 0",
                 "Block/Region": region, "Contact Base/Friction angle": str(angle), "Output/Statistics interval": "0.005",
                 "Output/Interval": entries["End time"], **entries})
    return table, plane.column(table, "Momentum", plane.down) / MASS


def friction_of(angle):
    return math.tan(math.radians(angle))


def level_plane(slope, offset):
    return Plane((0, 0.3 + offset * 0.05), (0, 1), (1, 0), slope)


def oblique_plane(slope, offset):
    """Descends to the right by 15 degrees, across cells."""
    angle = math.radians(15)
    return Plane((0.5, 0.9 + offset * 0.05), (math.sin(angle), math.cos(angle)), (1, 0), slope)


# Ground: name, plane, corner of the box, places of the interface in its cells.
GROUNDS = (("level", level_plane, {"Mesh/Upper corner": "3.2, 0.8"}, OFFSETS), ("oblique", oblique_plane, {"Mesh/Upper corner": "3.2, 1.6"}, (0.3,)))


def creep(plane, table):
    """Speed of the block by the potential energy that it loses from 1 s on, m/s."""
    return -slope_of(table, table["Potential energy (J)"], 1) / (MASS * GRAVITY * math.sin(plane.slope))


def contact_sliding(scree):
    """Coulomb's block: g (sin - mu cos), for interfaces on and off the lines of the mesh and oblique to it."""
    for what, make, box, offsets in GROUNDS:
        worst = 0
        for offset in offsets:
            for slope, angle, end in ((30, 25, "0.8"), (20, 0, "0.6"), (30, 0, "0.6")):
                plane = make(slope, offset)
                table, speed = run_block(scree, "slides", plane, angle, {"End time": end, **box})
                error = slope_of(table, speed, 0.3) / GRAVITY - plane.sliding(friction_of(angle))
                print("    offset %g, slope %g, friction %g: error of acceleration over g %.2e" % (offset, slope, angle, error))
                worst = max(worst, abs(error))
                check_gain("block on %s ground" % what, table)
        check("block on %s ground: largest error of acceleration over g" % what, worst, 0, 5e-3)


def contact_rest(scree):
    """Below the angle of friction a block stays where it is: no potential energy is lost but for what it swings in."""
    for what, make, box, offsets in GROUNDS:
        worst = 0
        for offset in offsets:
            plane = make(20, offset)
            table, _ = run_block(scree, "rests", plane, 25, {"End time": "2", "Output/Statistics interval": "0.002", **box})
            worst = max(worst, abs(creep(plane, table)))
            check_gain("block at rest on %s ground" % what, table)
        check("block at rest on %s ground: largest creep, m/s" % what, worst, 0, 1e-5)


def contact_rigid(scree):
    """On ground of "Material = rigid": slides as Coulomb says, or stays."""
    for what, make, box, _ in GROUNDS:
        for slope, angle in ((30, 25), (20, 0)):
            plane = make(slope, 0.3)
            table, speed = run_block(scree, "slides", plane, angle, {"End time": "0.6", "Ground/Material": "rigid", **box})
            name = "block on %s rigid ground, friction %g" % (what, angle)
            check(name + ": error of acceleration over g", abs(slope_of(table, speed, 0.3) / GRAVITY - plane.sliding(friction_of(angle))), 0, 5e-3)
            check_gain(name, table)
            time = table["Time (s)"]
            distance = np.concatenate(([0.], np.cumsum(0.5 * (speed[1:] + speed[:-1]) * np.diff(time))))
            lost, way = (np.ptp(values[time > 0.3]) for values in (table["Contact dissipation (J)"], distance))
            friction = MASS * GRAVITY * friction_of(angle) * math.cos(plane.slope)
            check(name + ": energy lost in contact over weight times way, less that of Coulomb's friction",
                  (lost - friction * way) / (MASS * GRAVITY * way), -0.02, 0.01)
        plane = make(20, 0.3)
        table, _ = run_block(scree, "rests", plane, 25, {"End time": "1.5", "Ground/Material": "rigid", **box})
        check("block on %s rigid ground: creep, m/s" % what, abs(creep(plane, table)), 0, 1e-5)


def contact_3d(scree):
    """In space, down a direction between the axes, with and without friction; the block is half as wide as long."""
    box = {"Dimension": "3", "Mesh/Lower corner": "0, 0, 0", "Mesh/Upper corner": "2.4, 1.2, 0.8", "Mesh/Cell size": "0.1",
           "Block/Region": "x > 0.4 && x < 1.4 && y > 0.2 && y < 0.7 && z > 0.33 && z < 0.63"}
    for slope, angle in ((30, 25), (20, 0)):
        plane = Plane((0, 0, 0.33), (0, 0, 1), (math.cos(0.2), math.sin(0.2), 0), slope)
        table, speed = run_block(scree, "slides_3d", plane, angle, {"End time": "0.6", **box})
        check("block in space, friction %g: error of acceleration over g" % angle,
              abs(slope_of(table, speed * 2, 0.3) / GRAVITY - plane.sliding(friction_of(angle))), 0, 5e-3)
        check_gain("block in space", table)


def check_contact_energy(name, table):
    """Kinetic and elastic energy never grow beyond those of the start."""
    energy = table["Kinetic energy (J)"] + table["Elastic energy (J)"]
    check(name + ": largest energy over that of the start", np.max(energy) / energy[0], 1, 1.001)
    check(name + ": energy that contact gives back over it", largest_fall(table["Contact dissipation (J)"]) / energy[0], 0, 1e-3)


def contact_lift(scree):
    """What moves away is not held; what comes near is stopped when it is there."""
    still = {"Gravity": "0, 0", "Body force": "", "Mesh/Upper corner": "2.4, 1.6", "End time": "0.3",
             "Output/Statistics interval": "0.001", "Output/Interval": "0.3", "Transfer/PIC rate": "0"}
    for angle in (0, 40):
        table = run(scree, "contact/block_on_ground", "lifts",
                    {**still, "Contact Base/Friction angle": str(angle), "Block/Initial velocity": "0.3; 1"})
        for axis in "yx":
            check("block that lifts off: change of its speed along " + axis, np.ptp(table["Momentum %s (N s)" % axis]) / MASS, 0, 1e-3)
    gap = 0.125 + 0.3 * 0.05  # 2.5 cells and more
    table = run(scree, "contact/block_on_ground", "falls",
                {**still, "Block/Region": "x > 0.4 && x < 1.4 && y > %g && y < %g" % (0.315 + gap, 0.615 + gap),
                 "Block/Initial velocity": "0; -1"})
    momentum = table["Momentum y (N s)"]
    touched = table["Time (s)"][np.argmax(np.abs(momentum - momentum[0]) > 1e-6 * abs(momentum[0]))]
    check("block that falls on ground: gap at first touch, cells", (gap - touched) / 0.05, -0.1, 0.6)
    check("block that falls on ground: its speed after it over that before", momentum[-1] / MASS, 0.5, 1)
    check_contact_energy("block that falls on ground", table)


def contact_bars(scree):
    """Two elastic bars of 1 m meet: after 2 L/c they have exchanged their velocities and part."""
    modulus, density = 1e7 * (1 - 0.3) / (1 + 0.3) / (1 - 2 * 0.3), 1500
    duration = 2 / math.sqrt(modulus / density)
    table = run(scree, "contact/block_on_ground", "meet", pictures({
        "Gravity": "0, 0", "Body force": "", "Mesh/Upper corner": "4, 0.1", "Mesh/Cell size": "0.025",
        "Boundaries/Bottom": "free slip", "Boundaries/Top": "free slip", "Transfer/PIC rate": "0",
        "Ground/Region": "x > 1 && x < 2", "Block/Region": "x > 2 && x < 3", "Ground/Initial velocity": "0.5; 0",
        "End time": "%.15g" % (2 * duration), "Output/Interval": "%.15g" % (duration / 20)}))
    check("bars: largest change of momentum over that of one", np.ptp(table["Momentum x (N s)"]) / table["Momentum x (N s)"][0], 0, 1e-12)
    left = []  # velocity of the first one over that before
    for points in (read_points("meet", i * duration / 20) for i in range(41)):
        mass = points.arrays["mass"].ravel() * (points.positions[:, 0] < 2.005)
        left.append(np.average(points.arrays["velocity"][:, 0], weights=mass) / 0.5)
    check("bars: velocity of the first over that before", left[-1], -0.03, 0.03)
    check("bars: the same of the second", 1 - left[-1], 0.97, 1.03)
    # Linear in time while the wave runs to and fro.
    slope, _ = np.polyfit(np.arange(4, 17) / 20, left[4:17], 1)
    check("bars: time of contact over 2 L/c", -1 / slope, 0.97, 1.03)
    check_contact_energy("bars", table)


if __name__ == "__main__":
    main(globals())

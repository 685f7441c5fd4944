# SPDX-License-Identifier: LGPL-2.1-or-later
"""contact_scenes.py SCREE SCENE: bodies that slide on each other, as scenes.py.

Bounds are from closed forms; they stood before the runs did.
"""

import math

import numpy as np

from scree.results import read_points

from bed_scenes import GRAVITY, Plane, slope_of
from scene_tools import check, check_momentum, largest_fall, main, run

OFFSETS = (0, 0.3, 0.8)  # of the interface in its cells
LENGTH, HEIGHT = 1., 0.3  # of the block, m


def run_block(scree, name, plane, angle, entries, start=0.1, across=None, ground="Ground"):
    """A block on ground below a plane, with an angle of friction; returns time, its velocity along the plane and the table."""
    down, normal = plane.along(plane.down), plane.along(plane.normal)
    region = "%s > 0 && %s < %g && %s > %g && %s < %g" % (normal, normal, HEIGHT, down, start, down, start + LENGTH)
    mass = LENGTH * HEIGHT * 1500
    if across is not None:
        region += " && y > %g && y < %g" % across
        mass *= across[1] - across[0]
    forces = plane.entries()
    table = run(scree, "contact/block_on_ground", name,
                {"Gravity": forces["Gravity"], "Body force": forces["Body force"], ground + "/Region": normal + " < 0",
                 "Block/Region": region, "Contact Base/Friction angle": str(angle), "Output/Statistics interval": "0.005",
                 "Output/Interval": entries["End time"], **entries})
    return np.array(table["Time (s)"]), plane.column(table, "Momentum", plane.down) / mass, table


def check_contact(name, table):
    """Momentum to rounding, no energy from nothing."""
    check_momentum(name, table)
    gain = largest_fall(table["Numerical dissipation (J)"])
    check(name + ": largest gain of energy over released energy", gain / np.ptp(table["Potential energy (J)"]), 0, 1e-3)


def level_plane(slope, offset):
    return Plane((0, 0.3 + offset * 0.05), (0, 1), (1, 0), slope)


def oblique_plane(slope, offset):
    """Descends to the right by 15 degrees, across cells."""
    angle = math.radians(15)
    return Plane((0.5, 0.9 + offset * 0.05), (math.sin(angle), math.cos(angle)), (1, 0), slope)


LEVEL, OBLIQUE = {"Mesh/Upper corner": "3.2, 0.8"}, {"Mesh/Upper corner": "3.2, 1.6"}


def contact_sliding(scree):
    """Coulomb's block: g (sin - mu cos), for interfaces on and off the lines of the mesh and oblique to it."""
    for make, box, what in ((level_plane, LEVEL, "level"), (oblique_plane, OBLIQUE, "oblique")):
        worst = 0
        for offset in OFFSETS if make is level_plane else (0.3,):
            for slope, angle, end in ((30, 25, "0.8"), (20, 0, "0.6"), (30, 0, "0.6")):
                time, speed, table = run_block(scree, "slides", make(slope, offset), angle, {"End time": end, **box})
                exact = math.sin(math.radians(slope)) - math.tan(math.radians(angle)) * math.cos(math.radians(slope))
                error = slope_of(table, speed, 0.3) / GRAVITY - exact
                print("    offset %g, slope %g, friction %g: error of acceleration over g %.2e" % (offset, slope, angle, error))
                worst = max(worst, abs(error))
                check_contact("block on %s ground" % what, table)
        check("block on %s ground: largest error of acceleration over g" % what, worst, 0, 5e-3)


def contact_rest(scree):
    """Below the angle of friction a block stays where it is: no potential energy is lost but for what it swings in."""
    for make, box, what in ((level_plane, LEVEL, "level"), (oblique_plane, OBLIQUE, "oblique")):
        worst = 0
        for offset in OFFSETS if make is level_plane else (0.3,):
            plane = make(20, offset)
            _, _, table = run_block(scree, "rests", plane, 25, {"End time": "2", "Output/Statistics interval": "0.002", **box})
            pull = LENGTH * HEIGHT * 1500 * GRAVITY * math.sin(plane.slope)
            creep = -slope_of(table, np.array(table["Potential energy (J)"]), 1) / pull
            print("    offset %g: creep %.2e m/s" % (offset, creep))
            worst = max(worst, abs(creep))
            check_contact("block at rest on %s ground" % what, table)
        check("block at rest on %s ground: largest creep, m/s" % what, worst, 0, 1e-5)


def mean_velocity(name, time, axis, inside):
    """Of the points of a picture that a function of their places chooses, m/s."""
    points = read_points(name, time)
    mass = points.arrays["mass"].ravel() * inside(points.positions)
    return mass @ points.arrays["velocity"][:, axis] / mass.sum()


def contact_lift(scree):
    """What moves away is not held; what comes near is stopped when it is there. The block weighs 450 kg."""
    still = {"Gravity": "0, 0", "Body force": "", "Mesh/Upper corner": "2.4, 1.6", "End time": "0.3",
             "Output/Statistics interval": "0.001", "Output/Interval": "0.3", "Transfer/PIC rate": "0"}
    for angle in (0, 40):
        table = run(scree, "contact/block_on_ground", "lifts",
                    {**still, "Contact Base/Friction angle": str(angle), "Block/Initial velocity": "0.3; 1"})
        check("block that lifts off: change of its speed upwards", np.ptp(table["Momentum y (N s)"]) / 450, 0, 1e-3)
        check("block that lifts off: change of its speed along", np.ptp(table["Momentum x (N s)"]) / 450, 0, 1e-3)
    gap = 0.125 + 0.3 * 0.05  # 2.5 cells and more
    table = run(scree, "contact/block_on_ground", "falls",
                {**still, "Block/Region": "x > 0.4 && x < 1.4 && y > %g && y < %g" % (0.315 + gap, 0.615 + gap),
                 "Block/Initial velocity": "0; -1"})
    time, momentum = np.array(table["Time (s)"]), np.array(table["Momentum y (N s)"])
    touched = time[np.argmax(np.abs(momentum - momentum[0]) > 1e-6 * abs(momentum[0]))]
    check("block that falls on ground: gap at first touch, cells", (gap - touched) / 0.05, -0.1, 0.6)
    check("block that falls on ground: its speed after it over that before", momentum[-1] / 450, 0.5, 1)
    check_contact_energy("block that falls on ground", table)


def check_contact_energy(name, table):
    """Kinetic and elastic energy never grow beyond those of the start."""
    energy = np.array(table["Kinetic energy (J)"]) + np.array(table["Elastic energy (J)"])
    check(name + ": largest energy over that of the start", np.max(energy) / energy[0], 1, 1.001)
    check(name + ": energy that contact gives back over it", largest_fall(table["Contact dissipation (J)"]) / energy[0], 0, 1e-3)


def contact_bars(scree):
    """Two elastic bars of 1 m meet: after 2 L/c they have exchanged their velocities and part."""
    modulus, density = 1e7 * (1 - 0.3) / (1 + 0.3) / (1 - 2 * 0.3), 1500
    duration = 2 / math.sqrt(modulus / density)
    table = run(scree, "contact/block_on_ground", "meet",
                {"Gravity": "0, 0", "Body force": "", "Mesh/Upper corner": "4, 0.1", "Mesh/Cell size": "0.025",
                 "Boundaries/Bottom": "free slip", "Boundaries/Top": "free slip", "Transfer/PIC rate": "0",
                 "Ground/Region": "x > 1 && x < 2", "Block/Region": "x > 2 && x < 3", "Ground/Initial velocity": "0.5; 0",
                 "End time": "%.15g" % (2 * duration), "Output/Graphics": "points", "Output/Interval": "%.15g" % (duration / 20)})
    check("bars: largest change of momentum over that of one", np.ptp(table["Momentum x (N s)"]) / table["Momentum x (N s)"][0], 0, 1e-12)
    left = np.array([mean_velocity("meet", i * duration / 20, 0, lambda x: x[:, 0] < 2.005) for i in range(41)]) / 0.5
    print("    " + " ".join("%.3f" % v for v in left))
    check("bars: velocity of the first over that before", left[-1], -0.03, 0.03)
    check("bars: the same of the second", 1 - left[-1], 0.97, 1.03)
    # Linear in time while the wave runs to and fro.
    slope, start = np.polyfit(np.arange(4, 17) / 20, left[4:17], 1)
    check("bars: time of contact over 2 L/c", -1 / slope, 0.97, 1.03)
    check_contact_energy("bars", table)


def distance(time, speed):
    """Of each row from the first one, m."""
    return np.concatenate(([0.], np.cumsum(0.5 * (speed[1:] + speed[:-1]) * np.diff(time))))


def contact_rigid(scree):
    """On ground of "Material = rigid": slides as Coulomb says, or stays."""
    rigid = {"Ground/Material": "rigid"}
    for make, box, what in ((level_plane, LEVEL, "level"), (oblique_plane, OBLIQUE, "oblique")):
        for slope, angle in ((30, 25), (20, 0)):
            time, speed, table = run_block(scree, "slides", make(slope, 0.3), angle, {"End time": "0.6", **rigid, **box})
            exact = math.sin(math.radians(slope)) - math.tan(math.radians(angle)) * math.cos(math.radians(slope))
            check("block on %s rigid ground, friction %g: error of acceleration over g" % (what, angle),
                  abs(slope_of(table, speed, 0.3) / GRAVITY - exact), 0, 5e-3)
            check_contact("block on %s rigid ground" % what, table)
            friction = 450 * GRAVITY * math.tan(math.radians(angle)) * math.cos(math.radians(slope))
            lost, way = (np.ptp(values[time > 0.3]) for values in (np.array(table["Contact dissipation (J)"]), distance(time, speed)))
            check("block on %s rigid ground, friction %g: energy lost in contact over weight times way, less that of Coulomb's friction" % (what, angle),
                  (lost - friction * way) / (450 * GRAVITY * way), -0.02, 0.01)
        _, speed, table = run_block(scree, "rests", make(20, 0.3), 25, {"End time": "1.5", **rigid, **box})
        check("block on %s rigid ground: creep, m/s" % what,
              abs(slope_of(table, np.array(table["Potential energy (J)"]), 1) / (450 * GRAVITY * math.sin(math.radians(20)))), 0, 1e-5)


def contact_3d(scree):
    """In space, down a direction between the axes, with and without friction."""
    box = {"Dimension": "3", "Mesh/Lower corner": "0, 0, 0", "Mesh/Upper corner": "2.4, 1.2, 0.8", "Mesh/Cell size": "0.1"}
    for slope, angle in ((30, 25), (20, 0)):
        plane = Plane((0, 0, 0.33), (0, 0, 1), (math.cos(0.2), math.sin(0.2), 0), slope)
        region = "x > 0.4 && x < 1.4 && y > 0.2 && y < 0.7 && z > 0.33 && z < 0.63"
        _, speed, table = run_block(scree, "slides_3d", plane, angle, {"End time": "0.6", "Block/Region": region, **box})
        exact = math.sin(math.radians(slope)) - math.tan(math.radians(angle)) * math.cos(math.radians(slope))
        check("block in space, friction %g: error of acceleration over g" % angle,
              abs(slope_of(table, speed * 2, 0.3) / GRAVITY - exact), 0, 5e-3)
        check_contact("block in space", table)


if __name__ == "__main__":
    main(globals())

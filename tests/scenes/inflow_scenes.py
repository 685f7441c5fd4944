# SPDX-License-Identifier: LGPL-2.1-or-later
"""inflow_scenes.py SCREE SCENE: points that enter during the run, as scenes.py.

Bounds are from closed forms and stood before the runs did.
"""

import os

import numpy as np

from scree.results import read_raster, read_table

from scene_tools import ROOT, check, check_gain, main, run


def check_momentum(name, table, scale):
    check(name + ": momentum residual over that entered", max(table["Momentum residual (N s)"]) / scale, 0, 1e-11)


def inflow_jet(scree):
    """A jet without gravity: discharge times time to a layer, and it flies on with its speed, straight and oblique."""
    spacing = 0.05 / 4
    for name, entries, end in (("FLIP", {}, (0.4, 0)), ("TPIC", {"Transfer/Method": "TPIC"}, (0.4, 0)),
                               ("oblique", {"Inflow Jet/Direction": "2, 1", "Inflow Jet/Speed": "10*t", "Transfer/Method": "AFLIP"}, (0.2 / 5**0.5 * 2, 0.1 * 2 / 5**0.5)),
                               ("section", {"Inflow Jet/Face": "Right", "Inflow Jet/Section": "0.9"}, (-0.4, 0))):
        table = run(scree, "inflow/jet", "jet_" + name, entries)
        mass, wanted = np.array(table["Mass (kg)"]), 1500 * 0.3 * abs(end[0])
        time = np.array(table["Time (s)"]) / table["Time (s)"][-1]
        missing = wanted * (time**2 if "oblique" in name else time) - mass
        layer = 1500 * 0.3 * spacing
        check("jet, %s: discharge less mass, over that of a layer" % name, max(missing) / layer, -1e-9, 1 + 1e-9)
        check("jet, %s: mass less discharge, over that of a layer" % name, max(-missing) / layer, -1, 1e-9)
        entered = [np.array(table["Momentum entered %s (N s)" % axis]) for axis in "xy"]
        scale = max(abs(entered[0]))
        check_momentum("jet, " + name, table, scale)
        if name == "oblique":  # faster and faster: later layers press on earlier ones
            continue
        for axis, momentum in zip("xy", entered):
            error = max(abs(np.array(table["Momentum %s (N s)" % axis]) - momentum)) / scale
            check("jet, %s: momentum %s beside that entered" % (name, axis), error, 0, 1e-12)
        check("jet, %s: largest effective stress, Pa, over rho v^2" % name, max(table["Largest effective stress (Pa)"]) / 6e3, 0, 1e-9)


def inflow_channel(scree):
    """Uniform flow: water keeps depth and discharge; also when the channel fills, once the tail of the front (v - sqrt(g d), 2 s) has left."""
    for name, entries, bound in (("full", {}, 0.01), ("filling", {"Water/Region": "0", "Water/Initial velocity": "", "End time": "3"}, 0.01)):
        table = run(scree, "inflow/channel", "channel_" + name, {"Output/Statistics interval": "0.05", **entries})
        time = np.array(table["Time (s)"])
        check("channel, %s: discharge in over 1600 kg/s" % name, table["Water entered (kg)"][-1] / (1600 * time[-1]), 0.998, 1.002)
        late = time >= time[-1] - 0.5 - 1e-9
        out = np.polyfit(time[late], np.array(table["Water lost (kg)"])[late], 1)[0]
        check("channel, %s: discharge out over that in" % name, out / 1600, 1 - bound, 1 + bound)
        for place in "abc":
            level = read_table("channel_%s/probe_%s.csv" % (name, place))["Water level (m)"][-1]
            check("channel, %s: depth at %s over that at the inflow" % (name, place), level / 0.4, 1 - bound, 1 + bound)
        check_momentum("channel, " + name, table, table["Momentum entered x (N s)"][-1])
        check_gain("channel, " + name, table, over=table["Energy entered (J)"][-1])


def inflow_saturated(scree):
    """A saturated layer on a smooth floor, twice as fast as its waves: it keeps its thickness where the front has passed, and its water."""
    table = run(scree, "inflow/saturated_layer", "saturated", {})
    for place in "ab":
        probe = read_table(f"saturated/probe_{place}.csv")
        for what in ("Thickness (m)", "Water level (m)"):
            check("saturated layer: %s at %s over that at the inflow" % (what.lower(), place), probe[what][-1] / 0.4, 0.98, 1.02)
    check("saturated layer: water over soil that entered", table["Water entered (kg)"][-1] / table["Mass entered (kg)"][-1] * 1590 / 400, 0.98, 1.02)
    check("saturated layer: water outside soil over that entered", max(table["Water outside soil (kg)"]) / table["Water entered (kg)"][-1], 0, 0.01)
    check("saturated layer: volume error", max(table["Volume error (-)"]), 0, 0.05)
    check_momentum("saturated layer", table, table["Momentum entered x (N s)"][-1])
    check_gain("saturated layer", table, over=table["Energy entered (J)"][-1])


def inflow_debris(scree):
    """A hydrograph of discharge on a slope: the mass that has entered is its integral to a layer, and energy does not grow."""
    hydrograph = os.path.join(ROOT, "prm", "inflow", "hydrograph.csv")
    table = run(scree, "inflow/debris_flow", "debris", {"Inflow Torrent/Hydrograph": hydrograph, "End time": "3"})
    time = np.array(table["Time (s)"])
    rows = np.array([[0, 0], [0.5, 1.6], [1.5, 1.2], [4, 0]])
    fine = np.linspace(0, 4, 40001)
    volume = np.interp(time, fine, np.concatenate([[0], np.cumsum(0.5 * np.diff(fine) * (lambda q: q[1:] + q[:-1])(np.interp(fine, *rows.T)))]))
    mass = np.array(table["Mass entered (kg)"])
    layer = min(step for step in np.diff(mass) if step > 0)
    missing = 1590 * volume - mass
    check("debris: discharge less mass, over that of a layer", max(missing) / layer, 0, 1 + 1e-6)
    check("debris: mass less discharge, over that of a layer", max(-missing) / layer, -1, 1e-6)
    check_momentum("debris", table, np.linalg.norm([table["Momentum entered %s (N s)" % axis][-1] for axis in "xyz"]))
    # Near the inflow; doc/tutorials/debris_flow.md.
    check("debris: largest thickness, m", np.nanmax(read_raster("debris/maps/largest_thickness.asc").values), 0.9 * 0.41, 1.1 * 0.41)
    check_gain("debris", table, over=table["Bed dissipation (J)"][-1] + table["Plastic dissipation (J)"][-1])


if __name__ == "__main__":
    main(globals())

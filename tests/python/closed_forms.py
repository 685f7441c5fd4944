# SPDX-License-Identifier: LGPL-2.1-or-later
"""The closed forms against each other, against tables and in their limits."""

import math

import numpy as np

from scree.closed_forms import (GRAVITY, GrainDamBreak, Mud, consolidate, dupuit_discharge, ergun_velocity, film_discharge, film_velocity, final_height,
                                final_settlement, final_volume_ratio, gauss, hydrostatic_pressure, oedometric_modulus, plane_poiseuille,
                                slip_circle_factor, stoker_bore, terzaghi_degree, terzaghi_pressure, volume_ratio_of_stress)

from test_tools import run_tests

DEPTH, FACTORS = np.linspace(0.025, 0.975, 20), (0.1, 0.5, 1)


def near(found, wanted, bound):
    """Absolute."""
    np.testing.assert_allclose(found, wanted, 0, bound)


def self_weight_pressure(depth, time_factor):
    """Terzaghi's excess pressure over the (buoyant) weight of the column when that is the load: p = gamma' z at t = 0, H = 1."""
    m = (2. * np.arange(4000) + 1) * math.pi / 2
    return np.sin(np.multiply.outer(depth, m)) @ (2 / m**2 * np.sin(m) * np.exp(-m**2 * time_factor))


def test_terzaghi():
    near([terzaghi_degree(t) for t in FACTORS], [.357, .764, .931], 6e-4)  # of the tables
    near(1 - np.sum(gauss(0., 1.)[1] * terzaghi_pressure(gauss(0., 1.)[0], 0.1)), terzaghi_degree(0.1), 1e-12)
    near(terzaghi_degree(0.01), math.sqrt(0.04 / math.pi), 1e-6)
    near(terzaghi_pressure(DEPTH, 0.01), [math.erf(z / 0.2) for z in DEPTH], 1e-6)


def test_slip_circles():
    """Taylor's chart: stability numbers, and a factor of 1.47 of a slope 2:1 with D = 2 and c_u = 0.25 gamma H."""
    near([slip_circle_factor(1 / math.tan(math.radians(degrees)), 1, n, n) for degrees, n in ((60, 0.191), (75, 0.219))], 1, 6e-3)
    near(slip_circle_factor(2, 2, 0.25, 0.25), 1.47, 6e-3)


def test_viscous_flow():
    y, w = gauss(0., 0.1)
    near(np.sum(w * plane_poiseuille(y, 3., 2., 0.1)) / 0.1 / (3 * 0.1**2 / 24), 1, 1e-12)  # G H^2/(12 mu)
    y, w = gauss(0., 1., 60)
    near([np.sum(w * film_velocity(y, t, 2., 500., 1.)) / film_discharge(t, 2., 500., 1.) for t in (0.1, 0.6)], 1, 1e-6)
    near(film_velocity(1., 0.01, 2., 500., 1.)[0] / 0.02, 1, 1e-6)  # no wall is felt yet


def test_large_strain():
    """In the limits of small strain: a load of 1e-5 M without weight is Terzaghi's column, weight of 1e-5 M the triangle."""
    near([Mud(1, 1, .5, 1).stress(volume_ratio_of_stress(s, 1.)) / s for s in (1e-9, 1e-3, .3, 1, 10)], 1, 1e-6)
    stiff, heavy = Mud(1., 1e7, .4, 1e-3, load=100., grain_density=1000.), Mud(1., 1e9, .4, 1e-3)
    for mud, exact in ((stiff, terzaghi_pressure), (heavy, self_weight_pressure)):
        for t, state in zip(FACTORS, consolidate(mud, [mud.time(t) for t in FACTORS])):
            near(state.excess_pressure / (mud.buoyant_weight * mud.height + mud.load), exact(1 - state.material_height / mud.height, t), 1e-3)
            if mud is stiff:
                near(state.settlement / (terzaghi_degree(t) * mud.load * mud.height / mud.modulus), 1, 1e-3)


def test_conductivity_that_falls():
    """To a sixteenth: the end does not know it, half the spacing changes little, and under a tiny load it is constant."""
    tight = Mud(1., 1e6, .4, 1e-3, load=4e5, grain_density=1000., kozeny_carman=True)
    times = [tight.time(t) for t in (0.5, 2, 200)]
    coarse, fine = ([state.settlement for state in consolidate(tight, times, n)] for n in (50, 200))
    near(fine[-1] / final_settlement(tight), 1, 1e-4)
    near(np.divide(coarse, fine), 1, 3e-3)
    slow, quick = (consolidate(tight._replace(load=10., kozeny_carman=law), times[:1])[0].settlement for law in (True, False))
    near(slow / quick, 1, 1e-4)


def test_mud():
    """prm/consolidation/large_strain_consolidation.prm: its end is the exact one, it converges, and grains first fall freely through water."""
    mud = Mud(1., oedometric_modulus(2e4, .2), .5, 1e-2)
    coarse, fine = (consolidate(mud, [mud.time(t) for t in (0.25, 1, 20)], n) for n in (50, 200))
    end = fine[-1]
    near(end.settlement / final_settlement(mud), 1, 1e-4)
    near(end.volume_ratio, final_volume_ratio(mud, end.material_height), 1e-4)
    near(end.height, final_height(mud, end.material_height), 1e-4)
    near(mud.stress(float(final_volume_ratio(mud, 0.))) / mud.buoyant_weight / mud.height, 1, 1e-12)
    near([a.settlement / b.settlement for a, b in zip(coarse, fine)], 1, 1e-3)
    start = consolidate(mud, [mud.time(1e-4)])[0]
    near(start.settlement / (mud.conductivity * mud.buoyant_weight / (mud.water_density * mud.gravity) * start.time), 1, 0.02)


def test_seepage():
    """Dupuit's discharge -k f f' is the same everywhere; Ergun's friction factor is 150/Re + 1.75."""
    x = (np.arange(4000) + .5) / 4000
    surface = np.sqrt(1 - (1 - .4**2) * x)  # Dupuit's parabola
    near((-1e-2 * surface * np.gradient(surface, x))[1:-1] / dupuit_discharge(1e-2, 1., .4, 1.), 1, 1e-6)
    for viscosity in (1, 1e-2, 1e-3, 1e-6):
        velocity = ergun_velocity(GRAVITY, 5e-3, .4, viscosity)
        reynolds, friction = 1000 * velocity * 5e-3 / (viscosity * .6), 1000 * GRAVITY * 5e-3 * .4**3 / (1000 * velocity**2 * .6)
        near(friction / (150 / reynolds + 1.75), 1, 1e-9)
    near(float(hydrostatic_pressure(0.25, 1.25)), 9810, 1e-9)


def test_dam_breaks():
    """Stoker's bore gets its momentum from the force on it, and a low step runs with sqrt(g h); a wave of grains grows by what enters from the layer."""
    bore = stoker_bore(1., .2)
    near(.2 * bore.speed * bore.velocity / (GRAVITY / 2 * (bore.depth**2 - .2**2)), 1, 1e-9)
    near(stoker_bore(1.0001, 1.).speed / math.sqrt(GRAVITY), 1, 1e-4)
    flow, part, dt = GrainDamBreak(.2, .35, .17), np.linspace(-1, 2, 3001), 1e-5
    volume = [.2 * np.trapz(flow.depth(part), flow.place(part, time)) for time in (1., 1. + dt)]
    speed = float(flow.place(-1., 1. + dt / 2) + flow.wave_speed * (1. + dt / 2)) * 2 / (1. + dt / 2)  # of the layer: m t
    end = float(flow.place(-1., 1. + dt) - flow.place(-1., 1.)) / dt
    near((volume[1] - volume[0]) / dt / (.2 * (speed - end)), 1, 1e-4)


run_tests(globals())

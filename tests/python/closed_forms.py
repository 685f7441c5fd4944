# SPDX-License-Identifier: LGPL-2.1-or-later
"""The closed forms against each other, against tables and in their limits."""

import math
import sys

import numpy as np

from scree.closed_forms import (GRAVITY, GrainDamBreak, Mud, consolidate, dupuit_discharge,
                                ergun_velocity, film_discharge, film_velocity, final_height, final_settlement,
                                final_volume_ratio, gauss, hydrostatic_pressure, oedometric_modulus, plane_poiseuille,
                                slip_circle_factor, stoker_bore, terzaghi_degree, terzaghi_pressure, volume_ratio_of_stress)


def check(failures, what, error, bound):
    good = error <= bound
    print(f"{what:<86} {error:9.2e}  below {bound:g}{'' if good else '  <-- FAILED'}")
    if not good:
        failures.append(what)


def self_weight_pressure(depth, time_factor):
    """Terzaghi's excess pressure over the (buoyant) weight of the column when that is the load: p = gamma' z at t = 0, H = 1."""
    m = (2. * np.arange(4000) + 1) * math.pi / 2
    return np.sin(np.multiply.outer(depth, m)) @ (2 / m**2 * np.sin(m) * np.exp(-m**2 * time_factor))


def check_all():
    failures = []
    depth = np.linspace(0.025, 0.975, 20)

    check(failures, "Terzaghi: U at T_v = 0.1, 0.5, 1 against the tables (.357, .764, .931)",
          max(abs(terzaghi_degree(t) - u) for t, u in ((0.1, .357), (0.5, .764), (1, .931))), 6e-4)
    check(failures, "Terzaghi: U = 1 - mean p/q at T_v = 0.1",
          abs(terzaghi_degree(0.1) - 1 + np.sum(gauss(0., 1.)[1] * terzaghi_pressure(gauss(0., 1.)[0], 0.1))), 1e-12)
    check(failures, "Terzaghi: U = sqrt(4 T_v/pi) at T_v = 0.01", abs(terzaghi_degree(0.01) - math.sqrt(0.04 / math.pi)), 1e-6)
    check(failures, "Terzaghi: p = q (1 - erfc(z/(2 sqrt(c_v t)))) at T_v = 0.01",
          max(abs(p - math.erf(z / 0.2)) for z, p in zip(depth, terzaghi_pressure(depth, 0.01))), 1e-6)

    for degrees, number in ((60, 0.191), (75, 0.219)):
        factor = slip_circle_factor(1 / math.tan(math.radians(degrees)), 1, number, number)
        check(failures, f"slip circles: stability number of Taylor's chart, {number} at {degrees} degrees", abs(factor - 1), 6e-3)
    check(failures, "slip circles: Taylor's factor 1.47 of a slope 2:1 with D = 2 and c_u = 0.25 gamma H",
          abs(slip_circle_factor(2, 2, 0.25, 0.25) - 1.47), 6e-3)

    y, w = gauss(0., 0.1)
    check(failures, "Poiseuille: mean velocity G H^2/(12 mu)",
          abs(np.sum(w * plane_poiseuille(y, 3., 2., 0.1)) / 0.1 / (3 * 0.1**2 / 24) - 1), 1e-12)
    y, w = gauss(0., 1., 60)
    check(failures, "film: discharge is the velocity's integral at nu t/H^2 = 0.05, 0.3",
          max(abs(np.sum(w * film_velocity(y, t, 2., 500., 1.)) / film_discharge(t, 2., 500., 1.) - 1) for t in (0.1, 0.6)), 1e-6)
    check(failures, "film: no wall is felt yet where u = g t (H = 1 m, nu t = 0.005 m^2)",
          abs(film_velocity(1., 0.01, 2., 500., 1.)[0] / 0.02 - 1), 1e-6)

    check(failures, "Hencky: s(J(s)) = s for s/M from 1e-9 to 10",
          max(abs(Mud(1, 1, .5, 1).stress(volume_ratio_of_stress(s, 1.)) / s - 1) for s in (1e-9, 1e-3, .3, 1, 10)), 1e-6)
    # A load of 1e-5 M without weight is Terzaghi's column; weight of 1e-5 M is the triangle.
    stiff = Mud(1., 1e7, .4, 1e-3, load=100., grain_density=1000.)
    heavy = Mud(1., 1e9, .4, 1e-3)
    for mud, exact, name in ((stiff, terzaghi_pressure, "load"), (heavy, self_weight_pressure, "weight")):
        factors = [0.1, 0.5, 1]
        weight = mud.buoyant_weight * mud.height + mud.load
        for time_factor, state in zip(factors, consolidate(mud, [mud.time(t) for t in factors])):
            error = state.excess_pressure / weight - exact(1 - state.material_height / mud.height, time_factor)
            check(failures, f"large strain, tiny {name}: p of the small-strain series, T_v = {time_factor}",
                  np.max(np.abs(error)), 1e-3)
            if name == "load":
                settlement = terzaghi_degree(time_factor) * mud.load * mud.height / mud.modulus
                check(failures, f"large strain, tiny load: settlement of Terzaghi, T_v = {time_factor}",
                      abs(state.settlement / settlement - 1), 1e-3)

    # Under a load, with k that falls to a sixteenth: the end does not know k, and half the spacing changes little.
    tight = Mud(1., 1e6, .4, 1e-3, load=4e5, grain_density=1000., kozeny_carman=True)
    times = [tight.time(t) for t in (0.5, 2, 200)]
    coarse, fine = (consolidate(tight, times, n) for n in (50, 200))
    check(failures, "Kozeny-Carman, load of 0.4 M: final settlement",
          abs(fine[-1].settlement / final_settlement(tight) - 1), 1e-4)
    check(failures, "the same: settlement at T_v = 0.5 and 2 with 50 and 200 cells, relative difference",
          max(abs(a.settlement / b.settlement - 1) for a, b in zip(coarse, fine)), 3e-3)
    slow, quick = (consolidate(tight._replace(load=10., kozeny_carman=law), times[:1])[0].settlement for law in (True, False))
    check(failures, "Kozeny-Carman, tiny load: as with constant k", abs(slow / quick - 1), 1e-4)

    mud = Mud(1., oedometric_modulus(2e4, .2), .5, 1e-2)
    settlement = final_settlement(mud)
    coarse, fine = (consolidate(mud, [mud.time(t) for t in (0.25, 1, 20)], n) for n in (50, 200))
    check(failures, "prm/consolidation/large_strain_consolidation.prm: settlement at T_v = 20 is the exact final one",
          abs(fine[-1].settlement / settlement - 1), 1e-4)
    end = fine[-1]
    check(failures, "the same: J at T_v = 20", np.max(np.abs(end.volume_ratio - final_volume_ratio(mud, end.material_height))), 1e-4)
    check(failures, "the same: y at T_v = 20", np.max(np.abs(end.height - final_height(mud, end.material_height))), 1e-4)
    check(failures, "the same: stress at the base is the buoyant weight",
          abs(mud.stress(float(final_volume_ratio(mud, 0.))) / mud.buoyant_weight / mud.height - 1), 1e-12)
    check(failures, "the same: settlement at T_v = 0.25 and 1 with 50 and 200 cells, relative difference",
          max(abs(a.settlement / b.settlement - 1) for a, b in zip(coarse, fine)), 1e-3)
    start = consolidate(mud, [mud.time(1e-4)])[0]
    rate = mud.conductivity * mud.buoyant_weight / (mud.water_density * mud.gravity)
    check(failures, "the same: first settlement is that of free fall of grains through water, k gamma'/(rho_w g) t",
          abs(start.settlement / (rate * start.time) - 1), 0.02)

    n = 4000
    x = (np.arange(n) + .5) / n
    surface = np.sqrt(1 - (1 - .4**2) * x)  # Dupuit's parabola
    # With a uniform head along each vertical the local discharge -k f f' is the same everywhere.
    discharge = -1e-2 * surface * np.gradient(surface, x)
    check(failures, "Dupuit: discharge of the parabola is k (h_1^2 - h_2^2)/(2 L) everywhere",
          np.max(np.abs(discharge[1:-1] / dupuit_discharge(1e-2, 1., .4, 1.) - 1)), 1e-6)
    for viscosity in (1, 1e-2, 1e-3, 1e-6):
        velocity = ergun_velocity(GRAVITY, 5e-3, .4, viscosity)
        # Ergun's own form: friction factor 150/Re + 1.75.
        reynolds = 1000 * velocity * 5e-3 / (viscosity * .6)
        friction = 1000 * GRAVITY * 5e-3 * .4**3 / (1000 * velocity**2 * .6)
        check(failures, f"Ergun, mu = {viscosity} Pa s: friction factor", abs(friction / (150 / reynolds + 1.75) - 1), 1e-9)

    bore = stoker_bore(1., .2)
    force = GRAVITY / 2 * (bore.depth**2 - .2**2)
    check(failures, "Stoker: momentum that passes the bore over the force on it",
          abs(.2 * bore.speed * bore.velocity / force - 1), 1e-9)
    check(failures, "Stoker: a low step runs with sqrt(g h)", abs(stoker_bore(1.0001, 1.).speed / math.sqrt(GRAVITY) - 1), 1e-4)

    flow, part, dt = GrainDamBreak(.2, .35, .17), np.linspace(-1, 2, 3001), 1e-5
    volume = [.2 * np.trapz(flow.depth(part), flow.place(part, time)) for time in (1., 1. + dt)]
    speed = float(flow.place(-1., 1. + dt / 2) + flow.wave_speed * (1. + dt / 2)) * 2 / (1. + dt / 2)  # of the layer: m t
    end = float(flow.place(-1., 1. + dt) - flow.place(-1., 1.)) / dt
    check(failures, "dam break of grains: growth of the wave's volume over what enters from the layer", abs((volume[1] - volume[0]) / dt / (.2 * (speed - end)) - 1), 1e-4)

    check(failures, "hydrostatics: 1 m of water", abs(float(hydrostatic_pressure(0.25, 1.25)) - 9810), 1e-9)
    return failures


if __name__ == "__main__":
    failed = check_all()
    sys.exit("failed: " + ", ".join(failed) if failed else 0)

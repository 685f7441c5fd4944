# SPDX-License-Identifier: LGPL-2.1-or-later
"""Exact and reference solutions that the cases with water are compared with. SI units, pressures compression positive.

- consolidation at small strain: Terzaghi 1943
- consolidation at large strain of soil that is elastic in logarithmic strain: exact end state, course in time by
  finite differences
- infiltration of a pond with suction (Green & Ampt 1911)
- hydrostatic pressure; discharge through a dam with vertical faces; flow through a bed of grains at any speed
- dam break on a wet bed in shallow water: Stoker 1957; of grains on a plane: Mangeney, Heinrich & Roche 2000
- viscous flow: between plates (Poiseuille), decay of vortices (Taylor 1923)
"""

import math
from typing import NamedTuple

import numpy as np
from scipy import integrate, optimize, sparse, special

GRAVITY = 9.81  # m/s^2


def oedometric_modulus(young_modulus, poisson_ratio):
    """K + 4/3 G = E (1 - nu)/((1 + nu)(1 - 2 nu)), Pa."""
    return young_modulus * (1 - poisson_ratio) / ((1 + poisson_ratio) * (1 - 2 * poisson_ratio))


# Small strain ---------------------------------------------------------------------------------------------------------


class Terzaghi(NamedTuple):
    """A column of height H, drained at its top, fixed and impermeable at its base, loaded by q at its top from t = 0 on."""
    height: float                # H, m
    load: float                  # q, Pa
    modulus: float               # oedometric, Pa
    conductivity: float          # k, m/s
    water_density: float = 1000  # kg/m^3
    gravity: float = GRAVITY     # that of the conductivity, m/s^2

    @property
    def consolidation_coefficient(self):
        """c_v = k E_oed/(rho_w g), m^2/s."""
        return self.conductivity * self.modulus / (self.water_density * self.gravity)

    def time(self, time_factor):
        """t = T_v H^2/c_v, s."""
        return time_factor * self.height**2 / self.consolidation_coefficient


def _odd(n_terms):
    return 2. * np.arange(n_terms) + 1.


def terzaghi_pressure(depth, time_factor, n_terms=4000):
    """p/q at depth/H below the drained top (number or array): sum over odd m of 4/(m pi) sin(m pi z/(2H)) exp(-m^2 pi^2 T_v/4)."""
    m = _odd(n_terms)
    amplitude = 4 / (m * math.pi) * np.exp(-(m * math.pi)**2 * time_factor / 4)
    m, amplitude = m[amplitude > 0], amplitude[amplitude > 0]
    return np.sin(np.multiply.outer(np.asarray(depth, dtype=float), m * math.pi / 2)) @ amplitude


def terzaghi_degree(time_factor, n_terms=4000):
    """Degree of consolidation U = 1 - sum over odd m of 8/(m pi)^2 exp(-m^2 pi^2 T_v/4); settlement = U q H/E_oed."""
    m = _odd(n_terms)
    return 1 - np.sum(8 / (m * math.pi)**2 * np.exp(-(m * math.pi)**2 * time_factor / 4))


# Large strain ---------------------------------------------------------------------------------------------------------


class Mud(NamedTuple):
    """A layer that consolidates in one dimension at any strain, under its weight below water and a load on its top.

    Soil elastic in logarithmic strain (Hencky): Kirchhoff stress tau = M ln J along the vertical, so that the effective
    stress, compression positive, is s(J) = -M ln J/J. Incompressible grains and water. Conductivity k at all porosities,
    or, after Kozeny and Carman, k at n_0 and elsewhere in proportion to n^3/(1-n)^2.
    """
    height: float                # H_0 without stress, m
    modulus: float               # M = K + 4/3 G, Pa
    porosity: float              # n_0 without stress
    conductivity: float          # k, m/s
    grain_density: float = 2650  # kg/m^3
    water_density: float = 1000  # kg/m^3
    gravity: float = GRAVITY     # m/s^2
    load: float = 0              # effective, on the top, Pa
    kozeny_carman: bool = False

    @property
    def buoyant_weight(self):
        """(1 - n_0)(rho_s - rho_w) g per initial volume, N/m^3: soil keeps its solids, so this holds at any strain."""
        return (1 - self.porosity) * (self.grain_density - self.water_density) * self.gravity

    def time(self, time_factor):
        """t = T_v H_0^2 rho_w g/(k M), s."""
        return time_factor * self.height**2 * self.water_density * self.gravity / (self.conductivity * self.modulus)

    def stress(self, volume_ratio):
        """s(J), Pa."""
        return -self.modulus * np.log(volume_ratio) / volume_ratio

    def mobility(self, volume_ratio):
        """k(n)/(rho_w g J), m^2/(Pa s): flux through the soil over the pressure's slope along Z."""
        darcy = self.conductivity / (self.water_density * self.gravity)
        if not self.kozeny_carman:
            return darcy / volume_ratio
        # (1-n) J = 1 - n_0, so that n^3/(1-n)^2 over its start is (n/n_0)^3 J^2.
        return darcy * ((1 - (1 - self.porosity) / volume_ratio) / self.porosity)**3 * volume_ratio


def volume_ratio_of_stress(stress, modulus):
    """J with -M ln J/J = stress: y = -ln J solves y exp(y) = stress/M. One root, since s(J) falls for all J < 1."""
    return np.exp(-special.lambertw(np.asarray(stress, dtype=float) / modulus).real)


def final_volume_ratio(mud, material_height):
    """J at the end of consolidation at the height Z that the material had without stress, m; exact.

    Water is hydrostatic again, so that the effective stress bears the buoyant weight above, gamma' (H_0 - Z), and the load.
    """
    above = mud.buoyant_weight * (mud.height - np.asarray(material_height, dtype=float)) + mud.load
    return volume_ratio_of_stress(above, mud.modulus)


def gauss(lower, upper, n=40):
    points, weights = np.polynomial.legendre.leggauss(n)
    half = (np.asarray(upper, dtype=float) - lower) / 2
    return lower + np.multiply.outer(half, points + 1), np.multiply.outer(half, weights)


def final_height(mud, material_height):
    """Height y, m, that the material of height Z (number or array) has at the end: integral of J from 0 to Z."""
    points, weights = gauss(0., material_height)
    return np.sum(weights * final_volume_ratio(mud, points), axis=-1)


def final_settlement(mud):
    """How far the top is at the end below its initial height, m."""
    return mud.height - float(final_height(mud, mud.height))


class MudState(NamedTuple):
    """The layer at one time, over its material height Z: of the cells' middles, m."""
    time: float
    material_height: np.ndarray
    volume_ratio: np.ndarray     # J
    height: np.ndarray           # y, m
    stress: np.ndarray           # effective, compression positive, Pa
    excess_pressure: np.ndarray  # over the hydrostatic one, Pa
    settlement: float            # of the top, m


def _rate(mud, ratio):
    """dJ/dt of all cells."""
    spacing = mud.height / len(ratio)
    # Values at the cells' middles and at the top; the base is impermeable.
    ratio = np.append(ratio, volume_ratio_of_stress(mud.load, mud.modulus))
    distance = np.full(len(ratio) - 1, spacing)
    distance[-1] /= 2

    # velocity of the soil, upwards, at the faces: -(k/(rho_w g J)) (ds/dZ + gamma'), where the part of the stress is the
    # difference of the integral of (k/(rho_w g J)) ds/dJ: k may fall steeply from one cell to the next
    points, weights = gauss(0., 1., 4)
    between = ratio[:-1, None] + np.diff(ratio)[:, None] * points
    mean = np.sum(weights * mud.mobility(between) * -mud.modulus * (1 - np.log(between)) / between**2, axis=1)
    mobility = mud.mobility(ratio)
    velocity = np.append(0., -mean * np.diff(ratio) / distance - mud.buoyant_weight * (mobility[:-1] + mobility[1:]) / 2)
    return np.diff(velocity) / spacing


def consolidate(mud, times, n_cells=200):
    """The states at `times` (ascending, s) of a layer without effective stress at t = 0: a finite volume solution.

    In the material coordinate Z (the height without stress) solids do not move and dx = J dZ. With
        v_s = (k/(rho_w g)) dp_e/dx                  Darcy, and (1-n) v_s + n v_w = 0 over an impermeable base
        dp_e/dZ = -ds/dZ - gamma'                    equilibrium of the mixture; (1-n) J = 1 - n_0
        dJ/dt = dv_s/dZ
    follows Gibson, England & Hussey's (1967) equation, with k = k(n) where it depends on n:
        dJ/dt = d/dZ [ -(k/(rho_w g J)) (ds/dZ + gamma') ],  s = -M ln J/J,
    with no flux at Z = 0 and s = load at Z = H_0. Cells of equal Z, fluxes at their faces, second order; in time Radau's
    method with an error of 1e-11 a step. Water and soil have no inertia here.
    """
    spacing = mud.height / n_cells
    material_height = (np.arange(n_cells) + 0.5) * spacing
    found = integrate.solve_ivp(lambda _, ratio: _rate(mud, ratio), (0, times[-1]), np.ones(n_cells), "Radau", times, rtol=1e-11, atol=1e-13,
                                jac_sparsity=sparse.diags([1, 1, 1], [-1, 0, 1], (n_cells, n_cells)))
    if not found.success:
        raise ArithmeticError(f"The finite volumes of consolidation do not converge: {found.message}")
    states = []
    for time, ratio in zip(found.t, found.y.T):
        stress, above = mud.stress(ratio), mud.buoyant_weight * (mud.height - material_height) + mud.load
        states.append(MudState(time, material_height, ratio, spacing * (np.cumsum(ratio) - ratio / 2), stress, above - stress,
                               mud.height - spacing * float(np.sum(ratio))))
    return states


# At rest and in steady flow -------------------------------------------------------------------------------------------


def hydrostatic_pressure(height, surface, density=1000):
    """rho g (surface - y) below the surface, 0 above, Pa; heights in m."""
    return density * GRAVITY * np.maximum(surface - np.asarray(height, dtype=float), 0)


def ergun_velocity(gravity, diameter, porosity, viscosity, density=1000):
    """Superficial velocity U, m/s, through a bed of grains of diameter d at the gradient rho g of the water's own weight (Ergun 1952):
    rho g = 150 mu (1-n)^2/(n^3 d^2) U + 1.75 rho (1-n)/(n^3 d) U^2."""
    slow = 150 * viscosity * (1 - porosity)**2 / (porosity**3 * diameter**2)
    fast = 1.75 * density * (1 - porosity) / (porosity**3 * diameter)
    return 2 * density * gravity / (slow + math.sqrt(slow**2 + 4 * fast * density * gravity))


def green_ampt_time(depth, pond, suction, porosity, conductivity):
    """Time, s, at which the sharp front of a pond that sinks into dry soil is at a depth, m (Green & Ampt 1911).

    n dz/dt = k (h + s + z)/z with the pond h = pond - n z and the suction s of the front, m of water.
    """
    head, rest = pond + suction, 1 - porosity
    return porosity / conductivity * (depth / rest - head / rest**2 * np.log(1 + rest * depth / head))


def dupuit_discharge(conductivity, upstream, downstream, length):
    """k (h_1^2 - h_2^2)/(2 L): discharge through a dam with vertical faces, mean over its length, m^2/s.

    Dupuit's formula is exact for this mean at any time and for any shape of the free surface y = f(x), seepage face
    included (Charny 1951), if the flow obeys Darcy and reservoirs are hydrostatic: with the head phi = p/(rho_w g) + y,
        integral of phi_x over the wetted dam = [integral of phi dy from 0 to f - f^2/2] between both faces
    since phi = y on y = f(x); the brackets are h_1^2/2 and h_2^2/2, with phi = y on the seepage face.
    """
    return conductivity * (upstream**2 - downstream**2) / (2 * length)


# Dam break ------------------------------------------------------------------------------------------------------------


class Bore(NamedTuple):
    """What runs into the shallow water: speed of the bore, depth and speed of the water behind it."""
    speed: float  # m/s
    depth: float  # m
    velocity: float  # m/s


def stoker_bore(upstream, downstream, gravity=GRAVITY):
    """The bore after water of depth h_1 is released onto h_0 < h_1 (Stoker 1957, chapter 10.8), in shallow water, at any time.

    Behind it depth h and speed u are uniform as far as the wave that runs upstream, which keeps u + 2 sqrt(g h); at the bore mass and
    momentum are conserved: u = (h - h_0) sqrt(g/2 (1/h + 1/h_0)).
    """
    def behind(depth):
        return 2 * (math.sqrt(gravity * upstream) - math.sqrt(gravity * depth))

    depth = optimize.brentq(lambda h: behind(h) - (h - downstream) * math.sqrt(gravity / 2 * (1 / h + 1 / downstream)), downstream, upstream,
                            xtol=1e-14 * upstream)
    return Bore(behind(depth) * depth / (depth - downstream), depth, behind(depth))


class GrainDamBreak(NamedTuple):
    """A layer of grains of depth h on a plane, held at x = 0 (x down the plane, depth across it), is released; shallow flow (Mangeney, Heinrich & Roche 2000).

    The plane is as steep as theta, its friction angle is delta <= theta. With c = sqrt(g h cos theta) and m = g cos theta (tan theta - tan delta) the depth at time t is
    (2 c - x/t + m t/2)^2/(9 g cos theta) from x = m t^2/2 - c t, where it is h, to the front x = m t^2/2 + 2 c t. The layer behind slides with m t.
    """
    layer: float            # h, m
    slope: float            # theta, radians
    friction: float         # delta, radians
    gravity: float = GRAVITY  # m/s^2

    @property
    def wave_speed(self):
        """c, m/s."""
        return math.sqrt(self.gravity * self.layer * math.cos(self.slope))

    def place(self, part, time):
        """x, m, of a part of the wave: -1 at its end in the layer, 2 at its front (number or array)."""
        acceleration = self.gravity * math.cos(self.slope) * (math.tan(self.slope) - math.tan(self.friction))
        return acceleration * time**2 / 2 + part * self.wave_speed * time

    def depth(self, part):
        """Depth over h at a part of the wave from -1 to 2, the same at any time."""
        return (2 - np.asarray(part, dtype=float))**2 / 9


# Viscous flow ---------------------------------------------------------------------------------------------------------


def plane_poiseuille(height, gradient, viscosity, width):
    """Velocity, m/s, of steady flow between plates `width` H apart: G y (H - y)/(2 mu), with the body force less the gradient of the
    pressure G, N/m^3. Its mean is G H^2/(12 mu)."""
    return gradient * height * (width - height) / (2 * viscosity)


def film_velocity(height, time, acceleration, viscosity, depth, density=1000):
    """Velocity, m/s, of a film on a plane that it sticks to, from rest: the half parabola of the steady state less what has not yet
    come, a series in the diffusion of momentum (as Terzaghi's of pressure). `acceleration`: gravity's along the plane, m/s^2."""
    nu, m = viscosity / density, _odd(400) * math.pi / 2
    height = np.atleast_1d(height)[:, None]
    missing = 2 * np.sin(m * height / depth) / m**3 * np.exp(-m**2 * nu * time / depth**2)
    return acceleration / nu * (height[:, 0] * (depth - height[:, 0] / 2) - depth**2 * np.sum(missing, axis=1))


def film_discharge(time, acceleration, viscosity, depth, density=1000):
    """Its discharge, m^2/s: g sin(theta) H^3/(3 nu) in the end."""
    nu, m = viscosity / density, _odd(400) * math.pi / 2
    return acceleration * depth**3 / nu * (1 / 3 - 2 * np.sum(np.exp(-m**2 * nu * time / depth**2) / m**4))


def vortex_decay(viscosity, density, size):
    """Rate, 1/s, at which the velocity (sin kx cos ky, -cos kx sin ky), k = pi/L, decays: 2 nu k^2 (Taylor 1923). The convective
    terms are a gradient, and walls along cell borders of the pattern take no shear."""
    return 2 * viscosity / density * (math.pi / size)**2


def _least_over_circles(run_per_rise, depth, factor):
    """Least factor(angle, x, y, height of soil above, radius, x of the centre) over slip circles of a slope of height 1; see slip_circle_factor()."""
    def of(circle):
        start, end, half_angle = circle  # x of the start on the crest (0, 1) and beyond, x of the end on the slope or beyond its toe
        rise = 1 - max(1 - end / run_per_rise, 0)
        chord = math.hypot(end - start, rise)
        if start > 0 or end <= 0 or not 0 < half_angle < math.pi / 2:
            return 1e6
        radius = chord / (2 * math.sin(half_angle))
        x0 = (start + end + 2 * radius * math.cos(half_angle) * rise / chord) / 2
        y0 = 1 - rise / 2 + radius * math.cos(half_angle) * (end - start) / chord
        angle = np.linspace(math.asin(max((start - x0) / radius, -1.)), math.asin(min((end - x0) / radius, 1.)), 1000)
        x, y = x0 + radius * np.sin(angle), y0 - radius * np.cos(angle)
        height = np.clip(1 - x / run_per_rise, 0, 1) - y
        if y0 < 1 or np.trapz(height * (x0 - x), x) <= 0 or y.min() < 1 - depth - 1e-9:
            return 1e6
        return factor(angle, x, y, height, radius, x0)

    starts = [(start, end * run_per_rise, half_angle) for start in (-0.3, -1.) for end in (1., 1.6) for half_angle in (0.4, 0.9)]
    return min(optimize.minimize(of, start, method="Nelder-Mead", options={"xatol": 1e-6, "fatol": 1e-9, "maxiter": 2000}).fun for start in starts)


def slip_circle_factor(run_per_rise, depth, strength, strength_below):
    """Factor of safety of a slope of undrained clay: the least over slip circles of resisting over driving moment (Taylor 1937 with phi_u = 0).

    run_per_rise: 2 of a slope 2:1. depth: of the firm base below the crest, over the height of the slope. strength, strength_below: above and
    below the level of the toe, over the weight of its height, c_u/(gamma H)."""
    return _least_over_circles(run_per_rise, depth, lambda angle, x, y, height, radius, x0:
                               np.trapz(np.where(y > 0, strength, strength_below) * radius**2, angle) / np.trapz(height * (x0 - x), x))


def bishop_factor(run_per_rise, depth, cohesion, friction_angle):
    """Factor of safety of a dry slope by Bishop's simplified method (1955): the least F over slip circles of
    F = sum of (c + gamma h tan phi)/(cos a + sin a tan phi/F) dx over sum of gamma h sin a dx, where a is the slope of the circle.

    run_per_rise, depth: as of slip_circle_factor(). cohesion: over the weight of the height, c/(gamma H). friction_angle: phi, degrees."""
    tangent = math.tan(math.radians(friction_angle))

    def factor(angle, x, _, height, __, ___):
        def excess(value):
            return value * driving - np.trapz((cohesion + height * tangent) / (np.cos(angle) - np.sin(angle) * tangent / value), x)
        driving = np.trapz(height * -np.sin(angle), x)
        least = max(0.05, 1.01 * tangent * np.max(np.tan(angle)))  # where all denominators are positive
        return optimize.brentq(excess, least, 100.) if excess(least) < 0 < excess(100.) else 1e6
    return _least_over_circles(run_per_rise, depth, factor)

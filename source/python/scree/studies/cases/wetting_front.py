# SPDX-License-Identifier: LGPL-2.1-or-later
"""The text of its section: doc/studies/intro/wetting_front.md."""
import functools

import numpy as np
from scipy.integrate import solve_ivp

from scree.closed_forms import green_ampt_time
from scree.studies import BOUNDS, StabilityMap, Study, axis, classify, product, roughness

POND, DEPTH, TOP = 0.2, 0.3, 0.5  # m: the pond's height, the front at the end, the soil's surface
POROSITY = 0.4
GRAVITY, WATER, GRAINS = 9.81, 1000., 2650.  # m/s^2, kg/m^3, kg/m^3
MODULUS = 1e5  # Pa, Young's; Poisson's ratio is .3


METHODS = {"2 x 2": {"Soil/Points per cell": 2, "Water/Points per cell": 2},
           "4 x 4": {"Soil/Points per cell": 4, "Water/Points per cell": 4}}


def time_of(z, k):
    """When the sharp front is at depth z, s."""
    return green_ampt_time(z, POND, 0, POROSITY, k)


def fall_of(z):
    """How far the water's centre of mass has sunk when the sharp front is at depth z, m."""
    pond = POND - POROSITY * z
    return POND / 2 - (pond * pond / 2 - POROSITY * z * z / 2) / POND


@functools.cache
def rigid_front(k):
    """Depth of the sharp front in rigid soil, m, at time_of(DEPTH, k)."""
    def rate(_, state):
        z, u = state
        pond = POND - POROSITY * z
        push = GRAVITY * (pond + z) - (1 - POROSITY ** 2) * u * u / 2 - GRAVITY * POROSITY / k * u * z
        return [u, push / (z + POROSITY * pond)]
    return solve_ivp(rate, (0, time_of(DEPTH, k)), [0., 0.], "Radau", rtol=1e-10, atol=1e-12).y[0, -1]


@functools.cache
def elastic_front(k, young_modulus=MODULUS, n_cells=100):
    """Depth of the sharp front in elastic soil, in coordinates of the soil at the start, and fall of the water's centre
    of mass, m, at time_of(DEPTH, k).

    Unknowns: displacement s of the soil's cells (X is the depth), Z, and the velocity V of the pond, which is that of
    the mixture in the wet soil, v_s + n w. With n w = V - v_s and the water's -dp/dx = rho_w [D(v_s + w)/Dt - g + g/k
    (V - v_s)] each soil cell has an acceleration alpha + beta dV/dt, and p = 0 at the pond's surface and at the front
    tells dV/dt. All is explicit; the cell with the front is wet in part.
    """
    modulus = young_modulus * 0.7 / (1.3 * 0.4)  # oedometric
    width = TOP / n_cells
    n_steps = int(np.ceil(time_of(DEPTH, k) / min(0.4 * width / np.sqrt(modulus / ((1 - POROSITY) * GRAINS)), 3e-4)))
    step = time_of(DEPTH, k) / n_steps
    upper_faces = np.arange(n_cells) * width
    s, v, pond_velocity, front = np.zeros(n_cells), np.zeros(n_cells), 0., 0.
    porosity = np.full(n_cells, POROSITY)
    for _ in range(n_steps):
        # of the faces: no stress above, no motion below
        strain = np.concatenate([[0], np.diff(s) / width, [-2 * s[-1] / width]])
        ratio = 1 + (strain[1:] + strain[:-1]) / 2  # J
        before, porosity = porosity, 1 - (1 - POROSITY) / ratio
        wet = np.clip((front - upper_faces) / width, 0, 1)
        flux = pond_velocity - v
        slip = flux / porosity
        convected = slip / ratio * np.concatenate([[0], np.diff(v + slip) / width])
        convected -= slip * (porosity - before) / (step * porosity)
        push = convected - GRAVITY + GRAVITY / k * flux  # -dp/dx over rho_w, but for dv_s/dt (1 - 1/n) and dV/dt / n
        lever = wet * ratio * (1 - porosity) * WATER
        mass = (1 - POROSITY) * GRAINS - lever * (1 - 1 / porosity)
        alpha = (modulus * np.diff(strain) / width + lever * push
                 + wet * ratio * porosity * WATER * GRAVITY / k * flux) / mass
        beta = lever / (porosity * mass)
        pond = POND - np.sum(wet * ratio * porosity) * width
        at_inlet = GRAVITY * pond - slip[0] ** 2 * (1 - porosity[0] ** 2) / 2  # p there over rho_w, at rest
        force = at_inlet - np.sum(wet * ratio * (alpha * (1 - 1 / porosity) + push)) * width
        inertia = pond + np.sum(wet * ratio * (beta * (1 - 1 / porosity) + 1 / porosity)) * width
        rate = force / inertia
        v, pond_velocity = v + step * (alpha + beta * rate), pond_velocity + step * rate
        s = s + step * v
        tip = min(int(front / width), n_cells - 1)
        front += step * (pond_velocity - v[tip]) / (porosity[tip] * ratio[tip])
    volumes = wet * porosity * ratio * width
    depths = upper_faces + width / 2 + s - (1 - wet) * width * ratio / 2
    pond, top = POND - volumes.sum(), s[0] - width * (ratio[0] - 1) / 2
    return front, (pond * (top - pond / 2) + np.sum(volumes * depths)) / POND + POND / 2


def conductivity(k):
    end = float(time_of(DEPTH, k))
    return {"Water/Hydraulic conductivity": k, "End time": end, "Output/Interval": end,
            "Output/Statistics interval": end / 20}


def measure(run):
    """A run that stops is compared nowhere: its ratio is nan."""
    if not run.ended:
        return classify(run)
    water = run.points(None, "water")
    y, volumes = water.positions[:, 1], water.arrays["volume"]
    k = float(run.entries["Water/Hydraulic conductivity"])
    fall = TOP + POND / 2 - np.average(y, weights=volumes)
    front, exact = elastic_front(k)
    rough = roughness(water, float(run.entries["Mesh/Cell size"]), "pressure") / (WATER * GRAVITY * POND)
    return {**classify(run, {"oscillation of p": rough, "error": abs(fall / exact - 1)}), "fall/exact": fall / exact,
            "fall/rigid": fall / fall_of(rigid_front(k)), "fall/Green & Ampt": fall / fall_of(DEPTH),
            "front/exact": (TOP - np.quantile(y, 0.01)) / front}


def verdict(rows, claim):
    ended = rows.where(ended=True)
    few, many = ended.where(points="2 x 2"), ended.where(points="4 x 4")
    conductivities, sizes = (sorted(set(ended.values[name]), reverse=True) for name in ("k", "h"))
    largest, coarse, fine = conductivities[0], sizes[0], sizes[-1]

    def off(chosen, name="fall/exact"):
        return max(abs(value - 1) for value in chosen.values[name])

    def gain(chosen):
        """Mean, over the energy released."""
        return sum(chosen.values["gain"]) / chosen.n

    errors = {h: off(many.where(h=h)) for h in sizes}
    fronts = many.where(h=fine).span["front/exact"]
    inertia = abs(fall_of(rigid_front(1e-3)) / fall_of(DEPTH) - 1)
    stiff = abs(elastic_front(largest, 100 * MODULUS)[1] / fall_of(rigid_front(largest)) - 1)
    alike = many.where(lambda row: row["h"] >= 0.025)
    claim = claim.shared(rows=rows, ended=ended, many=many, few=few, fine=fine, coarse=coarse,
                         conductivities=conductivities)
    return [
        claim("fall", errors[fine] < 0.03, quick=False, largest=max(errors.values()), sizes=sizes,
              errors=list(errors.values()), rigid=off(many, "fall/rigid"), green_ampt=off(many, "fall/Green & Ampt")),
        claim("reference", inertia < 1e-5 and stiff < 1e-3, inertia=inertia, stiff=stiff,
              falls=[elastic_front(k)[1] / fall_of(DEPTH) for k in conductivities],
              rigid=[fall_of(rigid_front(k)) / fall_of(DEPTH) for k in conductivities]),
        claim("tip", 0.95 < fronts.low and fronts.high < 1.05, fronts=fronts),
        claim("gain", gain(alike) < gain(few) and many.largest["gain"] < BOUNDS["gain"], gain_of_few=gain(few),
              gain_of_many=gain(alike)),
        claim("end", ended.n == rows.n),
        claim("points", off(few.where(h=coarse)) > errors[coarse], error_of_few=off(few.where(h=coarse)),
              error_of_many=errors[coarse])]


STUDY = Study(
    "prm/seepage/saturated_rest.prm", needs_end=False,
    entries={"Mesh/Upper corner": "0.2, 0.8", "Soil/Region": f"y < {TOP}",
             "Soil/Linear elastic/Young's modulus": MODULUS,
             "Water/Region": f"y > {TOP} && y < {TOP + POND}", "Water/Initial pressure": "none"},
    variants=product(axis("points", METHODS.get, list(METHODS)),
                     axis("h", "Mesh/Cell size", [0.1, 0.05, 0.025, 0.0125]),
                     axis("k", conductivity, [0.1, 0.03, 0.01])),
    quick=lambda labels: (labels["h"] in (0.1, 0.025) and labels["k"] == 0.03)
    or list(labels.values()) == ["4 x 4", 0.0125, 0.1], default={"points": "4 x 4"},
    chart=StabilityMap("k", "h", panels=["points"], xlabel="k (m/s)", ylabel="cell size (m)"))

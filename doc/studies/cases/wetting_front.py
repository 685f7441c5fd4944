"""Water infiltrates dry soil from a pond: 0.2 m of water stand on 0.5 m of dry elastic sand and sink in, with no capillary suction. With a sharp
front at depth z and saturated soil above it, n dz/dt = k (h + z)/z, h = h_0 - n z (Green & Ampt 1911, falling head), or
t = n/k [z/(1-n) - h_0/(1-n)^2 ln(1 + (1-n) z/h_0)]. Runs end when z = 0.3 m. Rows and columns: cell size and conductivity; panels: 2 x 2 or 4 x 4 points a cell, and `Divergence = flux`.
State: `measures.BOUNDS`; the oscillation of p is its roughness at the end (`measures.roughness`) over rho_w g h_0, the error that of the fall of the water's
centre of mass, over the exact one. The number is that fall over the exact one. `wetting_front_before.csv` and `.png` are the same runs before a solve
that takes too long made its preconditioner anew, with states by the bound of then, .1 for the fall."""
import numpy as np

from charts import StabilityMap
from measures import cause, classify, roughness
from study import Claim, Study, axis, product

POND, DEPTH, POROSITY, TOP = 0.2, 0.3, 0.4, 0.5  # m, m, -, m: the pond's height, the front at the end, the soil's surface


METHODS = {"2 x 2": {"Soil/Points per cell": 2, "Water/Points per cell": 2}, "4 x 4": {"Soil/Points per cell": 4, "Water/Points per cell": 4},
           "4 x 4, flux": {"Soil/Points per cell": 4, "Water/Points per cell": 4, "Water/Pressure/Divergence": "flux"}}


def time_of(z, k):
    """When the sharp front is at depth z, s."""
    return POROSITY / k * (z / (1 - POROSITY) - POND / (1 - POROSITY) ** 2 * np.log(1 + (1 - POROSITY) * z / POND))


def fall_of(z):
    """How far the water's centre of mass has sunk when the sharp front is at depth z, m."""
    pond = POND - POROSITY * z
    return POND / 2 - (pond * pond / 2 - POROSITY * z * z / 2) / POND


def conductivity(k):
    end = float(time_of(DEPTH, k))
    return {"Water/Hydraulic conductivity": k, "End time": end, "Output/Interval": end, "Output/Statistics interval": end / 20}


def measure(run):
    """A run that stops is compared nowhere: its ratio is nan."""
    if not run.ended:
        return {**classify(run), "cause": cause(run)}
    water = run.points(None, "water")
    y, volumes = water.positions[:, 1], water.arrays["volume"]
    ratio = (TOP + POND / 2 - np.average(y, weights=volumes)) / fall_of(DEPTH)
    rough = roughness(water, float(run.entries["Mesh/Cell size"]), "pressure") / (1000 * 9.81 * POND)
    return {**classify(run, {"oscillation of p": rough, "error": abs(ratio - 1)}), "cause": cause(run), "fall/exact": ratio,
            "front/exact": (TOP - np.quantile(y, 0.01)) / DEPTH, "volume error": max(run.statistics("Volume error (-)"))}


def verdict(rows):
    def of(method):
        return [row for row in ended if row["points"] == method]

    def gain(chosen):
        return 100 * sum(row["gain"] for row in chosen) / len(chosen)
    ended = [row for row in rows if row["ended"]]
    fine, coarse = (pick(row["h"] for row in ended) for pick in (min, max))
    errors = {h: [abs(row["fall/exact"] - 1) for row in of("4 x 4") if row["h"] == h] for h in sorted({row["h"] for row in ended})}
    fronts = [row["front/exact"] for row in of("4 x 4") if row["h"] == fine]
    few = [abs(row["fall/exact"] - 1) for row in of("2 x 2") if row["h"] == coarse]
    alike = [row for row in of("4 x 4") if any(other["h"] == row["h"] for other in of("4 x 4, flux"))]
    return [
        Claim(f"With 4 x 4 points a cell the water's fall is off from Green & Ampt's by up to {max(map(max, errors.values())):.1%}: "
              + ", ".join(f"{max(error):.1%} at h = {h:g} m" for h, error in reversed(errors.items())) + ".", max(errors[fine]) < 0.1),
        Claim(f"The front is not sharp: at h = {fine:g} m its tip (99 % of the water is above it) is at {min(fronts):.2f} to {max(fronts):.2f} of the sharp "
              "front's depth. A layer of water thinner than about a cell flows on without the drag of full pores.", 1 < max(fronts) < 1.3),
        Claim(f"Energy comes from nothing where water enters dry soil: {gain(of('2 x 2')):.2g} % of what its fall releases with 2 x 2 points a cell, "
              f"{gain(alike):.2g} % with 4 x 4, {gain(of('4 x 4, flux')):.2g} % with Divergence = flux (means). By default p does work on the moving surface, as its gradient is not the "
              "adjoint of the divergence, which is not integrated by parts; some of the gain remains with flux, which holds free water back: the fall is then off by up to "
              f"{max(abs(row['fall/exact'] - 1) for row in of('4 x 4, flux')):.0%}, against {max(abs(row['fall/exact'] - 1) for row in alike):.0%}.",
              gain(of("4 x 4, flux")) < gain(alike) < gain(of("2 x 2"))),
        Claim(f"{len(ended)} of {len(rows)} runs come to their end.", len(ended) == len(rows)),
        Claim(f"At h = {coarse:g} m two points a cell and axis are off by up to {max(few):.0%}, four by {max(errors[coarse]):.0%}.", max(few) > max(errors[coarse])),
    ]


STUDY = Study(title="Infiltration into dry soil", base="prm/saturated_rest.prm", needs_end=False,
              entries={"Mesh/Upper corner": "0.2, 0.8", "Soil/Region": f"y < {TOP}", "Soil/Linear elastic/Young's modulus": 1e5,
                       "Water/Region": f"y > {TOP} && y < {TOP + POND}", "Water/Initial pressure": "none"},
              variants=product(axis("points", METHODS.get, list(METHODS)[:2]), axis("h", "Mesh/Cell size", [0.1, 0.05, 0.025, 0.0125]),
                               axis("k", conductivity, [0.1, 0.03, 0.01]))
              + product(axis("points", METHODS.get, list(METHODS)[2:]), axis("h", "Mesh/Cell size", [0.1, 0.05, 0.025]),
                        axis("k", conductivity, [0.1, 0.03, 0.01])),
              quick=lambda labels: (labels["h"] in (0.1, 0.025) and labels["k"] == 0.03) or list(labels.values()) == ["4 x 4", 0.0125, 0.1],
              measure=measure, verdict=verdict, default={"points": "4 x 4"},
              chart=StabilityMap("k", "h", panels=["points"], number="fall/exact", xlabel="k, m/s", ylabel="cell size, m"))

"""Water infiltrates dry soil from a pond: 0.2 m of water stand on 0.5 m of dry elastic sand and sink in, with no capillary suction. With a sharp
front at depth z and saturated soil above it, n dz/dt = k (h + z)/z, h = h_0 - n z (Green & Ampt 1911, falling head), or
t = n/k [z/(1-n) - h_0/(1-n)^2 ln(1 + (1-n) z/h_0)]. Runs end when z = 0.3 m. Rows and columns: cell size and conductivity; panels: points a cell and axis.
State: `measures.classify`; oscillating if p at the end is rough (`measures.roughness`) by more than a tenth of rho_w g h_0, wrong if the infiltrated depth is
off by more than a tenth. The number is that depth (the pond's lost water over n) over the exact one."""
import numpy as np

from charts import StabilityMap
from measures import cause, classify, energy_gain, roughness
from study import Claim, Study, axis, product

POND, DEPTH, POROSITY, TOP = 0.2, 0.3, 0.4, 0.5  # m, m, -, m: the pond's height, the front at the end, the soil's surface


def time_of(z, k):
    """When the sharp front is at depth z, s."""
    return POROSITY / k * (z / (1 - POROSITY) - POND / (1 - POROSITY) ** 2 * np.log(1 + (1 - POROSITY) * z / POND))


def conductivity(k):
    end = float(time_of(DEPTH, k))
    return {"Water/Hydraulic conductivity": k, "End time": end, "Output/Interval": end, "Output/Statistics interval": end / 20}


def measure(run):
    """A run that stops is compared nowhere: its ratio is nan."""
    result = {"state": classify(run, scatter=0., column="^p oscillation"), "cause": cause(run)}
    if not run.ended:
        return result
    water = run.points(None, "water")
    y, volumes = water.positions[:, 1], water.arrays["volume"]
    ratio = np.sum(volumes[y < TOP]) / (0.2 * POROSITY * DEPTH)
    rough = roughness(water, float(run.entries["Mesh/Cell size"]), "pressure") / (1000 * 9.81 * POND)
    state = classify(run, scatter=rough, error=abs(ratio - 1), tolerance=0.1)
    return {**result, "state": state, "depth/exact": ratio, "front/exact": (TOP - np.quantile(y, 0.01)) / DEPTH, "gain, %": 100 * energy_gain(run),
            "roughness of p": rough, "volume error": max(run.statistics("^volume error"))}


def verdict(rows):
    ended = [row for row in rows if row["ended"]]
    fine = min(row["h"] for row in ended)
    errors = {h: [abs(row["depth/exact"] - 1) for row in ended if row["h"] == h and row["points"] == 4] for h in sorted({row["h"] for row in ended})}
    fronts = [row["front/exact"] for row in ended if row["h"] == fine and row["points"] == 4]
    return [
        Claim(f"{len(ended)} of {len(rows)} runs come to their end.", len(ended) == len(rows)),
        Claim("With 4 x 4 points a cell the infiltrated depth comes nearer to Green & Ampt's with finer cells: off by at most "
              + ", ".join(f"{max(error):.1%} at h = {h:g} m" for h, error in errors.items()) + ". Too much goes in, not too little: a layer of water thinner than "
              "about a cell flows on without the drag of full pores.", max(errors[fine]) < max(errors[max(errors)]) / 1.5),
        Claim(f"The front is not sharp: at h = {fine:g} m its tip (99 % of the water is above it) is at {min(fronts):.2f} to {max(fronts):.2f} of the sharp "
              "front's depth.", max(fronts) < 1.3),
        Claim("Two points a cell and axis are too few: they put up to "
              f"{max(row['depth/exact'] for row in ended if row['points'] == 2):.2f} of the exact depth into the soil.",
              max(row["depth/exact"] for row in ended if row["points"] == 2) > 1.1),
    ]


STUDY = Study(title="Infiltration into dry soil", base="prm/saturated_rest.prm", needs_end=False,
              entries={"Mesh/Upper corner": "0.2, 0.8", "Soil/Region": f"y < {TOP}", "Soil/Linear elastic/Young's modulus": 1e5,
                       "Water/Region": f"y > {TOP} && y < {TOP + POND}", "Water/Initial pressure": "none"},
              variants=product(axis("points", lambda n: {"Soil/Points per cell": n, "Water/Points per cell": n}, [2, 4]),
                               axis("h", "Mesh/Cell size", [0.1, 0.05, 0.025, 0.0125]), axis("k", conductivity, [0.1, 0.03, 0.01])),
              quick=lambda labels: labels["h"] in (0.1, 0.025) and labels["k"] == 0.03,
              measure=measure, verdict=verdict,
              chart=StabilityMap("k", "h", panels=["points"], number="depth/exact", xlabel="k, m/s", ylabel="cell size, m"))

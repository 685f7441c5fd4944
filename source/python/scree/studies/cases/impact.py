# SPDX-License-Identifier: LGPL-2.1-or-later
"""The text of its section: doc/studies/intro/impact.md."""
import numpy as np

from scree.studies.charts import StabilityMap
from scree.studies.measures import BOUNDS, classify, roughness
from scree.studies.study import Claim, Study, axis, product

HEAD = 1000 * 9.81 * 0.5  # Pa


def speed(v):
    velocity = f"0; {-v}"
    return {"Soil/Initial velocity": velocity, "Water/Initial velocity": velocity, "End time": 0.1 / v + 0.3}


def measure(run):
    water = run.points(None, "water")
    rough = roughness(water, float(run.entries["Mesh/Cell size"]), "pressure") / HEAD
    # From 0.1 m above the floor, with the momentum of the start and of free fall.
    momentum, speed_at_start = np.asarray(run.statistics("Momentum y (N s)")), run.labels["v"]
    speed_at_touch = (speed_at_start**2 + 2 * 9.81 * 0.1)**0.5
    later = (speed_at_touch - speed_at_start) / 9.81 + 0.1
    mass = -momentum[0] / speed_at_start
    impulse = 1 + np.interp(later, run.statistics("Time (s)"), momentum) / (mass * speed_at_touch)
    return {**classify(run, {"oscillation of p": rough}), "impulse": impulse, "peak p, kPa": 1e-3 * max(run.statistics("Largest p (Pa)")), "volume error": max(run.statistics("Volume error (-)"))}


def verdict(rows):
    ended = [row for row in rows if row["ended"]]
    spray = [row for row in rows if row["state"] == "J out of bounds"]
    rest = max((row["v"] for row in rows if row not in spray and row["v"] < max(row["v"] for row in rows)), default=0.)

    def pairs(quantity):
        """A quantity on the coarse and on the fine mesh."""
        fine = {(row["k"], row["v"]): row[quantity] for row in rows if row["h"] == min(row["h"] for row in rows)}
        return [(row[quantity], fine[row["k"], row["v"]]) for row in rows if row["h"] == 0.1]
    mean = sum(row["oscillation of p"] for row in rows) / len(rows)
    changes = [abs(b - a) for a, b in pairs("impulse")]
    ratios = [b / a for a, b in pairs("peak p, kPa")]
    return [
        Claim(f"p oscillates after the impact by {mean:.2g} rho_w g 0.5 m (RMS) in the mean, by up to {max(row['oscillation of p'] for row in rows):.2g}. The row of "
              "points that the impact has compressed carries pore pressure instead of effective stress, and at small k it cannot drain. "
              f"Bound of a map: {BOUNDS['oscillation of p']:g} for each impact, which is missed.", max(row["oscillation of p"] for row in rows) < 1.2),
        Claim(f"From h = 0.1 to 0.05 m the impulse changes by up to {max(changes):.2g} of the momentum, in the mean by {sum(changes) / len(changes):.2g}. The peak of p "
              f"changes by a factor of {min(ratios):.2g} to {max(ratios):.2g}, without a trend. Report the impulse; the peak is not a result.",
              max(changes) < 0.1 and max(ratios) > 1.5, quick=False),
        Claim(f"Single points of soil open beyond the bound in the spray of {max(row['v'] for row in rows):g} m/s (J up to {max(row['largest J'] for row in spray):.0f}, {len(spray)} of "
              f"{len(rows)} runs); up to {rest:g} m/s none does.", len(spray) > 0 and all(row["v"] > rest for row in spray), quick=False) if spray else
        Claim("No point's volume leaves its bounds.", True),
        Claim(f"{len(ended)} of {len(rows)} impacts run to their end, up to {max(row['v'] for row in rows):g} m/s. None gains more than "
              f"{100 * max(row['gain'] for row in rows):.2g} % of the energy released (bound {100 * BOUNDS['gain']:g} %); "
              f"no cell is overfull by more than {max(row['volume error'] for row in rows):.0%} of the volume.",
              len(ended) == len(rows) and max(row["gain"] for row in rows) < BOUNDS["gain"]),
    ]


STUDY = Study(title="Impact of a saturated block",
              question="Which results of an impact of saturated soil can be used?",
              advice="Report the impulse, not the peak of p.",
              base="prm/columns/column_saturated.prm", needs_end=False,
              entries={"Soil/Region": "x > 0.5 && x < 1.5 && y > 0.1 && y < 0.6", "Soil/Initial state/Type": "none", "Soil/Initial state/K0": "auto", "Water/Initial pressure": "none",
                       "Mesh/Upper corner": "2, 1.5", "Soil/Points per cell": 3, "Water/Points per cell": 3, "Output/Interval": 0.1,
                       "Output/Statistics interval": 0.002},
              variants=product(axis("h", "Mesh/Cell size", [0.1, 0.05]), axis("k", "Water/Hydraulic conductivity", [1e-1, 1e-2, 1e-3, 1e-5]),
                               axis("v", speed, [0.5, 1., 2., 5., 10.])),
              quick=lambda labels: labels["h"] == 0.1 and labels["k"] in (1e-1, 1e-5) and labels["v"] in (1., 10.),
              measure=measure, verdict=verdict, default={},
              chart=StabilityMap("v", "k", panels=["h"], xlabel="speed (m/s); h in m", ylabel="k (m/s)"))

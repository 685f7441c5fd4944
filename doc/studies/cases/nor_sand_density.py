"""Collapse of a small column of Nor-Sand, 1 m x 1 m, from very dense to very loose, with each stabilisation, dry and saturated. The critical state at the
column's mean pressure of 5 kPa has a specific volume of 1.78; v_0 = 1.5 is denser than any sand.
State: `measures.classify`; J out of bounds: a point's volume is halved or doubled; oscillating: the `Stress oscillation` is above .5 (time mean; p' of points without stabilisation scatters
by .7 and more of its mean in a collapse). The number is that oscillation."""
from charts import StabilityMap
from measures import classify, energy_gain, mean_oscillation, volume_ratios
from study import Claim, Study, axis, product, transfer


def water(kind):
    if kind == "dry":
        return {}
    return {"Soil/Initial porosity": 0.4, "Water/Region": "same", "Water/Points per cell": 3, "Water/Hydraulic conductivity": 5e-3,
            **transfer("TPIC"), "Time step/Maximum time step": 1e-3}


def measure(run):
    smallest, largest = volume_ratios(run)
    return {"state": classify(run, column="Stress oscillation (-)", oscillation=0.5, volume_ratio=(0.5, 2.)),
            "stress oscillation": mean_oscillation(run, "Stress oscillation (-)"), "gain, %": 100 * energy_gain(run), "smallest J": smallest, "largest J": largest,
            "largest effective stress, kPa": 1e-3 * max(run.statistics("Largest effective stress (Pa)")), "front, m": run.statistics("Front 99 % (m)")[-1],
            "unresolved": run.statistics("Unresolved")[-1]}


def verdict(rows):
    def of(stabilisation):
        return [row for row in rows if row["F-bar"] == stabilisation]

    def count(stabilisation, state):
        return sum(row["state"] == state for row in of(stabilisation))
    modified, none, standard = map(of, ("modified", "none", "standard"))
    loose = [row["v_0"] for row in modified if row["state"] == "oscillating" and row["pores"] == "saturated" and row["v_0"] > 1.78]
    bad = len(standard) - count("standard", "stable") - count("standard", "oscillating")
    return [
        Claim(f"With the modified F-bar (the default) {count('modified', 'stable')} of {len(modified)} columns are stable, v_0 from {min(row['v_0'] for row in rows):g} to "
              f"{max(row['v_0'] for row in rows):g}, dry and saturated; none gains energy or volume" + (
                  f". Exceptions: saturated, v_0 = {', '.join(f'{v:g}' for v in loose)}, where the sand is looser than critical and liquefies: the mean of p' "
                  "falls towards 0, and scatter over it grows" if loose else "") + ".",
              count("modified", "stable") + len(loose) == len(modified) and len(loose) < 2),
        Claim(f"Without stabilisation none breaks, but p' scatters in {count('none', 'oscillating')} of {len(none)} (mean {min(row['stress oscillation'] for row in none):.2g} to "
              f"{max(row['stress oscillation'] for row in none):.2g}).", count("none", "oscillating") + count("none", "stable") == len(none) and count("none", "oscillating") > 0),
        Claim(f"The standard F-bar gains energy, loses the volumes or breaks in {bad} of {len(standard)}, worst at {max(standard, key=lambda row: row['stress oscillation'])['v_0']:g}: "
              f"up to {max(row['gain, %'] for row in standard):.2g} % of the energy released.", bad > 0.5 * len(standard)),
        Claim(f"The return map leaves {sum(row['unresolved'] for row in rows):g} updates unresolved.", sum(row["unresolved"] for row in rows) == 0),
    ]


STUDY = Study(title="Density of Nor-Sand", base="prm/column_loose.prm", needs_end=False,
              entries={"Mesh/Upper corner": "2.5, 1.2", "Mesh/Cell size": 0.1, "Soil/Points per cell": 3, "End time": 1., "Output/Interval": 0.25,
                       "Output/Statistics interval": 0.02},
              variants=product(axis("pores", water, ["dry", "saturated"]), axis("F-bar", "Stabilisation/F-bar", ["none", "standard", "modified"]),
                               axis("v_0", "Soil/Nor-Sand/Initial specific volume", [1.5, 1.55, 1.63, 1.7, 1.78, 1.85])),
              quick=lambda labels: labels["pores"] == "dry" and labels["v_0"] in (1.55, 1.85),
              measure=measure, verdict=verdict,
              chart=StabilityMap("v_0", "F-bar", panels=["pores"], number="stress oscillation", xlabel="initial specific volume"))

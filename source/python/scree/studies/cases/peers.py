# SPDX-License-Identifier: LGPL-2.1-or-later
"""Nanoseconds of one core per point and time step, of the benchmarks of Scree and of other public codes.

Right after each run, `doc/studies/kernel.cc` is run on the same core: the bare method for one elastic block.
The ratio to it depends little on the machine.
Numbers of the other codes are in `doc/studies/reference/peers.csv`.
They were measured once on a machine of the same kind, built from public sources with their own release flags, with 16 points per cell in 2D.
The kernel there was another, simpler one.
Scree has 16 points per cell in 2D and 8 in 3D.
Its water has points of its own: points are those of soil and water together, while each point of the other code carries both.
"""

import math
import subprocess

from scree.studies.charts import Curves
from scree.studies.study import Claim, Study, Variant, compiled, reference_rows

SCENES = {"elastic 2D": "elastic_2d", "elastic 3D": "elastic_3d", "Mohr-Coulomb 3D": "mohr_coulomb_column_3d", "Nor-Sand 2D": "nor_sand_slope_2d",
          "Nor-Sand 3D": "nor_sand_column_3d", "soil and water 2D": "nor_sand_saturated_slope_2d", "soil and water 3D": "nor_sand_saturated_column_3d"}
LIKE = {"two-phase semi-implicit single-point 2D": "soil and water 2D", "slope failure 3D code": "Mohr-Coulomb 3D",
        "Drucker-Prager 3D": "Mohr-Coulomb 3D", "elastic 2D re-binned": "elastic 2D", "elastic 3D re-binned": "elastic 3D"}
WANTED = {"elastic 2D": 45, "elastic 3D": 110, "Nor-Sand 2D": 85, "Nor-Sand 3D": 170, "soil and water 2D": 135}  # ns with AVX-512; of soil and water half of a pair


def kernel():
    """The yardstick."""
    return compiled("kernel.cc", "c++", "-std=gnu++17", "-O3", "-march=native", "-ffast-math")


def measure(run):
    dimension = run.labels["scene"][-2]
    words = subprocess.run([kernel(), dimension], check=True, capture_output=True, text=True).stdout.split()
    ns = float(words[4])
    return {"kernel ns": ns, "over kernel": run.cost["ns per point and step"] / ns}


def peers():
    """Rows of the other codes, with the scene that they are set beside."""
    return [{**row, "beside": LIKE.get(row["scene"], row["scene"])} for row in reference_rows("peers")]


def verdict(rows):
    slowest = max(rows, key=lambda row: row["over kernel"])
    claims = [Claim(f"Scree takes {min(row['over kernel'] for row in rows):.1f} to {slowest['over kernel']:.1f} times the time of the bare kernel, most for {slowest['scene']}.",
                    all(math.isfinite(row["over kernel"]) for row in rows),
                    table=[("scene", "ns per point and time step", "over the kernel"),
                           *((row["scene"], f"{row['ns per point and step']:.0f}", f"{row['over kernel']:.1f}") for row in rows)])]
    factors = {}
    for row in rows:
        others = [float(peer["ns_low"]) for peer in peers() if peer["beside"] == row["scene"] and "kernel" not in peer["code"]]
        if others:
            factors[row["scene"]] = min(others) / row["ns per point and step"]
    claims.append(Claim("The fastest other code, at its best and with any basis, takes " + ", ".join(f"{factor:.1f} ({scene})" for scene, factor in factors.items())
                        + " times as long.", min(factors.values()) > 1))
    slow = [f"{row['scene']} {row['ns per point and step']:.0f} ({WANTED[row['scene']]})" for row in rows
            if row["scene"] in WANTED and row["ns per point and step"] > WANTED[row["scene"]]]
    claims.append(Claim(f"Above the bound: {'; '.join(slow)}." if slow else "All scenes are within their bounds of speed.", not slow, quick=False))
    return claims


def draw(figure, rows):
    axes = figure.subplots()
    bars = []
    for row in rows:
        ns = row["ns per point and step"]
        bars.append((f"{row['scene']}: Scree", ns, ns, "C3"))
        beside = sorted((peer for peer in peers() if peer["beside"] == row["scene"]), key=lambda peer: float(peer["ns_low"]))
        bars += [(f"{peer['code']}, {peer['basis']}" + ("" if peer["scene"] == row["scene"] else f" ({peer['scene']})"), float(peer["ns_low"]), float(peer["ns_high"]),
                  "0.8" if "kernel" in peer["code"] else "C0") for peer in beside]
        if row["scene"].startswith("elastic"):
            bars.append(("doc/studies/kernel.cc, beside the run", row["kernel ns"], row["kernel ns"], "0.6"))
    for line, (_, low, high, colour) in enumerate(bars):
        axes.barh(-line, high, color=colour, alpha=0.5 if high > low else 1.)
        axes.barh(-line, low, color=colour)
        axes.text(high * 1.05, -line, f"{low:.0f}" + (f" to {high:.0f}" if high > low else ""), va="center", fontsize="x-small")
    axes.set_yticks([-line for line in range(len(bars))], [name for name, *_ in bars], fontsize="x-small")
    axes.set(xscale="log", xlabel="ns of one core per point and step", xlim=(10, 30000))


STUDY = Study(title="Speed beside other codes", base="prm/benchmarks/elastic_2d.prm", measure=measure, verdict=verdict,
              variants=[Variant({"scene": scene}, {}, f"prm/benchmarks/{name}.prm") for scene, name in SCENES.items()],
              quick=lambda labels: labels["scene"] == "elastic 2D", chart=Curves(draw, size=(10, 9), timed=True))

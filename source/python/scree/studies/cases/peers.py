# SPDX-License-Identifier: LGPL-2.1-or-later
"""The text of its section: doc/studies/intro/peers.md."""

import math
import subprocess

from scree.studies import NoChart, Study, Variant, compiled, reference_rows

NS = "ns per point and step"
SCENES = {"elastic 2D": "elastic_2d", "elastic 3D": "elastic_3d", "Mohr-Coulomb 3D": "mohr_coulomb_column_3d",
          "Nor-Sand 2D": "nor_sand_slope_2d",
          "Nor-Sand 3D": "nor_sand_column_3d", "soil and water 2D": "nor_sand_saturated_slope_2d",
          "soil and water 3D": "nor_sand_saturated_column_3d"}
LIKE = {"two-phase semi-implicit single-point 2D": "soil and water 2D", "slope failure 3D code": "Mohr-Coulomb 3D",
        "Drucker-Prager 3D": "Mohr-Coulomb 3D", "elastic 2D re-binned": "elastic 2D",
        "elastic 3D re-binned": "elastic 3D"}
# ns with AVX-512; of soil and water half of a pair
WANTED = {"elastic 2D": 45, "elastic 3D": 110, "Nor-Sand 2D": 85, "Nor-Sand 3D": 170, "soil and water 2D": 135}


def measure(run):
    dimension = run.labels["scene"][-2]
    yardstick = compiled("kernel.cc", "c++", "-std=gnu++17", "-O3", "-march=native", "-ffast-math")
    words = subprocess.run([yardstick, dimension], check=True, capture_output=True, text=True).stdout.split()
    ns = float(words[4])
    return {"kernel ns": ns, "over kernel": run.cost[NS] / ns}


def fastest_peer(scene):
    """The smallest ns per point and step of another code beside a scene, None without one."""
    return min((float(peer["ns_low"]) for peer in reference_rows("peers")
                if LIKE.get(peer["scene"], peer["scene"]) == scene and "kernel" not in peer["code"]), default=None)


def table(rows):
    def beside(row):
        fastest = fastest_peer(row["scene"])
        return (f"{fastest:.0f}", f"{fastest / row[NS]:.1f}") if fastest else ("-", "-")
    return [("scene", "Scree (ns per point and time step)", "over the bare kernel", "fastest other code (ns)",
             "over Scree"),
            *((row["scene"], f"{row[NS]:.0f}", f"{row['over kernel']:.1f}", *beside(row)) for row in rows)]


def verdict(rows, claim):
    factors = {row["scene"]: fastest / row[NS] for row in rows if (fastest := fastest_peer(row["scene"]))}
    slow = [f"{row['scene']} {row[NS]:.0f} ({WANTED[row['scene']]})" for row in rows
            if row[NS] > WANTED.get(row["scene"], math.inf)]
    claim = claim.shared(rows=rows, slowest=rows.with_largest("over kernel"), factors=factors, slow="; ".join(slow))
    return [claim("kernel", all(map(math.isfinite, rows.values["over kernel"]))),
            claim("other codes", min(factors.values()) > 1),
            claim("slow" if slow else "fast", not slow, quick=False)]


STUDY = Study(
    "prm/benchmarks/elastic_2d.prm",
    variants=[Variant({"scene": scene}, {}, f"prm/benchmarks/{name}.prm") for scene, name in SCENES.items()],
    quick=lambda labels: labels["scene"] == "elastic 2D", chart=NoChart(timed=True))

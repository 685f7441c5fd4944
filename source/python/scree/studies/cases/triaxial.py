# SPDX-License-Identifier: LGPL-2.1-or-later
"""One material point of Nor-Sand under triaxial compression with the parameters of Xie, Navas & Lopez-Querol 2024, Table 1 (v_0 = 1.629 dense, 1.736 loose).
The start is an isotropic stress of 10 or 100 kPa on the yield surface; the chart shows 100 kPa.
Their curves of discrete element tests are only in figures; nothing is compared with them.
Assumed are a reference pressure of 1 Pa of the critical state line (with 1 kPa loose sand would dilate) and no overconsolidation at the start.
Without curves the theory can be checked: both sands must come to the same critical state, M and v_c = v_c0 - lambda ln(p'/p_ref).
Strains are logarithmic, compression positive, and q = sigma_1 - sigma_3; undrained tests hold the volume.
"""
import numpy as np

from scree import results
from scree.studies.charts import RunCurves, legend_above, tick_axis
from scree.studies.study import Claim, Study, axis, product

SOILS = {"dense": 1.629, "loose": 1.736}
M, CRITICAL_VOLUME, COMPRESSION_INDEX = 0.7097, 1.88, 0.012


def critical_volume(pressure):
    return CRITICAL_VOLUME - COMPRESSION_INDEX * np.log(pressure)


def measure(run):
    columns = results.read_element_table(run.folder / "table.txt")
    strain, ratio, pressure = columns["strain"], columns["stress_ratio"], columns["mean_pressure"]
    peak = np.argmax(ratio)
    return {"peak stress ratio": ratio[peak], "strain at peak": strain[peak], "stress ratio at the end": ratio[-1], "effective stress at the end (kPa)": 1e-3 * pressure[-1],
            "smallest effective stress (kPa)": 1e-3 * np.min(pressure), "v at the end": columns["specific_volume"][-1],
            "v beyond critical at the end": columns["specific_volume"][-1] - critical_volume(pressure[-1]),
            "smallest volume ratio": np.min(columns["volume_ratio"]), "volume ratio at the end": columns["volume_ratio"][-1]}


def verdict(rows):
    def row(path, soil, pressure=100):
        return next(row for row in rows if (row["path"], row["soil"], row["confining pressure (kPa)"]) == (path, soil, pressure))

    drained = [row for row in rows if row["path"] == "drained"]
    off_ratio = max(abs(row["stress ratio at the end"] / M - 1) for row in drained)
    off_volume = max(abs(row["v beyond critical at the end"]) for row in drained)
    dense, loose = row("drained", "dense"), row("drained", "loose")
    closed, open_ = row("undrained", "loose"), row("undrained", "dense")
    return [
        Claim(f"Drained, dense and loose sand come to one critical state: q/p' ends within {100 * off_ratio:.1f} % of M, v within {off_volume:.4f} of "
              f"the critical one, where they began {SOILS['loose'] - SOILS['dense']:.3f} apart.", holds=off_ratio < 0.02 and off_volume < 0.005),
        Claim(f"Dense sand has a peak, q/p' = {dense['peak stress ratio']:.2f} at {100 * dense['strain at peak']:.1f} % and 100 kPa, and grows by "
              f"{100 * (dense['volume ratio at the end'] - 1):.1f} %; loose sand has nearly none ({loose['peak stress ratio']:.2f}, "
              f"{100 * (loose['volume ratio at the end'] - 1):.2f} %).",
              holds=dense["peak stress ratio"] > 1.3 * M and loose["peak stress ratio"] < 1.1 * M and loose["volume ratio at the end"] < 1.01),
        Claim(f"Undrained from 100 kPa, the loose sand loses {100 - closed['smallest effective stress (kPa)']:.0f} % of its p' at first but ends at "
              f"{closed['effective stress at the end (kPa)']:.0f} kPa: with these parameters it does not liquefy.",
              holds=closed["smallest effective stress (kPa)"] < 75 and closed["effective stress at the end (kPa)"] > 100),
        Claim(f"The dense sand reaches {1e-3 * open_['effective stress at the end (kPa)']:.1f} MPa at 20 %, far beyond the suction at which water cavitates. In a "
              "saturated slope the inflow of water decides, not the undrained strength.", holds=open_["effective stress at the end (kPa)"] > 1000),
    ]


def table(rows):
    return [("path, soil, pressure", "peak q/p'", "q/p' at the end, M = 0.71", "p' at the end (kPa)", "v over critical"),
            *((f"{row['path']}, {row['soil']}, {row['confining pressure (kPa)']:g} kPa", f"{row['peak stress ratio']:.2f}", f"{row['stress ratio at the end']:.3f}",
               f"{row['effective stress at the end (kPa)']:.0f}", f"{row['v beyond critical at the end']:+.4f}") for row in rows)]


def curves(run):
    """Of the tests from 100 kPa: {"panel: soil, path": (x, y)}."""
    if run.labels["confining pressure (kPa)"] != 100:
        return {}
    columns, name = results.read_element_table(run.folder / "table.txt"), f"{run.labels['soil']}, {run.labels['path']}"
    strain, pressure = 100 * columns["strain"], 1e-3 * columns["mean_pressure"]
    return {f"strength: {name}": (strain, columns["stress_ratio"]), f"volume: {name}": (strain, -100 * np.log(columns["volume_ratio"])),
            f"path: {name}": (pressure, 1e-3 * columns["deviator_stress"]), f"state: {name}": (pressure, columns["specific_volume"])}


def draw(figure, found, _):
    plots = dict(zip(("strength", "volume", "path", "state"), figure.subplots(2, 2).flat))
    for name, points in found.items():
        panel, curve = name.split(": ")
        style = {"color": "C3" if curve.startswith("dense") else "C0", "linestyle": "--" if curve.endswith("undrained") else "-"}
        if panel != "volume" or curve.endswith(" drained"):
            plots[panel].plot(*points, linewidth=1.5, label=curve, **style)
    pressures = np.geomspace(30, 3e3, 50)
    plots["strength"].axhline(M, color="k", linewidth=0.8, linestyle=":")
    plots["path"].plot(pressures, M * pressures, "k:", linewidth=1)
    plots["state"].plot(pressures, critical_volume(1e3 * pressures), "k:", linewidth=1, label="critical state")
    plots["strength"].set(xlabel="axial strain (%)", ylabel="q/p' (-)")
    plots["volume"].set(xlabel="axial strain (%)", ylabel="volumetric strain, drained (%)")
    plots["volume"].invert_yaxis()
    plots["path"].set(xlabel="p' (kPa)", ylabel="q (kPa)", xscale="log", yscale="log", xlim=(30, 3e3), ylim=(10, 3e3))
    plots["state"].set(xlim=(30, 3e3), xlabel="p' (kPa)", ylabel="specific volume (-)", xscale="log")
    for logarithmic in (plots["path"].xaxis, plots["path"].yaxis, plots["state"].xaxis):
        tick_axis(logarithmic)
    legend_above(figure, plots["state"], 5)


CHART = RunCurves(curves, draw, 6.)
STUDY = Study(title="Nor-Sand in the triaxial test",
              question="Does Nor-Sand come to its critical state, drained and undrained?",
              advice="Do not expect liquefaction of the loose sand with the published parameters.",
              base="prm/element/drained_triaxial_dense.prm", program="scree-element",
              variants=product(axis("path", lambda path: {"Path": f"{path} triaxial", "Final strain": {"drained": 0.5, "undrained": 0.2}[path]},
                                    ["drained", "undrained"]),
                               axis("soil", lambda soil: {"Nor-Sand/Initial specific volume": SOILS[soil]}, SOILS),
                               axis("confining pressure (kPa)", lambda pressure: {"Initial confining pressure": 1e3 * pressure}, [10, 100])),
              measure=measure, verdict=verdict, chart=CHART, table=table)

# SPDX-License-Identifier: LGPL-2.1-or-later
"""One material point of Nor-Sand under triaxial compression, dense and loose, drained and undrained: the soil of the landslides.

The parameters are those of Xie, Navas & Lopez-Querol 2024, Table 1 (the defaults of the law; v_0 = 1.629 dense, 1.736 loose).
The start is an isotropic stress of 10 or 100 kPa on the yield surface.
The curves of the discrete element tests behind the parameters are only in figures of the paper; nothing is compared with them.
The paper leaves out three values, which are assumed:

- the reference pressure of the critical state line: 1 Pa (with 1 kPa the loose sand would dilate as a dense one);
- the overconsolidation at the start: none;
- for the slopes, geometry and K0: crest 2 m, height 2 m, 45 degrees, K0 = 1 - sin phi_c = 0.683.

The theory can be checked without the curves: both sands must come to the same critical state, M and v_c = v_c0 - lambda ln(p'/p_ref).

Strains are logarithmic, compression positive, and q = sigma_1 - sigma_3.
Undrained tests hold the volume; the pore pressure is the difference between p' and the total mean stress.
A path has 2000 steps, to an axial strain of 50 % (drained) or 20 % (undrained).
"""
import numpy as np

from scree import plot_element
from scree.studies.charts import RunCurves
from scree.studies.study import Claim, Study, axis, product

SOILS = {"dense": 1.629, "loose": 1.736}
M, CRITICAL_VOLUME, COMPRESSION_INDEX = 0.7097, 1.88, 0.012


def critical_volume(pressure):
    return CRITICAL_VOLUME - COMPRESSION_INDEX * np.log(pressure)


def measure(run):
    CHART.keep(run)
    columns = plot_element.read(run.folder / "table.txt")
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


def draw(figure, runs):
    (strength, volume), (path, state) = figure.subplots(2, 2)
    for run in runs:
        columns = plot_element.read(run.folder / "table.txt")
        drained = run.labels["path"] == "drained"
        style = {"color": {"dense": "C3", "loose": "C0"}[run.labels["soil"]], "linestyle": "-" if drained else "--",
                 "linewidth": 1.6 if run.labels["confining pressure (kPa)"] == 100 else 0.8,
                 "label": f"{run.labels['soil']}, {run.labels['path']}, {run.labels['confining pressure (kPa)']:g} kPa"}
        pressure = columns["mean_pressure"]
        strength.plot(100 * columns["strain"], columns["stress_ratio"], **style)
        if drained:
            volume.plot(100 * columns["strain"], -100 * np.log(columns["volume_ratio"]), **style)
        path.plot(1e-3 * pressure, 1e-3 * columns["deviator_stress"], **style)
        state.plot(1e-3 * pressure, columns["specific_volume"], **style)
    strength.axhline(M, color="k", linewidth=0.6, linestyle=":")
    pressures = np.geomspace(4, 3e3, 50)
    path.plot(pressures, M * pressures, "k:", linewidth=0.8, label="critical state")
    state.plot(pressures, critical_volume(1e3 * pressures), "k:", linewidth=0.8)
    strength.set(xlabel="axial strain (%)", ylabel="q/p' (-)")
    volume.set(xlabel="axial strain (%)", ylabel="volumetric strain, drained (%)")
    volume.invert_yaxis()
    path.set(xlabel="p' (kPa)", ylabel="q (kPa)", xscale="log", yscale="log", ylim=(3, 3e3))
    state.set(xlim=path.get_xlim(), xlabel="p' (kPa)", ylabel="specific volume (-)", xscale="log")
    path.legend(fontsize="x-small")
    for axes in figure.axes:
        axes.grid(alpha=0.3)


CHART = RunCurves(draw, size=(10, 7.5))
STUDY = Study(title="Nor-Sand in the triaxial test", base="prm/element/drained_triaxial_dense.prm", program="scree-element",
              variants=product(axis("path", lambda path: {"Path": f"{path} triaxial", "Final strain": {"drained": 0.5, "undrained": 0.2}[path]},
                                    ["drained", "undrained"]),
                               axis("soil", lambda soil: {"Nor-Sand/Initial specific volume": SOILS[soil]}, SOILS),
                               axis("confining pressure (kPa)", lambda pressure: {"Initial confining pressure": 1e3 * pressure}, [10, 100])),
              measure=measure, verdict=verdict, chart=CHART)

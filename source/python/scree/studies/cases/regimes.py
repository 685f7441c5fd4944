# SPDX-License-Identifier: LGPL-2.1-or-later
"""The text of its section: doc/studies/intro/regimes.md."""
import math

import numpy as np

from scree.closed_forms import oedometric_modulus
from scree.studies import Curves, Span, Study, Variant, tick_axis, transfer

GRAVITY, WATER, GRAINS, POROSITY = 9.81, 1000., 2650., 0.4
POISSON, FRICTION, K0 = 0.3, 30., 0.5
SATURATED = (1 - POROSITY) * GRAINS + POROSITY * WATER
ENOUGH = 0.05
END = 4  # sqrt(H/g)
UNDRAINED_BOUND = 400  # of G, for the limit of the undrained model
TIMES = (1, 2, 3, 4)  # sqrt(H/g)
STRAIN = 1e-3  # load over E_oed
UNDRAINED_POISSON = 0.49
COLLAPSE, LOADED = "prm/columns/column_saturated.prm", "prm/consolidation/terzaghi.prm"
DRY = "prm/columns/mohr_coulomb_collapse.prm"
SIZES = [(1., 1e6), (0.2, 1e6), (5., 1e6), (1., 1e7)]  # H, m; Young's modulus, Pa
CONDUCTIVITIES = [1e-1, 3e-2, 1e-2, 3e-3, 1e-3, 1e-4, 1e-5, 1e-6, 1e-12]
SUBMERGED = [1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-12]


def group(height, young, conductivity):
    """Time of drainage over time of motion, -."""
    drainage = height**2 * WATER * GRAVITY / (conductivity * oedometric_modulus(young, POISSON))
    return drainage / math.sqrt(height / GRAVITY)


def common(height, cells, length, top):
    """Mesh (length and top of the box over H), times, transfer."""
    motion = math.sqrt(height / GRAVITY)
    return {"End time": f"{END * motion:.6g}", "Output/Interval": f"{END * motion / 40:.9g}", "Output/Graphics": "none",
            "Mesh/Cell size": height / cells, "Mesh/Upper corner": f"{length * height:g}, {top * height:g}",
            "Time step/Maximum time step": f"{1e-3 * math.sqrt(height):.3g}", **transfer("TPIC")}


def collapse(height, young, cells=10):
    return {**common(height, cells, 5, 1.5), "Soil/Region": f"x < {height:g} && y < {height:g}",
            "Soil/Mohr-Coulomb/Young's modulus": young, "Soil/Mohr-Coulomb/Poisson's ratio": POISSON,
            "Soil/Mohr-Coulomb/Friction angle": FRICTION, "Soil/Grain density": GRAINS,
            "Soil/Initial porosity": POROSITY, "Soil/Initial state/K0": K0}


def submerged(height, young):
    return {**collapse(height, young), "Mesh/Upper corner": f"{4 * height:g}, {1.6 * height:g}",
            "Water/Region": f"y < {1.2 * height:g}",
            "Water/Volume correction rate": 0.5 * math.sqrt(GRAVITY / (height / 10))}


def loaded(height, young, cells=10):
    rate = STRAIN * oedometric_modulus(young, POISSON) / (END * math.sqrt(height / GRAVITY))  # Pa/s
    width = 2 * height / cells
    return {**common(height, cells, 2 / cells, 1.2), "Gravity": "0, 0", "Stabilisation/F-bar": "none",
            "Soil/Region": f"y < {height:g}",
            "Soil/Material": "linear elastic", "Soil/Linear elastic/Young's modulus": young,
            "Soil/Linear elastic/Poisson's ratio": POISSON,
            "Soil/Initial porosity": POROSITY, "Soil/Grain density": GRAINS, "Soil/Initial state/Type": "none",
            "Soil/Initial state/K0": "auto",
            "Surface load/Lower corner": f"0, {height:g}", "Surface load/Upper corner": f"{width:g}, {height:g}",
            "Surface load/Traction": f"0; {-rate:.6g}*t"}


def total_stress(height, young, cells=10):
    """Undrained soil as one phase. The first body keeps the base's name."""
    buoyant = (SATURATED - WATER) * GRAVITY
    entries = {**common(height, cells, 5, 1.5),
               "Bodies": ", ".join(["Soil", *(f"Row{row}" for row in range(1, cells))])}
    for row, name in enumerate(entries["Bodies"].split(", ")):
        low, high = height * row / cells, height * (row + 1) / cells
        strength = (1 + K0) / 2 * buoyant * (height - (low + high) / 2) * math.sin(math.radians(FRICTION))
        values = {"Region": f"x < {height:g} && y >= {low:g} && y < {high:g}", "Material": "Mohr-Coulomb",
                  "Grain density": SATURATED, "Initial porosity": 0,
                  "Mohr-Coulomb/Young's modulus": young * (1 + UNDRAINED_POISSON) / (1 + POISSON),
                  "Mohr-Coulomb/Poisson's ratio": UNDRAINED_POISSON, "Mohr-Coulomb/Friction angle": 0,
                  "Mohr-Coulomb/Cohesion": strength,
                  "Mohr-Coulomb/Tension cut-off": 1e9, "Initial state/Type": "K0", "Initial state/K0": 1}
        entries.update({f"{name}/{key}": value for key, value in values.items()})
    return entries


def variants():
    found = []

    def add(scene, model, size, conductivity, entries, base, cells=10):
        labels = {"scene": scene, "model": model, "H": size[0], "E": size[1], "k": conductivity, "cells": cells}
        water = {"Water/Hydraulic conductivity": conductivity} if conductivity else {}
        found.append(Variant(labels, {**entries, **water}, base))

    heavy = {"Soil/Grain density": SATURATED / (1 - POROSITY)}
    for size in SIZES:
        add("collapse", "drained", size, 0., collapse(*size), DRY)
        add("load", "drained", size, 0., {**loaded(*size), **heavy}, DRY)
        for k in CONDUCTIVITIES:
            add("collapse", "coupled", size, k, collapse(*size), COLLAPSE)
            add("load", "coupled", size, k, loaded(*size), LOADED)
    buoyant = {"Gravity": f"0, {-GRAVITY * (1 - WATER / SATURATED):.6g}"}
    add("submerged", "drained", SIZES[0], 0., {**collapse(*SIZES[0]), **heavy, **buoyant}, DRY)
    for k in SUBMERGED:
        add("submerged", "coupled", SIZES[0], k, submerged(*SIZES[0]), COLLAPSE)
    add("collapse", "single-point", SIZES[0], min(CONDUCTIVITIES),
        {**collapse(*SIZES[0]), "Water/Point sets": "single"}, COLLAPSE)
    add("collapse", "total stress", SIZES[0], 0., total_stress(*SIZES[0]), DRY)
    add("collapse", "total stress", SIZES[0], 0., total_stress(*SIZES[0], cells=20), DRY, cells=20)
    add("collapse", "coupled", SIZES[0], min(CONDUCTIVITIES), collapse(*SIZES[0], cells=20), COLLAPSE, cells=20)
    return found


def measure(run):
    height, young, k = (run.labels[name] for name in ("H", "E", "k"))
    if run.labels["scene"] == "load":
        top = run.statistics("Height (m)")
        values = (top[0] - top) / (STRAIN * height)
    else:
        values = run.statistics("Front 90 % (m)") / height
    samples = np.interp(np.array(TIMES) * math.sqrt(height / GRAVITY), run.time, values)
    return {"group": group(height, young, k) if k else math.nan,
            **{f"at {time}": value for time, value in zip(TIMES, samples)}}


def values(row):
    return np.array([row[f"at {time}"] for time in TIMES])


def undrained(rows, like):
    """The coupled run of the smallest conductivity with the size of another run."""
    return rows.first(scene=like["scene"], H=like["H"], E=like["E"], cells=like["cells"], model="coupled",
                      k=min(CONDUCTIVITIES))


def error(rows, row, model):
    """The largest error of a simpler model against a coupled run, -."""
    drained = rows.first(scene=row["scene"], H=row["H"], E=row["E"], cells=row["cells"], model="drained")
    simpler = drained if model == "drained" else undrained(rows, row)
    scale = values(drained)[-1] if row["scene"] == "load" else values(row)
    return np.max(np.abs(values(simpler) - values(row)) / scale)


def curve(rows, scene, size, model):
    """Groups, ascending, and errors; without the run that is the model."""
    runs = rows.where(scene=scene, model="coupled", H=size[0], E=size[1], cells=10)
    runs = sorted((row for row in runs if model == "drained" or row["k"] > min(CONDUCTIVITIES)),
                  key=lambda row: row["group"])
    return np.array([row["group"] for row in runs]), np.array([error(rows, row, model) for row in runs])


def threshold(rows, scene, size, model):
    """The group below (drained) or above (undrained) which all errors are small enough, between two runs by their
    logarithms; nan if there is none."""
    groups, errors = curve(rows, scene, size, model)
    if model == "drained":
        groups, errors = groups[::-1], errors[::-1]
    too_large = np.flatnonzero(errors > ENOUGH)
    if len(too_large) == 0 or too_large[-1] == len(groups) - 1:
        return math.nan
    pair = slice(too_large[-1], too_large[-1] + 2)
    part = math.log(errors[pair][0] / ENOUGH) / math.log(errors[pair][0] / errors[pair][1])
    return groups[pair][0] ** (1 - part) * groups[pair][1] ** part


def sizes(rows):
    return list(dict.fromkeys((row["H"], row["E"]) for row in rows))


def thresholds(rows, scene, model):
    found = [threshold(rows, scene, size, model) for size in sizes(rows)
             if rows.where(scene=scene, H=size[0], E=size[1])]
    return [value for value in found if math.isfinite(value)]


def number(value):
    return f"{value:.2g}" if value < 10 else f"{value:.0f}"


def span(found):
    return number(min(found)) if len(found) == 1 else f"{number(min(found))} to {number(max(found))}"


def collapses_of(rows):
    return rows.where(lambda row: row["model"] == "coupled" and row["cells"] == 10 and row["scene"] != "load")


def shorter_in_air(rows):
    """By which part the front of a dry run is shorter than that of a saturated collapse in air."""
    return Span.of(error(rows, row, "drained") for row in collapses_of(rows).where(scene="collapse"))


def verdict(rows, claim):
    drained = thresholds(rows, "load", "drained")
    load, air, under = (thresholds(rows, scene, "undrained") for scene in ("load", "collapse", "submerged"))
    slowest = max(load + air + under)
    collapses, shorter = collapses_of(rows), shorter_in_air(rows)
    wet = [error(rows, row, "drained") for row in collapses.where(scene="submerged")]
    first = collapses.where(scene="collapse", H=1, E=1e6)
    dry_run, wet_run = rows.first(scene="collapse", model="drained", H=1, E=1e6), first.first(k=min(CONDUCTIVITIES))
    single = error(rows, rows.first(model="single-point"), "undrained")
    claim = claim.shared(drained=span(drained), load=span(load), air=span(air))
    claims = [
        claim("limits", 0.3 < min(drained) < 1 and 100 < slowest < UNDRAINED_BOUND, low=number(min(drained)),
              high=number(slowest), expected=UNDRAINED_BOUND),
        claim("load", max(drained) < 2 * min(drained) and max(load) < 2 * min(load), pairs=len(sizes(rows))),
        claim("collapse", max(air) < 1.5 * max(load) and min(air) < 0.85 * min(load), part=min(air) / min(load)),
        claim("dry", shorter.low > ENOUGH and all(values(row)[-1] > values(dry_run)[-1] for row in first),
              shorter=shorter, cost=dry_run["core-seconds"] / wet_run["core-seconds"]),
        claim("single-point", single < 0.01, quick=False, error=single)]
    if wet:
        claims.append(claim("submerged", min(wet) > ENOUGH, quick=False, least=min(wet), limits=span(under)))
    total = [(row, undrained(rows, row)) for row in rows.where(model="total stress")]
    if total:
        off = {f"{row['cells']:g} cells": np.max(np.abs(values(row) / values(coupled) - 1)) for row, coupled in total}
        finest, coupled = total[-1]
        claims.append(claim("total stress", max(off.values()) < 0.16, quick=False, off=off,
                            cost=finest["core-seconds"] / coupled["core-seconds"]))
    return claims


def table(rows):
    def limits(scene, size, model):
        return number(value) if math.isfinite(value := threshold(rows, scene, size, model)) else "-"
    return [("scene", "H (m)", "E (MPa)", "drained below G", "undrained above G"),
            *((scene, f"{size[0]:g}", f"{1e-6 * size[1]:g}", limits(scene, size, "drained"),
               limits(scene, size, "undrained"))
              for scene in ("load", "collapse", "submerged") for size in sizes(rows)
              if rows.where(scene=scene, model="coupled", H=size[0], E=size[1]))]


def draw(figure, rows):
    plots = figure.subplots(1, 3, sharey=True)
    for scene, plot in zip(("load", "collapse", "submerged"), plots):
        for size, weight in ((SIZES[0], 1.8), (SIZES[3], 0.8)):
            for model, colour in (("drained", "C1"), ("undrained", "C0")):
                groups, errors = curve(rows, scene, size, model)
                if len(groups):
                    plot.plot(groups, errors, color=colour, marker="o", markersize=3, linewidth=weight)
        plot.axhline(ENOUGH, color="k", linewidth=0.8, linestyle=":")
        plot.set(xscale="log", yscale="log", ylim=(1e-3, 1), xlim=(1e-2, 1e5), xlabel="G (-)", title=scene)
        tick_axis(plot.yaxis)
        plot.set_xticks([1e-2, 1, 1e2, 1e4], ["0.01", "1", "100", "10$^4$"])
    plots[0].text(0.03, 0.13, "drained", color="C1", transform=plots[0].transAxes)
    plots[0].text(0.6, 0.75, "undrained", color="C0", transform=plots[0].transAxes)
    plots[0].text(1.2e3, 1.1 * ENOUGH, "bound 5 %", fontsize=9)
    plots[0].set_ylabel("error of the simpler model against\nthe coupled run (-)")
    figure.supxlabel("G: drainage time over motion time; H = 1 m, E = 1 MPa (thick) and 10 MPa (thin)", fontsize=9)


STUDY = Study(
    COLLAPSE, variants=variants(), quick=lambda labels: (labels["H"], labels["E"], labels["cells"]) == (*SIZES[0], 10)
    and labels["scene"] != "submerged"
    and labels["model"] != "total stress" and labels["k"] in (0, 1e-1, 1e-2, 1e-3, 1e-5, 1e-12),
    chart=Curves(draw, 4., timed=True))

# SPDX-License-Identifier: LGPL-2.1-or-later
"""The text of its section: doc/studies/intro/transfer_rate.md."""

import math

import numpy as np

from scree.studies import Curves, Study, Variant, measures, tick_axis, transfer

FLIP, TPIC, CHOSEN = "FLIP, 1/s", "TPIC", "AFLIP, 5"
FACTORS = (2, 5, 10)
GRAVITY = 9.81
PERIOD = 2 * math.pi / math.sqrt(GRAVITY * math.pi * math.tanh(math.pi))  # s, of the wave in a box of 1 m
MEASURES = {"dissipation": 0.005, "p oscillation": 0.02, "stress oscillation": 0.02}  # and the least that counts
TITLES = {"dissipation": "dissipation over\nreleased energy", "p oscillation": "oscillation of p\nover mean p",
          "stress oscillation": "oscillation of p'\nover mean p'"}
COLUMN, STIFF, LARGE = "Mohr-Coulomb column", "Mohr-Coulomb column, E x 10", "Mohr-Coulomb column, 100 m"


def scene(name, base, end, cells, entries=lambda h: {}):
    """(labels, entries, base) of each cell size."""
    common = {"End time": end, "Output/Graphics": "none", "Output/Interval": end}
    return [({"scene": name, "h": h}, {"Mesh/Cell size": h, "Output/Statistics interval": end / 50, **common,
                                       **entries(h)},
             f"prm/{base}.prm") for h in cells]


def column(name, modulus, size=1):
    return scene(name, "columns/mohr_coulomb_collapse", math.sqrt(size), [0.1 * size], lambda h: {
        "Mesh/Upper corner": f"{5 * size}, {1.5 * size}", "Soil/Region": f"x < {size} && y < {size}",
        "Soil/Mohr-Coulomb/Young's modulus": modulus * size, "Time step/Maximum time step": 0.01 * math.sqrt(size)})


def water(h):
    return {"Time step/Maximum time step": 0.04 * h, "Water/Volume correction rate": 0.5 * math.sqrt(GRAVITY / h)}


def sloshing(h):
    return {"Mesh/Upper corner": "1, 1.3", **water(h), "Water/Region": "y < 1 + 0.05*cos(pi*x)",
            "Output/Statistics interval": PERIOD / 40}


SCENES = [
    *scene("dry slope", "slopes/slope_dense", 2, [0.1, 0.05], lambda h: {"Soil/Points per cell": 3}),
    *scene("dry column", "columns/column_dense", 1.5, [0.1, 0.05], lambda h: {"Soil/Points per cell": 3}),
    *scene("loose saturated slope", "slopes/slope_saturated_loose", 3, [1 / 7, 1 / 14], lambda h: {"Mesh/Upper corner": f"10, {18 / 7}"}),
    *scene("dense saturated slope", "slopes/slope_saturated_dense", 2, [1 / 7, 1 / 14], lambda h: {"Mesh/Upper corner": f"10, {18 / 7}"}),
    *scene("dam break", "water/dam_break", 0.68, [0.1, 0.05], water),
    *scene("sloshing", "water/dam_break", 5 * PERIOD, [0.1, 0.05], sloshing),
    *column(COLUMN, 1e6), *column(STIFF, 1e7), *column(LARGE, 1e6, 100)]


def affine(alpha, h):
    """The program's own rate is one of them."""
    rate = "auto" if f"AFLIP, {alpha}" == CHOSEN else alpha * math.sqrt(GRAVITY / h)
    return {"Transfer/Method": "AFLIP", "Transfer/PIC rate": rate}


def variants():
    found = []
    for labels, entries, base in SCENES:
        transfers = {FLIP: {"Transfer/Method": "FLIP", "Transfer/PIC rate": 1}, TPIC: transfer("TPIC"),
                     **{f"AFLIP, {alpha}": affine(alpha, labels["h"]) for alpha in FACTORS}}
        if labels["scene"] == STIFF:  # as much faster as waves are
            transfers["AFLIP, 5 sqrt(10)"] = affine(5 * math.sqrt(10), labels["h"])
        if labels["scene"] == LARGE:
            transfers["AFLIP, 50/s"] = {"Transfer/Method": "AFLIP", "Transfer/PIC rate": 50}
        found += [Variant({**labels, "transfer": name}, {**entries, **one}, base) for name, one in transfers.items()]
    return sorted(found, key=lambda variant: -variant.labels["h"])  # the short ones first


def measure(run):
    dissipation, columns = run.statistics("Numerical dissipation (J)"), run.columns
    wave = 1000 * GRAVITY * 0.05**2 / 4 if run.labels["scene"] == "sloshing" else None

    def mean(name):
        return float(np.mean(columns[name][1:])) if name in columns else math.nan
    return {"dissipation": float(dissipation[-1] / (wave or measures.released_energy(run))),
            "p oscillation": mean("p oscillation (-)"), "stress oscillation": mean("Stress oscillation (-)")}


def before(scene):
    """What the cases travel with."""
    return (FLIP,) if scene.startswith(("dry", COLUMN)) else (TPIC,)


def cost(rows, transfer, others):
    """The worst ratio of a measure to the smallest one of the transfers `others(scene)`, and where it comes from."""
    found = {}
    for (scene, h), group in rows.grouped("scene", "h").items():
        of = {row["transfer"]: row for row in group}
        for measure, least in MEASURES.items() if {transfer, FLIP, TPIC} <= of.keys() else ():
            value, *compared = (max(abs(of[name][measure]), least) for name in (transfer, *others(scene)))
            if not math.isnan(of[transfer][measure]):
                found[f"{measure}, {scene}, h = {h:.2g} m"] = value / min(compared)
    place = max(found, key=found.get, default="-")
    return found.get(place, math.nan), place


def penalties(rows):
    """{transfer: (penalty, where)} against the transfer of the cases, and against the better one of FLIP and TPIC in
    each measure."""
    against_now = {f"AFLIP, {alpha}": cost(rows, f"AFLIP, {alpha}", before) for alpha in FACTORS}
    return against_now, {name: cost(rows, name, lambda _: (FLIP, TPIC)) for name in (FLIP, TPIC, *against_now)}


def table(rows):
    against_now, against_both = penalties(rows)
    return [("transfer", "penalty against the cases", "against the better one", "largest in"),
            *((name, f"{against_now[name][0]:.2g}" if name in against_now else "-", f"{value:.2g}", place)
              for name, (value, place) in against_both.items())]


def verdict(rows, claim):
    def of(scene, transfer):
        row = rows.first(scene=scene, transfer=transfer)
        return row["dissipation"] if row else math.nan

    change, change_of_flip = (of(LARGE, transfer) / of(COLUMN, transfer) for transfer in (CHOSEN, FLIP))
    against_now, against_both = penalties(rows)
    faster = "AFLIP, 5 sqrt(10)"
    stiff = {FLIP: of(STIFF, FLIP) / of(COLUMN, FLIP),
             **{name: of(STIFF, name) / of(COLUMN, CHOSEN) for name in (CHOSEN, faster)}}
    fixed = of(LARGE, "AFLIP, 50/s") / of(COLUMN, CHOSEN)
    return [
        claim("scale", abs(change - 1) < 1e-3 < 0.1 < abs(change_of_flip - 1), change=change,
              change_of_flip=change_of_flip),
        claim("fixed rate", fixed > 1.1, quick=False, factor=fixed),
        claim("stiffness", abs(stiff[CHOSEN] - stiff[FLIP]) < 0.1 < stiff[faster] - stiff[FLIP], quick=False,
              flip=stiff[FLIP], chosen=stiff[CHOSEN], faster=stiff[faster]),
        claim("against the cases", min(against_now, key=lambda name: against_now[name][0]) == CHOSEN, quick=False),
        claim("against the better one", min(against_both, key=lambda name: against_both[name][0]) == FLIP, quick=False,
              worst=True)]


def draw(figure, rows):
    plots = figure.subplots(1, len(MEASURES), sharey=True)
    places = list(dict.fromkeys((row["scene"], round(row["h"], 4)) for row in rows))
    for axes, measure in zip(plots, MEASURES):
        for name, style in ((FLIP, "ks"), (TPIC, "C3^"), (CHOSEN, "C0o")):
            values = {(row["scene"], round(row["h"], 4)): row[measure] for row in rows if row["transfer"] == name}
            axes.plot([values.get(place, math.nan) for place in places], range(len(places)), style, label=name,
                      markersize=5)
        axes.set(xscale="log")
        axes.set_title(TITLES[measure], fontsize=9)
        tick_axis(axes.xaxis)
        axes.tick_params(axis="x", labelsize=9, rotation=60)
    plots[0].set_yticks(range(len(places)), [f"{scene}, h = {h:.2g} m" for scene, h in places], fontsize=9)
    plots[0].invert_yaxis()
    height = 0.32 / figure.get_figheight()
    figure.get_layout_engine().set(rect=(0, 0, 1, 1 - height))
    figure.legend(*plots[0].get_legend_handles_labels(), loc="upper center", ncols=3, frameon=False, fontsize=9)


STUDY = Study(
    "prm/columns/mohr_coulomb_collapse.prm", variants=variants(),
    quick=lambda labels: labels["scene"] in (COLUMN, LARGE) and labels["transfer"] in (FLIP, TPIC, CHOSEN),
    default={"transfer": FLIP}, chart=Curves(draw, 5.4))

# SPDX-License-Identifier: LGPL-2.1-or-later
"""The text of its section: doc/studies/intro/run_out_limits.md."""

import math
import re

import numpy as np

from scree.pictures.tables import name_lines
from scree.studies import (HEIGHT, MASS, TIP, TRANSFERS, Curves, Limit, Rows, Span, Study, Variant, apart, depth,
                           front_of_depth, halving_of, lost_energy, reference_rows, whole_cells)

GRAVITY = 9.81
SIZES, SHORT_SIZES = (12, 16, 24, 32, 48), (12, 16, 24, 32)
ASPECTS = (0.6, 1, 1.7, 3, 4)
REPOSE, TRIAXIAL = "direct shear or repose", "triaxial"
WITH, WITHOUT = "mu(I)", "constant"
SAND, BEADS = "sand", "beads"
GRAINS = {SAND: (31, "Lube"), BEADS: (22, "Lajeunesse")}  # angle of repose, source of the law
FRONT, LATE = "front 0.02 L0", "99 % in the last sixth"
WIDTH = 0.05  # L0
DIAMETER = 0.011  # L0


def law(source, quantity, aspect):
    """The law's value, - ; nan where the source gives none. At the bound between two ranges it is the lower one's."""
    for row in reference_rows("lube_lajeunesse_2005"):
        sign, bound = row["range_of_a"].split()[1:]
        inside = aspect <= float(bound) if sign == "<" else aspect > float(bound)
        if row["source"].startswith(source) and row["quantity"] == quantity.replace("-", "") and inside:
            factor, power, over = re.fullmatch(r"(?:([\d.]+)\*)?a(?:\^\((\d)/(\d)\))?", row["formula"]).groups()
            return float(factor or 1) * aspect ** (float(power) / float(over) if power else 1)
    return math.nan


def variant(aspect, cells, transfer="FLIP", friction=WITH, kind=REPOSE, points=3, grains=SAND):
    labels = {"grains": grains, "a": float(aspect), "cells": cells, "transfer": transfer, "friction": friction,
              "angle": kind, "points": points}
    reach = 1 + 1.7 * law("Lajeunesse", "run-out", aspect)  # the far wall must not be touched
    time = 8 * math.sqrt(aspect / GRAVITY)
    return Variant(labels, {
        **TRANSFERS[transfer], **whole_cells(1 / cells, (reach, aspect + 0.2)), "Boundaries/Bottom": "fixed",
        "Soil/Region": f"x < 1 && y < {aspect:g}", "Soil/Points per cell": points,
        "Soil/Mohr-Coulomb/Young's modulus": f"{1e6 * aspect:g}", "Soil/Mohr-Coulomb/Friction angle": GRAINS[grains][0],
        "Soil/Mohr-Coulomb/Friction angle kind": kind,
        "Soil/Mohr-Coulomb/Grain diameter": DIAMETER if friction == WITH else 0,
        "End time": f"{time:.4f}", "Output/Interval": f"{time / 8:.4f}", "Output/Graphics": "points"})


def variants():
    found = [variant(1, cells, transfer, friction) for transfer in TRANSFERS for friction in (WITH, WITHOUT)
             for cells in SIZES]
    found += [variant(aspect, cells, friction=friction) for aspect in ASPECTS if aspect != 1
              for friction in (WITH, WITHOUT) for cells in SHORT_SIZES]
    found += [variant(1, cells, kind=TRIAXIAL, friction=friction) for friction in (WITH, WITHOUT)
              for cells in SHORT_SIZES]
    found += [variant(1, cells, points=points) for points in (2, 4) for cells in SHORT_SIZES]
    return found + [variant(aspect, cells, grains=BEADS) for aspect in (0.6, 1, 1.7, 3) for cells in SHORT_SIZES]


def measure(run):
    points, tip = run.points(), run.statistics("Front 99 % (m)")
    return {FRONT: front_of_depth(points, 0.02, 1., WIDTH, 0.0025), MASS: run.statistics("Front 90 % (m)")[-1],
            TIP: tip[-1],
            HEIGHT: depth(points, 0., 2 * WIDTH)[0], LATE: tip[-1] - np.interp(5 / 6 * run.time[-1], run.time, tip),
            "energy lost numerically": lost_energy(run)}


def curve_of(rows, a=1., transfer="FLIP", friction=WITH, angle=REPOSE, points=3, grains=SAND):
    """The sizes of a column; without any, a list without rows."""
    key = float(a), transfer, friction, angle, points, grains
    return rows.grouped("a", "transfer", "friction", "angle", "points", "grains").get(key, Rows())


def compared_with_law(group, name):
    """(limit, law, relative deviation) of the run-out or the height."""
    limit, start, quantity = Limit(group, name), *((1., "run-out") if name == FRONT else (0., "height"))
    exact = law(GRAINS[group[0]["grains"]][1] if name == FRONT else "Lube", quantity, group[0]["a"])
    limit.value -= start
    return limit, exact, limit.value / exact - 1


def table(rows):
    found = [["a", "grains", "run-out, h = 0", "law", "deviation", "height, h = 0", "law", "deviation"]]
    for grains, aspect in ((grains, aspect) for grains in GRAINS for aspect in ASPECTS):
        group = curve_of(rows, aspect, grains=grains)
        if len(group) > 2:
            line = [f"{aspect:g}", grains]
            for name in (FRONT, HEIGHT):
                limit, exact, deviation = compared_with_law(group, name)
                has_law = (grains, name) != (BEADS, HEIGHT)
                line += [f"{limit:.3f}", f"{exact:.3f}" if has_law else "-",
                         f"{100 * deviation:+.1f} %" if has_law else "-"]
            found.append(line)
    return found


def short_verdict(rows, claim, rest):
    """Of one mesh: each cause lengthens the run-out."""
    def tip(friction, angle):
        return rows.first(transfer="FLIP", friction=friction, angle=angle, grains=SAND)[TIP]
    both, none = tip(WITHOUT, TRIAXIAL), tip(WITH, REPOSE)
    return [rest, claim("short", none < tip(WITHOUT, REPOSE) < both and none < tip(WITH, TRIAXIAL) < both)]


def verdict(rows, claim):
    rest = claim("rest", rows.largest[LATE] < 0.01, advance=rows.largest[LATE])
    if set(rows.values["cells"]) == {SIZES[0]}:
        return short_verdict(rows, claim, rest)
    beads = Span.of(compared_with_law(curve_of(rows, aspect, grains=BEADS), FRONT)[2] for aspect in (0.6, 1, 1.7, 3))
    run_outs, heights = ([compared_with_law(curve_of(rows, aspect), name)[2] for aspect in ASPECTS]
                         for name in (FRONT, HEIGHT))
    curves = {friction: {transfer: curve_of(rows, transfer=transfer, friction=friction) for transfer in TRANSFERS}
              for friction in (WITH, WITHOUT)}
    claims = [claim("sand", max(map(abs, run_outs + heights)) < 0.1, quick=False, worst=True, aspects=Span.of(ASPECTS),
                    height=max(heights, key=abs), run_out=Span.of(run_outs)),
              claim("beads", max(map(abs, beads)) < 0.1, quick=False, off=beads)]
    for friction, of in curves.items():
        changes = {transfer: halving_of(curve, TIP, 24) for transfer, curve in of.items()}
        claims.append(claim("halving", max(map(abs, changes.values())) < 0.03, quick=False, friction=friction,
                            changes=changes))
    for friction, of in curves.items():
        limits = {transfer: Limit(curve, TIP) for transfer, curve in of.items()}
        claims.append(claim("transfers", apart(limits) < 0.03, quick=False, friction=friction, limits=limits,
                            apart=apart(limits)))
    plain, constant, triaxial, both = (Limit(curve_of(rows, friction=friction, angle=angle), FRONT).value - 1
                                       for angle in (REPOSE, TRIAXIAL) for friction in (WITH, WITHOUT))
    exact = law("Lube", "run-out", 1)
    tips = {f"{points} x {points}": curve_of(rows, points=points).first(cells=32)[TIP] for points in (2, 3, 4)}
    return [*claims,
            claim("causes", constant > 1.05 * exact and triaxial > 1.05 * exact, quick=False, plain=plain,
                  constant=constant, triaxial=triaxial, both=both, exact=exact),
            claim("points", abs(tips["3 x 3"] / tips["4 x 4"] - 1) < 0.02, quick=False, tips=tips), rest]


def draw(figure, rows):
    left, right = figure.subplots(1, 2)
    for friction, line in ((WITH, "-"), (WITHOUT, "--")):
        for transfer, color in (("FLIP", "C0"), ("TPIC", "C1"), ("AFLIP", "C2")):
            group = curve_of(rows, transfer=transfer, friction=friction)
            if (transfer, friction) != ("AFLIP", WITHOUT):
                left.plot(group.values["cells"], group.values[TIP], color + line, marker="o", markersize=4,
                          label=f"{transfer}, {friction}")
    left.set(xlabel="cells per L0 (a = 1)", ylabel="front of 99 % of the mass over L0")
    name_lines(left)
    aspects = np.geomspace(0.5, 4.5, 200)
    for quantity, name, color in ((FRONT, "run-out", "C0"), (HEIGHT, "height", "C1")):
        right.plot(aspects, [law("Lube", name, aspect) for aspect in aspects], color=color,
                   label=f"{name},\nLube et al.")
        for aspect in ASPECTS:
            group = curve_of(rows, aspect)
            if len(group) > 2:
                limit = compared_with_law(group, quantity)[0]
                right.errorbar(aspect, limit.value, limit.uncertainty, color=color, marker="o", markersize=4, capsize=3)
    right.set(xscale="log", yscale="log", xlabel="aspect ratio a = H0/L0 (points: limits)", ylabel="over L0")
    right.set_xticks(ASPECTS, [f"{aspect:g}" for aspect in ASPECTS])
    right.set_yticks([0.5, 1, 2, 4], ["0.5", "1", "2", "4"])
    right.minorticks_off()
    name_lines(right)


STUDY = Study(
    "prm/columns/mohr_coulomb_collapse.prm", variants=variants(),
    quick=lambda labels: labels["a"] == 1 and labels["cells"] == 12 and labels["points"] == 3, chart=Curves(draw))

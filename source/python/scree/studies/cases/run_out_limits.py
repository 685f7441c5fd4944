# SPDX-License-Identifier: LGPL-2.1-or-later
"""The text of its section: doc/studies/intro/run_out_limits.md."""

import math
import re

import numpy as np

from scree.studies.cases.run_out import Limit
from scree.pictures.tables import name_lines
from scree.studies.charts import Curves
from scree.studies.measures import grouped, lost_energy
from scree.studies.study import Claim, Study, Variant, reference_rows
from scree.studies.study import transfer as entries_of

GRAVITY = 9.81
SIZES, SHORT_SIZES = (12, 16, 24, 32, 48), (12, 16, 24, 32)
ASPECTS = (0.6, 1, 1.7, 3, 4)
REPOSE, TRIAXIAL = "direct shear or repose", "triaxial"
WITH, WITHOUT = "mu(I)", "constant"
SAND, BEADS = "sand", "beads"
GRAINS = {SAND: (31, "Lube"), BEADS: (22, "Lajeunesse")}  # angle of repose, source of the law
TRANSFERS = {"FLIP": {"Transfer/Method": "FLIP", "Transfer/PIC rate": 1}, "AFLIP": entries_of("AFLIP"), "TPIC": entries_of("TPIC")}
FRONT, TIP, MASS, HEIGHT = "front 0.02 L0", "front 99 %", "front 90 %", "height"
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
    labels = {"grains": grains, "a": float(aspect), "cells": cells, "transfer": transfer, "friction": friction, "angle": kind, "points": points}
    reach = 1 + 1.7 * law("Lajeunesse", "run-out", aspect)  # the far wall must not be touched
    time = 8 * math.sqrt(aspect / GRAVITY)
    return Variant(labels, {
        **TRANSFERS[transfer], "Mesh/Cell size": f"{1 / cells:.12g}", "Boundaries/Bottom": "fixed",
        "Mesh/Upper corner": ", ".join(f"{math.ceil(length * cells - 1e-9) / cells:.12g}" for length in (reach, aspect + 0.2)),
        "Soil/Region": f"x < 1 && y < {aspect:g}", "Soil/Points per cell": points,
        "Soil/Mohr-Coulomb/Young's modulus": f"{1e6 * aspect:g}", "Soil/Mohr-Coulomb/Friction angle": GRAINS[grains][0], "Soil/Mohr-Coulomb/Friction angle kind": kind,
        "Soil/Mohr-Coulomb/Grain diameter": DIAMETER if friction == WITH else 0, "End time": f"{time:.4f}", "Output/Interval": f"{time / 8:.4f}",
        "Output/Graphics": "points"})


def variants():
    found = [variant(1, cells, transfer, friction) for transfer in TRANSFERS for friction in (WITH, WITHOUT) for cells in SIZES]
    found += [variant(aspect, cells, friction=friction) for aspect in ASPECTS if aspect != 1 for friction in (WITH, WITHOUT) for cells in SHORT_SIZES]
    found += [variant(1, cells, kind=TRIAXIAL, friction=friction) for friction in (WITH, WITHOUT) for cells in SHORT_SIZES]
    found += [variant(1, cells, points=points) for points in (2, 4) for cells in SHORT_SIZES]
    return found + [variant(aspect, cells, grains=BEADS) for aspect in (0.6, 1, 1.7, 3) for cells in SHORT_SIZES]


def volume_below(coordinate, volume, dim):
    """A function place -> volume of the points below a place; each point is a square, or cube, of its volume."""
    sides = volume ** (1 / dim)
    return lambda place: np.sum(volume * np.clip((place - coordinate) / sides + 0.5, 0., 1.))


def depth(points, low, high):
    """Of the deposit between places, averaged, L0."""
    left_of = volume_below(points.positions[:, 0], points.arrays["volume"].ravel(), 2)
    return np.array([(left_of(end) - left_of(start)) / (end - start) for start, end in zip(np.atleast_1d(low), np.atleast_1d(high))])


def front_of_depth(points, least, start, width, step):
    """The last place, each `step` from `start`, around which the deposit, averaged over `width`, is deeper than `least`."""
    places = np.arange(start, points.positions[:, 0].max() + width, step)
    return places[np.flatnonzero(depth(points, places, places + width) > least)[-1]] + width / 2


def measure(run):
    points = run.points()
    last = np.interp(5 / 6 * run.time[-1], run.time, run.statistics("Front 99 % (m)"))
    return {FRONT: front_of_depth(points, 0.02, 1., WIDTH, 0.0025), MASS: run.statistics("Front 90 % (m)")[-1],
            TIP: run.statistics("Front 99 % (m)")[-1], HEIGHT: depth(points, 0., 2 * WIDTH)[0],
            "99 % in the last sixth": run.statistics("Front 99 % (m)")[-1] - last,
            "energy lost numerically": lost_energy(run)}


def curves(rows):
    return grouped(rows, "a", "transfer", "friction", "angle", "points", "grains")


def halving_of(group, name, cells):
    """Relative change from this number of cells to twice as many."""
    at = {row["cells"]: row[name] for row in group}
    return at[2 * cells] / at[cells] - 1


def number(limit):
    return f"{limit.value:.3f} +- {limit.uncertainty:.3f}"


def compared_with_law(group, name):
    """(limit, law, relative deviation) of the run-out or the height."""
    limit, start, quantity = Limit(group, name), *((1., "run-out") if name == FRONT else (0., "height"))
    exact = law(GRAINS[group[0]["grains"]][1] if name == FRONT else "Lube", quantity, group[0]["a"])
    limit.value -= start
    return limit, exact, limit.value / exact - 1


def table(rows):
    groups, found = curves(rows), [["a", "grains", "run-out, h = 0", "law", "deviation", "height, h = 0", "law", "deviation"]]
    for grains, aspect in ((grains, aspect) for grains in GRAINS for aspect in ASPECTS):
        group = groups.get((float(aspect), "FLIP", WITH, REPOSE, 3, grains), [])
        if len(group) > 2:
            texts = [text for name in (FRONT, HEIGHT) for limit, exact, deviation in [compared_with_law(group, name)]
                     for text in (number(limit), *((f"{exact:.3f}", f"{100 * deviation:+.1f} %") if (grains, name) != (BEADS, HEIGHT) else ("-", "-")))]
            found.append([f"{aspect:g}", grains, *texts])
    return found


def rest(rows):
    advance = max(row["99 % in the last sixth"] for row in rows)
    return Claim(f"All columns are at rest at the end: in the last sixth of the time the front of 99 % advances by {advance:.4f} L0 at most.", advance < 0.01)


def short_verdict(rows):
    """Of one mesh: each cause lengthens the run-out."""
    def tip(friction, angle):
        return next(row[TIP] for row in rows if (row["transfer"], row["friction"], row["angle"], row["grains"]) == ("FLIP", friction, angle, SAND))
    both, none = tip(WITHOUT, TRIAXIAL), tip(WITH, REPOSE)
    return [rest(rows), Claim("Without mu(I), and with the angle read as a triaxial one, the front of 99 % goes farther.",
                              none < tip(WITHOUT, REPOSE) < both and none < tip(WITH, TRIAXIAL) < both)]


def verdict(rows):
    if {row["cells"] for row in rows} == {SIZES[0]}:
        return short_verdict(rows)
    groups = curves(rows)

    def of(a=1., transfer="FLIP", friction=WITH, angle=REPOSE, points=3, grains=SAND):
        return groups[float(a), transfer, friction, angle, points, grains]

    beads = [compared_with_law(of(a=aspect, grains=BEADS), FRONT)[2] for aspect in (0.6, 1, 1.7, 3)]
    claims = [Claim(f"Beads of 22 degrees: the run-out at h = 0 deviates from the law of Lajeunesse et al. by {100 * min(beads):+.0f} to {100 * max(beads):+.0f} %. Bound: 10 %.",
                    max(map(abs, beads)) < 0.1, quick=False)]
    changes = {(transfer, friction): halving_of(of(transfer=transfer, friction=friction), TIP, 24) for transfer in TRANSFERS for friction in (WITH, WITHOUT)}
    for friction in (WITH, WITHOUT):
        told = ", ".join(f"{transfer} {100 * changes[transfer, friction]:+.1f} %" for transfer in TRANSFERS)
        worst = max(abs(changes[transfer, friction]) for transfer in TRANSFERS)
        claims.append(Claim(f"Friction {friction}, a = 1: from 24 to 48 cells the front of 99 % changes by {told}. Bound: 3 %.", worst < 0.03, quick=False))
    for friction in (WITH, WITHOUT):
        limits = {transfer: Limit(of(transfer=transfer, friction=friction), TIP) for transfer in TRANSFERS}
        values = [limit.value for limit in limits.values()]
        apart = (max(values) - min(values)) / np.mean(values)
        claims.append(Claim(f"Friction {friction}, a = 1: at h = 0 the front of 99 % is at {', '.join(f'{number(limit)} ({name})' for name, limit in limits.items())} L0. "
                            f"The transfers differ by {100 * apart:.1f} %. Bound: 3 %.", apart < 0.03, quick=False))
    worst = [deviation for aspect in ASPECTS for deviation in (compared_with_law(of(a=aspect), FRONT)[2], compared_with_law(of(a=aspect), HEIGHT)[2])]
    claims.insert(0, Claim(f"Sand, with mu(I) and the angle of repose, a = {ASPECTS[0]} to {ASPECTS[-1]}: at h = 0 the height deviates from the law of Lube et al. by up to {100 * max(worst[1::2], key=abs):+.0f} %, "
                           f"the run-out by {100 * min(worst[::2]):+.0f} to {100 * max(worst[::2]):+.0f} %. Bound: 10 %.",
                           max(map(abs, worst)) < 0.1, quick=False, worst=True))
    constant, triaxial = (Limit(of(friction=WITHOUT), FRONT).value - 1, Limit(of(angle=TRIAXIAL), FRONT).value - 1)
    claims.append(Claim(f"One cause at a time, a = 1: run-out at h = 0 {Limit(of(), FRONT).value - 1:.2f}; without mu(I) {constant:.2f}; with the angle read as a triaxial one "
                        f"{triaxial:.2f}; triaxial and without mu(I) {Limit(of(friction=WITHOUT, angle=TRIAXIAL), FRONT).value - 1:.2f}. Law: {law('Lube', 'run-out', 1):.2f}.",
                        constant > 1.05 * law("Lube", "run-out", 1) and triaxial > 1.05 * law("Lube", "run-out", 1), quick=False))
    at_32 = {points: next(row for row in of(points=points) if row["cells"] == 32) for points in (2, 3, 4)}
    claims.append(Claim("Points, 32 cells: the front of 99 % is at " + ", ".join(f"{row[TIP]:.3f} ({points} x {points})" for points, row in at_32.items()) +
                        " L0.", abs(at_32[3][TIP] / at_32[4][TIP] - 1) < 0.02, quick=False))
    claims.append(rest(rows))
    return claims


def draw(figure, rows):
    groups = curves(rows)
    left, right = figure.subplots(1, 2)
    shown = {"FLIP, mu(I)": ("FLIP", WITH, "C0-"), "TPIC, mu(I)": ("TPIC", WITH, "C1-"), "AFLIP, mu(I)": ("AFLIP", WITH, "C2-"),
             "FLIP, constant": ("FLIP", WITHOUT, "C0--"), "TPIC, constant": ("TPIC", WITHOUT, "C1--")}
    for label, (transfer, friction, style) in shown.items():
        group = groups.get((1., transfer, friction, REPOSE, 3, SAND), [])
        left.plot([row["cells"] for row in group], [row[TIP] for row in group], style, marker="o", markersize=4, label=label)
    left.set(xlabel="cells per L0 (a = 1)", ylabel="front of 99 % of the mass over L0")
    name_lines(left)
    aspects = np.geomspace(0.5, 4.5, 200)
    for quantity, source, color, name in ((FRONT, "run-out", "C0", "run-out"), (HEIGHT, "height", "C1", "height")):
        right.plot(aspects, [law("Lube", source, aspect) for aspect in aspects], color=color, label=f"{name},\nLube et al.")
        for aspect in ASPECTS:
            group = groups.get((float(aspect), "FLIP", WITH, REPOSE, 3, SAND), [])
            if len(group) > 2:
                limit = compared_with_law(group, quantity)[0]
                right.errorbar(aspect, limit.value, limit.uncertainty, color=color, marker="o", markersize=4, capsize=3)
    right.set(xscale="log", yscale="log", xlabel="aspect ratio a = H0/L0 (points: limits)", ylabel="over L0")
    right.set_xticks(ASPECTS, [f"{aspect:g}" for aspect in ASPECTS])
    right.set_yticks([0.5, 1, 2, 4], ["0.5", "1", "2", "4"])
    right.minorticks_off()
    name_lines(right)


STUDY = Study(title="Limits of the run-out", question="Has the run-out a limit as the cells become smaller, and is it that of the experiment?",
              advice="For grains of known diameter use inertial friction on a fixed base. With 24 cells the run-out is within 5 % of its limit.",
              base="prm/columns/mohr_coulomb_collapse.prm", variants=variants(), table=table,
              quick=lambda labels: labels["a"] == 1 and labels["cells"] == 12 and labels["points"] == 3, measure=measure, verdict=verdict,
              chart=Curves(draw))

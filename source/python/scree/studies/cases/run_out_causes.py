# SPDX-License-Identifier: LGPL-2.1-or-later
"""The text of its section: doc/studies/intro/run_out_causes.md."""

from scree.studies.cases import run_out
from scree.studies.charts import Curves
from scree.studies.study import Study, transfer

BASES = run_out.FIXED, run_out.FRICTION
COLUMN_CAUSES = {
    "as it is": {},
    "PIC rate 0": {"Transfer/PIC rate": 0},
    "PIC rate 20 1/s": {"Transfer/PIC rate": 20},
    "TPIC": transfer("TPIC"),
    "no F-bar": {"Stabilisation/F-bar": "none"},
    "2 x 2 points": {"Soil/Points per cell": 2},
    "4 x 4 points": {"Soil/Points per cell": 4},
    "base of 35 degrees": {"Boundaries/Bottom": "friction 35"},
}
SIZES = (10, 20)


def changed(scene, soil, base, name, entries):
    """The sizes of a scene with one thing changed; that between them is for the short version."""
    found = []
    for n in (10, 14, 20) if name == "as it is" else SIZES:
        plain = run_out.variant(scene, soil, base, n)
        found.append(plain._replace(labels={**plain.labels, "changed": name}, entries={**plain.entries, **entries}))
    return found


VARIANTS = [variant for base in BASES for name, entries in COLUMN_CAUSES.items()
            if base == run_out.FIXED or name in ("as it is", "PIC rate 0", "no F-bar", "4 x 4 points")
            for variant in changed(run_out.COLUMN, "dense", base, name, entries)]
measure = run_out.measure


def pairs(rows):
    """{(scene, base, what is changed): (row of the largest cells, row of the smallest)}."""
    return {key: (group[0], group[-1])
            for key, group in rows.grouped("scene", "treatment", "changed").items() if len(group) > 1}


def advance(pair, percent):
    """By what part the smaller cells bring the front forward."""
    large, small = (row[f"front {percent} % (m)"] for row in pair)
    return small / large - 1


def verdict(rows, claim):
    both = pairs(rows)
    plain = {base: both[run_out.COLUMN, base, "as it is"] for base in BASES}
    large, small = (row["h"] for row in plain[run_out.FIXED])
    (fixed, fixed_tip), (friction, friction_tip) = ([advance(plain[base], percent) for percent in (90, 99)]
                                                    for base in BASES)
    claim = claim.shared(fixed=fixed, fixed_tip=fixed_tip, friction=friction, friction_tip=friction_tip)
    claims = [claim("base", fixed_tip > 1.5 * friction_tip, large=large, small=small)]
    name = (run_out.COLUMN, run_out.FRICTION, "PIC rate 0")
    if name in both:
        free, free_tip = (advance(both[name], percent) for percent in (90, 99))
        lost, kept = (pair[0]["energy lost numerically (-)"] for pair in (plain[run_out.FRICTION], both[name]))
        changed = {key[2]: pair for key, pair in both.items() if key[:2] == (run_out.COLUMN, run_out.FIXED)}
        rates = [advance(changed[rate], 90) for rate in ("PIC rate 0", "as it is", "PIC rate 20 1/s")]
        others = {what: advance(changed[what], 99) for what in ("no F-bar", "2 x 2 points", "4 x 4 points", "TPIC")}
        claims += [
            claim("damping", free < 0.5 * friction and free_tip < 0.6 * friction_tip, quick=False, free=free,
                  free_tip=free_tip, lost=lost, kept=kept),
            claim("rates", rates == sorted(rates), quick=False, rates=rates),
            claim("others", min(others.values()) > 0.6 * fixed_tip, quick=False, others=others)]
    return claims


def draw(figure, rows):
    both = pairs(rows)
    groups = {f"dense column, base: {base}": {name: pair for (_, of, name), pair in both.items() if of == base}
              for base in BASES}
    groups = {title: group for title, group in groups.items() if group}
    for axes, (title, group) in zip(figure.subplots(1, len(groups), squeeze=False, sharex=True)[0], groups.items()):
        for offset, quantile in ((-0.2, 90), (0.2, 99)):
            axes.barh([line + offset for line in range(len(group))],
                      [100 * advance(pair, quantile) for pair in group.values()], 0.38, label=f"front of {quantile} %")
        axes.set_yticks(range(len(group)), list(group))
        axes.invert_yaxis()
        axes.axvline(0, color="0.5", linewidth=0.8)
        axes.set(title=title, xlabel="advance of the front (%)")
        axes.grid(False, axis="y")
    axes.legend(fontsize=9, loc="lower right")


STUDY = Study(
    "prm/columns/column_dense.prm", variants=VARIANTS,
    quick=lambda labels: labels["scene"] == run_out.COLUMN and labels["changed"] == "as it is" and labels["h"] > 0.06,
    chart=Curves(draw, 4.4))

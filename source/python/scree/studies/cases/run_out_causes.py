# SPDX-License-Identifier: LGPL-2.1-or-later
"""The text of its section: doc/studies/intro/run_out_causes.md."""

from scree.studies.cases import run_out
from scree.studies.charts import Curves
from scree.studies.measures import grouped
from scree.studies.study import Claim, Study, transfer

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


VARIANTS = [variant for base in (run_out.FIXED, run_out.FRICTION) for name, entries in COLUMN_CAUSES.items()
            if base == run_out.FIXED or name in ("as it is", "PIC rate 0", "no F-bar", "4 x 4 points")
            for variant in changed(run_out.COLUMN, "dense", base, name, entries)]


def pairs(rows):
    """{(scene, base, what is changed): (row of the largest cells, row of the smallest)}."""
    return {key: (group[0], group[-1]) for key, group in grouped(rows, "scene", "treatment", "changed").items() if len(group) > 1}


def advance(pair, percent):
    """By what part the smaller cells bring the front forward."""
    large, small = (row[f"front {percent} % (m)"] for row in pair)
    return small / large - 1


def verdict(rows):
    both = pairs(rows)
    plain = {base: both[run_out.COLUMN, base, "as it is"] for base in (run_out.FIXED, run_out.FRICTION)}
    large, small = (row["h"] for row in plain[run_out.FIXED])
    at = {(base, percent): 100 * advance(pair, percent) for base, pair in plain.items() for percent in (90, 99)}
    claims = [Claim(f"The base: cells of {small:.3g} m instead of {large:.3g} m advance the front at 99 % by {at[run_out.FIXED, 99]:.1f} % on the fixed base and by "
                    f"{at[run_out.FRICTION, 99]:.1f} % on the one with friction. At 90 %, where the deposit is several cells deep, they advance it by {at[run_out.FIXED, 90]:.1f} % and "
                    f"{at[run_out.FRICTION, 90]:.1f} %.", at[run_out.FIXED, 99] > 1.5 * at[run_out.FRICTION, 99])]
    name = (run_out.COLUMN, run_out.FRICTION, "PIC rate 0")
    if name in both:
        free = {percent: 100 * advance(both[name], percent) for percent in (90, 99)}
        lost, kept = (pair[0]["energy lost numerically (-)"] for pair in (plain[run_out.FRICTION], both[name]))
        claims.append(Claim(f"Damping: without PIC the advance on the base with friction falls to {free[99]:.1f} % (90 %: {free[90]:.1f} %). The largest cells lose "
                            f"{100 * kept:.1f} % of the energy instead of {100 * lost:.1f} %. In a layer in shear as thick as a cell, PIC damps the difference to the grid velocity "
                            "at its rate: a loss in proportion to h.",
                            free[90] < 0.5 * at[run_out.FRICTION, 90] and free[99] < 0.6 * at[run_out.FRICTION, 99], quick=False))
        rates = [100 * advance(both[run_out.COLUMN, run_out.FIXED, changed], 90) for changed in ("PIC rate 0", "as it is", "PIC rate 20 1/s")]
        claims.append(Claim("On the fixed base, too, the advance grows with the rate: " + ", ".join(f"{rate:.1f} %" for rate in rates) + " at 90 % for 0, 5 and 20 1/s.",
                            rates == sorted(rates), quick=False))
        others = {changed: 100 * advance(both[run_out.COLUMN, run_out.FIXED, changed], 99) for changed in ("no F-bar", "2 x 2 points", "4 x 4 points", "TPIC")}
        claims.append(Claim("F-bar, points and transfer are not the cause: on the fixed base the front at 99 % still advances by " +
                            ", ".join(f"{value:.1f} % ({changed})" for changed, value in others.items()) + ".",
                            min(others.values()) > 0.6 * at[run_out.FIXED, 99], quick=False))
    return claims


def draw(figure, rows):
    both = pairs(rows)
    groups = {f"dense column, base: {base}": {key[2]: pair for key, pair in both.items() if key[:2] == (run_out.COLUMN, base)}
              for base in (run_out.FIXED, run_out.FRICTION)}
    groups = {title: group for title, group in groups.items() if group}
    for axes, (title, group) in zip(figure.subplots(1, len(groups), squeeze=False, sharex=True)[0], groups.items()):
        for offset, quantile in ((-0.2, 90), (0.2, 99)):
            axes.barh([line + offset for line in range(len(group))], [100 * advance(pair, quantile) for pair in group.values()], 0.38,
                      label=f"front of {quantile} %")
        axes.set_yticks(range(len(group)), list(group))
        axes.invert_yaxis()
        axes.axvline(0, color="0.5", linewidth=0.8)
        axes.set(title=title, xlabel="advance of the front (%)")
        axes.grid(False, axis="y")
    axes.legend(fontsize=9, loc="lower right")


STUDY = Study(
    title="Causes of the mesh dependence of the run-out",
    question="Which part of the method makes the front depend on the cell size?",
    advice="Without inertial friction, use a base with friction instead of a fixed one, and a low PIC rate. F-bar and points do not help.",
    base="prm/columns/column_dense.prm", variants=VARIANTS,
    quick=lambda labels: labels["scene"] == run_out.COLUMN and labels["changed"] == "as it is" and labels["h"] > 0.06,
    measure=run_out.measure, verdict=verdict, chart=Curves(draw, 4.4))

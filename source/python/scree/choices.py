# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tables and lists of numbers of doc/choosing.md and doc/studies/defaults.md, from the tables of the studies and doc/verification/benchmarks.csv; times
of prm/README.md, the last column of its tables, from the study `advice`.

PYTHONPATH=source/python python3 -m scree.choices

Writes them between the lines `<!-- numbers: NAME -->` and `<!-- end -->`. A number that no table has is `quoted` from the page that has it, and that
page must contain it. Deviations of fronts are relative to the displacement of the front, on every base.
"""

import functools
import math
import re

from scree import benchmarks
from scree.command import ROOT
from scree.studies import run as studies
from scree.studies.cases import regimes, run_out, run_out_limits, saturated_run_out_limits, strength_reduction
from scree.studies.limits import MASS, TIP, Limit
from scree.studies.pages import table as lines_of
from scree.studies.precision import DEFAULTS, LimitFit, at_finest, curve, ratio
from scree.studies.study import reference_rows
from scree.variants import read_entries

CHOICES, DEFAULTS_PAGE = ROOT / "doc" / "choosing.md", ROOT / "doc" / "studies" / "defaults.md"
TIMES, ROW = ROOT / "prm" / "README.md", re.compile(r"^(\| `([\w-]+)` \|.*\| )([^|]*)( \|)$", re.MULTILINE)
BLOCK = re.compile(r"(<!-- numbers: (\w+) -->\n).*?(<!-- end -->)", re.DOTALL)
GOOD, LIMITED = 0.05, 0.2  # largest deviations of these marks
RATIOS = 1.2, 3.  # and largest ratios to the recommended method
GAIN = 0.005  # of the released energy


@functools.lru_cache
def rows(study):
    return studies.read_table(studies.PAGES / f"{study}.csv")


def with_labels(study, labels):
    """The rows with these labels; `h` to within rounding."""
    others = {name: value for name, value in labels.items() if name != "h"}
    return rows(study).where(others).where(lambda row: "h" not in labels or abs(row["h"] - labels["h"]) < 1e-4)


def one(study, **labels):
    """The one row with these labels."""
    found = with_labels(study, labels)
    if len(found) != 1:
        raise ValueError(f"{study}.csv has {len(found)} rows with {labels}")
    return found[0]


def benchmark(quantity):
    return next(row for row in benchmarks.read() if row["quantity"] == quantity)


def quoted(page, text, number):
    """A number of a page without a CSV: the page must have the text, and the text the number."""
    if number not in text or text not in (ROOT / "doc" / page).read_text(encoding="utf-8"):
        raise ValueError(f"{page} does not say {text}")
    return number


def percent(value, sign=False):
    """With two digits: 0.07, 4.1, 19."""
    digits = 0 if abs(value) >= 0.0995 else 1 if abs(value) >= 0.00995 else 2 if abs(value) < 0.00095 else 1
    return f"{100 * value:{'+' if sign else ''}.{digits}f} %"


def start(scene, part):
    """The x below which this part of the mass lies at the start: columns of 1 m x 1 m, slopes of 2 m with a crest of 2 m and 45 degrees."""
    return part if scene == run_out.COLUMN else 4 - math.sqrt(2 * 6 * (1 - part))


def deviations(group, name, start, number=lambda row: round(row["cells"])):
    """{H/h: deviation of a front from its value at h = 0, over the displacement at h = 0} of the sizes of a curve."""
    limit = Limit(group, name)
    return {number(row): abs(row[name] - limit.value) / (limit.value - start) for row in group}


def fronts(scene, soil, treatment):
    """Those of the front of 90 %."""
    group = run_out.curves(rows("run_out"))[scene, soil, treatment]
    return deviations(group, run_out.FRONT, start(scene, 0.9), lambda row: round((1 if scene == run_out.COLUMN else 2) / row["h"]))


def worst(*series):
    """The largest deviation of several scenes with each H/h that all of them have."""
    return {n: max(one[n] for one in series) for n in sorted(set(series[0]).intersection(*series))}


def errors(study, length, method=DEFAULTS):
    """{H/h: error} of a work-precision study whose scene has this height, m."""
    return {round(length / h): row["error"] for h, row in curve(rows(study), method).items()}


def lacks(study, length, reference, sizes):
    """{H/h: deviation of the defaults from the limit by a fit}."""
    fit = LimitFit(rows(study), reference)
    return {round(length / h): fit.lack(h) for h in sizes}


def reached(series, bound):
    """The smallest H/h from which on all finer runs are within the bound."""
    within = []
    for n in sorted(series, reverse=True):
        if series[n] > bound:
            break
        within.append(n)
    return str(within[-1]) if within else "none"


def at(series, *numbers):
    return ", ".join(f"{percent(series[n])} at {n}" for n in numbers)


def span(values, sign=False):
    low, high = (percent(value, sign) for value in (min(values), max(values)))
    return low if low == high else f"{low.removesuffix(' %')} to {high}"


def minutes(study, n, **labels):
    """Core-minutes of the run with these labels, or of the slowest one, and its H/h."""
    value = max(row["core-seconds"] for row in with_labels(study, labels)) / 60
    return f"{value:.2g} ({n})" if value >= 0.001 else f"< 0.001 ({n})"


COLUMNS = worst(*(fronts(run_out.COLUMN, soil, run_out.LOW_PIC) for soil in ("dense", "loose")))
SLOPES = worst(*(fronts(run_out.SLOPE, soil, run_out.LOW_PIC) for soil in ("dense", "loose")))
WET_SLOPES = worst(fronts(run_out.SATURATED, "loose", run_out.FRICTION), fronts(run_out.PERMEABLE, "dense", run_out.FRICTION))
HELD = fronts(run_out.SATURATED, "dense", run_out.FRICTION)
FIXED_SLOPE = lacks("dry_slope", 2, 0.04, (0.2, 0.13333, 0.1, 0.066667))
DAM_BREAK = lacks("dam_break", 2, 1 / 60, (0.1, 0.05, 0.033333))
TERZAGHI, LARGE = errors("terzaghi", 1), errors("large_strain", 1)
BAR = errors("bar", 1, "TPIC")
MANUFACTURED = errors("manufactured", 1, "TPIC")
POND = {round(0.2 / h): max(abs(row["fall/exact"] - 1) for row in with_labels("wetting_front", {"default": True, "h": h}))
        for h in (0.1, 0.05, 0.025, 0.0125)}


def wet_limits():
    """Of the front of 90 % of a loose saturated slope on friction, TPIC."""
    group = saturated_run_out_limits.curves(rows("saturated_run_out_limits"))[saturated_run_out_limits.SLOPE, saturated_run_out_limits.FRICTION, "TPIC"]
    return deviations(group, MASS, start(run_out.SLOPE, 0.9))


def tip_change():
    """Largest change of the front of 99 % at the last refinement of saturated slopes on friction, over its displacement."""
    groups = [group for (scene, _, _), group in run_out.curves(rows("run_out")).items() if scene in (run_out.SATURATED, run_out.PERMEABLE)]
    return max(abs(fine[run_out.TIP] - coarse[run_out.TIP]) / (fine[run_out.TIP] - start(run_out.SLOPE, 0.99)) for *_, coarse, fine in groups)


def columns_of_grains():
    """Of the front of 99 % of a column with inertial friction."""
    return deviations(run_out_limits.curve_of(rows("run_out_limits")), TIP, 0.99)


def bars():
    """Run-out of the bars over the measured one: the column is 0.2 m wide, the measured front at 0.442 m."""
    measured = float(benchmark("front, inertial friction, h = 2.5 mm")["reference"])
    return [(row["front (m)"] - 0.2) / (measured - 0.2) - 1 for row in rows("aluminium_bars") if row["base"] == "fixed, mu(I)"]


def tips():
    """{H/h: run-out of the dam break over the measured one, from x/a = 1 on}."""
    measured = float(benchmark("front x/a at T = 2.98")["reference"])
    return {round(2 / row["h"]): (row["Z at T = 2.98"] - 1) / (measured - 1) - 1 for row in rows("martin_moyce")}


def impact_pairs(quantity):
    """A quantity of each impact with h = 0.1 and 0.05 m."""
    default = rows("impact")
    fine = {(row["k"], row["v"]): row[quantity] for row in default if row["h"] == 0.05}
    return [(row[quantity], fine[row["k"], row["v"]]) for row in default if row["h"] == 0.1]


def peak_factors():
    factors = [fine / coarse for coarse, fine in impact_pairs("peak p, kPa")]
    return min(factors), max(factors)


IMPULSE = max(abs(fine - coarse) for coarse, fine in impact_pairs("impulse"))  # its change


def table(lines):
    return "\n" + "\n".join(lines_of(lines)) + "\n\n"


def factors():
    """{H/h: largest deviation of the factor of safety of a slope}."""
    slopes = strength_reduction.scenes_of(rows("strength_reduction"))
    return {n: max(abs(strength_reduction.deviation(row)) for row in slopes if row["H/h"] == n) for n in (10, 20)}


@functools.lru_cache
def accuracies():
    """The rows of the table of accuracy: scene, points, H/h for 10 and 5 %, cost, deviation, reference."""
    def row(scene, points, series, cost, deviation, reference):
        return scene, points, reached(series, 0.1), reached(series, 0.05), cost, deviation, reference

    none, (low, high) = {1: 1.}, peak_factors()
    grains = [float(row["deviation_percent"]) / 100 for row in benchmarks.read() if row["quantity"].startswith("run-out/L0, a = ")]
    heap = "Fronts of undrained collapses deviate by -5.5 to +18.5 %"
    large = [float(quoted("verification/consolidation_and_seepage.md", "| the same, Kozeny-Carman | - | **1.096**; 1.037 |", "1.096")) - 1]
    mountain = "The cell size changes the reach by 20 m, the area by 3 % and the largest thickness of the deposit by 33 %"
    return [
        row("[factor of safety][safety]", "3", factors(), "-", at(factors(), 10, 20), "published, exact"),
        row("[dry columns][run_out], friction", "3", COLUMNS, minutes("run_out", 20, scene="column", h=0.05, treatment=run_out.LOW_PIC), at(COLUMNS, 10, 20),
            "limit of 4 sizes"),
        row("[dry slopes][run_out], friction", "2 or 3", SLOPES, minutes("run_out", 40, scene="slope", h=0.05, treatment=run_out.LOW_PIC), at(SLOPES, 20, 40),
            "limit of 4 sizes"),
        row("[saturated slopes][run_out], friction", "2", WET_SLOPES, minutes("run_out", 40, scene="saturated slope", h=0.05), at(WET_SLOPES, 20, 40),
            "limit of 4 sizes"),
        row("[loose saturated slope][wet_limits], friction", "3", wet_limits(), minutes("saturated_run_out_limits", 40, scene="slope", transfer="TPIC", cells=40.),
            at(wet_limits(), 20, 40), "limit of 4 sizes, TPIC"),
        row("the same, held by suction", "2", HELD, minutes("run_out", 40, scene="saturated slope", soil="dense", h=0.05), at(HELD, 20, 40),
            "limit of 4 sizes"),
        row("the same, front of 99 %", "2", none, minutes("run_out", 40, scene="saturated slope", h=0.05), f"{percent(tip_change())} from 28 to 40", "finer run"),
        row("[dry slope][dry], fixed base", "4", FIXED_SLOPE, minutes("dry_slope", 30, method=DEFAULTS, h=0.066667), at(FIXED_SLOPE, 20, 30), "limit by fit"),
        row("[saturated slope][wet], fixed base", "4", none, minutes("saturated_slope", 20, method=DEFAULTS, h=0.1),
            f"{percent(one('saturated_slope', method=DEFAULTS, h=0.1)['error'])} at 20", "finer FLIP run"),
        row("[column of grains][grains], inertial", "3", columns_of_grains(), minutes("run_out_limits", 24, cells=24., a=1., friction=run_out_limits.WITH, points=3., transfer="FLIP"),
            at(columns_of_grains(), 12, 24), "limit of 5 sizes"),
        row("[the same][grain_experiment], sand, beads", "3", none, "-", f"{span(grains, True)} at h = 0", "experiment"),
        row("[aluminium bars][bars], inertial", "4", none, minutes("aluminium_bars", 40, base="fixed, mu(I)", h=0.0025), f"{span(bars(), True)} at 10 to 40", "experiment"),
        ("[flow slide, undrained][fail]", "4", "not reliable", "not reliable", "-",
         f"{quoted('validation.md', heap, '-5.5')} % at 10, {quoted('validation.md', heap, '+18.5 %')} at 80", "total stress"),
        row("[consolidation, small strain][terzaghi]", "4", TERZAGHI, minutes("terzaghi", 20, method=DEFAULTS, h=0.05), at(TERZAGHI, 10, 20), "exact"),
        row("[consolidation, large strain][large]", "4", LARGE, minutes("large_strain", 20, method=DEFAULTS, h=0.05), at(LARGE, 10, 20), "exact"),
        row("[the same][limits_large], load 0.4 M", "4", {20: large[0]}, "-", f"{percent(large[0])} at 20", "finite differences"),
        row("[dam break][dam_break]", "4", DAM_BREAK, minutes("dam_break", 20, method=DEFAULTS, h=0.1), at(DAM_BREAK, 20, 60), "limit by fit"),
        row("[dam break][mm], front", "4", none, minutes("martin_moyce", 80, h=0.025), ", ".join(f"{percent(tips()[n], True)} at {n}" for n in (20, 80)), "experiment"),
        row("[impact][impact], impulse", "3", {5: IMPULSE}, minutes("impact", 10, h=0.05), f"{percent(IMPULSE)} from 5 to 10", "finer run"),
        row("[impact][impact], peak of p", "3", none, minutes("impact", 10, h=0.05), f"factor {low:.2g} to {high:.2g} from 5 to 10", "finer run"),
        row("[infiltration][infil], pond of 0.2 m", "4", POND, minutes("wetting_front", 4, h=0.05, default=True), ", ".join(percent(value).removesuffix(" %") for value in POND.values()) + f" % at {', '.join(map(str, POND))}", "exact"),
        ("[terrain][mountain], 10 and 5 m", "3", "not known", "not known", "-", f"deposit {quoted('tutorials/own_terrain.md', mountain, '33 %')} thicker",
         "finer run"),
        row("[elastic waves][bar], cells in the bar", "4", BAR, minutes("bar", 32, method="TPIC", h=0.03125), at(BAR, 16, 32), "exact")]


def accuracy():
    return table([("scene", "points", "H/h for 10 %", "H/h for 5 %", "core-minutes (H/h)", "deviation", "measured against"), *accuracies()])


# Scenes of the table of settings, by their beginning in the table of accuracy: case, transfer, base.
SETTINGS = {"[factor of safety]": ("slopes/griffiths_lane", "AFLIP", "fixed"),
            "[dry columns]": ("slopes/first_slope", "AFLIP", "friction (1)"), "[dry slopes]": ("slopes/first_slope", "AFLIP", "friction (1)"),
            "[dry slope]": ("slopes/slope_dense", "FLIP", "fixed"), "[column of grains]": ("columns/aluminium_bars", "FLIP", "fixed (2)"),
            "[loose saturated slope]": ("slopes/slope_saturated_loose_friction", "AFLIP", "friction (1)"),
            "[consolidation, small": ("consolidation/terzaghi", "AFLIP", "-"),
            "[consolidation, large": ("consolidation/large_strain_consolidation", "AFLIP", "-"), "[dam break][dam_break]": ("water/dam_break", "AFLIP", "free slip"),
            "[impact][impact], impulse": ("columns/column_saturated", "AFLIP", "fixed"),
            "[terrain]": ("terrain/mountain_dry", "AFLIP", "friction")}


def settings():
    lines = []
    for scene, (case, method, base) in SETTINGS.items():
        found = [row for row in accuracies() if row[0].startswith(scene)]
        name, _, _, cells, _, value, reference = found[0]
        lines.append((name, f"`{case}`", method, base, cells, value, re.sub(" (of . sizes|by fit)", "", reference)))
    return table([("scene", "start from", "transfer", "base", "H/h for 5 %", "deviation at H/h", "against"), *lines])


def points():
    """What 3 and 2 points per cell and axis cost in accuracy, against 4."""
    def ratios(scene, of, column="error"):
        return scene, *(f"{ratio(of, f'{n} x {n} points', column):.2g}" for n in (3, 2)), f"{ratio(of, '3 x 3 points', 'core-seconds'):.2g}"

    def pond(n):
        return max(abs(row["fall/exact"] - 1) for row in rows("wetting_front") if row["points"] == f"{n} x {n}")
    return table([("quantity over that with 4 points", "3 points", "2 points", "time, 3 points"),
                  ratios("[dry slope][dry]: front", SLOPE_ROWS), ratios("the same: oscillation of the stress", SLOPE_ROWS, "mean oscillation"),
                  ratios("[saturated slope][wet]: front", rows("saturated_slope")), ratios("[dam break][dam_break]: front", DAM_ROWS),
                  ratios("[large strain][large]: settlement, p", rows("large_strain")),
                  ("[infiltration][infil]: worst deviation", "-", f"{pond(2) / pond(4):.2g}", "-")])


def word(value, limits):
    return "good" if value <= limits[0] else "limited" if value <= limits[1] else "fails"


def deviation(method, value):
    return f"{method}: {word(value, (GOOD, LIMITED))}, {percent(value)}"


def times(value):
    """A ratio to the recommended method."""
    value = float(f"{value:.2g}")
    return f"{word(value, RATIOS)}, {value:.{1 if value < 10 else 0}f}"


def gain(value):
    return f"{'fails' if value > GAIN else 'good'}, gain {percent(value)}"


def transfer(scene, method, base):
    """The worst mean ratio over the meshes of dissipation and of the oscillations, from the study of the rates."""
    def mean(column):
        pairs = [(row[column], one("transfer_rate", scene=scene, h=row["h"], transfer=base)[column]) for row in rows("transfer_rate")
                 if row["scene"] == scene and row["transfer"] == method]
        logs = [math.log(value / other) for value, other in pairs if value > 0 and other > 0]
        return math.exp(sum(logs) / len(logs)) if logs else 0.
    return max(map(mean, ("dissipation", "p oscillation", "stress oscillation")))


def at_least(series):
    """The worst value with H/h of 20 or more."""
    return max(value for number, value in series.items() if number >= 20)


FLIP, AFLIP = "FLIP, 1/s", "AFLIP, 5"
SLOPE_ROWS, DAM_ROWS = (LimitFit(rows(study), h).against_limit(rows(study)) for study, h in (("dry_slope", 0.04), ("dam_break", 1 / 60)))


def stable(study, **labels):
    chosen = with_labels(study, labels)
    return sum(row["state"] == "stable" for row in chosen), len(chosen)


def methods():
    slope, dam, wet = SLOPE_ROWS, DAM_ROWS, rows("saturated_slope")
    single_gain = max(row["energy gained"] for row in wet if row["method"] == "single-point")
    thrown, n_thrown = stable("single_point", points="double")
    low, n_low = stable("low_stress")
    air = max(row["air left, cells"] for row in rows("air_gap"))
    pond_gain = max(row["gain"] for row in rows("wetting_front") if row["points"] == "2 x 2")
    finest = min(curve(rows("manufactured"), "TPIC"))

    def of_finest(method):
        return at_finest(rows("manufactured"), method) / one("manufactured", method="TPIC", h=finest)["error"]

    return table([
        ("scene", "recommended", "FLIP, 1 1/s", "TPIC", "AFLIP", "linear functions", "2 points", "single-point"),
        ("[dry slope, fixed][dry]", deviation("FLIP", at_least(FIXED_SLOPE)), "=", times(max(ratio(slope, "TPIC"), transfer("dry slope", "TPIC", FLIP))),
         times(transfer("dry slope", AFLIP, FLIP)), times(ratio(slope, "linear")), times(ratio(slope, "2 x 2 points", "mean oscillation")), "-"),
        ("[dry column, friction][run_out]", deviation("FLIP", at_least(COLUMNS)), "=", times(transfer("dry column", "TPIC", FLIP)),
         times(transfer("dry column", AFLIP, FLIP)), "-", "-", "-"),
        ("[dry slope, friction][run_out]", deviation("FLIP", at_least(SLOPES)), "=", "-", "-", "-", "-", "-"),
        ("[saturated slope, fixed][wet]", deviation("AFLIP", one("saturated_slope", method=DEFAULTS, h=0.1)["error"]), times(ratio(wet, "FLIP")), "-", "=", "-",
         times(max(ratio(wet, "2 x 2 points", name) for name in ("error", "median p oscillation"))), gain(single_gain)),
        ("[consolidation, small][terzaghi]", deviation("AFLIP", at_least(TERZAGHI)), "-", "-", "=",
         *(times(ratio(rows("terzaghi"), name)) for name in ("linear", "2 x 2 points", "single-point"))),
        ("[consolidation, large][large]", deviation("AFLIP", at_least(LARGE)), times(ratio(rows("large_strain"), "FLIP")), "-", "=",
         *(times(ratio(rows("large_strain"), name)) for name in ("linear", "2 x 2 points")), "-"),
        ("[dam break][mm]", deviation("AFLIP", max(tips().values())), times(ratio(dam, "FLIP")), "-", "=",
         *(times(ratio(dam, name)) for name in ("linear", "2 x 2 points")), "-"),
        ("[elastic waves][bar]", deviation("TPIC", at_least(BAR)), times(ratio(rows("bar"), DEFAULTS, other="TPIC")), "=", "-",
         times(ratio(rows("bar"), "linear", other="TPIC")), times(ratio(rows("bar"), "2 x 2 points")), "-"),
        ("[points cross cells][mms]", deviation("TPIC", at_least(MANUFACTURED)), times(of_finest(DEFAULTS)), "=", "-", times(of_finest("linear")),
         times(of_finest("2 x 2 points")), "-"),
        ("[impact, impulse][impact]", deviation("AFLIP", IMPULSE), "-", "-", "=", "-", "-", "-"),
        ("[impact, peak of p][impact]", f"AFLIP: fails, factor {peak_factors()[1]:.0f}", "-", "-", "=", "-", "-", "-"),
        ("[soil thrown at a wall][thrown]", f"AFLIP: fails, {thrown} of {n_thrown} stable", "-", "-", "=", "-", "-",
         f"fails, mass x {max(row['error'] for row in rows('single_point') if row['points'] == 'single'):.1f}"),
        ("[closure of an air gap][air_gap]", f"AFLIP: fails, {air:.1f} cell of air", "-", "-", "=", "-", "-", "-"),
        ("[infiltration, E = 1e5 Pa][infil]", deviation("AFLIP", max(POND.values())), "-", "-", "=", "-", gain(pond_gain), "-"),
        ("[low stress][low_stress]", f"fails, {low} of {n_low} stable", "-", "-", "-", "-", "-", "-"),
        ("[terrain, thickness][mountain]", "AFLIP: fails, 33 %", "-", "-", "-", "-", "-", "-")])


def remarks():
    """What stands behind some cells of the table of methods."""
    slope, wet, stress = SLOPE_ROWS, rows("saturated_slope"), "mean oscillation"
    contours = max(row["energy gained over released to 0.4 s"] for row in rows("contours") if row["F-bar"] == "standard")
    water = one("point_sets", soil="dense", points="single", end=12.)["change of water mass"]
    peaks = [max(row["largest effective stress, kPa"] for row in wet if row["method"] == name) for name in ("FLIP, 3 x 3 points", DEFAULTS)]
    oscillation = max(row["oscillation of p'"] for row in rows("low_stress"))
    return "\n" + "\n".join([
        "- Recommended method, dry slope on friction: the worst is the dense one at H/h = 20.",
        f"- FLIP in the saturated slope on a fixed base has {ratio(wet, 'FLIP'):.2f} times the distance to its own finer run.",
        f"  The ratio is that of the oscillation of p; the largest p' is {peaks[0]:.0f} kPa instead of {peaks[1]:.0f} kPa.",
        f"- TPIC in the dry slope: {ratio(slope, 'TPIC'):.1f} times the error and {transfer('dry slope', 'TPIC', FLIP):.1f} times the numerical dissipation.",
        "  TPIC and AFLIP in other slopes and columns: the larger ratio of dissipation and oscillations ([rate of AFLIP][rate]).",
        f"- 2 points in the dry slope: {ratio(slope, '2 x 2 points', stress):.1f} times the stress oscillation, {ratio(slope, '2 x 2 points'):.1f} times the error.",
        f"- Single-point in the dense slope: the mass of the water grows by {percent(water)} ([formulations][sets]).",
        f"- Dam break: the deviation is that of the front against the experiment; from the limit it is {percent(DAM_BREAK[20])}.",
        f"- Standard F-bar gains up to {percent(contours)} of the released energy in dry slopes ([stress][contours]).",
        f"  Without F-bar the stress oscillates {ratio(slope, 'no F-bar', stress):.1f} times as much in the dry slope "
        f"and {ratio(wet, 'no F-bar', stress):.1f} times in the saturated one.",
        f"- At low stress p' oscillates by up to {oscillation:.1f} of its mean. Use the fronts only.",
        "- Terrain: the largest thickness of the deposit changes by this value from cells of 10 m to cells of 5 m."]) + "\n\n"


def limits_of_g():
    """The limits of drained and undrained analysis that the study of the regimes finds."""
    claims = " ".join(claim.text for claim in regimes.STUDY.verdict(rows("regimes")))

    def said(pattern):
        return re.search(pattern, claims).groups()
    (low,), (high,) = said(r"drained model is within 5 % for G below ([\d.]+\d)"), said(r"undrained model is within 5 % for G above (\d+)")
    load, air, (water,) = said(r"undrained above (\d+) to (\d+), for"), said(r"collapse in air is undrained above ([\d.]+) to (\d+)"), said(r"within 5 % above (\d+)")
    dry = said(r"its front is shorter by (\d+) to (\d+) %")
    return table([("G", "load on elastic soil", "collapse in air", "collapse under water"),
                  (f"below {low}", "drained", "coupled", "coupled"),
                  (f"{low} to {high}", "coupled", "coupled", "coupled"),
                  (f"above {high}", "undrained", "undrained", "undrained")]) + "\n".join([
                      f"A dry run never replaces a saturated collapse: its front is {dry[0]} to {dry[1]} % shorter in air, at any conductivity.",
                      f"The limit of the undrained model varies with H and E: {air[0]} to {air[1]} in air, {load[0]} to {load[1]} under a load, {water} under water.",
                      ]) + "\n\n"


def cost():
    """How much less a run costs today."""
    then, now = one("dry_slope", method=DEFAULTS, h=0.066667), one("advice", case="slope_dense")
    return (f"\nThe studies took {then['ns per point and step']:.0f} ns per point and time step for the dense slope.\n"
            f"The newer [times of the cases](../../prm/README.md) take {now['ns per point and step']:.0f} ns.\n"
            "Compare costs within the table only, and use `--advise` for a case of your own.\n\n")


# {case: row} of runs by hand.
BY_HAND = {row["case"]: row for row in reference_rows("times_by_hand")}


def rounded(seconds):
    """Two digits above 10 s, whole seconds below, at least 1 s."""
    if seconds < 10:
        return f"{max(1, round(seconds))}"
    return f"{float(f'{seconds:.2g}'):,.0f}".replace(",", " ") if seconds >= 1e4 else f"{float(f'{seconds:.2g}'):.0f}"


def time_of(name, rows):
    """The last cell of a case; None for a case of scree-element."""
    path, = (ROOT / "prm").rglob(f"{name}.prm")
    entries = read_entries(path)
    if "Path" in entries:
        return None
    if by_hand := BY_HAND.get(name):
        seconds, simulated = by_hand["seconds"], by_hand["simulated"]
        return f"~{rounded(float(seconds) * float(entries['End time']) / float(simulated))} *" if simulated else f"{seconds} *"
    if name not in rows:
        return "-"
    row = rows[name]
    if row["whole"]:
        return rounded(row["core-seconds"])
    return f"~{rounded(row['core-seconds'] * float(entries['End time']) / row['simulated'])}"


def with_times(text):
    """The page with its times made again. Of a case whose first part was run it is "~" and the time in proportion; runs by hand have "*"."""
    times = {row["case"]: row for row in rows("advice")}

    def cell(match):
        time = time_of(match.group(2), times)
        return match.group() if time is None else match.group(1) + time + match.group(4)
    return ROW.sub(cell, text)


MAKERS = {CHOICES: {"settings": settings},
          DEFAULTS_PAGE: {"cost": cost, "accuracy": accuracy, "methods": methods, "remarks": remarks, "points": points, "limits_of_g": limits_of_g}}


def filled(page, text):
    """The text of a page with its blocks made again."""
    return BLOCK.sub(lambda match: match.group(1) + MAKERS[page][match.group(2)]() + match.group(3), text)


def main():
    for page in MAKERS:
        page.write_text(filled(page, page.read_text(encoding="utf-8")), encoding="utf-8")
    TIMES.write_text(with_times(TIMES.read_text(encoding="utf-8")), encoding="utf-8")


if __name__ == "__main__":
    main()

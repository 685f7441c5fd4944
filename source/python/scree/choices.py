# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tables and lists of numbers of doc/choosing.md and doc/studies/defaults.md, from the tables of the studies and
doc/verification/benchmarks.csv; times of prm/README.md, the last column of its tables, from the study `advice`.

PYTHONPATH=source/python python3 -m scree.choices

Writes them between the lines `<!-- numbers: NAME -->` and `<!-- end -->`; their words are those of
doc/studies/intro/choices.md. A number that no table has is `quoted` from the page that has it, and that page must
contain it. Deviations of fronts are relative to the displacement of the front, on every base.
"""

import functools
import math
import re

from scree import benchmarks
from scree.command import ROOT
from scree.studies import MASS, TIP, Limit, Lookup, Span, reference_rows
from scree.studies import run as studies
from scree.studies.cases import impact, regimes, resolution, run_out, run_out_limits, saturated_run_out_limits, strength_reduction
from scree.studies.measures import stable_of
from scree.studies.precision import DEFAULTS, LimitFit, at_finest, curve, ratio, ratios
from scree.studies.words import FOLDER, Filling
from scree.variants import read_entries

CHOICES, DEFAULTS_PAGE = ROOT / "doc" / "choosing.md", ROOT / "doc" / "studies" / "defaults.md"
BLOCKS = {CHOICES: ("settings",), DEFAULTS_PAGE: ("cost", "accuracy", "methods", "remarks", "points", "limits_of_g")}
TIMES, ROW = ROOT / "prm" / "README.md", re.compile(r"^(\| `([\w-]+)` \|.*\| )([^|]*)( \|)$", re.MULTILINE)
BLOCK = re.compile(r"(<!-- numbers: (\w+) -->\n)(.*?)(<!-- end -->)", re.DOTALL)
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


# Words of numbers -----------------------------------------------------------------------------------------------------


def percent(value, sign=False):
    """With two digits: 0.07, 4.1, 19."""
    digits = 0 if abs(value) >= 0.0995 else 1 if abs(value) >= 0.00995 else 2 if abs(value) < 0.00095 else 1
    return f"{100 * value:{'+' if sign else ''}.{digits}f} %"


def word(value, limits):
    return "good" if value <= limits[0] else "limited" if value <= limits[1] else "fails"


def times(value):
    """A ratio to the recommended method."""
    value = float(f"{value:.2g}")
    return f"{word(value, RATIOS)}, {value:.{1 if value < 10 else 0}f}"


class Numbers(Filling):
    """`percent`, of a Span "1.0 to 2.0 %"; `mark` of a deviation, `times` of a ratio to the recommended method, `gain`
    of energy."""
    FORMS = {"percent": percent, "+percent": lambda value: percent(value, True), "times": times,
             "mark": lambda value: f"{word(value, (GOOD, LIMITED))}, {percent(value)}",
             "gain": lambda value: f"{'fails' if value > GAIN else 'good'}, gain {percent(value)}"}

    def format_field(self, value, format_spec):
        form = self.FORMS.get(format_spec)
        if form and isinstance(value, Span):
            return f"{form(value.low).removesuffix(' %')} to {form(value.high)}"
        return form(value) if form else super().format_field(value, format_spec)


def reached(series, bound):
    """The smallest H/h from which on all finer runs are within the bound."""
    within = []
    for n in sorted(series, reverse=True):
        if series[n] > bound:
            break
        within.append(n)
    return str(within[-1]) if within else "none"


class Series:
    """Deviations by H/h. As text: `10 %`: the H/h from which on they are within it; `20, 40`: those at H/h; `=20`: that
    one alone; "": all."""

    def __init__(self, values):
        self.values = values

    def __format__(self, form):
        if form.endswith(" %"):
            return reached(self.values, float(form.removesuffix(" %")) / 100)
        if form.startswith("="):
            return percent(self.values[int(form[1:])])
        if not form:
            numbers = ", ".join(percent(value).removesuffix(" %") for value in self.values.values())
            return f"{numbers} % at {', '.join(map(str, self.values))}"
        return ", ".join(f"{percent(self.values[int(n)], form[0] == '+')} at {int(n)}" for n in form.split(", "))

    @property
    def largest(self):
        return max(self.values.values())

    @property
    def from_20(self):
        """The worst with H/h of 20 or more."""
        return max(value for number, value in self.values.items() if number >= 20)


# Deviations -----------------------------------------------------------------------------------------------------------


def start(scene, part):
    """The x below which this part of the mass lies at the start: columns of 1 m x 1 m, slopes of 2 m with a crest of
    2 m and 45 degrees."""
    return part if scene == run_out.COLUMN else 4 - math.sqrt(2 * 6 * (1 - part))


def deviations(group, name, start, number=lambda row: round(row["cells"])):
    """{H/h: deviation of a front from its value at h = 0, over the displacement at h = 0} of the sizes of a curve."""
    limit = Limit(group, name)
    return {number(row): abs(row[name] - limit.value) / (limit.value - start) for row in group}


def fronts(scene, soil, treatment):
    """Those of the front of 90 %."""
    group, height = run_out.curves(rows("run_out"))[scene, soil, treatment], 1 if scene == run_out.COLUMN else 2
    return deviations(group, run_out.FRONT, start(scene, 0.9), lambda row: round(height / row["h"]))


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


def worst_fall(chosen):
    """Of ponds that sink into sand, against the exact solution."""
    return max(abs(fall - 1) for fall in chosen.values["fall/exact"])


def minutes(study, n, **labels):
    """Core-minutes of the run with these labels, or of the slowest one, and its H/h."""
    value = with_labels(study, labels).largest["core-seconds"] / 60
    return f"{value:.2g} ({n})" if value >= 0.001 else f"< 0.001 ({n})"


def series():
    """Deviations of the scenes with several sizes of cells."""
    held, low = run_out.FRICTION, run_out.LOW_PIC
    wet = saturated_run_out_limits.curves(rows("saturated_run_out_limits"))["slope", "friction", "TPIC"]
    measured = float(benchmark("front x/a at T = 2.98")["reference"])
    slopes = strength_reduction.scenes_of(rows("strength_reduction"))
    loaded = quoted("verification/consolidation_and_seepage.md", "| the same, Kozeny-Carman | - | **1.096**; 1.037 |",
                    "1.096")
    found = {
        "safety": {n: max(abs(strength_reduction.deviation(row)) for row in slopes.where({"H/h": n}))
                   for n in (10, 20)},
        "columns": worst(*(fronts(run_out.COLUMN, soil, low) for soil in ("dense", "loose"))),
        "slopes": worst(*(fronts(run_out.SLOPE, soil, low) for soil in ("dense", "loose"))),
        "wet_slopes": worst(fronts(run_out.SATURATED, "loose", held), fronts(run_out.PERMEABLE, "dense", held)),
        "loose": deviations(wet, MASS, start(run_out.SLOPE, 0.9)),  # TPIC
        "held": fronts(run_out.SATURATED, "dense", held),
        "fixed_slope": lacks("dry_slope", 2, 0.04, (0.2, 0.13333, 0.1, 0.066667)),
        "grains": deviations(run_out_limits.curve_of(rows("run_out_limits")), TIP, 0.99),
        "terzaghi": errors("terzaghi", 1), "large": errors("large_strain", 1), "loaded": {20: float(loaded) - 1},
        "dam_break": lacks("dam_break", 2, 1 / 60, (0.1, 0.05, 0.033333)),
        # The run-out of the dam break over the measured one, from x/a = 1 on.
        "tips": {round(2 / row["h"]): (row["Z at T = 2.98"] - 1) / (measured - 1) - 1 for row in rows("martin_moyce")},
        "pond": {round(0.2 / h): worst_fall(with_labels("wetting_front", {"default": True, "h": h}))
                 for h in (0.1, 0.05, 0.025, 0.0125)},
        "waves": errors("bar", 1, "TPIC"), "manufactured": errors("manufactured", 1, "TPIC")}
    return {name: Series(values) for name, values in found.items()}


def costs():
    """Core-minutes of the scenes of the table of accuracy."""
    wet, low = {"scene": "saturated slope", "h": 0.05}, run_out.LOW_PIC
    grains = {"cells": 24., "a": 1., "friction": run_out_limits.WITH, "points": 3., "transfer": "FLIP"}
    return {"columns": minutes("run_out", 20, scene="column", h=0.05, treatment=low),
            "slopes": minutes("run_out", 40, scene="slope", h=0.05, treatment=low),
            "wet_slopes": minutes("run_out", 40, **wet), "held": minutes("run_out", 40, soil="dense", **wet),
            "loose": minutes("saturated_run_out_limits", 40, scene="slope", transfer="TPIC", cells=40.),
            "fixed_slope": minutes("dry_slope", 30, method=DEFAULTS, h=0.066667),
            "fixed_wet": minutes("saturated_slope", 20, method=DEFAULTS, h=0.1),
            "grains": minutes("run_out_limits", 24, **grains),
            "bars": minutes("aluminium_bars", 40, base="fixed, mu(I)", h=0.0025),
            "terzaghi": minutes("terzaghi", 20, method=DEFAULTS, h=0.05),
            "large": minutes("large_strain", 20, method=DEFAULTS, h=0.05),
            "dam_break": minutes("dam_break", 20, method=DEFAULTS, h=0.1), "tips": minutes("martin_moyce", 80, h=0.025),
            "impact": minutes("impact", 10, h=0.05), "pond": minutes("wetting_front", 4, h=0.05, default=True),
            "waves": minutes("bar", 32, method="TPIC", h=0.03125)}


def single_values():
    """Deviations of scenes with one size of cells, and what stands beside them."""
    wet = [group for (scene, _, _), group in run_out.curves(rows("run_out")).items()
           if scene in (run_out.SATURATED, run_out.PERMEABLE)]
    at_start = start(run_out.SLOPE, 0.99)
    measured = float(benchmark("front, inertial friction, h = 2.5 mm")["reference"])
    bars = rows("aluminium_bars").where(base="fixed, mu(I)")
    heap = "Fronts of undrained collapses deviate by -5.5 to +18.5 %"
    return {
        # Of the front of 99 % at the last refinement of saturated slopes on friction, over its displacement.
        "tip_change": max(abs(fine[run_out.TIP] - coarse[run_out.TIP]) / (fine[run_out.TIP] - at_start)
                          for *_, coarse, fine in wet),
        "fixed_wet": one("saturated_slope", method=DEFAULTS, h=0.1)["error"],
        "sand_and_beads": Span.of(float(row["deviation_percent"]) / 100 for row in benchmarks.read()
                                  if row["quantity"].startswith("run-out/L0, a = ")),
        # The column is 0.2 m wide, the measured front at 0.442 m.
        "bars": Span.of((front - 0.2) / (measured - 0.2) - 1 for front in bars.values["front (m)"]),
        "heap": [quoted("validation.md", heap, number) for number in ("-5.5", "+18.5 %")],
        "impulse": max(abs(fine - coarse) for coarse, fine in impact.pairs(rows("impact"), "impulse")),
        "peaks": Span.of(fine / coarse for coarse, fine in impact.pairs(rows("impact"), "peak p, kPa")),
        "terrain": next(error for *_, error, _, row in resolution.deviations(rows("resolution"))["mountain side"] if row["h"] == 10),
        "then": one("dry_slope", method=DEFAULTS, h=0.066667)["ns per point and step"],
        "now": one("advice", case="slope_dense")["ns per point and step"]}


# Methods --------------------------------------------------------------------------------------------------------------

FLIP = "FLIP, 1/s"


def rate_ratio(names):
    """"scene; transfer": the worst mean ratio to FLIP over the meshes of dissipation and of the oscillations, from the
    study of the rates."""
    scene, method = names.split("; ")

    def mean(column):
        pairs = [(row[column], one("transfer_rate", scene=scene, h=row["h"], transfer=FLIP)[column])
                 for row in rows("transfer_rate").where(scene=scene, transfer=method)]
        logs = [math.log(value / other) for value, other in pairs if value > 0 and other > 0]
        return math.exp(sum(logs) / len(logs)) if logs else 0.
    return max(map(mean, ("dissipation", "p oscillation", "stress oscillation")))


def of_methods():
    """Ratios of methods to the defaults, and the worst numbers of some maps."""
    slope, dam = (LimitFit(rows(study), h).against_limit(rows(study))
                  for study, h in (("dry_slope", 0.04), ("dam_break", 1 / 60)))
    wet, mud, small, bar, mms = map(rows, ("saturated_slope", "large_strain", "terzaghi", "bar", "manufactured"))
    finest = one("manufactured", method="TPIC", h=min(curve(mms, "TPIC")))["error"]
    two_points = rows("wetting_front").where(points="2 x 2")
    pond = {points: worst_fall(rows("wetting_front").where(points=points)) for points in ("2 x 2", "4 x 4")}
    return {
        "slope": ratios(slope), "slope_stress": ratios(slope, "mean oscillation"), "rates": Lookup(rate_ratio),
        "wet": ratios(wet),
        "wet_stress": ratios(wet, "mean oscillation"), "mud": ratios(mud), "small": ratios(small), "dam": ratios(dam),
        "bar": ratios(bar),
        "bar_tpic": Lookup(lambda method: ratio(bar, method, other="TPIC")),
        "mms": Lookup(lambda method: at_finest(mms, method) / finest),
        "slope_tpic": max(ratio(slope, "TPIC"), rate_ratio("dry slope; TPIC")),
        "wet_points": max(ratio(wet, "2 x 2 points", name) for name in ("error", "median p oscillation")),
        **{f"{name}_time": ratio(of, "3 x 3 points", "core-seconds")
           for name, of in (("slope", slope), ("wet", wet), ("dam", dam), ("mud", mud))},
        "single_gain": max(row["energy gained"] for row in wet if row["method"] == "single-point"),
        "peak": Lookup(lambda method: wet.where(method=method).largest["largest effective stress, kPa"]),
        "thrown": stable_of(rows("single_point").where(points="double")),
        "made": rows("single_point").where(points="single").largest["error"],
        "low": stable_of(rows("low_stress")), "oscillation": rows("low_stress").largest["oscillation of p'"],
        "air": rows("air_gap").largest["air left, cells"], "pond_gain": two_points.largest["gain"],
        "pond_of_2": pond["2 x 2"] / pond["4 x 4"],
        "water": one("point_sets", soil="dense", points="single", end=12.)["change of water mass"],
        "gained": rows("contours").where({"F-bar": "standard"}).largest["energy gained over released to 0.4 s"]}


def limits_of_g():
    """The limits of drained and undrained analysis."""
    table = rows("regimes")
    load, air, water = (regimes.thresholds(table, scene, "undrained") for scene in ("load", "collapse", "submerged"))
    return {"low_g": regimes.number(min(regimes.thresholds(table, "load", "drained"))),
            "high_g": regimes.number(max(load + air + water)),
            "load_g": regimes.span(load), "air_g": regimes.span(air), "water_g": regimes.span(water),
            "shorter": regimes.shorter_in_air(table)}


@functools.lru_cache
def blocks():
    """{name: text} of all blocks."""
    values = {**series(), "minutes": costs(), **single_values(), **of_methods(), **limits_of_g()}
    words = (FOLDER / "choices.md").read_text(encoding="utf-8")
    return {name: Numbers().format(text, **values) for _, name, text, _ in BLOCK.findall(words)}


# Times ----------------------------------------------------------------------------------------------------------------

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
        if not simulated:
            return f"{seconds} *"
        return f"~{rounded(float(seconds) * float(entries['End time']) / float(simulated))} *"
    if name not in rows:
        return "-"
    row = rows[name]
    if row["whole"]:
        return rounded(row["core-seconds"])
    return f"~{rounded(row['core-seconds'] * float(entries['End time']) / row['simulated'])}"


def with_times(text):
    """The page with its times made again. Of a case whose first part was run it is "~" and the time in proportion; runs
    by hand have "*"."""
    times = {row["case"]: row for row in rows("advice")}

    def cell(match):
        time = time_of(match.group(2), times)
        return match.group() if time is None else match.group(1) + time + match.group(4)
    return ROW.sub(cell, text)


def filled(page, text):
    """The text of a page with its blocks made again."""
    return BLOCK.sub(lambda match: match.group(1) + blocks()[match.group(2)] + match.group(4), text)


def main():
    for page in BLOCKS:
        page.write_text(filled(page, page.read_text(encoding="utf-8")), encoding="utf-8")
    TIMES.write_text(with_times(TIMES.read_text(encoding="utf-8")), encoding="utf-8")


if __name__ == "__main__":
    main()

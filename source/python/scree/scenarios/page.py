# SPDX-License-Identifier: LGPL-2.1-or-later
"""Files of a study: the table of its runs, maps of probability, pictures, and the report that holds them."""

import html
import shutil
from typing import NamedTuple

import numpy as np

from scree import maps, report, results, variants
from scree.scenarios import charts, evaluation, observed, runs


class Evaluated(NamedTuple):
    """Verdicts by the numbers of runs, results {number: {Result: value}} of runs that ended well, and all Results in their order."""
    verdicts: dict
    numbers: dict
    results: list


def evaluate(study):
    """The numbers of all runs. A run whose files cannot be read counts as failed."""
    verdicts, numbers = runs.verdicts(study), {}
    for number, one in verdicts.items():
        if one.word == "finished":
            try:
                of_event = observed.numbers(study.event, study.run(number)) if study.event else {}
                numbers[number] = {**evaluation.numbers_of(study, study.run(number)), **of_event}
            except (OSError, ValueError) as error:
                verdicts[number] = runs.Verdict("failed", (), f"its results cannot be read: {error}")
    return Evaluated(verdicts, numbers, list(dict.fromkeys(one for row in numbers.values() for one in row)))


def write_all(study):
    """Writes runs.csv, maps, pictures and report.html into the folder of the study; returns what has been evaluated."""
    done = evaluate(study)
    write_table(study, done)
    if not done.numbers:
        return done
    for old in study.folder.glob("*.png"):
        old.unlink()
    probabilities = write_probabilities(study, done)
    pictures = draw(study, done, probabilities)
    (study.folder / "report.html").write_text(page(study, done, probabilities, pictures), encoding="utf-8")
    return done


def write_table(study, done):
    """A row for each run: parameters, verdict, results."""
    head = ["run", *(one.label for one in study.parameters), "verdict", "checks", "wall_time_s", *map(column, done.results), "message"]
    results.write_rows(study.folder / "runs.csv", head, (
        [number, *row, one.word, _checks(one), _cell(one.seconds), *(_cell(found.get(result, np.nan)) for result in done.results), one.message]
        for number, row in zip(study.numbers, study.rows) for one, found in [(done.verdicts[number], done.numbers.get(number, {}))]))


def _checks(verdict):
    if verdict.word != "finished":
        return ""
    found = [f"{kind}: {', '.join(names)}" for kind, names in (("fault", verdict.faults), ("resolution", verdict.coarse)) if names]
    return "; ".join(found) or "within bounds"


def column(result):
    """The name of a column: "run_out_m", "largest_speed_m_s"."""
    unit = result.unit.replace("^", "").replace("/", "_")
    return result.key + (f"_{unit}" if unit != "-" else "")


def _cell(value):
    return f"{value:.9g}" if np.isfinite(value) else ""  # national coordinates to 1 cm


def word(study):
    """What a part of the runs is: a probability if the runs are drawn from the distributions, else only a share."""
    return "Share" if study.sampling == "one at a time" else "Probability"


def write_probabilities(study, done):
    """{(quantity, threshold): Raster of probabilities}; writes them into the folder maps, in 3D as rasters and in 2D as a table."""
    folder = study.folder / "maps"
    shutil.rmtree(folder, ignore_errors=True)
    found, names, like = {}, {}, None
    for quantity, thresholds in study.thresholds.items():
        rasters = [peaks[quantity] for peaks in (evaluation.peak_maps(study.run(number)) for number in done.numbers) if quantity in peaks]
        for threshold in thresholds if rasters else ():
            found[quantity, threshold] = evaluation.probability(rasters, threshold)
            names[quantity, threshold] = f"probability_{quantity}_{threshold:g}{ {'thickness': 'm', 'speed': 'm_s', 'pressure': 'Pa'}[quantity] }"
    if not found:
        return found
    folder.mkdir()
    files = maps.map_files(study.run(next(iter(done.numbers))))
    if "profile" in files:
        first = next(iter(found.values()))
        x = first.x + first.width * (np.arange(first.values.shape[1]) + 0.5)
        np.savetxt(folder / "probability.csv", np.column_stack([x, *(raster.values[0] for raster in found.values())]), fmt="%.6g", delimiter=",",
                   header=",".join(["x", *names.values()]), comments="")
        return found
    like = files[evaluation.MAPS[next(iter(found))[0]]]
    for key, raster in found.items():
        results.write_map(folder / f"{names[key]}{like.suffix}", raster._replace(values=np.where(raster.values > 0, raster.values, np.nan)), like)
    return found


def series(done, study, result):
    """(rows, values) of the runs that have a result."""
    found = [(row, done.numbers[number][result]) for number, row in zip(study.numbers, study.rows)
             if np.isfinite(done.numbers.get(number, {}).get(result, np.nan))]
    return [row for row, _ in found], [value for _, value in found]


def nearest(done):
    """(number, critical success index of the impact) of the run with the largest one; None without an event."""
    found = {number: value for number, row in done.numbers.items() for one, value in row.items() if one.key == "impact_index"}
    return max(found.items(), key=lambda item: item[1]) if found else None


def draw(study, done, probabilities):
    """{name: caption} of the pictures that have been drawn."""
    folder, drawn = study.folder, {}
    if best := nearest(done):
        charts.draw_nearest(study.run(best[0]), study.event, folder / "nearest.png")
        drawn["nearest"] = f"Run {best[0]}, with the largest critical success index of the impact, and the observed areas"
    first = study.run(next(iter(done.numbers)))
    if probabilities and results.read_box(first).dim == 3:
        sources = [one for one in (maps.release(study.run(number)) for number in done.numbers) if one]
        placed = evaluation.on_one_grid(sources) if sources else []
        source = placed[0]._replace(values=np.max([np.nan_to_num(one.values) for one in placed], axis=0)) if placed else None
        charts.draw_probabilities(first, probabilities, source, word(study), len(done.numbers), folder / "probability.png")
    elif probabilities:
        charts.draw_profiles(probabilities, word(study), len(done.numbers), folder / "probability.png")
    if probabilities:
        drawn["probability"] = "Part of the runs above each threshold"
    shown = [one for one in done.results if one.key in ("run_out", "factor", "area", "length", "largest_speed", "h_over_l")]
    run_out = next((one for one in done.results if one.key in ("run_out", "factor")), None)
    if study.sampling == "one at a time":
        bars = {one: evaluation.tornado(study.parameters, study.rows, [done.numbers.get(number, {}).get(one, np.nan) for number in study.numbers])
                for one in shown[:3]}
        bars = {one: chart for one, chart in bars.items() if chart and chart[1]}
        if bars:
            charts.draw_tornado(bars, folder / "tornado.png")
            drawn["tornado"] = "What each parameter alone changes"
        return drawn
    if run_out and len(series(done, study, run_out)[1]) > 1:
        rows, values = series(done, study, run_out)
        charts.draw_exceedance(run_out, values, folder / "run_out.png")
        drawn["run_out"] = f"Exceedance of the {run_out.name[0].lower()}{run_out.name[1:]}"
        charts.draw_values(study.parameters, rows, run_out, values, folder / "values.png")
        drawn["values"] = f"{run_out.name} of each run against its parameters"
    bars = {one: evaluation.influences(study.parameters, *series(done, study, one)) for one in shown if len(series(done, study, one)[1]) > 2}
    bars = {one: chart for one, chart in bars.items() if chart}
    if bars:
        charts.draw_influences(bars, folder / "correlation.png")
        drawn["correlation"] = ("Rank correlation (Spearman) with each parameter; within the grey band (pale bars) it cannot be told from none "
                                "with this number of runs (95 %)")
    return drawn


def summary(study, done):
    """[(is good, label, text)]: how many runs there are, what is missing, what their checks say."""
    n_runs, n_done = len(study.rows), len(done.numbers)
    n_missing = n_runs - n_done
    words = [one.word for one in done.verdicts.values()]
    missing = "".join(f", {words.count(word)} {word}" for word in ("failed", "stopped", "not run") if word in words)
    lines = [(not n_missing, "Runs", f"{n_done} of {n_runs} evaluated{missing}")]
    if n_missing and study.sampling != "one at a time":
        lines.append((False, "Missing", f"probabilities and quantiles hold for the {n_done} runs; over all {n_runs} runs, a probability may differ by up to "
                      f"{100 * n_missing / n_runs:.2g} %"))
    for label, kind, what in (("Checks", "faults", "have a fault"), ("Resolution", "coarse", "are coarse, cut off or not final")):
        found = [names for names in (getattr(done.verdicts[number], kind) for number in done.numbers) if names]
        names = [name for names in found for name in names]
        which = ", ".join(f"{name} in {names.count(name)}" for name in sorted(set(names), key=lambda name: -names.count(name)))
        lines.append((not found, label, f"{len(found)} of {n_done} runs {what}: {which}" if found else f"all {n_done} runs are within the bounds"))
    n_lost = sum(row.get(evaluation.Result("mass_lost", "Mass lost", "kg"), 0.) > 0 for row in done.numbers.values())
    if n_lost:
        lines.append((False, "Box", f"in {n_lost} of {n_done} runs soil has left through open walls: their run-out is a lower bound. Enlarge the box"))
    factors = [value for row in done.numbers.values() for one, value in row.items() if one.key == "factor"]
    if factors and study.sampling != "one at a time":
        lines.append((True, "Factor", f"mean {np.mean(factors):.3g}, standard deviation {np.std(factors, ddof=len(factors) > 1):.2g}; "
                      f"{sum(value < 1 for value in factors)} of {len(factors)} runs are below 1"))
    if best := nearest(done):
        values = ", ".join(f"{one.label} = {_short(value)}" for one, value in zip(study.parameters, study.rows[study.numbers.index(best[0])]))
        lines.append((True, "Nearest", f"run {best[0]} has the largest critical success index of the impact, {best[1]:.3f}: {values}"))
    for quantity, thresholds in study.thresholds.items():
        largest = max((row.get(one, 0.) for row in done.numbers.values() for one in row if one.key == evaluation.MAPS[quantity]), default=0.)
        unit, factor = charts.UNITS[quantity]
        for threshold in thresholds:
            if factor * threshold > largest:
                lines.append((False, "Threshold", f"no run has a {charts.threshold_text(quantity, threshold)}; the largest is {largest:.4g} {unit}"))
    return lines


def _parameters(study):
    rows = []
    for place, one in enumerate(study.parameters):
        used = [row[place] for row in study.rows]
        is_number = all(isinstance(value, (int, float)) for value in used)
        rows.append((one.label, one.distribution.text(), _short(min(used)) if is_number else "-", _short(max(used)) if is_number else "-",
                     _short(study.base.get(one.entry, "default")) if not one.is_factor else "1"))
    return report.table(rows, ("parameter", "distribution", "smallest value", "largest value", "base case"))


def _short(value):
    return f"{value:.5g}" if isinstance(value, float) else str(value)


def _quantile_table(study, done):
    if study.sampling == "one at a time":
        return ""
    rows = []
    for one in done.results:
        _, values = series(done, study, one)
        if len(values) > 1 and one.key != "mass_lost":
            rows.append((one.name, one.unit, *map(float, evaluation.quantiles(values)), float(np.mean(values)), float(min(values)), float(max(values))))
    head = ("result", "unit", *(f"{100 * part:g} %" for part in evaluation.QUANTILES), "mean", "smallest", "largest")
    return report.table(rows, head) + '\n<p class="note">The given part of the runs stays below the value.</p>' if rows else ""


def _run_table(study, done):
    rows = []
    for number, row in zip(study.numbers, study.rows):
        verdict, found = done.verdicts[number], done.numbers.get(number, {})
        rows.append((number, *map(_short, row), verdict.word, _checks(verdict), *(f"{found[one]:.5g}" if one in found else "" for one in done.results)))
    head = ("run", *(one.label for one in study.parameters), "verdict", "checks", *(one.label for one in done.results))
    return f'<div style="overflow-x: auto">{report.table(rows, head)}</div>'


def page(study, done, probabilities, pictures):
    """The text of the report."""
    def figures(*names):
        return "\n".join(report.figure(pictures[name], (study.folder / f"{name}.png").read_bytes()) for name in names if name in pictures)

    failed = [(number, one.word, one.message) for number, one in done.verdicts.items() if one.word in ("failed", "stopped")]
    texts = [(study.file.name, study.file.read_text(encoding="utf-8").strip()), (f"Base case, {study.case.name}", variants.read_case(study.case))]
    files = "".join(f"<details><summary>{html.escape(heading)}</summary><pre>{html.escape(text)}</pre></details>" for heading, text in texts)
    sections = [
        ("verdict", "Verdict", "\n".join(f'<div class="{"good" if is_good else "bad"}"><b>{label}</b> {html.escape(text)}</div>'
                                         for is_good, label, text in summary(study, done))),
        ("parameters", "Parameters", f"<p>Sampling: {html.escape(study.sampling)}, {len(study.rows)} runs.</p>\n" + _parameters(study)),
        ("maps", "Maps" if probabilities else "", figures("probability")),
        ("event", "Comparison with the event" if "nearest" in pictures else "", figures("nearest")),
        ("run_out", "Run-out and other results", figures("run_out") + _quantile_table(study, done)),
        ("influence", "Influence of the parameters", figures("tornado", "correlation", "values")),
        ("failed", "Failed runs", report.table(failed, ("run", "verdict", "message")) if failed else ""),
        ("runs", "Runs", _run_table(study, done)),
        ("study", "Study", files),
    ]
    return report.document(study.folder.resolve().name, "scenarios of Scree", report.description(study.file), sections)

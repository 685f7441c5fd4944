# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a fit writes: report, tables, entries to paste into a case, picture."""

import matplotlib.pyplot as plt
import numpy as np

from scree import results, variants
from scree.command import aligned
from scree.fit import laboratory
from scree.pictures.panels import save_picture

TEST, LAW = "0.35", "#c8553d"


def write_all(problem, runs, solution):
    """All files of the folder; returns the report."""
    folder = problem.folder
    (folder / "cases").mkdir(parents=True, exist_ok=True)
    for test in problem.tests:
        (folder / "cases" / f"{test.name}.prm").write_text(runs.case(test, solution.values, str(folder / "paths" / test.name)), encoding="utf-8")
    report = text(problem, runs, solution)
    (folder / "report.txt").write_text(report + "\n", encoding="utf-8")
    (folder / "fitted.prm").write_text(snippet(problem, solution), encoding="utf-8")
    _write_parameters(folder / "parameters.csv", problem, solution)
    _write_residuals(folder / "residuals.csv", problem, solution)
    draw(problem, solution, folder / "fit.png")
    return report


def _pairs(problem, solution):
    """(test, its table of the law, column, the law's values at its rows)."""
    for test, table in zip(problem.tests, solution.laws):
        for column in test.columns:
            yield test, table, column, laboratory.at_rows(column, test.coordinate, table, test.strain)


def text(problem, runs, solution):
    """Values, correlations, differences, flags; the same on the screen and in report.txt."""
    parts = [f"Fit of {problem.file}: {len(problem.tests)} tests, {problem.n_values} values, {len(problem.parameters)} free entries\n"
             f"{solution.n_evaluations} evaluations, {runs.n_runs} runs, {len(runs.failures)} failed, wall time {solution.seconds:.0f} s; "
             f"sum of squares {solution.start_cost:.4g} at the start, {solution.cost:.4g} at the end",
             aligned(["", "entry", "start", "fitted", "sigma", "low", "high"],
                    [[f"[{number}]", one.entry, *(f"{value:.5g}" for value in (one.start, value)), f"{sigma:.2g}", f"{one.low:g}", f"{one.high:g}"]
                     for number, (one, value, sigma) in enumerate(zip(problem.parameters, solution.values, solution.sigma), 1)]),
             aligned(["correlation", *(f"[{number}]" for number in range(1, 1 + len(solution.values)))],
                    [[f"[{number}]", *(f"{value:+.2f}" for value in row[:number])] + [""] * (len(row) - number)
                     for number, row in enumerate(solution.correlation, 1)]),
             aligned(["test", "quantity", "values", "rms", "", "largest"],
                    [[test.name, column.name, str(len(column.values)), f"{rms:.3g}", unit, f"{100 * (column.largest if column.is_strain else 1.) * np.max(np.abs(column.differences(law))):.3g}"]
                     for test, _, column, law in _pairs(problem, solution) for rms, unit in [column.rms(law)]]),
             "\n".join(f"FLAG  {flag}." for flag in solution.flags) or "No flags."]
    if runs.failures:
        name, values, message = runs.failures[-1]
        shown = ", ".join(f"{parameter.entry} = {value:.4g}" for parameter, value in zip(problem.parameters, values))
        parts.append(f"{len(runs.failures)} runs failed; the fit went on without them. The last one: test {name} with {shown}: {message}")
    return "\n\n".join(parts)


def _write_parameters(file, problem, solution):
    results.write_rows(file, ["entry", "start", "fitted", "sigma", "low", "high", *(f"correlation with {one.entry}" for one in problem.parameters)], (
        [one.entry, one.start, f"{value:.9g}", f"{sigma:.4g}", one.low, one.high, *(f"{number:.5f}" for number in correlation)]
        for one, value, sigma, correlation in zip(problem.parameters, solution.values, solution.sigma, solution.correlation)))


def _write_residuals(file, problem, solution):
    results.write_rows(file, ["test", "quantity", "unit", "strain", "measured", "law", "difference", "row_weight"], (
        [test.name, column.name, "-" if column.is_strain else "Pa", *(f"{number:.7g}" for number in values)]
        for test, _, column, law in _pairs(problem, solution)
        for values in zip(column.strain, column.values, law, law - column.values, column.row_weights)))


def snippet(problem, solution):
    """The law's entries that all tests share, with the fitted ones, for the subsection of a body or a case of scree-element."""
    cases = [{**variants.read_entries(test.case), **test.entries} for test in problem.tests]
    law = cases[0].get("Material", "Nor-Sand")
    fitted = {one.entry: (f"{value:.6g}", f"  # sigma {sigma:.2g}") for one, value, sigma in zip(problem.parameters, solution.values, solution.sigma)}
    shared = {entry: (value, "") for entry, value in cases[0].items() if entry.startswith(law + "/") and all(case.get(entry) == value for case in cases)}
    lines = [f"# Fitted to {', '.join(test.name for test in problem.tests)} by scree-element --fit {problem.file.name}.",
             *(f"# FLAG {flag}." for flag in solution.flags), f"set Material = {law}"]
    different = sorted({entry for case in cases for entry in case if entry.startswith(law + "/")} - set(shared) - set(fitted))
    lines += [f"# Differs between the tests: {entry} = {', '.join(case.get(entry, 'default') for case in cases)}." for entry in different]
    entries = {entry: value + comment for entry, (value, comment) in {**shared, **fitted}.items()}
    return variants.set_entries("\n".join(lines) + "\n", entries).rstrip("\n") + "\n"


def draw(problem, solution, file):
    """A row of panels for each test: the table as dots, the law as a line."""
    n_columns = max(len(test.columns) for test in problem.tests)
    figure, panels = plt.subplots(len(problem.tests), n_columns, figsize=(0.5 + 4.6 * n_columns, 0.4 + 2.9 * len(problem.tests)), squeeze=False,
                                  layout="constrained")
    for row, test, table in zip(panels, problem.tests, solution.laws):
        x = 100 * laboratory.law_values(test.coordinate, table, test.strain)
        for axes in row[len(test.columns):]:
            axes.set_axis_off()
        for axes, column in zip(row, test.columns):
            factor, unit = (100., "%") if column.is_strain else (1e-3, "kPa")
            axes.plot(100 * column.strain, factor * column.values, "o", ms=3, mfc="none", color=TEST, label="test")
            axes.plot(x, factor * laboratory.law_values(column.name, table, test.strain), color=LAW, lw=1.6, label="law")
            number, of = column.rms(laboratory.at_rows(column, test.coordinate, table, test.strain))
            axes.set_title(f"{test.name}: rms {number:.2g} {of}", fontsize=9, loc="left")
            axes.set(xlabel=f"{test.coordinate.replace('_', ' ')} (%)", ylabel=f"{column.name.replace('_', ' ')} ({unit})")
            if column.is_logarithmic:
                axes.set_yscale("log")
            axes.grid(alpha=0.3)
    panels[0, 0].legend(fontsize=8)
    save_picture(figure, file, 120)

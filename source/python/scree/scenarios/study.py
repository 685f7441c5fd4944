# SPDX-License-Identifier: LGPL-2.1-or-later
"""The file of a study, in TOML: base case, parameters with distributions, sampling, thresholds."""

import contextlib
import os
import pathlib
import subprocess
import tempfile
from typing import NamedTuple

import numpy as np

from scree import command, results, settings, variants
from scree.scenarios import observed, sampling
from scree.scenarios.evaluation import FACTOR

TABLES = ("set", "parameters", "factors", "thresholds", "observed")
KEYS = ("case", "results", "sampling", "runs", "seed", "quantiles", "levels", "run_out", "run_out_thickness", *TABLES)
QUANTITIES = {"thickness": "m", "speed": "m/s", "pressure": "Pa"}


class Parameter(NamedTuple):
    """An entry of the case that differs between runs: its value or, if `is_factor`, what multiplies its value or its raster."""
    entry: str
    distribution: sampling.Distribution
    is_factor: bool

    @property
    def label(self):
        return self.entry + (", factor" if self.is_factor else "")


class Study(NamedTuple):
    """A study whose entries have been checked; `rows` has the values of the parameters for each run."""
    file: pathlib.Path
    case: pathlib.Path
    folder: pathlib.Path
    sampling: str
    fixed: dict
    parameters: list
    rows: list
    thresholds: dict
    run_out: str
    run_out_thickness: float
    event: observed.Observed | None = None

    @property
    def numbers(self):
        """The numbers of the runs, as in the names of their files."""
        digits = max(4, len(str(len(self.rows))))
        return [f"{number:0{digits}d}" for number in range(1, 1 + len(self.rows))]

    def run(self, number):
        """The run folder."""
        return self.folder / "runs" / number

    def finished(self, number):
        """The folder with log and checks of a run that has ended: of a factor of safety that of the last trial that rests."""
        return self.run(number) / "safety" / "rests" if self.run_out == FACTOR else self.run(number)

    @property
    def base(self):
        return variants.read_entries(self.case)


def read(file):
    """Reads and checks a study. Throws a ValueError with file, entry, value and remedy."""
    file = pathlib.Path(file)
    given = settings.read(file, KEYS, TABLES)
    if "case" not in given:
        raise ValueError(f'{file}: the base case is missing. Write for instance case = "slope.prm"; its path counts from this file')
    case = settings.path(file, "case", given["case"])
    base = variants.read_entries(case)
    fixed = {key: settings.text(value) for key, value in given.get("set", {}).items()}
    parameters = [_parameter(file, table, entry, value) for table in ("parameters", "factors") for entry, value in given.get(table, {}).items()]
    if not parameters:
        raise ValueError(f"{file}: no entry differs between the runs. Write one into [parameters] or [factors]")
    entries = {kind: [one.entry for one in parameters if one.is_factor == (kind == "factors")] for kind in ("parameters", "factors")}
    settings.check_entries(file, base, {"set": fixed, **entries}, fixed, {
        "Output directory": ': the runs have folders of their own. Name that of the study by the entry "results"'})
    for key, value in fixed.items():
        _check_file(file, case, base, "set", key, value)
    fixed = {key: _moved(file, value) for key, value in fixed.items()}
    for table in ("thresholds", "observed") if given.get("run_out") == FACTOR else ():
        if table in given:
            raise ValueError(f'{file}: [{table}] has no effect with run_out = "{FACTOR}". Remove it')
    if given.get("run_out") != FACTOR:
        fixed = {"Output/Maps/Write": "true", "Output/Graphics": "none", **fixed}
    kind = given.get("sampling", "Sobol")
    study = Study(file, case, pathlib.Path(given.get("results", f"results/{file.stem}")), kind, fixed, parameters, _rows(file, given, kind, parameters),
                  _thresholds(file, given), given.get("run_out", "distance"), settings.number(file, given, "run_out_thickness", float({**base, **fixed}.get("Output/Maps/Least thickness", 0.)), unit="m"),
                  _observed(file, given, {**base, **fixed}))
    _check_values(study, base)
    return study


def _parameter(file, table, entry, value):
    try:
        distribution = sampling.distribution_of(value)
    except ValueError as error:
        raise settings.fault(file, entry, value, error, table) from error
    if table == "factors" and distribution.is_list and not all(isinstance(one, (int, float)) for one in distribution.numbers["values"]):
        raise settings.fault(file, entry, value, "factors are numbers", table)
    return Parameter(entry, distribution, table == "factors")


def _rows(file, given, kind, parameters):
    distributions = [one.distribution for one in parameters]
    if kind not in sampling.SAMPLINGS:
        raise settings.fault(file, "sampling", kind, f"there is no such sampling{settings.nearest(str(kind), sampling.SAMPLINGS)}")
    random = ("Latin hypercube", "Sobol")
    for key, kinds in (("runs", random), ("seed", random), ("quantiles", ("one at a time",)), ("levels", ("grid",))):
        if key in given and kind not in kinds:
            raise settings.fault(file, key, given[key], f'this entry has no effect with sampling = "{kind}". Remove it')
    if kind == "one at a time":
        quantiles = given.get("quantiles", [0.05, 0.95])
        is_pair = isinstance(quantiles, list) and len(quantiles) == 2 and all(isinstance(one, float) for one in quantiles)
        if not is_pair or not 0 < quantiles[0] < quantiles[1] < 1:
            raise settings.fault(file, "quantiles", quantiles, "write two numbers between 0 and 1, the lower one first, such as [0.05, 0.95]")
        return sampling.one_at_a_time(distributions, quantiles)
    if kind == "grid":
        return sampling.grid(distributions, settings.count(file, given, "levels", 3, 2))
    if "runs" not in given:
        raise ValueError(f'{file}: entry "runs" is missing. Write their number, for instance runs = 64')
    least, n_runs = len(parameters) + 2, settings.count(file, given, "runs", 0)
    if n_runs < least:
        raise settings.fault(file, "runs", n_runs, f"too few for {len(parameters)} parameters. Write at least {least}; for probabilities 50 or more")
    power = 2**int(np.log2(n_runs))
    if kind == "Sobol" and power != n_runs:
        raise settings.fault(file, "runs", n_runs, f'Sobol\'s sequence is balanced for powers of 2. Write {power} or {2 * power}, or sampling = "Latin hypercube"')
    return sampling.sampled(kind, distributions, n_runs, settings.count(file, given, "seed", 1, 0))


def _thresholds(file, given):
    found = {}
    for name, values in given.get("thresholds", {}).items():
        if name not in QUANTITIES:
            raise settings.fault(file, name, values, f"there is no map of it{settings.nearest(name, list(QUANTITIES))}", "thresholds")
        values = values if isinstance(values, list) else [values]
        for value in values:
            if not settings.is_number(value) or value <= 0:
                raise settings.fault(file, name, value, f"write a number above 0, in {QUANTITIES[name]}", "thresholds")
        found[name] = sorted(set(values))
    return found


def _observed(file, given, entries):
    if "observed" not in given:
        return None
    if str(entries.get("Dimension", "2")) != "3":
        raise ValueError(f"{file}: [observed] compares maps of a case in 3D. Remove the table")
    try:
        return observed.read(file.parent, given["observed"])
    except ValueError as error:
        raise ValueError(f"{file}: [observed], {error}") from error


def _moved(file, value):
    """A value of an entry; the absolute path if it names a file, which counts from the study."""
    path = file.parent / value
    return str(path.resolve()) if value and path.is_file() else value


def _check_file(file, case, base, table, entry, value):
    """Throws a ValueError if the case names a file here, and the study neither a number nor a file that is there."""
    with contextlib.suppress(ValueError):
        float(value)
        return
    if variants.file_named(case, base.get(entry, "")) and not (file.parent / value).is_file():
        raise settings.fault(file, entry, value, f"there is no such file. Its path counts from {file.name}", table)


def _check_values(study, base):
    """That files are there, and that the program reads the case with the extreme values of each parameter, beside medians of the others."""
    for one in study.parameters:
        for value in one.distribution.numbers["values"] if one.distribution.is_list and not one.is_factor else ():
            _check_file(study.file, study.case, base, "parameters", one.entry, settings.text(value))
        if one.is_factor:
            _check_factor(study, one, {**base, **study.fixed}.get(one.entry, ""))
    middle = sampling.medians([one.distribution for one in study.parameters])
    for place, one in enumerate(study.parameters):
        values = [row[place] for row in study.rows]
        for value in dict.fromkeys(values if one.distribution.is_list else (min(values), max(values))):
            _ask_program(study, one, value, middle[:place] + [value] + middle[place + 1:])


def _check_factor(study, one, value):
    is_listed = any(other.entry == one.entry and not other.is_factor for other in study.parameters)
    raster = variants.file_named(study.case, value)
    try:
        if raster:
            results.read_raster(raster)
        elif not is_listed:
            float(value)
    except ValueError as error:
        fault = error if raster else f'a factor needs a number or a raster, and the value of the case is "{value}"'
        raise settings.fault(study.file, one.entry, one.distribution.text(), fault, "factors") from error
    if min(one.distribution.numbers["values"] if one.distribution.is_list else [one.distribution.quantile(0)]) < 0:
        raise settings.fault(study.file, one.entry, one.distribution.text(), "a factor below 0 may occur. Set low = 0 or more", "factors")


def _ask_program(study, one, value, row):
    """Throws a ValueError with what the program says of the entries of a run, if it is there to be asked."""
    program = command.program("scree")
    if program is None:
        return
    with tempfile.TemporaryDirectory() as folder:
        case = pathlib.Path(folder, "case.prm")
        write_case(study, row, case)
        done = subprocess.run([program, str(case), "--print-parameters", "Output"], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        table = "factors" if one.is_factor else "parameters"
        raise settings.fault(study.file, one.entry, value, "the program refuses the case: "
                     + " ".join(done.stderr.split()).replace(f"scree: {case}, ", ""), table)


def write_case(study, row, target, entries=None):
    """Writes the case of a run, and the rasters that are multiplied by factors beside it. `entries`: further ones of this run."""
    target = pathlib.Path(target)
    base, changed = study.base, {**study.fixed, **(entries or {})}
    for one, value in sorted(zip(study.parameters, row), key=lambda pair: pair[0].is_factor):
        before = changed.get(one.entry, base.get(one.entry, ""))
        if not one.is_factor:
            changed[one.entry] = _moved(study.file, settings.text(value))
            continue
        raster = variants.file_named(study.case, before)
        if raster is None:
            changed[one.entry] = f"{float(before) * value:.9g}"
        else:
            scaled = target.with_name(f"{target.stem}_{raster.stem}{'.asc' if raster.suffix.lower() == '.asc' else '.tif'}")
            given = results.read_raster(raster)
            results.write_map(scaled, given._replace(values=value * given.values), raster)
            changed[one.entry] = scaled.name
    variants.write_variant(study.case, target, {entry: os.path.relpath(value, target.parent.resolve()) if os.path.isabs(value) else value
                                                for entry, value in changed.items()})

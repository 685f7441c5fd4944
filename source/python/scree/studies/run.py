# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs studies: variants of a case, a chart, a table and a page with the verdict.

scree-study NAME... | all [--quick] [--list] [--again]

A study is a module of scree.studies.cases. Its runs are kept in folders of results/studies named by the content of their parameter
files: a second call makes what is missing or has changed, so that an interrupted study goes on where it was. The table, the
chart and the page of its topic go to doc/studies/pages; with --quick, a short version is run and checked, and nothing under doc/ is written.
"""

import concurrent.futures
import hashlib
import itertools
import json
import os
import pathlib
import shutil
import subprocess
import tempfile

from scree.command import ROOT, Command, program
from scree.results import read_rows, write_rows
from scree.studies.charts import StabilityMap
from scree.studies.pages import TOPICS, index_text, page_text, topic_of
from scree.studies.rows import Rows
from scree.studies.study import Run, Variant, prm_files, study_of

INTERRUPTED = {-2, -9, -15, 130, 137, 143}  # by SIGINT, SIGKILL, SIGTERM, itself or below `timeout`: such a run is not kept

PAGES = ROOT / "doc" / "studies" / "pages"


def names_of_studies():
    return sorted(file.stem for file in pathlib.Path(__file__).with_name("cases").glob("[a-z]*.py"))


def case_text(study, variant, folder=None):
    """The variant's parameter file, without an output directory; paths of files count from `folder`, or from the base."""
    text = prm_files.read_case(ROOT / (variant.base or study.base), folder)
    return prm_files.set_entries(text, {"Output/Checkpoint interval": 0, **study.entries, **variant.entries}) + "\n"


def folder_of(study, variant, results):
    """Runs of one content share a folder, whichever study or label they serve."""
    command = " ".join(("scree", *study.options))
    return results / hashlib.sha256(f"{command} {variant.ranks}\n{case_text(study, variant)}".encode()).hexdigest()[:12]


def load_run(folder, labels):
    """The run in a folder, None if there is none that has ended."""
    record = folder / "run.json"
    if not record.exists():
        return None
    return Run(folder, labels, **json.loads(record.read_text(encoding="utf-8")))


def make_run(study, variant, folder, arguments):
    """Runs one variant in `folder`, which it empties before."""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    prm, screen = folder / "case.prm", folder / "screen.txt"
    prm.write_text(prm_files.set_entry(case_text(study, variant, folder), "Output directory", folder).rstrip("\n") + "\n", encoding="utf-8")
    environment = dict(os.environ, DEAL_II_NUM_THREADS="1", OMP_NUM_THREADS="1", **study.environment())
    if os.geteuid() == 0:
        environment.update(OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
    launcher = ["mpirun", "-np", str(variant.ranks)] if variant.ranks > 1 else []
    if variant.ranks > (os.cpu_count() or 1):
        launcher += ["--oversubscribe", "--mca", "mpi_yield_when_idle", "1"]
    command = ["timeout", "7200", *launcher, arguments.program, *study.options, prm]
    # Runs of Open MPI side by side share folders, which the last one to end removes under one that begins: each has its own.
    with open(screen, "w", encoding="utf-8") as output, tempfile.TemporaryDirectory(prefix="scree_", ignore_cleanup_errors=True) as temporary:
        environment["TMPDIR"] = temporary
        process = subprocess.Popen(command, cwd=ROOT, env=environment, stdout=output, stderr=subprocess.STDOUT)
        _, status, usage = os.wait4(process.pid, 0)
    code = os.waitstatus_to_exitcode(status)
    process.returncode = code  # it has been waited for
    if code in INTERRUPTED:
        raise RuntimeError(f"{prm} was interrupted; {screen} has what it said. Start the study again: it goes on from here.")
    record = {"exit_code": code, "core_seconds": usage.ru_utime + usage.ru_stime}
    run = Run(folder, variant.labels, **record)
    if run.ended:
        study.after(run, arguments.program)
    (folder / "run.json").write_text(json.dumps(record), encoding="utf-8")
    return run


def make_runs(name, study, arguments):
    """The runs of all variants, in their order, each with the reference's; with progress."""
    variants = [variant for variant in study.variants if not arguments.quick or study.quick(variant.labels)]
    reference = study.quick_reference if arguments.quick and study.quick_reference is not None else study.reference
    if reference is not None:
        variants.insert(0, Variant({"reference": "reference"}, reference))
    folders = [folder_of(study, variant, arguments.results) for variant in variants]
    missing = {folder: variant for variant, folder in zip(variants, folders) if arguments.again or load_run(folder, variant.labels) is None}
    jobs = 1 if study.chart.timed else max(1, arguments.jobs // max(variant.ranks for variant in variants))
    n_runs, done = len(set(folders)), itertools.count(1)
    print(f"{name}: {n_runs} runs, {n_runs - len(missing)} of them are there", flush=True)

    def make(folder):
        run = make_run(study, missing[folder], folder, arguments)
        print(f"  {next(done)} of {len(missing)}: " + ", ".join(f"{key} {value}" for key, value in run.labels.items())
              + f": {folder.name}" + ("" if run.ended else f" (ended with {run.exit_code})"), flush=True)

    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        list(pool.map(make, missing))
    runs = [load_run(folder, variant.labels) for variant, folder in zip(variants, folders)]
    of_reference = runs.pop(0) if reference is not None else None
    for run in runs:
        run.reference = of_reference
    return runs


def _text(value):
    return f"{value:.5g}" if isinstance(value, (float, int)) and not isinstance(value, bool) else str(value)


def _value(word):
    if word in ("True", "False"):
        return word == "True"
    try:
        return float(word)
    except ValueError:
        return word


def write_table(rows, table):
    names = list(dict.fromkeys(name for row in rows for name in row))
    write_rows(table, names, ([_text(row.get(name, "nan")) for name in names] for row in rows))


def read_table(table):
    """The rows of a table: numbers are floats, True and False are themselves, the rest is text."""
    return Rows({name: _value(word) for name, word in row.items()} for row in read_rows(table))


def row_of(study, run):
    row = {**run.labels, "ended": run.ended, **run.cost}
    if study.default is not None:
        row["default"] = all(run.labels.get(name, value) == value for name, value in study.default.items())
    if run.ended or not study.needs_end:
        row.update(study.measure(run))
        study.chart.keep(run)
    return row


def page_texts():
    """{file: text} of the list of the studies and of all pages, from the committed tables."""
    studies = {}
    for name in names_of_studies():
        table, study = PAGES / f"{name}.csv", study_of(name)
        if table.exists():
            rows = read_table(table)
            studies[name] = study, rows, study.verdict(rows)
    return {PAGES / "README.md": index_text(studies),
            **{PAGES / f"{topic}.md": page_text(topic, studies) for topic, (_, names) in TOPICS.items() if set(names) & studies.keys()}}


def finish(name, study, folder, rows=None):
    """Writes table and chart of a study into `folder` (the chart from the table in it without `rows`); returns the claims."""
    folder.mkdir(parents=True, exist_ok=True)
    table = folder / f"{name}.csv"
    if rows is not None:
        write_table(rows, table)
    rows = read_table(table)
    claims = study.verdict(rows)
    study.chart.write(rows, folder / name)
    return claims


def cells_lost(name, study, folder):
    """Labels of the default cells of a map that the table in `folder` does not call stable, where the committed one does or does not know them."""
    if not isinstance(study.chart, StabilityMap):
        return []
    labels = list(study.variants[0].labels)

    def stable(table):
        return {tuple(row[label] for label in labels): row["state"] == "stable" for row in read_table(table) if row["default"]}
    committed = stable(PAGES / f"{name}.csv")
    return [cell for cell, holds in stable(folder / f"{name}.csv").items() if not holds and committed.get(cell, True)]


def run_study(name, arguments):
    """True if all claims hold, and in the short version also if the map is what the committed table says."""
    study = study_of(name)
    folder = arguments.results / "quick" if arguments.quick else PAGES
    rows = None if arguments.page else [row_of(study, run) for run in make_runs(name, study, arguments)]
    claims = [claim for claim in finish(name, study, folder, rows) if claim.quick or not arguments.quick]
    for claim in claims:
        print(f"  {'holds' if claim.holds else 'DOES NOT HOLD'}: {claim.text}")
    lost = cells_lost(name, study, folder) if arguments.quick else []
    if lost:
        print(f"  no longer stable, as {PAGES / topic_of(name)}.md says: {'; '.join(', '.join(map(_text, cell)) for cell in lost)}")
    return not lost and all(claim.holds for claim in claims)


def run_studies(arguments):
    """0 if all claims hold, 1 else."""
    if arguments.list:
        print("\n".join(names_of_studies()))
        return 0
    unknown = sorted(set(arguments.names) - {"all", *names_of_studies()})
    if unknown or not arguments.names:
        raise ValueError((f"no study {', '.join(unknown)}" if unknown else "name a study, or all") + f"; there are {', '.join(names_of_studies())}")
    if not arguments.page and not (arguments.program and os.access(arguments.program, os.X_OK)):
        raise ValueError(f"{arguments.program or 'scree'} is not there: build it (sh doc/quickstart.sh), or name it with --program")
    arguments.program, arguments.results = pathlib.Path(arguments.program or "").resolve(), arguments.results.resolve()
    names = names_of_studies() if "all" in arguments.names else arguments.names
    held = [run_study(name, arguments) for name in names]
    if not arguments.quick:
        for file, text in page_texts().items():
            file.write_text(text, encoding="utf-8")
    return 0 if all(held) else 1


def main():
    parser = Command("scree-study", __doc__)
    parser.add_argument("names", nargs="*", metavar="NAME", help="studies, or all")
    parser.add_argument("--quick", action="store_true", help="the short version, into results/studies/quick")
    parser.add_argument("--list", action="store_true", help="names of the studies")
    parser.add_argument("--page", action="store_true", help="write chart and page again from the table that is there")
    parser.add_argument("--again", action="store_true", help="repeat runs that are there already")
    parser.add_argument("--program", type=pathlib.Path, default=program("scree"), help="default: scree of the build, or of the PATH")
    parser.add_argument("--results", type=pathlib.Path, default=ROOT / "results" / "studies", help="folder of the runs; default results/studies")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="runs at a time where times are not compared; default %(default)d")
    parser.run(run_studies)

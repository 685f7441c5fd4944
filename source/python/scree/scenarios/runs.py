# SPDX-License-Identifier: LGPL-2.1-or-later
"""The runs of a study: their cases, Snakemake that starts them, progress and verdicts."""

import contextlib
import fcntl
import json
import pathlib
import re
import shutil
import subprocess
import tempfile
import time
from typing import NamedTuple

from scree import command, results, variants
from scree.scenarios import study as studies
from scree.scenarios.evaluation import FACTOR

SNAKEFILE = pathlib.Path(__file__).with_name("Snakefile.txt")
MISSING = "Install Debian's package snakemake: apt-get install --no-install-recommends snakemake"


class Verdict(NamedTuple):
    """How a run has ended: "finished", "failed", "stopped" or "not run"; names of its faults; message of a failure; wall time, s; what is coarse."""
    word: str
    faults: tuple = ()
    message: str = ""
    seconds: float = float("nan")
    coarse: tuple = ()


def verdict(study, number):
    run = study.run(number)
    if not (run / "finished").exists():
        if not (run / "failed").exists():
            return Verdict("not run")
        code = (run / "failed").read_text(encoding="utf-8").strip()
        lines = (run / "screen.txt").read_text(encoding="utf-8", errors="replace").strip().splitlines() if (run / "screen.txt").exists() else []
        told = [line for line in lines if line.startswith("scree: ")] or lines or [""]
        return Verdict("stopped" if code == "3" else "failed", (), f"exit code {code}: {told[-1].removeprefix('scree: ')}")
    seconds = re.match(r"wall time (\S+) s", results.read_log(study.finished(number)).parts.get("Finished", ""))
    faults, coarse = (tuple(check.name for check in results.read_checks(study.finished(number)) if check.is_exceeded and check.kind == kind) for kind in ("fault", "resolution"))
    return Verdict("finished", faults, "", float(seconds.group(1)) if seconds else float("nan"), coarse)


def verdicts(study):
    """By numbers. A run of other values, from before a change of the study or the case, counts as not run."""
    file = study.folder / "values.json"
    known = json.loads(file.read_text(encoding="utf-8")) if file.exists() else {}
    wanted = _values(study)
    return {number: verdict(study, number) if known.get(number) == wanted[number] else Verdict("not run") for number in study.numbers}


def _values(study):
    """{number: all entries of the run, before factors, and its parameters}."""
    entries = {**study.base, **study.fixed}
    return {number: {"case": entries, "parameters": {one.label: value for one, value in zip(study.parameters, row)}}
            for number, row in zip(study.numbers, study.rows)}


@contextlib.contextmanager
def only_one(study):
    """Throws a ValueError if another scree-scenarios works in the folder."""
    study.folder.mkdir(parents=True, exist_ok=True)
    with open(study.folder / "lock", "w", encoding="utf-8") as lock:
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError as error:
            raise ValueError(f"{study.folder}: another scree-scenarios works in this folder. Wait for its end, or write another entry \"results\"") from error
        yield


def prepare(study, n_ranks):
    """Writes cases and Snakefile. Runs whose case or rasters have changed are deleted; the others stay as they are."""
    (study.folder / "cases").mkdir(parents=True, exist_ok=True)
    shutil.copy(study.file, study.folder / "study.toml")
    shutil.rmtree(study.folder / "new", ignore_errors=True)
    (study.folder / "new").mkdir()
    for number, row in zip(study.numbers, study.rows):
        studies.write_case(study, row, study.folder / "new" / f"{number}.prm", {"Output directory": f"runs/{number}"})
        for file in sorted((study.folder / "new").iterdir()):
            old = study.folder / "cases" / file.name
            if old.exists() and old.read_bytes() == file.read_bytes():
                file.unlink()
            else:
                file.replace(old)
        if study.run(number).exists() and _is_stale(study, number):
            shutil.rmtree(study.run(number))
    shutil.rmtree(study.folder / "new")
    (study.folder / "values.json").write_text(json.dumps(_values(study)), encoding="utf-8")
    command_line = [*(["mpirun", "-np", str(n_ranks)] if n_ranks > 1 else []), str(pathlib.Path(command.needed("scree")).resolve()),
                    *(["--safety"] if study.run_out == FACTOR else [])]
    config = {"runs": study.numbers, "ranks": n_ranks, "program": command_line}
    (study.folder / "runs.json").write_text(json.dumps(config), encoding="utf-8")
    shutil.copy(SNAKEFILE, study.folder / "Snakefile")


def _is_stale(study, number):
    """Whether the case or a file that it names is newer than the start of the run."""
    case = study.folder / "cases" / f"{number}.prm"
    started = study.finished(number) / "original.prm"
    if not started.exists():
        return True
    files = [case, *filter(None, (variants.file_named(case, value) for value in variants.read_entries(case).values()))]
    return any(file.stat().st_mtime_ns > started.stat().st_mtime_ns for file in files)


def estimate(study):
    """Wall time of a run, s, and where it is from: the mean of finished runs, or what the program expects of the first run."""
    known = [one.seconds for one in verdicts(study).values() if one.seconds > 0] if study.folder.exists() else []
    if known:
        return sum(known) / len(known), f"mean of {len(known)} finished runs"
    with tempfile.TemporaryDirectory() as folder:
        case = pathlib.Path(folder, "case.prm")
        studies.write_case(study, study.rows[0], case)
        done = subprocess.run([command.needed("scree"), str(case), "--advise"], capture_output=True, text=True, check=False, cwd=folder)
    found = re.search(r"^ +run +(\S+) core-seconds", done.stdout, re.MULTILINE)
    if done.returncode != 0 or not found:
        reason = done.stderr.strip().splitlines() or ["it tells no time"]
        return float("nan"), f"scree --advise of the first run gives none: {reason[-1]}"
    n_trials = 10 if study.run_out == FACTOR else 1
    return n_trials * float(found.group(1)) + 1, ("ten trials of " if n_trials > 1 else "") + "scree --advise of the first run, and 1 s for its start"


def duration(seconds):
    if not seconds < 1e9:
        return "?"
    return f"{seconds:.0f} s" if seconds < 100 else f"{seconds / 60:.0f} min" if seconds < 6000 else f"{seconds / 3600:.1f} h"


def start(study, n_cores, n_ranks, profile, sleep=0.5):
    """Runs what is missing; returns whether it was interrupted. Tells the progress on the screen."""
    waiting = [number for number in study.numbers if not (study.run(number) / "finished").exists()]
    if not waiting:
        print(f"All {len(study.rows)} runs are there already.")
        return False
    snakemake = shutil.which("snakemake")
    if snakemake is None:
        raise ValueError(f"the runs need Snakemake. {MISSING}")
    for number in waiting:
        (study.run(number) / "failed").unlink(missing_ok=True)
    # One scree-scenarios at a time has the folder: Snakemake's own lock would outlive a killed one.
    call = [snakemake, "--directory", str(study.folder), "--snakefile", str(study.folder / "Snakefile"), "--keep-going", "--nolock", "--nocolor",
            "--rerun-incomplete", "--rerun-triggers", "mtime", "--scheduler", "greedy",
            *(["--profile", str(pathlib.Path(profile).resolve())] if profile else []),
            *(["--cores", str(max(n_cores, n_ranks))] if n_cores else [])]
    print(f"{study.folder}: {len(study.rows)} runs, {len(waiting)} to do" + (f", {max(1, n_cores // n_ranks)} at a time" if n_cores else ""), flush=True)
    with open(study.folder / "snakemake.log", "w", encoding="utf-8") as log, \
            subprocess.Popen(call, stdout=log, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL) as process:
        try:
            _watch(study, waiting, process, sleep)
        except KeyboardInterrupt:
            print("Interrupted: the runs write checkpoints and stop.", flush=True)
            process.wait()
            return True
    if process.returncode != 0 and not any((study.run(number) / name).exists() for number in waiting for name in ("failed", "finished")):
        log = study.folder / "snakemake.log"
        told = log.read_text(encoding="utf-8", errors="replace").strip().splitlines()
        raise ValueError(f"Snakemake has started no run: {told[-1] if told else 'no message'} (its log: {log})")
    return False


def _watch(study, waiting, process, sleep):
    """Prints a line when a run has ended, at most one in 5 s."""
    begin, told, told_time, is_over = time.monotonic(), 0, -1e9, False
    print(f"{'runs ended':>14}{'failed':>9}{'elapsed':>11}{'remaining':>12}", flush=True)
    while not is_over:
        is_over = process.poll() is not None
        good, bad = (sum((study.run(number) / name).exists() for number in waiting) for name in ("finished", "failed"))
        now = time.monotonic()
        if good + bad > told and (now - told_time > 5 or is_over or good + bad == len(waiting)):
            elapsed = now - begin
            left = elapsed / (good + bad) * (len(waiting) - good - bad)
            print(f"{f'{good + bad}/{len(waiting)}':>14}{bad:>9}{duration(elapsed):>11}{duration(left):>12}", flush=True)
            told, told_time = good + bad, now
        if not is_over:
            time.sleep(sleep)

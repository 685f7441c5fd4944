# SPDX-License-Identifier: LGPL-2.1-or-later
"""run_folder.py SCREE LAUNCHER TEST: what becomes of a run folder when runs are killed, stopped or in each other's way.

Each test is a function below; it works in the current folder. LAUNCHER is "mpirun -np" or alike.
"""

import atexit
import os
import pathlib
import random
import re
import resource
import shutil
import signal
import subprocess
import sys
import time

from scree.variants import set_entries

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent / "cases"))
from case_tools import LAUNCHER, SCREE, check, log_of  # pylint: disable=wrong-import-position
from compare_statistics import compare  # pylint: disable=wrong-import-position

# A small dry column with many rows: what happens to the run folder is tested with it, not what it computes.
CASE = set_entries("", {
    "End time": 0.1, "Output directory": "results", "Mesh/Upper corner": "1.5, 0.8", "Mesh/Cell size": 0.1, "Transfer/Method": "FLIP",
    "Transfer/PIC rate": 5, "Soil/Region": "x < 0.5 && y < 0.5", "Soil/Points per cell": 4, "Soil/Initial state/Type": "K0",
    "Soil/Initial state/K0": 0.683, "Output/Interval": 0.02, "Output/Statistics interval": 0.002, "Output/Screen": "nothing",
    "Output/Graphics": "points"}) + "\n"
RESULTS = pathlib.Path("results")
STATISTICS = RESULTS / "statistics.csv"
PATIENCE = 100  # s; far beyond what anything here takes
STOPPED = 3  # the exit code


def write_case(name, entries=(), text=CASE):
    """A variant of the case with `entries`, such as "End time = 1"; others than this one are of subsection Output."""
    pairs = (entry.split(" = ") for entry in entries)
    text = set_entries(text, {key if key == "End time" else "Output/" + key: value for key, value in pairs})
    pathlib.Path(name).write_text(text + "\n", encoding="utf-8")


def start(case, *options, ranks=1, **how):
    command = ([*LAUNCHER, str(ranks)] if ranks > 1 else []) + [SCREE, case, *options]
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, **how)
    atexit.register(process.kill)  # Nothing is left behind by a test that fails.
    return process


def end(process, wanted, what=""):
    """Standard error of a process that ends with the wanted exit code; None: with any."""
    _, errors = process.communicate(timeout=PATIENCE)
    check(wanted in (process.returncode, None), f"{what}: exit code {process.returncode}, not {wanted}: {errors}")
    return errors


def run(case, *options, wanted=0, **how):
    return end(start(case, *options, **how), wanted, f"{case} {' '.join(options)}")


def content():
    return STATISTICS.read_bytes() if STATISTICS.exists() else b""


def n_pictures():
    """How many pictures points.pvd names: all of them are whole, and so are their pieces."""
    folder = RESULTS / "solution"
    series = folder / "points.pvd"
    pictures = re.findall(r'file="([^"]+)"', series.read_text(encoding="utf-8")) if series.exists() else []
    for picture in pictures:
        for piece in re.findall(r'Source="([^"]+)"', (folder / picture).read_text(encoding="utf-8")):
            check((folder / piece).read_bytes().rstrip().endswith(b"</VTKFile>"), f"{piece} is cut")
    return len(pictures)


def n_rows():
    return max(0, len(content().splitlines()) - 1)


def log():
    return log_of(RESULTS)


def wait_for(fact, process=None):
    before = time.monotonic()
    while not fact():
        check(time.monotonic() - before < PATIENCE, "nothing happens")
        if process and process.poll() is not None:
            return
        time.sleep(0.002)


def check_tidy(what):
    check(not (RESULTS / "lock").exists() and not (RESULTS / "terminate").exists(), f"{what}: lock or terminate is left")


def fresh():
    shutil.rmtree(RESULTS, ignore_errors=True)


def whole_run(case):
    """The statistics of a run that nobody disturbs."""
    fresh()
    run(case)
    check_tidy("a run that has ended")
    result = content()
    fresh()
    return result


def resumable():
    return any((RESULTS / "checkpoint").glob("step-*"))


def options_to_go_on():
    return ["--resume"] if resumable() else []


def kill():
    """kill -9 at random instants, from the start of the program on, and on and on: at each of them `statistics` is the
    beginning of the undisturbed run's and has each row that was seen before, all pictures that are listed are whole,
    and in the end it is all of it."""
    write_case("case.prm", ["Statistics interval = 0.0002", "Checkpoint interval = 0.003", "Interval = 0.002"])
    wanted = whole_run("case.prm")
    run("case.prm")
    wanted_pictures = n_pictures()
    fresh()
    chance = random.Random(20)
    n_kills = 0
    for rows_more in [0, 0, 10, 20, 30, 50, 0, 80, 10, 50, 20, 80]:
        process = start("case.prm", *options_to_go_on())
        seen = 0
        if rows_more == 0:
            time.sleep(chance.uniform(0, 0.3))
        else:
            seen = rows_more + (n_rows() if resumable() else 0)
            wait_for(lambda: n_rows() >= seen, process)
            time.sleep(chance.uniform(0, 0.02))
        process.kill()
        end(process, None)
        n_kills += process.returncode == -signal.SIGKILL
        check(process.returncode == 0 or n_rows() >= seen, f"after {n_kills} kills, of {seen} rows {n_rows()} are left")
        check(wanted.startswith(content()), f"after {n_kills} kills, statistics is no beginning of the undisturbed run's")
        check(content()[-1:] in (b"", b"\n"), f"after {n_kills} kills, a row is cut")
        n_pictures()
    rows = n_rows()
    run("case.prm", *options_to_go_on())
    check(content() == wanted, "statistics differs from the undisturbed run's")
    check(n_pictures() == wanted_pictures, f"{n_pictures()} pictures, not {wanted_pictures}")
    check(n_kills > 6, f"only {n_kills} runs were killed")
    print(f"{n_kills} kills, the last after {rows} rows; {n_rows()} rows in the end, as in the undisturbed run")


def from_the_start():
    """The only checkpoint is that at t = 0: the resumed run has its row there, and no second one."""
    write_case("case.prm", ["Checkpoint interval = 1"])
    wanted = whole_run("case.prm")
    run("case.prm")
    run("case.prm", "--resume")
    check("Resumed at t = 0 s" in log() and len(re.findall("^Libraries  ", log(), re.MULTILINE)) == 2, log())
    check(content() == wanted, f"{n_rows()} rows differ from the undisturbed run's")


def kill_two_ranks():
    """One of two ranks is killed, mpirun ends the other one; the run that goes on has the undisturbed run's rows."""
    write_case("case.prm", ["Checkpoint interval = 0.003"])
    whole = whole_run("case.prm")
    pathlib.Path("whole").write_bytes(whole)
    for rows in (3, 20):
        process = start("case.prm", *options_to_go_on(), ranks=2)
        wait_for(lambda: n_rows() >= rows, process)
        os.kill(int((RESULTS / "lock").read_text(encoding="utf-8").split()[1]), signal.SIGKILL)
        end(process, None)
        check(process.returncode != 0, "the run came to its end although a rank was killed")
        n_pictures()
    run("case.prm", "--resume", ranks=2)
    check(n_pictures() == 6, f"{n_pictures()} pictures, not 6")
    compare(("whole", STATISTICS), 1e-9)


def stop_and_go_on(case, wanted, ask, reason, ranks=1):
    """A run that is asked to stop writes a checkpoint of its last step, a row, and goes on as if nothing had been."""
    fresh()
    process = start(case, ranks=ranks)
    wait_for(lambda: n_rows() >= 5, process)
    ask(process)
    end(process, STOPPED, reason)
    message = re.search(rf"Stopped at t = (\S+) s, step (\d+), by {reason}\. .*--resume", log())
    check(message, f"the log does not tell of {reason}: {log()}")
    last_row = content().splitlines()[-1].split(b",")
    check(float(last_row[1]) == int(message.group(2)), f"{reason}: the last row is not that of the last step")
    check_tidy(reason)
    run(case, "--resume", ranks=ranks)
    if ranks == 1:
        check(content() == wanted, f"{reason}: statistics differs from the undisturbed run's")
    else:
        check(len(content().splitlines()) == len(wanted.splitlines()), f"{reason}: other rows than the undisturbed run's")
    print(f"{reason}, {ranks} rank(s): stopped at step {message.group(2)}, resumed to the undisturbed run's rows")


def signals():
    """Without a checkpoint interval: the signal alone makes one. mpirun hands on SIGUSR1. Under nohup a run goes on."""
    write_case("case.prm", ["End time = 0.2"])
    fresh()
    signal.signal(signal.SIGHUP, signal.SIG_IGN)
    process = start("case.prm")
    signal.signal(signal.SIGHUP, signal.SIG_DFL)
    wait_for(lambda: n_rows() >= 2, process)
    process.send_signal(signal.SIGHUP)
    end(process, 0, "a run under nohup stops at SIGHUP")
    wanted = content()
    check(not (RESULTS / "checkpoint").exists(), "there is a checkpoint although there is no interval")
    fresh()
    for number in (signal.SIGHUP, signal.SIGTERM, signal.SIGINT, signal.SIGUSR1):
        stop_and_go_on("case.prm", wanted, lambda process, n=number: process.send_signal(n), number.name)
    stop_and_go_on("case.prm", wanted, lambda process: process.send_signal(signal.SIGUSR1), "SIGUSR1", ranks=2)


def stop_while_settling():
    """Before the release a run ends with its exit code and a row as well, but there is nothing to go on from."""
    damped = "Settling\n  set Maximum time = 1000\n  set Unbalanced force = 0"
    case = CASE + f"subsection {damped}\nend\n"
    requests = [(lambda process, n=number: process.send_signal(n), number.name, [], ranks)
                for number, ranks in ((signal.SIGTERM, 1), (signal.SIGINT, 1), (signal.SIGUSR1, 1), (signal.SIGUSR1, 2))]
    requests += [(lambda process: (RESULTS / "terminate").touch(), "the file terminate", [], 1),
                 (lambda process: None, 'the entry "Wall time limit"', ["Wall time limit = 1"], 2)]
    for ask, reason, entries, ranks in requests:
        write_case("settling.prm", ["Checkpoint interval = 0.01", *entries], case)
        fresh()
        process = start("settling.prm", ranks=ranks)
        wait_for(lambda: (RESULTS / "log.txt").exists() and "Memory" in log(), process)
        time.sleep(0.1)
        ask(process)
        errors = end(process, STOPPED, reason)
        check("scree:" not in errors, f"{reason}: {errors}")
        check(re.search(r"Settled for \S+ s in [1-9]\d* steps; .* Asked to stop", log()), log())
        check(f"Stopped while settling, by {reason}. There is no checkpoint" in log(), log())
        check(n_rows() == 1 and not resumable(), f"{reason}: {n_rows()} rows instead of 1, or a checkpoint")
        check_tidy(reason)
        errors = run("settling.prm", "--resume", wanted=1)
        check("no checkpoint to resume from" in errors, errors)


def wall_time():
    """The run ends before its wall time limit, and its checkpoint is good; in a resumed run the limit holds anew. A file stops it, too."""
    write_case("long.prm", ["End time = 200", "Wall time limit = 2", "Checkpoint interval = 0.05"])
    for options in ([], ["--resume"]):
        before = time.monotonic()
        run("long.prm", *options, wanted=STOPPED)
        check('by the entry "Wall time limit". ' in log(), "the log does not tell of the limit")
        seconds = time.monotonic() - before
        check(0.5 < seconds < 20, f"the run took {seconds} s")  # starting and ending a program takes time, too
        rows = n_rows()
        print(f"limit 2 s: {seconds:.1f} s with start and end, {rows} rows")
    write_case("long.prm", ["End time = 200"])
    process = start("long.prm")
    wait_for(lambda: n_rows() >= 5, process)
    (RESULTS / "terminate").touch()  # It is looked for each second.
    end(process, STOPPED)
    check("by the file terminate. " in log(), "the log does not tell of the file")
    check_tidy("a run that is stopped")


def fingerprints():
    """The contents of all files."""
    return {str(path): path.read_bytes() for path in RESULTS.rglob("*") if path.is_file()}


def failed_input():
    """A case that fails on its input, early or late, touches nothing of the results that are there."""
    write_case("case.prm", ["End time = 0.02", "Checkpoint interval = 0.01"])
    run("case.prm")
    before = fingerprints()
    check(any("checkpoint" in path for path in before) and any(".vtu" in path for path in before), "results are missing")
    write_case("misspelt.prm", ["End tme = 0.02"])
    write_case("empty.prm", text=CASE.replace("x < 0.5 && y < 0.5", "x < 0"))
    write_case("load.prm", text=CASE + "subsection Surface load\n  set Lower corner = 0, 0.7\n"
               "  set Upper corner = 0.5, 0.7\n  set Traction = 0; -1000\nend\n")
    for case in ("misspelt.prm", "empty.prm", "load.prm"):
        for ranks in (1, 2):
            errors = run(case, wanted=1, ranks=ranks)
            check("entry" in errors, f"{case}: {errors}")
            check(fingerprints() == before, f"{case}: the older results have changed")


def lock():
    """Two runs in a folder: the second is refused. A dead process's lock is replaced, one of another host is obeyed."""
    write_case("case.prm", ["End time = 0.02", "Checkpoint interval = 0.01"])
    write_case("long.prm", ["End time = 200", "Checkpoint interval = 0.01"])
    first = start("long.prm")
    wait_for(lambda: n_rows() >= 5 and resumable(), first)
    for options in ([], ["--resume"]):
        for ranks in (1, 2):
            errors = run("case.prm", *options, wanted=1, ranks=ranks)
            check(f"another run writes there (process {first.pid} on {os.uname().nodename}" in errors, errors)
    check(first.poll() is None, "the first run was disturbed")
    rows = n_rows()
    wait_for(lambda: n_rows() > rows + 2, first)
    first.kill()
    first.wait()
    check((RESULTS / "lock").exists(), "the killed run has no lock")
    run("case.prm")
    check(f"The run before this one (process {first.pid} on " in log(), "the log does not tell of the killed run")
    # A process of that number lives, but it is another one.
    (RESULTS / "lock").write_text(f"{os.uname().nodename} {os.getpid()} 1 2026-01-01T00:00:00Z\n", encoding="utf-8")
    run("case.prm", "--resume")
    for text in ("elsewhere 1 1 2026-01-01T00:00:00Z\n", ""):
        (RESULTS / "lock").write_text(text, encoding="utf-8")
        before = fingerprints()
        errors = run("case.prm", "--resume", wanted=1)
        check("If that run is dead, remove the file results/lock" in errors, errors)
        check(fingerprints() == before, "a run that was refused has changed the folder")
    (RESULTS / "lock").unlink()
    run("case.prm", "--resume")


def removed_folder():
    """The folder is removed, and another one takes its name: an error that names the entry."""
    write_case("case.prm", ["End time = 200", "Graphics = none"])
    for ranks in (1, 2):
        fresh()
        process = start("case.prm", ranks=ranks)
        wait_for(lambda: n_rows() >= 5, process)
        shutil.rmtree("gone", ignore_errors=True)
        RESULTS.rename("gone")
        errors = end(process, 1)
        check('entry "Output directory" = results: it was removed or renamed while the run wrote to it' in errors, errors)
        check(errors.count("scree:") == 1, "told more than once: " + errors)


def start_on_full_disk(case, n_rows_before):
    """A run for which files cannot grow any more, after so many rows: as if the disk were full."""
    ignore = {"preexec_fn": lambda: signal.signal(signal.SIGXFSZ, signal.SIG_IGN), "restore_signals": False}
    fresh()
    process = start(case, **ignore)
    wait_for(lambda: n_rows() >= n_rows_before, process)
    limit = len(content()) + 200  # a part of a row; the log is far shorter
    resource.prlimit(process.pid, resource.RLIMIT_FSIZE, (limit, resource.RLIM_INFINITY))
    return process


def rows_are_refused():
    before = len(content())
    time.sleep(0.02)  # many rows' time
    return len(content()) == before


def full_disk():
    """Rows that the disk does not take are told of once, and written when there is room; if there never is, the run fails."""
    write_case("case.prm", ["Interval = 1", "Graphics = none", "End time = 0.8"])
    wanted = whole_run("case.prm")
    errors = end(start_on_full_disk("case.prm", 5), 1)
    check(errors.count("results/statistics.csv: cannot be written: File too large") == 2, errors)  # once, and at the end
    check("The run goes on" in errors and "scree: stopped: results/statistics.csv" in errors, errors)
    check(wanted.startswith(content()) and content().endswith(b"\n"), "a row was cut")

    process = start_on_full_disk("case.prm", 5)
    wait_for(rows_are_refused, process)
    resource.prlimit(process.pid, resource.RLIMIT_FSIZE, (resource.RLIM_INFINITY, resource.RLIM_INFINITY))
    errors = end(process, 0)
    check(errors.count("results/statistics.csv: cannot be written") == 1, errors)
    check("results/statistics.csv: is written again, and nothing of it is missing." in log(), log())
    check(content() == wanted, "rows are missing")


def run_on_small_disk(case, n_bytes, *options):
    """The error of a run for which no file can grow beyond so many bytes."""
    def limit():
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (n_bytes, resource.RLIM_INFINITY))
    without_files = {**os.environ, "PMIX_MCA_gds": "hash", "OMPI_MCA_btl": "self"}  # of Open MPI's own
    return run(case, *options, wanted=1, preexec_fn=limit, restore_signals=False, env=without_files)


def small_disk():
    """A checkpoint or a picture that finds no room stops the run with an error; older checkpoints stay whole, and the run goes on from them."""
    write_case("case.prm", ["Checkpoint interval = 0.03"])
    wanted = whole_run("case.prm")
    write_case("begin.prm", ["Checkpoint interval = 0.03", "End time = 0.08"])
    run("begin.prm")
    before = sorted((RESULTS / "checkpoint").iterdir())
    errors = run_on_small_disk("case.prm", 50000, "--resume")  # its points need 61416
    check(re.search(r"^scree: case.prm: results/checkpoint/unfinished/points.0: cannot be written: .*bytes are needed.*"
                    r"Still whole: results/checkpoint/step-\d+ and results/checkpoint/step-\d+\.$", errors, re.MULTILINE), errors)
    check(len(before) == 2 and sorted((RESULTS / "checkpoint").iterdir()) == before, "checkpoints have changed")
    run("case.prm", "--resume")
    check(content() == wanted, "rows are missing")
    fresh()
    write_case("pictures.prm")
    errors = run_on_small_disk("pictures.prm", 30000)  # more than parameters.prm needs
    check(re.search(r"^scree: pictures.prm: results/solution/points_00001.0.vtu: cannot be written: ", errors, re.MULTILINE), errors)


def lost_rows():
    """A resumed run tells if statistics has lost rows that were there at the checkpoint, and lists only pictures it has."""
    entries = ["Checkpoint interval = 0.04", "Interval = 0.02"]
    write_case("case.prm", entries)
    wanted = whole_run("case.prm")
    run("case.prm")
    series = RESULTS / "solution" / "points.pvd"
    check("points_00005" in series.read_text(encoding="utf-8"), "a picture is missing")
    STATISTICS.write_bytes(wanted[: len(wanted) // 3])
    write_case("case.prm", entries + ["Graphics = none"])
    run("case.prm", "--resume")
    check("bytes that it had at the checkpoint: rows are missing there." in log(), log())
    check(content().endswith(wanted.splitlines(keepends=True)[-1]), "the rows do not go on")
    check(len({line.count(b",") for line in content().splitlines()}) == 1, "a row was cut")
    check("points_00004" in series.read_text(encoding="utf-8"), "a picture is missing on its list")
    check("points_00005" not in series.read_text(encoding="utf-8"), "a picture of after the checkpoint is listed")


def grid(value):
    return "ncols 3\nnrows 3\nxllcenter 0\nyllcenter 0\ncellsize 1\n" + ("%g %g %g\n" % (value, value, value)) * 3


# Contents and changed ones of each file that a case names.
FILES_3D = {"raster.asc": (grid(0.2), grid(0.25)), "thickness.asc": (grid(0.5), grid(0.4)),
            "outline.csv": ("0, 0\n1, 0\n1, 1\n0, 1\n", "0, 0\n1, 0\n1, 1.1\n0, 1\n"),
            "record.csv": ("0, 0, 0, 0\n1, 1, 0, 0\n", "0, 0, 0, 0\n1, 2, 0, 0\n")}
SHORT = {"End time": 2e-4, "Output directory": "results", "Output/Graphics": "none", "Output/Screen": "nothing", "Output/Checkpoint interval": 1e-4}
CASE_3D = set_entries("", {
    **SHORT, "Dimension": 3, "Gravity": "0, 0, -9.81", "Mesh/Lower corner": "0, 0, 0", "Mesh/Upper corner": "2, 2, 2", "Mesh/Cell size": 0.25,
    "Bed/Type": "friction", "Bed/Raster": "FOLDER/raster.asc", "Bed/Friction angle": 30, "Obstacle Wall/Type": "free slip",
    "Obstacle Wall/Level set expression": "(x - 1.5)^2 + (y - 1.5)^2 + (z - 1)^2 - 0.3^2", "Base motion/Acceleration record": "FOLDER/record.csv",
    "Soil/Points per cell": 2, "Soil/Thickness": "FOLDER/thickness.asc", "Soil/Outline": "FOLDER/outline.csv"})
FILES_2D = {"profile.csv": ("0, 0.1\n2, 0.1\n", "0, 0.1\n2, 0.11\n"), "hydrograph.csv": ("0, 0.1\n1, 0.1\n", "0, 0.1\n1, 0.2\n")}
CASE_2D = set_entries("", {
    **SHORT, "Mesh/Upper corner": "2, 1", "Bed/Type": "fixed", "Bed/Profile": "FOLDER/profile.csv", "Soil/Region": "x < 0.5 && y < 0.5",
    "Inflow Torrent/Body": "Soil", "Inflow Torrent/Region": "y > 0.2 && y < 0.5", "Inflow Torrent/Hydrograph": "FOLDER/hydrograph.csv"})


def write_files(files, folder="data"):
    pathlib.Path(folder).mkdir(exist_ok=True, parents=True)
    for name, (text, _) in files.items():
        pathlib.Path(folder, name).write_text(text, encoding="utf-8")


def changed_files():
    """--resume refuses changed contents of each file that a case names, with the entry; it takes the same contents under another name."""
    for case, files in ((CASE_3D, FILES_3D), (CASE_2D, FILES_2D)):
        fresh()
        write_files(files)
        pathlib.Path("case.prm").write_text(case.replace("FOLDER", "data"), encoding="utf-8")
        run("case.prm")
        run("case.prm", "--resume")
        for name, (text, other) in files.items():
            pathlib.Path("data", name).write_text(other, encoding="utf-8")
            errors = run("case.prm", "--resume", wanted=1)
            check(re.search(rf"case.prm, line \d+: subsection .*, entry .* = data/{name}: the run that wrote results/checkpoint/step-\d+ had "
                            rf"data/{name} with other contents, and --resume cannot change that", errors), f"{name}: {errors}")
            pathlib.Path("data", name).write_text(text, encoding="utf-8")
        shutil.rmtree("moved", ignore_errors=True)
        shutil.move("data", "moved")
        pathlib.Path("case.prm").write_text(case.replace("FOLDER", "moved"), encoding="utf-8")
        run("case.prm", "--resume")


def other_folder():
    """Paths count from the case: a run, its --resume and the run of its parameters.prm from other working folders."""
    shutil.rmtree("case", ignore_errors=True)
    write_files(FILES_2D, "case/data")
    pathlib.Path("elsewhere/deep").mkdir(parents=True, exist_ok=True)
    text = CASE_2D.replace("FOLDER", "data").replace("= results", f"= {RESULTS.resolve()}")
    bed = text[text.index("subsection Bed"):text.index("subsection Soil")]
    pathlib.Path("case/data/bed.part").write_text(bed.replace("data/", ""), encoding="utf-8")
    pathlib.Path("case/case.prm").write_text(text.replace(bed, "include data/bed.part\n"), encoding="utf-8")
    run("case/case.prm")
    rows = n_rows()
    case = str(pathlib.Path("case/case.prm").resolve())
    run("../../case/case.prm", "--resume", cwd="elsewhere/deep")
    run(case, "--resume", cwd="elsewhere")
    check(n_rows() == rows, "rows of resumed runs")
    before = content()
    shutil.copy(RESULTS / "parameters.prm", RESULTS / "again.prm")
    run(str(RESULTS.resolve() / "again.prm"), cwd="elsewhere/deep")
    check(content() == before, "the run of parameters.prm differs")


os.environ["OMPI_MCA_odls_base_sigkill_timeout"] = "0"  # Do not wait a second for ranks that end by themselves.
fresh()
globals()[sys.argv[3]]()

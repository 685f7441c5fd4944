# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a report tells of a run: its parts by labels of the log, verdicts, escaped texts; no address outside of the file."""

import html.parser
import pathlib
import shutil
from unittest import mock

from scree import report, results

from test_tools import run_tests

LOG = """Scree 0.9.0 (abc1234), 2 ranks                          2026-11-25 12:53:12 UTC
Case        my <slope>.prm -> run
Model       2D plane strain, dry, FLIP, 38480 soil points
Unusual value: my.prm, line 3: this value is unusual in Pa.

    time (s)    done      step     dt (s)     front 90 % (m)    kinetic (J)     remaining
      1.0000   100 %       500   2.79e-04             3.1000           2100           0 s
Check: smallest V/V_0 0.5; Soil, point 3 at (1, 2) m, t = 0.5 s: it is compressed by so much.

Finished    wall time 26.2 s, 500 steps
Limits      time step limited by wave speed (100 % of steps)
Warning     'Maximum time step' bounds 90 % of the steps.
            Write a larger one.
Motion      not at rest at the end, t = 1 s: failed soil moves at 3 m/s in the mean, the toe at 30
            m/s; at rest below 0.02 m/s (0.002 sqrt(g H))
Run-out     so far: H = 87 m, L = 250 m, H/L = 0.348, travel angle 19.2 degrees; the toe has moved
            200 m, the soil at most 210 m; deposit 1.2e+03 m^2, 2e+03 m^3
Checks      fault: smallest V/V_0 0.5 (bound 0.6); Soil, point 3 at (1, 2) m
            within bounds: mass balance 0; points of soil lost 0
Results     run
"""

class Tags(html.parser.HTMLParser):
    """Throws an AssertionError at a tag that is not closed; `sources` has what the page loads."""

    def __init__(self, text):
        super().__init__()
        self.open, self.sources, self.sections = [], [], []
        self.feed(text)
        assert not self.open, self.open

    def handle_starttag(self, tag, attrs):
        self.sources += [value for name, value in attrs if name == "src"] + [value for name, value in attrs if name == "href" and value[0] != "#"]
        self.sections += [value for name, value in attrs if tag == "section" and name == "id"]
        if tag not in ("meta", "img"):
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag, tag


CHECKS = """check,value,bound,class,is_exceeded,place,remedy
"mass balance","0","1e-06","fault","0","",""
"thickness of the moving soil","2 cells","at least 3","resolution","{coarse}","","use cells of ""0.1"" m, or less"
"smallest V/V_0","0.5","0.6","fault","{fault}","Soil, point 3","write a larger
Young's modulus"
"""


def folder(log, fault=1, coarse=1):
    run = pathlib.Path("run")
    run.mkdir(exist_ok=True)
    (run / "checks.csv").write_text(CHECKS.format(fault=fault, coarse=coarse) if "Checks" in log else "", encoding="utf-8")
    (run / "log.txt").write_text(log, encoding="utf-8")
    (run / "original.prm").write_text("# A slope & more.\n# Compare: front.\n\nset End time = 1 # s, <b>\n", encoding="utf-8")
    (run / "parameters.prm").write_text("set End time = 1\nset Bodies = Soil\n", encoding="utf-8")
    (run / "statistics.csv").write_text("Time (s),Front 90 % (m),Step\n0,1.5,0\n1,nan,500\n", encoding="utf-8")
    (run / "probe_empty.csv").write_text("Time (s),Pore pressure (Pa)\n0,nan\n", encoding="utf-8")
    return run


def test_log():
    log = results.read_log(folder(LOG))
    assert log.parts["Checks"].splitlines()[1] == "within bounds: mass balance 0; points of soil lost 0", log.parts
    assert log.parts["Model"] == "2D plane strain, dry, FLIP, 38480 soil points"
    assert [line[:30] for line in log.warnings] == ["Unusual value: my.prm, line 3:", "Check: smallest V/V_0 0.5; Soi", "'Maximum time step' bounds 90 "], log.warnings
    assert log.warnings[-1].endswith("steps. Write a larger one.")
    identity = dict(report.identity("run", log))
    assert (identity["Commit"], identity["Command"], identity["Start of the run"]) == ("abc1234", "mpirun -np 2 scree my <slope>.prm", "2026-11-25 12:53:12 UTC")
    assert [word in report.verdict("run", log) for word in ('good"><b>Finished', 'good"><b>Limits', 'open"><b>Motion', 'open"><b>Run-out', 'bad"><b>Checks')] == [True] * 5
    text = report.verdict("run", results.read_log(folder(LOG.replace("not at rest", "at rest").replace("so far: ", ""), 0, 0)))
    assert 'good"><b>Motion' in text and 'good"><b>Run-out</b> H = 87 m' in text and "open" not in text, text


def test_checks():
    """A fault is red, what is coarse is not; texts keep quotes, commas and ends of lines."""
    for fault, coarse, mark in ((1, 1, "bad"), (0, 1, "open"), (0, 0, "good")):
        text = report.verdict("run", results.read_log(folder(LOG, fault, coarse)))
        assert f'{mark}"><b>Checks' in text, text
    first, second, third = results.read_checks("run")
    assert (first.kind, first.is_exceeded, second.remedy) == ("fault", False, 'use cells of "0.1" m, or less') and third.remedy.endswith("larger\nYoung's modulus")


def test_ends():
    text = report.verdict("run", results.read_log(folder(LOG.split("Finished")[0])))
    assert 'bad"><b>Not finished</b>' in text and "at t = 1 s, the end time is 1 s" in text and 'bad"><b>Checks' in text, text
    assert 'bad"><b>Stopped' in report.verdict("run", results.read_log(folder(LOG.replace("Finished ", "Stopped  "))))


def test_page():
    text = report.page(folder(LOG))
    tags = Tags(text)
    assert tags.sections == ["verdict", "warnings", "run", "charts", "statistics", "case", "log", "files"], tags.sections
    assert all(source.startswith("data:image/") for source in tags.sources)
    for wanted in ("<p>A slope &amp; more.</p>", "# s, &lt;b&gt;", "scree my &lt;slope&gt;.prm", "Probe empty: not drawn.",
                   "<td>Front 90 %</td><td>m</td><td class=number>1.5</td><td class=number>nan</td>"):
        assert wanted in text, wanted


def test_stages():
    """Each stage has a heading, and what the log says of it; without stages there is no such section."""
    stage = ("Stage       Lift 1, from t = 1 to 1 s\nRemoved     soil 100 kg/m\nSettling: 1.6 s, step 1000, unbalanced force over weight 0.01\n"
             "Settled for 1.7 s in 1052 steps. Released.\nSettling: displacement while settling 0.1 m\nMotion      at rest at\n            the end\n")
    text = report.page(folder(LOG + stage + stage.replace("Lift 1", "Lift <2>")))
    assert "stages" in Tags(text).sections and "<h3>Lift &lt;2&gt;, from t = 1 to 1 s</h3>" in text
    said = text[text.index("<h3>Lift 1"):text.index("<h3>Lift &lt;2")]
    for wanted in ("<b>Removed</b> soil 100 kg/m", "<b>Settled</b> for 1.7 s", "<b>Settling</b> displacement while settling 0.1 m", "<b>Motion</b> at rest at the end"):
        assert wanted in said, said
    assert "step 1000" not in said, said
    # The first picture of a stage has the time of the last one before.
    solution = pathlib.Path("run", "solution")
    solution.mkdir(exist_ok=True)
    files = "".join(f'<DataSet timestep="{time}" file="{number}.vtu"/>' for number, time in enumerate(("0", "1", "1", "1", "1.5", "2")))
    (solution / "points.pvd").write_text(f"<VTKFile><Collection>{files}</Collection></VTKFile>", encoding="utf-8")
    assert [file.name for _, file in sorted(results._pictures("run", "points").items())] == [f"{number}.vtu" for number in range(6)]
    with mock.patch.object(report, "draw", side_effect=lambda run, module, arguments, folder: {",".join(arguments): b""}) as draw, \
            mock.patch.object(results, "read_points", return_value=results.Points(2., None, {})):
        text = report.page("run")
    shown = [call.args[2] for call in draw.call_args_list if "--times" in call.args[2]]
    times = [[float(time) for time in arguments[-1].split(",")] for arguments in shown]
    assert len(times) == 2 and 1 - 1e-12 < times[0][0] == times[0][1] < times[1][0] == 1. and times[1][1] == 2., shown
    assert shown[0][:-1] == ["--collection", "points", "--field", "displacement", "--times"] and "Lift &lt;2&gt;: at its release" in text
    shutil.rmtree(solution)


def test_safety():
    """A folder of --safety alone, and the run folder around it, show the factor, its bracket and the trials."""
    run = folder(LOG)
    safety = run / "safety"
    (safety / "fails").mkdir(parents=True, exist_ok=True)
    (safety / "log.txt").write_text("Safety      case.prm -> run/safety\nFactor of safety  1.35 (between 1.300 and 1.400)\nSet by      rest: it still moved\n", encoding="utf-8")
    (safety / "safety.csv").write_text("Factor (-),Rests (-),Displacement (m)\n1.4,0,0.5\n1,1,0.1\n1.3,1,0.2\n", encoding="utf-8")
    for name in ("original.prm", "parameters.prm"):
        (safety / "fails" / name).write_bytes((run / name).read_bytes())
    for place, has_verdict in ((run, True), (safety, False)):
        text = report.page(place)
        sections = Tags(text).sections
        assert sections[0] == "safety" and ("verdict" in sections) == has_verdict and "case" in sections, sections
        for wanted in ("<b>Factor of safety</b> 1.35 (between 1.300 and 1.400)", "<b>Set by</b> rest", "<td class=number>1.4</td><td class=number>0</td>"):
            assert wanted in text, wanted
        assert text.index(">1</td>") < text.index(">1.3</td>") < text.index(">1.4</td>"), "trials by their factors"
    shutil.rmtree(safety)


run_tests(globals())

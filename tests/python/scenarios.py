# SPDX-License-Identifier: LGPL-2.1-or-later
"""scenarios.py SCREE: sampling and evaluation of scree-scenarios against known answers, its errors, and a study of four runs with the program SCREE."""

import os
import pathlib
import re
import shutil
import subprocess
import sys

import numpy as np
from scipy import stats

from scree import results, variants
from scree.results import Raster
from scree.scenarios import evaluation, observed, page, runs, sampling, study

from test_tools import raises, rows_of, run_tests

CASE = {"End time": 2e-3, "Output directory": "run", "Mesh/Cell size": 0.25, "Soil/Region": "x < 0.5 && y < 0.5", "Soil/Material": "Mohr-Coulomb",
        "Soil/Mohr-Coulomb/Friction angle": 30, "Soil/Mohr-Coulomb/Dilation angle": 0, "Output/Interval": 1e-3, "Output/Screen": "nothing"}
GRID = """# Four heights of a heap.
case = "case.prm"
sampling = "grid"
[parameters]
"Soil/Region" = ["x < 0.5 && y < 0.25", "x < 0.5 && y < 0.5", "x < 0.5 && y < 0.75", "y > 5"]
[thresholds]
thickness = [0.1, 0.4]
"""
SOBOL = """case = "case.prm"
runs = 4
[parameters]
"Soil/Mohr-Coulomb/Friction angle" = { distribution = "uniform", low = 20, high = 40 }
[factors]
"Mesh/Cell size" = [1, 0.5]
"""

FACTORS = """case = "{case}"
results = "results/factors"
sampling = "grid"
run_out = "factor of safety"
[set]
"Mesh/Cell size" = 2
[parameters]
"Soil/Tresca/Undrained strength" = [25e3, 50e3]
"""


def of(kind, **numbers):
    return sampling.distribution_of({"distribution": kind, **numbers})


def test_distributions():
    middles = (np.arange(1000) + 0.5) / 1000
    assert of("uniform", low=2, high=4).quantile(0.25) == 2.5
    np.testing.assert_allclose(of("normal", mean=10, deviation=2).quantile(0.975), 10 + 2 * stats.norm.ppf(0.975), rtol=1e-5)
    cut = of("normal", mean=10, deviation=2, low=9, high=11)
    assert (cut.quantile(0), cut.quantile(0.5), cut.quantile(1)) == (9, 10, 11)
    values = np.array([of("lognormal", mean=3, deviation=1.5).quantile(middle) for middle in middles])
    np.testing.assert_allclose([values.mean(), values.std()], [3, 1.5], rtol=0.02)
    np.testing.assert_allclose(of("triangular", low=0, mode=1, high=4).quantile(0.25), 1, rtol=1e-5)  # the mode: area 1/4 to its left
    assert [of("list", values=["a", "b"]).quantile(place) for place in (0, 0.49, 0.5, 1)] == ["a", "a", "b", "b"]
    for text, given in (('no distribution "unifrm"', {"distribution": "unifrm"}), ("uniform needs high", {"distribution": "uniform", "low": 1}),
                        ("uniform has no mean", {"distribution": "uniform", "low": 1, "high": 2, "mean": 1}), ("write a list of values", 3),
                        ("low = 2 is not below high = 1", {"distribution": "uniform", "low": 2, "high": 1}), ("two different values", [1]),
                        ("mode = 5 is not between", {"distribution": "triangular", "low": 1, "mode": 5, "high": 2}),
                        ("deviation = 0", {"distribution": "normal", "mean": 1, "deviation": 0}),
                        ("mean = a is not a number", {"distribution": "normal", "mean": "a", "deviation": 1}),
                        ("less than 1 %", {"distribution": "normal", "mean": 0, "deviation": 1, "low": 9})):
        raises(text, sampling.distribution_of, given)


def test_designs():
    places = [of("uniform", low=0, high=1)] * 3
    for kind in ("Sobol", "Latin hypercube"):
        rows = np.array(sampling.sampled(kind, places, 16, 1))
        # Each sixteenth of each parameter has one run.
        np.testing.assert_array_equal(np.sort(np.floor(16 * rows), axis=0), np.repeat(np.arange(16)[:, None], 3, axis=1))
        np.testing.assert_array_equal(rows, sampling.sampled(kind, places, 16, 1))
        assert np.any(rows != sampling.sampled(kind, places, 16, 2))
    np.testing.assert_array_equal(sampling.sampled("Sobol", places, 16, 1), sampling.sampled("Sobol", places, 32, 1)[:16])
    mixed = [of("uniform", low=0, high=1), of("list", values=["a", "b", "c"])]
    assert sampling.one_at_a_time(mixed, [0.1, 0.9]) == [[0.5, "a"], [0.1, "a"], [0.9, "a"], [0.5, "b"], [0.5, "c"]]
    assert sampling.grid(mixed, 2) == [[0.25, "a"], [0.25, "b"], [0.25, "c"], [0.75, "a"], [0.75, "b"], [0.75, "c"]]


def test_probability():
    rasters = [Raster(np.array([[1., 2., np.nan], [0., 3., run]]), 10., 20., 5.) for run in range(4)]
    np.testing.assert_array_equal(evaluation.probability(rasters, 1.5).values, [[0, 1, 0], [0, 1, 0.5]])
    # One of two runs with half the cells and an area that begins further left: nearest cells, no value outside.
    fine = Raster(np.full((4, 8), 9.), 5., 20., 2.5)
    both = evaluation.probability([rasters[0], fine], 1.5)
    assert both.extent == (5, 25, 20, 30)
    np.testing.assert_array_equal(both.values[0], [0.5, 0.5, 0.5, 0.5, 1, 1, 0.5, 0.5])
    values, part = evaluation.exceedance([3., 1., 2., 4.])
    assert list(values) == [1, 2, 3, 4] and list(part) == [1, 0.75, 0.5, 0.25]
    np.testing.assert_allclose(evaluation.quantiles([1., 2., 3., 4., 5.]), [1.2, 2, 3, 4, 4.8])


def test_influence():
    parameters = [study.Parameter("a", of("uniform", low=0, high=1), False), study.Parameter("b", of("list", values=["x", "y"]), False)]
    rows = [[0.1 * run, "xy"[run % 2]] for run in range(9)]
    one, = evaluation.influences(parameters, rows, [-run**3 for run in range(9)])
    np.testing.assert_allclose([one.correlation, one.bound], [-1, 1.96 / np.sqrt(8)])
    rows = [[0.5, "x"], [0.1, "x"], [0.9, "x"], [0.5, "y"]]
    base, bars = evaluation.tornado(parameters, rows, [10., 14., 9., np.nan])
    assert base == 10 and bars == [evaluation.Bar("a", [0.1, 0.5, 0.9], [14., 10., 9.])]
    assert evaluation.tornado(parameters, rows, [np.nan, 1., 2., 3.]) is None


def test_observed():
    """Of 6 cells with soil in 8 of a run 4 agree; soil comes to 45 m of a path that bends."""
    area = Raster(np.array([[0, 1, 1, 0], [1, 1, np.nan, 0], [1, 1, 0, 0]]), 0., 0., 10.)
    soil = Raster(np.array([[1, 1, 1, 1], [1, 1, 1, 0.05], [np.nan, 0, 0, 1]]), 0., 0., 10.)
    np.testing.assert_allclose(observed.overlap(area, soil, 0.1), [4 / 10, 2 / 6, 4 / 6])
    assert np.isnan(observed.overlap(area._replace(values=0 * area.values), soil, 0.1)).all()
    path = np.array([(5., 15.), (25., 15.), (25., 25.), (39., 25.)])
    assert observed.toe(path, soil, 0.1) == 44 and observed.toe(path, soil._replace(values=0 * soil.values), 0.1) == 0
    half = soil._replace(values=np.where(np.arange(4) < 3, soil.values, 0))
    assert observed.toe(path, half, 0.1) == 30  # at x = 25 m; the next place, 35 m, lies in the fourth column
    pathlib.Path("path.csv").write_text("s, x, y\n0, 5, 15\n1, 25, 15\n", encoding="utf-8")
    pathlib.Path("other.asc").write_text("", encoding="utf-8")
    results.write_map("area.asc", area, "other.asc")
    found = observed.read(".", {"impact": "area.asc", "path": "path.csv", "thickness": 0.5})
    assert found.deposit is None and found.path.shape == (2, 2) and found.impact.values.shape == (3, 4)
    raises("no file .*nowhere.asc. Ask the survey", observed.read, ".", {"impact": "nowhere.asc", "source": "Ask the survey."})
    raises("nothing is observed", observed.read, ".", {"thickness": 1})
    raises("above 0, in m", observed.read, ".", {"impact": "area.asc", "thickness": 0})
    raises('"impct": there is no such entry', observed.read, ".", {"impct": "area.asc"})


def test_maps():
    """A map gets the format of another one; also as GeoTIFF, with its system of coordinates."""
    from osgeo import gdal, osr  # pylint: disable=import-outside-toplevel
    given = Raster(np.array([[1., np.nan], [3., 4.], [0.5, 2.]]), 1e6, 2e5, 10.)
    system = osr.SpatialReference()
    system.ImportFromEPSG(31254)
    like = gdal.GetDriverByName("GTiff").Create("like.TIF", 2, 2, 1, gdal.GDT_Int16)
    like.SetGeoTransform((0, 10, 0, 20, 0, -10))
    like.SetSpatialRef(system)
    band = like.GetRasterBand(1)
    band.SetScale(0.1)
    band.SetOffset(1)
    band.WriteArray(np.array([[10, 20], [30, 40]]))
    like.CreateMaskBand(gdal.GMF_PER_DATASET)
    band.GetMaskBand().WriteArray(np.array([[255, 255], [0, 255]]))
    band = like = None  # writes the file
    np.testing.assert_allclose(results.read_raster("like.TIF").values, [[2, 3], [np.nan, 5]])
    like = gdal.Open("like.TIF", gdal.GA_Update)
    like.GetRasterBand(1).SetUnitType("US survey foot")
    like = None
    raises("its values are in US survey foot", results.read_raster, "like.TIF")
    pathlib.Path("like.asc").write_text("", encoding="utf-8")
    pathlib.Path("like.prj").write_text("PROJCS", encoding="utf-8")
    for name in ("map.TIF", "map.tiff", "map.asc"):
        results.write_map(name, given, "like.asc" if name == "map.asc" else "like.TIF")
        found = results.read_raster(name)
        np.testing.assert_allclose(found.values, given.values)
        assert found[1:] == given[1:] and pathlib.Path("map.prj").read_text(encoding="utf-8") == "PROJCS"
        assert name == "map.asc" or gdal.Open(name).GetSpatialRef().GetAuthorityCode(None) == "31254"
    assert page._cell(5200012.34) == "5200012.34"  # pylint: disable=protected-access


def test_errors():
    for before, after, text in (
            ("case.prm", "cases.prm", '^study.toml: entry "case" = cases.prm: there is no file cases.prm'),
            ('case = "case.prm"', "", '^study.toml: the base case is missing. Write for instance case = "slope.prm"'),
            ("runs", "run", 'entry "run" = 4: there is no such entry. Did you mean "runs"'),
            ("runs = 4", "runs = 2", 'entry "runs" = 2: too few for 2 parameters. Write at least 4'),
            ("runs = 4", "runs = 6", "Write 4 or 8, or sampling = \"Latin hypercube\""),
            ("runs = 4", "", 'entry "runs" is missing'),
            ("runs = 4", "runs = many", "study.toml: Invalid value .*Strings and names with blanks"),
            ("runs = 4", 'runs = 4\nsampling = "sobol"', 'there is no such sampling. Did you mean "Sobol"'),
            ("runs = 4", 'runs = 4\nsampling = "grid"', "no effect with sampling = \"grid\". Remove it"),
            ("runs = 4", 'sampling = "grid"\nlevels = 1', 'entry "levels" = 1: write a whole number of at least 2'),
            ("runs = 4", 'sampling = "one at a time"\nquantiles = [0.9, 0.1]', "the lower one first"),
            ("Friction angle", "Friction angel", r'\[parameters\]: there is no entry "Soil/Mohr-Coulomb/Friction angel". Did you mean "Soil/Mohr-Coulomb/Friction angle"'),
            ("high = 40", "hihg = 40", r'\[parameters\], entry "Soil/Mohr-Coulomb/Friction angle" = .*: uniform has no hihg'),
            ("high = 40", "high = 300", r'\[parameters\], entry "Soil/.*" = \d.*the program refuses the case: .*write a number from 0 to 89'),
            ("[1, 0.5]", '["a", "b"]', r"\[factors\], .*: factors are numbers"),
            ("[1, 0.5]", "[1, -0.5]", r"\[factors\], .*a factor below 0 may occur"),
            ("Mesh/Cell size", "Soil/Region", r'\[factors\], .* a factor needs a number or a raster, and the value of the case is "x < 0.5'),
            ("[factors]", '[thresholds]\nspeed = [0, 1]\n[factors]', r'\[thresholds\], entry "speed" = 0: write a number above 0, in m/s'),
            ("[factors]", '[thresholds]\ndepth = 1\n[factors]', "no map of it. Write one of: thickness, speed, pressure"),
            ("[factors]", '[set]\n"Output directory" = "x"\n[factors]', "Name that of the study by the entry \"results\""),
            ("[factors]", '[set]\n"Soil/Mohr-Coulomb/Friction angle" = 20\n[factors]', r"it is in \[set\] as well. Remove one")):
        assert before in SOBOL
        pathlib.Path("study.toml").write_text(SOBOL.replace(before, after, 1), encoding="utf-8")
        raises(text, study.read, "study.toml")


def call(*arguments):
    done = subprocess.run([sys.executable, "-m", "scree", "scenarios.command", "study.toml", *arguments], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def test_runs():
    """Four runs, of which one fails; then with its value changed: it alone runs again. Maps and columns have the known heights."""
    if not shutil.which("snakemake"):
        print("Without Snakemake: the study of four runs is left out.")
        return
    pathlib.Path("study.toml").write_text(GRID, encoding="utf-8")
    told = call("--dry-run")
    assert len(re.findall("^000. .*not run$", told, re.MULTILINE)) == 4 and "4 of 4 runs to do" in told, told
    assert not pathlib.Path("results").exists()
    told = call("--cores", "2")
    assert "3 of 4 evaluated, 1 failed" in told and re.search("^Run 0004 +exit code 1: .*the region is empty", told, re.MULTILINE), told
    rows = rows_of("results/study/runs.csv")
    assert [row["verdict"] for row in rows] == ["finished"] * 3 + ["failed"] and [row["run"] for row in rows] == ["0001", "0002", "0003", "0004"]
    np.testing.assert_allclose([float(row["largest_thickness_m"]) for row in rows[:3]], [0.25, 0.5, 0.75], rtol=0.02)
    for number, row in zip(("0001", "0002", "0003"), rows):
        statistics = results.read_statistics(f"results/study/runs/{number}")
        assert float(row["run_out_m"]) == statistics["Run-out length (m)"][-1] and float(row["h_over_l"]) == statistics["Run-out H/L (-)"][-1], row
    table = np.genfromtxt("results/study/maps/probability.csv", delimiter=",", names=True)
    np.testing.assert_allclose(table["probability_thickness_01m"][0], 1)
    np.testing.assert_allclose(table["probability_thickness_04m"][0], 2 / 3, rtol=1e-5)
    page = pathlib.Path("results/study/report.html").read_text(encoding="utf-8")
    assert page.count('src="data:image/png;base64,') == 3 and "over all 4 runs, a probability may differ by up to 25 %" in page, re.findall("<h2>.*", page)
    ends = {number: pathlib.Path(f"results/study/runs/{number}/finished").stat().st_mtime_ns for number in ("0001", "0002", "0003")}
    pathlib.Path("study.toml").write_text(GRID.replace("y > 5", "x < 0.5 && y < 1"), encoding="utf-8")
    assert "3 of 4 evaluated, 1 not run" in call("--evaluate")  # not the run of the former value
    assert "4 runs, 1 to do" in call("--cores", "2")
    assert ends == {number: pathlib.Path(f"results/study/runs/{number}/finished").stat().st_mtime_ns for number in ends}
    np.testing.assert_allclose(float(rows_of("results/study/runs.csv")[3]["largest_thickness_m"]), 1, rtol=0.02)


def test_factors_of_safety():
    """The factor of clay is in proportion to its strength; tables of thresholds are refused."""
    if not shutil.which("snakemake"):
        return
    text = FACTORS.format(case=pathlib.Path(__file__).resolve().parents[2] / "prm" / "clay" / "random_field.prm")
    pathlib.Path("study.toml").write_text(text + "[thresholds]\nspeed = 1\n", encoding="utf-8")
    raises(r"\[thresholds\] has no effect with run_out", study.read, "study.toml")
    pathlib.Path("study.toml").write_text(text, encoding="utf-8")
    told = call("--cores", "2")
    rows = rows_of("results/factors/runs.csv")
    np.testing.assert_allclose(float(rows[1]["factor"]) / float(rows[0]["factor"]), 2, rtol=0.02)
    assert "1 of 2 runs are below 1" in told and [row["verdict"] for row in rows] == ["finished"] * 2, told


def test_verdicts():
    """Faults and what is coarse of each run come from its checks.csv, whatever the layout of its log."""
    checks = {"0001": {"smallest V/V_0": ("fault", 1), "a long name: with a colon; and more": ("fault", 1)}, "0002": {"thickness of the moving soil": ("resolution", 1)},
              "0003": {"smallest V/V_0": ("fault", 0), "numerical dissipation": ("information", 0)}}
    pathlib.Path("study.toml").write_text(GRID.replace('case = ', 'results = "verdicts"\ncase = '), encoding="utf-8")
    one = study.read("study.toml")
    for number, found in checks.items():
        run = one.run(number)
        run.mkdir(parents=True)
        (run / "finished").touch()
        (run / "log.txt").write_text("Checks      fault: of another program\n", encoding="utf-8")
        rows = "".join(f'"{name}","1","0","{kind}","{is_exceeded}","",""\n' for name, (kind, is_exceeded) in found.items())
        (run / "checks.csv").write_text("check,value,bound,class,is_exceeded,place,remedy\n" + rows, encoding="utf-8")
    verdicts = {number: runs.verdict(one, number) for number in one.numbers}
    assert verdicts["0001"].faults == tuple(checks["0001"]) and verdicts["0001"].coarse == () and verdicts["0004"].word == "not run"
    assert verdicts["0002"].coarse == ("thickness of the moving soil",) and verdicts["0003"][1] == verdicts["0003"].coarse == ()
    lines = {label: (is_good, text) for is_good, label, text in page.summary(one, page.Evaluated(verdicts, {number: {} for number in checks}, []))}
    assert lines["Checks"][1].startswith("1 of 3 runs have a fault: ") and all(f"{name} in 1" in lines["Checks"][1] for name in checks["0001"]), lines
    assert lines["Resolution"] == (False, "1 of 3 runs are coarse, cut off or not final: thickness of the moving soil in 1"), lines


def test_factors():
    pathlib.Path("study.toml").write_text(SOBOL, encoding="utf-8")
    one = study.read("study.toml")
    for number, row in zip(one.numbers, one.rows):
        study.write_case(one, row, f"{number}.prm")
        entries = variants.read_entries(f"{number}.prm")
        assert float(entries["Mesh/Cell size"]) == 0.25 * row[1] and float(entries["Soil/Mohr-Coulomb/Friction angle"]) == row[0]
    assert sorted(row[1] for row in one.rows) == [0.5, 0.5, 1, 1]


def main():
    program = pathlib.Path(sys.argv[1]).resolve()
    for path in pathlib.Path(".").iterdir():
        (shutil.rmtree if path.is_dir() else os.remove)(path)
    os.environ["SCREE_PROGRAMS"] = str(program.parent)
    pathlib.Path("case.prm").write_text(variants.set_entries("", CASE), encoding="utf-8")
    run_tests(globals())


main()

# SPDX-License-Identifier: LGPL-2.1-or-later
"""commands.py BUILD SCREE ELEMENT: what the commands of the Python package in BUILD say of wrong arguments, and which files they write."""

import importlib
import os
import pathlib
import re
import shutil
import subprocess
import sys
import traceback
import types

from scree.variants import set_entries

ROOT = pathlib.Path(__file__).resolve().parents[2]
CASE = {"End time": 2e-3, "Output directory": "run", "Bodies": "Sand", "Mesh/Cell size": 0.25, "Sand/Region": "y < 0.5", "Water/Region": "same",
        "Output/Interval": 1e-3, "Output/Screen": "nothing"}
CASE_3D = {"Dimension": 3, "Gravity": "0, 0, -9.81", "End time": 2e-3, "Output directory": "run_3d", "Mesh/Lower corner": "0, 0, 0",
           "Mesh/Upper corner": "1, 1, 1", "Mesh/Cell size": 0.25, "Bed/Type": "fixed", "Bed/Level set expression": "z - 0.2 - 0.2*x",
           "Soil/Region": "x < 0.5 && z < 0.6", "Output/Interval": 1e-3, "Output/Screen": "nothing"}
ELEMENT = "set Path = oedometer\nset Final strain = 0.001\nset Number of steps = 5\nset Output directory = element\n"


class Commands:
    """The commands, and what was not as it should be."""

    def __init__(self, build, path):
        self.build, self.faults = build, []
        self.environment = {**os.environ, "PATH": path + ":/usr/bin:/bin", "SCREE_PROGRAMS": build}
        listed = (ROOT / "source" / "python" / "pyproject.toml").read_text(encoding="utf-8")
        self.modules = {name: importlib.import_module(module) for name, module in re.findall(r'^(scree-[a-z-]+) = "(.*):main"$', listed, re.MULTILINE)}

    def launch(self, command, *arguments):
        """The command by its launcher."""
        return subprocess.run([os.path.join(self.build, command), *arguments], capture_output=True, text=True, check=False, env=self.environment)

    def run(self, command, *arguments):
        """The command in a copy of this process, which has loaded the packages: that takes most of the time of a launcher."""
        names = ("stdout", "stderr")
        child = os.fork()
        if child == 0:
            for number, name in enumerate(names, 1):
                os.dup2(os.open(name, os.O_WRONLY | os.O_CREAT | os.O_TRUNC), number)
            os.environ.clear()
            os.environ.update(self.environment)
            sys.argv = [command, *arguments]
            code = 0
            try:
                self.modules[command].main()
            except SystemExit as ending:
                code = int(ending.code or 0) if isinstance(ending.code, (int, type(None))) else print(ending.code, file=sys.stderr) or 1
            except BaseException:  # pylint: disable=broad-except
                traceback.print_exc()
                code = 1
            sys.stdout.flush()
            sys.stderr.flush()
            os._exit(code)  # pylint: disable=protected-access
        code = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
        texts = [pathlib.Path(name).read_text(encoding="utf-8") for name in names]
        for name in names:
            os.remove(name)
        return types.SimpleNamespace(returncode=code, stdout=texts[0], stderr=texts[1])

    def refuses(self, wanted, command, *arguments):
        """The command must end with one line that reads as `wanted`."""
        done = self.run(command, *arguments)
        error = done.stderr.strip()
        if done.returncode != 1 or "\n" in error or not re.search(wanted, error):
            self.faults.append(f"{command} {' '.join(arguments)}: exit code {done.returncode}, {done.stdout}{error}")

    def writes(self, files, command, *arguments):
        """The command must end well, with these files changed or new and no other one."""
        before = times_of_files()
        done = self.run(command, *arguments)
        changed = {name for name, time in times_of_files().items() if before.get(name) != time}
        if done.returncode != 0 or changed != set(files):
            self.faults.append(f"{command} {' '.join(arguments)}: exit code {done.returncode}, wrote {sorted(changed)}, {done.stderr}")


def times_of_files():
    return {str(path): path.stat().st_mtime_ns for path in pathlib.Path(".").rglob("*") if path.is_file()}


def check_variants(commands):
    for entry, wanted in (("Mesh/Cell sise = 0.1", '^scree-variant: there is no entry "Mesh/Cell sise". Did you mean "Mesh/Cell size"'),
                          ("Cell size = 0.1", 'Did you mean "Mesh/Cell size"'),
                          ("Soil/Region = 1", 'Did you mean "Sand/Region"'),
                          ("Mesh/Cell size", 'has no "="')):
        commands.refuses(wanted, "scree-variant", "case.prm", "new.prm", entry)
    commands.refuses("^scree-variant: .*no_case.prm", "scree-variant", "no_case.prm", "new.prm", "End time = 1")
    commands.refuses("^scree-variant: .*no_folder/new.prm", "scree-variant", "case.prm", "no_folder/new.prm", "End time = 1")
    commands.refuses("is the case itself", "scree-variant", "case.prm", "./case.prm", "End time = 1")
    commands.refuses('Did you mean "Final strain"', "scree-variant", "element.prm", "new.prm", "Final strian = 1")
    commands.writes(["new.prm"], "scree-variant", "case.prm", "new.prm", "Sand/Points per cell = 2", "Time step/Courant number = 0.3")


def check_plot_element(commands):
    commands.refuses("^scree-plot-element: .*nowhere", "scree-plot-element", "nowhere")
    commands.refuses("^scree-plot-element: .*run/table.txt has no column strain", "scree-plot-element", "run")
    commands.writes(["element/element.png"], "scree-plot-element", "element")


STAND_IN = """from unittest.mock import MagicMock
for name in {names!r}:
    globals()[name] = MagicMock()
PVDReader.return_value.PointData.keys.return_value = {fields!r}
PVDReader.return_value.PointData.__getitem__.return_value.GetNumberOfComponents.return_value = 1
def SaveScreenshot(file, *_, **__):
    open(file, "w").close()
"""


def check_script_for_paraview(commands):
    """The script runs from its folder, so that its name hides no module, and writes its picture; without ParaView, a module takes its calls."""
    script = pathlib.Path("run/show_in_paraview.py").resolve()
    text, environment, program = script.read_text(encoding="utf-8"), dict(commands.environment), shutil.which("pvpython")
    if program is None:
        pathlib.Path("stand_in/paraview").mkdir(parents=True, exist_ok=True)
        pathlib.Path("stand_in/paraview/__init__.py").write_text("", encoding="utf-8")
        names = sorted(set(re.findall(r"\b([A-Z]\w+)\(", text)))
        pathlib.Path("stand_in/paraview/simple.py").write_text(STAND_IN.format(names=names, fields=re.findall(r"^show\('\S+', '(\w+)'", text, re.MULTILINE)),
                                                               encoding="utf-8")
        environment["PYTHONPATH"] = str(pathlib.Path("stand_in").resolve())
    done = subprocess.run([program or sys.executable, script], capture_output=True, text=True, check=False, env=environment)
    if done.returncode != 0 or not script.with_suffix(".png").exists():
        commands.faults.append(f"show_in_paraview.py: {done.stderr}")


def check_render(commands):
    commands.refuses("^scree-render: .*nowhere", "scree-render", "nowhere")
    commands.refuses("^scree-render: .*No field speed; there are: .*velocity.*\\(points\\).*pressure.*\\(water\\)", "scree-render", "run", "--field", "speed")
    commands.refuses("^scree-render: --times 0,one: write numbers", "scree-render", "run", "--times", "0,one")
    for how in ([], ["--animate", "gif"]):
        commands.refuses("^scree-render: run has no picture at t = 0.0016 s; there are 3, at 0, 0.001, 0.002 s. The next is at 0.002 s", "scree-render", "run",
                        "--times", "0,0.0016", *how)
    commands.refuses("^scree-render: --limits 1: write 2 numbers", "scree-render", "run", "--limits", "1")
    commands.refuses("^scree-render: --panels: there is no panel fronts; there are: .*front", "scree-render", "run", "--panels", "fronts")
    statistics = "run/statistics.png"
    commands.writes(["run/points.png", "run/water.png", statistics], "scree-render", "run")
    commands.writes(["run/points_velocity.png", "run/water_velocity.png", statistics], "scree-render", "run", "--field", "velocity")
    commands.writes(["run/water_inside_soil_t_0.png", statistics], "scree-render", "run", "--field", "inside_soil", "--times", "0")
    commands.writes(["mine.png", "mine_statistics.png"], "scree-render", "run", "--collection", "water", "--output", "mine.png")
    commands.refuses("mine.png is there already", "scree-render", "run", "--collection", "points", "--output", "mine.png")
    commands.writes(["mine.png", "mine_statistics.png"], "scree-render", "run", "--collection", "points", "--output", "mine.png", "--force")
    commands.writes(["run/points_t_0.gif", "run/water_t_0.gif"], "scree-render", "run", "--animate", "gif", "--times", "0")
    commands.writes(["film.gif"], "scree-render", "run", "--animate", "gif", "--collection", "water", "--output", "film.gif")
    commands.refuses("film.png: a film of --animate gif ends with .gif", "scree-render", "run", "--animate", "gif", "--collection", "water",
                    "--output", "film.png")
    films = [f"run/water{ending}" for ending in ((".gif", ".mp4") if shutil.which("ffmpeg", path=commands.environment["PATH"]) else (".gif",))]
    commands.writes(films, "scree-render", "run", "--animate", "--collection", "water")
    commands.writes(["run/show_in_paraview.py"], "scree-render", "run", "--paraview")
    check_script_for_paraview(commands)
    commands.refuses("--limits low,high: write 2 numbers", "scree-render", "run", "--limits", "low,high")
    commands.writes(["run/water_limits_-1_2.png", statistics], "scree-render", "run", "--collection", "water", "--limits", "-1,2")
    check_render_3d(commands)
    if shutil.which("ffmpeg", path=commands.environment["PATH"]) is None:
        commands.refuses("--animate mp4: ffmpeg is missing. Install ffmpeg, or write --animate gif", "scree-render", "run", "--animate", "mp4")
    picture = max(pathlib.Path("run/solution").glob("water*.vtu"))
    text = picture.read_bytes()
    picture.write_bytes(text[:len(text) // 2])
    commands.refuses("^scree-render: .*water.*vtu is damaged", "scree-render", "run", "--collection", "water", "--field", "mass")
    picture.unlink()
    commands.refuses("^scree-render: .*water.*vtu is not there", "scree-render", "run", "--collection", "water", "--field", "mass")


FLUME = {"Dimension": 3, "Gravity": "0, 0, -9.81", "Mesh/Lower corner": "0, 0, 0", "Mesh/Upper corner": "2, 1, 1", "Mesh/Cell size": 0.5,
         "Bed/Type": "friction", "Bed/Level set expression": "z - 0.3*(2 - x)"}
GRID = "ncols 4\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 0.5\nNODATA_value -9999\n"


def check_maps(commands):
    commands.refuses("^scree-maps: .*nowhere", "scree-maps", "nowhere")
    commands.refuses("^scree-maps: run has no maps. Set \"Write = true\" in subsection Maps", "scree-maps", "run")
    folder = pathlib.Path("flume/maps")
    folder.mkdir(parents=True)
    pathlib.Path("flume/parameters.prm").write_text(set_entries("", FLUME), encoding="utf-8")
    (folder / "deposit.asc").write_text(GRID + "0 -1 0 0\n0 1 2\n", encoding="utf-8")
    for name in ("thickness_0s", "thickness_10.50s"):
        (folder / f"{name}.asc").write_text(GRID + "0 1 0 0\n0 1 2 0\n", encoding="utf-8")
    commands.refuses("^scree-maps: flume/maps/deposit.asc: GDAL reads no complete raster", "scree-maps", "flume")
    (folder / "deposit.asc").write_text(GRID + "0 -1 0 0\n0 1 2 0\n", encoding="utf-8")
    commands.writes(["flume/maps.png"], "scree-maps", "flume")
    commands.writes(["flume/maps_deposit_thickness_10.5s.png"], "scree-maps", "flume", "--maps", "deposit", "--times", "10.5")
    commands.refuses("^scree-maps: flume has no map at t = 10 s; there are 2, at 0, 10.5 s", "scree-maps", "flume", "--times", "10")
    commands.refuses("^scree-maps: flume has no map speed; there are: deposit, thickness_TIMEs", "scree-maps", "flume", "--maps", "speed")
    commands.refuses("^scree-maps: --times one: write numbers", "scree-maps", "flume", "--times", "one")


def check_report(commands):
    """The pages of a run in 2D with pictures, and of one with maps: each picture is in the file."""
    commands.refuses("^scree-report: nowhere/parameters.prm: No such file", "scree-report", "nowhere")
    commands.writes(["run/report.html"], "scree-report", "run")
    commands.writes(["flume.html"], "scree-report", "flume", "--output", "flume.html")
    for page, pictures in (("run/report.html", 4), ("flume.html", 1)):
        text = pathlib.Path(page).read_text(encoding="utf-8")
        if text.count('src="data:image/png;base64,') != pictures or len(text) > 2e6 or "not drawn" in text:
            commands.faults.append(f"{page}: {text.count('src=')} pictures, {len(text)} bytes, {re.findall('.*not drawn.*', text)}")


def check_render_3d(commands):
    pictures = ["run_3d", "--field", "velocity"]
    if shutil.which("Xvfb") is None:
        if not os.environ.get("DISPLAY"):
            commands.refuses("pictures of 3D runs need an X server. Install Xvfb", "scree-render", *pictures)
        return
    commands.writes(["run_3d/points_velocity.png", "run_3d/statistics.png"], "scree-render", *pictures)
    commands.writes(["run_3d/points_velocity.gif"], "scree-render", *pictures, "--animate", "gif", "--view", "-30,40")


def check_mountain(commands):
    """The rasters of prm/terrain are those that the generator makes, to the digits that it writes."""
    commands.refuses("^scree-mountain: .*case.prm", "scree-mountain", "1", "case.prm/folder")
    files = [f"mountain/{name}" for name in ("terrain.asc", "release.asc", "case.prm")]
    commands.writes(files, "scree-mountain", "1", "mountain", "--size", "small")
    terrain = ROOT / "prm" / "terrain"
    for shipped, made in (("mountain.asc", files[0]), ("release.asc", files[1])):
        texts = [path.read_text(encoding="utf-8").split() for path in (terrain / shipped, pathlib.Path(made))]
        if texts[0][:12] != texts[1][:12] or any(abs(float(a) - float(b)) > 0.011 for a, b in zip(texts[0][12:], texts[1][12:], strict=True)):
            commands.faults.append(f"{shipped} is not what scree-mountain makes")
    commands.writes(files, "scree-mountain", "2", "mountain", "--rim", "cut", "--relief", "smooth", "--feature", "cliff", "--cell", "20", "--spacing", "20")


def check_others(commands):
    commands.refuses("^scree-study: no study slope; there are advice, ", "scree-study", "slope")
    commands.refuses("^scree-study: nowhere/scree is not there: build it", "scree-study", "bar", "--program", "nowhere/scree")
    commands.refuses("^scree-terrain-bank: --seeds all: write the first and the last", "scree-terrain-bank", "bank", "--seeds", "all")
    folders = {**commands.environment, "PYTHONPATH": str(ROOT / "source" / "python")}
    done = subprocess.run([sys.executable, "-S", "-m", "scree", "render", "run"], capture_output=True, text=True, check=False, env=folders)  # -S: no installed packages
    if done.returncode != 1 or not re.search("^scree: .* has no module .* Install numpy, scipy, matplotlib and vtk", done.stderr):
        commands.faults.append(f"without packages: {done.returncode}, {done.stderr}")


def check_help(commands):
    """Every command has a help that tells about each of its options, and refuses an argument too many in one line."""
    for name in commands.modules:
        done = commands.launch(name, "--help")
        if done.returncode != 0 or re.search(r"^  -\S+( [A-Z_{]\S*)?$\n(?! {10})", done.stdout, re.MULTILINE):
            commands.faults.append(f"{name} --help: exit code {done.returncode}, an option without a word: {done.stdout}")
        commands.refuses(f"^{name}: .*--help lists the arguments", name, "--no-such-option")


def main():
    build, scree, element = sys.argv[1:]
    for path in pathlib.Path(".").iterdir():
        (shutil.rmtree if path.is_dir() else os.remove)(path)
    pathlib.Path("case.prm").write_text(set_entries("", CASE), encoding="utf-8")
    pathlib.Path("case_3d.prm").write_text(set_entries("", CASE_3D), encoding="utf-8")
    pathlib.Path("element.prm").write_text(ELEMENT, encoding="utf-8")
    for case in ("case.prm", "case_3d.prm"):
        subprocess.run([scree, case], check=True)
    subprocess.run([element, "element.prm"], check=True, capture_output=True)
    pathlib.Path("run/table.txt").write_text("a b\n1 2\n", encoding="utf-8")
    commands = Commands(build, os.path.dirname(scree))
    check_variants(commands)
    check_plot_element(commands)
    check_maps(commands)
    check_report(commands)
    check_render(commands)
    check_mountain(commands)
    check_others(commands)
    check_help(commands)
    print("\n".join(commands.faults) or "all as they should be")
    sys.exit(bool(commands.faults))


if __name__ == "__main__":
    main()

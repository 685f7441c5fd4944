#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""scripts.py DOC SCREE ELEMENT: what variants.py, plot_element.py, render.py, relief.py and mountain.py say of wrong arguments, and which files they write."""

import os
import pathlib
import re
import shutil
import subprocess
import sys

CASE = """set End time = 2e-3
set Output directory = run
set Bodies = Sand
subsection Mesh
  set Cell size = 0.25
end
subsection Sand
  set Region = y < 0.5
end
subsection Water
end
subsection Output
  set Interval = 1e-3
  set Screen = nothing
end
"""
ELEMENT = "set Path = oedometer\nset Final strain = 0.001\nset Number of steps = 5\nset Output directory = element\n"


class Scripts:
    """The scripts, and what was not as it should be."""

    def __init__(self, doc, path):
        self.doc, self.faults = doc, []
        self.environment = {**os.environ, "PATH": path + ":/usr/bin:/bin"}

    def run(self, script, *arguments, interpreter="/usr/bin/python3"):
        return subprocess.run([interpreter, os.path.join(self.doc, script), *arguments], capture_output=True, text=True,
                              check=False, env=self.environment)

    def refuses(self, wanted, script, *arguments, **options):
        """The script must end with one line that reads as `wanted`."""
        done = self.run(script, *arguments, **options)
        error = done.stderr.strip()
        if done.returncode != 1 or "\n" in error or not re.search(wanted, error):
            self.faults.append(f"{script} {' '.join(arguments)}: exit code {done.returncode}, {done.stdout}{error}")

    def writes(self, files, script, *arguments):
        """The script must end well, with these files changed or new and no other one."""
        before = times_of_files()
        done = self.run(script, *arguments)
        changed = {name for name, time in times_of_files().items() if before.get(name) != time}
        if done.returncode != 0 or changed != set(files):
            self.faults.append(f"{script} {' '.join(arguments)}: exit code {done.returncode}, wrote {sorted(changed)}, {done.stderr}")


def times_of_files():
    return {str(path): path.stat().st_mtime_ns for path in pathlib.Path(".").rglob("*") if path.is_file()}


def check_variants(scripts):
    for entry, wanted in (("Mesh/Cell sise = 0.1", '^variants.py: there is no entry "Mesh/Cell sise". Did you mean "Mesh/Cell size"'),
                          ("Cell size = 0.1", 'Did you mean "Mesh/Cell size"'),
                          ("Soil/Region = 1", 'Did you mean "Sand/Region"'),
                          ("Mesh/Cell size", 'has no "="')):
        scripts.refuses(wanted, "variants.py", "case.prm", "new.prm", entry)
    scripts.refuses("^variants.py: .*no_case.prm", "variants.py", "no_case.prm", "new.prm", "End time = 1")
    scripts.refuses("^variants.py: .*no_folder/new.prm", "variants.py", "case.prm", "no_folder/new.prm", "End time = 1")
    scripts.refuses("is the case itself", "variants.py", "case.prm", "./case.prm", "End time = 1")
    scripts.refuses('Did you mean "Final strain"', "variants.py", "element.prm", "new.prm", "Final strian = 1")
    scripts.writes(["new.prm"], "variants.py", "case.prm", "new.prm", "Sand/Points per cell = 2", "Time step/Courant number = 0.3")
    # Paths count from the case, also in a variant that lies elsewhere; what names no file stays as it is.
    for folder in ("base", "new/deep"):
        pathlib.Path(folder).mkdir(parents=True)
    for name in ("part.prm", "ground.asc"):
        pathlib.Path("base", name).write_text("", encoding="utf-8")
    pathlib.Path("base/case.prm").write_text("include part.prm\nsubsection Bed\n  set Raster = \\\n    ground.asc # heights\n  set Profile = none.csv\nend\n",
                                             encoding="utf-8")
    scripts.writes(["new/deep/new.prm"], "variants.py", "base/case.prm", "new/deep/new.prm", "End time = 1")
    moved = pathlib.Path("new/deep/new.prm").read_text(encoding="utf-8")
    for wanted in ("include ../../base/part.prm\n", "  set Raster = ../../base/ground.asc\n", "  set Profile = none.csv\n"):
        if wanted not in moved:
            scripts.faults.append(f"variants.py: no {wanted!r} in {moved}")


def check_plot_element(scripts):
    scripts.refuses("^plot_element.py: .*nowhere", "plot_element.py", "nowhere")
    scripts.refuses("^plot_element.py: .*run/table.txt has no column strain", "plot_element.py", "run")
    scripts.writes(["element/element.png"], "plot_element.py", "element")


def check_render(scripts):
    scripts.refuses("^render.py: .*nowhere", "render.py", "nowhere")
    scripts.refuses("^render.py: .*No field speed; there are: .*velocity.*\\(points\\).*pressure.*\\(water\\)", "render.py", "run", "--field", "speed")
    scripts.refuses("^render.py: --times 0,one: write numbers", "render.py", "run", "--times", "0,one")
    for how in ([], ["--animate", "gif"]):
        scripts.refuses("^render.py: run has no picture at t = 0.0016 s; there are 3, at 0, 0.001, 0.002 s. The next is at 0.002 s", "render.py", "run",
                        "--times", "0,0.0016", *how)
    scripts.refuses("^render.py: --limits 1: write 2 numbers", "render.py", "run", "--limits", "1")
    scripts.refuses("^render.py: --panels: there is no panel fronts; there are: .*front", "render.py", "run", "--panels", "fronts")
    statistics = "run/statistics.png"
    scripts.writes(["run/points.png", "run/water.png", statistics], "render.py", "run")
    scripts.writes(["run/points_velocity.png", "run/water_velocity.png", statistics], "render.py", "run", "--field", "velocity")
    scripts.writes(["run/water_inside_soil_t_0.png", statistics], "render.py", "run", "--field", "inside_soil", "--times", "0")
    scripts.writes(["mine.png", "mine_statistics.png"], "render.py", "run", "--collection", "water", "--output", "mine.png")
    scripts.refuses("mine.png is there already", "render.py", "run", "--collection", "points", "--output", "mine.png")
    scripts.writes(["mine.png", "mine_statistics.png"], "render.py", "run", "--collection", "points", "--output", "mine.png", "--force")
    scripts.writes(["run/points_t_0.gif", "run/water_t_0.gif"], "render.py", "run", "--animate", "gif", "--times", "0")
    scripts.writes(["film.gif"], "render.py", "run", "--animate", "gif", "--collection", "water", "--output", "film.gif")
    scripts.refuses("film.png: a film of --animate gif ends with .gif", "render.py", "run", "--animate", "gif", "--collection", "water",
                    "--output", "film.png")
    if shutil.which("ffmpeg") is None:
        scripts.refuses("--animate mp4: ffmpeg is missing. Install ffmpeg, or write --animate gif", "render.py", "run", "--animate", "mp4")
    picture = max(pathlib.Path("run/solution").glob("water*.vtu"))
    text = picture.read_bytes()
    picture.write_bytes(text[:len(text) // 2])
    scripts.refuses("^render.py: .*water.*vtu is damaged", "render.py", "run", "--collection", "water", "--field", "mass")
    picture.unlink()
    scripts.refuses("^render.py: .*water.*vtu is not there", "render.py", "run", "--collection", "water", "--field", "mass")


def check_relief(scripts):
    scripts.refuses("^relief.py: .*nowhere", "relief.py", "nowhere")
    scripts.refuses("^relief.py: .*run/maps/deposit.asc", "relief.py", "run", "--maps", "deposit")
    pathlib.Path("run/maps").mkdir()
    grid = pathlib.Path("run/maps/deposit.asc")
    grid.write_text("ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 0.5\n0 1\n2\n", encoding="utf-8")
    scripts.refuses("^relief.py: run/maps/deposit.asc is no ESRI ASCII grid", "relief.py", "run", "--maps", "deposit")
    grid.write_text(grid.read_text(encoding="utf-8") + "3\n", encoding="utf-8")
    scripts.writes(["run/relief.png"], "relief.py", "run", "--maps", "deposit")


def check_mountain(scripts):
    """The rasters of prm/terrain are those that the generator makes, to the digits that it writes."""
    scripts.refuses("^mountain.py: .*case.prm", "mountain.py", "1", "case.prm/folder")
    files = [f"mountain/{name}" for name in ("terrain.asc", "release.asc", "case.prm")]
    scripts.writes(files, "mountain.py", "1", "mountain", "--size", "small")
    terrain = pathlib.Path(scripts.doc).parent / "prm" / "terrain"
    for shipped, made in (("mountain.asc", files[0]), ("release.asc", files[1])):
        texts = [path.read_text(encoding="utf-8").split() for path in (terrain / shipped, pathlib.Path(made))]
        if texts[0][:12] != texts[1][:12] or any(abs(float(a) - float(b)) > 0.011 for a, b in zip(texts[0][12:], texts[1][12:], strict=True)):
            scripts.faults.append(f"{shipped} is not what mountain.py makes")
    scripts.writes(files, "mountain.py", "2", "mountain", "--rim", "cut", "--relief", "smooth", "--feature", "cliff", "--cell", "20", "--spacing", "20")


def check_interpreter(scripts):
    """A Python without the modules names the one that has them."""
    bare = pathlib.Path("bare_python")
    bare.write_text("#!/bin/sh\nexec /usr/bin/python3 -I -S \"$@\"\n", encoding="utf-8")  # -S: no installed packages
    bare.chmod(0o755)
    for script in ("render.py", "plot_element.py", "relief.py", "mountain.py"):
        scripts.refuses(f"^{script}: .* has no module .*: start this with /usr/bin/python3", script, "run", interpreter="./bare_python")
    readme = pathlib.Path(scripts.doc).parent / "README.md"
    for word in re.findall(r"\S*python3 \S+", readme.read_text(encoding="utf-8")):
        if word.startswith("python3"):
            scripts.faults.append(f"{readme}: {word} names no interpreter that is sure to work")


def main():
    doc, scree, element = sys.argv[1:]
    for path in pathlib.Path(".").iterdir():
        (shutil.rmtree if path.is_dir() else os.remove)(path)
    pathlib.Path("case.prm").write_text(CASE, encoding="utf-8")
    pathlib.Path("element.prm").write_text(ELEMENT, encoding="utf-8")
    subprocess.run([scree, "case.prm"], check=True)
    subprocess.run([element, "element.prm"], check=True, capture_output=True)
    pathlib.Path("run/table.txt").write_text("a b\n1 2\n", encoding="utf-8")
    scripts = Scripts(doc, os.path.dirname(scree))
    check_variants(scripts)
    check_plot_element(scripts)
    check_render(scripts)
    check_relief(scripts)
    check_mountain(scripts)
    check_interpreter(scripts)
    print("\n".join(scripts.faults) or "all as they should be")
    sys.exit(bool(scripts.faults))


if __name__ == "__main__":
    main()

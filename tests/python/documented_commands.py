# SPDX-License-Identifier: LGPL-2.1-or-later
"""documented_commands.py BUILD quick|full [PAGE...]: runs every command of the blocks ```sh and ```python of the documentation.

The blocks of a page run in their order in a folder of its own, with a copy of prm/ and a link to BUILD as build/. A page fails with a command that does.
All times of the cases, of scree-variant and of --times are divided by 200, so that pictures are where the text asks for them; of the pictures that the
text does not ask for, most are left out. A factor of safety is searched to 0.3 and, where they fit, with cells of twice the size. The commands on the list NOT_RUN do not run; the list must follow the text.

- quick: without what takes long and does not depend on these times (LONG).
- full: with it.

What stands for the reader's own files and folders is in PLACES and PREPARED; how commands that build or test are checked instead, in checked().
"""

import concurrent.futures
import fractions
import math
import os
import pathlib
import re
import shutil
import subprocess
import sys

from scree.command import ROOT
from scree.studies.study import prm_files

FACTOR = {"doc/tutorials/debris_flow.md": 10}  # here the soil must have entered
DEFAULT_FACTOR = 200
NOT_RUN = {
    "cmake --build build --target scree scree-element": "the test build/test_programs, on which this one depends, is this command",
    "cmake --preset package": "tests/debian13.sh runs it",
    "cmake --build --preset package --target scree scree-element": "compiles everything again",
    "cd build-package && cpack -G DEB": "needs the programs of the line before",
    "podman build -t scree -f doc/Containerfile .": "downloads a system; the page says what is tested",
    'podman run --rm -v "$PWD:/run" -w /run scree mpirun -np 2 scree case.prm': "needs the image of the line before",
    "spack install dealii@9.5 +mpi +p4est +trilinos +muparser": "compiles for hours; the page says that it is not tested",
    "spack load dealii": "needs the package of the line before",
    "build/scree prm/clay/cut.prm --safety": "the test cases/safety_clay_cut is this command",
    "build/scree strong.prm --safety": "as dam.prm --safety on the same page, with other numbers",
    "build/scree-scenarios prm/terrain/acheron_scenarios.toml": "needs rasters that are not in the repository; the page says where to get them",
}
LONG = re.compile(r"cmake (-S|--install)|build/scree-(study|report|scenarios|element --fit)|gdal|mpirun -np 4|build/scree .*dam\.prm --safety")
# What a reader replaces by something of his own.
PLACES = {"FOLDER": "installed", "XMIN YMIN XMAX YMAX": "100 100 500 800"}
# What a page takes for granted: files and runs of the reader.
POLYGON = '{"type": "Polygon", "coordinates": [[[200, 600], [300, 600], [300, 700], [200, 700], [200, 600]]]}'
PREPARED = {"doc/tutorials/own_terrain.md": ["gdal_translate -q -a_srs EPSG:31254 prm/terrain/mountain.asc dtm.tif",
                                             f"echo '{POLYGON}' > release.geojson"],
            "doc/tutorials/fit.md": ["sed -i '1i evaluations = 1' prm/element/erksak_fit.toml"],
            "doc/tutorials/scenarios.md": ["sed -i 's/^runs  *= 64/runs = 8/' prm/terrain/mountain_scenarios.toml"]}
TIMES = ("End time", "Output/Interval", "Output/Statistics interval", "Output/Checkpoint interval", "Settling/Maximum time")
BLOCK = re.compile(r"^ *```(\S*)\n(.*?)^ *```$", re.MULTILINE | re.DOTALL)
COMMAND = re.compile(r"(sudo |sh |mpirun |build/|cmake |apt-get |gdal)")


TIMES_IN_TEXT = (r"(--times )([\d.,]+)", r"(\btime=)([\d.]+)")


def shortened_words(text, factor):
    """A command or a block of Python with its times divided by the factor."""
    for pattern in (*TIMES_IN_TEXT, r"(\"(?:End time|Output/Interval) = )([\d.]+)"):
        text = re.sub(pattern, lambda match: match.group(1) + ",".join(f"{float(number) / factor:.12g}" for number in match.group(2).split(",")), text)
    return text


def rarer(interval, end, wanted):
    """A multiple of the interval of pictures that still meets all wanted times."""
    interval = fractions.Fraction(interval)
    times = [fractions.Fraction(time) for time in (*wanted, end)]
    if any(time % interval for time in times):
        return float(interval)
    return float(interval * math.gcd(*(int(time / interval) for time in times)))


def copy_of_cases(folder, factor, wanted):
    """prm/ in the folder, with the times of all cases divided by the factor, and pictures at the wanted times."""
    shutil.copytree(ROOT / "prm", folder / "prm")
    for case in (folder / "prm").rglob("*.prm"):
        text = case.read_text(encoding="utf-8")
        entries = prm_files.read_entries(ROOT / "prm" / case.relative_to(folder / "prm"))
        if "Path" in entries:  # a case of scree-element
            continue
        if "End time" in entries:
            entries["Output/Interval"] = rarer(entries.get("Output/Interval", "0.1"), entries["End time"], wanted)
            entries["Output/Statistics interval"] = 0
        for name in TIMES:
            if name in entries:
                text = prm_files.set_entry(text, name, f"{float(entries[name]) / factor:.12g}")
        case.write_text(text, encoding="utf-8")


class Page:
    """A page, its blocks, and what its commands did."""

    def __init__(self, path, build, scratch, version):
        self.name, self.build, self.version = str(path.relative_to(ROOT)), build, version
        self.text = path.read_text(encoding="utf-8")
        self.factor = FACTOR.get(self.name, DEFAULT_FACTOR)
        self.folder = scratch / self.name.replace("/", "_")
        self.faults, self.n_commands, self.n_skipped, self.left_out, self.seconds = [], 0, 0, set(), 0.

    def blocks(self):
        return [(language, text) for language, text in BLOCK.findall(self.text) if language in ("sh", "python")]

    def check_languages(self):
        """A block with commands is marked as such."""
        for language, text in BLOCK.findall(self.text):
            if language not in ("sh", "python") and COMMAND.match(text):
                self.faults.append(f"this block has commands and is not marked with sh: {text.splitlines()[0]}")

    def make_folder(self):
        shutil.rmtree(self.folder, ignore_errors=True)
        self.folder.mkdir(parents=True)
        wanted = [time for pattern in TIMES_IN_TEXT for _, words in re.findall(pattern, self.text) for time in words.split(",")]
        copy_of_cases(self.folder, self.factor, wanted)
        for name in set(re.findall(r"build/scree (prm/\S+\.prm) --safety", self.text)):
            case = self.folder / name
            entries, text = prm_files.read_entries(case), prm_files.set_entry(case.read_text(encoding="utf-8"), "Safety/Tolerance", 0.3)
            cell = 2 * float(entries["Mesh/Cell size"])
            if all(float(side) % cell == 0 for side in entries["Mesh/Upper corner"].split(",")):
                text = prm_files.set_entry(text, "Mesh/Cell size", cell)
            case.write_text(text, encoding="utf-8")
        (self.folder / "build").symlink_to(self.build)
        # The quickstart without installation and build: the rest of the script runs.
        shutil.copytree(ROOT / "doc" / "studies" / "reference", self.folder / "doc" / "studies" / "reference")
        shutil.copy(ROOT / "doc" / "quickstart.sh", self.folder / "doc")
        (self.folder / "doc" / "setup.sh").write_text(f'root="{self.folder}"\n', encoding="utf-8")

    def checked(self, command):
        """What runs in place of a command that builds, tests or writes into the repository."""
        words = command.split()
        if command.startswith("sh tests/run.sh"):  # that these tests exist
            chosen = " ".join(word for word in words[2:] if word != "--full") if len(words) > 2 else "-L '^quick$'"
            return f"ctest --test-dir build/ -N {chosen} | grep -q 'Test *#'"
        if "apt-get install" in command:  # that the packages exist
            return command.replace("sudo ", "").replace("apt-get install", "apt-get --simulate install") if shutil.which("apt-get") else "true"
        if command.startswith("cmake -S . -B build"):  # into another folder
            cache = (self.build / "CMakeCache.txt").read_text(encoding="utf-8")
            for place, entry in (("/path/to/dealii", "deal.II_DIR"), ("/path/to/python3", "SCREE_PYTHON")):
                command = command.replace(place, re.search(f"^{entry}:.*=(.*)$", cache, re.MULTILINE).group(1))
            return command.replace("-S . -B build", f"-S {ROOT} -B configured")
        if words[0] == "paraview":  # that the script is there and can be read
            return f"{sys.executable} -m py_compile {words[1].removeprefix('--script=')}"
        if words[0] == "build/scree-study" and words[1] != "--list":
            return command + " --quick --jobs 1 --results results/studies"
        return command

    def run(self, command):
        """Runs a command of the page or what stands for it."""
        self.n_commands += 1
        if command in NOT_RUN:
            self.left_out.add(command)
            return
        is_without_program = any(command.startswith(start) and shutil.which(program) is None
                                 for start, program in (("gdal", "gdalwarp"), ("build/scree-scenarios", "snakemake")))
        if (LONG.match(command) and self.version == "quick") or is_without_program:
            self.n_skipped += 1
            return
        called = self.checked(shortened_words(command, self.factor))
        for place, value in PLACES.items():
            called = called.replace(place, value)
        self.call(["sh", "-c", called], command)

    def call(self, words, command):
        environment = {**os.environ, "PYTHONPATH": str(ROOT / "source" / "python"), "SLURM_NTASKS": "2",
                       "PATH": f"{self.folder}/build:{os.environ['PATH']}", "TMPDIR": str(self.folder)}
        environment.pop("DISPLAY", None)  # Open MPI would ask the display for graphics cards
        with open(self.folder / "screen.txt", "w+", encoding="utf-8") as screen:
            process = subprocess.Popen(words, cwd=self.folder, env=environment, stdout=screen, stderr=subprocess.STDOUT)
            _, status, usage = os.wait4(process.pid, 0)
            process.returncode = os.waitstatus_to_exitcode(status)  # it has been waited for
            screen.seek(0)
            last = screen.read().strip().splitlines()[-5:]
        seconds = usage.ru_utime + usage.ru_stime
        self.seconds += seconds
        if seconds > 5:
            print(f"  {self.name}: {seconds:.0f} core-seconds, {command}", flush=True)
        if process.returncode != 0:
            self.faults.append("\n    ".join([f"{command}: exit code {process.returncode}", *last]))

    def run_blocks(self):
        self.check_languages()
        if self.blocks():
            self.make_folder()
            for command in PREPARED.get(self.name, []):
                self.run(command)
        self.run_all()
        if not self.faults:
            shutil.rmtree(self.folder, ignore_errors=True)
        return self

    def run_all(self):
        for language, text in self.blocks():
            if language == "python":
                self.n_commands += 1
                self.call([sys.executable, "-c", shortened_words(text, self.factor)], f"block of Python: {text.splitlines()[0]}")
            elif text.startswith("#!"):  # a script
                self.n_commands += 1
                (self.folder / "job.sh").write_text(text, encoding="utf-8")
                self.call(["bash", "job.sh"], "the script " + text.splitlines()[1])
            else:
                for line in text.replace("\\\n", " ").splitlines():
                    command = " ".join(re.sub(r"\s#.*", "", line).split())
                    if command:
                        self.run(command)


def pages():
    generated = ROOT / "doc" / "studies" / "pages"
    return [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "prm").rglob("*.md")),
            *(path for path in sorted((ROOT / "doc").rglob("*.md")) if generated not in path.parents)]


def main():
    build, version = pathlib.Path(sys.argv[1]).resolve(), sys.argv[2]
    chosen = [ROOT / name for name in sys.argv[3:]] or pages()
    scratch = pathlib.Path("documented_commands", version).resolve()
    if os.geteuid() == 0:
        os.environ.update(OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        # Long pages first: those with factors of safety, then by their length.
        chosen.sort(key=lambda path: (b".prm --safety" not in path.read_bytes(), -len(path.read_bytes())))
        done = list(pool.map(lambda path: Page(path, build, scratch, version).run_blocks(), chosen))
    for page in sorted(done, key=lambda page: page.name):
        if page.n_commands:
            print(f"{page.name}: {page.n_commands} commands, {page.n_skipped} only in the full version or with other programs, {page.seconds:.0f} core-seconds")
    faults = [f"{page.name}: {fault}" for page in done for fault in page.faults]
    if len(sys.argv) < 4:
        faults += [f"{command} is on the list of commands that are not run, and on no page"
                   for command in set(NOT_RUN) - set().union(*(page.left_out for page in done))]
    n_commands = sum(page.n_commands for page in done)
    print(f"{n_commands} commands, {len(NOT_RUN)} are never run")
    sys.exit("\n".join(faults) or not n_commands)


if __name__ == "__main__":
    main()

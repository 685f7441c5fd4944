# SPDX-License-Identifier: LGPL-2.1-or-later
"""Writes a report of a run: one HTML file with verdict, warnings, statistics, pictures, maps, the case and the log.

scree-report results/quickstart

Writes report.html into the run folder. The file holds its pictures, so that it can be sent and archived alone. Pictures are those of scree-render and
scree-maps; one that cannot be drawn is replaced by the message of its command.
"""

import base64
import datetime
import html
import io
import os
import pathlib
import re
import subprocess
import sys
import tempfile

import numpy as np
import PIL.Image

from scree import maps, results, variants
from scree.command import Command

LARGEST_PICTURE = 700_000  # bytes; larger ones are compressed with loss

STYLE = """
body { font: 15px/1.5 system-ui, "Segoe UI", "Liberation Sans", Arial, sans-serif; color: #222; max-width: 62rem; margin: 2rem auto; padding: 0 1rem; }
h1 { font-size: 1.7rem; margin-bottom: 0; } h2 { font-size: 1.2rem; border-bottom: 1px solid #bbb; margin-top: 2.2rem; }
nav { font-size: .9rem; margin: 1rem 0; } nav a { margin-right: 1rem; } a { color: #14568c; }
table { border-collapse: collapse; } th, td { text-align: left; vertical-align: top; padding: .15rem .9rem .15rem 0; border-bottom: 1px solid #e4e4e4; }
th.number, td.number { text-align: right; font-variant-numeric: tabular-nums; }
pre { background: #f6f6f4; border: 1px solid #e0e0dc; padding: .7rem; overflow-x: auto; font-size: 12.5px; line-height: 1.4; }
figure { margin: 1rem 0; } img { max-width: 100%; height: auto; } figcaption, .note { color: #555; font-size: .9rem; }
.good, .open, .bad { border-left: 5px solid #3a8a4d; background: #eef6ef; padding: .4rem .8rem; margin: .5rem 0; white-space: pre-line; }
.open { border-color: #c98a00; background: #fdf6e3; } .bad { border-color: #b8322a; background: #fbeeed; }
summary { cursor: pointer; } ul { padding-left: 1.2rem; }
@media print { body { font-size: 10pt; margin: 0; max-width: none; } nav { display: none; } figure, tr, .good, .open, .bad { break-inside: avoid; }
               h2 { break-after: avoid; } pre { white-space: pre-wrap; font-size: 8pt; } a { color: inherit; } }
"""


def identity(run, log):
    """[(what, text)] of program, date, command, case, model and machine."""
    program, case = log.parts.get("Program", ""), log.parts.get("Case", "original.prm").split(" -> ")[0]
    version = re.match(r"Scree (\S+)(?: \(([^)]*)\))?", program)
    date = re.search(r"\d{4}-\d\d-\d\d \d\d:\d\d:\d\d UTC", program)
    ranks = re.search(r"(\d+) ranks?\b", program)
    n_ranks = int(ranks.group(1)) if ranks else 1
    return [(what, text) for what, text in (
        ("Run folder", str(pathlib.Path(run))),
        ("Start of the run", date.group(0) if date else ""),
        ("Program", f"Scree {version.group(1)}" if version else ""),
        ("Commit", version.group(2) if version else ""),
        ("Command", (f"mpirun -np {n_ranks} " if n_ranks > 1 else "") + f"scree {case}"),
        *((label, log.parts.get(label, "")) for label in ("Model", "Mesh", "Memory", "Libraries")),
    ) if text]


def table(rows, head=()):
    """A table of HTML; numbers are right-aligned."""
    is_number = [isinstance(cell, float) for cell in rows[0]] if rows else []
    cells = "".join(f'<th{" class=number" if is_right else ""}>{html.escape(word)}</th>' for word, is_right in zip(head, is_number))
    lines = [f"<tr>{cells}</tr>"] if head else []
    for row in rows:
        lines.append("<tr>" + "".join(f'<td{" class=number" if isinstance(cell, float) else ""}>'
                                      f"{f'{cell + 0.:.6g}' if isinstance(cell, float) else html.escape(cell)}</td>" for cell in row) + "</tr>")
    return "<table>\n" + "\n".join(lines) + "\n</table>"


def verdict(run, log):
    """How the run has ended, and the lines Limits, Motion, Run-out and Checks, each marked as good, bad (a fault) or open (resolution, motion goes on)."""
    lines = []
    if "Stopped" in log.parts:
        lines.append(("bad", "Stopped", log.parts["Stopped"]))
    elif "Finished" in log.parts:
        lines.append(("good", "Finished", log.parts["Finished"]))
    else:
        lines.append(("bad", "Not finished", f"the run still goes on, or has ended with an error; {_last_time(run)}"))
    checks = results.read_checks(run)
    beyond = {check.kind for check in checks if check.is_exceeded}
    mark = "open" if log.parts.get("Motion", "").startswith("not at rest") else "good"
    lines += [(mark if label != "Limits" else "good", label, log.parts[label]) for label in ("Limits", "Motion", "Run-out") if label in log.parts]
    lines.append(("bad" if "fault" in beyond or not checks else "open" if beyond else "good", "Checks",
                  log.parts.get("Checks", "there is no such line in the log: the run did not come to its end")))
    return "\n".join(f'<div class="{mark}"><b>{label}</b> {html.escape(text)}</div>' for mark, label, text in lines)


def _last_time(run):
    statistics = results.read_statistics(run) if (pathlib.Path(run) / "statistics.csv").exists() else {}
    times = statistics.get("Time (s)", [])
    end = variants.read_entries(pathlib.Path(run) / "parameters.prm").get("End time", "?")
    return f"the last row of statistics is at t = {times[-1]:g} s, the end time is {end} s" if len(times) else "there are no statistics"


def band(run):
    """The field that shows where soil shears, as --field for a run folder."""
    name = "plastic_shear_strain"
    return ["--field", name if name in results.read_points(run).arrays else "displacement"]


def stages(run, log, folder):
    """What the log says of each stage: what was removed or added, how it settled, its motion and checks beyond their bounds; with pictures of it."""
    parts, times = [], results.times_of_stages(run) if (run / "solution" / "points.pvd").exists() else []
    for number, block in enumerate(re.split(r"^Stage +", log.text, flags=re.MULTILINE)[1:]):
        title, text = block.split("\n", 1)
        joined = re.sub(r"\n {12}(?=\S)", " ", text)  # lines that go on
        lines = re.findall(r"^(Removed|Added|Settled|Settling:|Check:|Motion|Run-out) +(.*)$", joined, re.MULTILINE)
        said = "\n".join(f'<div class="{"bad" if label == "Check:" else "good"}"><b>{label.rstrip(":")}</b> {html.escape(line)}</div>'
                         for label, line in lines if not re.match(r"\S+ s, step ", line))  # of its progress
        parts.append(f"<h3>{html.escape(title)}</h3>\n{said}")
        if number < len(times):
            shown = ",".join(map(repr, map(float, times[number])))
            caption = title.split(",")[0] + ": at its release and at its end"
            parts.append(_figures(run, [(caption, "render", ["--collection", "points", *band(run), "--times", shown])], folder, []))
    return "\n".join(parts)


def warnings(log):
    if not log.warnings:
        return "<p>None.</p>"
    return "<ul>\n" + "\n".join(f"<li>{html.escape(line)}</li>" for line in dict.fromkeys(log.warnings)) + "\n</ul>"


def final_statistics(run):
    """Table of the first and the last row of the statistics."""
    if not (pathlib.Path(run) / "statistics.csv").exists():
        return "<p>There are no statistics.</p>"
    rows = []
    for name, values in results.read_statistics(run).items():
        quantity, unit = results.split_unit(name)
        numbers = values[np.isfinite(values)]
        if len(values):
            rows.append((quantity, unit or "-", float(values[0]), float(values[-1]),
                         *((float(numbers.min()), float(numbers.max())) if len(numbers) else ("-", "-"))))
    return table(rows, ("quantity", "unit", "first row", "last row", "smallest", "largest")) if rows else "<p>The statistics have no row.</p>"


def case_text(run):
    """The case as given, and folded all entries with the values used."""
    run, parts = pathlib.Path(run), []
    for name, heading in (("original.prm", ""), ("parameters.prm", "All entries with the values used")):
        if (run / name).exists():
            text = f"<pre>{html.escape((run / name).read_text(encoding='utf-8', errors='replace').strip())}</pre>"
            parts.append(f"<details><summary>{heading} ({name})</summary>{text}</details>" if heading else f'<p class="note">{name}</p>{text}')
    return "\n".join(parts)


def files(run):
    """Table of files and their sizes; of folders the sum."""
    run, rows = pathlib.Path(run), []
    for path in sorted(run.iterdir()):
        if path.name != "report.html":
            parts = [part for part in path.rglob("*") if part.is_file()] if path.is_dir() else [path]
            rows.append((path.name + (f"/ ({len(parts)} files)" if path.is_dir() else ""), sum(part.stat().st_size for part in parts) / 1000))
    return table(rows, ("file", "size (kB)"))


def safety_folder(run):
    """The folder of --safety of a run, which may be the run folder itself; None without."""
    return next((folder for folder in (run, run / "safety") if (folder / "safety.csv").exists()), None)


def factor_of_safety(folder):
    """What the log of --safety says of the factor, and a table of its trials."""
    lines = re.findall(r"^(Factor of safety|Set by|Zone|Stopped) +(.*)$", (folder / "log.txt").read_text(encoding="utf-8"), re.MULTILINE)
    trials = results.read_table(folder / "safety.csv")
    said = "\n".join(f'<div class="{"bad" if label == "Stopped" else "good"}"><b>{label}</b> {html.escape(text)}</div>' for label, text in lines)
    return said + table(sorted(zip(*trials.values())), trials)


def picture_commands(run, field, times):
    """[(caption, module, arguments)] of the pictures that there is something for."""
    run = pathlib.Path(run)
    at_times = ["--times", times] if times else []
    commands = {"points": [], "charts": [], "maps": []}
    if (run / "solution" / "points.pvd").exists():
        commands["points"].append(("Scene at the start", "render", ["--scene"]))
    for collection, caption in (("points", "Soil points"), ("water", "Water points")):
        if (run / "solution" / f"{collection}.pvd").exists():
            asked = ["--field", field] if field and collection == "points" else []
            commands["points"].append((caption, "render", ["--collection", collection, *asked, *at_times]))
    for probe in sorted(path.stem[len("probe_"):] for path in run.glob("probe_*.csv")):
        commands["charts"].append((f"Probe {probe}", "render", ["--probe", probe]))
    if maps.map_files(run):
        commands["maps"].append(("Maps", "maps", []))
    return commands


def draw(run, module, arguments, folder):
    """The pictures that a command writes, {name: content}. Throws a ValueError with its message if it fails."""
    package = pathlib.Path(__file__).resolve().parents[1]
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join([str(package), *filter(None, [os.environ.get("PYTHONPATH")])])}
    with tempfile.TemporaryDirectory(dir=folder) as place:
        output = pathlib.Path(place) / "picture.png"
        done = subprocess.run([sys.executable, "-m", "scree", module, str(run), *arguments, "--output", str(output)],
                              capture_output=True, text=True, check=False, env=environment)
        if done.returncode != 0:
            raise ValueError(done.stderr.strip().splitlines()[-1] if done.stderr.strip() else f"exit code {done.returncode}")
        return {path.stem: path.read_bytes() for path in sorted(pathlib.Path(place).glob("*.png"))}


def embedded(content):
    """The address of a picture within the text. Too large a picture becomes a JPEG, of 1600 pixels at most."""
    kind = "png"
    if len(content) > LARGEST_PICTURE:
        with PIL.Image.open(io.BytesIO(content)) as image:
            small = image.convert("RGB")
            small.thumbnail((1600, 3000))
            smaller = io.BytesIO()
            small.save(smaller, "JPEG", quality=88, optimize=True)
        content, kind = smaller.getvalue(), "jpeg"
    return f"data:image/{kind};base64," + base64.b64encode(content).decode("ascii")


def figure(caption, content):
    """A picture with its caption, from the content of its file."""
    text = html.escape(caption)
    return f'<figure><img alt="{text}" src="{embedded(content)}"><figcaption>{text}</figcaption></figure>'


def _figures(run, commands, folder, charts):
    """The figures of a section. Charts of statistics that a command has drawn besides go to `charts`."""
    parts = []
    for caption, module, arguments in commands:
        try:
            pictures = draw(run, module, arguments, folder)
        except ValueError as error:
            parts.append(f'<p class="note">{html.escape(caption)}: not drawn. {html.escape(str(error))}</p>')
            continue
        for name, content in pictures.items():
            if "statistics" in name:
                charts[:] = [figure("Statistics", content)]  # the same for each collection
            else:
                parts.append(figure(caption, content))
    return "\n".join(parts)


def description(file):
    """The first sentence of the comment at the head of a case or a study; the rest may be of the case that it was copied from."""
    file, lines = pathlib.Path(file), []
    for line in file.read_text(encoding="utf-8-sig", errors="replace").splitlines() if file.exists() else []:
        if not line.startswith("#"):
            break
        lines.append(line.lstrip("# ").strip())
    return re.split(r"(?<=[.!?])\s+(?=[A-Z])", " ".join(lines))[0]


def page(run, field=None, times=None):
    """The whole text of the report. Throws OSError or ValueError if `run` is no run folder."""
    run = pathlib.Path(run)
    safety = safety_folder(run)
    # A folder of --safety alone has the case in those of its trials.
    case = run if safety is None or (run / "parameters.prm").exists() else next(
        (safety / trial for trial in ("fails", "rests") if (safety / trial).exists()), run)
    variants.read_entries(case / "parameters.prm")
    log, charts, trials = results.read_log(run if case == run else safety), [], []
    with tempfile.TemporaryDirectory() as folder:
        drawn = {section: _figures(run, commands, folder, charts) for section, commands in picture_commands(run, field, times).items()}
        for trial in ("fails", "rests") if safety else ():
            if (safety / trial / "solution" / "points.pvd").exists():
                trials.append(_figures(safety / trial, [(f"The slope {trial}", "render", ["--collection", "points", *band(safety / trial)])], folder, []))
        of_stages = stages(run, log, folder)
    sections = [
        ("safety", "Factor of safety", factor_of_safety(safety) + "\n".join(trials) if safety else ""),
        ("verdict", "Verdict", verdict(run, log) if case == run else ""),
        ("stages", "Stages", of_stages),
        ("warnings", "Warnings", warnings(log)),
        ("run", "Run", table(identity(run, log))),
        ("maps", "Maps", drawn["maps"]),
        ("pictures", "Pictures", drawn["points"]),
        ("charts", "Charts", "\n".join(charts) + drawn["charts"]),
        ("statistics", "Statistics", final_statistics(run) if case == run else ""),
        ("case", "Case", case_text(case)),
        ("log", "Log", f"<details><summary>log.txt</summary><pre>{html.escape(log.text.strip())}</pre></details>"),
        ("files", "Files", files(run)),
    ]
    return document(run.resolve().name, "report of a run of Scree", description(case / "original.prm"), sections)


def document(title, kind, text, sections):
    """A page of HTML; `sections`: [(anchor, heading, content)], of which those without content are left out."""
    sections = [section for section in sections if section[2].strip()]
    now = datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%d %H:%M UTC")
    links = "".join(f'<a href="#{anchor}">{heading}</a>' for anchor, heading, _ in sections)
    body = "\n".join(f'<section id="{anchor}">\n<h2>{heading}</h2>\n{content}\n</section>' for anchor, heading, content in sections)
    return (f'<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n<meta name="viewport" content="width=device-width, initial-scale=1">\n'
            f"<title>{html.escape(title)}: {kind}</title>\n<style>{STYLE}</style>\n</head>\n<body>\n<h1>{html.escape(title)}</h1>\n"
            f'<p>{html.escape(text)}</p>\n<p class="note">Report of {now}</p>\n<nav>{links}</nav>\n{body}\n</body>\n</html>\n')


def _write(arguments):
    output = arguments.output or arguments.run / "report.html"
    text = page(arguments.run, arguments.field, arguments.times)
    output.write_text(text, encoding="utf-8")
    print(f"Wrote {output} ({len(text.encode()) / 1e6:.1f} MB)")


def main():
    parser = Command("scree-report", __doc__)
    parser.add_argument("run", type=pathlib.Path, help="run folder, for instance results/quickstart")
    parser.add_argument("--field", help="of the pictures of soil points, as for scree-render")
    parser.add_argument("--times", help="times of these pictures in s, separated by commas; default: first, 1/4, 1/2 and last")
    parser.add_argument("--output", type=pathlib.Path, help="another file; default: report.html in the run folder")
    parser.run(_write)

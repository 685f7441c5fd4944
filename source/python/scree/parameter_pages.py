# SPDX-License-Identifier: LGPL-2.1-or-later
"""Writes the pages of doc/parameters, one for each subsection of a case file, from the entries that the program declares.

The introduction of a page is doc/parameters/intro/PAGE.md. With --check, nothing is written: the exit code is 1 if a page differs."""

import json
import pathlib
import re
import subprocess
import textwrap

from scree.command import ROOT, Command, program

# Subsections in the order of the index, with their pages where these have another name. Others get a page of their own name.
PAGES = {"": "top_level", "Mesh": None, "Soil": "bodies", "Boundaries": None, "Bed": None, "Obstacle Wall": "obstacle", "Inflow Torrent": "inflow", "Rain": None,
         "Contact Base": "contact", "Base motion": None, "Surface load": None, "Water": None, "Settling": None, "Stage": None, "Safety": None, "Time step": None,
         "Transfer": None, "Stabilisation": None, "Output": None, "Probes": None}

UNITS = {"m", "s", "m/s", "m/s^2", "1/s", "Pa", "Pa s", "kg/m^3", "degrees"}
LARGEST = {"MAX_DOUBLE", "MAX_INT", "-MAX_DOUBLE", "-MAX_INT"}
NOTE = "<!-- Made by python3 -m scree parameter_pages from the declarations in source/ and from %s. Do not edit. -->"


def is_entry(node):
    return "pattern_description" in node


def split_unit(documentation):
    """(unit or "", description) of a declaration, which begins with the unit and a semicolon where there is one."""
    unit, semicolon, rest = documentation.partition("; ")
    if not semicolon or unit not in UNITS:
        return "", documentation
    return unit, rest[0].upper() + rest[1:]


def limits(noun, low, high):
    if high in LARGEST:
        return noun if low in LARGEST else f"{noun} above 0" if low == "1e-12" else f"{noun} from {low}"
    if low in LARGEST:
        return f"{noun} up to {high}"
    return f"{noun} above 0, at most {high}" if low == "1e-12" else f"{noun} from {low} to {high}"


def kind_of_text(description, default):
    """What a text that the program reads itself stands for."""
    if default == "auto":
        return "number or `auto`"
    for words, kind in (("expression", "expression"), ("coordinate system", "text"), ("coordinate", "number"), ("Names", "names"), ("name of", "name")):
        if words.lower() in description.lower():
            return kind
    return "text"


def values(pattern, description, default):
    """What an entry accepts, in words."""
    if number := re.fullmatch(r"\[(Double|Integer)(?: range)? (\S+?)\.\.\.(\S+) \(inclusive\)\]", pattern):
        return limits("number" if number.group(1) == "Double" else "whole number", number.group(2), number.group(3))
    if words := words_of(pattern):
        return ", ".join(f"`{word}`" for word in words)
    if numbers := re.fullmatch(r"\[List of <\[Double.*?\]> of length (\d+)\.\.\.(\d+) \(inclusive\)\]", pattern):
        low, high = numbers.groups()
        return f"{low} numbers" if low == high else "2 or 3 numbers"
    if pattern.startswith("[List of"):
        return "names"
    if pattern.startswith("[FileName"):
        return "path of a file"
    return "`true`, `false`" if pattern == "[Bool]" else kind_of_text(description, default)


def words_of(pattern):
    """The words of a selection."""
    selection = re.fullmatch(r"\[Selection (.*?) ?\]", pattern)
    return selection.group(1).split("|") if selection else []


def sentences(text, words):
    """The sentences of a description, each on a line of its own; those about one of the words are items of a list."""
    lines, in_list = [], False
    for sentence in re.split(r"(?<=[A-Za-z0-9)\"\]])\. (?=[A-Za-z0-9\"])", text.rstrip(".")):
        word = next((word for word in [*words, "auto", "none"] if sentence.startswith(word + ": ")), None)
        if word:
            lines += ([] if in_list or not lines else [""]) + wrapped(f"- `{word}`: {marked(sentence[len(word) + 2:])}.", "  ")
        else:
            lines += ([""] if in_list else []) + wrapped(marked(sentence) + ".", "")
        in_list = bool(word)
    return lines


def wrapped(line, indent):
    return textwrap.wrap(line, 118, subsequent_indent=indent, break_long_words=False, break_on_hyphens=False)


def marked(text):
    """Names of entries and statements, which stand between quotes, as code; no star begins an emphasis."""
    text = re.sub(r'"([^"]+)"', r"`\1`", text.replace("*", r"\*"))
    return re.sub(r"^(true|0): ", r"`\1`: ", text)


def entry_lines(name, node):
    unit, description = split_unit(node["documentation"])
    pattern, default = node["pattern_description"], node["default_value"].strip()
    accepted = values(pattern, description, default)
    if " | " in description:  # The walls: the description lists what is accepted.
        description, _, walls = description.rstrip(".").partition(": ")
        accepted = ", ".join(f"`{wall}`" for wall in walls.split(" | "))
    dimension = re.match(r"([23]D)\. ", description)
    description = description[dimension.end():] if dimension else description
    facts = [f"{dimension.group(1)} only"] if dimension else []
    facts += ([f"unit {unit}"] if unit else []) + [f"values: {accepted}", f"default `{default}`" if default else "default empty"]
    return [f"### {name}", "", "*" + "; ".join(facts) + "*", ""] + sentences(description, words_of(pattern)) + [""]


def section_lines(node, path, title):
    lines = [f"## {title}", ""] if any(is_entry(child) for child in node.values()) else []
    for name, child in node.items():
        if is_entry(child):
            lines += entry_lines(name, child)
    for name, child in node.items():
        if not is_entry(child):
            below = f"{path}/{name}" if path else name
            lines += section_lines(child, below, f"Subsection {name}")
    return lines


def introduction(folder, page, subsection=""):
    """Head and first lines of a page."""
    file = folder / "intro" / f"{page}.md"
    return file.read_text(encoding="utf-8").strip() if file.is_file() else f"# {subsection}\n\n`subsection {subsection}`"


def pages(entries, folder):
    """{file name: text} of all pages."""
    result, table = {}, []
    top = {name: node for name, node in entries.items() if is_entry(node)}
    subsections = {"": top, **{name: node for name, node in entries.items() if not is_entry(node)}}
    order = list(PAGES) + [name for name in subsections if name not in PAGES]
    for subsection in order:
        page = PAGES.get(subsection) or subsection.lower().replace(" ", "_")
        head = introduction(folder, page, subsection)
        lines = [NOTE % f"intro/{page}.md", "", head, "", *section_lines(subsections[subsection], subsection, "Entries")]
        result[f"{page}.md"] = "\n".join(lines).rstrip() + "\n"
        table.append((page, head.partition("\n")[0][2:]))
    lines = [NOTE % "intro/index.md", "", introduction(folder, "index")] + ["", "## Pages", ""]
    lines += [f"- [{title}]({page}.md)" for page, title in table]
    lines += ["", "```{toctree}", ":hidden:", ""] + [page for page, _ in table] + ["```"]
    result["index.md"] = "\n".join(lines) + "\n"
    return result


def work(arguments):
    printed = subprocess.run([arguments.program, "--print-parameters", "--json"], capture_output=True, text=True, check=True).stdout
    folder = pathlib.Path(arguments.folder)
    wanted = pages(json.loads(printed), folder)
    changed = [name for name, text in wanted.items() if not (folder / name).is_file() or (folder / name).read_text(encoding="utf-8") != text]
    unknown = sorted({file.name for file in folder.glob("*.md")} - set(wanted))
    unused = sorted({file.name for file in (folder / "intro").glob("*.md")} - set(wanted))
    if arguments.check:
        faults = [f"{name} is not current" for name in changed] + [f"{name} has no subsection" for name in unknown]
        faults += [f"intro/{name} has no page" for name in unused]
        print("\n".join(faults + ["Write the pages again: python3 -m scree parameter_pages"]) if faults else f"{len(wanted)} pages are current")
        return bool(faults)
    for name in changed:
        (folder / name).write_text(wanted[name], encoding="utf-8")
    return 0


def main():
    command = Command("parameter_pages", __doc__)
    command.add_argument("--check", action="store_true", help="only compare the pages with the entries")
    command.add_argument("--program", default=program("scree"), help="the program scree (default: that of the build folder)")
    command.add_argument("--folder", default=ROOT / "doc" / "parameters", help="folder of the pages (default: doc/parameters)")
    command.run(work)


if __name__ == "__main__":
    main()

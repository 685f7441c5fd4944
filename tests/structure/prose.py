# SPDX-License-Identifier: LGPL-2.1-or-later
"""prose.py ROOT: limits of the texts below ROOT, which are README.md, CONTRIBUTING.md, CHANGELOG.md, doc/**/*.md and the comments of prm/**/*.prm.

A line has at most 120 characters (in a table 300), a sentence at most 40 words, a cell of a table at most 25 words, and no text has a phrase
of forbidden_phrases.txt. Code, formulas and targets of links do not count. The descriptions of entries are on the pages of doc/parameters."""

import pathlib
import re
import sys

LENGTH_OF_LINE, LENGTH_OF_ROW, WORDS_OF_SENTENCE, WORDS_OF_CELL = 120, 300, 40, 25


def forbidden_phrases():
    text = (pathlib.Path(__file__).parent / "forbidden_phrases.txt").read_text(encoding="utf-8")
    return [line.strip() for line in text.splitlines() if line.strip() and not line.startswith("#")]


PHRASES = [re.compile(r"(?<!\w)(" + r"\s+".join(phrase.split()) + r")(?!\w)", re.IGNORECASE) for phrase in forbidden_phrases()]


def plain(line):
    """A line without what does not count: a formula, code or a number to fill in is one word, a link its text."""
    line = re.sub(r"`[^`]*`", "`code`", line)
    line = re.sub(r"\{[\w.]+(\[[^\]]*\])?:[^}]*\}", "number", line)
    line = re.sub(r"\$[^$]+\$", lambda formula: "f" * len(formula[0]), line)
    line = re.sub(r"(!?\[[^\]]*\])\([^()\s]*(?:\([^()]*\)[^()\s]*)*\)", r"\1", line)
    line = re.sub(r"^(\[[^\]]+\]:) .*", r"\1", line)
    return re.sub(r"<?https?://[^\s>)]+>?", "link", line)


def words(text):
    return len([word for word in text.split() if re.search(r"\w", word)])


def sentences(text):
    return re.split(r"(?<=[.!?])[\"')*_]*\s+(?=[\"'(`*_\[]*[A-Z0-9`])", text)


def phrase_faults(number, text):
    for pattern in PHRASES:
        for found in pattern.finditer(text):
            yield number, f'the phrase "{found[0]}"'


def paragraph_faults(number, text):
    for sentence in sentences(text):
        if words(sentence) > WORDS_OF_SENTENCE:
            yield number, f"a sentence of {words(sentence)} words: {sentence[:60]}..."
    yield from phrase_faults(number, text)


def blocks(lines):
    """(number, text) of the lines that count: fences, display formulas, comments and front matter are left out."""
    fence, hidden = None, None
    for number, line in enumerate(lines, 1):
        mark = re.match(r"\s*(?:[-*] +)?(`{3,}|~{3,}|:{3,})", line)
        text, counted = line.strip(), ""
        if fence:
            if mark and text == mark.group(1) and mark.group(1).startswith(fence):
                fence = None
        elif hidden:
            hidden = None if hidden in line else hidden
        elif mark:
            fence = mark.group(1) if mark.group(1)[0] != ":" else None
        elif text.startswith("$$"):
            hidden = None if text.endswith("$$") and len(text) > 3 else "$$"
        elif text.startswith("<!--"):
            hidden = None if "-->" in line else "-->"
        elif number == 1 and text == "---":
            hidden = "---"
        else:
            counted = plain(line)
        yield number, counted


def markdown_faults(lines):
    start, paragraph, indented = 0, [], False
    for number, line in list(blocks(lines)) + [(len(lines) + 1, "")]:
        text = line.strip()
        is_row = text.startswith("|")
        indented = line.startswith("    ") and not paragraph and not re.match(r"\s+([-*]|\d+\.) ", line) if text else indented
        if indented and text:
            continue  # code by indentation
        if len(line) > (LENGTH_OF_ROW if is_row else LENGTH_OF_LINE):
            yield number, f"a line of {len(line)} characters"
        if is_row:
            for cell in text.strip("|").split("|"):
                if words(cell) > WORDS_OF_CELL:
                    yield number, f"a cell of {words(cell)} words: {cell.strip()[:60]}..."
            yield from phrase_faults(number, text)
        if paragraph and (not text or is_row or re.match(r"([-*+]|\d+\.) |#|>", text)):
            yield from paragraph_faults(start, " ".join(paragraph))
            paragraph = []
        if text and not is_row:
            start = start if paragraph else number
            paragraph.append(re.sub(r"^([-*+]|\d+\.|#+|>) +", "", text))
            if text.startswith("#"):
                yield from paragraph_faults(start, " ".join(paragraph))
                paragraph = []


def comment_faults(lines):
    """The comments of a case: lines in a row are one paragraph, a comment behind an entry is its own."""
    start, paragraph = 0, []
    for number, line in enumerate(lines + [""], 1):
        text = line.strip()
        if "#" in line and len(line) > LENGTH_OF_LINE:
            yield number, f"a line of {len(line)} characters"
        if text.startswith("#"):
            start = start if paragraph else number
            paragraph.append(plain(text.lstrip("# ")))
            continue
        if paragraph:
            yield from paragraph_faults(start, " ".join(paragraph))
            paragraph = []
        if "#" in text:
            yield from paragraph_faults(number, plain(text.split("#", 1)[1].strip()))


def main():
    root = pathlib.Path(sys.argv[1])
    texts = [root / name for name in ("README.md", "CONTRIBUTING.md", "CHANGELOG.md")] + sorted((root / "doc").rglob("*.md"))
    checked, n_faults = 0, 0
    for file in texts + sorted((root / "prm").rglob("*.prm")):
        name = file.relative_to(root)
        if not file.is_file():
            continue
        lines = file.read_text(encoding="utf-8").splitlines()
        checked += 1
        for number, fault in comment_faults(lines) if file.suffix == ".prm" else markdown_faults(lines):
            print(f"{name}, line {number}: {fault}")
            n_faults += 1
    print(f"{checked} files, {n_faults} faults")
    sys.exit(bool(n_faults) or checked < 1)


if __name__ == "__main__":
    main()

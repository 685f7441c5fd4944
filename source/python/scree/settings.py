# SPDX-License-Identifier: LGPL-2.1-or-later
"""Files in TOML that the user writes: how they are read, and how faults in them are told."""

import difflib
import tomllib


def read(file, keys, tables):
    """The content of a file whose entries are `keys`, of which `tables` are tables. Throws a ValueError with file, entry, value and remedy."""
    try:
        given = tomllib.loads(file.read_text(encoding="utf-8"))
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise ValueError(f"{file}: {error}. Strings and names with blanks or slashes stand in quotes") from error
    for key in given:
        if key not in keys:
            raise fault(file, key, given[key], f"there is no such entry{nearest(key, keys)}")
    for key in tables:
        if not isinstance(given.get(key, {}), dict):
            raise fault(file, key, given[key], f"write a table, [{key}]")
    return given


def fault(file, entry, value, explanation, table=None):
    """A ValueError to throw."""
    place = f"[{table}], " if table else ""
    return ValueError(f'{file}: {place}entry "{entry}" = {text(value)}: {explanation}')


def nearest(name, names):
    """The end of a message: what the name could have meant."""
    close = difflib.get_close_matches(name, names, 1)
    return f'. Did you mean "{close[0]}"?' if close else f". Write one of: {', '.join(names)}"


def text(value):
    """A value as it stands in a case."""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, float):
        return f"{value:.12g}"
    if isinstance(value, dict):
        return "{" + ", ".join(f"{name} = {text(one)}" for name, one in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(map(text, value)) + "]"
    return str(value)


def is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool) and abs(value) < float("inf")

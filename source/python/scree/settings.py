# SPDX-License-Identifier: LGPL-2.1-or-later
"""Files in TOML that the user writes: how they are read, and how faults in them are told."""

import difflib
import tomllib

from scree import variants


def read(file, keys, tables):
    """The content of a file whose entries are `keys`, of which `tables` are tables. Throws a ValueError with file, entry, value and remedy."""
    try:
        given = tomllib.loads(file.read_text(encoding="utf-8"))
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise ValueError(f"{file}: {error}. Strings and names with blanks or slashes stand in quotes") from error
    check_keys(file, given, keys)
    for key in tables:
        if not isinstance(given.get(key, {}), dict):
            raise fault(file, key, given[key], f"write a table, [{key}]")
    return given


def check_keys(file, given, keys, table=None):
    if not isinstance(given, dict):
        raise ValueError(f"{file}: [{table}] = {text(given)}: write a table with the entries {', '.join(keys)}")
    for key in given:
        if key not in keys:
            raise fault(file, key, given[key], f"there is no such entry{nearest(key, keys)}", table)


def check_entries(file, base, tables, held, forbidden):
    """That a case with the entries `base` may have those of `tables`, {[table]: names}: no parameter among those `held`, none `forbidden`, {name: reason}."""
    for table, entries in tables.items():
        try:
            variants.check_entries(base, dict.fromkeys(entries, ""))
        except ValueError as error:
            raise ValueError(f"{file}: [{table}]: {error}") from error
        for entry in entries:
            if entry in forbidden:
                raise ValueError(f'{file}: [{table}], entry "{entry}"{forbidden[entry]}')
            if table == "parameters" and entry in held:
                raise ValueError(f'{file}: [{table}], entry "{entry}": it is in [set] as well. Remove one of them')


def fault(file, entry, value, explanation, table=None):
    """A ValueError to throw."""
    place = f"[{table}], " if table else ""
    return ValueError(f'{file}: {place}entry "{entry}" = {text(value)}: {explanation}')


def nearest(name, names):
    """The end of a message: what the name could have meant."""
    close = difflib.get_close_matches(name, names, 1)
    return f'. Did you mean "{close[0]}"?' if close else f". Write one of: {', '.join(names)}"


def path(file, key, value, table=None):
    """A file that is there; its path counts from that of the file which names it."""
    found = file.parent / str(value)
    if not found.is_file():
        raise fault(file, key, value, f"there is no file {found}. Its path counts from {file.name}", table)
    return found


def choice(file, given, key, choices, table=None):
    """One of the choices; the first without the entry."""
    value = given.get(key, choices[0])
    if value not in choices:
        raise fault(file, key, value, f"there is no such choice{nearest(str(value), choices)}", table)
    return value


def number(file, given, key, default, least=0., unit="", table=None):
    """A number above `least` or, with a unit, of at least it."""
    value = given.get(key, default)
    if not is_number(value) or value < least or (value == least and not unit):
        raise fault(file, key, value, f"write a number of at least {least:g}, in {unit}" if unit else f"write a number above {least:g}", table)
    return float(value)


def count(file, given, key, default, least=1):
    """A whole number."""
    value = given.get(key, default)
    if isinstance(value, bool) or not isinstance(value, int) or value < least:
        raise fault(file, key, value, f"write a whole number of at least {least}")
    return value


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

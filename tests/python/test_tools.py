# SPDX-License-Identifier: LGPL-2.1-or-later
"""What several tests of the package share."""

import csv
import re


def raises(text, function, *arguments, kind=ValueError):
    """The function must throw this kind of error with a message in which the regular expression `text` is found."""
    try:
        function(*arguments)
    except kind as error:
        assert re.search(text, str(error)), error
    else:
        raise AssertionError(f"{function.__name__}{arguments} throws nothing, and not {text}")


def rows_of(file):
    with open(file, encoding="utf-8") as table:
        return list(csv.DictReader(table))


def run_tests(module, chosen=()):
    """All functions test_... of a module's globals(), or those named."""
    for name, test in list(module.items()):
        if name.startswith("test_") and (not chosen or name in chosen):
            test()

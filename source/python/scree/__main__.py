# SPDX-License-Identifier: LGPL-2.1-or-later
"""python3 -m scree MODULE [arguments]: a command by its module, as the launchers start it."""

import importlib
import sys


def main():
    if len(sys.argv) < 2:
        sys.exit("scree: name a module with a command: python3 -m scree render --help")
    try:
        module = importlib.import_module("scree." + sys.argv.pop(1))
    except ModuleNotFoundError as missing:
        sys.exit(f"scree: {sys.executable} has no module {missing.name}. Install numpy, scipy, matplotlib and vtk for it; "
                 "in Debian: python3-numpy, python3-scipy, python3-matplotlib and python3-vtk9.")
    module.main()


if __name__ == "__main__":
    main()

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
        sys.exit(f"scree: {sys.executable} has no module {missing.name}. Install numpy, matplotlib and vtk for it, and scipy "
                 "for scree-scenarios and scree-element --fit, which need Python 3.11; in Debian: python3-numpy, python3-matplotlib, python3-vtk9 and python3-scipy.")
    module.main()


if __name__ == "__main__":
    main()

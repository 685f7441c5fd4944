# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the commands share: how they read arguments and tell errors, and where files and programs are."""

import argparse
import os
import pathlib
import re
import shutil
import subprocess
import sys

# The repository, or share/scree of an installation: the folder with cases and texts. Outside of both, the current folder.
ROOT = next((folder for folder in pathlib.Path(__file__).resolve().parents if (folder / "prm").is_dir() and (folder / "doc").is_dir()), pathlib.Path.cwd())


def program(name):
    """The path of scree or scree-element: beside the launcher, which tells its folder, or in build/, or on the PATH; else None."""
    beside = pathlib.Path(os.environ.get("SCREE_PROGRAMS", ROOT / "build"), name)
    return str(beside) if os.access(beside, os.X_OK) else shutil.which(name)


def needed(name):
    """The path of a program; a ValueError if it is not there."""
    if (found := program(name)) is None:
        raise ValueError(f"no program {name} is there. Build it (sh doc/quickstart.sh), or add its folder to PATH")
    return found


class Command(argparse.ArgumentParser):
    """The arguments of a command. Each error is one line on standard error, with exit code 1."""

    def __init__(self, name, text):
        super().__init__(prog=name, description=text, formatter_class=argparse.RawDescriptionHelpFormatter)
        # Lists of numbers may begin with a minus: --limits -5,15
        self._negative_number_matcher = re.compile(r"-[\d.][-\d.,eE+]*$")

    def error(self, message):
        self.exit(1, f"{self.prog}: {message}. {self.prog} --help lists the arguments.\n")

    def run(self, work):
        """Ends with what work(arguments) returns, 1 if it throws OSError, KeyError, ValueError or a program that it calls fails."""
        arguments = self.parse_args()
        try:
            code = work(arguments)
            sys.stdout.flush()
            sys.exit(code)
        except BrokenPipeError:  # of `| head`: nobody reads on
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        except (OSError, KeyError, ValueError, subprocess.CalledProcessError) as error:
            sys.exit(f"{self.prog}: {_text(error)}")


def aligned(head, rows, n_left=2):
    """Lines of a table of texts, whose first `n_left` columns begin at the left; the others end at the right."""
    widths = [max(map(len, cells)) for cells in zip(head, *rows)]
    return "\n".join("  ".join(f"{cell:{'<' if place < n_left else '>'}{widths[place]}}" for place, cell in enumerate(cells)).rstrip() for cells in [head, *rows])


def _text(error):
    if isinstance(error, OSError) and error.filename and error.strerror:
        return f"{error.filename}: {error.strerror}" + (". Is the path right?" if isinstance(error, FileNotFoundError) else "")
    return error.args[0] if isinstance(error, KeyError) else error

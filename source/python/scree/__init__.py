# SPDX-License-Identifier: LGPL-2.1-or-later
"""Scree's Python tools: results and pictures of runs, variants and scenarios of cases, closed forms, mountains, studies."""

import os

os.environ.setdefault("MPLBACKEND", "Agg")  # Pictures go to files: no display is needed.

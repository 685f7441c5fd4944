# SPDX-License-Identifier: LGPL-2.1-or-later
"""Studies: series of runs with a table, a chart and a verdict. How to write one: doc/developer/index.md."""

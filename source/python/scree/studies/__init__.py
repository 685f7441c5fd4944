# SPDX-License-Identifier: LGPL-2.1-or-later
"""Studies: series of runs with a table, a chart and a verdict. How to write one, with these words: doc/developer/index.md."""

from scree.command import ROOT
from scree.studies.charts import Curves, NoChart, Pictures, RunCurves, StabilityMap, WorkPrecision, tick_axis
from scree.studies.limits import HEIGHT, MASS, TIP, TRANSFERS, Limit, apart, depth, front_of_depth, halving_of, volume_below, whole_cells
from scree.studies.measures import BOUNDS, classify, energy_gain, lost_energy, mean_depth, mean_oscillation, roughness
from scree.studies.rows import Lookup, Rows, Span
from scree.studies.study import Run, Study, Variant, axis, compiled, prm_files, product, reference_rows, transfer
from scree.studies.words import filled, tabled

__all__ = ("BOUNDS", "Curves", "HEIGHT", "Limit", "Lookup", "MASS", "NoChart", "Pictures", "ROOT", "Rows", "Run", "RunCurves", "Span", "StabilityMap",
           "Study", "TIP", "TRANSFERS", "Variant", "WorkPrecision", "apart", "axis", "classify", "compiled", "depth", "energy_gain", "filled",
           "front_of_depth", "halving_of", "lost_energy", "mean_depth", "mean_oscillation", "prm_files", "product", "reference_rows", "roughness",
           "tabled", "tick_axis", "transfer", "volume_below", "whole_cells")

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Scenarios: many runs of a case with other values of its entries, and what follows from all of them.

sampling: distributions and designs. study: the file that describes a study. runs: cases, Snakemake, progress. evaluation: results of the runs, maps of
probability. charts: pictures. page: the report. command: scree-scenarios.
"""

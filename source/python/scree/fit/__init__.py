# SPDX-License-Identifier: LGPL-2.1-or-later
"""Entries of a law fitted to laboratory tests.

problem: the file that describes a fit. laboratory: tests, their quantities and units. runs: scree-element in parallel. solution: least squares, sigma,
correlations, flags. page: report, files and picture. command: scree-fit, which scree-element --fit starts.
"""

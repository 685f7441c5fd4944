# SPDX-License-Identifier: LGPL-2.1-or-later
"""The part of the box that a picture shows: what the material reaches in its panels, with a margin."""

import numpy as np


def fitted(box, pictures):
    """The box, cut to the points of all pictures (a list of Points) and a margin of 8 % of their extent or three cells."""
    bounds = [(points.positions.min(axis=0), points.positions.max(axis=0)) for points in pictures if len(points.positions)]
    if not bounds:
        return box
    lower = np.min([low for low, _ in bounds], axis=0)[:box.dim]
    upper = np.max([high for _, high in bounds], axis=0)[:box.dim]
    margin = np.maximum(0.08 * np.max(upper - lower), 3 * box.cell_size)
    lower, upper = np.maximum(box.lower, lower - margin), np.minimum(box.upper, upper + margin)
    # A little more than the material is no reason to cut: walls of the box that are close are shown.
    size = box.upper - box.lower
    lower = np.where(lower - box.lower < 0.12 * size, box.lower, lower)
    upper = np.where(box.upper - upper < 0.12 * size, box.upper, upper)
    return box._replace(lower=lower, upper=upper)

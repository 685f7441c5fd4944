# SPDX-License-Identifier: LGPL-2.1-or-later
"""Fields of points: name, unit and colours, and the range of the colour bar."""

from typing import NamedTuple

import matplotlib.colors
import matplotlib.pyplot as plt
import numpy as np


class Field(NamedTuple):
    """How a field is shown: its name in words, the unit, the factor from SI to that unit, its colour map, and whether it can be negative."""
    label: str
    unit: str
    factor: float
    colours: str = "viridis"
    signed: bool = True


# Fields whose zero is the state at rest or at the start have a map that begins light; plain blue is for water.
FIELDS = {
    "mean_effective_stress": Field("mean effective stress", "kPa", 1e-3),
    "deviatoric_stress": Field("deviatoric stress", "kPa", 1e-3, signed=False),
    "stress_ratio": Field("stress ratio", "", 1),
    "stress": Field("norm of the stress", "kPa", 1e-3, signed=False),
    "velocity": Field("speed", "m/s", 1, signed=False),
    "displacement": Field("displacement", "m", 1, "YlOrRd", False),
    "specific_volume": Field("specific volume", "", 1, signed=False),
    "state_parameter": Field("state parameter", "", 1, "RdBu_r"),
    "plastic_shear_strain": Field("plastic shear strain", "", 1, "YlOrRd", False),
    "image_pressure": Field("image pressure", "kPa", 1e-3, signed=False),
    "mass": Field("mass", "kg", 1, signed=False),
    "volume": Field("volume", "m$^3$", 1, signed=False),
    "porosity": Field("porosity", "", 1, signed=False),
    "pore_pressure": Field("pore pressure", "kPa", 1e-3, "YlGnBu"),
    "seepage_velocity": Field("seepage velocity", "m/s", 1, signed=False),
    "pressure": Field("pore pressure", "kPa", 1e-3, "YlGnBu"),
}


class Scale(NamedTuple):
    """Colours of a field in all panels of a picture: `extend` is that of matplotlib's colour bar."""
    name: str
    low: float
    high: float
    extend: str

    @property
    def mappable(self):
        return plt.cm.ScalarMappable(matplotlib.colors.Normalize(self.low, self.high), field_style(self.name).colours)


def field_style(name):
    return FIELDS.get(name, Field(name.replace("_", " "), "", 1))


def field_label(name):
    style = field_style(name)
    return f"{style.label} ({style.unit})" if style.unit else style.label


def field_values(points, name):
    """A field in its display unit, one number per point; of a vector or tensor the norm."""
    if len(points.positions) == 0:
        return np.zeros(0)
    if name not in points.arrays:
        raise KeyError(f"No field {name}; there are: {', '.join(sorted(points.arrays))}.")
    values = field_style(name).factor * points.arrays[name]
    return values if values.ndim == 1 else np.linalg.norm(values, axis=1)


def colour_limits(values, name):
    """From the first to the 99th percentile, since single points must not take the colours from all others."""
    style = field_style(name)
    values = values[np.isfinite(values)]
    if len(values) == 0:
        return 0., 1.
    low, high = np.percentile(values, [1, 99])
    if style.colours.startswith("RdBu"):
        high = max(abs(low), abs(high))
        low = -high
    elif not style.signed and low < 0.5 * high or -0.02 * high < low < 0.3 * high:
        low = 0.
    if not style.signed and high <= 0:
        # All points are at zero: a range around it would show values that cannot be.
        return 0., max(np.max(values), 0.) or 1.
    return (low, high) if high > low else (low - 0.5, high + 0.5)


def colour_scale(values, name, limits=None):
    """The scale for the values of all panels, in the unit that is shown."""
    low, high = limits or colour_limits(values, name)
    values = values[np.isfinite(values)]
    # Rounding, and pressure just beside a free surface, are no reason for an arrow.
    margin = 0.02 * (high - low)
    below = np.any(values < low - margin) and (field_style(name).signed or low > 0)
    above = np.any(values > high + margin)
    extend = {(False, False): "neither", (True, False): "min", (False, True): "max", (True, True): "both"}
    return Scale(name, low, high, extend[bool(below), bool(above)])

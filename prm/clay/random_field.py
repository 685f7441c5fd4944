# SPDX-License-Identifier: LGPL-2.1-or-later
"""Writes a random field of undrained strength for random_field.prm: lognormal, of mean 50 kPa, coefficient of variation
0.5 and scale of fluctuation THETA, m, by the covariance exp(-2 distance/THETA) of its logarithm.

Usage: python3 random_field.py SEED FILE [THETA]
"""

import sys

import numpy as np

MEAN, VARIATION, SPACING = 50e3, 0.5, 1.0  # Pa; -; m, of the places


def main():
    """Writes the lines x, y, s_u."""
    seed, file = int(sys.argv[1]), sys.argv[2]
    theta = float(sys.argv[3]) if len(sys.argv) > 3 else 5.0
    x, y = np.meshgrid(np.arange(0.5, 60, SPACING), np.arange(0.5, 20, SPACING), indexing="ij")
    places = np.column_stack([x.ravel(), y.ravel()])
    distance = np.linalg.norm(places[:, None] - places[None], axis=2)
    root = np.linalg.cholesky(np.exp(-2 * distance / theta) + 1e-10 * np.eye(len(places)))
    deviation = np.sqrt(np.log(1 + VARIATION**2))
    logarithm = np.log(MEAN) - deviation**2 / 2 + deviation * root @ np.random.default_rng(seed).standard_normal(len(places))
    np.savetxt(file, np.column_stack([places, np.exp(logarithm)]), fmt=["%.1f", "%.1f", "%.0f"], delimiter=",",
               header="x (m), y (m), undrained strength (Pa)")


if __name__ == "__main__":
    main()

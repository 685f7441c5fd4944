# SPDX-License-Identifier: LGPL-2.1-or-later
"""compare_statistics.py: are all rows of two tables `statistics.csv` equal?

Numbers differ by at most a tolerance times the largest number of their column. Columns that are differences of large numbers
have their scale: the energies and momenta that they balance, the largest p, 1 for errors, and for an oscillation over a mean the
condition number of the ratio, as the mean is a difference of what oscillates. How the pressure was solved (iterations,
preconditioners) is not compared, only the result. With a thickness the second table is of a run in 3D, one cell
thick: what is per metre in 2D is divided by it, its axis z is y there, and its points are only to be a multiple.
"""
import sys

import numpy as np

from scree.results import read_table

SOLVER = ("CG iterations per step", "Viscous iterations per step", "Preconditioners built")
COUNTS = ("Points", "Water points", "Separated points", "Fallbacks", "Vertices", "Unresolved", "Points lost")


def largest(table, *columns):
    """The largest number of those columns that are there."""
    return max(np.nanmax(np.abs(table[column]), initial=0) for column in columns if column in table)


def per_metre(table, thickness):
    """A run in 3D as one in 2D."""
    across = {column: table.pop(column) for column in ("Momentum y (N s)", "Bed impulse y (N s)") if column in table}
    if largest(across, *across) > 1e-9 * largest(table, "Mass (kg)", "Water mass (kg)"):
        sys.exit(f"there is motion across the slice: {largest(across, *across):g} N s")
    is_per_metre = {column: column.startswith("Deposit ") or column.endswith(("(kg)", "(N s)", "(J)")) for column in table}
    return {column.replace("Momentum z", "Momentum y").replace("Bed impulse z", "Bed impulse y"):
            values / thickness if is_per_metre[column] else values for column, values in table.items()}


def scales_of(table):
    """Of columns whose own size is not their scale."""
    energy = largest(table, *(column for column in table if "energy (J)" in column))
    scales = {"Volume error (-)": 1., "Momentum residual (N s)": largest(table, "Mass (kg)", "Water mass (kg)"),
              **{f"{part} dissipation (J)": energy for part in ("Numerical", "Wall", "Drag")}}
    if "Largest p (Pa)" in table:
        scales |= {"Smallest p (Pa)": np.max(table["Largest p (Pa)"]), "Water outside soil (kg)": np.max(table["Water mass (kg)"])}
    ratios = {column: np.max(table[column]) for column in ("Stress oscillation (-)", "p oscillation (-)") if column in table}
    return scales | {column: ratio * (1 + ratio) for column, ratio in ratios.items()}


def compare(files, tolerance, thickness=None):
    first, second = map(read_table, files)
    if not len(first["Step"]) == len(second["Step"]) > 0:
        sys.exit(f"numbers of rows: {len(first['Step'])} and {len(second['Step'])}")
    counts = ()
    if thickness:
        second = per_metre(second, thickness)
        counts = [column for column in COUNTS if column in first]
        points = "Points" if first["Points"][0] else "Water points"
        for column in counts:
            if np.any(second[points][0] / first[points][0] * first[column] != second[column]):
                sys.exit(column + ": not the same in every layer")
    if set(first) != set(second):
        sys.exit("different columns: " + ", ".join(sorted(set(first) ^ set(second))))
    scales, differences = scales_of(first), {}
    for column in set(first) - set(counts) - set(SOLVER):
        scale = scales.get(column) or max(largest(first, column), largest(second, column)) or 1.
        is_none = np.isnan(first[column]) & np.isnan(second[column])
        differences[column] = np.max(np.where(is_none, 0, np.abs(first[column] - second[column]))) / scale
    worst = max(differences, key=differences.get)
    print(f"{' and '.join(map(str, files))}: {len(first['Step'])} rows, largest difference {differences[worst]:.2g} in {worst}")
    if not np.max(list(differences.values())) <= tolerance:
        sys.exit(f"more than {tolerance:g}")

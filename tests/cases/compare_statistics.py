# SPDX-License-Identifier: LGPL-2.1-or-later
"""compare_statistics.py FILE FILE TOLERANCE... [THICKNESS]: are all rows of two files `statistics` equal, and of two others?

Numbers differ by at most TOLERANCE times the largest number of their column. Columns that are differences of large numbers
have their scale: the energies and momenta that they balance, the largest p, 1 for errors, and for an oscillation over a mean the
condition number of the ratio, as the mean is a difference of what oscillates. How the pressure was solved (iterations,
preconditioners) is not compared, only the result. With THICKNESS the second file is of a run in 3D, one cell
thick: what is per metre in 2D is divided by it, its axis z is y there, and its points are only to be a multiple.
"""
import sys

from scree.results import read_table

SOLVER = ("CG iterations per step", "Viscous iterations per step", "Preconditioners built")
COUNTS = ("Points", "Water points", "Separated points", "Fallbacks", "Vertices", "Unresolved", "Points lost")


def series(name):
    """Columns as lists."""
    table = {column: values.tolist() for column, values in read_table(name).items()}
    if not table.get("Step"):
        sys.exit(name + ": not a table of statistics")
    return table


def per_metre(table, thickness):
    """A run in 3D as one in 2D."""
    across = max(abs(value) for value in table.pop("Momentum y (N s)") + table.pop("Bed impulse y (N s)", []))
    if across > 1e-9 * max(table["Mass (kg)"] + table.get("Water mass (kg)", [])):
        sys.exit("there is motion across the slice: %g N s" % across)
    result = {}
    for column, values in table.items():
        column = column.replace("Momentum z", "Momentum y").replace("Bed impulse z", "Bed impulse y")
        if any(unit in column for unit in ("(kg)", "(N s)", "(J)")) or column.startswith("Deposit "):
            values = [value / thickness for value in values]
        result[column] = values
    return result


def largest_difference(first, second, counts):
    if set(first) != set(second):
        sys.exit("different columns: " + ", ".join(sorted(set(first) ^ set(second))))
    scales = {"Volume error (-)": 1.0}
    energy = max(abs(v) for column in first for v in first[column] if "energy (J)" in column)
    for column in ("Numerical dissipation (J)", "Wall dissipation (J)", "Drag dissipation (J)"):
        scales[column] = energy
    scales["Momentum residual (N s)"] = max(first["Mass (kg)"] + first.get("Water mass (kg)", []))
    if "Largest p (Pa)" in first:
        scales["Smallest p (Pa)"] = max(first["Largest p (Pa)"])
        scales["Water outside soil (kg)"] = max(first["Water mass (kg)"])
    for column in ("Stress oscillation (-)", "p oscillation (-)"):
        ratio = max(first.get(column, [0.0]))
        scales[column] = ratio * (1 + ratio)
    worst = (0.0, "")
    for column, values in first.items():
        if column in counts or column in SOLVER:
            continue
        others = second[column]
        if len(values) != len(others):
            sys.exit("different numbers of rows: %d and %d" % (len(values), len(others)))
        scale = scales.get(column) or max(abs(v) for v in values + others) or 1.0
        worst = max(worst, max((abs(a - b) / scale, column) for a, b in zip(values, others)))
    return worst


def compare(files, tolerance, thickness=None):
    first, second = map(series, files)
    counts = ()
    if thickness:
        second = per_metre(second, thickness)
        counts = [column for column in COUNTS if column in first]
        points = "Points" if first["Points"][0] else "Water points"
        ratio = second[points][0] / first[points][0]
        for column in counts:
            if [ratio * value for value in first[column]] != second[column]:
                sys.exit(column + ": not the same in every layer")
    difference, column = largest_difference(first, second, counts)
    print("%s and %s: %d rows, largest difference %.2g%s" % (*files, len(first["Step"]), difference, " in " + column if difference else ""))
    if not difference <= tolerance:
        sys.exit("more than %g" % tolerance)


def main():
    *comparisons, thickness = sys.argv[1:] if len(sys.argv) % 3 == 2 else (*sys.argv[1:], 0)
    for i in range(0, len(comparisons), 3):
        compare(comparisons[i:i + 2], float(comparisons[i + 2]), float(thickness))


if __name__ == "__main__":
    main()

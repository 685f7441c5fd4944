# SPDX-License-Identifier: LGPL-2.1-or-later
"""paths.py SCREE_ELEMENT: what the single point prints in the end of paths of several laws, each number to relative 1e-8 or absolute 1e-6."""
import math
import pathlib
import re
import subprocess
import sys

# Entries of each law, whose sets have names behind a semicolon, and the column that is another one for each path
LAWS = {
    "Nor-Sand": ({}, "Initial specific volume"),
    "Nor-Sand (Jefferies-Been)": ({"Critical stress ratio M": "1.1877", "Volumetric coupling N": "0.05", "State dilatancy": "4.3036",
                                   "Hardening modulus": "77.729", "Hardening slope": "632.97", "Substep strain": "2e-4"}, "Initial void ratio"),
    "Nor-Sand (Jefferies-Been); loose": ({"Critical stress ratio M": "1.17", "Volumetric coupling N": "0.066", "State dilatancy": "4.28",
                                          "Hardening modulus": "77", "Hardening slope": "688"}, "Initial void ratio"),
    "linear elastic": ({"Young's modulus": "1e6"}, "Poisson's ratio"),
    "Mohr-Coulomb": ({"Friction angle": "30"}, "Dilation angle"),
    "Mohr-Coulomb; softening": ({"Friction angle": "30", "Residual friction angle": "20", "Softening strain": "0.02"}, "Dilation angle")}

# What is printed; shear/vertical stress of simple shear only, and the state of laws that have one.
COMMON = ["strain [-]", "peak q/P [-]", "q/P [-]", "P [kPa]", "J [-]"]
STATE = {"Nor-Sand": ["specific_volume [-]", "state_parameter [-]"], "Nor-Sand (Jefferies-Been)": ["void_ratio [-]", "state_parameter [-]"]}
SHEAR = ["peak shear/vertical stress [-]", "shear/vertical stress [-]"]
COUNTS = ["sub-steps", "fallbacks", "vertices", "separated", "unresolved"]

# Path, confining pressure (Pa), K0, final strain, steps, value of the law's column | numbers of COMMON, STATE | SHEAR | COUNTS but the first,
# which is that of the steps.
CASES = """
Nor-Sand | drained triaxial, 100e3, 1, 0.5, -, 1.629 | 0.500000, 1.013771, 0.717538, 131.437025, 1.065230, 1.735259, -0.002547 |  | 0, 0, 0, 0
Nor-Sand | drained triaxial, 10e3, 1, 0.5, -, 1.629 | 0.500000, 1.087636, 0.718106, 13.146974, 1.081963, 1.762517, -0.002730 |  | 0, 0, 0, 0
Nor-Sand | drained triaxial, 50e3, 1, 0.5, -, 1.629 | 0.500000, 1.035972, 0.717631, 65.721191, 1.070282, 1.743490, -0.002577 |  | 0, 0, 0, 0
Nor-Sand | drained triaxial, 100e3, 1, 0.5, -, 1.736 | 0.500000, 0.731532, 0.710364, 131.025185, 1.001365, 1.738370, -0.000216 |  | 0, 0, 0, 0
Nor-Sand | drained triaxial, 10e3, 1, 0.5, -, 1.736 | 0.500000, 0.802461, 0.712055, 13.112201, 1.016854, 1.765259, -0.000765 |  | 0, 0, 0, 0
Nor-Sand | drained triaxial, 50e3, 1, 0.5, -, 1.736 | 0.500000, 0.752579, 0.710909, 65.528204, 1.006021, 1.746452, -0.000393 |  | 0, 0, 0, 0
Nor-Sand | isotropic compression, 10e3, 1, 0.005, -, 1.736 | 0.005000, 0.000000, 0.000000, 428.837015, 0.985112, 1.710154, -0.014400 |  | 2000, 2000, 0, 0
Nor-Sand | oedometer, 10e3, 0.683, 0.02, -, 1.736 | 0.020000, 0.401944, 0.019100, 1333.357242, 0.980199, 1.701625, -0.009377 |  | 0, 0, 0, 0
Nor-Sand | simple shear, 20e3, 1, 1, -, 1.629 | 1.000000, 1.058013, 0.714999, 20.028295, 1.079498, 1.758503, -0.001721 | 0.746024, 0.413387 | 0, 0, 0, 0
Nor-Sand | simple shear, 20e3, 1, 1, -, 1.736 | 1.000000, 0.783000, 0.710803, 19.990956, 1.014191, 1.760636, -0.000358 | 0.467331, 0.410196 | 0, 0, 0, 0
Nor-Sand | undrained triaxial, 100e3, 1, 0.2, -, 1.629 | 0.200000, 0.862490, 0.808389, 2381.184465, 1.000000, 1.629000, -0.074803 |  | 0, 0, 0, 0
Nor-Sand | undrained triaxial, 100e3, 1, 0.2, -, 1.736 | 0.200000, 0.722132, 0.711703, 141.040635, 1.000000, 1.736000, -0.001718 |  | 0, 0, 0, 0
Nor-Sand | undrained triaxial, 100e3, 1, 0.2, -, 1.76 | 0.200000, 0.707694, 0.707694, 25.444086, 1.000000, 1.760000, 0.001731 |  | 0, 0, 0, 0
Nor-Sand (Jefferies-Been) | drained triaxial, 129.827e3, -, 0.2232, 1500, 0.586924 | 0.223200, 1.684689, 1.305786, 229.888868, 1.074108, 0.704527, -0.028836 |  | 0, 0, 0, 0
Nor-Sand (Jefferies-Been) | drained triaxial, 500.403e3, -, 0.2232, 1500, 0.776 | 0.223200, 1.158827, 1.158827, 815.354756, 0.969218, 0.721331, 0.005416 |  | 0, 0, 0, 0
Nor-Sand (Jefferies-Been) | undrained triaxial, 500e3, -, 0.05, 1000, 0.8 | 0.050000, 1.187700, 1.187700, 2.905680, 1.000000, 0.800000, 0.000000 |  | 0, 0, 0, 0
Nor-Sand (Jefferies-Been); loose | undrained triaxial, 500e3, 1, 0.0027, 270, 0.8 | 0.002700, 0.865690, 0.865690, 249.538090, 1.000000, 0.800000, 0.066794 |  | 0, 0, 0, 0
Nor-Sand (Jefferies-Been); loose | undrained triaxial, 500e3, 1, 0.01, 1000, 0.8 | 0.010000, 0.993896, 0.993896, 38.301641, 1.000000, 0.800000, 0.038682 |  | 0, 0, 0, 0
Nor-Sand (Jefferies-Been); loose | undrained triaxial, 500e3, 1, 0.02, 2000, 0.8 | 0.020000, 1.155939, 1.155939, 3.581499, 1.000000, 0.800000, 0.003137 |  | 0, 0, 0, 0
Nor-Sand (Jefferies-Been); loose | undrained triaxial, 500e3, 1, 0.06, 6000, 0.8 | 0.060000, 1.170000, 1.170000, 2.905677, 1.000000, 0.800000, 0.000000 |  | 0, 0, 0, 0
linear elastic | oedometer, 10e3, -, 0.1, -, 0.25 | 0.100000, 1.043478, 1.043478, 84.729770, 0.904837 |  | 0, 0, 0, 0
Mohr-Coulomb | simple shear, 20e3, -, 0.2, -, 5 | 0.200000, 0.871115, 0.871115, 20.474855, 1.014283 | 0.513931, 0.513931 | 0, 0, 0, 0
Mohr-Coulomb; softening | drained triaxial, 50e3, 1, 0.4, -, 0 | 0.400000, 1.200000, 0.772060, 67.326779, 0.980932 |  | 0, 0, 0, 0
"""

# Independent programs of the equations, to 1 %: of the path, the confining pressure, the final strain and the specific volume or void ratio. Loose soil
# liquefies: q of 216 kPa at its peak falls to M p, p = exp((Gamma - e)/lambda). Friction that falls from 30 to 20 degrees: q/P = 6 sin/(3 - sin).
TARGETS = {
    ("drained triaxial", "50e3", "0.4", "0"): {"peak q/P [-]": 1.2, "q/P [-]": 6 * math.sin(math.radians(20)) / (3 - math.sin(math.radians(20)))},
    ("undrained triaxial", "500e3", "0.0027", "0.8"): {"q [kPa]": 216.0},
    ("undrained triaxial", "500e3", "0.01", "0.8"): {"q [kPa]": 38.1},
    ("undrained triaxial", "500e3", "0.02", "0.8"): {"q [kPa]": 4.14},
    ("undrained triaxial", "500e3", "0.06", "0.8"): {"P [kPa]": math.exp((0.816 - 0.8) / 0.015), "q/P [-]": 1.17},
    ("drained triaxial", "10e3", "0.5", "1.629"): {"peak q/P [-]": 1.089, "specific_volume [-]": 1.763},
    ("drained triaxial", "50e3", "0.5", "1.629"): {"peak q/P [-]": 1.037, "specific_volume [-]": 1.744},
    ("drained triaxial", "100e3", "0.5", "1.629"): {"peak q/P [-]": 1.014, "specific_volume [-]": 1.735},
    ("drained triaxial", "10e3", "0.5", "1.736"): {"peak q/P [-]": 0.803, "specific_volume [-]": 1.765},
    ("drained triaxial", "50e3", "0.5", "1.736"): {"peak q/P [-]": 0.753, "specific_volume [-]": 1.747},
    ("drained triaxial", "100e3", "0.5", "1.736"): {"peak q/P [-]": 0.732, "specific_volume [-]": 1.738},
    ("undrained triaxial", "100e3", "0.2", "1.629"): {"P [kPa]": 2381},
    ("undrained triaxial", "100e3", "0.2", "1.736"): {"P [kPa]": 141},
    ("undrained triaxial", "100e3", "0.2", "1.76"): {"P [kPa]": 25.4},
    ("simple shear", "20e3", "1", "1.629"): {SHEAR[0]: 0.747, SHEAR[1]: 0.413},
    ("simple shear", "20e3", "1", "1.736"): {SHEAR[0]: 0.468, SHEAR[1]: 0.410}}


def parameter_file(law, path, pressure, k0, strain, steps, value):
    """The text of a parameter file."""
    (entries, column), law = LAWS[law], law.partition(";")[0]
    common = {"Path": path, "Initial confining pressure": pressure, "K0": k0, "Final strain": strain, "Number of steps": steps,
              "Output directory": "results", "Material": law}
    inside = {**entries, column: value}
    section = law[0].upper() + law[1:]
    return "".join(f"set {name} = {text}\n" for name, text in common.items() if text != "-") + \
        f"subsection {section}\n" + "".join(f"  set {name} = {text}\n" for name, text in inside.items()) + "end\n"


def printed(program, text):
    """The first line, {name: number} of the others, all in their order."""
    pathlib.Path("path.prm").write_text(text, encoding="ascii")
    head, *lines, counts = subprocess.run([program, "path.prm"], check=True, capture_output=True, text=True).stdout.splitlines()
    rows = [line.rsplit(None, 1) for line in lines] + [word.rsplit(" ", 1) for word in counts.split(", ")]
    return head, {name: float(value) for name, value in rows}


def main():
    """Runs all paths."""
    faults, targets = [], dict(TARGETS)
    for line in CASES.strip().splitlines():
        law, entries, numbers, shear, counts = (re.split(r", ", part.strip()) for part in line.split("|"))
        (law,), (path, *_) = law, entries
        common, state = numbers[:5], numbers[5:]
        names = COMMON[:3] + (SHEAR if shear != [""] else []) + COMMON[3:] + STATE.get(law.partition(";")[0], []) + COUNTS
        values = common[:3] + (shear if shear != [""] else []) + common[3:] + state + [entries[4].replace("-", "2000"), *counts]
        head, found = printed(pathlib.Path(sys.argv[1]).resolve(), parameter_file(law, *entries))
        if head != f"{path}, {law.partition(';')[0]}" or list(found) != names or len(values) != len(names):
            faults.append(f"{line}\n  prints {head}: {', '.join(found)}")
            continue
        for name, value in zip(names, map(float, values)):
            if abs(found[name] - value) > max(1e-6 * 1.000001, 1e-8 * abs(value)):
                faults.append(f"{line}\n  {name} is {found[name]}, not {value}")
        found["q [kPa]"] = found["q/P [-]"] * found["P [kPa]"]
        for name, target in targets.pop((path, entries[1], entries[3], entries[5]), {}).items():
            if abs(found[name] / target - 1) > 0.01:
                faults.append(f"{line}\n  {name} is {found[name]}, and {target} of the independent implementation")
    faults += [f"There is no path {path}, which has targets." for path in targets]
    sys.exit("\n".join(faults) or 0)


if __name__ == "__main__":
    main()

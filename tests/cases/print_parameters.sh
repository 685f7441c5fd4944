#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# print_parameters.sh SCREE LAUNCHER: all entries, one subsection, those of a case, and the names of subsections.
set -e
scree=$1

"$scree" --print-parameters >all
grep -q '^subsection Mesh' all
"$scree" --print-parameters "Time step" >step
grep -q 'set Courant number' step
grep -c '^ *subsection ' step | grep -qx 1
"$scree" --print-parameters Soil/Initial\ state >nested
grep -q 'set K0 ' nested
if grep -q 'Courant number' nested; then exit 1; fi

"$scree" --print-parameters --sections >sections
for name in Mesh "Time step" Soil "Soil/Initial state" Water/Pressure; do
  grep -qx "$name" sections
done
# Each name is one that prints.
head -n 5 sections | while IFS= read -r name; do
  "$scree" --print-parameters "$name" | grep -q '^ *subsection '
done

cat >case.prm <<END
set Bodies   = Sand
set End time = 2
subsection Mesh
  set Upper corner = 1, 1
  set Cell size    = 0.125
end
subsection Sand
  set Region        = y < 0.5
  set Grain density = 2611
end
END
"$scree" case.prm --print-parameters Sand >sand
"$scree" --print-parameters Sand case.prm | cmp - sand
grep -q 'Grain density *= 2611' sand
# A subsection that the case does not have yet: the defaults, to be added.
"$scree" case.prm --print-parameters Water | grep -q 'Hydraulic conductivity *= auto'
"$scree" --print-parameters --sections case.prm | grep -qx "Sand/Initial state"
if "$scree" --print-parameters Sand 2>error; then exit 1; fi
cat error
grep -q 'no subsection "Sand"' error
if "$scree" --print-parameters "initial state" 2>error; then exit 1; fi
cat error
grep -q 'Did you mean "Soil/Initial state"' error

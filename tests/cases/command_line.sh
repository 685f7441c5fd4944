#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# command_line.sh SCREE LAUNCHER TEST SCREE_ELEMENT: what the programs print; each test is a function below.
set -e
source=$(dirname -- "$0")
scree=$1
launcher=$2 # several words
element=$4

# Both programs tell version, commit, libraries, compiler and build type, once on any number of ranks; -h is --help.
version()
{
  "$scree" --version >version
  cat version
  number='[0-9][0-9]*\.[0-9][0-9]*\.[0-9][0-9]*'
  grep -Eqx "Scree $number \(commit ([0-9a-f]{7,}(-dirty)?|unknown)\)" version
  grep -qx "deal.II $number, Trilinos $number, p4est $number, GDAL $number" version
  grep -Eqx "[A-Za-z]+ [0-9.]+, (Release|Debug)" version
  [ "$(wc -l <version)" -eq 3 ]

  # The commit that is checked out, although it may be younger than the build folder.
  commit=$(git -C "$source" rev-parse --short HEAD 2>/dev/null) || commit=
  prefix=$(git -C "$source/../.." rev-parse --show-prefix 2>/dev/null) || prefix=none
  [ -n "$prefix" ] || grep -q "(commit $commit" version

  $launcher 2 "$scree" --version | cmp - version
  "$element" --version | cmp - version

  for program in "$scree" "$element"; do
    "$program" --help >help
    "$program" -h | cmp - help
    grep -q "^Usage: $(basename "$program") " help
  done
}


# All entries, one subsection, those of a case, and the names of subsections.
print_parameters()
{
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
}


# The layout of the screen; log.txt has what it has, and details.
screen()
{
  cat >case.prm <<END
set End time         = 0.02
set Output directory = results
subsection Mesh
  set Upper corner = 2, 1
  set Cell size    = 0.125
end
subsection Soil
  set Region = x < 1 && y < 0.5
end
subsection Output
  set Statistics interval = 0.005
end
END
  for ranks in 1 2; do
    $launcher "$ranks" "$scree" case.prm >screen
    cat screen
    if [ "$ranks" -eq 1 ]; then named='1 rank'; else named='2 ranks'; fi
    sed -n 1p screen | grep -Eqx "Scree [0-9.]+ \((unknown|[0-9a-f]+(-dirty)?)\), $named +20[0-9][0-9]-[0-9-]+ [0-9:]+ \w+"
    sed -n 2p screen | grep -qx 'Case        case.prm -> results'
    sed -n 3p screen | grep -Eqx 'Model       2D plane strain, dry, AFLIP \(PIC rate auto: [0-9.]+ 1/s\), [1-9][0-9]* soil points'
    sed -n 4p screen | grep -qx 'Mesh        128 cells of 0.125 m'
    sed -n 5p screen | grep -Eqx 'Memory      [1-9][0-9]* MB estimated'
    grep -Eqx ' +time \(s\) +done +step +dt \(s\) +front 90 % \(m\) +kinetic \(J\) +remaining' screen
    grep -Eqx ' +0\.020000 +100 % +[0-9]+ +[0-9.]+e-0[0-9] +0\.[0-9]+ +[0-9.e-]+ +0 s' screen
    # Numbers end below the ends of their headings.
    [ "$(awk '/ time \(s\) / || / 100 % .* 0 s$/ { print length($0) }' screen | sort -u | wc -l)" -eq 1 ]
    grep -Eqx 'Finished    wall time [0-9.]+ s, [1-9][0-9]* steps, [0-9]+ ns per point and step and core' screen
    grep -Eqx 'Limits      time step limited by wave speed \(100 % of steps\)' screen
    grep -Eq '^Checks      within bounds: mass balance [0-9.e-]+; momentum balance [0-9.e-]+;' screen
    grep -q 'points of soil lost 0' screen
    grep -qx 'Results     results/solution/points.pvd (ParaView), statistics, log.txt' screen
    if grep -Eq 'deal.II|points to grid|Soil at' screen; then exit 1; fi
    [ "$(awk '{ if (length($0) > n) n = length($0) } END { print n }' screen)" -le 100 ]
    # The screen is an excerpt of the log.
    diff results/log.txt screen >differences || true
    if grep -q '^>' differences; then exit 1; fi
    for detail in 'Libraries   deal.II' 'Compiler ' 'points to grid' 'Soil at the end' 'Largest memory'; do
      grep -q "^< $detail" differences
    done
  done

  # Soil that falls out of the box exceeds a bound.
  sed 's/set Region.*/set Region = x > 1 \&\& y < 0.5/; /^subsection Output/i subsection Boundaries\n  set Right = open\nend' case.prm |
    sed 's/^set End time.*/set End time = 0.5/' >leaves.prm
  "$scree" leaves.prm >screen
  cat screen
  grep -Eq '^Checks      out of bounds:.*points of soil lost [1-9][0-9]* \(bound 0\)' screen
  grep -q '^            within bounds: mass balance' screen
}

"$3"

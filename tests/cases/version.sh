#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# version.sh SCREE LAUNCHER SCREE_ELEMENT: both programs tell version, commit, libraries, compiler and build type, once on any number
# of ranks; -h is --help.
set -e
source=$(dirname -- "$0")
scree=$1
launcher=$2 # several words
element=$3

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

#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# follows_points.sh SCREE LAUNCHER CASE TOLERANCE: fine cells that follow the points change nothing but time and memory: two and three
# ranks agree with one to the TOLERANCE; a box of twice the height and width takes no more fine cells.
set -e
cases=$(dirname -- "$0")
scree=$1
launcher=$2 # several words
case=$SHORT_CASES/$3.prm

# run NAME RANKS CASE: in a folder of that name
run()
{
  rm -rf "$1"
  mkdir "$1"
  (cd "$1" && $launcher "$2" "$scree" "$3" >screen)
}

compare()
{
  echo "$1 and $2:"
  "$PYTHON" "$cases/compare_statistics.py" "$1"/results/statistics "$2"/results/statistics "$3"
}

run around 1 "$case"
grep -q 'followed the points [1-9] times' around/results/log.txt

for ranks in 2 3; do
  run $ranks $ranks "$case"
  compare around $ranks "$4"
done

"$PYTHON" - "$case" <<END
import sys
from scree.variants import read_entries, write_variant
corner = [2 * float(x) for x in read_entries(sys.argv[1])["Mesh/Upper corner"].split(",")]
write_variant(sys.argv[1], "wide.prm", {"End time": 0.002, "Mesh/Upper corner": ", ".join(map(str, corner))})
END
run wide 1 "$PWD/wide.prm"
for size in around wide; do
  sed -n 's/^Mesh  *\([0-9e+.]*\) cells of .* m around the points.*/\1/p' $size/results/log.txt >$size/cells
done
echo "fine cells: $(cat around/cells), in a wide box $(cat wide/cells)"
test -s wide/cells
cmp around/cells wide/cells

#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# restart.sh SCREE LAUNCHER CASE SAME OTHER [RANKS]: after some hundred steps, all statistics of one rank and of two (or RANKS, such as "2 3")
# agree to OTHER. A run that goes on from its checkpoint ends as if it had not stopped, to SAME on as many ranks (points keep their order), and
# to OTHER on more or fewer (sums have another order). OTHER is far above rounding, which grows with the steps, and far below anything that a
# lost point or node would do. The newest checkpoint of the cases is at 0.09 s; the end is no checkpoint. Without SAME ("none") nothing goes on.
set -e
cases=$(dirname -- "$0")
scree=$1
launcher=$2 # several words
case=$cases/$3.prm

# compare WHAT FOLDER FOLDER TOLERANCE
compare()
{
  echo "$1:"
  "$PYTHON" "$cases/compare_statistics.py" "$2"/results/statistics "$3"/results/statistics "$4"
}

# go_on RANKS RANKS_AFTER TOLERANCE
go_on()
{
  folder=${1}_to_$2
  rm -rf "$folder"
  cp -r "$1" "$folder"
  (cd "$folder" && $launcher "$2" "$scree" "$case" --resume >screen)
  grep -q Resumed "$folder/results/log.txt"
  compare "$1 to $2 ranks" "$1" "$folder" "$3"
}

for ranks in 1 ${6:-2}; do
  rm -rf "$ranks"
  mkdir "$ranks"
  (cd "$ranks" && $launcher "$ranks" "$scree" "$case" >screen)
  [ "$ranks" -eq 1 ] || compare "1 and $ranks ranks" 1 "$ranks" "$5"
done
[ "$4" != none ] || exit 0
go_on 1 1 "$4"
go_on 2 1 "$5"
go_on 1 2 "$5"

#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# restart.sh SCREE LAUNCHER CASE SAME OTHER [RANKS]: after some hundred steps, all statistics of one rank and of two (or RANKS) agree to OTHER. A
# run that goes on from its checkpoint ends as if it had not stopped, to SAME on as many ranks (points keep their order), and to OTHER on more or
# fewer (sums have another order). OTHER is far above rounding, which grows with the steps, and far below anything that a lost point or node would
# do. The newest checkpoint of the cases is at 0.09 s; the end is no checkpoint. Without SAME ("none") nothing goes on. Three ranks are not run
# beside two: one of them has two neighbours, and the run that goes on on two ranks is compared, too.
set -e
cases=$(dirname -- "$0")
scree=$1
launcher=$2 # several words
case=$SHORT_CASES/$3.prm
ranks=${6:-2}

# go_on RANKS RANKS_AFTER COMMAND...
go_on()
{
  folder=${1}_to_$2
  rm -rf "$folder"
  cp -r "$1" "$folder"
  shift 2
  (cd "$folder" && "$@" "$case" --resume >screen)
  grep -q Resumed "$folder/results/log.txt"
}

rm -rf 1 "$ranks"
mkdir 1 "$ranks"
(cd 1 && "$scree" "$case" >screen)
# shellcheck disable=SC2086 # The launcher is several words.
(cd "$ranks" && $launcher "$ranks" "$scree" "$case" >screen)
table=results/statistics
if [ "$4" = none ]; then
  "$PYTHON" "$cases/compare_statistics.py" 1/$table "$ranks/$table" "$5"
  exit 0
fi
go_on 1 1 "$scree" &
go_on "$ranks" 1 "$scree"
wait $!
# shellcheck disable=SC2086
go_on 1 2 $launcher 2 "$scree"
"$PYTHON" "$cases/compare_statistics.py" 1/$table "$ranks/$table" "$5" 1/$table 1_to_1/$table "$4" \
  "$ranks/$table" "${ranks}_to_1/$table" "$5" 1/$table 1_to_2/$table "$5"

#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# restart.sh SCREE LAUNCHER CASE SAME OTHER: a run that goes on from its checkpoint ends as if it had not stopped, to the tolerance
# SAME on as many ranks (points keep their order), and to OTHER on more or fewer (sums have another order).
# The newest checkpoint of the cases is at 0.09 s; the end is no checkpoint.
set -e
cases=$(dirname -- "$0")
scree=$1
launcher=$2 # several words
case=$cases/$3.prm

# stop_and_go RANKS RANKS_AFTER TOLERANCE
stop_and_go()
{
  folder=${1}_to_$2
  rm -rf "$folder"
  mkdir "$folder"
  cd "$folder"
  $launcher "$1" "$scree" "$case" >screen
  cp results/statistics whole
  $launcher "$2" "$scree" "$case" --resume >screen
  grep -q Resumed results/log.txt
  echo "$1 to $2 ranks:"
  "$PYTHON" "$cases/compare_statistics.py" whole results/statistics "$3"
  cd ..
}

stop_and_go 1 1 "$4"
stop_and_go 2 1 "$5"
stop_and_go 1 2 "$5"

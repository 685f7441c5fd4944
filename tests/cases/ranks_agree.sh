#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# ranks_agree.sh SCREE LAUNCHER CASE TOLERANCE: after more than 200 steps of the column, all statistics of one and of two ranks
# agree. The tolerance is far above rounding, which grows with the steps, and far below anything that a lost point or node would do.
set -e
cases=$(dirname -- "$0")
scree=$1
launcher=$2 # several words
for ranks in 1 2; do
  mkdir -p $ranks
  (cd $ranks && $launcher $ranks "$scree" "$cases/$3.prm" >screen)
done
/usr/bin/python3 "$cases/compare_statistics.py" 1/results/statistics 2/results/statistics "$4"

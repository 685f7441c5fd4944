#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# ranks_agree.sh SCREE LAUNCHER CASE TOLERANCE [RANKS]: after some hundred steps, all statistics of one and of two ranks (or RANKS, such as
# "2 3") agree. The tolerance is far above rounding, which grows with the steps, and far below anything that a lost point or node would do.
set -e
cases=$(dirname -- "$0")
scree=$1
launcher=$2 # several words
for ranks in 1 ${5:-2}; do
  mkdir -p "$ranks"
  (cd "$ranks" && $launcher "$ranks" "$scree" "$cases/$3.prm" >screen)
done
for ranks in ${5:-2}; do
  "$PYTHON" "$cases/compare_statistics.py" 1/results/statistics "$ranks"/results/statistics "$4"
done

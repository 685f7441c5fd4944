#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# thin_3d_is_2d.sh SCREE LAUNCHER CASE TOLERANCE: a slice of the column in 3D, one cell thick between smooth walls (CASE_3d.prm), is
# the plane strain run (CASE_2d.prm) at the end, per metre of thickness. In the plane the points are the same; cell averages are, too.
set -e
cases=$(dirname -- "$0")
scree=$1
launcher=$2 # several words
for dimension in 2 3; do
  mkdir -p $dimension
  (cd $dimension && $launcher $((dimension - 1)) "$scree" "$SHORT_CASES/$3_${dimension}d.prm" >screen)
done
"$PYTHON" "$cases/compare_statistics.py" 2/results/statistics 3/results/statistics "$4" 0.1

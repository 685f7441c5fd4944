#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# thin_3d_is_2d.sh SCREE LAUNCHER: a slice of the column in 3D, one cell thick between smooth walls, is the plane strain run after
# 100 steps: per metre of thickness, the statistics agree to 1e-9. In the plane the points are the same; cell averages are, too.
set -e
cases=$(dirname -- "$0")
scree=$1
launcher=$2 # several words
for dimension in 2 3; do
  mkdir -p $dimension
  (cd $dimension && $launcher $((dimension - 1)) "$scree" "$cases/slice_${dimension}d.prm" >screen)
done
/usr/bin/python3 "$cases/compare_statistics.py" 2/results/statistics 3/results/statistics 1e-9 0.1

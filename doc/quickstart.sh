#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# sh doc/quickstart.sh: from a fresh Debian 12 to the first pictures.

# shellcheck source=doc/setup.sh
. "$(dirname -- "$0")/setup.sh"
cd "$root" || exit 1

mpirun -np 2 build/scree prm/quickstart.prm || exit 1
build/scree-render results/quickstart || exit 1

echo
echo "Pictures:     $root/results/quickstart/points.png"
echo "              $root/results/quickstart/statistics.png"
echo "For ParaView: $root/results/quickstart/solution/points.pvd"

#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# sh doc/quickstart.sh: from a fresh Debian 12 or 13 to the first pictures.

# shellcheck source=doc/setup.sh
. "$(dirname -- "$0")/setup.sh"
cd "$root" || exit 1

mpirun -np 2 build/scree prm/quickstart.prm || exit 1
build/scree-render results/quickstart --field plastic_shear_strain || exit 1

echo
echo "Pictures:     $root/results/quickstart/points_plastic_shear_strain.png"
echo "              $root/results/quickstart/statistics.png"
echo "For ParaView: $root/results/quickstart/solution/points.pvd"

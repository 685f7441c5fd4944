# SPDX-License-Identifier: LGPL-2.1-or-later
# shellcheck shell=sh
# Sourced: what Open MPI needs to start any number of ranks on any one machine, also as root, on one core, without a network and in a
# container that forbids reading another process's memory.

# Scree's ranks have one thread each.
export OMP_NUM_THREADS=1 DEAL_II_NUM_THREADS=1

if [ "$(id -u)" -eq 0 ]; then
  export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
fi
# More ranks than cores, and unbound, because runs that start side by side would all be bound to the first cores.
export OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_MCA_hwloc_base_binding_policy=none
# The same from Open MPI 5 on.
export PRTE_MCA_rmaps_default_mapping_policy=:oversubscribe PRTE_MCA_hwloc_default_binding_policy=none
export OMPI_MCA_btl=self,vader OMPI_MCA_btl_vader_single_copy_mechanism=none
# No search for networks and, without mpirun, no daemon: runs begin in half the time.
export OMPI_MCA_pml=ob1 OMPI_MCA_ess_singleton_isolated=1

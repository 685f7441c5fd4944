// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_deal_ii_versions_h
#define scree_deal_ii_versions_h

#include <deal.II/base/config.h>

#include <mpi.h>

namespace scree
{
  /// Communicator of a triangulation: the one name that differs between the versions of deal.II.
  template <typename Triangulation>
  MPI_Comm communicator_of(const Triangulation &mesh)
  {
#if DEAL_II_VERSION_GTE(9, 7, 0)
    return mesh.get_mpi_communicator();
#else
    return mesh.get_communicator();
#endif
  }
} // namespace scree

#endif

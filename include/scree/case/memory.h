// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_case_memory_h
#define scree_case_memory_h

#include <scree/case/parameters.h>

namespace scree
{
  /// What a case will take of memory, from its entries alone.
  struct MemoryEstimate
  {
    double n_cells        = 0; ///< fine ones, at the start
    double n_soil_points  = 0, ///< at the start, of all bodies
        n_water_points    = 0; ///< at the start; 0 if the soil's points carry the water
    double bytes_of_cells = 0, ///< of all ranks
        bytes_of_points   = 0; ///< of all ranks
    double bytes_of_rank  = 0; ///< of each rank beside its share of the cells

    /// Of so many ranks that share the case.
    double bytes(const unsigned int n_ranks) const
    {
      return bytes_of_cells + bytes_of_points + n_ranks * bytes_of_rank;
    }
  };

  /// Numbers of cells and points of a case; regions are sampled. Throws ValueError if one is no number at a sample.
  template <int dim>
  MemoryEstimate estimate_memory(const Parameters &parameters);

  /// The estimate; throws EntryError, with it, if the hosts of the ranks have not enough memory for the case.
  /// Collective.
  template <int dim>
  MemoryEstimate require_memory(const Parameters &parameters, const MPI_Comm communicator);
} // namespace scree

#endif

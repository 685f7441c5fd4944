// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_particles_batch_pointers_h
#define scree_particles_batch_pointers_h

#include <scree/particles/point_set.h>
#include <scree/simd/records.h>

#include <cmath>
#include <limits>

namespace scree
{
  /// Where the records of a batch of a cell's points lie.
  template <int dim>
  struct BatchPointers
  {
    RecordPointers<double> properties,   ///< properties of each point
        locations;                       ///< location of each point, m
    RecordPointers<const double> places; ///< in the cell, from 0 to 1

    /// @param indices of points in the cell
    BatchPointers(const CellPoints<dim> &cell, const BatchIndices &indices)
    {
      for (unsigned int l = 0; l < batch_size; ++l)
        {
          properties[l] = apart(cell.properties_of(indices[l]));
          locations[l]  = apart(&cell.location_of(indices[l])[0]);
          places[l]     = apart(&cell.reference_location_of(indices[l])[0]);
        }
    }

    /// Properties from a slot on.
    RecordPointers<double> slots_at(const unsigned int slot) const
    {
      RecordPointers<double> slots = properties;
      for (double *&pointer : slots)
        pointer = apart(pointer + slot);
      return slots;
    }
  };


  /// The largest of squares of speeds, m^2/s^2, lane by lane; not a number if any was not.
  struct LargestSquare
  {
    Batch of_lanes = simd::broadcast<Batch>(0.); ///< largest square so far

    /// Takes in the first `n` of a batch.
    void include(const Batch &squares, const unsigned int n)
    {
      const simd::Mask<Batch> is_larger = simd::first_lanes(n) & !(squares <= of_lanes) & (of_lanes == of_lanes);
      of_lanes                          = simd::select<Batch>(is_larger, squares, of_lanes);
    }

    /// Largest speed, m/s.
    double speed() const
    {
      double largest = 0;
      for (unsigned int l = 0; l < batch_size; ++l)
        if (!(of_lanes[l] <= largest))
          largest = of_lanes[l];
      return simd::any(of_lanes != of_lanes) ? std::numeric_limits<double>::quiet_NaN() : std::sqrt(largest);
    }
  };
} // namespace scree

#endif

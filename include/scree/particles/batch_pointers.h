// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_particles_batch_pointers_h
#define scree_particles_batch_pointers_h

#include <scree/particles/point_set.h>
#include <scree/simd/records.h>

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


  /// The largest of squares of speeds, m^2/s^2; not a number if any was not.
  struct LargestSquare
  {
    double value = 0; ///< largest square so far, m^2/s^2

    /// Takes in the square of a speed, m^2/s^2.
    void include(const double square)
    {
      if (value == value && !(square <= value))
        value = square;
    }

    /// The first `n` of a batch.
    void include(const Batch &squares, const unsigned int n)
    {
      if (simd::any(!(squares <= value)))
        for (unsigned int l = 0; l < n; ++l)
          include(squares[l]);
    }
  };
} // namespace scree

#endif

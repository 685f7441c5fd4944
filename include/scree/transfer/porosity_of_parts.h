// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_transfer_porosity_of_parts_h
#define scree_transfer_porosity_of_parts_h

#include <deal.II/base/point.h>

#include <algorithm>
#include <array>

namespace scree
{
  /// The porosity about points of water: of the soil in the part of their cell that holds them. A cell is cut in half
  /// along each axis: a face of soil shows within half a cell, and the soil's points may lie anyhow.
  template <int dim>
  class PorosityOfParts
  {
  public:
    /// Adds a point of soil.
    ///
    /// @param x its place in the cell
    /// @param grains volume of its grains, m^3
    /// @param volume with pores, m^3
    void add_soil(const dealii::Point<dim> &x, const double grains, const double volume)
    {
      Part &part = parts[part_of(x)];
      part.grains += grains;
      part.volume += volume;
    }

    /// Finds the porosities, when all soil is in. Soil that does not fill its part shares it with free water.
    ///
    /// @param volume of water and wet grains in the cell, at most that of the cell, m^3
    void find(const double volume)
    {
      for (Part &part : parts)
        part.inverse_porosity =
            1. / std::max(smallest, 1. - part.grains / std::max({ part.volume, volume / n_parts, tiny }));
    }

    /// 1 over the porosity about a place of the cell, -; 1 without soil.
    double inverse_at(const dealii::Point<dim> &x) const
    {
      return parts[part_of(x)].inverse_porosity;
    }

  private:
    struct Part
    {
      double grains = 0, volume = 0; // m^3
      double inverse_porosity = 1;
    };

    static unsigned int part_of(const dealii::Point<dim> &x)
    {
      unsigned int part = 0;
      for (unsigned int a = 0; a < dim; ++a)
        part |= (x[a] > 0.5) << a;
      return part;
    }

    static constexpr unsigned int n_parts = 1 << dim;
    static constexpr double smallest      = 0.1;   // where grains crowd water shall not race
    static constexpr double tiny          = 1e-99; // m^3

    std::array<Part, n_parts> parts;
  };
} // namespace scree

#endif

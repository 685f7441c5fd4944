// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_mixture_porosity_of_parts_h
#define scree_mixture_porosity_of_parts_h

#include <scree/mixture/closures.h>
#include <scree/simd/batch.h>

#include <deal.II/base/point.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <array>
#include <utility>

namespace scree
{
  /// The porosity about points of water: of the soil in the part of their cell that holds them. The parts are those
  /// that a point of soil has at the start, but for no finer than a quarter (3D: half) of a cell along each axis.
  template <int dim>
  class PorosityOfParts
  {
  public:
    /// @param soil_points in a cell along each axis, at the start
    explicit PorosityOfParts(const unsigned int soil_points)
        : n_1d(std::min(soil_points, most_1d))
    {
    }

    /// Adds a point of soil.
    ///
    /// @param x its place in the cell
    /// @param grains volume of its grains, m^3
    /// @param volume with pores, m^3
    /// @param resistance of its pores to slow flow, times volume, N s/m
    /// @param inertial the same over the discharge, N s^2/m^2
    void add_soil(const dealii::Point<dim> &x,
                  const double grains,
                  const double volume,
                  const double resistance,
                  const double inertial)
    {
      Part &part = parts[part_of(x)];
      part.grains += grains;
      part.volume += volume;
      part.resistance += resistance;
      part.inertial += inertial;
    }

    /// Finds porosities and resistances, when all soil is in. Soil that does not fill its part shares it with free
    /// water, but for parts inside the soil: these hold more or fewer of its points by chance, and have its porosity,
    /// or that of the cell where there is none.
    ///
    /// @param volume of the cell that is open, m^3
    /// @param depths signed distances of the vertices from the surface of the soil, positive inside
    void find(const double volume, const std::array<double, (1 << dim)> &depths)
    {
      Part cell;
      for (unsigned int p = 0; p < dealii::Utilities::fixed_power<dim>(n_1d); ++p)
        {
          cell.grains += parts[p].grains;
          cell.volume += parts[p].volume;
          cell.resistance += parts[p].resistance;
          cell.inertial += parts[p].inertial;
        }
      // Less than `whole` is no scatter of points: to take it for that lends water at a face the grains of its
      // neighbourhood, and consolidating mud blows up.
      const double whole = volume / dealii::Utilities::fixed_power<dim>(n_1d);
      for (unsigned int p = 0; p < dealii::Utilities::fixed_power<dim>(n_1d); ++p)
        {
          Part &part           = parts[p];
          const bool is_inside = depth_of(p, depths) > 0.;
          if (is_inside && part.volume <= 0.)
            part = cell;
          if (part.volume > 0.)
            {
              const double of_part  = is_inside ? part.volume : std::max(part.volume, whole);
              part.inverse_porosity = 1. / std::max(closures::least_porosity, 1. - part.grains / of_part);
              part.resistance /= of_part;
              part.inertial /= of_part;
            }
        }
    }

    /// The pores about a point of water.
    struct Pores
    {
      double inverse_porosity; ///< -
      double resistance;       ///< pressure gradient of slow flow over the discharge, N s/m^4
      double inertial;         ///< what that grows by with the discharge, N s^2/m^5
    };

    /// Pores about a place of the cell, after find().
    Pores at(const dealii::Point<dim> &x) const
    {
      const Part &part = parts[part_of(x)];
      return { part.inverse_porosity, part.resistance, part.inertial };
    }

    /// 1 over the porosity about a place of the cell, -; 1 without soil.
    double inverse_at(const dealii::Point<dim> &x) const
    {
      return parts[part_of(x)].inverse_porosity;
    }

    /// The same about a batch of places.
    Batch inverse_at(const std::array<Batch, dim> &x) const
    {
      using Integers   = int __attribute__((vector_size(batch_size * sizeof(int))));
      const Batch zero = simd::broadcast<Batch>(0.), last = simd::broadcast<Batch>(n_1d - 1.);
      Integers part{};
      for (unsigned int a = 0; a < dim; ++a)
        part = part * static_cast<int>(n_1d) +
               __builtin_convertvector(simd::min<Batch>(simd::max<Batch>(x[a] * double(n_1d), zero), last), Integers);
      return inverse_of(part, std::make_index_sequence<batch_size>());
    }

  private:
    struct Part
    {
      double grains = 0, volume = 0;       // m^3
      double resistance = 0, inertial = 0; // see Pores; times volume until find()
      double inverse_porosity = 1;
    };

    /// A function that is linear along each axis, at the centre of a part.
    double depth_of(const unsigned int part, std::array<double, (1 << dim)> depths) const
    {
      unsigned int rest = part, strides[dim]; // the last axis is the fastest
      for (unsigned int a = dim; a-- > 0; rest /= n_1d)
        strides[a] = rest % n_1d;
      for (unsigned int a = dim; a-- > 0;)
        {
          const double x = (strides[a] + 0.5) / n_1d;
          for (unsigned int v = 0; v < (1u << a); ++v)
            depths[v] += x * (depths[v | 1u << a] - depths[v]);
        }
      return depths[0];
    }

    /// In registers: numbers that are stored one by one and read as a vector wait for each other.
    template <typename Integers, std::size_t... lane>
    Batch inverse_of(const Integers &part, std::index_sequence<lane...>) const
    {
      return Batch{ parts[part[lane]].inverse_porosity... };
    }

    unsigned int part_of(const dealii::Point<dim> &x) const
    {
      unsigned int part = 0;
      for (unsigned int a = 0; a < dim; ++a)
        part = part * n_1d + std::min(n_1d - 1, static_cast<unsigned int>(std::max(0., x[a] * n_1d)));
      return part;
    }

    static constexpr unsigned int most_1d = dim == 2 ? 4 : 2;

    unsigned int n_1d; // parts along an axis
    std::array<Part, dealii::Utilities::pow(most_1d, dim)> parts;
  };
} // namespace scree

#endif

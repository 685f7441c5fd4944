// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_mixture_mixture_h
#define scree_mixture_mixture_h

#include <scree/mesh/cut_cells.h>
#include <scree/mixture/porosity_of_parts.h>

#include <array>
#include <functional>
#include <vector>

namespace scree
{
  /// What the points of a cell weigh and fill (2D: per m).
  template <int dim>
  struct MixtureCell
  {
    static constexpr unsigned int n_vertices = 1 << dim; ///< vertices of a cell
    using AtVertices = std::array<double, n_vertices>;   ///< a number a vertex, in deal.II's order

    unsigned int cell;           ///< active cell index
    double volume;               ///< of the cell, without what rigid ground fills, m^3
    double soil_mass    = 0,     ///< kg
        water_mass      = 0;     ///< kg
    double grain_volume = 0,     ///< m^3
        water_volume    = 0;     ///< m^3
    double pore_volume  = 0;     ///< of the soil, m^3
    bool is_rigid       = false; ///< whether the soil is held at its place

    // Sums weighted with the linear functions of the vertices.
    AtVertices grains_at_vertex{},   ///< volume of grains, m^3
        water_at_vertex{};           ///< volume of water, m^3
    AtVertices pressure_at_vertex{}; ///< volume of water times pressure there, Pa m^3
    AtVertices soil_depths{};        ///< signed distances from the surface of the soil, cells; positive inside
    AtVertices bulk_at_vertex{};     ///< volume of water and the grains about it, sum V/n_p, m^3

    double bulk_volume  = 0, ///< sum V/n_p, m^3
        mass_of_flux    = 0, ///< sum m/n_p, kg
        inertia_of_flux = 0; ///< sum m/n_p^2, kg
    double drag_of_flux = 0; ///< sum V/n_p times the resistance of the pores, N s/m

    double mobility = 0; ///< kappa: what a pressure gradient does to the mixture's flow, m^3/kg

    /// @param cell active cell index
    /// @param volume open to soil and water, m^3
    MixtureCell(const unsigned int cell, const double volume)
        : cell(cell)
        , volume(volume)
    {
    }
  };

  /// The pressure at a cell's vertices, Pa, in deal.II's order.
  template <int dim>
  using PressureOfCell = std::function<std::array<double, (1 << dim)>(const unsigned int cell)>;

  /// A pressure that is linear along each axis of a cell: coefficients of the monomials of the cell's coordinates from
  /// 0 to 1; bit a of the index stands for a factor x_a.
  template <int dim>
  using Multilinear = std::array<double, (1 << dim)>;

  /// The multilinear function with the given values at the vertices (deal.II's order).
  template <int dim>
  inline Multilinear<dim> multilinear_of(std::array<double, (1 << dim)> values)
  {
    for (unsigned int a = 0; a < dim; ++a)
      for (unsigned int m = 0; m < values.size(); ++m)
        if ((m >> a) & 1)
          values[m] -= values[m ^ (1 << a)];
    return values;
  }

  /// Water on its way into a cell, weighted with the linear functions of the vertices, m^3.
  template <int dim>
  struct EnteringWater
  {
    unsigned int cell;                               ///< active cell index
    typename MixtureCell<dim>::AtVertices at_vertex; ///< m^3, in deal.II's order
  };

  /// Soil and water in the cells that hold points: sums of each cell, and the porosity of its parts.
  template <int dim>
  class Mixture
  {
  public:
    /// @param soil_points of a cell along each axis at the start; of the body that has fewest
    /// @param cut_cells what rigid ground leaves of the cells; null: all
    Mixture(const BackgroundGrid<dim> &grid, const unsigned int soil_points, const CutCells<dim> *cut_cells = nullptr);

    /// Fits the mixture to the grid's current cells.
    void reinit();

    /// Empties the mixture, before a new step.
    void clear();

    /// The number of a cell's record, which is made if there is none.
    unsigned int record(const unsigned int cell);

    /// Masses of the cells times a factor.
    void scale_inertia(const double factor)
    {
      if (factor == 1.)
        return;
      for (MixtureCell<dim> &cell : records)
        {
          cell.soil_mass *= factor;
          cell.water_mass *= factor;
          cell.mass_of_flux *= factor;
          cell.inertia_of_flux *= factor;
        }
    }

    /// Counts a volume of water, m^3, about a place of a cell, from 0 to 1 along each axis, for which there is no point
    /// yet: where an inflow is between two layers. It fills the cell's vertices, if points have brought water there,
    /// and has no other effect.
    void add_entering(const unsigned int cell, const dealii::Point<dim> &place, const double volume);

    /// Sums of add_entering().
    const std::vector<EnteringWater<dim>> &entering() const
    {
      return entering_water;
    }

    /// Records of the cells that hold points, by the numbers of record().
    std::vector<MixtureCell<dim>> &cells()
    {
      return records;
    }

    /// Read-only access.
    const std::vector<MixtureCell<dim>> &cells() const
    {
      return records;
    }

    /// Soil in the parts of a cell: room for it is made. Records of cells with soil have to come before the others.
    PorosityOfParts<dim> &soil_parts(const unsigned int record)
    {
      while (record >= porosities.size())
        porosities.emplace_back(soil_points);
      return porosities[record];
    }

    /// Finds the porosities of a cell's parts, when all soil of the cell is in its record.
    void find_porosities(const unsigned int record)
    {
      porosities[record].find(records[record].volume, records[record].soil_depths);
    }

    /// The porosities of a cell's parts; null if nothing has been put into soil_parts() there.
    const PorosityOfParts<dim> *porosity_of_parts(const unsigned int cell) const
    {
      const unsigned int record = record_of_cell[cell];
      return record < porosities.size() ? &porosities[record] : nullptr;
    }

  private:
    const BackgroundGrid<dim> &grid;
    const unsigned int soil_points;
    const double cell_volume;       // m^3
    const CutCells<dim> *cut_cells; // may be null
    std::vector<MixtureCell<dim>> records;
    std::vector<unsigned int> record_of_cell; // by active cell index
    std::vector<EnteringWater<dim>> entering_water;
    std::vector<PorosityOfParts<dim>> porosities; // of the first records, which have soil
  };

} // namespace scree

#endif

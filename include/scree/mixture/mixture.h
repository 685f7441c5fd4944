// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_mixture_mixture_h
#define scree_mixture_mixture_h

#include <scree/mesh/nodal_field.h>
#include <scree/mesh/cut_cells.h>
#include <scree/mixture/closures.h>
#include <scree/mesh/node_rows.h>
#include <scree/mixture/porosity_of_parts.h>

#include <deal.II/base/geometry_info.h>

#include <algorithm>
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
    double drag         = 0;     ///< of saturated soil in slow flow, sum V R; then dt^-1 C, N s/m
    double inertial     = 0;     ///< what sum V R grows by with |q|: sum V_grains b, N s^2/m^2

    // Sums weighted with the linear functions of the vertices.
    AtVertices grains_at_vertex{},    ///< volume of grains, m^3
        water_at_vertex{};            ///< volume of water, m^3
    AtVertices pressure_at_vertex{};  ///< volume of water times pressure there, Pa m^3
    AtVertices forgotten_at_vertex{}; ///< volume of water times what its pressure has lost, m^3
    AtVertices soil_depths{};         ///< signed distances from the surface of the soil, cells; positive inside
    AtVertices bulk_at_vertex{};      ///< volume of water and the grains about it, sum V/n_p, m^3

    double bulk_volume  = 0, ///< sum V/n_p, m^3
        mass_of_flux    = 0, ///< sum m/n_p, kg
        inertia_of_flux = 0; ///< sum m/n_p^2, kg
    double drag_of_flux = 0; ///< sum V/n_p times the resistance of the pores, N s/m

    double drag_share           = 0; ///< of the drag of soil full of water, see drag_share_of()
    double effective_saturation = 0; ///< of the pores, see effective_saturation_of()
    double fill                 = 0; ///< volume of water and wet grains over `volume`
    double mobility             = 0; ///< kappa: what a pressure gradient does to the mixture's flow, m^3/kg
    double volume_factor        = 1; ///< of the soil over a step, beside what its nodes tell of

    /// @param cell active cell index
    /// @param volume open to soil and water, m^3
    MixtureCell(const unsigned int cell, const double volume)
        : cell(cell)
        , volume(volume)
    {
    }

    /// Centre of the water and the wet grains, from 0 to 1 along each axis.
    dealii::Point<dim> centre() const
    {
      dealii::Point<dim> moment;
      double volume = 0;
      for (unsigned int v = 0; v < n_vertices; ++v)
        {
          const double filled = water_at_vertex[v] + effective_saturation * grains_at_vertex[v];
          volume += filled;
          moment += filled * dealii::GeometryInfo<dim>::unit_cell_vertex(v);
        }
      return dealii::Point<dim>(moment / volume);
    }

    /// Volume of grains at a vertex that are wet as far as water fills the pores, m^3; with the effective saturation
    /// more of them are. The last twentieth of the pores may be empty, as strain opens them.
    double wet_grains_at(const unsigned int vertex) const
    {
      return std::min(1., water_volume / (0.95 * pore_volume)) * grains_at_vertex[vertex];
    }

    /// Effective saturation, fill and share of the drag from the volumes.
    void find_fill()
    {
      effective_saturation = effective_saturation_of(water_volume, pore_volume);
      fill                 = (water_volume + effective_saturation * grain_volume) / volume;
      drag_share           = drag_share_of(volume, grain_volume, pore_volume, water_volume);
    }
  };

  /// The pressure at a cell's vertices, Pa, in deal.II's order.
  template <int dim>
  using PressureOfCell = std::function<std::array<double, (1 << dim)>(const unsigned int cell)>;

  /// What the next step does not start from of the pressure at a cell's vertices, in the same order, 0 to 1; empty: the
  /// pressure is kept.
  template <int dim>
  using ForgottenOfCell = std::function<std::array<double, (1 << dim)>(const unsigned int cell)>;

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

  /// Soil and water in the cells that hold points: sums of each cell, and the moments V phi_i x^m of grains and water,
  /// with which the pressure's force on a node, sum V phi_i grad p, needs no second walk over the points.
  template <int dim>
  class Mixture
  {
  public:
    /// Monomials in a pressure's gradient: all products of coordinates but the one of all axes.
    static constexpr unsigned int n_moments = (1 << dim) - 1;

    /// @param soil_points of a cell along each axis at the start; of the body that has fewest
    /// @param cut_cells what rigid ground leaves of the cells; null: all
    Mixture(const BackgroundGrid<dim> &grid, const unsigned int soil_points, const CutCells<dim> *cut_cells = nullptr);

    /// Fits the mixture to the grid's current cells.
    void reinit();

    /// Empties the mixture, before a new step.
    void clear();

    /// The number of a cell's record, which is made if there is none.
    unsigned int record(const unsigned int cell);

    /// Effective saturation and fill, when all points are in.
    void finish();

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

    /// What add_entering() has been told.
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

    /// Moments of a cell's grains or water: rows of nodes of n_moments each.
    NodeRow *grain_moments(const unsigned int record)
    {
      return &grains[std::size_t(record) * moments_per_cell];
    }

    /// Read-only access.
    const NodeRow *grain_moments(const unsigned int record) const
    {
      return &grains[std::size_t(record) * moments_per_cell];
    }

    /// The same of the cell's water.
    NodeRow *water_moments(const unsigned int record)
    {
      return &water[std::size_t(record) * moments_per_cell];
    }

    /// Of these the sums V phi_i of grains at a row of nodes, m^3.
    const NodeRow &grain_volumes(const unsigned int record, const unsigned int row) const
    {
      return grain_moments(record)[row * n_moments];
    }

    /// The same of water.
    const NodeRow &water_volumes(const unsigned int record, const unsigned int row) const
    {
      return water[std::size_t(record) * moments_per_cell + row * n_moments];
    }

    /// Soil in the parts of a cell: room for it is made. Records of cells with soil have to come before the others.
    PorosityOfParts<dim> &soil_parts(const unsigned int record)
    {
      while (record >= porosities.size())
        porosities.emplace_back(soil_points);
      return porosities[record];
    }

    /// Finds the porosities of a cell's parts, when all soil and water of the cell is in its record.
    /// @param by_flux whether all of the cell counts that is open, or what soil and water fill
    void find_porosities(const unsigned int record, const bool by_flux);

    /// What the soil's change of volume in a cell is multiplied by.
    double volume_factor(const unsigned int cell) const
    {
      const unsigned int record = record_of_cell[cell];
      return record < records.size() ? records[record].volume_factor : 1.;
    }

    /// The porosities of a cell's parts; null if nothing has been put into soil_parts() there.
    const PorosityOfParts<dim> *porosity_of_parts(const unsigned int cell) const
    {
      const unsigned int record = record_of_cell[cell];
      return record < porosities.size() ? &porosities[record] : nullptr;
    }

    /// Adds `factor` sum S V_grains phi_i grad p and `factor` sum V_water phi_i grad p to `dim` components each of the
    /// nodes of a cell, from `first_soil` of `soil_nodes` and `first_water` of `water_nodes` on (N at factor 1).
    template <typename SoilNodes, typename WaterNodes>
    void add_pressure_gradient(const unsigned int record,
                               const Multilinear<dim> &pressure,
                               const double factor,
                               SoilNodes &soil_nodes,
                               const unsigned int first_soil,
                               WaterNodes &water_nodes,
                               const unsigned int first_water) const;

    /// Adds `factor` sum S (V_grains + V_pores) phi_i grad p to `dim` components of the soil's nodes of a cell, from
    /// `first` on (N at factor 1): what a pressure does to grains that bear all of it.
    template <typename Nodes>
    void add_soil_gradient(const unsigned int record,
                           const Multilinear<dim> &pressure,
                           const double factor,
                           Nodes &nodes,
                           const unsigned int first) const;

  private:
    template <int n, typename Nodes>
    void add_gradient(const NodeRow *moments,
                      const unsigned int *nodes,
                      const Multilinear<dim> &slopes,
                      Nodes &values,
                      const unsigned int first) const;

    const BackgroundGrid<dim> &grid;
    const unsigned int soil_points, moments_per_cell;
    const double cell_volume;       // m^3
    const CutCells<dim> *cut_cells; // may be null
    std::vector<MixtureCell<dim>> records;
    std::vector<unsigned int> record_of_cell; // by active cell index
    std::vector<NodeRow> grains, water;
    std::vector<EnteringWater<dim>> entering_water;
    std::vector<PorosityOfParts<dim>> porosities; // of the first records, which have soil
  };


  template <int dim>
  template <int n, typename Nodes>
  inline void Mixture<dim>::add_gradient(const NodeRow *moments,
                                         const unsigned int *nodes,
                                         const Multilinear<dim> &slopes,
                                         Nodes &values,
                                         const unsigned int first) const
  {
    for (unsigned int r = 0; r < RowFactors<dim, n>::n_rows; ++r, moments += n_moments)
      for (unsigned int a = 0; a < dim; ++a)
        {
          NodeRow force{};
          for (unsigned int m = 0; m < n_moments; ++m)
            if (!((m >> a) & 1))
              force += slopes[m | (1 << a)] * moments[m];
          for (unsigned int i = 0; i < n; ++i)
            values[nodes[r * n + i]][first + a] += force[i];
        }
  }


  template <int dim>
  template <typename Nodes>
  inline void Mixture<dim>::add_soil_gradient(const unsigned int record,
                                              const Multilinear<dim> &pressure,
                                              const double factor,
                                              Nodes &nodes,
                                              const unsigned int first) const
  {
    const MixtureCell<dim> &cell = records[record];
    if (!(cell.grain_volume > 0.))
      return;
    Multilinear<dim> slopes = pressure;
    for (double &slope : slopes)
      slope *= factor * cell.effective_saturation * (1. + cell.pore_volume / cell.grain_volume) / grid.cell_size();
    const NodeRow *moments = &grains[std::size_t(record) * moments_per_cell];
    if (grid.n_nodes_1d() == 2)
      add_gradient<2>(moments, grid.nodes(cell.cell), slopes, nodes, first);
    else
      add_gradient<3>(moments, grid.nodes(cell.cell), slopes, nodes, first);
  }


  template <int dim>
  template <typename SoilNodes, typename WaterNodes>
  inline void Mixture<dim>::add_pressure_gradient(const unsigned int record,
                                                  const Multilinear<dim> &pressure,
                                                  const double factor,
                                                  SoilNodes &soil_nodes,
                                                  const unsigned int first_soil,
                                                  WaterNodes &water_nodes,
                                                  const unsigned int first_water) const
  {
    const MixtureCell<dim> &cell = records[record];
    const unsigned int *nodes    = grid.nodes(cell.cell);
    const auto add = [&](const NodeRow *moments, const double weight, auto &values, const unsigned int at) {
      Multilinear<dim> slopes = pressure;
      for (double &slope : slopes)
        slope *= weight / grid.cell_size();
      if (grid.n_nodes_1d() == 2)
        add_gradient<2>(moments, nodes, slopes, values, at);
      else
        add_gradient<3>(moments, nodes, slopes, values, at);
    };
    if (cell.grain_volume > 0 && cell.effective_saturation > 0)
      add(&grains[std::size_t(record) * moments_per_cell], factor * cell.effective_saturation, soil_nodes, first_soil);
    if (cell.water_volume > 0)
      add(&water[std::size_t(record) * moments_per_cell], factor, water_nodes, first_water);
  }
} // namespace scree

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/particles/point_set.h>
#include <scree/transfer/cell_sums.h>
#include <scree/transfer/velocity_transfer.h>
#include <scree/transfer/water_transfer.h>

#include <cmath>
#include <optional>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// Value, Pa, and gradient, Pa/m, of a cell's pressure at places in it: 1 + dim batches.
    template <int dim>
    void
    find_pressure(const Multilinear<dim> &pressure, const std::array<Batch, dim> &x, const double width, Batch *result)
    {
      const auto powers = monomials<dim, Batch>(x);
      result[0]         = simd::broadcast<Batch>(pressure.back());
      for (unsigned int a = 0; a < dim; ++a)
        result[0] *= x[a];
      for (unsigned int m = 0; m < powers.size(); ++m)
        result[0] += pressure[m] * powers[m];
      for (unsigned int a = 0; a < dim; ++a)
        {
          Batch slope{};
          for (unsigned int m = 0; m < powers.size(); ++m)
            if (!((m >> a) & 1))
              slope += pressure[m | (1 << a)] * powers[m];
          result[1 + a] = slope / width;
        }
    }
  } // namespace


  template <int dim>
  WaterTransfer<dim>::WaterTransfer(const BackgroundGrid<dim> &grid,
                                    const TransferParameters &transfer,
                                    const WaterParameters &water)
      : grid(grid)
      , method(transfer.transfer_method())
      , pic_rate(transfer.pic_rate)
      , point_sets(water.point_sets_kind())
      , density(water.density)
  {
  }


  template <int dim>
  double WaterTransfer<dim>::kept(const double time_step) const
  {
    return kept_velocity(method, pic_rate, time_step);
  }


  template <int dim>
  template <int n, bool is_affine>
  void WaterTransfer<dim>::add_water(const WaterPhase<dim> &water, Mixture<dim> &mixture, WetNodes<dim> &nodes) const
  {
    using PoresAbout              = typename PorosityOfParts<dim>::PoresAbout;
    constexpr unsigned int n_rows = RowFactors<dim, n>::n_rows;
    const SoilBody<dim> *carrier  = water.carrier();
    const double width            = grid.cell_size();
    const auto &layout            = water.layout;
    for (const auto &cell : water.points().cells())
      {
        const OpenKnots open                 = grid.open_knots(cell.cell);
        const unsigned int record            = mixture.record(cell.cell);
        const PorosityOfParts<dim> *porosity = mixture.porosity_of_parts(cell.cell);
        if (porosity != nullptr)
          mixture.find_porosities(record);
        MixtureCell<dim> totals = mixture.cells()[record];
        CellSums<dim, n> sums(width);
        CellSums<dim, n> excess_sums(width);
        NodeRow pore_sums[4][n_rows] = {}; // by the first numbers of Pores
        const bool has_pores         = porosity != nullptr || carrier != nullptr;
        const auto pores_at          = [&](const auto &point, const Point<dim> &x) {
          if (porosity != nullptr)
            return porosity->at(x);
          if (carrier == nullptr)
            return PoresAbout{ 1., 0., 0. };
          const double porous = std::max(carrier->porosity(point.properties), smallest_porosity);
          return PoresAbout{ 1. / porous,
                             carrier->drag->linear(porous) / porous,
                             (1. - porous) * carrier->drag->inertial(porous) / porous };
        };

        for_each_record_with_shape<n>(
            cell, cell.stride, open, width, [&](const auto &point, const auto &shape) DEAL_II_ALWAYS_INLINE {
              const double *properties = point.properties, *affine = properties + layout.affine;
              const double mass = properties[layout.mass], volume = properties[layout.volume];
              sums.template add_momentum<is_affine>(shape, mass, properties + layout.velocity, affine);
              const PoresAbout about = pores_at(point, shape.x);
              const double more      = about.inverse_porosity - 1.;
              const double bulk      = about.inverse_porosity * volume;
              add_row<dim>(bulk * vertex_values(shape.x), totals.bulk_at_vertex);
              totals.bulk_volume += bulk;
              totals.mass_of_flux += about.inverse_porosity * mass;
              totals.inertia_of_flux += about.inverse_porosity * about.inverse_porosity * mass;
              totals.drag_of_flux += bulk * about.resistance;
              if (has_pores)
                {
                  add_row_sums(shape, bulk * about.resistance, pore_sums[Pores::drag]);
                  add_row_sums(shape, bulk * about.inertial, pore_sums[Pores::inertial_drag]);
                  add_row_sums(shape, volume * more, pore_sums[Pores::local_solid_volume]);
                  add_row_sums(shape, volume * more * (2. + more), pore_sums[Pores::flux_inertia]);
                  excess_sums.template add_momentum<is_affine>(
                      shape, mass * more, properties + layout.velocity, affine);
                }

              std::array<double, dim> rise;
              for (unsigned int a = 0; a < dim; ++a)
                rise[a] = width * properties[layout.pressure_gradient + a];
              add_to_vertices<dim>(shape.x, volume, properties[layout.pressure], rise, totals);
              totals.water_volume += volume;
              totals.water_mass += mass;
            });
        mixture.cells()[record] = totals;

        const unsigned int *of_cell = grid.nodes(cell.cell);
        nodes.water.activate_cell(cell.cell);
        sums.scatter(of_cell, nodes.water);
        if (has_pores)
          {
            nodes.pores.activate_cell(cell.cell);
            excess_sums.scatter_momentum(of_cell, Pores::excess_momentum, nodes.pores);
            for (unsigned int r = 0; r < n_rows; ++r)
              for (unsigned int i = 0; i < n; ++i)
                for (unsigned int c = 0; c < 4; ++c)
                  nodes.pores[of_cell[r * n + i]][c] += pore_sums[c][r][i];
          }
      }
  }


  template <int dim>
  template <int n, TransferMethod method>
  void WaterTransfer<dim>::move_cell(const WaterPhase<dim> &water,
                                     const CellPoints<dim> &cell,
                                     const WetNodes<dim> &nodes,
                                     const PorosityOfParts<dim> *porosity,
                                     const Multilinear<dim> &pressure,
                                     const double time_step,
                                     const double keep,
                                     LargestSquare &largest) const
  {
    const double width      = grid.cell_size();
    const auto &layout      = water.layout;
    const OpenKnots open    = grid.open_knots(cell.cell);
    const unsigned int *ids = grid.nodes(cell.cell);
    const bool is_alone     = water.carrier() == nullptr;
    const CellVelocity<dim, n> velocity(ids, nodes.water, width);
    std::optional<PoreVelocity<dim, n>> by_place;
    if (is_alone && PoreVelocity<dim, n>::differs(ids, nodes))
      by_place.emplace(ids, velocity, nodes, width);

    for_each_batch(cell.n_points, [&](const BatchIndices &indices, const unsigned int n_used) {
      const BatchPointers<dim> points(cell, indices);
      for (const unsigned int p : indices)
        cell.prefetch_all_after(p);
      const BatchShape<dim, n> shape(points.places, open);
      const NodesAtPoints<dim> at_points =
          by_place ? by_place->template at<method>(
                         shape, porosity ? porosity->inverse_at(shape.x) : simd::broadcast<Batch>(1.))
                   : velocity.template at<method, false>(shape);

      Batch own[dim], affine[dim * dim], pressure_there[1 + dim];
      const auto own_slots = points.slots_at(layout.velocity);
      simd::load_records<dim>(as_constant(own_slots), own);
      largest.include(at_points.template update<method>(own, affine, keep, time_step), n_used);
      simd::store_records<dim>(own, own_slots);
      if constexpr (carries_affine(method))
        simd::store_records<dim * dim>(affine, points.slots_at(layout.affine));
      if (is_alone)
        {
          Batch location[dim];
          simd::load_records<dim>(as_constant(points.locations), location);
          for (unsigned int c = 0; c < dim; ++c)
            location[c] += time_step * at_points.velocity[c];
          simd::store_records<dim>(location, points.locations);
        }
      // The slots of the gradient are behind the pressure.
      find_pressure<dim>(pressure, shape.x, width, pressure_there);
      simd::store_records<1 + dim>(pressure_there, points.slots_at(layout.pressure));
    });
  }


  template <int dim>
  void WaterTransfer<dim>::soil_to_grid(const SoilBody<dim> &soil, Mixture<dim> &mixture) const
  {
    with_nodes_1d(grid, [&](auto n) {
      const auto &layout = soil.layout;
      const DragLaw &law = *soil.drag;
      for (const auto &cell : soil.points.cells())
        {
          const OpenKnots open      = grid.open_knots(cell.cell);
          const unsigned int record = mixture.record(cell.cell);
          MixtureCell<dim> sums     = mixture.cells()[record];
          auto *parts               = point_sets == PointSets::double_point ? &mixture.soil_parts(record) : nullptr;

          for_each_record_with_shape<n>(cell,
                                        layout.volume + 1,
                                        open,
                                        grid.cell_size(),
                                        [&](const auto &point, const auto &shape) DEAL_II_ALWAYS_INLINE {
                                          const double *properties = point.properties;
                                          const double mass        = properties[layout.mass];
                                          const double volume      = properties[layout.volume];
                                          const double grains      = mass / soil.grain_density;
                                          const double porosity    = std::max(1. - grains / volume, smallest_porosity);
                                          const double pores_of_point = porosity * volume;
                                          if (parts != nullptr)
                                            parts->add_soil(shape.x,
                                                            grains,
                                                            volume,
                                                            volume * law.linear(porosity) / porosity,
                                                            grains * law.inertial(porosity) / porosity);
                                          add_row<dim>(grains * vertex_values(shape.x), sums.grains_at_vertex);
                                          sums.soil_mass += mass;
                                          sums.grain_volume += grains;
                                          sums.pore_volume += pores_of_point;
                                        });
          sums.is_rigid           = sums.is_rigid || soil.is_rigid;
          mixture.cells()[record] = sums;
        }
    });
  }


  template <int dim>
  void WaterTransfer<dim>::to_grid(const WaterPhase<dim> &water, Mixture<dim> &mixture, WetNodes<dim> &nodes) const
  {
    with_nodes_1d(grid, [&](auto n) {
      if (carries_affine(method))
        add_water<n, true>(water, mixture, nodes);
      else
        add_water<n, false>(water, mixture, nodes);
    });
  }


  template <int dim>
  double WaterTransfer<dim>::to_points(WaterPhase<dim> &water,
                                       const WetNodes<dim> &nodes,
                                       const Mixture<dim> &mixture,
                                       const PressureOfCell<dim> &pressure,
                                       const double time_step) const
  {
    const double keep = kept(time_step);
    LargestSquare largest;
    for (const auto &cell : water.points().cells())
      {
        const Multilinear<dim> of_cell = multilinear_of<dim>(pressure(cell.cell));
        const auto *porosity           = mixture.porosity_of_parts(cell.cell);
        with_nodes_1d(grid, [&](auto n) {
          with_method(method, [&](auto of_points) {
            move_cell<n, of_points>(water, cell, nodes, porosity, of_cell, time_step, keep, largest);
          });
        });
        if (const SoilBody<dim> *soil = water.carrier())
          for_each_point(cell, [&](const auto &point) {
            double &volume                      = point.properties[water.layout.volume];
            volume                              = std::max(soil->pore_volume(point.properties), 0.);
            point.properties[water.layout.mass] = water.density * volume;
          });
      }
    return largest.speed();
  }

  template class WaterTransfer<2>;
  template class WaterTransfer<3>;
} // namespace scree

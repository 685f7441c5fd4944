// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/points/batch_pointers.h>
#include <scree/transfer/cell_sums.h>
#include <scree/transfer/pore_velocity.h>
#include <scree/transfer/water_transfer.h>

#include <cmath>
#include <cstring>
#include <optional>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// A number for each corner of a cell, in registers: numbers that are stored one by one and read as a vector wait
    /// for each other.
    template <int dim>
    struct RowOfCorners;
    template <>
    struct RowOfCorners<2>
    {
      using type = double __attribute__((vector_size(4 * sizeof(double))));
    };
    template <>
    struct RowOfCorners<3>
    {
      using type = double __attribute__((vector_size(8 * sizeof(double))));
    };
    template <int dim>
    using CornerRow = typename RowOfCorners<dim>::type;

    /// `upper` at the corners on the upper face of an axis, `lower` at the others.
    template <int dim>
    DEAL_II_ALWAYS_INLINE inline CornerRow<dim>
    on_faces(const unsigned int axis, const double lower, const double upper)
    {
      CornerRow<dim> row;
      for (unsigned int v = 0; v < (1 << dim); ++v)
        row[v] = v >> axis & 1 ? upper : lower;
      return row;
    }

    /// The linear functions of a cell's corners at one of its points.
    template <int dim>
    DEAL_II_ALWAYS_INLINE inline CornerRow<dim> corner_values(const Point<dim> &x)
    {
      CornerRow<dim> values = on_faces<dim>(0, 1. - x[0], x[0]);
      for (unsigned int a = 1; a < dim; ++a)
        values *= on_faces<dim>(a, 1. - x[a], x[a]);
      return values;
    }

    /// Adds a row to sums of a cell.
    template <int dim>
    DEAL_II_ALWAYS_INLINE inline void add(const CornerRow<dim> &row, typename MixtureCell<dim>::AtCorners &sums)
    {
      CornerRow<dim> sum;
      std::memcpy(&sum, sums.data(), sizeof(sum));
      sum += row;
      std::memcpy(sums.data(), &sum, sizeof(sum));
    }

    /// The monomials x^m of places of a cell, bit a of m standing for x_a.
    template <int dim, typename Number, typename Place>
    std::array<Number, Mixture<dim>::n_moments> monomials(const Place &x)
    {
      std::array<Number, Mixture<dim>::n_moments> values;
      values[0] = simd::broadcast<Number>(1.);
      for (unsigned int a = 0; a < dim; ++a)
        for (unsigned int m = 0; m < (1u << a); ++m)
          if (const unsigned int with = m | (1 << a); with < values.size())
            values[with] = values[m] * x[a];
      return values;
    }

    /// Adds the moments of a point's volume to rows of nodes.
    template <int dim, int n>
    DEAL_II_ALWAYS_INLINE inline void
    add_moments(const PointShape<dim, n> &shape, const double volume, NodeRow *moments)
    {
      const NodeRow volume_x = shape.value_x * volume;
      const auto powers      = monomials<dim, double>(shape.x);
      for (unsigned int r = 0; r < RowFactors<dim, n>::n_rows; ++r)
        {
          const NodeRow volume_of_row = volume_x * shape.rows.value[r];
          for (unsigned int m = 0; m < Mixture<dim>::n_moments; ++m)
            *moments++ += volume_of_row * powers[m];
        }
    }

    /// Adds a point's number, shared by the shape functions, to rows of nodes.
    template <int dim, int n, unsigned long n_rows>
    void add_row_sums(const PointShape<dim, n> &shape, const double number, NodeRow (&sums)[n_rows])
    {
      const NodeRow number_x = shape.value_x * number;
      for (unsigned int r = 0; r < n_rows; ++r)
        sums[r] += number_x * shape.rows.value[r];
    }

    /// Adds rows of nodes to a component of the pores.
    template <int dim, int n, unsigned long n_rows>
    void scatter(const NodeRow (&sums)[n_rows],
                 const unsigned int *nodes,
                 const unsigned int component,
                 PoreField<dim> &pores)
    {
      for (unsigned int r = 0; r < n_rows; ++r)
        for (unsigned int i = 0; i < n; ++i)
          pores[nodes[r * n + i]][component] += sums[r][i];
    }

    /// Adds volume and pressure of a point of water to the corners of its cell.
    ///
    /// @param forgotten part of the pressure that the step does not start from
    /// @param rise of the pressure along each axis over the cell's width, Pa
    template <int dim>
    DEAL_II_ALWAYS_INLINE inline void add_to_corners(const Point<dim> &x,
                                                     const double volume,
                                                     const double pressure,
                                                     const std::array<double, dim> &rise,
                                                     const double forgotten,
                                                     MixtureCell<dim> &sums)
    {
      double pressure_at_lower = pressure;
      for (unsigned int a = 0; a < dim; ++a)
        pressure_at_lower -= rise[a] * x[a];
      CornerRow<dim> pressure_at_corner = on_faces<dim>(0, pressure_at_lower, pressure_at_lower + rise[0]);
      for (unsigned int a = 1; a < dim; ++a)
        pressure_at_corner += on_faces<dim>(a, 0., rise[a]);
      const CornerRow<dim> volume_at_corner = volume * corner_values(x);
      add<dim>(volume_at_corner, sums.water_at_corner);
      add<dim>(volume_at_corner * pressure_at_corner, sums.pressure_at_corner);
      add<dim>(volume_at_corner * forgotten, sums.forgotten_at_corner);
    }

    /// Value, Pa, and gradient, Pa/m, of a cell's pressure at places in it, and, if anything, what the next step
    /// forgets of it: 1 or 2 + dim batches.
    template <int dim>
    void
    find_pressure(const CellPressure<dim> &pressure, const std::array<Batch, dim> &x, const double width, Batch *result)
    {
      const auto powers   = monomials<dim, Batch>(x);
      const auto value_of = [&](const Multilinear<dim> &function) {
        Batch value = simd::broadcast<Batch>(function.back());
        for (unsigned int a = 0; a < dim; ++a)
          value *= x[a];
        for (unsigned int m = 0; m < powers.size(); ++m)
          value += function[m] * powers[m];
        return value;
      };
      result[0] = value_of(pressure.value);
      if (pressure.forgotten)
        result[1 + dim] = value_of(*pressure.forgotten);
      for (unsigned int a = 0; a < dim; ++a)
        {
          Batch slope{};
          for (unsigned int m = 0; m < powers.size(); ++m)
            if (!((m >> a) & 1))
              slope += pressure.value[m | (1 << a)] * powers[m];
          result[1 + a] = slope / width;
        }
    }


    /// 1 over the porosity about the points of a batch; 1 without soil.
    template <int dim>
    Batch inverse_porosity_at(const PorosityOfParts<dim> *porosity, const std::array<Batch, dim> &x)
    {
      Batch result = simd::broadcast<Batch>(1.);
      if (porosity != nullptr)
        for (unsigned int l = 0; l < batch_size; ++l)
          {
            Point<dim> place;
            for (unsigned int a = 0; a < dim; ++a)
              place[a] = x[a][l];
            result[l] = porosity->inverse_at(place);
          }
      return result;
    }
  } // namespace


  template <int dim>
  WaterTransfer<dim>::WaterTransfer(const BackgroundGrid<dim> &grid,
                                    const TransferParameters &transfer,
                                    const WaterParameters &water,
                                    const double pressure_slope)
      : grid(grid)
      , method(transfer.transfer_method())
      , pic_rate(transfer.pic_rate)
      , pressure_slope(pressure_slope)
      , point_sets(water.point_sets_kind())
  {
  }


  template <int dim>
  template <int n>
  void WaterTransfer<dim>::add_soil(const SoilBody<dim> &soil, Mixture<dim> &mixture, PoreField<dim> &pores) const
  {
    constexpr unsigned int n_rows = RowFactors<dim, n>::n_rows;
    const auto &layout            = soil.layout;
    const DragLaw &law            = *soil.drag;
    for (const auto &cell : soil.points.cells())
      {
        const OpenKnots open          = grid.open_knots(cell.cell);
        const unsigned int record     = mixture.record(cell.cell);
        NodeRow *moments              = mixture.grain_moments(record);
        MixtureCell<dim> sums         = mixture.cells()[record];
        auto *parts                   = point_sets == PointSets::double_point ? &mixture.soil_parts(record) : nullptr;
        const double grains_of_others = sums.grain_volume;
        NodeRow pore_sums[n_rows] = {}, drag_sums[n_rows] = {};

        for_each_record(cell, [&](const auto &point) {
          const PointShape<dim, n> shape(point.reference_location, open);
          const double *properties    = point.properties;
          const double mass           = properties[layout.mass];
          const double volume         = properties[layout.volume];
          const double grains         = mass / soil.grain_density;
          const double porosity       = std::max(1. - grains / volume, smallest_porosity);
          const double pores_of_point = porosity * volume;
          const double drag           = volume * law.linear(porosity);

          add_moments(shape, grains, moments);
          add_row_sums(shape, pores_of_point, pore_sums);
          add_row_sums(shape, drag, drag_sums);
          if (parts != nullptr)
            parts->add_soil(shape.x, grains, volume);
          add<dim>(grains * corner_values(shape.x), sums.grains_at_corner);
          sums.soil_mass += mass;
          sums.grain_volume += grains;
          sums.pore_volume += pores_of_point;
          sums.drag += drag;
        });
        sums.is_rigid = sums.is_rigid || soil.is_rigid;
        sums.inertial += (sums.grain_volume - grains_of_others) * law.inertial();
        mixture.cells()[record] = sums;
        pores.activate_cell(cell.cell);
        scatter<dim, n>(pore_sums, grid.nodes(cell.cell), PoreField<dim>::pore_volume, pores);
        scatter<dim, n>(drag_sums, grid.nodes(cell.cell), PoreField<dim>::drag, pores);
      }
  }


  template <int dim>
  template <int n, TransferMethod method>
  void WaterTransfer<dim>::add_water(const WaterPhase<dim> &water,
                                     Mixture<dim> &mixture,
                                     NodalField<dim> &field,
                                     PoreField<dim> &pores) const
  {
    constexpr unsigned int n_rows = RowFactors<dim, n>::n_rows;
    const double width            = grid.cell_size();
    const auto &layout            = water.layout;
    for (const auto &cell : water.points().cells())
      {
        const OpenKnots open      = grid.open_knots(cell.cell);
        const unsigned int record = mixture.record(cell.cell);
        NodeRow *moments          = mixture.water_moments(record);
        for_each_point(
            cell, [&](const auto &point) { mixture.cells()[record].water_volume += point.properties[layout.volume]; });
        const PorosityOfParts<dim> *porosity = mixture.porosity_of_parts(cell.cell);
        if (porosity != nullptr)
          mixture.find_porosities(record);
        MixtureCell<dim> totals = mixture.cells()[record];
        CellSums<dim, n> sums(width);
        NodeRow grains_about[n_rows] = {};

        for_each_record(cell, [&](const auto &point) {
          const PointShape<dim, n> shape(point.reference_location, open);
          const double *properties = point.properties, *affine = properties + layout.affine;
          const double mass = properties[layout.mass], volume = properties[layout.volume];
          sums.template add_momentum<method>(shape, mass, properties + layout.velocity, affine);
          add_moments(shape, volume, moments);
          if (porosity != nullptr)
            add_row_sums(shape, volume * (porosity->inverse_at(shape.x) - 1.), grains_about);

          std::array<double, dim> rise;
          for (unsigned int a = 0; a < dim; ++a)
            rise[a] = pressure_slope * width * properties[layout.pressure_gradient + a];
          add_to_corners<dim>(shape.x, volume, properties[layout.pressure], rise, properties[layout.forgotten], totals);
          totals.water_mass += mass;
        });
        mixture.cells()[record] = totals;

        field.activate_cell(cell.cell);
        sums.scatter(grid.nodes(cell.cell), field);
        if (porosity != nullptr)
          scatter<dim, n>(grains_about, grid.nodes(cell.cell), PoreField<dim>::grains_about_water, pores);
      }
  }


  template <int dim>
  template <int n, TransferMethod method>
  double WaterTransfer<dim>::move_water(WaterPhase<dim> &water,
                                        const MixtureNodes<dim> &nodes,
                                        const Mixture<dim> &mixture,
                                        const PressureOfCell<dim> &corner_pressure,
                                        const ForgottenOfCell<dim> &corner_forgotten,
                                        const double time_step) const
  {
    const double keep = kept_velocity(method, pic_rate, time_step);
    LargestSquare largest;
    CellCosts &costs = water.points().costs();
    costs.start_pass();
    for (const auto &cell : water.points().cells())
      {
        CellPressure<dim> pressure{ multilinear_of<dim>(corner_pressure(cell.cell)), {} };
        if (corner_forgotten)
          pressure.forgotten = multilinear_of<dim>(corner_forgotten(cell.cell));
        largest.include(
            move_cell<n, method>(water, cell, nodes, mixture.porosity_of_parts(cell.cell), pressure, time_step, keep));
        if (const SoilBody<dim> *soil = water.carrier())
          for_each_point(cell, [&](const auto &point) {
            double &volume                      = point.properties[water.layout.volume];
            volume                              = std::max(soil->pore_volume(point.properties), 0.);
            point.properties[water.layout.mass] = water.density * volume;
          });
        costs.finish_cell(cell.cell, cell.n_points);
      }
    return std::sqrt(largest.value);
  }


  template <int dim>
  template <int n, TransferMethod method>
  double WaterTransfer<dim>::move_cell(const WaterPhase<dim> &water,
                                       const CellPoints<dim> &cell,
                                       const MixtureNodes<dim> &nodes,
                                       const PorosityOfParts<dim> *porosity,
                                       const CellPressure<dim> &pressure,
                                       const double time_step,
                                       const double keep) const
  {
    const double width      = grid.cell_size();
    const auto &layout      = water.layout;
    const OpenKnots open    = grid.open_knots(cell.cell);
    const unsigned int *ids = grid.nodes(cell.cell);
    const bool is_alone     = water.carrier() == nullptr;
    const CellVelocity<dim, n> velocity(ids, nodes.water, width);
    std::optional<PoreVelocity<dim, n>> by_place;
    if (is_alone && PoreVelocity<dim, n>::differs(ids, nodes.pores))
      by_place.emplace(ids, velocity, nodes, water.density, width);

    LargestSquare largest;
    for_each_batch(cell.n_points, [&](const BatchIndices &indices, const unsigned int n_used) {
      const BatchPointers<dim> points(cell, indices);
      for (const unsigned int p : indices)
        cell.prefetch_after(p);
      const BatchShape<dim, n> shape(points.places, open);
      const NodesAtPoints<dim> at_points =
          by_place ? by_place->template at<method>(shape, inverse_porosity_at<dim>(porosity, shape.x))
                   : velocity.template at<method, false>(shape);

      Batch own[dim], affine[dim * dim], pressure_there[2 + dim];
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
      // The slots of the gradient and of what is forgotten are behind the pressure.
      find_pressure<dim>(pressure, shape.x, width, pressure_there);
      if (pressure.forgotten)
        simd::store_records<2 + dim>(pressure_there, points.slots_at(layout.pressure));
      else
        simd::store_records<1 + dim>(pressure_there, points.slots_at(layout.pressure));
    });
    return largest.value;
  }


  template <int dim>
  void WaterTransfer<dim>::soil_to_grid(const SoilBody<dim> &soil, Mixture<dim> &mixture, PoreField<dim> &pores) const
  {
    if (grid.n_nodes_1d() == 2)
      add_soil<2>(soil, mixture, pores);
    else
      add_soil<3>(soil, mixture, pores);
  }


  template <int dim>
  void WaterTransfer<dim>::to_grid(const WaterPhase<dim> &water,
                                   Mixture<dim> &mixture,
                                   NodalField<dim> &field,
                                   PoreField<dim> &pores) const
  {
    const auto dispatch = [&](auto n) {
      switch (method)
        {
        case TransferMethod::apic:
          return add_water<n, TransferMethod::apic>(water, mixture, field, pores);
        case TransferMethod::tpic:
        case TransferMethod::aflip: // They differ on the way back only.
          return add_water<n, TransferMethod::tpic>(water, mixture, field, pores);
        default: // FLIP and PIC differ on the way back only.
          return add_water<n, TransferMethod::flip>(water, mixture, field, pores);
        }
    };
    if (grid.n_nodes_1d() == 2)
      dispatch(std::integral_constant<int, 2>());
    else
      dispatch(std::integral_constant<int, 3>());
  }


  template <int dim>
  double WaterTransfer<dim>::to_points(WaterPhase<dim> &water,
                                       const MixtureNodes<dim> &nodes,
                                       const Mixture<dim> &mixture,
                                       const PressureOfCell<dim> &pressure,
                                       const ForgottenOfCell<dim> &forgotten,
                                       const double time_step) const
  {
    const auto dispatch = [&](auto n) {
      switch (method)
        {
        case TransferMethod::flip:
          return move_water<n, TransferMethod::flip>(water, nodes, mixture, pressure, forgotten, time_step);
        case TransferMethod::pic:
          return move_water<n, TransferMethod::pic>(water, nodes, mixture, pressure, forgotten, time_step);
        case TransferMethod::apic:
          return move_water<n, TransferMethod::apic>(water, nodes, mixture, pressure, forgotten, time_step);
        case TransferMethod::aflip:
          return move_water<n, TransferMethod::aflip>(water, nodes, mixture, pressure, forgotten, time_step);
        default:
          return move_water<n, TransferMethod::tpic>(water, nodes, mixture, pressure, forgotten, time_step);
        }
    };
    if (grid.n_nodes_1d() == 2)
      return dispatch(std::integral_constant<int, 2>());
    return dispatch(std::integral_constant<int, 3>());
  }

  template class WaterTransfer<2>;
  template class WaterTransfer<3>;
} // namespace scree

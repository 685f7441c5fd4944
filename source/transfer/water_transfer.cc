// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/transfer/velocity_transfer.h>
#include <scree/transfer/water_transfer.h>

#include <cmath>

namespace scree
{
  using namespace dealii;

  namespace
  {
    constexpr double standard_gravity  = 9.81; // m/s^2
    constexpr double smallest_porosity = 1e-3; // keeps the drag finite where grains overlap

    /// The linear functions of a cell's corners at one of its points.
    template <int dim>
    std::array<double, (1 << dim)> corner_values(const Point<dim> &x)
    {
      std::array<double, (1 << dim)> values;
      values[0] = 1.;
      for (unsigned int a = 0, n = 1; a < dim; ++a, n *= 2)
        for (unsigned int m = 0; m < n; ++m)
          {
            values[m + n] = values[m] * x[a];
            values[m] -= values[m + n];
          }
      return values;
    }

    /// The monomials x^m of a place of a cell, bit a of m standing for x_a.
    template <int dim>
    std::array<double, Mixture<dim>::n_moments> monomials(const Point<dim> &x)
    {
      std::array<double, Mixture<dim>::n_moments> values;
      values[0] = 1.;
      for (unsigned int a = 0; a < dim; ++a)
        for (unsigned int m = 0; m < (1u << a); ++m)
          if (const unsigned int with = m | (1 << a); with < values.size())
            values[with] = values[m] * x[a];
      return values;
    }

    /// Adds the moments of a point's volume to rows of nodes.
    template <int dim, int n>
    void add_moments(const PointShape<dim, n> &shape, const double volume, NodeRow *moments)
    {
      const NodeRow volume_x = shape.value_x * volume;
      const auto powers      = monomials(shape.x);
      for (unsigned int r = 0; r < RowFactors<dim, n>::n_rows; ++r)
        {
          const NodeRow volume_of_row = volume_x * shape.rows.value[r];
          for (unsigned int m = 0; m < Mixture<dim>::n_moments; ++m)
            *moments++ += volume_of_row * powers[m];
        }
    }

    /// Adds volume and pressure of a point of water to the corners of its cell.
    ///
    /// @param rise of the pressure along each axis over the cell's width, Pa
    template <int dim>
    DEAL_II_ALWAYS_INLINE inline void add_to_corners(const Point<dim> &x,
                                                     const double volume,
                                                     const double pressure,
                                                     const std::array<double, dim> &rise,
                                                     MixtureCell<dim> &sums)
    {
      double pressure_at_lower = pressure;
      for (unsigned int a = 0; a < dim; ++a)
        pressure_at_lower -= rise[a] * x[a];
      const auto corners = corner_values(x);
      for (unsigned int v = 0; v < corners.size(); ++v)
        {
          double pressure_at_corner = pressure_at_lower;
          for (unsigned int a = 0; a < dim; ++a)
            if ((v >> a) & 1)
              pressure_at_corner += rise[a];
          sums.water_at_corner[v] += volume * corners[v];
          sums.pressure_at_corner[v] += volume * corners[v] * pressure_at_corner;
        }
    }

    /// Newtonian stress 2 mu dev(sym grad v), Pa: incompressible beside the pressure.
    ///
    /// @param gradient of the velocity, 1/s, dim x dim
    template <int dim>
    Tensor<2, dim> viscous_stress(const double viscosity, const double *gradient)
    {
      double trace = 0;
      for (unsigned int c = 0; c < dim; ++c)
        trace += gradient[c * dim + c];
      Tensor<2, dim> stress;
      for (unsigned int c = 0; c < dim; ++c)
        for (unsigned int a = 0; a < dim; ++a)
          stress[c][a] = viscosity * (gradient[c * dim + a] + gradient[a * dim + c] - (a == c ? 2. / 3. * trace : 0.));
      return stress;
    }

    /// Value, Pa, and gradient, Pa/m, of a multilinear pressure at a place of a cell, into a point's slots.
    template <int dim>
    void set_pressure(const Multilinear<dim> &pressure,
                      const Point<dim> &x,
                      const double width,
                      double &value,
                      double *gradient)
    {
      const auto powers = monomials(x);
      value             = pressure.back();
      for (unsigned int a = 0; a < dim; ++a)
        value *= x[a];
      for (unsigned int m = 0; m < powers.size(); ++m)
        value += pressure[m] * powers[m];
      for (unsigned int a = 0; a < dim; ++a)
        {
          double slope = 0;
          for (unsigned int m = 0; m < powers.size(); ++m)
            if (!((m >> a) & 1))
              slope += pressure[m | (1 << a)] * powers[m];
          gradient[a] = slope / width;
        }
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
      , unit_weight(water.density * standard_gravity)
      , reference_conductivity(water.conductivity)
      , conductivity_law(water.conductivity_law_kind())
      , viscosity(water.viscosity)
      , pressure_slope(pressure_slope)
  {
  }


  template <int dim>
  double WaterTransfer<dim>::conductivity(const double porosity, const double initial_porosity) const
  {
    if (conductivity_law == ConductivityLaw::constant)
      return reference_conductivity;
    const auto kozeny = [](const double n) { return n * n * n / ((1. - n) * (1. - n)); };
    return reference_conductivity * kozeny(porosity) / kozeny(initial_porosity);
  }


  template <int dim>
  template <int n>
  void WaterTransfer<dim>::add_soil(const SoilBody<dim> &soil, Mixture<dim> &mixture, PoreField<dim> &pores) const
  {
    constexpr unsigned int n_rows = RowFactors<dim, n>::n_rows;
    const auto &layout            = soil.layout;
    const double initial_porosity = std::max(1. - soil.density / soil.grain_density, smallest_porosity);
    for (const auto &cell : soil.points.cells())
      {
        const OpenKnots open      = grid.open_knots(cell.cell);
        const unsigned int record = mixture.record(cell.cell);
        NodeRow *moments          = mixture.grain_moments(record);
        MixtureCell<dim> sums     = mixture.cells()[record];
        NodeRow pore_sums[n_rows] = {}, drag_sums[n_rows] = {};

        for_each_point(cell, [&](const auto &point) {
          const PointShape<dim, n> shape(point.reference_location, open);
          const double *properties    = point.properties;
          const double mass           = properties[layout.mass];
          const double volume         = properties[layout.volume];
          const double grains         = mass / soil.grain_density;
          const double porosity       = std::max(1. - grains / volume, smallest_porosity);
          const double pores_of_point = porosity * volume;
          const double drag = pores_of_point * porosity * unit_weight / conductivity(porosity, initial_porosity);

          add_moments(shape, grains, moments);
          const NodeRow pore_x = shape.value_x * pores_of_point, drag_x = shape.value_x * drag;
          for (unsigned int r = 0; r < n_rows; ++r)
            {
              pore_sums[r] += pore_x * shape.rows.value[r];
              drag_sums[r] += drag_x * shape.rows.value[r];
            }
          const auto corners = corner_values(shape.x);
          for (unsigned int v = 0; v < corners.size(); ++v)
            sums.grains_at_corner[v] += grains * corners[v];
          sums.soil_mass += mass;
          sums.grain_volume += grains;
          sums.pore_volume += pores_of_point;
          sums.drag += drag;
        });
        mixture.cells()[record] = sums;
        pores.activate_cell(cell.cell);
        const unsigned int *nodes = grid.nodes(cell.cell);
        for (unsigned int r = 0; r < n_rows; ++r)
          for (unsigned int i = 0; i < n; ++i)
            {
              double *node = pores[nodes[r * n + i]];
              node[PoreField<dim>::pore_volume] += pore_sums[r][i];
              node[PoreField<dim>::drag] += drag_sums[r][i];
            }
      }
  }


  template <int dim>
  template <int n, TransferMethod method>
  void WaterTransfer<dim>::add_water(const WaterPhase<dim> &water, Mixture<dim> &mixture, NodalField<dim> &field) const
  {
    constexpr unsigned int n_rows = RowFactors<dim, n>::n_rows;
    const double width            = grid.cell_size();
    const auto &layout            = water.layout;
    for (const auto &cell : water.points().cells())
      {
        const OpenKnots open      = grid.open_knots(cell.cell);
        const unsigned int record = mixture.record(cell.cell);
        NodeRow *moments          = mixture.water_moments(record);
        MixtureCell<dim> totals   = mixture.cells()[record];
        CellSums<dim, n> sums(width);
        NodeRow volume_before[n_rows]; // of water that rides on another body's points in this cell
        for (unsigned int r = 0; r < n_rows; ++r)
          volume_before[r] = moments[r * Mixture<dim>::n_moments];

        for_each_point(cell, [&](const auto &point) {
          const PointShape<dim, n> shape(point.reference_location, open);
          const double *properties = point.properties, *affine = properties + layout.affine;
          const double mass = properties[layout.mass], volume = properties[layout.volume];
          sums.add(shape, sums.template momentum_part<method>(shape, mass, properties + layout.velocity, affine));
          if (method == TransferMethod::tpic && viscosity > 0)
            sums.add(shape, sums.force_part(shape, volume, viscous_stress<dim>(viscosity, affine)));
          add_moments(shape, volume, moments);

          std::array<double, dim> rise;
          for (unsigned int a = 0; a < dim; ++a)
            rise[a] = pressure_slope * width * properties[layout.pressure_gradient + a];
          add_to_corners<dim>(shape.x, volume, properties[layout.pressure], rise, totals);
          totals.water_mass += mass;
          totals.water_volume += volume;
        });
        mixture.cells()[record] = totals;

        // The density of water is one for all points: mass follows from the volume's moments.
        for (unsigned int r = 0; r < n_rows; ++r)
          sums.mass(r) = water.density * (moments[r * Mixture<dim>::n_moments] - volume_before[r]);
        field.activate_cell(cell.cell);
        sums.scatter(grid.nodes(cell.cell), field);
      }
  }


  template <int dim>
  template <int n, TransferMethod method>
  double WaterTransfer<dim>::move_water(WaterPhase<dim> &water,
                                        const NodalField<dim> &field,
                                        const PressureOfCell<dim> &corner_pressure,
                                        const double time_step) const
  {
    const double keep         = kept_velocity(method, pic_rate, time_step);
    const auto &layout        = water.layout;
    const SoilBody<dim> *soil = water.carrier();

    double largest_square = 0;
    CellCosts &costs      = water.points().costs();
    costs.start_pass();
    for (const auto &cell : water.points().cells())
      {
        const OpenKnots open = grid.open_knots(cell.cell);
        const CellVelocity<dim, n> nodes(grid.nodes(cell.cell), field, grid.cell_size());
        const Multilinear<dim> pressure = multilinear_of<dim>(corner_pressure(cell.cell));

        for_each_point(cell, [&](const auto &point) {
          const PointShape<dim, n> shape(point.reference_location, open);
          double *properties  = point.properties;
          const double square = nodes.template move<method>(shape,
                                                            { properties + layout.velocity,
                                                              properties + layout.affine,
                                                              soil == nullptr ? &point.location : nullptr,
                                                              nullptr },
                                                            keep,
                                                            time_step);
          if (!(square <= largest_square)) // keeps a NaN
            largest_square = square;
          set_pressure(
              pressure, shape.x, grid.cell_size(), properties[layout.pressure], properties + layout.pressure_gradient);
          if (soil != nullptr)
            {
              properties[layout.volume] = std::max(soil->pore_volume(properties), 0.);
              properties[layout.mass]   = water.density * properties[layout.volume];
            }
        });
        costs.finish_cell(cell.cell, cell.n_points);
      }
    return std::sqrt(largest_square);
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
  void WaterTransfer<dim>::to_grid(const WaterPhase<dim> &water, Mixture<dim> &mixture, NodalField<dim> &field) const
  {
    const auto dispatch = [&](auto n) {
      switch (method)
        {
        case TransferMethod::apic:
          return add_water<n, TransferMethod::apic>(water, mixture, field);
        case TransferMethod::tpic:
          return add_water<n, TransferMethod::tpic>(water, mixture, field);
        default: // FLIP and PIC differ on the way back only.
          return add_water<n, TransferMethod::flip>(water, mixture, field);
        }
    };
    if (grid.n_nodes_1d() == 2)
      dispatch(std::integral_constant<int, 2>());
    else
      dispatch(std::integral_constant<int, 3>());
  }


  template <int dim>
  double WaterTransfer<dim>::to_points(WaterPhase<dim> &water,
                                       const NodalField<dim> &field,
                                       const PressureOfCell<dim> &pressure,
                                       const double time_step) const
  {
    const auto dispatch = [&](auto n) {
      switch (method)
        {
        case TransferMethod::flip:
          return move_water<n, TransferMethod::flip>(water, field, pressure, time_step);
        case TransferMethod::pic:
          return move_water<n, TransferMethod::pic>(water, field, pressure, time_step);
        case TransferMethod::apic:
          return move_water<n, TransferMethod::apic>(water, field, pressure, time_step);
        default:
          return move_water<n, TransferMethod::tpic>(water, field, pressure, time_step);
        }
    };
    if (grid.n_nodes_1d() == 2)
      return dispatch(std::integral_constant<int, 2>());
    return dispatch(std::integral_constant<int, 3>());
  }

  template class WaterTransfer<2>;
  template class WaterTransfer<3>;
} // namespace scree

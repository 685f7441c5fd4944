// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/transfer/affine_field.h>
#include <scree/transfer/cell_velocity.h>
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

    /// Adds the moments of a volume at a place of the cell to rows of nodes.
    template <int dim, int n>
    void add_moments(const RowFactors<dim, n> &rows,
                     const NodeRow &volume_x,
                     const std::array<double, Mixture<dim>::n_moments> &powers,
                     NodeRow *moments)
    {
      for (unsigned int r = 0; r < RowFactors<dim, n>::n_rows; ++r)
        {
          const NodeRow volume = volume_x * rows.value[r];
          for (unsigned int m = 0; m < Mixture<dim>::n_moments; ++m)
            *moments++ += volume * powers[m];
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
      , follows_porosity(water.conductivity_law == "Kozeny-Carman")
      , viscosity(water.viscosity)
      , pressure_slope(pressure_slope)
  {
  }


  template <int dim>
  double WaterTransfer<dim>::conductivity(const double porosity, const double initial_porosity) const
  {
    if (!follows_porosity)
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

        const double *properties = cell.properties;
        for (unsigned int p = 0; p < cell.n_points; ++p, properties += soil.points.stride())
          {
            const Point<dim> &x = cell.reference_location[p];
            const CellBasis<dim, n> basis(x, open);
            const RowFactors<dim, n> rows(basis);
            const NodeRow value_x = make_row(basis.value[0]);

            const double mass           = properties[layout.mass];
            const double volume         = properties[layout.volume];
            const double grains         = mass / soil.grain_density;
            const double porosity       = std::max(1. - grains / volume, smallest_porosity);
            const double pores_of_point = porosity * volume;
            const double drag = pores_of_point * porosity * unit_weight / conductivity(porosity, initial_porosity);

            add_moments<dim, n>(rows, value_x * grains, monomials(x), moments);
            const NodeRow pore_x = value_x * pores_of_point, drag_x = value_x * drag;
            for (unsigned int r = 0; r < n_rows; ++r)
              {
                pore_sums[r] += pore_x * rows.value[r];
                drag_sums[r] += drag_x * rows.value[r];
              }
            const auto corners = corner_values(x);
            for (unsigned int v = 0; v < corners.size(); ++v)
              sums.grains_at_corner[v] += grains * corners[v];
            sums.soil_mass += mass;
            sums.grain_volume += grains;
            sums.pore_volume += pores_of_point;
            sums.drag += drag;
          }
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
    constexpr bool is_affine      = method == TransferMethod::apic || method == TransferMethod::tpic;
    constexpr unsigned int n_rows = RowFactors<dim, n>::n_rows;
    const double width            = grid.cell_size();
    const auto &layout            = water.layout;
    for (const auto &cell : water.points().cells())
      {
        const OpenKnots open               = grid.open_knots(cell.cell);
        const unsigned int record          = mixture.record(cell.cell);
        NodeRow *moments                   = mixture.water_moments(record);
        MixtureCell<dim> sums              = mixture.cells()[record];
        NodeRow momentum_sums[n_rows][dim] = {}, force_sums[n_rows][dim] = {};
        NodeRow volume_before[n_rows]; // of water that rides on another body's points in this cell
        for (unsigned int r = 0; r < n_rows; ++r)
          volume_before[r] = moments[r * Mixture<dim>::n_moments];

        const double *properties = cell.properties;
        for (unsigned int p = 0; p < cell.n_points; ++p, properties += water.points().stride())
          {
            const Point<dim> &x = cell.reference_location[p];
            const CellBasis<dim, n> basis(x, open);
            const RowFactors<dim, n> rows(basis);
            const NodeRow value_x = make_row(basis.value[0]);
            const double mass = properties[layout.mass], volume = properties[layout.volume];
            const double *affine = properties + layout.affine;

            NodeRow momentum[dim];
            for (unsigned int c = 0; c < dim; ++c)
              momentum[c] = value_x * (mass * properties[layout.velocity + c]);
            if constexpr (is_affine)
              add_affine_momentum<method>(basis,
                                          rows,
                                          open,
                                          x,
                                          width,
                                          mass,
                                          affine,
                                          momentum,
                                          [&](const unsigned int r, const unsigned int c, const NodeRow &part) {
                                            momentum_sums[r][c] += part;
                                          });
            for (unsigned int r = 0; r < n_rows; ++r)
              for (unsigned int c = 0; c < dim; ++c)
                momentum_sums[r][c] += momentum[c] * rows.value[r];

            if (method == TransferMethod::tpic && viscosity > 0)
              {
                // Newtonian: 2 mu dev(sym grad v), incompressible beside the pressure
                const NodeRow derivative_x = make_row(basis.derivative[0]);
                double trace               = 0;
                for (unsigned int c = 0; c < dim; ++c)
                  trace += affine[c * dim + c];
                for (unsigned int c = 0; c < dim; ++c)
                  for (unsigned int a = 0; a < dim; ++a)
                    {
                      const double stress =
                          viscosity * (affine[c * dim + a] + affine[a * dim + c] - (a == c ? 2. / 3. * trace : 0.));
                      const NodeRow along = (a == 0 ? derivative_x : value_x) * (-volume / width * stress);
                      for (unsigned int r = 0; r < n_rows; ++r)
                        force_sums[r][c] += along * (a == 0 ? rows.value[r] : rows.derivative[a - 1][r]);
                    }
              }

            add_moments<dim, n>(rows, value_x * volume, monomials(x), moments);

            const auto corners       = corner_values(x);
            const double *gradient   = properties + layout.pressure_gradient;
            double pressure_at_lower = properties[layout.pressure];
            std::array<double, dim> rise;
            for (unsigned int a = 0; a < dim; ++a)
              {
                rise[a] = pressure_slope * width * gradient[a];
                pressure_at_lower -= rise[a] * x[a];
              }
            for (unsigned int v = 0; v < corners.size(); ++v)
              {
                double pressure = pressure_at_lower;
                for (unsigned int a = 0; a < dim; ++a)
                  if ((v >> a) & 1)
                    pressure += rise[a];
                sums.water_at_corner[v] += volume * corners[v];
                sums.pressure_at_corner[v] += volume * corners[v] * pressure;
              }
            sums.water_mass += mass;
            sums.water_volume += volume;
          }
        mixture.cells()[record] = sums;

        field.activate_cell(cell.cell);
        const unsigned int *nodes = grid.nodes(cell.cell);
        for (unsigned int r = 0; r < n_rows; ++r)
          for (unsigned int i = 0; i < n; ++i)
            {
              double *node = field[nodes[r * n + i]];
              // The density of water is one for all points: mass follows from the volume's moments.
              node[NodalField<dim>::mass] +=
                  water.density * (moments[r * Mixture<dim>::n_moments][i] - volume_before[r][i]);
              for (unsigned int c = 0; c < dim; ++c)
                {
                  node[NodalField<dim>::momentum + c] += momentum_sums[r][c][i];
                  node[NodalField<dim>::force + c] += force_sums[r][c][i];
                }
            }
      }
  }


  template <int dim>
  template <int n, TransferMethod method>
  double WaterTransfer<dim>::move_water(WaterPhase<dim> &water,
                                        const NodalField<dim> &field,
                                        const PressureOfCell<dim> &corner_pressure,
                                        const double time_step) const
  {
    const double width        = grid.cell_size();
    const double keep         = method == TransferMethod::flip ? std::exp(-pic_rate * time_step) : 0.;
    const auto &layout        = water.layout;
    const SoilBody<dim> *soil = water.carrier();

    double largest_square = 0;
    CellCosts &costs      = water.points().costs();
    costs.start_pass();
    for (const auto &cell : water.points().cells())
      {
        const OpenKnots open = grid.open_knots(cell.cell);
        const CellVelocity<dim, n> nodes(grid.nodes(cell.cell), field);
        const Multilinear<dim> pressure = multilinear_of<dim>(corner_pressure(cell.cell));

        double *properties = cell.properties;
        for (unsigned int p = 0; p < cell.n_points; ++p, properties += water.points().stride())
          {
            const Point<dim> &x = cell.reference_location[p];
            const CellBasis<dim, n> basis(x, open);
            const RowFactors<dim, n> rows(basis);
            const NodeRow value_x = make_row(basis.value[0]), derivative_x = make_row(basis.derivative[0]);

            double square = 0;
            for (unsigned int c = 0; c < dim; ++c)
              {
                const NodeRow along   = contract(rows.value, nodes.velocity[c]);
                const double velocity = sum(along * value_x);
                double &own           = properties[layout.velocity + c];
                if (method == TransferMethod::flip)
                  own = keep * (own + sum(contract(rows.value, nodes.change[c]) * value_x)) + (1. - keep) * velocity;
                else
                  own = velocity;
                if (soil == nullptr)
                  cell.location[p][c] += time_step * velocity;
                square += own * own;

                double *affine = properties + layout.affine + c * dim;
                if constexpr (method == TransferMethod::apic)
                  affine_moment<dim, n>(basis, rows, open, x, width, nodes.velocity[c], affine);
                if constexpr (method == TransferMethod::tpic)
                  {
                    affine[0] = sum(along * derivative_x) / width;
                    for (unsigned int a = 1; a < dim; ++a)
                      affine[a] = sum(contract(rows.derivative[a - 1], nodes.velocity[c]) * value_x) / width;
                  }
              }
            if (!(square <= largest_square)) // keeps a NaN
              largest_square = square;

            const auto powers = monomials(x);
            double value      = pressure.back();
            for (unsigned int a = 0; a < dim; ++a)
              value *= x[a];
            for (unsigned int m = 0; m < powers.size(); ++m)
              value += pressure[m] * powers[m];
            properties[layout.pressure] = value;
            for (unsigned int a = 0; a < dim; ++a)
              {
                double slope = 0;
                for (unsigned int m = 0; m < powers.size(); ++m)
                  if (!((m >> a) & 1))
                    slope += pressure[m | (1 << a)] * powers[m];
                properties[layout.pressure_gradient + a] = slope / width;
              }

            if (soil != nullptr)
              {
                properties[layout.volume] = std::max(soil->pore_volume(properties), 0.);
                properties[layout.mass]   = water.density * properties[layout.volume];
              }
          }
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

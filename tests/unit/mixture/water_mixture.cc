// SPDX-License-Identifier: LGPL-2.1-or-later

// Soil and water in one grid, for every basis, on one rank and on two: the moments give the pressure's force that a
// walk over the points gives; a linear pressure comes back from points that lie anyhow; the mixture's divergence is
// exact for linear motion, and a mixture that moves as one draws nothing, wherever its surface is; the solver finds the
// pressure whose flux it is given.

#include "../elastic_soil.h"
#include "../pattern.h"

#include <scree/seeding/water_seeding.h>
#include <scree/mixture/closures.h>
#include <scree/pressure/divergence.h>
#include <scree/pressure/pore_pressure.h>
#include <scree/pressure/pressure_solver.h>

#include <deal.II/base/geometry_info.h>
#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "../unit_test.h"

namespace test_water_mixture
{
using namespace dealii;
using namespace scree;

namespace
{
  double largest(const double value)
  {
    return Utilities::MPI::max(value, MPI_COMM_WORLD);
  }

  template <int dim>
  double linear(const Point<dim> &x)
  {
    return 5. - 3. * x[0] + 2. * x[1] - (dim == 3 ? x[2] : 0.);
  }
} // namespace

template <int dim, int n>
void test(const std::string &basis, std::ostream &out)
{
  GridParameters grid_parameters;
  grid_parameters.basis = basis;
  grid_parameters.lower_corner.assign(dim, 0.);
  grid_parameters.upper_corner.assign(dim, 0.6);
  const BackgroundGrid<dim> grid(grid_parameters, MPI_COMM_WORLD);
  NodeNumbering<dim> corners(Basis::linear);
  corners.distribute(grid.fine_cells());

  // Soil stands in water; the surface of the water lies inside the cells.
  constexpr unsigned int n_points = 2; // of the soil in a cell along each axis
  constexpr double porosity       = 0.4;
  ElasticSoil<dim> soil(grid, "x < 0.33", n_points, porosity);
  WaterParameters water_parameters;
  water_parameters.region          = "y < 0.44";
  water_parameters.points_per_cell = 3;
  WaterPhase<dim> water(1000., false, grid.triangulation(), grid.mapping());
  seed_water(water,
             water_parameters,
             { { "Soil", "x < 0.33", porosity, soil.density } },
             grid.triangulation(),
             grid.cell_size());

  const auto shake = [&](PointSet<dim> &points) {
    for_each_point(points, [&](const auto &point) {
      const Point<dim> x = point.location;
      for (unsigned int a = 0; a < dim; ++a)
        point.location[a] += 0.01 * pattern(x + Point<dim>::unit_vector(a));
    });
    points.hand_over();
  };
  shake(soil.points);
  shake(water.points());
  for_each_point(water.points(), [&](const auto &point) {
    double *properties                = point.properties;
    properties[water.layout.pressure] = linear(point.location);
    double *gradient                  = properties + water.layout.pressure_gradient;
    gradient[0]                       = -3.;
    gradient[1]                       = 2.;
    if (dim == 3)
      gradient[2] = -1.;
  });

  TransferParameters transfer_parameters;
  transfer_parameters.method = "FLIP"; // The points have no room for a gradient.
  soil.drag.emplace(water_parameters, porosity);
  const WaterTransfer<dim> transfer(grid, transfer_parameters, water_parameters, 1.);
  Mixture<dim> mixture(grid, n_points);
  PoreField<dim> pores(grid);
  NodalField<dim> soil_field(grid), water_field(grid), excess(grid);
  transfer.soil_to_grid(soil, mixture);
  transfer.to_grid(water, mixture, water_field, excess, pores);
  mixture.finish();

  // 1. A multilinear pressure in every cell: moments against points.
  NodeValues<dim, 2 * dim> moments(grid.numbering()), points(grid.numbering());
  const auto pressure_of_cell = [&](const unsigned int cell) {
    std::array<double, (1 << dim)> values;
    for (unsigned int v = 0; v < values.size(); ++v)
      values[v] = pattern(corners.position(corners.nodes(cell)[v]));
    return values;
  };
  std::map<unsigned int, double> saturation;
  for (unsigned int record = 0; record < mixture.cells().size(); ++record)
    {
      const auto &cell      = mixture.cells()[record];
      saturation[cell.cell] = cell.effective_saturation;
      moments.activate_cell(cell.cell);
      points.activate_cell(cell.cell);
      mixture.add_pressure_gradient(
          record, multilinear_of<dim>(pressure_of_cell(cell.cell)), 1., moments, 0, moments, dim);
    }
  const auto walk = [&](const PointSet<dim> &set, const unsigned int first, const auto &volume_of) {
    for_each_point(set, [&](const auto &point) {
      const auto values   = pressure_of_cell(point.cell);
      const Point<dim> &x = point.reference_location;
      Tensor<1, dim> slope;
      for (unsigned int v = 0; v < values.size(); ++v)
        for (unsigned int a = 0; a < dim; ++a)
          {
            double factor = values[v] * ((v >> a) & 1 ? 1. : -1.) / grid.cell_size();
            for (unsigned int b = 0; b < dim; ++b)
              if (b != a)
                factor *= (v >> b) & 1 ? x[b] : 1. - x[b];
            slope[a] += factor;
          }
      const double volume = volume_of(point.cell, point.properties);
      const CellBasis<dim, n> shape(x, grid.open_knots(point.cell));
      for (unsigned int i = 0; i < CellBasis<dim, n>::n_nodes; ++i)
        {
          double value = 1.;
          for (unsigned int a = 0, rest = i; a < dim; ++a, rest /= n)
            value *= shape.value[a][rest % n];
          for (unsigned int a = 0; a < dim; ++a)
            points[grid.nodes(point.cell)[i]][first + a] += volume * value * slope[a];
        }
    });
  };
  walk(soil.points, 0, [&](const unsigned int cell, const double *properties) {
    return saturation[cell] * properties[soil.layout.mass] / soil.grain_density;
  });
  walk(water.points(), dim, [&](const unsigned int, const double *properties) {
    return properties[water.layout.volume];
  });
  moments.add_contributions();
  points.add_contributions();
  double difference = 0, size = 0;
  for (const unsigned int node : moments.active_nodes())
    for (unsigned int c = 0; c < 2 * dim; ++c)
      {
        difference = std::max(difference, std::abs(moments[node][c] - points[node][c]));
        size       = std::max(size, std::abs(points[node][c]));
      }
  out << "  moments and points: " << (largest(difference) < 1e-12 * largest(size) ? "same force" : "DIFFERENT FORCES")
      << std::endl;

  // 2. A linear pressure.
  WaterBoundaryParameters wall_parameters;
  wall_parameters.top = "impermeable";
  const WaterBoundaryConditions<dim> walls(grid, wall_parameters);
  FreeSurface<dim> surface(grid, corners, walls, Tensor<1, dim>(), nullptr);
  VertexVector pressure(corners.partitioner());
  surface.locate(mixture, pressure);
  double error = 0, unknowns = 0;
  for (const unsigned int corner : surface.wet_vertices())
    if (surface.kind(corner) == PressureDofType::unknown)
      {
        ++unknowns;
        error = std::max(error, std::abs(pressure.local_element(corner) - linear(corners.position(corner))));
      }
  out << "  linear pressure from shaken points: " << (largest(error) < 1e-12 ? "exact" : "WRONG") << " at "
      << Utilities::MPI::sum(unknowns, MPI_COMM_WORLD) << " unknown corners" << std::endl;

  // 3. Divergence: linear motion of both phases, then translation of both. That of a partly full cell with soil belongs
  // to the middle of the box around its material, from .85 to .95 of the cell to a place on the way to the cell's own.
  struct Content
  {
    Point<dim> moment;
    double volume = 0.;
  };
  std::map<unsigned int, Content> contents;
  const auto count = [&](const auto &point, const double volume) {
    contents[point.cell].moment += volume * point.reference_location;
    contents[point.cell].volume += volume;
  };
  for_each_point(soil.points, [&](const auto &point) {
    count(point, saturation[point.cell] * point.properties[soil.layout.mass] / soil.grain_density);
  });
  for_each_point(water.points(), [&](const auto &point) { count(point, point.properties[water.layout.volume]); });
  const auto middle_of_box = [&](const MixtureCell<dim> &cell) {
    const Content &content = contents[cell.cell];
    const double share     = cell.soil_mass > 0. ? std::clamp((0.95 - cell.fill) / 0.1, 0., 1.) : 0.;
    Point<dim> middle;
    for (unsigned int a = 0; a < dim; ++a)
      middle[a] = 0.5 + share * (content.moment[a] / content.volume - 0.5);
    return middle;
  };
  constexpr double gravity = 9.81;
  const GroundGaps<dim> no_ground(grid, nullptr, gravity);
  MixtureDivergence<dim> divergence(grid, corners, surface, gravity, nullptr, no_ground);
  const auto set_motion = [&](const bool moves_as_one, const double factor) {
    // Nodes of all cells, so that absent phases move along.
    for (NodalField<dim> *field : { &soil_field, &water_field })
      {
        for (const auto &cell : mixture.cells())
          field->activate_cell(cell.cell);
        field->add_contributions();
        for (const unsigned int node : field->active_nodes())
          for (unsigned int a = 0; a < dim; ++a)
            (*field)[node][NodalField<dim>::velocity + a] =
                factor * (moves_as_one
                              ? 2. + a
                              : (a + 1.) * grid.node_position(node)[a] + grid.node_position(node)[1 - (a % 2)]);
        field->update_ghosts();
      }
  };
  const double trace = dim == 2 ? 3. : 6.;
  const auto drawn   = [&](const bool moves_as_one) {
    set_motion(moves_as_one, 1.);
    VertexVector sums(corners.partitioner());
    divergence.integrate(mixture, soil_field, water_field, pores, 1e-3, sums);
    VertexVector expected(corners.partitioner());
    for (const auto &cell : mixture.cells())
      if (cell.water_volume > 0 && !moves_as_one)
        for (unsigned int v = 0; v < cell.n_vertices; ++v)
          expected.local_element(corners.nodes(cell.cell)[v]) -=
              trace * std::min(cell.fill, 1.) * Utilities::fixed_power<dim>(grid.cell_size()) *
              GeometryInfo<dim>::d_linear_shape_function(middle_of_box(cell), v);
    expected.compress(VectorOperation::add);
    sums -= expected;
    return sums.linfty_norm() / Utilities::fixed_power<dim>(grid.cell_size());
  };
  out << "  divergence of linear motion: " << (drawn(false) < 1e-12 ? "exact" : "WRONG")
      << ", of translation: " << (drawn(true) < 1e-12 ? "none" : "WRONG") << std::endl;

  // 4. Soil whose cells close fast keeps the part of its volume that its water holds; not where they open.
  constexpr double time_step = 1e-3;
  SoilGaps<dim> gaps(grid, corners, surface); // none
  gaps.find(mixture);
  double n_kept = 0, off = 0;
  for (const double factor : { 1., -1. })
    {
      set_motion(false, factor);
      divergence.find_volume_factors(mixture, soil_field, water_field, pores, gaps, time_step);
      for (const auto &cell : mixture.cells())
        {
          double expected = 1.;
          if (factor < 0. && cell.soil_mass > 0. && cell.effective_saturation == 1. && surface.has_unknown(cell.cell))
            {
              const double held = time_step * cell.drag / (time_step * cell.drag + cell.water_mass);
              const double fast = 1. / (1. + gravity / grid.cell_size() / (trace * trace));
              expected          = std::exp(held * fast * trace * time_step);
              ++n_kept;
            }
          off = std::max(off, std::abs(cell.volume_factor - expected));
        }
    }
  out << "  soil keeps its volume where cells close: " << (largest(off) < 1e-12 ? "exact" : "WRONG") << " in "
      << Utilities::MPI::sum(n_kept, MPI_COMM_WORLD) << " cells" << std::endl;

  // 5. Mobility of cells: the flow that a unit impulse of the pressure gradient gives to both phases, coupled by the
  // drag of the water that lies in pores.
  std::vector<MixtureCell<dim>> before(mixture.cells().begin(), mixture.cells().end());
  TimerOutput timer(std::cout, TimerOutput::never, TimerOutput::wall_times);
  Budget<dim> balance;
  PorePressure<dim> pore_pressure(
      grid, walls, PressureParameters(), water_parameters, Tensor<1, dim>(), nullptr, no_ground, timer);
  pore_pressure.locate(mixture);
  pore_pressure.solve(mixture, { soil_field, water_field, pores }, time_step, 0., balance);
  double n_partly = 0;
  off             = 0;
  for (unsigned int record = 0; record < before.size(); ++record)
    {
      const MixtureCell<dim> &cell = before[record];
      if (cell.water_volume == 0.)
        continue;
      const double V_s = cell.effective_saturation * cell.grain_volume, V_w = cell.water_volume;
      const double wet_pores = cell.effective_saturation * cell.pore_volume;
      double flow            = V_w * V_w / cell.water_mass; // V . v
      if (cell.soil_mass > 0.)
        {
          const double C = time_step * (1. - grain_fraction_of(V_s, V_w, wet_pores)) * cell.drag_share * cell.drag;
          Tensor<2, 2> masses;
          masses[0][0] = cell.soil_mass + C;
          masses[1][1] = cell.water_mass + C;
          masses[0][1] = masses[1][0] = -C;
          const Tensor<1, 2> volumes({ V_s, V_w });
          flow = volumes * (invert(masses) * volumes);
          n_partly += cell.drag_share > 0. && cell.drag_share < 0.9;
        }
      const double expected = flow / (Utilities::fixed_power<dim>(grid.cell_size()) * std::min(cell.fill, 1.));
      off                   = std::max(off, std::abs(mixture.cells()[record].mobility / expected - 1.));
    }
  out << "  mobility of cells: " << (largest(off) < 1e-12 ? "exact" : "WRONG") << ", with a part of the drag in "
      << Utilities::MPI::sum(n_partly, MPI_COMM_WORLD) << std::endl;

  // 6. The solver: a unit source at every unknown corner is what the found pressure carries away.
  for (MixtureCell<dim> &cell : mixture.cells())
    cell.mobility = 1e-3 * (1. + 0.5 * pattern(corners.position(corners.nodes(cell.cell)[0])));
  constexpr double relative_tolerance = 1e-12;
  PressureSolver<dim> solver(grid, corners, PressureParameters());
  VertexVector source(corners.partitioner()), change(corners.partitioner());
  for (const unsigned int corner : surface.wet_vertices())
    if (surface.kind(corner) == PressureDofType::unknown)
      source.local_element(corner) = surface.volume_under(corner);
  double work[2];
  for (double &sum : work)
    {
      solver.assemble(
          mixture, surface, 1e-3, [](const unsigned int) { return 0.; }, 0.);
      const SolveReport report = solver.solve(source, pressure, relative_tolerance, change);
      sum                      = source * change;
      if (&sum == work)
        out << "  solved with a preconditioner made: " << (report.made_preconditioner ? "yes" : "NO");
      else
        out << "; again from the solution: " << report.n_iterations << " iterations" << std::endl;
    }
  out << "  work of the source: " << work[0]
      << ", same again: " << (std::abs(work[0] - work[1]) < 1e-9 * work[0] ? "yes" : "NO") << std::endl;
}


void run()
{
  std::ostream silent(nullptr);
  std::ostream &out = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0 ? std::cout : silent;
  out.precision(10);
  out << "spline, 2D" << std::endl;
  test<2, 3>("spline", out);
  out << "spline, 3D" << std::endl;
  test<3, 3>("spline", out);
  out << "linear, 2D" << std::endl;
  test<2, 2>("linear", out);
}

const UnitTest registered("water_mixture", run);
} // namespace test_water_mixture

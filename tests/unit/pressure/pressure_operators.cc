// SPDX-License-Identifier: LGPL-2.1-or-later
// The matrix of pressures and tractions, for scattered points of soil and water whose surface lies inside cells, for
// every basis: the filled part is a half plane's where the depth is linear; the matrix is symmetric and positive; a
// row's own flow is its diagonal, and the preconditioner of the rows is the inverse up to 1. (That divergence and force
// are transposes, forces add up to 0 and rigid motion has no divergence: scenes/wet_step, infiltration,
// obstacle_moving_tank.)
#include "../soil.h"

#include <scree/pressure/operators.h>

namespace test_pressure_operators
{
/// Water up to y = 0.44 m in a box of 6 cells an axis, with elastic soil of porosity 0.4 on the left, points off their
/// lattice.
template <int dim>
class Scene
{
public:
  explicit Scene(const std::string &basis)
      : grid(grid_box<dim>(0., 0.6, 0.1, basis), MPI_COMM_WORLD)
      , soil(grid, "x < 0.33", 2, 0.4)
      , water(1000., true, grid.triangulation(), grid.mapping())
      , mixture(grid, 2)
  {
    WaterParameters parameters;
    parameters.region          = "y < 0.44";
    parameters.points_per_cell = 3;
    seed_water(water, parameters, { { "Soil", "x < 0.33", 0.4, soil.density } }, { grid.triangulation(), 0.1 });
    TransferParameters flip;
    flip.method   = "FLIP";
    flip.pic_rate = 0;
    soil.drag.emplace(parameters, 0.4);
    for (PointSet<dim> *points : { &soil.points, &water.points() })
      {
        for_each_point(*points, [](const auto &point) {
          const Point<dim> x = point.location;
          for (unsigned int a = 0; a < dim; ++a)
            point.location[a] += 0.01 * pattern(x + Point<dim>::unit_vector(a));
        });
        points->hand_over();
      }
    const WaterTransfer<dim> transfer(grid, flip, parameters);
    transfer.soil_to_grid(soil, mixture);
    transfer.to_grid(water, mixture, nodes);
    for (const auto &cell : mixture.cells())
      nodes.activate_cell(cell.cell);
    nodes.add_contributions(1.);
    surface.locate(mixture, pressure);
    operators.integrate(
        mixture,
        [&](const unsigned int node) {
          return nodes.water[node][NodalField<dim>::mass] / 1000. + nodes.pores[node][Pores::local_solid_volume];
        },
        [](const unsigned int, const unsigned int) { return false; },
        time_step);
    for (MixtureCell<dim> &cell : mixture.cells())
      cell.mobility = 1e-3;
    // Two masses and their drag, soil alone, water alone, water that does not see the grains of the soil beside it.
    constexpr double with_soil_unseen = 0.7;
    const auto kind_of                = [&](const unsigned int node) { return pattern(grid.node_position(node)); };
    for (const unsigned int node : nodes.active())
      {
        const double kind                        = kind_of(node);
        const double n                           = kind < -0.5 ? 0. : kind > 0.5 ? 1. : 0.7 + 0.2 * kind;
        nodes.pores[node][Pores::grain_fraction] = 1. - n;
        nodes.soil[node][NodalField<dim>::mass]  = n < 1. || kind > with_soil_unseen;
        nodes.water[node][NodalField<dim>::mass] = n > 0.;
      }
    nodes.update_velocity_ghosts();
    nodes.pores.update_ghosts();
    add_rows();
    const auto block_at = [&](const unsigned int node) {
      DragBlock<dim> block;
      block.soil_mass  = nodes.has_soil(node) ? 1.5 + kind_of(node) : 0.;
      block.water_mass = nodes.has_water(node) ? 1. + pattern(2. * grid.node_position(node)) / 2. : 0.;
      block.drag       = nodes.porosity(node) < 1. ? 10. : 0.;
      return block;
    };
    operators.assemble(mixture, nodes, block_at, &rows, time_step);
  }

  /// Soil and water at a facet in each wet cell.
  void add_rows()
  {
    facets.reserve(operators.filled_part().cells().size());
    for (const auto &cell : operators.filled_part().cells())
      {
        const Point<dim> x = grid.node_position(grid.nodes(cell.cell)[0]);
        CutFacet<dim> facet;
        facet.cell      = cell.cell;
        facet.normal[0] = 0.6;
        facet.normal[1] = -0.8;
        for (unsigned int i = 0; i < grid.n_nodes_per_cell(); ++i)
          facet.shapes.push_back((1. + 0.5 * pattern((i + 1.) * x)) / grid.n_nodes_per_cell());
        facets.push_back(facet);
        for (const Phase phase : { Phase::soil, Phase::water })
          {
            GroundRow<dim> row{};
            row.phase  = phase;
            row.area   = 0.1 + 0.05 * pattern(x);
            row.normal = facet.normal;
            rows.add(row, facets.back(), 0.5, phase == Phase::soil ? nodes.soil : nodes.water, &nodes);
          }
      }
  }

  /// A traction a row.
  typename GroundRows<dim>::Vectors tractions(const double factor) const
  {
    typename GroundRows<dim>::Vectors result(rows.all.size());
    for (unsigned int k = 0; k < result.size(); ++k)
      for (unsigned int c = 0; c < dim; ++c)
        result[k][c] = pattern(factor * (k % 2 + 1.) * grid.node_position(grid.nodes(facets[k / 2].cell)[c]));
    return result;
  }

  static constexpr double time_step = 0.01;

  const BackgroundGrid<dim> grid;
  ElasticSoil<dim> soil;
  WaterPhase<dim> water;
  Mixture<dim> mixture;
  NodalField<dim> soil_field{ grid };
  WetNodes<dim> nodes{ grid, soil_field };

  const NodeNumbering<dim> corners = numbered(grid);
  const BoundaryConditions<dim> walls{ grid, WaterBoundaryParameters() };
  FreeSurface<dim> surface{ grid, corners, walls, nullptr };
  const GroundGaps<dim> gaps{ grid, nullptr, 0. };
  std::vector<CutFacet<dim>> facets;
  GroundRows<dim> rows{ grid };
  PressureOperators<dim> operators{ grid, corners, surface, nullptr, gaps };
  VertexVector pressure{ corners.partitioner() };

private:
  static NodeNumbering<dim> numbered(const BackgroundGrid<dim> &grid)
  {
    NodeNumbering<dim> corners(Basis::linear);
    corners.distribute(grid.fine_cells());
    return corners;
  }
};


/// @param volume of the filled part, m^dim
/// @param energies p.(S p) of the pressures below, without and with tractions
template <int dim>
void test(const std::string &basis, const double volume, const std::vector<double> &energies)
{
  const std::string name = std::to_string(dim) + "D, " + basis + ": ";
  Scene<dim> scene(basis);
  double filled = 0.;
  for (const auto &cell : scene.operators.filled_part().cells())
    filled += cell.fraction * std::pow(scene.grid.cell_size(), dim);
  expect(sum_of_ranks(filled), volume, 1e-6, name + "filled part");

  // Symmetry: q.(S p) = p.(S q), and p.(S p) > 0; the same of pressures and tractions together.
  PressuresAndTractions<dim> first, second, s_first, s_second;
  for (const unsigned int vertex : scene.surface.unknowns())
    {
      first.pressures.push_back(pattern(scene.corners.position(vertex)));
      second.pressures.push_back(pattern(3. * scene.corners.position(vertex)));
    }
  for (const bool has_rows : { false, true })
    {
      if (has_rows)
        {
          first.tractions  = scene.tractions(1.);
          second.tractions = scene.tractions(3.);
        }
      scene.operators.vmult(s_first, first);
      scene.operators.vmult(s_second, second);
      const double square = sum_of_ranks(first * s_first);
      expect(square / energies[has_rows], 1., 1e-5, name + "p.(S p) over that before");
      expect(sum_of_ranks(second * s_first - first * s_second) / square, 0., 1e-11, name + "q.(S p) - p.(S q)");
    }

  // A traction of 1 along an axis at one row of soil, of one rank after the other: its own flow is the diagonal.
  scene.rows.set_responses(scene.operators.inverse_masses(), Scene<dim>::time_step);
  const unsigned int n_rows = scene.rows.all.size(), most_rows = Utilities::MPI::max(n_rows, MPI_COMM_WORLD);
  for (unsigned int rank = 0; rank < Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD); ++rank)
    for (unsigned int k = 0; k < std::min(most_rows, 40u); k += 2)
      {
        first.clear(first.pressures.size(), n_rows);
        const bool is_own = rank == Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) && k < n_rows;
        if (is_own)
          first.tractions[k][0] = 1.;
        scene.operators.vmult(s_first, first);
        if (is_own)
          expect(s_first.tractions[k][0] / scene.rows.all[k].diagonal,
                 1.,
                 1e-11,
                 name + "flow of a row over the diagonal");
      }

  // The preconditioner of the rows, with friction at some: symmetric, and the inverse up to 1 (Gauss-Seidel).
  for (unsigned int k = 0; k < n_rows; ++k)
    {
      GroundRow<dim> &row = scene.rows.all[k];
      row.holds_across    = k % 3 != 2;
      row.holds_along     = k % 3 == 1;
      row.compliance      = row.holds_along ? 0.5 * row.diagonal : 0.;
    }
  PressuresAndTractions<dim> flows_a, flows_b, of_a, of_b;
  flows_a.tractions = scene.tractions(1.);
  flows_b.tractions = scene.tractions(3.);
  scene.rows.precondition(flows_a.tractions, of_a.tractions);
  scene.rows.precondition(flows_b.tractions, of_b.tractions);
  const double used = sum_of_ranks(of_a * flows_a);
  require(used > 0., name + "The preconditioner of the rows is not positive.");
  expect(sum_of_ranks(of_a * flows_b - of_b * flows_a) / used,
         0.,
         1e-12,
         name + "symmetry of the preconditioner of the rows");
  for (unsigned int k = 0; k < n_rows; ++k)
    {
      const Tensor<1, dim> &traction = of_a.tractions[k];
      expect((traction - scene.rows.all[k].held_part(traction)).norm(),
             0.,
             1e-12 * traction.norm(),
             name + "free traction");
    }
  of_a.pressures.assign(first.pressures.size(), 0.);
  scene.operators.vmult(s_first, of_a);
  for (unsigned int k = 0; k < n_rows; ++k)
    s_first.tractions[k] += scene.rows.all[k].compliance * scene.rows.all[k].along(of_a.tractions[k]);
  const double quotient = sum_of_ranks(of_a * s_first) / used;
  require(quotient > 0.1 && quotient < 1. + 1e-12,
          name + "Quotient of the preconditioned rows: " + std::to_string(quotient));
}


const UnitTest registered("pressure_operators", [] {
  test<2>("spline", 0.262347, { 0.000816676, 0.00115534 });
  test<3>("spline", 0.157837, { 2.87803e-05, 0.00316607 });
  test<2>("linear", 0.262347, { 0.000629316, 0.00190413 });
  test<3>("linear", 0.157837, { 3.45843e-05, 0.00937255 });
});
} // namespace test_pressure_operators

// Runs with mpirun=1,2.

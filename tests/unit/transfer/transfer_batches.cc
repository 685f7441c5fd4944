// SPDX-License-Identifier: LGPL-2.1-or-later
// The pass from the nodes to the points, in batches, against the same pass written down point by point, step by step:
// for every basis, transfer, F-bar and law, with cells of one point, batches that are not full and points without
// stress. Nodes move at random.
#include "../test.h"

#include <scree/materials/laws/nor_sand.h>
#include <scree/materials/laws/linear_elastic.h>
#include <scree/materials/table.h>
#include <scree/seeding/seeding.h>
#include <scree/tensor/invariants.h>
#include <scree/tensor/matrix.h>
#include <scree/transfer/transfer.h>

#include <deal.II/base/symmetric_tensor.h>

#include <array>
#include <map>

#include "../materials/one_point.h"

namespace test_transfer_batches
{
constexpr double time_step = 1e-3, density = 1000., pic_rate = 20.;

/// A point as the reference has it.
template <int dim>
struct Reference
{
  std::vector<double> properties;
  Point<dim> location;
  Tensor<2, dim> increment;
  double volume_change, stretch;
};


/// Velocity, place and gradient of a point from the nodes.
template <int dim>
Reference<dim> moved(const CellPoints<dim> &cell,
                     const unsigned int p,
                     const BackgroundGrid<dim> &grid,
                     const NodalField<dim> &field,
                     const PropertyLayout<dim> &layout,
                     const std::string &method)
{
  const double *old  = cell.properties_of(p);
  const Point<dim> x = cell.reference_location_of(p);
  Reference<dim> point{ std::vector<double>(old, old + layout.n_properties), cell.location_of(p), {}, 1., 1. };

  const auto of_nodes = [&](const unsigned int component) {
    return evaluate<dim>(grid, cell.cell, x, [&](const unsigned int node) { return field[node][component]; });
  };
  Tensor<1, dim> velocity, change;
  Tensor<2, dim> gradient;
  for (unsigned int c = 0; c < dim; ++c)
    {
      std::tie(velocity[c], gradient[c]) = of_nodes(NodalField<dim>::velocity + c);
      change[c]                          = of_nodes(NodalField<dim>::velocity_change + c).first;
    }
  const Tensor<2, dim> one = unit_symmetric_tensor<dim>();
  point.increment          = one + time_step * gradient;
  point.volume_change      = determinant(point.increment);
  point.location += time_step * velocity;
  const bool keeps  = method == "FLIP" || method == "AFLIP";
  const double keep = std::exp(-pic_rate * time_step);
  for (unsigned int c = 0; c < dim; ++c)
    point.properties[c] = keeps ? keep * (old[c] + change[c]) + (1 - keep) * velocity[c] : velocity[c];
  Tensor<2, dim> affine = gradient;
  const bool is_loose   = density * point.properties[layout.volume] > 1.2 * point.properties[layout.mass];
  if (method == "AFLIP" || (method == "TPIC" && is_loose))
    {
      const Tensor<2, dim> carried = gradient * invert(point.increment);
      if (carried.norm() < gradient.norm())
        affine = carried;
    }
  if (old[layout.volume] > Utilities::fixed_power<dim>(grid.cell_size())) // It does not grow.
    {
      affine -= std::max(0., trace(affine)) / dim * one;
      point.increment *= std::pow(std::max(1., point.volume_change), -1. / dim);
      point.volume_change = determinant(point.increment);
    }
  if (method == "TPIC" || method == "AFLIP")
    for (unsigned int c = 0; c < dim * dim; ++c)
      point.properties[layout.affine + c] = affine[c / dim][c % dim];
  return point;
}


/// J_e of a point under stress, else 0.
template <int dim>
double elastic_ratio(const PropertyLayout<dim> &layout, const Reference<dim> &point)
{
  const double *stress = &point.properties[layout.stress];
  const bool has_none  = stress[0] == 0. && stress[1] == 0. && stress[2] == 0.;
  return has_none ? 0. : std::sqrt(determinant_of_components<dim>(&point.properties[layout.left_cauchy_green]));
}


template <int dim>
void scale(Reference<dim> &point, const double change)
{
  point.stretch = std::cbrt(change / point.volume_change);
  point.increment *= point.stretch;
}


/// F-bar of a cell's points by means of the cell.
template <int dim>
void average(const std::string &f_bar, const PropertyLayout<dim> &layout, std::vector<Reference<dim>> &points)
{
  // The standard one reads no strain.
  const auto ratio = [&](const Reference<dim> &point) {
    return f_bar == "standard" ? 1. : elastic_ratio(layout, point);
  };
  double volume = 0, unloaded = 0;
  for (const auto &point : points)
    if (const double own = point.properties[layout.volume], J_e = ratio(point); J_e > 0)
      {
        volume += own * point.volume_change;
        unloaded += own / J_e;
      }
  for (auto &point : points)
    {
      const double J_e    = ratio(point);
      const double change = J_e > 0 ? volume / unloaded / J_e : point.volume_change;
      scale(point, change);
      if (f_bar == "modified")
        point.volume_change = change;
    }
}


/// What a vertex of the cells sees of the points around it.
template <int dim>
struct Vertex
{
  double volume = 0, shear = 0, seen = 0; // seen: volume of the box about the vertex
  Tensor<1, dim> distance;
  Tensor<2, dim> square_of_distance;

  /// Sums of a quantity of the points and of it times their distance.
  struct Sums
  {
    double value = 0;
    Tensor<1, dim> times_distance;
  } change, strain;

  /// The linear function of a quantity, with a part of its slope.
  double linear(const Sums &sums, const Tensor<1, dim> &from_vertex, const double kept_slope) const
  {
    const double mean           = sums.value / volume;
    const Tensor<1, dim> centre = distance / volume;
    const double lack           = std::max(0., 1. - 2. * volume / seen);
    const Tensor<2, dim> one    = unit_symmetric_tensor<dim>();
    const Tensor<2, dim> variance =
        square_of_distance / volume - outer_product(centre, centre) + (0.002 + 0.2 * lack * lack) * one;
    const Tensor<1, dim> slope = invert(variance) * (sums.times_distance / volume - mean * centre);
    return mean + kept_slope * (slope * (from_vertex - centre));
  }

  /// Part of the elastic volume strain that relaxes.
  double relaxed() const
  {
    return 1. - std::exp(-100. * shear / volume);
  }
};


/// F-bar of all points by linear functions of the cells' vertices, of which one is the origin.
template <int dim>
void project(const std::vector<CellPoints<dim>> &cells,
             const BackgroundGrid<dim> &grid,
             const PropertyLayout<dim> &layout,
             std::vector<std::vector<Reference<dim>>> &points)
{
  const double cell_size = grid.cell_size();
  std::map<std::array<long, dim>, Vertex<dim>> vertices;
  const auto for_each_vertex = [&](const auto &act) { // around each point under stress
    for (unsigned int c = 0; c < cells.size(); ++c)
      for (unsigned int p = 0; p < cells[c].n_points; ++p)
        if (const double J_e = elastic_ratio(layout, points[c][p]); J_e > 0)
          for (unsigned int v = 0; v < 1 << dim; ++v)
            {
              const Point<dim> &x = cells[c].reference_location_of(p);
              std::array<long, dim> key;
              Tensor<1, dim> distance;
              double psi = 1;
              for (unsigned int a = 0; a < dim; ++a)
                {
                  const unsigned int side = v >> a & 1;
                  key[a]                  = std::lround(cells[c].location_of(p)[a] / cell_size - x[a]) + side;
                  distance[a]             = x[a] - side;
                  psi *= 1. - std::abs(distance[a]);
                }
              Vertex<dim> &vertex = vertices[key];
              vertex.seen         = Utilities::fixed_power<dim>(cell_size);
              for (unsigned int a = 0; a < dim; ++a)
                if (key[a] == std::lround(grid.lower_corner()[a] / cell_size) ||
                    key[a] == std::lround(grid.upper_corner()[a] / cell_size))
                  vertex.seen /= 2.;
              act(points[c][p], v, std::log(J_e), psi, distance, vertex);
            }
  };

  for_each_vertex([&](const auto &point, const unsigned int, const double own, const double psi, auto x, auto &vertex) {
    const Tensor<2, dim> green =
        0.5 * (transpose(point.increment) * point.increment - Tensor<2, dim>(unit_symmetric_tensor<dim>()));
    const double shear  = std::sqrt(2. * (green.norm_square() - trace(green) * trace(green) / 3.)); // plane strain
    const double weight = psi * point.properties[layout.volume];
    vertex.volume += weight;
    vertex.shear += weight * shear;
    vertex.distance += weight * x;
    for (auto [sums, value] : { std::pair(&vertex.change, point.volume_change), std::pair(&vertex.strain, own) })
      {
        sums->value += weight * value;
        sums->times_distance += weight * value * x;
      }
    vertex.square_of_distance += weight * outer_product(x, x);
  });

  double change = 0, rest = 0;
  for_each_vertex([&](auto &point, const unsigned int v, const double own, const double psi, auto x, auto &vertex) {
    change = (v == 0 ? 0 : change) + psi * vertex.linear(vertex.change, x, 0.15);
    rest   = (v == 0 ? 0 : rest) + psi * vertex.relaxed() * (own - vertex.linear(vertex.strain, x, 1));
    if (v + 1 < 1 << dim)
      return;
    change *= std::exp(-rest);
    scale(point, change);
    point.volume_change = change;
  });
}


/// Volume and stress of a point.
template <int dim>
void update(const Material<dim> &material,
            const PropertyLayout<dim> &layout,
            Reference<dim> &point,
            UpdateReport &report)
{
  double *properties = point.properties.data();
  properties[layout.volume] *= point.volume_change;
  const double V0 = properties[layout.mass] / density, J = properties[layout.volume] / V0;
  material.update({ 1,
                    0,
                    properties + layout.left_cauchy_green,
                    properties + layout.stress,
                    properties + layout.internal_variables },
                  { &point.increment[0][0], &point.stretch, &J, &V0 },
                  report);
}


template <int dim>
void start(SoilBody<dim> &body, RandomNumbers &random)
{
  for_each_point(body.points, [&](const auto &point) {
    double *properties = point.properties, stress[6] = {};
    const double pressure = random.log_uniform(500, 5e3);
    if (body.layout.affine > body.layout.internal_variables || random.uniform(0, 1) > 0.2) // else free, if elastic
      set_k0_components(pressure, random.uniform(0.6, 1), dim - 1, stress);
    body.material->initialise(stress,
                              properties + body.layout.left_cauchy_green,
                              properties + body.layout.stress,
                              properties + body.layout.internal_variables);
    for (unsigned int a = 0; a < dim; ++a)
      properties[a] = random.uniform(-1, 1);
    properties[body.layout.volume] *= random.uniform(0.9, 1.3); // Some are loose,
    if (stress[0] == 0. && random.uniform(0, 1) > 0.5)
      properties[body.layout.volume] = 1.5 * Utilities::fixed_power<dim>(0.1); // and some larger than a cell.
  });
}


template <int dim>
void shake_nodes(const BackgroundGrid<dim> &grid,
                 const PointSet<dim> &points,
                 NodalField<dim> &field,
                 RandomNumbers &random)
{
  field.clear();
  for (const auto &cell : points.cells())
    for (unsigned int i = 0; i < grid.n_nodes_per_cell(); ++i)
      for (unsigned int c = 1; c < NodalField<dim>::n_components; ++c)
        if (double &value = field[grid.nodes(cell.cell)[i]][c]; value == 0.)
          value = random.uniform(-1, 1) * (i % 7 == 0 ? 0.5 : 0.05);
}


/// What the batches have to serve, over all runs.
struct Visited
{
  unsigned int cells_of_one_point = 0, partial_batches = 0, points_without_stress = 0, large_points = 0;
  UpdateReport report;
};


template <int dim>
std::vector<std::vector<Reference<dim>>> reference_step(const SoilBody<dim> &body,
                                                        const std::vector<CellPoints<dim>> &cells,
                                                        const BackgroundGrid<dim> &grid,
                                                        const NodalField<dim> &field,
                                                        const std::string &method,
                                                        const std::string &f_bar,
                                                        const Material<dim> &one_by_one,
                                                        Visited &visited)
{
  std::vector<std::vector<Reference<dim>>> expected;
  for (const auto &cell : cells)
    {
      std::vector<Reference<dim>> points;
      for (unsigned int p = 0; p < cell.n_points; ++p)
        points.push_back(moved(cell, p, grid, field, body.layout, method));
      for (const auto &point : points)
        {
          visited.points_without_stress += point.properties[body.layout.stress] == 0.;
          visited.large_points += point.properties[body.layout.volume] > Utilities::fixed_power<dim>(grid.cell_size());
        }
      if (f_bar == "standard" || f_bar == "modified")
        average(f_bar, body.layout, points);
      visited.cells_of_one_point += cell.n_points == 1;
      visited.partial_batches += cell.n_points % batch_size != 0;
      expected.push_back(points);
    }
  if (f_bar == "projected")
    project(cells, grid, body.layout, expected);
  for (auto &points : expected)
    for (auto &point : points)
      update(one_by_one, body.layout, point, visited.report);
  return expected;
}


template <int dim>
void compare(const std::vector<CellPoints<dim>> &cells,
             const std::vector<std::vector<Reference<dim>>> &expected,
             const PropertyLayout<dim> &layout)
{
  for (unsigned int c = 0; c < cells.size(); ++c)
    for (unsigned int p = 0; p < cells[c].n_points; ++p)
      {
        const Reference<dim> &wanted = expected[c][p];
        double stress                = 1;
        for (unsigned int i = 0; i < n_symmetric_components<dim>; ++i)
          stress = std::max(stress, std::abs(wanted.properties[layout.stress + i]));
        for (unsigned int i = 0; i < layout.n_properties; ++i)
          {
            const bool is_stress = i >= layout.stress && i < layout.internal_variables;
            const double value = cells[c].properties_of(p)[i], other = wanted.properties[i];
            const double scale = std::max({ is_stress ? stress : 1e-2, std::abs(value), std::abs(other) });
            expect(value / scale, other / scale, 1e-9, "property " + std::to_string(i) + " of a point in a batch");
          }
        expect(cells[c].location_of(p).distance(wanted.location), 0, 1e-9, "error of a place in a batch");
      }
}


template <int dim>
void test(const std::string &basis,
          const std::string &method,
          const std::string &f_bar,
          const std::string &law,
          RandomNumbers &random,
          Visited &visited)
{
  const BackgroundGrid<dim> grid(grid_box<dim>(0., dim == 2 ? 0.9 : 0.5, 0.1, basis), MPI_COMM_WORLD);
  TransferParameters transfer_parameters;
  transfer_parameters.method   = method;
  transfer_parameters.pic_rate = pic_rate;
  StabilisationParameters stabilisation;
  stabilisation.f_bar = f_bar;
  Transfer<dim> transfer(grid, transfer_parameters, stabilisation);

  MaterialParameters material;
  material.law = law;
  std::unique_ptr<Material<dim>> one_by_one;
  if (law == "Nor-Sand")
    one_by_one = std::make_unique<OnePointMaterial<dim, NorSand>>(NorSand(material.of<NorSandParameters>()));
  else
    one_by_one =
        std::make_unique<OnePointMaterial<dim, LinearElastic>>(LinearElastic(material.of<LinearElasticParameters>()));
  SeedingParameters seeding;
  seeding.region = "x + 0.7 * y < 0.55";
  if (dim == 3) // and a point in a cell by itself
    seeding.region += " || max(max(abs(x - 0.4167), abs(y - 0.4167)), abs(z - 0.4167)) < 0.0166";
  seeding.points_per_cell = 3;
  SoilBody<dim> body(
      "Soil",
      density,
      density,
      make_material<dim>(material),
      PropertyLayout<dim>(one_by_one->internal_quantities.size(), transfer_parameters.carries_affine_field()),
      grid.triangulation(),
      grid.mapping());
  seed(body, seeding, { grid.triangulation(), grid.cell_size() });
  start(body, random);

  NodalField<dim> field(grid);
  for (unsigned int step = 0; step < 8; ++step)
    {
      shake_nodes(grid, body.points, field, random);
      const auto &cells   = body.points.cells();
      const auto expected = reference_step(body, cells, grid, field, method, f_bar, *one_by_one, visited);
      transfer.to_points({ &body }, field, time_step, 0., [](const auto &, const auto &) {});
      compare(cells, expected, body.layout);
      body.points.hand_over();
    }
}


template <int dim>
void test_all(RandomNumbers &random)
{
  for (const std::string law : { "linear elastic", "Nor-Sand" })
    {
      Visited visited;
      for (const std::string method : { "FLIP", "TPIC", "AFLIP" })
        for (const std::string basis : { "spline", "linear" })
          for (const std::string f_bar : { "none", "standard", "modified", "projected" })
            if (basis == "spline" || f_bar == "projected")
              test<dim>(basis, method, f_bar, law, random, visited);
      // The scene must reach what it is for.
      const UpdateReport &report = visited.report;
      require(visited.cells_of_one_point > 0 && visited.partial_batches > 0 &&
                  (law == "Nor-Sand" ? report.n_substeps > report.n_updates && report.plastic_dissipation > 0
                                     : visited.points_without_stress > 0 && visited.large_points > 0),
              law + ": a way was not taken");
    }
}


const UnitTest registered("transfer_batches", [] {
  RandomNumbers random;
  test_all<2>(random);
  test_all<3>(random);
});
} // namespace test_transfer_batches

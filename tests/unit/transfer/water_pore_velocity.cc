// SPDX-License-Identifier: LGPL-2.1-or-later
// Velocities of water points with the porosity of their own place, for every transfer:
// - soil and water lie anyhow and nodes move at random: the points' momentum is that of the nodes (FLIP, AFLIP:
//   its change);
// - a flux U that is the same in free water and in soil with a sharp face: points that move with U/n_p come from the
//   nodes as they went there, and without gradient;
// - soil that has just crossed a face of cells, whose nodes beyond it have no mass to speak of and any velocity: water
//   there does not take it;
// - uniform porosity gives the velocity of the nodes to rounding, water without soil gives it to the last digit.
#include "../soil.h"

namespace test_water_pore_velocity
{
constexpr double time_step = 1.; // s: displacements of the size of velocities

template <int dim>
class Scene : public WetScene<dim>
{
public:
  using Field = NodalField<dim>;
  using WetScene<dim>::grid, WetScene<dim>::nodes;

  Scene(const std::string &basis, const std::string &method, const std::string &soil_region)
      : WetScene<dim>(basis, method, soil_region, dim == 2 ? 4 : 2)
  {
  }

  /// Points to nodes; soil at rest, water with its velocity; the nodes' change is their velocity.
  void gather()
  {
    WetScene<dim>::gather();
    for (const unsigned int node : nodes.active())
      if (const double solid = 1000. * nodes.pores[node][Pores::local_solid_volume]; solid > 0.)
        nodes.pores[node][Pores::grain_fraction] = solid / (nodes.water[node][Field::mass] + solid);
    for (const unsigned int node : nodes.active())
      if (const double mass = nodes.water[node][Field::mass]; mass > 0.)
        set_vector<dim>(nodes.water[node], Field::velocity, nodes.velocities(node).water / mass);
  }

  /// Random velocities of soil and water at the nodes.
  void move_nodes()
  {
    for (NodalField<dim> *field : { &nodes.soil, &nodes.water })
      for (const unsigned int node : field->active_nodes())
        for (unsigned int c = 0; c < dim; ++c)
          {
            const Point<dim> place =
                grid.node_position(node) + (field == &nodes.soil ? 1. : 3.) * Point<dim>::unit_vector(c);
            (*field)[node][Field::velocity + c] = (*field)[node][Field::velocity_change + c] = pattern(place);
          }
  }

  void scatter()
  {
    nodes.update_velocity_ghosts();
    nodes.pores.update_ghosts();
    this->transfer->to_points(
        this->water,
        nodes,
        this->mixture,
        [](const unsigned int) { return std::array<double, (1 << dim)>(); },
        time_step);
  }
};

/// Points' momentum less the nodes', over the sum of its parts' size.
template <int dim>
double momentum_error(const std::string &basis, const std::string &method)
{
  Scene<dim> scene(basis, method, "x + 0.7 * y < 0.37");
  shake(scene.soil.points);
  shake(scene.water.points());
  const auto &layout = scene.water.layout;
  for_each_point(scene.water.points(),
                 [&](const auto &point) { set_vector(point.properties, layout.velocity, Tensor<1, dim>()); });
  scene.gather();
  scene.move_nodes();
  scene.scatter();
  Tensor<1, dim> sum;
  double size = 0.;
  for_each_point(scene.water.points(), [&](const auto &point) {
    const auto momentum = point.properties[layout.mass] * vector_of<dim>(point.properties, layout.velocity);
    sum += momentum;
    size += momentum.norm();
  });
  for (const unsigned int node : scene.nodes.active())
    sum -= scene.nodes.water[node][NodalField<dim>::mass] * scene.nodes.velocities(node).water;
  return sum_of_ranks(sum).norm() / sum_of_ranks(size);
}

/// Largest difference of a point's velocity, or of what its gradient adds over a cell, from U/n_p, over U.
template <int dim>
double flux_error(const std::string &method)
{
  const double flux = 0.02; // m/s
  Scene<dim> scene("spline", method, "x < 0.25");
  const auto &layout  = scene.water.layout;
  const auto velocity = [&](const double x) { return (x < 0.25 ? flux / 0.4 : flux) * Point<dim>::unit_vector(0); };
  for_each_point(scene.water.points(), [&](const auto &point) {
    std::fill_n(point.properties + layout.affine, dim * dim, 0.);
    set_vector<dim>(point.properties, layout.velocity, velocity(point.location[0]));
  });
  scene.gather();
  std::vector<Point<dim>> places;
  for_each_point(scene.water.points(), [&](const auto &point) { places.push_back(point.location); });
  scene.scatter();
  double error       = 0;
  unsigned int index = 0;
  for_each_point(scene.water.points(), [&](const auto &point) {
    const Point<dim> place        = places[index++];
    const Tensor<1, dim> expected = velocity(place[0]);
    error                         = std::max({ error,
                                               (vector_of<dim>(point.properties, layout.velocity) - expected).norm() / flux,
                                               ((point.location - place) / time_step - expected).norm() / flux });
    if (method == "TPIC")
      for (unsigned int i = 0; i < dim * dim; ++i)
        error = std::max(error, std::abs(point.properties[layout.affine + i]) * scene.grid.cell_size() / flux);
  });
  return error;
}

/// Largest difference of a point's velocity from that of the nodes there.
template <int dim>
double plain_error(const std::string &method, const std::string &soil_region)
{
  Scene<dim> scene("spline", method, soil_region), same("spline", method, "none");
  for (Scene<dim> *one : { &scene, &same })
    {
      shake(one->water.points());
      one->gather();
      one->move_nodes();
    }
  // Nodes of the same motion, of which one set knows nothing of soil.
  scene.scatter();
  same.scatter();
  std::vector<Tensor<1, dim>> velocities;
  const unsigned int first = same.water.layout.velocity;
  for_each_point(same.water.points(),
                 [&](const auto &point) { velocities.push_back(vector_of<dim>(point.properties, first)); });
  double error       = 0;
  unsigned int index = 0;
  for_each_point(scene.water.points(), [&](const auto &point) {
    error = std::max(error, (vector_of<dim>(point.properties, first) - velocities[index++]).norm());
  });
  return error;
}

template <int dim>
void test()
{
  const std::string of = std::to_string(dim) + "D: error of ";
  for (const std::string method : { "FLIP", "TPIC", "AFLIP" })
    {
      expect(momentum_error<dim>("spline", method), 0., 1e-14, of + "the momentum, " + method);
      if (method == "TPIC") // the others keep the points' own velocity
        expect(flux_error<dim>(method), 0., 1e-13, of + "the flux through a face, " + method);
      expect(plain_error<dim>(method, "x < 1"), 0., 1e-14, of + "the velocity in uniform soil, " + method);
      expect(plain_error<dim>(method, "none"), 0., 0., of + "the velocity without soil, " + method);
    }
  expect(momentum_error<dim>("linear", "TPIC"), 0., 1e-14, of + "the momentum, linear basis");
}


const UnitTest registered("water_pore_velocity", [] {
  test<2>();
  test<3>();
});
} // namespace test_water_pore_velocity

// Runs with mpirun=1,2.

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/postprocess/measures.h>
#include <scree/postprocess/point_sums.h>
#include <scree/run/shown_motion.h>
#include <scree/tensor/vector.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace scree
{
  using namespace dealii;

  namespace
  {
    constexpr double part_behind_front = 0.90; // of the mass
  }


  template <int dim>
  ShownMotion<dim>::ShownMotion(const Scene<dim> &scene)
      : scene(scene)
      , kind(dim == 3 && scene.bed   ? Kind::largest_speed
             : !scene.bodies.empty() ? Kind::soil_front
                                     : Kind::water_front)
  {
  }


  template <int dim>
  std::string ShownMotion<dim>::heading() const
  {
    return kind == Kind::soil_front    ? "front 90 % (m)"
           : kind == Kind::water_front ? "water front 90 % (m)"
                                       : "fastest (m/s)";
  }


  template <int dim>
  double ShownMotion<dim>::value() const
  {
    if (kind == Kind::soil_front)
      return mass_percentiles(scene.bodies, scene.grid, 0, { part_behind_front })[0];
    if (kind == Kind::water_front)
      return mass_percentiles(scene.water, scene.grid, 0, { part_behind_front })[0];
    double largest  = 0.;
    const auto look = [&](const PointSet<dim> &points, const unsigned int velocity) {
      for_each_point(points, [&](const auto &point) {
        largest = std::max(largest, vector_of<dim>(point.properties + velocity).norm());
      });
    };
    for (const auto &body : scene.bodies)
      look(body.points, body.layout.velocity);
    for (const auto &part : scene.water)
      look(part.points(), part.layout.velocity);
    return Utilities::MPI::max(largest, scene.grid.communicator());
  }


  template <int dim>
  double ShownMotion<dim>::kinetic_energy() const
  {
    return PointSums<dim>(scene.bodies, scene.water, scene.forcing.gravity(), scene.grid.communicator()).kinetic;
  }

  template class ShownMotion<2>;
  template class ShownMotion<3>;
} // namespace scree

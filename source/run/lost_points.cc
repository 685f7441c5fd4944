// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/run/lost_points.h>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// Adds one that left the box through the face of this name.
    template <int dim>
    void lose(const Scene<dim> &scene,
              const std::string &name,
              const LostPoint<dim> &point,
              const std::pair<std::string, bool> &face_and_whether_open,
              const unsigned int velocity_slot,
              const unsigned int mass_slot,
              const double time,
              double &lost_mass,
              RunTotals<dim> &totals)
    {
      const auto &[face, is_open] = face_and_whether_open;
      AssertThrow(is_open,
                  ExcMessage("A point of " + name + " left the box through the closed wall '" + face + "' at (" +
                             number_text(point.location) + ") m, t = " + number_text(time) +
                             " s. Remedies: a smaller 'Courant number', or 'open' (water: 'drained') in subsection "
                             "Boundaries."));
      const double *velocity_of_point = point.properties.data() + velocity_slot;
      const double mass               = point.properties[mass_slot];
      const Tensor<1, dim> velocity(make_array_view(velocity_of_point, velocity_of_point + dim));
      lost_mass += mass;
      const double inertia = scene.forcing.mass_scaling() * mass;
      totals.lost_momentum += inertia * velocity;
      totals.lost_energy +=
          0.5 * inertia * velocity.norm_square() - mass * (scene.forcing.gravity() * (point.location - Point<dim>()));
    }
  } // namespace


  template <int dim>
  void account_for_lost_points(Scene<dim> &scene, RunTotals<dim> &totals, const double time)
  {
    for (auto &part : scene.water)
      for (const LostPoint<dim> &point : part.points().lost())
        lose(scene,
             "the water",
             point,
             part.own_points() != nullptr ? scene.water_walls->face_crossed(point.location)
                                          : scene.walls.face_crossed(point.location),
             part.layout.velocity,
             part.layout.mass,
             time,
             totals.lost_water_mass,
             totals);
    for (auto &body : scene.bodies)
      {
        for (const LostPoint<dim> &point : body.points.lost())
          lose(scene,
               body.name,
               point,
               scene.walls.face_crossed(point.location),
               body.layout.velocity,
               body.layout.mass,
               time,
               totals.lost_mass,
               totals);
        for (const LostPoint<dim> &point : body.points.lost())
          totals.lost_volume += point.properties[body.layout.mass] / body.density;
        totals.n_lost += body.points.lost().size();
        body.points.lost().clear();
      }
    for (auto &part : scene.water)
      part.points().lost().clear();
    for (auto &load : scene.loads)
      load.points().lost().clear();
  }

  template void account_for_lost_points(Scene<2> &, RunTotals<2> &, const double);
  template void account_for_lost_points(Scene<3> &, RunTotals<3> &, const double);
} // namespace scree

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/points/point_set.h>

namespace scree
{
  using namespace dealii;

  template <int dim>
  PointSet<dim>::PointSet(const Triangulation<dim> &triangulation,
                          const Mapping<dim> &mapping,
                          const unsigned int n_properties)
      : n_properties(n_properties)
      , particle_handler(triangulation, mapping, n_properties)
  {
    particle_handler.signals.particle_lost.connect([this](const auto &point, const auto &) {
      const auto properties = point->get_properties();
      lost_points.push_back({ point->get_location(), { properties.begin(), properties.end() } });
    });
  }


  template <int dim>
  void PointSet<dim>::sort()
  {
    particle_handler.sort_particles_into_subdomains_and_cells();
    update_cells();
  }


  template <int dim>
  void PointSet<dim>::update_cells()
  {
    cell_list.clear();
    for (auto point = particle_handler.begin(); point != particle_handler.end();)
      {
        const auto &cell            = point->get_surrounding_cell();
        const unsigned int n_points = particle_handler.n_particles_in_cell(cell);

        // The pool stores locations by value and hands out references to them: writing through them saves a
        // set_location() call per point.
        cell_list.push_back({ cell->active_cell_index(),
                              n_points,
                              point->get_properties().data(),
                              const_cast<Point<dim> *>(&point->get_location()),
                              &point->get_reference_location() });
        point = particle_handler.particles_in_cell(cell).end();
      }
  }

  template class PointSet<2>;
  template class PointSet<3>;
} // namespace scree

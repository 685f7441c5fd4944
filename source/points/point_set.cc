// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/points/point_set.h>

#include <deal.II/base/config.h>
#include <deal.II/base/mpi.h>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// The points of the cell of `first`, if they lie one behind the other in memory from there on.
    template <int dim>
    CellPoints<dim> points_of_cell(const Particles::ParticleHandler<dim> &handler,
                                   Particles::ParticleIterator<dim> first)
    {
      const auto &cell      = first->get_surrounding_cell();
      const auto properties = first->get_properties();

      // The pool stores locations by value and hands out references to them: writing through them saves a
      // set_location() call per point.
#if DEAL_II_VERSION_GTE(9, 6, 0)
      Point<dim> *location = &first->get_location();
#else
      // Before 9.6 only constant ones.
      Point<dim> *location = const_cast<Point<dim> *>(&first->get_location());
#endif
      return { cell->active_cell_index(),
               handler.n_particles_in_cell(cell),
               unsigned(properties.size()),
               properties.data(),
               location,
               &first->get_reference_location() };
    }


    template <int dim>
    bool operator==(const CellPoints<dim> &one, const CellPoints<dim> &other)
    {
      return one.cell == other.cell && one.n_points == other.n_points && one.properties == other.properties &&
             one.location == other.location && one.reference_location == other.reference_location;
    }


    /// Sets the points' places in their cells. Returns whether all points are still there, and in memory as `cells`
    /// says, so that sorting would change nothing; if not, some places are not set.
    template <int dim>
    bool set_places(Particles::ParticleHandler<dim> &handler, const std::vector<CellPoints<dim>> &cells)
    {
      auto listed = cells.begin();
      for (auto point = handler.begin(); point != handler.end(); ++listed)
        {
          if (listed == cells.end() || !(points_of_cell(handler, point) == *listed))
            return false;

          // As in deal.II's MappingCartesian, to the last digit.
          const auto &cell        = point->get_surrounding_cell();
          const Point<dim> corner = cell->vertex(0);
          Tensor<1, dim> width;
          for (unsigned int a = 0; a < dim; ++a)
            width[a] = cell->vertex(1 << a)[a] - corner[a];

          for (unsigned int p = 0; p < listed->n_points; ++p, ++point)
            {
              Point<dim> place = listed->location[p];
              bool is_in_place = &point->get_location() == listed->location + p;
              for (unsigned int a = 0; a < dim; ++a)
                {
                  place[a]    = (place[a] - corner[a]) / width[a];
                  is_in_place = is_in_place && place[a] >= 0. && place[a] <= 1.;
                }
              if (!is_in_place)
                return false;
              point->set_reference_location(place);
            }
        }
      return listed == cells.end();
    }
  } // namespace


  template <int dim>
  PointSet<dim>::PointSet(const Triangulation<dim> &triangulation,
                          const Mapping<dim> &mapping,
                          const unsigned int n_properties)
      : communicator(triangulation.get_communicator())
      , n_properties(n_properties)
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
    if (Utilities::MPI::min<int>(update_places(), communicator) == 0)
      hand_over();
  }


  template <int dim>
  bool PointSet<dim>::update_places()
  {
    return set_places(particle_handler, cell_list);
  }


  template <int dim>
  void PointSet<dim>::hand_over()
  {
    particle_handler.sort_particles_into_subdomains_and_cells();
    update_cells();
  }


  template <int dim>
  void PointSet<dim>::update_cells()
  {
    cell_list.clear();
    const_cell_list.clear();
    for (auto point = particle_handler.begin(); point != particle_handler.end();)
      {
        const auto cell = points_of_cell(particle_handler, point);
        cell_list.push_back(cell);
        const_cell_list.push_back(
            { cell.cell, cell.n_points, cell.stride, cell.properties, cell.location, cell.reference_location });
        point = particle_handler.particles_in_cell(point->get_surrounding_cell()).end();
      }
  }

  template class PointSet<2>;
  template class PointSet<3>;
} // namespace scree

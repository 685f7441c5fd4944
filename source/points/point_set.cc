// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/points/cell_places.h>
#include <scree/points/point_set.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>
#include <deal.II/distributed/tria_base.h>
#include <deal.II/grid/cell_id.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// Place of `x` in a cell, as by deal.II's MappingCartesian, to the last digit.
    template <int dim>
    Point<dim> place_in_cell(const Point<dim> &x, const Point<dim> &corner, const Tensor<1, dim> &width)
    {
      Point<dim> place;
      for (unsigned int a = 0; a < dim; ++a)
        place[a] = (x[a] - corner[a]) / width[a];
      return place;
    }


    template <int dim>
    bool is_inside(const Point<dim> &place)
    {
      bool inside = true;
      for (unsigned int a = 0; a < dim; ++a)
        inside = inside && place[a] >= 0. && place[a] <= 1.;
      return inside;
    }


    template <int dim>
    Tensor<1, dim> width_of(const typename Triangulation<dim>::active_cell_iterator &cell)
    {
      Tensor<1, dim> width;
      for (unsigned int a = 0; a < dim; ++a)
        width[a] = cell->vertex(1 << a)[a] - cell->vertex(0)[a];
      return width;
    }


    /// The cell one or no step from `cell` along each axis that holds `x`; no valid one if there is none on this rank.
    template <int dim>
    typename Triangulation<dim>::active_cell_iterator
    neighbour_with(const typename Triangulation<dim>::active_cell_iterator &start, const Point<dim> &x)
    {
      typename Triangulation<dim>::cell_iterator cell = start;
      const Point<dim> place                          = place_in_cell(x, cell->vertex(0), width_of<dim>(start));
      for (unsigned int a = 0; a < dim; ++a)
        if (place[a] < 0. || place[a] > 1.)
          {
            const unsigned int face = 2 * a + (place[a] > 1. ? 1 : 0);
            if (cell->at_boundary(face))
              return {};
            cell = cell->neighbor(face);
            if (!cell->is_active() || cell->is_artificial() || use_of(cell) == CellUse::outside)
              return {};
          }
      const typename Triangulation<dim>::active_cell_iterator found = cell;
      if (!is_inside(place_in_cell(x, found->vertex(0), width_of<dim>(found))))
        return {};
      return found;
    }
  } // namespace


  template <int dim>
  struct PointSet<dim>::Record
  {
    CellId::binary_type cell; // where it goes
    Point<dim> location;      // m
    Point<dim> reference_location;
    types::particle_index id;
    std::vector<double> properties;

    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &cell &location &reference_location &id &properties;
    }
  };


  template <int dim>
  PointSet<dim>::Cell::Cell(const CellIterator &iterator)
      : index(iterator->active_cell_index())
      , iterator(iterator)
  {
    // The mesh's first vertex is the lower corner of the box.
    const Point<dim> lower = iterator->get_triangulation().get_vertices()[0], corner = iterator->vertex(0);
    const Tensor<1, dim> width = width_of<dim>(iterator);
    CellPlace<dim> place;
    for (unsigned int a = 0; a < dim; ++a)
      place[a] = static_cast<int>(std::lround((corner[a] - lower[a]) / width[a]));
    number = curve_number<dim>(place);
  }


  /// Cell by cell.
  template <int dim>
  struct PointSet<dim>::Lifted
  {
    std::vector<std::pair<CellId::binary_type, unsigned int>> cells; // and how many points they hold
    std::vector<Point<dim>> locations;
    std::vector<types::particle_index> ids;
    std::vector<double> properties;
  };


  template <int dim>
  PointSet<dim>::PointSet(const Triangulation<dim> &triangulation,
                          const Mapping<dim> &mapping,
                          const unsigned int n_properties)
      : mesh(triangulation)
      , n_properties(n_properties)
      , particle_handler(triangulation, mapping, n_properties)
  {
    particle_handler.signals.particle_lost.connect([this](const auto &point, const auto &) {
      const auto properties = point->get_properties();
      lost_points.push_back({ point->get_location(), { properties.begin(), properties.end() } });
    });
  }


  template <int dim>
  PointSet<dim>::~PointSet() = default;


  template <int dim>
  void PointSet<dim>::sort()
  {
    particle_handler.sort_particles_into_subdomains_and_cells();
    n_moved = 0;
    list_all_cells();
  }


  template <int dim>
  void PointSet<dim>::hand_over()
  {
    const int disorder = static_cast<int>(update_places());
    hand_over(static_cast<Disorder>(Utilities::MPI::max(disorder, mesh.get_communicator())));
  }


  template <int dim>
  Disorder PointSet<dim>::update_places()
  {
    const bool found_all = set_places();
    at_edge              = std::any_of(
        leavers.begin(), leavers.end(), [](const Leaver &leaver) { return use_of(leaver.to) != CellUse::inner; });
    // From the last one on: where a point is taken out, the last one of its cell takes its number.
    std::for_each(leavers.rbegin(), leavers.rend(), [this](const Leaver &leaver) { move(leaver); });
    if (!found_all || n_moved > most_moved * n_points())
      return Disorder::far;
    return emigrants.empty() ? Disorder::none : Disorder::beside_a_border;
  }


  template <int dim>
  bool PointSet<dim>::set_places()
  {
    bool found_all = true;
    auto &pool     = particle_handler.get_property_pool();
    leavers.clear();
    for (unsigned int c = 0; c < cell_list.size(); ++c)
      {
        const CellPoints<dim> &points = cell_list[c];
        const CellIterator &cell      = filled[c].iterator;
        const Point<dim> corner       = cell->vertex(0);
        const Tensor<1, dim> width    = width_of<dim>(cell);
        for (unsigned int p = 0; p < points.n_points; ++p)
          {
            const Point<dim> &x    = points.location_of(p);
            const Point<dim> place = place_in_cell(x, corner, width);
            if (is_inside(place))
              pool.set_reference_location(points.slots[p], place);
            else if (const CellIterator to = neighbour_with(cell, x); to.state() == IteratorState::valid)
              leavers.push_back({ cell, to, p });
            else
              found_all = false;
          }
      }
    return found_all;
  }


  template <int dim>
  void PointSet<dim>::move(const Leaver &leaver)
  {
    auto point = particle_handler.particles_in_cell(leaver.from).begin();
    std::advance(point, leaver.point);
    const auto properties = point->get_properties();
    const Record record{ leaver.to->id().template to_binary<dim>(),
                         point->get_location(),
                         place_in_cell(point->get_location(), leaver.to->vertex(0), width_of<dim>(leaver.to)),
                         point->get_id(),
                         { properties.begin(), properties.end() } };
    particle_handler.remove_particle(point);
    if (leaver.to->is_locally_owned())
      insert(leaver.to, record);
    else
      emigrants[leaver.to->subdomain_id()].push_back(record);
    ++n_moved;
  }


  template <int dim>
  void PointSet<dim>::insert(const CellIterator &cell, const Record &record)
  {
    if (particle_handler.n_particles_in_cell(cell) == 0)
      newly_filled.emplace_back(cell);
    particle_handler.insert_particle(record.location, record.reference_location, record.id, cell, record.properties);
  }


  template <int dim>
  void PointSet<dim>::hand_over(const Disorder disorder)
  {
    if (disorder != Disorder::none)
      exchange();
    if (disorder == Disorder::far)
      sort();
    else if (disorder == Disorder::beside_a_border || !leavers.empty())
      list_cells();
  }


  template <int dim>
  void PointSet<dim>::exchange()
  {
    // Points go to ghost cells only, so that all ranks know who may write to them. deal.II's some_to_some() asks first,
    // which takes 60 microseconds more a step on two ranks.
    const auto &neighbours      = dynamic_cast<const parallel::TriangulationBase<dim> &>(mesh).ghost_owners();
    const MPI_Comm communicator = mesh.get_communicator();
    constexpr int tag           = 1;
    std::vector<std::vector<char>> messages;
    std::vector<MPI_Request> requests(neighbours.size());
    for (const unsigned int rank : neighbours)
      {
        messages.push_back(Utilities::pack(emigrants[rank], /*allow_compression=*/false));
        const int error = MPI_Isend(messages.back().data(),
                                    messages.back().size(),
                                    MPI_CHAR,
                                    rank,
                                    tag,
                                    communicator,
                                    &requests[messages.size() - 1]);
        AssertThrowMPI(error);
      }
    for (const unsigned int rank : neighbours)
      {
        MPI_Status status;
        int size, error = MPI_Probe(rank, tag, communicator, &status);
        AssertThrowMPI(error);
        error = MPI_Get_count(&status, MPI_CHAR, &size);
        AssertThrowMPI(error);
        std::vector<char> message(size);
        error = MPI_Recv(message.data(), size, MPI_CHAR, rank, tag, communicator, MPI_STATUS_IGNORE);
        AssertThrowMPI(error);
        for (const Record &record : Utilities::unpack<std::vector<Record>>(message, /*allow_compression=*/false))
          insert(mesh.create_cell_iterator(CellId(record.cell)), record);
      }
    const int error = MPI_Waitall(requests.size(), requests.data(), MPI_STATUSES_IGNORE);
    AssertThrowMPI(error);
    emigrants.clear();
  }


  template <int dim>
  bool PointSet<dim>::is_in_inner_cells() const
  {
    return std::all_of(
        filled.begin(), filled.end(), [](const Cell &cell) { return use_of(cell.iterator) == CellUse::inner; });
  }


  template <int dim>
  void PointSet<dim>::lift()
  {
    lifted                  = std::make_unique<Lifted>();
    const std::size_t count = particle_handler.n_locally_owned_particles();
    lifted->locations.reserve(count);
    lifted->ids.reserve(count);
    lifted->properties.reserve(count * n_properties);
    for (const Cell &cell : filled)
      {
        lifted->cells.emplace_back(cell.iterator->id().template to_binary<dim>(),
                                   particle_handler.n_particles_in_cell(cell.iterator));
        for (const auto &point : particle_handler.particles_in_cell(cell.iterator))
          {
            const auto properties = point.get_properties();
            lifted->locations.push_back(point.get_location());
            lifted->ids.push_back(point.get_id());
            lifted->properties.insert(lifted->properties.end(), properties.begin(), properties.end());
          }
      }
    filled.clear();
    particle_handler.clear_particles();
    particle_handler.update_cached_numbers();
    list_all_cells();
  }


  template <int dim>
  void PointSet<dim>::put_down()
  {
    particle_handler.reserve(lifted->ids.size());
    std::size_t p = 0;
    for (const auto &[id, n_points] : lifted->cells)
      {
        typename Triangulation<dim>::cell_iterator parent = mesh.create_cell_iterator(CellId(id));
        for (unsigned int i = 0; i < n_points; ++i, ++p)
          {
            const Point<dim> &x = lifted->locations[p];
            auto cell           = parent;
            while (cell->has_children())
              {
                unsigned int child = 0;
                for (unsigned int a = 0; a < dim; ++a)
                  child |= (x[a] > cell->center()[a] ? 1u : 0u) << a;
                cell = cell->child(child);
              }
            const CellIterator active = cell;
            double *properties        = lifted->properties.data() + p * n_properties;
            particle_handler.insert_particle(x,
                                             place_in_cell(x, active->vertex(0), width_of<dim>(active)),
                                             lifted->ids[p],
                                             active,
                                             ArrayView<const double>(properties, n_properties));
          }
      }
    lifted.reset();
    particle_handler.update_cached_numbers();
    n_moved = 0;
    list_all_cells();
  }


  template <int dim>
  void PointSet<dim>::lose_points_outside()
  {
    std::vector<typename Particles::ParticleHandler<dim>::particle_iterator> outside;
    for (auto point = particle_handler.begin(); point != particle_handler.end();)
      {
        const CellIterator cell = point->get_surrounding_cell();
        const auto points       = particle_handler.particles_in_cell(cell);
        if (use_of(cell) == CellUse::outside)
          for (auto one = points.begin(); one != points.end(); ++one)
            {
              const auto properties = one->get_properties();
              lost_points.push_back({ one->get_location(), { properties.begin(), properties.end() } });
              outside.push_back(one);
            }
        point = points.end();
      }
    // One by one, and from the last one on, since the last point of a cell takes the number of one that is removed:
    // deal.II's remove_particles() is collective.
    std::for_each(
        outside.rbegin(), outside.rend(), [this](const auto &point) { particle_handler.remove_particle(point); });
    particle_handler.update_cached_numbers();
  }


  template <int dim>
  void PointSet<dim>::list_all_cells()
  {
    filled.clear();
    newly_filled.clear();
    lose_points_outside();
    at_edge = false;
    for (auto point = particle_handler.begin(); point != particle_handler.end();)
      {
        const CellIterator cell = point->get_surrounding_cell();
        newly_filled.emplace_back(cell);
        at_edge = at_edge || use_of(cell) != CellUse::inner;
        point   = particle_handler.particles_in_cell(cell).end();
      }
    list_cells();
  }


  template <int dim>
  void PointSet<dim>::list_cells()
  {
    const auto is_empty = [this](const Cell &cell) { return particle_handler.n_particles_in_cell(cell.iterator) == 0; };
    std::sort(newly_filled.begin(), newly_filled.end());
    const auto n_before = filled.size();
    filled.insert(filled.end(), newly_filled.begin(), newly_filled.end());
    newly_filled.clear();
    std::inplace_merge(filled.begin(), filled.begin() + n_before, filled.end());
    // A cell that emptied and filled again stands there twice.
    filled.erase(
        std::unique(filled.begin(), filled.end(), [](const Cell &a, const Cell &b) { return a.index == b.index; }),
        filled.end());
    filled.erase(std::remove_if(filled.begin(), filled.end(), is_empty), filled.end());

    slots.clear();
    for (const Cell &cell : filled)
      for (const auto &point : particle_handler.particles_in_cell(cell.iterator))
        slots.push_back(point.get_local_index());
    cell_list.clear();
    const_cell_list.clear();
    if (filled.empty())
      return;

    // The pool stores records slot by slot and hands out references to them: writing through them saves a call per
    // point.
    auto &pool = particle_handler.get_property_pool();
#if DEAL_II_VERSION_GTE(9, 6, 0)
    Point<dim> *locations = &pool.get_location(0);
#else
    // Before 9.6 only constant ones.
    Point<dim> *locations = const_cast<Point<dim> *>(&pool.get_location(0));
#endif
    double *properties          = pool.get_properties(0).data();
    const unsigned int *of_cell = slots.data();
    for (const Cell &cell : filled)
      {
        const auto n = particle_handler.n_particles_in_cell(cell.iterator);
        cell_list.push_back(
            { cell.index, unsigned(n), of_cell, n_properties, properties, locations, &pool.get_reference_location(0) });
        const_cell_list.push_back(
            { cell.index, unsigned(n), of_cell, n_properties, properties, locations, &pool.get_reference_location(0) });
        of_cell += n;
      }
  }


  template <int dim>
  std::vector<types::particle_index> PointSet<dim>::ids(const unsigned int cell) const
  {
    std::vector<types::particle_index> result;
    for (const auto &point : particle_handler.particles_in_cell(filled[cell].iterator))
      result.push_back(point.get_id());
    return result;
  }

  template class PointSet<2>;
  template class PointSet<3>;
} // namespace scree

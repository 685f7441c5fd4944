// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/particles/point_set.h>

#include <deal.II/distributed/tria_base.h>

#include <utility>

namespace scree
{
  using namespace dealii;

  namespace
  {
    template <std::size_t dim>
    bool is_inside(const std::array<double, dim> &place)
    {
      bool inside = true;
      for (const double along : place)
        inside = inside && along >= 0. && along <= 1.;
      return inside;
    }
  } // namespace


  template <int dim>
  unsigned int CellTable<dim>::neighbour(const unsigned int number, const unsigned int face)
  {
    const auto find = [&]() -> unsigned int {
      const Iterator cell = cells[number].iterator;
      if (cell->at_boundary(face))
        return none;
      const auto other = cell->neighbor(face);
      if (!other->is_active() || other->is_artificial() || use_of(other) == CellUse::outside)
        return none;
      return number_of(other);
    };
    if (cells[number].neighbours[face] == unknown)
      {
        const unsigned int found       = find();
        cells[number].neighbours[face] = found; // the table may have moved
      }
    return cells[number].neighbours[face];
  }


  template <int dim>
  unsigned int CellTable<dim>::neighbour_with(const unsigned int number, const Point<dim> &x)
  {
    const auto place  = cells[number].template place_of<double>(x);
    unsigned int cell = number;
    for (unsigned int a = 0; a < dim; ++a)
      if (place[a] < 0. || place[a] > 1.)
        if (cell = neighbour(cell, 2 * a + (place[a] > 1. ? 1 : 0)); cell == none)
          return none;
    return is_inside(cells[cell].template place_of<double>(x)) ? cell : none;
  }

  template class CellTable<2>;
  template class CellTable<3>;


  /// Cell by cell.
  template <int dim>
  struct PointSet<dim>::Lifted
  {
    std::vector<std::pair<CellId::binary_type, unsigned int>> cells; // and how many points they hold
    std::vector<Point<dim>> middles;                                 // of the cells
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
      , refinement_signal(triangulation.signals.any_change.connect([this] { table.clear(); }))
      , repartition_signal(triangulation.signals.post_distributed_repartition.connect([this] { table.clear(); }))
  {
    particle_handler.signals.particle_lost.connect([this](const auto &point, const auto &) {
      const auto properties = point->get_properties();
      lost_points.push_back({ point->get_location(), { properties.begin(), properties.end() } });
    });
  }


  template <int dim>
  PointSet<dim>::~PointSet() = default;


  template <int dim>
  Disorder PointSet<dim>::update_places()
  {
    const bool found_all = set_places();
    at_edge              = std::any_of(leavers.begin(), leavers.end(), [this](const Leaver &leaver) {
      return use_of(table[leaver.to].iterator) != CellUse::inner;
    });
    carried.resize(std::max(carried.size(), leavers.size())); // Its memory is kept.
    // From the last one on: where a point is taken out, the last one of its cell takes its number.
    for (std::size_t l = leavers.size(); l > 0; --l)
      take_out(leavers[l - 1], carried[l - 1]);
    for (std::size_t l = 0; l < leavers.size(); ++l)
      hand_on(leavers[l].to, carried[l]);
    n_moved += leavers.size();
    if (!found_all)
      return Disorder::far;
    if (n_moved > most_moved * n_points())
      return Disorder::scattered;
    return emigrants.empty() ? Disorder::none : Disorder::beside_a_border;
  }


  template <int dim>
  bool PointSet<dim>::set_places()
  {
    leavers.clear();
    if (cell_list.empty())
      return true;
    bool found_all = true;
    // Writing through the pool saves a call per point.
    auto *places = const_cast<Point<dim> *>(cell_list.front().reference_locations);
    for (unsigned int c = 0; c < cell_list.size(); ++c)
      {
        const CellPoints<dim> &points = cell_list[c];
        const auto cell               = table[filled[c].in_table]; // a copy: the table may grow
        for_each_batch(points.n_points, [&](const BatchIndices &indices, const unsigned int n) {
          RecordPointers<const double> from;
          RecordPointers<double> to;
          for (unsigned int l = 0; l < batch_size; ++l)
            {
              from[l] = apart(&points.location_of(indices[l])[0]);
              to[l]   = apart(&places[points.slots[indices[l]]][0]);
            }
          Batch x[dim];
          simd::load_records<dim>(from, x);
          const auto place = cell.template place_of<Batch>(x);
          simd::store_records<dim>(place.data(), to);
          auto inside = simd::first_lanes(batch_size);
          for (const Batch &along : place)
            inside = inside & (along >= 0.) & (along <= 1.);
          unsigned int left = ~simd::bits_of(inside) & ((1u << n) - 1);
          for (unsigned int l = 0; left != 0; ++l, left >>= 1)
            if (left & 1)
              {
                const unsigned int other = table.neighbour_with(filled[c].in_table, points.location_of(indices[l]));
                if (other == table.none)
                  found_all = false;
                else
                  leavers.push_back({ c, indices[l], other });
              }
        });
      }
    return found_all;
  }


  template <int dim>
  void PointSet<dim>::take_out(const Leaver &leaver, Record &record)
  {
    const CellPoints<dim> &points = cell_list[leaver.from];
    FilledCell &cell              = filled[leaver.from];
    const auto of_handler         = particle_handler.particles_in_cell(table[cell.in_table].iterator);
    const auto point              = std::next(of_handler.begin(), leaver.point);
    Assert(point->get_local_index() == points.slots[leaver.point], ExcInternalError("The lists differ."));

    const double *properties = points.properties_of(leaver.point);
    record.properties.assign(properties, properties + n_properties);
    record.location = point->get_location();
    record.id       = point->get_id();
    // In both lists the last point of the cell takes the number of one that is removed; cells() keeps it until then.
    particle_handler.remove_particle(point);
    unsigned int *own = slots.data() + (points.slots - slots.data());
    own[leaver.point] = own[--cell.n_points];
  }


  template <int dim>
  void PointSet<dim>::exchange()
  {
    // Points go to ghost cells only, so that the ghost layer gives the partners. deal.II's some_to_some() asks first,
    // which takes 60 microseconds more a step on two ranks.
    const auto &neighbours      = dynamic_cast<const parallel::TriangulationBase<dim> &>(mesh).ghost_owners();
    const MPI_Comm communicator = communicator_of(mesh);
    constexpr int tag           = 1;
    std::vector<std::vector<char>> messages;
    std::vector<MPI_Request> requests(neighbours.size());
    for (const unsigned int rank : neighbours)
      {
        const auto &message = messages.emplace_back(Utilities::pack(emigrants[rank], /*allow_compression=*/false));
        MPI_Isend(message.data(), message.size(), MPI_CHAR, rank, tag, communicator, &requests[messages.size() - 1]);
      }
    for (const unsigned int rank : neighbours)
      {
        MPI_Status status;
        int size;
        MPI_Probe(rank, tag, communicator, &status);
        MPI_Get_count(&status, MPI_CHAR, &size);
        std::vector<char> message(size);
        MPI_Recv(message.data(), size, MPI_CHAR, rank, tag, communicator, MPI_STATUS_IGNORE);
        receive(Utilities::unpack<std::vector<Record>>(message, /*allow_compression=*/false));
      }
    MPI_Waitall(requests.size(), requests.data(), MPI_STATUSES_IGNORE);
    emigrants.clear();
  }


  template <int dim>
  void PointSet<dim>::hand_over(const Disorder disorder)
  {
    if (disorder != Disorder::none)
      exchange();
    if (disorder == Disorder::far)
      return sort();
    if (!leavers.empty() || !entrants.empty())
      update_lists();
    if (disorder == Disorder::scattered)
      {
        lift();
        put_down();
      }
  }


  template <int dim>
  void PointSet<dim>::lift()
  {
    lifted                  = std::make_unique<Lifted>();
    const std::size_t count = particle_handler.n_locally_owned_particles();
    lifted->locations.reserve(count);
    lifted->ids.reserve(count);
    lifted->properties.reserve(count * n_properties);
    const auto &pool = particle_handler.get_property_pool();
    for (unsigned int c = 0; c < cell_list.size(); ++c)
      {
        const CellPoints<dim> &points = cell_list[c];
        const CellIterator &cell      = table[filled[c].in_table].iterator;
        lifted->cells.emplace_back(cell->id().template to_binary<dim>(), points.n_points);
        lifted->middles.push_back(cell->center());
        for (unsigned int p = 0; p < points.n_points; ++p)
          {
            const double *properties = points.properties_of(p);
            lifted->locations.push_back(points.location_of(p));
            lifted->ids.push_back(pool.get_id(points.slots[p]));
            lifted->properties.insert(lifted->properties.end(), properties, properties + n_properties);
          }
      }
    particle_handler.clear_particles();
    particle_handler.update_cached_numbers();
    list_all_cells();
  }


  template <int dim>
  typename PointSet<dim>::CellIterator PointSet<dim>::active_cell(const CellId::binary_type &id,
                                                                  const Point<dim> &x) const
  {
    const CellId cell_id(id);
    auto cell = mesh.create_cell_iterator(CellId(cell_id.get_coarse_cell_id(), {}));
    for (const auto child : cell_id.get_child_indices())
      if (cell->has_children())
        cell = cell->child(child);
    while (cell->has_children())
      {
        unsigned int child = 0;
        for (unsigned int a = 0; a < dim; ++a)
          child |= (x[a] > cell->center()[a] ? 1u : 0u) << a;
        cell = cell->child(child);
      }
    return cell;
  }


  template <int dim>
  void PointSet<dim>::put_down(const RanksAt &ranks_at)
  {
    particle_handler.reserve(lifted->ids.size());
    const auto ranks = ranks_at ? ranks_at(lifted->middles) : std::vector<types::subdomain_id>();
    std::size_t p    = 0;
    for (unsigned int c = 0; c < lifted->cells.size(); ++c)
      for (unsigned int i = 0; i < lifted->cells[c].second; ++i, ++p)
        {
          const auto &id          = lifted->cells[c].first;
          const Point<dim> &x     = lifted->locations[p];
          const CellIterator cell = active_cell(id, x);
          double *properties      = lifted->properties.data() + p * n_properties;
          if (cell->is_locally_owned())
            insert_into(table.number_of(cell), x, lifted->ids[p], ArrayView<const double>(properties, n_properties));
          else
            emigrants[ranks[c]].push_back({ id, x, lifted->ids[p], { properties, properties + n_properties } });
        }
    lifted.reset();
    if (ranks_at)
      for (const auto &[rank, records] : Utilities::MPI::some_to_some(communicator_of(mesh), emigrants))
        receive(records);
    emigrants.clear();
    particle_handler.update_cached_numbers();
    n_moved = 0;
    list_all_cells();
  }


  template <int dim>
  void PointSet<dim>::list_all_cells()
  {
    lose_points_outside();
    filled.clear();
    slots.clear();
    entrants.clear();
    for (auto point = particle_handler.begin(); point != particle_handler.end();)
      {
        const CellIterator cell     = point->get_surrounding_cell();
        const unsigned int in_table = table.number_of(cell);
        filled.push_back({ table[in_table].number, in_table, particle_handler.n_particles_in_cell(cell) });
        point = particle_handler.particles_in_cell(cell).end();
      }
    std::sort(
        filled.begin(), filled.end(), [](const FilledCell &a, const FilledCell &b) { return a.number < b.number; });
    for (const FilledCell &cell : filled)
      for (const auto &point : particle_handler.particles_in_cell(table[cell.in_table].iterator))
        slots.push_back(point.get_local_index());
    point_to_records();
    at_edge = !is_in_inner_cells();
  }


  template <int dim>
  void PointSet<dim>::update_lists()
  {
    std::sort(entrants.begin(), entrants.end());
    new_filled.clear();
    new_slots.clear();
    const Entrant *entrant = entrants.data(), *end = entrant + entrants.size();
    for (unsigned int c = 0; c < filled.size();)
      {
        // Cells that no point has left or entered are copied together.
        unsigned int changed = c;
        while (changed < filled.size() && filled[changed].n_points == cell_list[changed].n_points &&
               (entrant == end || filled[changed].number < entrant->number))
          ++changed;
        if (changed > c)
          {
            const auto &last = cell_list[changed - 1];
            new_slots.insert(new_slots.end(), cell_list[c].slots, last.slots + last.n_points);
            new_filled.insert(new_filled.end(), filled.begin() + c, filled.begin() + changed);
            c = changed;
            continue;
          }
        while (entrant != end && entrant->number < filled[c].number)
          entrant = append_cell({ entrant->number, entrant->in_table, 0 }, nullptr, entrant, end);
        entrant = append_cell(filled[c], cell_list[c].slots, entrant, end);
        ++c;
      }
    while (entrant != end)
      entrant = append_cell({ entrant->number, entrant->in_table, 0 }, nullptr, entrant, end);
    filled.swap(new_filled);
    slots.swap(new_slots);
    entrants.clear();
    point_to_records();
  }


  template <int dim>
  void PointSet<dim>::point_to_records()
  {
    cell_list.resize(filled.size());
    const_cell_list.resize(filled.size());
    slots.insert(slots.end(), points_ahead, 0);
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
    const Point<dim> *places    = &pool.get_reference_location(0);
    double *properties          = pool.get_properties(0).data();
    const unsigned int stride   = pool.n_properties_per_slot();
    const unsigned int *of_cell = slots.data();
    for (unsigned int c = 0; c < filled.size(); ++c)
      {
        const FilledCell &cell   = filled[c];
        const unsigned int index = table[cell.in_table].index;
        cell_list[c]             = { index, cell.n_points, of_cell, stride, properties, locations, places };
        const_cell_list[c]       = { index, cell.n_points, of_cell, stride, properties, locations, places };
        of_cell += cell.n_points;
      }
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


  template class PointSet<2>;
  template class PointSet<3>;
} // namespace scree

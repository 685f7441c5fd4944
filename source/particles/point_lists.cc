// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/particles/point_lists.h>

#include <algorithm>

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


  template <int dim>
  void PointLists<dim>::list_all()
  {
    filled.clear();
    slots.clear();
    entrants.clear();
    for (auto point = handler.begin(); point != handler.end();)
      {
        const CellIterator cell     = point->get_surrounding_cell();
        const unsigned int in_table = table.number_of(cell);
        filled.push_back({ table[in_table].number, in_table, handler.n_particles_in_cell(cell) });
        point = handler.particles_in_cell(cell).end();
      }
    std::sort(
        filled.begin(), filled.end(), [](const FilledCell &a, const FilledCell &b) { return a.number < b.number; });
    for (const FilledCell &cell : filled)
      for (const auto &point : handler.particles_in_cell(table[cell.in_table].iterator))
        slots.push_back(point.get_local_index());
    point_to_records();
  }


  template <int dim>
  void PointLists<dim>::update()
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
  void PointLists<dim>::point_to_records()
  {
    cell_list.resize(filled.size());
    const_cell_list.resize(filled.size());
    slots.insert(slots.end(), points_ahead, 0);
    if (filled.empty())
      return;

    // The pool stores records slot by slot and hands out references to them: writing through them saves a call per
    // point.
    auto &pool = handler.get_property_pool();
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

  template class PointLists<2>;
  template class PointLists<3>;
} // namespace scree

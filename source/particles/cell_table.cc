// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/particles/cell_places.h>
#include <scree/particles/cell_table.h>
#include <scree/particles/cell_use.h>

#include <cmath>

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
  TableCell<dim>::TableCell(const Iterator &iterator)
      : iterator(iterator)
      , index(iterator->active_cell_index())
      , corner(iterator->vertex(0))
  {
    neighbours.fill(CellTable<dim>::none - 1);
    // The mesh's first vertex is the lower corner of the box.
    const Point<dim> lower = iterator->get_triangulation().get_vertices()[0];
    CellPlace<dim> place;
    for (unsigned int a = 0; a < dim; ++a)
      {
        width[a] = iterator->vertex(1 << a)[a] - corner[a];
        place[a] = static_cast<int>(std::lround((corner[a] - lower[a]) / width[a]));
      }
    number = curve_number<dim>(place);
  }


  template <int dim>
  void CellTable<dim>::clear()
  {
    cells.clear();
    numbers.clear();
  }


  template <int dim>
  unsigned int CellTable<dim>::number_of(const Iterator &cell)
  {
    if (numbers.empty())
      numbers.assign(cell->get_triangulation().n_active_cells(), none);
    unsigned int &number = numbers[cell->active_cell_index()];
    if (number == none)
      {
        number = cells.size();
        cells.emplace_back(cell);
      }
    return number;
  }


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

  template struct TableCell<2>;
  template struct TableCell<3>;
  template class CellTable<2>;
  template class CellTable<3>;
} // namespace scree

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/particles/cell_costs.h>

#include <algorithm>

namespace scree
{
  void CellCosts::reinit(const unsigned int n_cells)
  {
    cells.assign(n_cells, Cell());
    is_wanted = is_timed = false;
  }


  void CellCosts::time_next_pass()
  {
    is_wanted = !cells.empty();
  }


  void CellCosts::add(const unsigned int cell, const double seconds)
  {
    Cell &own = cells[cell];
    own.sum += seconds;
    own.largest = std::max(own.largest, seconds);
    ++own.n_measurements;
  }


  double CellCosts::of_point(const unsigned int cell, const double otherwise) const
  {
    if (cell >= cells.size() || cells[cell].n_measurements == 0)
      return otherwise;
    const Cell &own = cells[cell];
    return own.n_measurements == 1 ? own.sum : (own.sum - own.largest) / (own.n_measurements - 1);
  }
} // namespace scree

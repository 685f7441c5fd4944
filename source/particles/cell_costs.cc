// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/particles/cell_costs.h>

#include <algorithm>
#include <ctime>

namespace scree
{
  double thread_time()
  {
    timespec time;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return time.tv_sec + 1e-9 * time.tv_nsec;
  }


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


  void CellCosts::add_contacts(const unsigned int cell, const unsigned int n_points, const double seconds)
  {
    cells[cell].contacts += seconds / n_points;
  }


  double CellCosts::of_contacts(const unsigned int cell) const
  {
    return cell < cells.size() && cells[cell].n_measurements > 0 ? cells[cell].contacts / cells[cell].n_measurements
                                                                 : 0.;
  }
} // namespace scree

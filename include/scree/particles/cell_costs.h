// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_particles_cell_costs_h
#define scree_particles_cell_costs_h

#include <chrono>
#include <vector>

namespace scree
{
  /// Processor time of this thread, s: that of others on the machine does not count.
  double thread_time();


  /// What a point of each of this rank's cells costs, measured around the cells in some passes over them; and what its
  /// contacts with the ground cost, measured in the same steps.
  ///
  /// Costs belong to active cell indices: reinit() clears them when the mesh is partitioned anew.
  class CellCosts
  {
  public:
    /// Nothing is measured before the first call.
    void reinit(const unsigned int n_cells);

    /// Asks for the next pass to be timed. Others cost a branch a cell.
    void time_next_pass();

    /// Whether it will be.
    bool is_due() const
    {
      return is_wanted;
    }

    /// A pass over the cells begins.
    void start_pass()
    {
      is_timed = is_wanted;
      if (!is_timed)
        return;
      is_wanted = false;
      last      = TimeStepper::now();
    }

    /// The pass is through with a cell of `n_points`: the time since the cell before was its own.
    void finish_cell(const unsigned int cell, const unsigned int n_points)
    {
      if (!is_timed)
        return;
      const auto now = TimeStepper::now();
      add(cell, std::chrono::duration<double>(now - last).count() / n_points);
      last = now;
    }

    /// The same for a range of cells that hold `n_points` in all.
    template <typename Iterator>
    void finish_cells(const Iterator &begin, const Iterator &end, const unsigned int n_points)
    {
      if (!is_timed)
        return;
      const auto now = TimeStepper::now();
      for (auto cell = begin; cell != end; ++cell)
        add(cell->cell, std::chrono::duration<double>(now - last).count() / n_points);
      last = now;
    }

    /// Adds a measurement, s a point.
    void add(const unsigned int cell, const double seconds);

    /// Seconds a point of the cell: the mean of its measurements without the largest, since the system may have
    /// interrupted the rank in that one; `otherwise` if there are none.
    double of_point(const unsigned int cell, const double otherwise) const;

    /// Adds the time, s, that contacts of the cell's points took in a step whose next pass is_due().
    void add_contacts(const unsigned int cell, const unsigned int n_points, const double seconds);

    /// Seconds that contacts of a point of the cell take, the mean over its measured passes; 0 without any.
    double of_contacts(const unsigned int cell) const;

  private:
    using TimeStepper = std::chrono::steady_clock;

    struct Cell
    {
      double sum = 0, largest = 0, contacts = 0; // s a point
      unsigned int n_measurements = 0;
    };

    std::vector<Cell> cells;
    bool is_wanted = false, is_timed = false;
    TimeStepper::time_point last;
  };
} // namespace scree

#endif

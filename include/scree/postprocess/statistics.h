// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_postprocess_statistics_h
#define scree_postprocess_statistics_h

#include <scree/postprocess/statistics/column.h>

#include <boost/serialization/string.hpp>
#include <boost/serialization/utility.hpp>
#include <boost/serialization/vector.hpp>

namespace scree
{
  /// The rows of the files `statistics` and `statistics.csv`: global numbers at each due time.
  template <int dim>
  class Statistics
  {
  public:
    /// Without a row.
    /// @param gravity m/s^2
    Statistics(const BackgroundGrid<dim> &grid,
               const dealii::Tensor<1, dim> &gravity,
               const FurtherColumns<dim> &further);

    /// Makes a row: of soil and water together, of the soil if there is any, and of `water` unless it is empty.
    /// Collective.
    void collect(const std::list<SoilBody<dim>> &bodies,
                 const std::list<WaterPhase<dim>> &water,
                 const RunTotals<dim> &totals,
                 const double time,
                 const unsigned long long step,
                 const double time_step,
                 const UpdateReport &last_step);

    /// Throws if a number of the last row, of a `time` in s, is none.
    void require_numbers(const double time) const;

    /// The whole names of the columns of the last row.
    std::vector<std::string> columns() const;

    /// The numbers of the last row.
    std::vector<double> values() const;

    /// Prints the last row, one quantity a line.
    void print_last_row(std::ostream &out) const;

    /// Steps of the run at the last row.
    unsigned long long step_of_last_row() const
    {
      return history.step;
    }

    /// The soil at the last row.
    const SoilMotion<dim> &soil_motion() const
    {
      return motion;
    }

    /// Saves or loads the last row and the state that differences start from (Boost).
    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &history.has_start &history.start_momentum &history.start_energy;
      archive &last_row &history.step &history.n_iterations &history.n_cavitating &history.n_viscous_iterations;
      archive &history.time &history.obstacles &motion;
    }

  private:
    const BackgroundGrid<dim> &grid;
    const dealii::Tensor<1, dim> gravity;
    const FurtherColumns<dim> further;
    SoilMotion<dim> motion;
    RowHistory<dim> history;
    StatisticsRow last_row;
  };
} // namespace scree

#endif

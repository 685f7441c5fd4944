// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_advice_advise_h
#define scree_advice_advise_h

#include <scree/advice/cost.h>
#include <scree/advice/recommendation.h>
#include <scree/case/parameters.h>

#include <mpi.h>

#include <ostream>

namespace scree
{
  /// All that the text of an advice is made of.
  struct Advice
  {
    SceneNumbers scene;       ///< numbers that describe the case
    Observation seen;         ///< measured steps and their cost
    Schedule schedule;        ///< entries of time step and output
    GridParameters grid;      ///< box and cell size
    double accuracy      = 0; ///< relative error for which cells are recommended
    double settling_time = 0; ///< s, at most
    unsigned int n_ranks = 1; ///< ranks that --advise runs on
    unsigned int coarser = 1; ///< how many times as wide the cells were in the first steps that were taken
    double pilot_coarser = 0; ///< and in the pilot; 0: there was none
    std::string pilot_fault;  ///< what kept it from its end
  };

  /// Writes groups, size, cost and recommendation, a line a number with its unit.
  void write_report(const Advice &advice, std::ostream &out);

  /// Default of the error that a run is to have.
  constexpr double default_accuracy = 0.05;

  /// Writes what a case is, what it will cost and what would serve it better, from its points and its first steps; its
  /// run folder is not touched. `parameters` must not be used for a run afterwards. Collective; throws as a run's
  /// start.
  /// @param accuracy relative error for which cells are recommended
  template <int dim>
  void advise(Parameters &parameters, const double accuracy, const MPI_Comm communicator, std::ostream &out);
} // namespace scree

#endif

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

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_advice_survey_h
#define scree_advice_survey_h

#include <scree/advice/scene_numbers.h>
#include <scree/run/simulation.h>

namespace scree
{
  /// Looks at the points of a run before its first step. Collective.
  template <int dim>
  SceneNumbers survey(const Simulation<dim> &simulation, const Parameters &parameters, const MPI_Comm communicator);
} // namespace scree

#endif

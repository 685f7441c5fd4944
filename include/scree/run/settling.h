// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_run_settling_h
#define scree_run_settling_h

#include <scree/io/run_folder.h>
#include <scree/model/scene.h>
#include <scree/run/step_control.h>

#include <functional>

namespace scree
{
  /// Lets the soil come to rest, with damping and behind a gate if there is one, and releases it unless the run is
  /// asked to stop; logs how it went. Collective.
  /// @param scheme that `advance` steps with
  /// @param advance moves all by a step, s
  /// @return whether it is released
  template <int dim>
  bool settle(const Parameters &parameters,
              Scene<dim> &scene,
              Scheme<dim> &scheme,
              StepControl<dim> &control,
              RunFolder &folder,
              const std::function<void(double)> &advance,
              const MPI_Comm communicator);
} // namespace scree

#endif

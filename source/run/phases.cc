// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/run/phases.h>

namespace scree
{
  template <int dim>
  End run_in_phases(Parameters &parameters, const Start start, const MPI_Comm communicator)
  {
    const double factor = parameters.safety.strength_factor;
    const bool weakens  = parameters.settling.maximum_time > 0. && factor != 1.;
    if (weakens && start == Start::fresh)
      {
        Parameters(parameters.case_file).reduce_strength(factor); // throws before files are touched
        parameters.set("Safety", "Strength factor", "1");
        const double begin = MPI_Wtime();
        Simulation<dim> settled(parameters, start, communicator);
        if (!settled.is_settled())
          return settled.run();
        settled.report();
        settled.write_checkpoint();
        if (double &limit = parameters.output.wall_time_limit; limit > 0.)
          limit = std::max(limit + begin - MPI_Wtime(), 1e-3); // 0 is no limit
      }
    if (weakens)
      parameters.reduce_strength(factor);
    return Simulation<dim>(parameters, weakens ? Start::resume : start, communicator).run();
  }

  template End run_in_phases<2>(Parameters &, const Start, const MPI_Comm);
  template End run_in_phases<3>(Parameters &, const Start, const MPI_Comm);
} // namespace scree

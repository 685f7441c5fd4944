// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/advice/advise.h>
#include <scree/advice/measure.h>
#include <scree/advice/report.h>
#include <scree/advice/survey.h>
#include <scree/input/input_error.h>
#include <scree/memory.h>

#include <deal.II/base/mpi.h>

#include <unistd.h>

#include <filesystem>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// A run folder of its own for the steps that are looked at; removed with its owner.
    class PassingFolder
    {
    public:
      explicit PassingFolder(const MPI_Comm communicator)
          : is_owner(Utilities::MPI::this_mpi_process(communicator) == 0)
          , name(Utilities::MPI::broadcast(
                communicator,
                (std::filesystem::temp_directory_path() / ("scree-advice-" + std::to_string(getpid()))).string(),
                0))
      {
      }
      ~PassingFolder()
      {
        std::error_code nobody_minds;
        if (is_owner)
          std::filesystem::remove_all(name, nobody_minds);
      }
      PassingFolder(const PassingFolder &)            = delete;
      PassingFolder &operator=(const PassingFolder &) = delete;

      const std::string &path() const
      {
        return name;
      }

    private:
      const bool is_owner;
      const std::string name;
    };


    /// How many times as wide cells keep a case to what can be looked at in seconds. Collective.
    template <int dim>
    unsigned int coarsening(const Parameters &parameters, const MPI_Comm communicator)
    {
      constexpr double most = 2e6; // points and fine cells
      MemoryEstimate size;
      on_all_ranks(communicator, [&] { size = estimate_memory<dim>(parameters); });
      const double n = size.n_soil_points + size.n_water_points + size.n_cells;
      return std::max(1., std::ceil(std::pow(n / most, 1. / dim)));
    }

    /// Widens the cells; the box grows by less than one of them an axis.
    void coarsen(GridParameters &grid, const unsigned int factor)
    {
      if (factor == 1)
        return;
      grid.cell_size *= factor;
      for (unsigned int a = 0; a < grid.lower_corner.size(); ++a)
        grid.upper_corner[a] =
            grid.lower_corner[a] +
            grid.cell_size * std::ceil((grid.upper_corner[a] - grid.lower_corner[a]) / grid.cell_size - 1e-6);
    }
  } // namespace


  template <int dim>
  void advise(Parameters &parameters, const double accuracy, const MPI_Comm communicator, std::ostream &out)
  {
    constexpr double seconds_of_steps = 0.5;
    for (const InflowParameters &inflow : parameters.inflows)
      require_entry(
          false,
          inflow.subsection,
          "Body",
          inflow.body,
          "--advise looks at the points of the start, and cannot tell what a case costs whose points enter on "
          "the way. Remove the inflow for it, and write its points as a body.");
    const PassingFolder folder(communicator);

    Advice advice;
    advice.accuracy           = accuracy;
    advice.grid               = parameters.grid;
    advice.schedule.time_step = parameters.time_step;
    advice.schedule.output    = parameters.output;
    advice.settling_time      = parameters.settling.maximum_time;
    advice.n_ranks            = Utilities::MPI::n_mpi_processes(communicator);
    advice.coarser            = coarsening<dim>(parameters, communicator);

    parameters.output_directory      = folder.path();
    parameters.output.screen         = "nothing";
    parameters.settling.maximum_time = 0;
    coarsen(parameters.grid, advice.coarser);
    Simulation<dim> simulation(parameters, Start::fresh, communicator);
    const SceneNumbers seeded = survey(simulation, parameters, communicator);
    const StepCost steps      = measure_steps(simulation, seconds_of_steps, communicator);

    advice.scene       = with_cell_size(seeded, advice.grid.cell_size);
    advice.first_steps = with_cell_size(steps, seeded, advice.grid.cell_size);
    write_report(advice, out);
  }

  template void advise<2>(Parameters &, const double, const MPI_Comm, std::ostream &);
  template void advise<3>(Parameters &, const double, const MPI_Comm, std::ostream &);
} // namespace scree

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/advice/advise.h>
#include <scree/advice/measure.h>
#include <scree/advice/report.h>
#include <scree/advice/survey.h>
#include <scree/input/input_error.h>
#include <scree/case/memory.h>

#include <deal.II/base/mpi.h>

#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <numeric>

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


    /// Makes the cells `factor` times as wide, and the longest step. Where they do not fill the box, it is cut: beyond
    /// it there may be no ground.
    void coarsen(Parameters &parameters, const double factor)
    {
      GridParameters &grid    = parameters.grid;
      const double width      = factor * grid.cell_size;
      constexpr double one_up = 1 + 1e-9;
      parameters.time_step.maximum_time_step *= factor;
      for (unsigned int a = 0; a < grid.upper_corner.size(); ++a)
        grid.upper_corner[a] =
            grid.lower_corner[a] + width * std::max(1., std::floor(grid.n_cells_along(a) / factor * one_up));
      grid.cell_size = width;
    }


    /// Core-seconds that a pilot may take: a part of those of the run's steps, but some seconds are nothing.
    double seconds_of_pilot(const double of_run)
    {
      return std::clamp(0.05 * of_run, 1., 15.);
    }

    /// How many times as wide the cells of a pilot are: as few as its time allows, and not so many that no height is
    /// left; somewhat more if cells then fill the box.
    double coarsening_of_pilot(const Advice &advice, const double of_run)
    {
      constexpr double least_cells = 3; // over the height
      const double wanted          = std::pow(of_run / seconds_of_pilot(of_run), 1. / (advice.scene.dim + 1));
      const double allowed         = advice.scene.height / advice.scene.cell_size / least_cells;
      const double factor          = std::max({ 2., double(advice.coarser), std::min(wanted, allowed) });
      long common                  = 0; // divisor of the cells along all axes
      for (unsigned int a = 0; a < advice.scene.dim; ++a)
        common = std::gcd(common, advice.grid.n_cells_along(a));
      const double exact = common / std::max(1., std::floor(common / factor));
      return exact >= factor && exact < 1.5 * factor ? exact : std::ceil(factor);
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

    parameters.output.screen              = "nothing";
    parameters.output.interval            = 0; // what is written is looked at by itself
    parameters.output.statistics_interval = 0;
    parameters.output.checkpoint_interval = 0;
    parameters.settling.maximum_time      = 0;
    parameters.output_directory           = folder.path() + "/first_steps";
    coarsen(parameters, advice.coarser);
    {
      Simulation<dim> simulation(parameters, Start::fresh, communicator);
      const SceneNumbers seeded = survey(simulation, parameters, communicator);
      advice.seen               = measure_first_steps(simulation, seconds_of_steps, communicator);
      advice.scene              = with_cell_size(seeded, advice.grid.cell_size);
      advice.seen               = with_cell_size(advice.seen, seeded, advice.grid.cell_size);
    }
    const double seen = advice.seen.duration();
    if (seen < (1. - 1e-9) * advice.scene.end_time)
      try
        {
          const double of_run         = cost_of_run(advice.scene, advice.seen, advice.schedule).step_seconds;
          advice.pilot_coarser        = coarsening_of_pilot(advice, of_run);
          parameters.output_directory = folder.path() + "/pilot";
          parameters.grid             = advice.grid;
          parameters.time_step        = advice.schedule.time_step;
          coarsen(parameters, advice.pilot_coarser);
          Simulation<dim> pilot(parameters, Start::fresh, communicator);
          advice.seen = with_pilot(advice.seen, measure_run(pilot, seen, 2. * seconds_of_pilot(of_run), communicator));
        }
      catch (const std::exception &fault)
        {
          if (advice.n_ranks > 1) // It may be on one rank only.
            throw;
          advice.pilot_fault = fault.what();
        }
    write_report(advice, out);
  }

  template void advise<2>(Parameters &, const double, const MPI_Comm, std::ostream &);
  template void advise<3>(Parameters &, const double, const MPI_Comm, std::ostream &);
} // namespace scree

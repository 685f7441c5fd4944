// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/run/safety.h>

#include <cstdio>

namespace scree
{
  using namespace dealii;

  bool
  search_factor(const double tolerance, const std::function<TrialEnd(double)> &try_factor, const FactorBracket &bracket)
  {
    constexpr double largest = 100.;
    while (bracket.fails - bracket.rests > tolerance)
      {
        if (try_factor(bracket.next()) == TrialEnd::undecided)
          return false;
        if (bracket.rests > largest)
          throw EntryError("--safety: the soil still comes to rest with its strength divided by " +
                           number_text(bracket.rests) +
                           ", so its own weight does not make it fail. Check that the \"Region\" of the bodies has a "
                           "slope that no obstacle holds, and the direction of \"Gravity\".");
      }
    return true;
  }


  namespace
  {
    void check(const Parameters &parameters)
    {
      require_entry(
          !parameters.bodies.empty(), { "", "Bodies", "none" }, "without soil there is no slope. Name a body.");
      require_entry(!parameters.has_water || parameters.settling.maximum_time > 0.,
                    { "Settling", "Maximum time", parameters.settling.maximum_time },
                    "--safety holds the pore pressure of settled soil. Write a time above 0, in s.");
      for (const BodyParameters &body : parameters.bodies)
        require_entry((body.material.law != "Nor-Sand" && body.material.law != "Nor-Sand (Jefferies-Been)") ||
                          parameters.safety.keeps(body.name),
                      { body.name, "Material", body.material.law },
                      "the hardening of this law depends on the strength that --safety divides. Write Mohr-Coulomb, or "
                      "the body among "
                      "\"Bodies not reduced\" of subsection Safety.");
      require_entry(parameters.time_step.mass_scaling == 1.,
                    { "Time step", "Mass scaling", parameters.time_step.mass_scaling },
                    "the times of --safety are those of the true inertia. Write 1.");
      require_entry(parameters.safety.strength_factor == 1.,
                    { "Safety", "Strength factor", parameters.safety.strength_factor },
                    "--safety searches this factor. Remove the entry.");
      for (const double component : parameters.gravity)
        if (component != 0.)
          return;
      require_entry(false,
                    { "", "Gravity", number_text(parameters.gravity) },
                    "without gravity no slope fails. Write another one.");
    }


    std::string text_of(const TrialEnd end)
    {
      return end == TrialEnd::rests ? "rests" : end == TrialEnd::fails ? "fails" : "stopped";
    }


    /// Trials of a case, one after the other, each a run with a folder of its own.
    template <int dim>
    class Trials
    {
    public:
      Trials(const Parameters &given, const MPI_Comm communicator)
          : given(given)
          , last_stage(given.stages.empty() ? "" : given.stages.back())
          , path(given.output_directory + "/safety")
          , communicator(communicator)
          , folder(path, given.output.screen_kind() == Screen::progress, communicator)
          , rows(folder.file("safety.csv"))
      {
        folder.remove_old_results();
        for (const char *name : { "safety.csv", "settled", "trial", "rests", "fails" })
          remove(name);
      }


      /// Settles, and searches the factor. Throws EntryError if there is none.
      End search()
      {
        const SafetyParameters &safety = given.safety;
        folder.log("Safety      " + given.case_file + " -> " + path);
        folder.log("Rests       where not more than 1 % of the soil is faster than 2e-4 sqrt(gH), during sqrt(H/g)\n"
                   "Fails       where more than 1 % of the soil has moved by " +
                   number_text(safety.displacement) + " H, or still moves after " + number_text(safety.longest_trial) +
                   " sqrt(H/g)");
        const TrialEnd first = settle();
        require_entry(first != TrialEnd::fails,
                      { "", "Bodies", boost::algorithm::join(names_of(given.bodies), ", ") },
                      "the slope does not settle with four times its strength. Write more strength, or a longer "
                      "\"Maximum time\" in subsection Settling.");
        bool has_found = false;
        try
          {
            has_found = first == TrialEnd::rests &&
                        search_factor(
                            safety.tolerance, [&](const double factor) { return try_factor(factor); }, bracket);
          }
        catch (const EntryError &) // on all ranks: there is no factor
          {
            remove("settled");
            throw;
          }
        remove("settled");
        if (!has_found)
          {
            folder.log("Stopped     " + (bracket.rests > 0. ? "factor so far: " + bracket.text() + "; " : "") +
                       "safety.csv has the trials so far");
            return End::stopped;
          }
        const int digits = std::max(0, int(std::ceil(-std::log10(safety.tolerance) - 1e-9)));
        folder.log(formatted("Factor of safety  %.*f (between %.*f and %.*f)",
                             digits,
                             0.5 * (bracket.rests + bracket.fails),
                             digits + 1,
                             bracket.rests,
                             digits + 1,
                             bracket.fails));
        folder.log(
            "Set by      " +
            (failed_by_displacement
                 ? "\"Displacement\" = " + number_text(safety.displacement) +
                       ": the trial beyond the factor ended there, still in motion. A larger value shows whether it "
                       "comes to rest."
                 : std::string("rest: beyond the factor the soil did not come to rest in time, and moved less than "
                               "\"Displacement\".")));
        folder.log("Zone        " + zone);
        folder.log("Results     " + path +
                   ": safety.csv; rests and fails, the trials beside the factor, with solution/points.pvd");
        return End::complete;
      }

    private:
      /// From the start of the case to the state that the other trials begin with, without a bound of the displacement.
      TrialEnd settle()
      {
        constexpr double factor = 0.25; // deforms little beyond elasticity
        std::vector<std::string> stages{ "" };
        stages.insert(stages.end(), given.stages.begin(), given.stages.end());
        std::unique_ptr<Parameters> parameters;
        std::unique_ptr<Simulation<dim>> before; // has written the checkpoint that the next one begins with
        for (const std::string &stage : stages)
          {
            before.reset();
            parameters = parameters_of_trial(factor, "settled", stage);
            before     = std::make_unique<Simulation<dim>>(
                *parameters, stage.empty() ? Start::fresh : Start::new_stage, communicator);
            if (!before->is_settled() || (stage != last_stage && before->run() == End::stopped))
              return TrialEnd::undecided;
          }
        Simulation<dim> &simulation = *before;
        const Trial trial           = simulation.try_strength(std::numeric_limits<double>::infinity());
        if (trial.end == TrialEnd::rests)
          simulation.write_checkpoint();
        bracket.include(factor, trial.end);
        record(factor, trial);
        return trial.end;
      }


      /// From that state.
      TrialEnd try_factor(const double factor)
      {
        Trial trial;
        {
          const auto parameters    = parameters_of_trial(factor, "trial", last_stage);
          parameters->start_folder = path + "/settled";
          Simulation<dim> simulation(*parameters, Start::resume, communicator);
          trial = simulation.try_strength(given.safety.displacement);
          simulation.write_picture();
        }
        bracket.include(factor, trial.end);
        if (trial.end == TrialEnd::fails)
          {
            failed_by_displacement = trial.has_moved;
            zone                   = trial.zone;
          }
        record(factor, trial);
        if (trial.end != TrialEnd::undecided)
          keep_as(text_of(trial.end));
        return trial.end;
      }


      /// Removes what only the search needs. Collective.
      void remove(const std::string &name)
      {
        MPI_Barrier(communicator);
        if (folder.is_writer())
          std::filesystem::remove_all(folder.file(name));
        MPI_Barrier(communicator);
      }


      /// @param name of its folder
      std::unique_ptr<Parameters>
      parameters_of_trial(const double factor, const std::string &name, const std::string &stage)
      {
        auto parameters = std::make_unique<Parameters>(given.case_file, stage);
        parameters->set("", "Output directory", path + '/' + name);
        parameters->set("Output", "Screen", "nothing");
        if (given.output.graphics_kind() == Pictures::none)
          parameters->set("Output", "Graphics", "points");
        parameters->reduce_strength(factor);
        return parameters;
      }


      /// The folder of the last trial gets this name. Collective.
      void keep_as(const std::string &name)
      {
        remove(name);
        if (folder.is_writer())
          std::filesystem::rename(folder.file("trial"), folder.file(name));
        MPI_Barrier(communicator);
      }


      void record(const double factor, const Trial &trial)
      {
        if (rows.is_empty())
          folder.log("   factor   trial   displacement (m)   time (s)    steps   range so far       trials left");
        const unsigned int n_left = bracket.n_left(given.safety.tolerance);
        folder.log(formatted("   %-6.4g   %-7s %16.4g   %8.3f  %7llu   %-16s   %u, about %s",
                             factor,
                             text_of(trial.end).c_str(),
                             trial.displacement,
                             trial.time,
                             trial.steps,
                             bracket.text().c_str(),
                             n_left,
                             duration(n_left * clock.wall_time() / ++n_trials).c_str()));
        if (!folder.is_writer() || trial.end == TrialEnd::undecided)
          return;
        if (rows.is_empty())
          rows.append(csv_head({ "Factor (-)", "Rests (-)", "Displacement (m)", "Time (s)", "Steps (-)" }));
        rows.append(csv_row(
            { factor, double(trial.end == TrialEnd::rests), trial.displacement, trial.time, double(trial.steps) }));
      }

      const Parameters &given;
      const std::string last_stage; // after whose settling the factor is; empty: of the case itself
      const std::string path;
      const MPI_Comm communicator;
      RunFolder folder;
      RowFile rows;
      FactorBracket bracket;
      Timer clock; // of all trials
      unsigned int n_trials       = 0;
      bool failed_by_displacement = false; // the last trial that failed
      std::string zone;                    // the same
    };
  } // namespace


  template <int dim>
  End find_safety(const Parameters &parameters, const MPI_Comm communicator)
  {
    check(parameters);
    for (const std::string &stage : parameters.stages)
      check(Parameters(parameters.case_file, stage));
    Parameters(parameters.case_file).reduce_strength(0.5); // throws if there is none, before files
    return Trials<dim>(parameters, communicator).search();
  }

  template End find_safety<2>(const Parameters &, const MPI_Comm);
  template End find_safety<3>(const Parameters &, const MPI_Comm);
} // namespace scree

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_run_results_h
#define scree_run_results_h

#include <scree/io/files.h>
#include <scree/io/output_parameters.h>
#include <scree/io/run_folder.h>
#include <scree/model/scene.h>
#include <scree/postprocess/checks.h>
#include <scree/postprocess/graphics.h>
#include <scree/postprocess/maps.h>
#include <scree/postprocess/probes.h>
#include <scree/postprocess/statistics.h>
#include <scree/schemes/scheme.h>

#include <string>

namespace scree
{
  /// What a run has come to, beside its points.
  template <int dim>
  struct RunState
  {
    const RunBalance<dim> &totals;   ///< of this rank
    const UpdateReport &last_update; ///< of this rank
    double time;                     ///< s
    unsigned long long step;         ///< number of the time step
    double time_step;                ///< the last one, s
  };

  /// What is written of a run to be looked at: statistics, probes, maps and pictures.
  template <int dim>
  class Results
  {
  public:
    /// All are kept by reference.
    Results(const Parameters &parameters, const Scene<dim> &scene, Scheme<dim> &scheme, RunFolder &folder);

    /// Writes what is due. Collective.
    void report(const RunState<dim> &state, const OutputTimes &output_times);

    /// Output of the state as it is. Collective.
    void write_row(const RunState<dim> &state);

    /// Pictures, lines and maps of the state as it is: gathered here, and written while the run goes on. Collective.
    void write_picture(const RunState<dim> &state);

    /// Writes the files of a checkpoint of `time`, s, while the run goes on; if that fails, the run stops, as the
    /// case says. Collective.
    void write_checkpoint(FileJob job);

    /// What writes pictures, maps and checkpoints.
    BackgroundWriter &writer()
    {
      return files;
    }

    /// Brings all rows to the disk, before a checkpoint counts on them.
    void sync();

    /// After a checkpoint has been read: drops from lists and rows what was written after it.
    void cut();

    /// Adds to the checks that are reported at the end of the run.
    void add_checks(const std::vector<CheckResult> &results)
    {
      found.insert(found.end(), results.begin(), results.end());
    }

    /// At the end of a run: reports where the results are, and writes rows that the disk did not take. Throws FileError
    /// if it still refuses them.
    void complete();

    /// Steps of the run at the last row.
    unsigned long long step_of_last_row() const
    {
      return statistics.step_of_last_row();
    }

    /// Saves or loads the state of all files (Boost).
    template <class Archive>
    void serialize(Archive &archive)
    {
      archive &statistics &graphics &rows &probes &maps &found &checks &balances;
    }

  private:
    /// Where the results are.
    std::string text_of_results() const;

    ProbedState<dim> probed_state(const RunState<dim> &state, const WaterView<dim> *view) const;

    const Parameters &parameters;
    const Scene<dim> &scene;
    Scheme<dim> &scheme;
    RunFolder &folder;
    Graphics<dim> graphics;
    Statistics<dim> statistics;
    TableFile rows; // of the statistics
    Probes<dim> probes;
    Maps<dim> maps;
    std::vector<CheckResult> found; // in checks that have ended
    RunChecks<dim> checks;
    BalanceChecks<dim> balances;
    BackgroundWriter files; // the last member: its jobs use others
  };
} // namespace scree

#endif

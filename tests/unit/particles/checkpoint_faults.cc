// SPDX-License-Identifier: LGPL-2.1-or-later
// Checkpoints of two sets of points, one of them empty, come back to the last digit. Of two checkpoints, damage to the
// newer one is named and the older one is read; damage to both is an error.
#include "../test.h"

#include <scree/input/input_error.h>
#include <scree/io/checkpoint.h>
#include <scree/io/files.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <sys/stat.h>

namespace test_checkpoint_faults
{
namespace fs = std::filesystem;

bool is_first()
{
  return Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
}

/// What a run has: a mesh, points, a state. Made without points, as a scene is.
template <int dim>
struct Run
{
  BackgroundGrid<dim> grid{ grid_box<dim>(0., 0.4), MPI_COMM_WORLD };
  PointSet<dim> points{ grid.triangulation(), grid.mapping(), 3 }, none{ grid.triangulation(), grid.mapping(), 2 };
  double state = 0.;

  void fill()
  {
    grid.change_cells(nullptr); // a fresh grid is all on one rank
    unsigned int id = 0;
    for (const auto &cell : grid.triangulation().active_cell_iterators())
      for (unsigned int p = 0; p < 3; ++p, ++id)
        if (cell->is_locally_owned())
          {
            const auto place   = point_of<dim>([&](const unsigned int a) { return 0.1 + 0.3 * p + 0.01 * a; });
            const Point<dim> x = grid.mapping().transform_unit_to_real_cell(cell, place);
            points.add(cell, x, 2 * id, { x[0], x[1] / 3., 1. / 7. });
          }
    points.finish_adding();
    points.handler().update_cached_numbers();
  }

  void step()
  {
    for_each_point(points, [](const auto &point) { point.properties[2] += point.properties[0] / 3.; });
    state += 1.;
  }

  /// Depends on all digits of all points, but not on the ranks they are on.
  double sum() const
  {
    double result = 0.;
    for (const auto &point : points.handler())
      result += std::fmod(1e6 * (1 + point.get_id()) *
                              (point.get_properties()[2] + point.get_properties()[1] + 7. * point.get_location()[0] +
                               point.get_reference_location()[1]),
                          1.);
    return sum_of_ranks(result) + 1000. * state + points.handler().n_global_particles() +
           none.handler().n_global_particles();
  }

  void save(const std::string &folder)
  {
    const CaseEntries entries("\tEnd time\t" + std::to_string(state) + "\t\n");
    BackgroundWriter writer(MPI_COMM_WORLD);
    writer.start(checkpoint_files<dim>(
        folder, 0.1 * state, std::uint64_t(state), entries, grid, { &points, &none }, [&](auto &archive) {
          archive << state;
        }));
    writer.finish();
  }

  void load(const std::string &folder, const std::function<void(const std::string &)> &log)
  {
    const Checkpoint checkpoint = find_checkpoint(folder, log, MPI_COMM_WORLD);
    load_checkpoint<dim>(checkpoint, grid, { &points, &none }, [&](auto &archive) { archive >> state; });
  }
};


/// What a run reads that goes on from the folder: "step 2", or why there is none.
template <int dim>
std::string outcome(const std::string &folder, const std::vector<double> &sums)
{
  std::string text;
  try
    {
      Run<dim> run;
      run.load(folder, [&](const std::string &line) { text += line + ' '; });
      const double difference = std::abs(run.sum() - sums.at(static_cast<unsigned int>(run.state)));
      text += difference < 1e-6 ? "Step " + std::to_string(int(run.state)) : "WRONG by " + number_text(difference);
    }
  catch (const EntryError &error)
    {
      text += error.what();
    }
  return text;
}


void copy_folder(const std::string &from, const std::string &to)
{
  if (is_first())
    {
      fs::remove_all(to);
      fs::copy(from, to, fs::copy_options::recursive);
    }
  MPI_Barrier(MPI_COMM_WORLD);
}


void set_content(const std::string &file, const std::string &content)
{
  std::ofstream(file, std::ios::binary) << content;
}

/// Changes a bit, at a place from 0 to 1.
void flip(const std::string &file, const double where)
{
  std::string content = read_whole_file(file);
  content[std::size_t(where * (content.size() - 1))] ^= 4;
  set_content(file, content);
}


const std::string newer = "run/checkpoint/step-2/", older = "run/checkpoint/step-1/";
const std::string not_used = "The checkpoint run/checkpoint/step-2 is damaged and not used. ";

std::vector<double> whole_sums; // of the whole run after each step

/// What befalls the run, and what is said then.
void test_damage(const std::function<void()> &damage, const std::string &expected)
{
  copy_folder("whole", "run");
  if (is_first())
    damage();
  MPI_Barrier(MPI_COMM_WORLD);
  // Sizes are those of boost's archives.
  const std::string found =
      std::regex_replace(outcome<2>("run", whole_sums), std::regex("[0-9]+ (bytes,|were)"), "some $1");
  expect_text(found, expected, "what is said");
}


/// Damage to each file of the newer checkpoint.
void test_files()
{
  RandomNumbers random;
  const std::string checksum = "is not what was written (its checksum differs)";
  std::vector<std::string> files{ "manifest" };
  for (unsigned int rank = 0; rank < Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD); ++rank)
    files.push_back("points." + std::to_string(rank));
  for (const std::string &name : files)
    {
      const std::string file = newer + name;
      const auto test =
          [&](const std::function<void()> &damage, const std::string &reason, const std::string &manifest = "") {
            const bool is_other = name == "manifest" && !manifest.empty();
            test_damage(damage, not_used + file + ": " + (is_other ? manifest : reason) + ". Step 1");
          };
      for (const double where : { 0., random.uniform(0, 1), random.uniform(0, 1), 1. })
        test([&] { flip(file, where); }, checksum);
      const std::string size = "has some bytes, but some were written";
      for (const double part : { 0., random.uniform(0, 1), 1. })
        test([&] { fs::resize_file(file, std::size_t(part * (fs::file_size(file) - 1))); }, size, checksum);
      test([&] { set_content(file, read_whole_file(file) + '\n'); }, size, checksum);
      test([&] { set_content(file, std::string(fs::file_size(file), '\0')); }, checksum);
      test([&] { fs::remove(file); }, "is missing");
      for (const bool is_folder : { true, false })
        test(
            [&] {
              fs::remove(file);
              require(is_folder ? fs::create_directory(file) : mkfifo(file.c_str(), 0600) == 0, "It cannot be made.");
            },
            "is no file");
      const auto overwrite = [&](const std::string &from) {
        fs::copy_file(from, file, fs::copy_options::overwrite_existing);
      };
      test([&] { overwrite(older + name); }, checksum, "belongs to step 1, not to this folder");
      test([&] { overwrite(newer + (name == "manifest" ? "points.0" : "manifest")); }, size, checksum);
    }
}


/// What befalls whole checkpoints.
void test_folders()
{
  const auto clear_newer = [] {
    fs::remove_all(newer);
    fs::create_directory(newer);
  };
  test_damage([] {}, "Step 2");
  test_damage([] { fs::remove_all(newer); }, "Step 1");
  test_damage(clear_newer, not_used + newer + "manifest: is missing. Step 1");
  test_damage([] { set_content(newer + "manifest", "Scree checkpoint, format 1\nchecksum: 87f4fa9080897eca\n"); },
              not_used + newer +
                  "manifest: begins with \"Scree checkpoint, format 1\", but this program reads \"Scree " +
                  "checkpoint, format 26\". Step 1");
  test_damage(
      [&] {
        clear_newer();
        fs::copy(older, newer, fs::copy_options::recursive);
      },
      not_used + newer + "manifest: belongs to step 1, not to this folder. Step 1");
  test_damage([] { flip(older + "points.0", 0.5); }, "Step 2");
  test_damage([] { fs::copy(older, "run/checkpoint/unfinished"); }, "Step 2");
  test_damage([] { fs::create_directory("run/checkpoint/step-9a"); }, "Step 2");
  const std::string faults  = newer + "points.0: is not what was written (its checksum differs). ",
                    missing = older + "manifest: is missing. ", entry = "entry \"Output directory\" = run: ";
  test_damage(
      [] {
        flip(newer + "points.0", 0.5);
        fs::remove(older + "manifest");
      },
      not_used + faults + "The checkpoint run/checkpoint/step-1 is damaged and not used. " + missing + entry +
          "no checkpoint there is whole. " + faults + missing + "Bring the files back, or run without --resume.");
}


template <int dim>
std::vector<double> test_return(const std::string &folder)
{
  Run<dim> run;
  run.fill();
  std::vector<double> sums{ run.sum() };
  for (unsigned int step = 0; step < 4; ++step)
    {
      run.save(folder);
      const std::string found = outcome<dim>(folder, sums);
      require(found == "Step " + std::to_string(step), found);
      std::vector<std::string> wanted{ folder + "/checkpoint/step-" + std::to_string(step) };
      if (step > 0)
        wanted.push_back(folder + "/checkpoint/step-" + std::to_string(step - 1));
      require(whole_checkpoints(folder) == wanted, "There should be this checkpoint and the one before.");
      run.step();
      sums.push_back(run.sum());
    }
  return sums;
}


const UnitTest registered("checkpoint_faults", [] {
  test_return<3>("run_3d");
  whole_sums = test_return<2>("run_2d");

  Run<2> run;
  run.fill();
  for (unsigned int step = 0; step < 2; ++step)
    {
      run.step();
      run.save("whole");
    }
  test_files();
  test_folders();
});
} // namespace test_checkpoint_faults

// Runs with mpirun=1,2.

// SPDX-License-Identifier: LGPL-2.1-or-later

// Checkpoints of two sets of points, one of them empty, come back to the last digit. Of two checkpoints, damage to the
// newer one is named and the older one is read; damage to both is an error. A disk that is full while a checkpoint is
// written costs no older one.
#include "../test.h"

#include <scree/input/input_error.h>
#include <scree/io/checkpoint.h>
#include <scree/io/files.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sys/resource.h>
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
  BackgroundGrid<dim> grid;
  PointSet<dim> points, none;
  double state = 0.;

  Run()
      : grid(grid_box<dim>(0., 0.4), MPI_COMM_WORLD)
      , points(grid.triangulation(), grid.mapping(), 3)
      , none(grid.triangulation(), grid.mapping(), 2)
  {
  }

  void fill()
  {
    grid.triangulation().repartition(); // a fresh grid is all on one rank
    unsigned int id = 0;
    for (const auto &cell : grid.triangulation().active_cell_iterators())
      for (unsigned int p = 0; p < 3; ++p, ++id)
        if (cell->is_locally_owned())
          {
            Point<dim> place;
            for (unsigned int a = 0; a < dim; ++a)
              place[a] = 0.1 + 0.3 * p + 0.01 * a;
            const Point<dim> x = grid.mapping().transform_unit_to_real_cell(cell, place);
            points.handler().insert_particle(x, place, 2 * id, cell, std::vector<double>{ x[0], x[1] / 3., 1. / 7. });
          }
    points.handler().update_cached_numbers();
    none.handler().update_cached_numbers();
    points.sort();
    none.sort();
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
    return Utilities::MPI::sum(result, MPI_COMM_WORLD) + 1000. * state + points.handler().n_global_particles() +
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


/// Sizes are those of boost's archives, free space is the machine's.
std::string without_sizes(const std::string &text)
{
  return std::regex_replace(std::regex_replace(text, std::regex(", [0-9]+ are free on that disk"), ""),
                            std::regex("[0-9]+ (bytes in|bytes are|bytes,|were)"),
                            "some $1");
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


std::string content_of(const std::string &file)
{
  std::ifstream in(file, std::ios::binary);
  return { std::istreambuf_iterator<char>(in), {} };
}

void set_content(const std::string &file, const std::string &content)
{
  std::ofstream(file, std::ios::binary) << content;
}

void flip(const std::string &file, const double where)
{
  std::string content = content_of(file);
  content[std::size_t(where * (content.size() - 1))] ^= 4;
  set_content(file, content);
}


using Damage = std::pair<std::string, std::function<void()>>;

/// What can befall one file of the newer checkpoint.
std::vector<Damage> damage_to(const std::string &folder, const std::string &name)
{
  const std::string file = folder + "/checkpoint/step-2/" + name, older = folder + "/checkpoint/step-1/" + name;
  const std::string other = folder + "/checkpoint/step-2/" + (name == "state" ? "entries" : "state");
  return { { "first bit", [=] { flip(file, 0.); } },
           { "a bit in the middle", [=] { flip(file, 0.5); } },
           { "last bit", [=] { flip(file, 1.); } },
           { "one byte less", [=] { fs::resize_file(file, fs::file_size(file) - 1); } },
           { "half of it", [=] { fs::resize_file(file, fs::file_size(file) / 2); } },
           { "empty", [=] { fs::resize_file(file, 0); } },
           { "a byte more", [=] { set_content(file, content_of(file) + '\n'); } },
           { "zeros", [=] { set_content(file, std::string(fs::file_size(file), '\0')); } },
           { "missing", [=] { fs::remove(file); } },
           { "a folder",
             [=] {
               fs::remove(file);
               fs::create_directory(file);
             } },
           { "a pipe",
             [=] {
               fs::remove(file);
               AssertThrow(mkfifo(file.c_str(), 0600) == 0, ExcInternalError());
             } },
           { "that of the older one", [=] { fs::copy_file(older, file, fs::copy_options::overwrite_existing); } },
           { "another file", [=] { fs::copy_file(other, file, fs::copy_options::overwrite_existing); } } };
}


/// What can befall whole checkpoints.
std::vector<Damage> damage_to_folders(const std::string &folder)
{
  const std::string newer = folder + "/checkpoint/step-2", older = folder + "/checkpoint/step-1";
  return { { "nothing", [=] {} },
           { "newer one missing", [=] { fs::remove_all(newer); } },
           { "newer one empty",
             [=] {
               fs::remove_all(newer);
               fs::create_directory(newer);
             } },
           { "newer one of another format",
             [=] { set_content(newer + "/manifest", "Scree checkpoint, format 1\nchecksum: 87f4fa9080897eca\n"); } },
           { "the older one under the newer name",
             [=] {
               fs::remove_all(newer);
               fs::copy(older, newer, fs::copy_options::recursive);
             } },
           { "older one damaged", [=] { flip(older + "/state", 0.5); } },
           { "one that was not finished", [=] { fs::copy(older, folder + "/checkpoint/unfinished"); } },
           { "a stranger's folder", [=] { fs::create_directory(folder + "/checkpoint/step-9a"); } },
           { "both damaged",
             [=] {
               flip(newer + "/points.0", 0.5);
               fs::remove(older + "/manifest");
             } },
           { "none left", [=] { fs::remove_all(folder + "/checkpoint"); } } };
}


/// While it lives, no file of this rank can grow beyond `n_bytes`: as if the disk were full.
class FullDisk
{
public:
  explicit FullDisk(const rlim_t n_bytes)
  {
    std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &before);
    const rlimit limit{ n_bytes, before.rlim_max };
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FullDisk()
  {
    setrlimit(RLIMIT_FSIZE, &before);
  }

private:
  rlimit before;
};


/// The error of a third checkpoint, with room for files of so many bytes on this rank; no older checkpoint is lost, and
/// nothing left of it.
std::string fault_of_full_disk(const std::vector<double> &sums, const rlim_t n_bytes)
{
  copy_folder("whole", "full");
  Run<2> run;
  run.grid.triangulation().repartition();
  run.load("full", [](const auto &) {});
  run.step();
  std::string fault;
  try
    {
      const FullDisk disk(n_bytes);
      run.save("full");
    }
  catch (const EntryError &error)
    {
      fault = without_sizes(error.what());
    }
  const std::string found = outcome<2>("full", sums), wanted = fault.empty() ? "Step 3" : "Step 2";
  require(found == wanted, found + " instead of " + wanted + " after " + fault);
  require(!fs::exists("full/checkpoint/unfinished"), "Rubbish is left after " + fault);
  return fault;
}


/// A disk that is full for all ranks or the first one: the same error; for another one: that of its points.
void test_full_disk(const std::vector<double> &sums)
{
  const unsigned int rank = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
  for (const rlim_t n_bytes : { 0u, 30u, 150u, 10000u })
    {
      const std::string fault = fault_of_full_disk(sums, n_bytes);
      std::cout << "room for " << n_bytes << " bytes: " << (fault.empty() ? "no error" : fault) << std::endl;
      for (unsigned int full_rank = 0; full_rank < Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD); ++full_rank)
        {
          const std::string file  = "full/checkpoint/unfinished/points." + std::to_string(full_rank);
          const std::string found = fault_of_full_disk(sums, rank == full_rank ? n_bytes : RLIM_INFINITY);
          const std::string wanted =
              full_rank == 0 || fault.empty() ? fault : file + fault.substr(fault.find(": cannot be written"));
          require(found == wanted, found + " instead of " + wanted);
        }
    }
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
      std::cout << dim << "D " << outcome<dim>(folder, sums) << ", checkpoints:";
      for (const std::string &name : whole_checkpoints(folder))
        std::cout << ' ' << name;
      std::cout << std::endl;
      run.step();
      sums.push_back(run.sum());
    }
  return sums;
}


void run()
{
  for (const std::string folder : { "run_2d", "run_3d", "whole" })
    if (is_first())
      fs::remove_all(folder);
  test_return<3>("run_3d");
  const std::vector<double> sums = test_return<2>("run_2d");

  Run<2> run;
  run.fill();
  for (unsigned int step = 0; step < 2; ++step)
    {
      run.step();
      run.save("whole");
    }

  std::vector<std::string> files{ "manifest", "entries", "state" };
  for (unsigned int rank = 0; rank < Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD); ++rank)
    files.push_back("points." + std::to_string(rank));
  const auto test = [&](const Damage &damage) {
    copy_folder("whole", "run");
    if (is_first())
      damage.second();
    MPI_Barrier(MPI_COMM_WORLD);
    return without_sizes(outcome<2>("run", sums));
  };
  // What is said of the same damage to each file, FILE; the ranks' points count as one file, of which all say the same.
  for (unsigned int i = 0; i < damage_to("run", "state").size(); ++i)
    {
      std::map<std::string, std::set<std::string>> files_of;
      for (const std::string &file : files)
        {
          const Damage damage = damage_to("run", file)[i];
          files_of[damage.first + ": " + std::regex_replace(test(damage), std::regex("/" + file + ":"), "/FILE:")]
              .insert(file.substr(0, file.find('.')));
        }
      for (const auto &said : files_of)
        {
          for (const std::string &file : said.second)
            std::cout << file << ' ';
          std::cout << said.first << std::endl;
        }
    }
  for (const Damage &damage : damage_to_folders("run"))
    std::cout << damage.first << ": " << test(damage) << std::endl;
  test_full_disk(sums);
}

const UnitTest registered("checkpoint_faults", run);
} // namespace test_checkpoint_faults

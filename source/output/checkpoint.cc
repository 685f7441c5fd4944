// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/input/input_error.h>
#include <scree/output/checkpoint.h>

#include <deal.II/base/mpi.h>

#include <boost/serialization/string.hpp>
#include <boost/serialization/utility.hpp>
#include <boost/serialization/vector.hpp>

#include <filesystem>
#include <fstream>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// Names in the folder alternate, so that one whole checkpoint is always there.
    std::string other(const std::string &name)
    {
      return name == "a" ? "b" : "a";
    }

    std::string latest(const std::string &folder)
    {
      std::string name;
      std::ifstream in(folder + "latest");
      in >> name;
      return name;
    }
  } // namespace


  template <int dim>
  void save_checkpoint(const std::string &run_folder,
                       const BackgroundGrid<dim> &grid,
                       const std::vector<PointSet<dim> *> &sets,
                       const std::function<void(boost::archive::binary_oarchive &)> &state)
  {
    const std::string folder    = run_folder + "/checkpoint/";
    const MPI_Comm communicator = grid.triangulation().get_communicator();
    const bool writer           = Utilities::MPI::this_mpi_process(communicator) == 0;
    if (writer)
      std::filesystem::create_directories(folder);
    const std::string name = Utilities::MPI::broadcast(communicator, other(latest(folder)));

    for (PointSet<dim> *points : sets)
      points->handler().prepare_for_serialization();
    grid.triangulation().save(folder + name + ".mesh");
    if (writer)
      {
        std::ofstream file(folder + name + ".state", std::ios::binary);
        boost::archive::binary_oarchive archive(file);
        for (PointSet<dim> *points : sets)
          archive << points->handler();
        state(archive);
      }
    MPI_Barrier(communicator);
    if (writer)
      {
        std::ofstream(folder + "latest.new") << name << '\n';
        std::filesystem::rename(folder + "latest.new", folder + "latest");
      }
  }


  template <int dim>
  void load_checkpoint(const std::string &run_folder,
                       BackgroundGrid<dim> &grid,
                       const std::vector<PointSet<dim> *> &sets,
                       const std::function<void(boost::archive::binary_iarchive &)> &state)
  {
    const std::string folder = run_folder + "/checkpoint/";
    const std::string name   = latest(folder);
    require_entry(!name.empty(),
                  "",
                  "Output directory",
                  run_folder,
                  "there is no checkpoint to resume from. Write a \"Checkpoint interval\" in subsection Output and run "
                  "without --resume first.");

    grid.load(folder + name + ".mesh");
    std::ifstream file(folder + name + ".state", std::ios::binary);
    boost::archive::binary_iarchive archive(file);
    for (PointSet<dim> *points : sets)
      archive >> points->handler();
    for (PointSet<dim> *points : sets)
      {
        points->handler().deserialize();
        points->sort();
      }
    state(archive);
  }

  template void save_checkpoint(const std::string &,
                                const BackgroundGrid<2> &,
                                const std::vector<PointSet<2> *> &,
                                const std::function<void(boost::archive::binary_oarchive &)> &);
  template void save_checkpoint(const std::string &,
                                const BackgroundGrid<3> &,
                                const std::vector<PointSet<3> *> &,
                                const std::function<void(boost::archive::binary_oarchive &)> &);
  template void load_checkpoint(const std::string &,
                                BackgroundGrid<2> &,
                                const std::vector<PointSet<2> *> &,
                                const std::function<void(boost::archive::binary_iarchive &)> &);
  template void load_checkpoint(const std::string &,
                                BackgroundGrid<3> &,
                                const std::vector<PointSet<3> *> &,
                                const std::function<void(boost::archive::binary_iarchive &)> &);
} // namespace scree

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/input/input_error.h>
#include <scree/io/byte_reader.h>
#include <scree/io/checkpoint.h>
#include <scree/io/packed_points.h>
#include <scree/io/whole_file.h>
#include <scree/version.h>

#include <deal.II/base/mpi.h>

#include <boost/serialization/string.hpp>
#include <boost/serialization/utility.hpp>
#include <boost/serialization/vector.hpp>

#include <memory>
#include <sstream>

namespace scree
{
  using namespace dealii;

  namespace
  {
    const std::string name_of_entries = "entries", name_of_state = "state", name_of_points = "points.",
                      name_of_mesh = "mesh.";

    /// The fault of the first rank that has one, on all ranks. Collective.
    std::string fault_of_any_rank(const std::string &fault, const MPI_Comm communicator)
    {
      std::string result;
      for (const std::string &other : Utilities::MPI::all_gather(communicator, fault))
        if (result.empty())
          result = other;
      return result;
    }

    /// Reads all points of a checkpoint, of which this rank keeps those in its cells; returns how many each set has.
    template <int dim>
    std::vector<std::uint64_t>
    read_points(const Checkpoint &checkpoint, const Triangulation<dim> &mesh, const std::vector<PointSet<dim> *> &sets)
    {
      AssertThrow(checkpoint.manifest.dimension == dim, ExcMessage("It is of another dimension than the case."));
      const OwnCells<dim> cells = own_cells(mesh);
      std::vector<std::uint64_t> n_points(sets.size(), 0);
      for (const CheckedFile &file : checkpoint.manifest.files)
        if (file.name.rfind(name_of_points, 0) == 0)
          {
            const std::string content = read_checked_file(checkpoint.folder, file);
            ByteReader reader(checkpoint.folder + '/' + file.name, content);
            for (unsigned int s = 0; s < sets.size(); ++s)
              n_points[s] += unpack_points(reader, cells, *sets[s]);
          }
      return n_points;
    }


    /// The blocks of fine cells of all ranks.
    Blocks read_blocks(const Checkpoint &checkpoint)
    {
      Blocks blocks;
      for (const CheckedFile &file : checkpoint.manifest.files)
        if (file.name.rfind(name_of_mesh, 0) == 0)
          {
            const std::string content = read_checked_file(checkpoint.folder, file);
            const std::size_t n = content.size() / sizeof(Blocks::value_type), n_before = blocks.size();
            blocks.resize(n_before + n);
            ByteReader(checkpoint.folder + '/' + file.name, content).take(blocks.data() + n_before, n);
          }
      return blocks;
    }


    void read_state(const Checkpoint &checkpoint, const std::function<void(boost::archive::binary_iarchive &)> &state)
    {
      std::istringstream in(read_checked_file(checkpoint.folder, checkpoint.manifest.file(name_of_state)));
      boost::archive::binary_iarchive archive(in);
      state(archive);
      if (in.peek() != std::istringstream::traits_type::eof())
        throw FileError(checkpoint.folder + '/' + name_of_state + ": holds more than this program reads");
    }


    std::string packed_state(const std::function<void(boost::archive::binary_oarchive &)> &state)
    {
      std::ostringstream out;
      boost::archive::binary_oarchive archive(out);
      state(archive);
      return out.str();
    }


    std::string first_line(const std::string &text)
    {
      return text.substr(0, text.find('\n'));
    }


    /// What the message about a failed checkpoint contains.
    std::string what_is_left(const CheckpointFolder &folder, const Manifest &manifest)
    {
      std::string names;
      for (const std::string &name : folder.whole())
        names += (names.empty() ? "" : " and ") + name;
      return " The checkpoint at t = " + number_text(manifest.time) + " s needs " + std::to_string(manifest.size()) +
             " bytes in all. " + (names.empty() ? "There is no older one." : "Still whole: " + names + '.');
    }
  } // namespace


  template <int dim>
  FileJob checkpoint_files(const std::string &run_folder,
                           const double time,
                           const std::uint64_t step,
                           const CaseEntries &entries,
                           const BackgroundGrid<dim> &grid,
                           const std::vector<PointSet<dim> *> &sets,
                           const std::function<void(boost::archive::binary_oarchive &)> &state)
  {
    const CheckpointFolder folder(run_folder);
    const MPI_Comm communicator = grid.communicator();
    const unsigned int rank     = Utilities::MPI::this_mpi_process(communicator);

    const auto contents = std::make_shared<std::vector<FileContent>>();
    std::vector<CheckedFile> own;
    const auto add = [&](const std::string &name, std::string content) {
      own.push_back(checked_file(name, content));
      contents->emplace_back(folder.unfinished + '/' + name, std::move(content));
    };
    if (rank == 0)
      add(name_of_entries, entries.text());
    if (grid.follows_points())
      {
        const Blocks blocks = grid.fine_blocks();
        std::string bytes;
        append_bytes(bytes, blocks.data(), blocks.size());
        add(name_of_mesh + std::to_string(rank), std::move(bytes));
      }
    add(name_of_points + std::to_string(rank), pack_points(sets));
    if (rank == 0)
      add(name_of_state, packed_state(state));
    Manifest manifest{ first_line(version_text()), dim, time, step, {} };
    for (const auto &files : Utilities::MPI::all_gather(communicator, own))
      manifest.files.insert(manifest.files.end(), files.begin(), files.end());

    FileJob job;
    job.stages.resize(3);
    job.stages[1] = [=] {
      write_whole_files(*contents);
      for (const CheckedFile &file : own)
        read_checked_file(folder.unfinished, file);
    };
    if (rank == 0)
      {
        job.stages[0] = [=] { folder.begin(); };
        job.stages[2] = [=] { folder.finish(manifest); };
      }
    job.failed = [=](const std::string &fault) {
      if (rank == 0)
        folder.abandon();
      throw_on_all_ranks(rank == 0 ? fault + what_is_left(folder, manifest) : "", communicator);
    };
    return job;
  }


  Checkpoint find_checkpoint(const std::string &run_folder,
                             const std::function<void(const std::string &)> &log,
                             const MPI_Comm communicator)
  {
    const unsigned int rank    = Utilities::MPI::this_mpi_process(communicator);
    const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(communicator);
    std::string faults;
    for (const std::string &folder : Utilities::MPI::broadcast(communicator, CheckpointFolder(run_folder).all()))
      {
        Checkpoint checkpoint{ folder, {}, {} };
        const std::string fault        = fault_of([&] {
          checkpoint.manifest = Manifest::read(folder);
          checkpoint.entries  = CaseEntries(read_checked_file(folder, checkpoint.manifest.file(name_of_entries)));
          const auto &files   = checkpoint.manifest.files;
          for (unsigned int f = rank; f < files.size(); f += n_ranks)
            read_checked_file(folder, files[f]);
        });
        const std::string fault_of_all = fault_of_any_rank(fault, communicator);
        if (fault_of_all.empty())
          return checkpoint;
        log("The checkpoint " + folder + " is damaged and not used. " + fault_of_all + '.');
        faults += ' ' + fault_of_all + '.';
      }
    require_entry(!faults.empty(),
                  "",
                  "Output directory",
                  run_folder,
                  "there is no checkpoint to resume from. Write a \"Checkpoint interval\" in subsection Output and run "
                  "without --resume first.");
    throw EntryError(
        entry_message("",
                      "Output directory",
                      run_folder,
                      "no checkpoint there is whole." + faults + " Bring the files back, or run without --resume."));
  }


  template <int dim>
  void load_checkpoint(const Checkpoint &checkpoint,
                       BackgroundGrid<dim> &grid,
                       const std::vector<PointSet<dim> *> &sets,
                       const std::function<void(boost::archive::binary_iarchive &)> &state)
  {
    const MPI_Comm communicator = grid.communicator();
    const auto on_all_ranks     = [&](const std::function<void()> &action) {
      const std::string fault = fault_of(action);
      throw_on_all_ranks(fault.empty() ? ""
                                       : "The checkpoint " + checkpoint.folder + " of " + checkpoint.manifest.program +
                                             " cannot be read. " + fault,
                         communicator);
    };
    for (PointSet<dim> *points : sets)
      points->handler().clear_particles();
    if (grid.follows_points())
      {
        Blocks blocks;
        on_all_ranks([&] { blocks = read_blocks(checkpoint); });
        make_unique(blocks);
        grid.refine(blocks, Shares::even);
      }
    std::vector<std::uint64_t> n_points;
    on_all_ranks([&] { n_points = read_points(checkpoint, grid.triangulation(), sets); });
    for (PointSet<dim> *points : sets)
      {
        points->handler().update_cached_numbers();
        points->sort(); // brings the points of a cell together in memory
      }
    on_all_ranks([&] {
      for (unsigned int s = 0; s < sets.size(); ++s)
        AssertThrow(sets[s]->handler().n_global_particles() == n_points[s],
                    ExcMessage("Points lie in cells that the case does not have."));
      read_state(checkpoint, state);
    });
  }

  template FileJob checkpoint_files(const std::string &,
                                    const double,
                                    const std::uint64_t,
                                    const CaseEntries &,
                                    const BackgroundGrid<2> &,
                                    const std::vector<PointSet<2> *> &,
                                    const std::function<void(boost::archive::binary_oarchive &)> &);
  template FileJob checkpoint_files(const std::string &,
                                    const double,
                                    const std::uint64_t,
                                    const CaseEntries &,
                                    const BackgroundGrid<3> &,
                                    const std::vector<PointSet<3> *> &,
                                    const std::function<void(boost::archive::binary_oarchive &)> &);
  template void load_checkpoint(const Checkpoint &,
                                BackgroundGrid<2> &,
                                const std::vector<PointSet<2> *> &,
                                const std::function<void(boost::archive::binary_iarchive &)> &);
  template void load_checkpoint(const Checkpoint &,
                                BackgroundGrid<3> &,
                                const std::vector<PointSet<3> *> &,
                                const std::function<void(boost::archive::binary_iarchive &)> &);
} // namespace scree

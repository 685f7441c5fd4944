// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/io/checkpoint.h>
#include <scree/version.h>

#include <boost/range/adaptor/map.hpp>

#include <cerrno>
#include <filesystem>
#include <iomanip>
#include <sstream>

namespace scree
{
  using namespace dealii;

  namespace
  {
    namespace fs = std::filesystem;

    const std::string name_of_manifest = "manifest", name_of_step = "step-";
    const std::string format_line    = "Scree checkpoint, format 26";
    const std::string checksum_label = "checksum: ";

    std::uint64_t checksum_of(const std::string &content)
    {
      Checksum checksum;
      checksum.process_bytes(content.data(), content.size());
      return checksum.checksum();
    }


    CheckedFile checked_file(const std::string &name, const std::string &content)
    {
      return { name, content.size(), checksum_of(content) };
    }


    /// The content of the file, or FileError unless it has its size and checksum.
    std::string read_checked_file(const std::string &folder, const CheckedFile &file)
    {
      const std::string path = folder + '/' + file.name;
      std::error_code error;
      if (const auto size = fs::file_size(path, error); !error && size != file.size)
        throw FileError(path + ": has " + std::to_string(size) + " bytes, but " + std::to_string(file.size) +
                        " were written");
      std::string content = read_whole_file(path);
      if (content.size() != file.size || checksum_of(content) != file.checksum)
        throw FileError(path + ": is not what was written (its checksum differs)");
      return content;
    }


    std::string checksum_line(const std::string &text)
    {
      std::ostringstream line;
      line << checksum_label << std::hex << std::setw(16) << std::setfill('0') << checksum_of(text) << '\n';
      return line.str();
    }


    /// The number behind `step-`, or -1.
    long long step_of(const fs::path &folder)
    {
      const std::string name = folder.filename();
      std::istringstream digits(name.rfind(name_of_step, 0) == 0 ? name.substr(name_of_step.size()) : "");
      long long step = -1;
      digits >> step;
      return digits && digits.eof() ? step : -1;
    }


    /// The content of the manifest: the format, the checkpoint as an archive, and a checksum of both.
    std::string manifest_of(const Checkpoint &checkpoint)
    {
      std::ostringstream text;
      text << format_line << '\n';
      boost::archive::binary_oarchive(text) << checkpoint;
      return text.str() + checksum_line(text.str());
    }


    /// Throws FileError if it is not whole or of another format.
    Checkpoint read_manifest(const std::string &folder)
    {
      const std::string path = folder + '/' + name_of_manifest, text = read_whole_file(path);
      const std::size_t end  = text.size() - std::min(text.size(), checksum_line("").size());
      const std::string head = text.substr(0, end);
      if (text.substr(end) != checksum_line(head))
        throw FileError(path + ": is not what was written (its checksum differs)");
      std::istringstream in(head);
      std::string line;
      std::getline(in, line);
      if (line != format_line)
        throw FileError(path + ": begins with \"" + line + "\", but this program reads \"" + format_line + '"');
      Checkpoint checkpoint;
      boost::archive::binary_iarchive(in) >> checkpoint;
      checkpoint.folder = folder;
      if (const auto step = step_of(folder); step >= 0 && std::uint64_t(step) != checkpoint.step)
        throw FileError(path + ": belongs to step " + std::to_string(checkpoint.step) + ", not to this folder");
      return checkpoint;
    }


    /// The folders `checkpoint/step-<n>` of a run, the newest first, whole or not.
    std::vector<std::string> folders_of(const std::string &run_folder)
    {
      std::map<long long, std::string, std::greater<>> folders;
      std::error_code error;
      for (const auto &entry : fs::directory_iterator(run_folder + "/checkpoint", error))
        if (const long long step = step_of(entry.path()); step >= 0)
          folders[step] = entry.path();
      return boost::copy_range<std::vector<std::string>>(folders | boost::adaptors::map_values);
    }


    void remove_folder(const std::string &folder)
    {
      std::error_code error;
      fs::remove_all(folder, error);
      if (error)
        throw FileError(folder + ": cannot be removed: " + error.message());
    }


    /// Writes the manifest, reads it again, gives the checkpoint its name and removes older ones than the last.
    void finish_checkpoint(const std::string &unfinished,
                           const std::string &manifest,
                           const std::string &run_folder,
                           const std::uint64_t step)
    {
      write_whole_files({ { unfinished + '/' + name_of_manifest, manifest } });
      read_checked_file(unfinished, checked_file(name_of_manifest, manifest));
      const std::string folder = run_folder + "/checkpoint", name = folder + '/' + name_of_step + std::to_string(step);
      // One of that name is of another future: a damaged one, or the run went on from an older one.
      remove_folder(name);
      if (std::rename(unfinished.c_str(), name.c_str()) != 0)
        throw error_of_writing(name, manifest.size());
      sync_folder(folder);
      unsigned int n_older = 0;
      for (const std::string &other : folders_of(run_folder))
        if (const auto of_other = std::uint64_t(step_of(other)); of_other != step && (of_other > step || n_older++ > 0))
          remove_folder(other);
    }


    /// Appends numbers to a file's content, as they are in memory.
    template <typename Value>
    void append_bytes(std::string &buffer, const Value *values, const std::size_t n)
    {
      buffer.append(reinterpret_cast<const char *>(values), n * sizeof(Value));
    }


    /// This rank's points, cell by cell: for each set the numbers of properties and of points; for each cell its id and
    /// the number of its points; for each point its id, location, reference location and properties.
    template <int dim>
    std::string pack_points(const std::vector<PointSet<dim> *> &sets)
    {
      std::string buffer;
      for (const PointSet<dim> *points : sets)
        {
          const auto &handler           = points->handler();
          const std::uint64_t numbers[] = { points->stride(), handler.n_locally_owned_particles() };
          append_bytes(buffer, numbers, 2);
          for (auto point = handler.begin(); point != handler.end();)
            {
              const auto cell              = point->get_surrounding_cell();
              const auto id                = cell->id().template to_binary<dim>();
              const std::uint64_t n_points = handler.n_particles_in_cell(cell);
              append_bytes(buffer, id.data(), id.size());
              append_bytes(buffer, &n_points, 1);
              for (std::uint64_t p = 0; p < n_points; ++p, ++point)
                {
                  const std::uint64_t number = point->get_id();
                  append_bytes(buffer, &number, 1);
                  append_bytes(buffer, &point->get_location()[0], dim);
                  append_bytes(buffer, &point->get_reference_location()[0], dim);
                  append_bytes(buffer, point->get_properties().data(), points->stride());
                }
            }
        }
      return buffer;
    }


    /// Reads all points of a checkpoint, of which this rank keeps those in its cells; returns how many each set has.
    template <int dim>
    std::vector<std::uint64_t>
    read_points(const Checkpoint &checkpoint, const Triangulation<dim> &mesh, const std::vector<PointSet<dim> *> &sets)
    {
      AssertThrow(checkpoint.dimension == dim, ExcMessage("It is of another dimension than the case."));
      std::map<CellId, typename Triangulation<dim>::active_cell_iterator> cells;
      for (const auto &cell : mesh.active_cell_iterators())
        if (cell->is_locally_owned())
          cells.emplace(cell->id(), cell);
      std::vector<std::uint64_t> n_of_sets(sets.size(), 0);
      const auto unpack = [&](const auto &take, PointSet<dim> &points) {
        std::uint64_t stride, n_points, n_in_cell, number;
        take(&stride, 1);
        AssertThrow(stride == points.stride(), ExcMessage("The points have other properties than the case's."));
        take(&n_points, 1);
        std::vector<double> properties(stride);
        for (std::uint64_t n = 0; n < n_points;)
          {
            CellId::binary_type id;
            take(id.data(), id.size());
            const auto cell = cells.find(CellId(id));
            take(&n_in_cell, 1);
            for (std::uint64_t p = 0; p < n_in_cell; ++p, ++n)
              {
                Point<dim> location, reference_location;
                take(&number, 1);
                take(&location[0], dim);
                take(&reference_location[0], dim);
                take(properties.data(), properties.size());
                if (cell != cells.end())
                  points.handler().insert_particle(location, reference_location, number, cell->second, properties);
              }
          }
        return n_points;
      };
      for (const CheckedFile &file : checkpoint.files)
        {
          std::istringstream content(read_checked_file(checkpoint.folder, file));
          const auto take = [&](auto *values, const std::size_t n) { // as append_bytes() put them there
            if (!content.read(reinterpret_cast<char *>(values), n * sizeof(*values)))
              throw FileError(checkpoint.folder + '/' + file.name + ": ends too early");
          };
          for (unsigned int s = 0; s < sets.size(); ++s)
            n_of_sets[s] += unpack(take, *sets[s]);
        }
      return n_of_sets;
    }
  } // namespace


  std::vector<std::string> whole_checkpoints(const std::string &run_folder)
  {
    std::vector<std::string> result;
    for (const std::string &folder : folders_of(run_folder))
      if (fault_of([&] {
            for (const CheckedFile &file : read_manifest(folder).files)
              read_checked_file(folder, file);
          }).empty())
        result.push_back(folder);
    return result;
  }


  template <int dim>
  FileJob checkpoint_files(const std::string &run_folder,
                           const double time,
                           const std::uint64_t step,
                           const CaseEntries &entries,
                           const BackgroundGrid<dim> &grid,
                           const std::vector<PointSet<dim> *> &sets,
                           const SaveState &state)
  {
    const std::string unfinished = run_folder + "/checkpoint/unfinished";
    const MPI_Comm communicator  = grid.communicator();
    const unsigned int rank      = Utilities::MPI::this_mpi_process(communicator);
    const std::string version    = version_text();
    Checkpoint checkpoint{ unfinished, version.substr(0, version.find('\n')), dim, time, step, entries, {}, {}, {} };
    if (grid.follows_points())
      checkpoint.blocks = all_blocks(grid.fine_blocks(), communicator);
    const auto points =
        std::make_shared<FileContent>(unfinished + "/points." + std::to_string(rank), pack_points(sets));
    const CheckedFile own = checked_file("points." + std::to_string(rank), points->second);
    checkpoint.files      = Utilities::MPI::all_gather(communicator, own);
    std::string manifest;
    if (rank == 0)
      {
        std::ostringstream out;
        boost::archive::binary_oarchive archive(out);
        state(archive);
        checkpoint.state = out.str();
        manifest         = manifest_of(checkpoint);
      }
    std::uint64_t n_bytes = manifest.size();
    for (const CheckedFile &file : checkpoint.files)
      n_bytes += file.size;

    FileJob job;
    job.stages.resize(3);
    job.stages[1] = [=] {
      write_whole_files({ *points });
      read_checked_file(unfinished, own);
    };
    if (rank == 0)
      {
        job.stages[0] = [=] {
          std::error_code error;
          fs::remove_all(unfinished, error);
          fs::create_directories(unfinished, error);
          if (error)
            {
              errno = error.value();
              throw error_of_writing(unfinished, 0);
            }
        };
        job.stages[2] = [=] { finish_checkpoint(unfinished, manifest, run_folder, step); };
      }
    job.failed = [=](const std::string &fault) {
      std::error_code ignored;
      if (rank == 0)
        fs::remove_all(unfinished, ignored);
      std::string message = fault + " The checkpoint at t = " + number_text(time) + " s needs " +
                            std::to_string(n_bytes) + " bytes in all. ";
      if (rank == 0)
        {
          std::string names;
          for (const std::string &folder : whole_checkpoints(run_folder))
            names += (names.empty() ? "Still whole: " : " and ") + folder;
          message += names.empty() ? "There is no older one." : names + '.';
        }
      throw_on_all_ranks(rank == 0 ? message : "", communicator);
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
    for (const std::string &folder : Utilities::MPI::broadcast(communicator, folders_of(run_folder)))
      {
        Checkpoint checkpoint;
        const std::string fault        = fault_of([&] {
          checkpoint        = read_manifest(folder);
          const auto &files = checkpoint.files;
          for (unsigned int f = rank; f < files.size(); f += n_ranks)
            read_checked_file(folder, files[f]);
        });
        const std::string fault_of_all = first_fault(fault, communicator);
        if (fault_of_all.empty())
          return checkpoint;
        log("The checkpoint " + folder + " is damaged and not used. " + fault_of_all + '.');
        faults += ' ' + fault_of_all + '.';
      }
    throw EntryError(entry_message(
        { "", "Output directory", run_folder },
        faults.empty()
            ? "there is no checkpoint to resume from: no run in this folder has come to its first one. Run "
              "without --resume; a \"Checkpoint interval\" in subsection Output, or a stop on request, gives one."
            : "no checkpoint there is whole." + faults + " Bring the files back, or run without --resume."));
  }


  template <int dim>
  void load_checkpoint(const Checkpoint &checkpoint,
                       BackgroundGrid<dim> &grid,
                       const std::vector<PointSet<dim> *> &sets,
                       const LoadState &state)
  {
    const auto on_all = [&](const std::function<void()> &action) {
      const std::string fault = fault_of(action);
      throw_on_all_ranks(fault.empty() ? ""
                                       : "The checkpoint " + checkpoint.folder + " of " + checkpoint.program +
                                             " cannot be read. " + fault,
                         grid.communicator());
    };
    for (PointSet<dim> *points : sets)
      points->handler().clear_particles();
    if (grid.follows_points())
      grid.change_cells(&checkpoint.blocks);
    std::vector<std::uint64_t> n_points;
    on_all([&] { n_points = read_points(checkpoint, grid.triangulation(), sets); });
    for (PointSet<dim> *points : sets)
      {
        points->handler().update_cached_numbers();
        points->sort(); // brings the points of a cell together in memory
      }
    on_all([&] {
      for (unsigned int s = 0; s < sets.size(); ++s)
        AssertThrow(sets[s]->handler().n_global_particles() == n_points[s],
                    ExcMessage("Points lie in cells that the case does not have."));
      std::istringstream in(checkpoint.state);
      boost::archive::binary_iarchive archive(in);
      state(archive);
      if (in.peek() != std::istringstream::traits_type::eof())
        throw FileError(checkpoint.folder + '/' + name_of_manifest + ": holds more than this program reads");
    });
  }

  template decltype(checkpoint_files<2>) checkpoint_files<2>;
  template decltype(checkpoint_files<3>) checkpoint_files<3>;
  template decltype(load_checkpoint<2>) load_checkpoint<2>;
  template decltype(load_checkpoint<3>) load_checkpoint<3>;
} // namespace scree

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/postprocess/visualization/graphics.h>
#include <scree/postprocess/visualization/patch_output.h>

#include <deal.II/base/data_out_base.h>

#include <sstream>

namespace scree
{
  using namespace dealii;

  template <int dim>
  Graphics<dim>::Graphics(const BackgroundGrid<dim> &grid,
                          const OutputParameters &parameters,
                          const std::string &run_folder)
      : grid(grid)
      , pictures(parameters.graphics_kind())
      , folder(run_folder + "/solution/")
      , rank(Utilities::MPI::this_mpi_process(grid.communicator()))
      , n_ranks(Utilities::MPI::n_mpi_processes(grid.communicator()))
  {
  }


  template <int dim>
  FileJob Graphics<dim>::write(const std::list<SoilBody<dim>> &bodies,
                               const NodalField<dim> &field,
                               const double time,
                               const WaterView<dim> *view)
  {
    FileJob job;
    if (pictures == Pictures::none)
      return job;
    Files files;
    const bool with_grid = pictures == Pictures::points_and_grid;

    Cells contents;
    const std::list<WaterPhase<dim>> no_water;
    if (with_grid || view)
      contents = contents_of_cells(bodies, view ? view->water : no_water, grid);
    if (!bodies.empty())
      add_points(bodies, field, time, view, files);
    if (view)
      add_water(field, time, *view, contents, files);
    if (with_grid)
      add_grid(field, time, view, contents, files);
    const auto piece_of = [](const std::string &path, const unsigned int rank) {
      return path + '.' + std::to_string(rank) + ".vtu";
    };
    job.stages.resize(2);
    job.stages[0] = [=, rank = rank] {
      std::vector<FileContent> pieces;
      for (const auto &[path, picture] : files.pictures)
        pieces.emplace_back(piece_of(path, rank), picture->piece());
      write_whole_files(pieces);
    };
    if (rank == 0)
      job.stages[1] = [=, n_ranks = n_ranks] {
        std::vector<FileContent> records;
        for (const auto &[path, picture] : files.pictures)
          {
            std::vector<std::string> pieces;
            for (unsigned int rank = 0; rank < n_ranks; ++rank)
              pieces.push_back(piece_of(path.substr(path.rfind('/') + 1), rank));
            records.emplace_back(path + ".pvtu", picture->record(pieces));
          }
        records.insert(records.end(), files.series.begin(), files.series.end());
        write_whole_files(records);
      };
    return job;
  }


  template <int dim>
  void Graphics<dim>::add(const std::string &series,
                          std::vector<TimeAndFile> &pictures,
                          const double time,
                          const std::shared_ptr<Picture> &picture,
                          Files &files) const
  {
    const std::string name = series + '_' + Utilities::int_to_string(pictures.size(), 5);
    pictures.emplace_back(time, name + ".pvtu");
    files.pictures.emplace_back(folder + name, picture);
    if (rank == 0) // It alone writes them.
      files.series.push_back(series_file(series, pictures));
  }


  template <int dim>
  FileContent Graphics<dim>::series_file(const std::string &series, const std::vector<TimeAndFile> &pictures) const
  {
    std::ostringstream text;
    DataOutBase::write_pvd_record(text, pictures);
    return { folder + series + ".pvd", text.str() };
  }


  template <int dim>
  void Graphics<dim>::cut() const
  {
    std::vector<FileContent> files;
    // Named, since GCC 13 takes a list in the loop for a dangling reference.
    const auto all = { std::make_pair("points", &point_files), { "water", &water_files }, { "grid", &grid_files } };
    for (const auto &[series, pictures] : all)
      if (rank == 0 && !pictures->empty())
        files.push_back(series_file(series, *pictures));
    write_whole_files(files);
  }

  template class Graphics<2>;
  template class Graphics<3>;
} // namespace scree

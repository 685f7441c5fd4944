// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/postprocess/visualization/graphics.h>
#include <scree/io/whole_file.h>

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
  {
  }


  template <int dim>
  void Graphics<dim>::write(const std::list<SoilBody<dim>> &bodies,
                            const NodalField<dim> &field,
                            const double time,
                            const WaterView<dim> *view)
  {
    if (pictures == Pictures::none)
      return;
    const bool with_grid = pictures == Pictures::points_and_grid;

    Cells contents;
    const std::list<WaterPhase<dim>> no_water;
    if (with_grid || view)
      contents = contents_of_cells(bodies, view ? view->water : no_water, grid);
    if (!bodies.empty())
      write_points(bodies, field, time, view);
    if (view)
      write_water(field, time, *view, contents);
    if (with_grid)
      write_grid(field, time, view, contents);
  }


  template <int dim>
  void Graphics<dim>::record(const std::string &series,
                             std::vector<TimeAndFile> &files,
                             const double time,
                             const std::string &file) const
  {
    files.emplace_back(time, file);
    write_series(series, files);
  }


  template <int dim>
  void Graphics<dim>::write_series(const std::string &series, const std::vector<TimeAndFile> &files) const
  {
    if (files.empty() || Utilities::MPI::this_mpi_process(grid.triangulation().get_communicator()) != 0)
      return;
    std::ostringstream text;
    DataOutBase::write_pvd_record(text, files);
    write_whole_file(folder + series + ".pvd", text.str());
  }


  template <int dim>
  void Graphics<dim>::cut() const
  {
    write_series("points", point_files);
    write_series("water", water_files);
    write_series("grid", grid_files);
  }

  template class Graphics<2>;
  template class Graphics<3>;
} // namespace scree

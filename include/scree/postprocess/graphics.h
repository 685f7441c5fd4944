// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_postprocess_graphics_h
#define scree_postprocess_graphics_h

#include <scree/io/files.h>
#include <scree/io/output_parameters.h>
#include <scree/postprocess/measures.h>
#include <scree/transfer/water_transfer.h>

#include <deal.II/base/data_out_base.h>
#include <deal.II/base/geometry_info.h>

#include <sstream>

namespace scree
{
  /// Velocity of a solved field, m/s, at the place `x` (in cell widths from the lower corner) of a cell of this rank.
  template <int dim>
  dealii::Tensor<1, dim> velocity_at(const dealii::Point<dim> &x,
                                     const BackgroundGrid<dim> &grid,
                                     const unsigned int cell,
                                     const NodalField<dim> &field);

  /// Velocity of the water relative to the soil, m/s, at the place `x` of a cell; nodes that only one of them reaches
  /// do not count.
  template <int dim>
  dealii::Tensor<1, dim> relative_velocity_at(const dealii::Point<dim> &x,
                                              const BackgroundGrid<dim> &grid,
                                              const unsigned int cell,
                                              const NodalField<dim> &soil,
                                              const NodalField<dim> &water);

  /// The pressure, Pa, at the place `x` (in cell widths from the lower corner) of a cell with the given values at its
  /// corners: linear along each axis.
  template <int dim>
  double pressure_at(const dealii::Point<dim> &x, const std::array<double, (1 << dim)> &corners)
  {
    double pressure = 0;
    for (unsigned int corner = 0; corner < corners.size(); ++corner)
      pressure += corners[corner] * dealii::GeometryInfo<dim>::d_linear_shape_function(x, corner);
    return pressure;
  }

  /// The folder `solution` of a run: `.pvtu` files of points, of water points and of grid cells that hold points, and a
  /// `.pvd` of each.
  template <int dim>
  class Graphics
  {
  public:
    /// Begins with empty lists of files.
    /// @param run_folder path
    Graphics(const BackgroundGrid<dim> &grid, const OutputParameters &parameters, const std::string &run_folder)
        : grid(grid)
        , pictures(parameters.graphics_kind())
        , folder(run_folder + "/solution/")
        , rank(dealii::Utilities::MPI::this_mpi_process(grid.communicator()))
        , n_ranks(dealii::Utilities::MPI::n_mpi_processes(grid.communicator()))
    {
    }

    /// Gathers the state at `time` under the next number; the job writes it, a `.pvd` last. doc/output.md has the
    /// fields of soil points, water points and grid cells.
    /// @param field the soil's, solved: its mass and velocity are read
    /// @param view null in a dry run; soil points that carry water are water points, too
    FileJob write(const std::list<SoilBody<dim>> &bodies,
                  const NodalField<dim> &field,
                  const double time,
                  const WaterView<dim> *view = nullptr);

    /// After the state has been read from a checkpoint: takes the pictures that were written after it off the lists, or
    /// all of them if they are not in this run's folder.
    void cut(const bool is_own_folder)
    {
      if (!is_own_folder)
        series.clear();
      std::vector<FileContent> files;
      for (const auto &[name, list] : series)
        if (rank == 0 && !list.empty())
          files.push_back(series_file(name, list));
      write_whole_files(files);
    }

    /// Saves or loads the lists of files (Boost).
    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &series["points"] & series["water"] & series["grid"];
    }

  private:
    using TimesAndFiles = std::vector<std::pair<double, std::string>>;

    /// The `.pvd` of a series.
    FileContent series_file(const std::string &name, const TimesAndFiles &list) const
    {
      std::ostringstream text;
      dealii::DataOutBase::write_pvd_record(text, list);
      return { folder + name + ".pvd", text.str() };
    }

    const BackgroundGrid<dim> &grid;
    const Pictures pictures;
    const std::string folder;
    const unsigned int rank, n_ranks;
    std::map<std::string, TimesAndFiles> series; // of points, water and grid
  };
} // namespace scree

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_postprocess_visualization_graphics_h
#define scree_postprocess_visualization_graphics_h

#include <scree/postprocess/cell_contents.h>
#include <scree/postprocess/visualization/interpolation.h>
#include <scree/step/background_writer.h>
#include <scree/io/output_parameters.h>
#include <scree/io/whole_file.h>
#include <scree/transfer/water_view.h>

#include <list>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace scree
{
  class Picture;

  /// The folder `solution` of a run: `.pvtu` files of points, of water points and of grid cells that hold points, and a
  /// `.pvd` of each.
  template <int dim>
  class Graphics
  {
  public:
    /// Begins with empty lists of files.
    /// @param run_folder path
    Graphics(const BackgroundGrid<dim> &grid, const OutputParameters &parameters, const std::string &run_folder);

    /// Gathers the state at `time` under the next number; the job writes it, a `.pvd` last.
    /// Fields have the names and units of output_field.h. Points (if there is soil): velocity (m/s), stress (Pa,
    /// tension positive, 3 x 3), mean_effective_stress P, deviatoric_stress q (Pa), stress_ratio q/P, mass (kg), volume
    /// (m^3), body (number), id (lasting, unique in its body), displacement (m, if points keep their start), and the
    /// law's internal variables and derived fields. Grid: velocity (m/s) at the cells' corners, mean density (kg/m^3)
    /// and P (Pa) of the cells.
    ///
    /// @param field the soil's, solved: its mass and velocity are read
    /// @param view null in a dry run. Else points gain porosity n = 1 - m/(rho_s V), pore_pressure (Pa) and
    /// seepage_velocity n (v_w - v_s) (m/s), and the grid water_velocity (m/s) and pressure (Pa) at the corners,
    /// porosity and saturation of the cells. Water points, or soil points seen as carriers of water: velocity (m/s),
    /// pressure (Pa), mass (kg) and volume (m^3) of the water, porosity of the soil in the cell (1 without soil),
    /// inside_soil (1 in cells with soil points, else 0) and seepage_velocity (m/s, 0 without soil).
    FileJob write(const std::list<SoilBody<dim>> &bodies,
                  const NodalField<dim> &field,
                  const double time,
                  const WaterView<dim> *view = nullptr);

    /// After the state has been read from a checkpoint: takes the pictures that were written after it off the lists.
    void cut() const;

    /// Saves or loads the lists of files (Boost).
    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &point_files &water_files &grid_files;
    }

  private:
    using TimeAndFile = std::pair<double, std::string>;
    using Cells       = std::vector<CellContents>; // by active cell index

    /// What is gathered at a time: paths without what follows a picture's name, and the `.pvd` of each series.
    struct Files
    {
      std::vector<std::pair<std::string, std::shared_ptr<Picture>>> pictures;
      std::vector<FileContent> series;
    };

    void add_points(const std::list<SoilBody<dim>> &bodies,
                    const NodalField<dim> &field,
                    const double time,
                    const WaterView<dim> *view,
                    Files &files);
    void add_water(const NodalField<dim> &soil_field,
                   const double time,
                   const WaterView<dim> &view,
                   const Cells &contents,
                   Files &files);
    void add_grid(const NodalField<dim> &field,
                  const double time,
                  const WaterView<dim> *view,
                  const Cells &contents,
                  Files &files);

    /// Adds a picture to a series.
    void add(const std::string &series,
             std::vector<TimeAndFile> &pictures,
             const double time,
             const std::shared_ptr<Picture> &picture,
             Files &files) const;

    /// The `.pvd` of a series.
    FileContent series_file(const std::string &series, const std::vector<TimeAndFile> &pictures) const;

    const BackgroundGrid<dim> &grid;
    const Pictures pictures;
    const std::string folder;
    const unsigned int rank, n_ranks;
    std::vector<TimeAndFile> point_files, water_files, grid_files;
  };
} // namespace scree

#endif

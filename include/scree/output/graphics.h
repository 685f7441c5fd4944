// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_output_graphics_h
#define scree_output_graphics_h

#include <scree/grid/nodal_field.h>
#include <scree/output/output_parameters.h>
#include <scree/points/phase.h>

#include <list>
#include <string>
#include <utility>
#include <vector>

namespace scree
{
  /// The folder `solution` of a run: `.pvtu` files of points and of grid cells that hold points, and a `.pvd` of each.
  template <int dim>
  class Graphics
  {
  public:
    Graphics(const BackgroundGrid<dim> &grid, const OutputParameters &parameters, const std::string &run_folder);

    /// Writes the state at `time` under the next number. Collective.
    /// Points: velocity (m/s), stress (Pa, tension positive, 3 x 3), mean_effective_stress P, deviatoric_stress q (Pa),
    /// stress_ratio q/P, mass (kg), volume (m^3), body (number), and the law's internal variables and derived fields.
    /// Grid: velocity (m/s) at the cells' corners, mean density (kg/m^3) and P (Pa) of the cells.
    void write(const std::list<Phase<dim>> &phases, const NodalField<dim> &field, const double time);

    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &point_files &grid_files;
    }

  private:
    using TimeAndFile = std::pair<double, std::string>;

    void write_points(const std::list<Phase<dim>> &phases, const double time);
    void write_grid(const std::list<Phase<dim>> &phases, const NodalField<dim> &field, const double time);
    void write_pvd(const std::string &name, const std::vector<TimeAndFile> &files) const;

    const BackgroundGrid<dim> &grid;
    const std::string graphics;
    const std::string folder;
    std::vector<TimeAndFile> point_files, grid_files;
  };
} // namespace scree

#endif

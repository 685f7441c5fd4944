// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/postprocess/visualization/interpolation.h>
#include <scree/postprocess/wall_forces.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <limits>
#include <set>

namespace scree
{
  using namespace dealii;

  template <int dim>
  WallForces<dim>::WallForces(const BackgroundGrid<dim> &grid,
                              const BoundaryConditions<dim> &walls,
                              const WaterBoundaryConditions<dim> *water_walls)
      : grid(grid)
      , is_wet(water_walls != nullptr)
  {
    for (unsigned int f = 0; f < 2 * dim; ++f)
      if (walls.walls()[f].type != WallType::open || (is_wet && !water_walls->is_drained(f)))
        faces.push_back(f);
  }


  template <int dim>
  std::vector<std::string> WallForces<dim>::names() const
  {
    std::vector<std::string> result;
    const std::vector<std::string> of_face = FaceEntries::names(dim);
    for (const unsigned int face : faces)
      {
        for (const std::string phase : { " soil ", " water " })
          if (is_wet || phase == " soil ")
            for (unsigned int a = 0; a < dim; ++a)
              result.push_back(of_face[face] + phase + "xyz"[a] + " (N)");
        if (is_wet)
          result.push_back(of_face[face] + " pressure " + "xyz"[face / 2] + " (N)");
      }
    return result;
  }


  template <int dim>
  std::vector<double> WallForces<dim>::pressure_forces(const WaterView<dim> &view) const
  {
    constexpr unsigned int n = 8; // places along each axis of a cell's face: p has a kink where it is cut off at 0
    const double area        = Utilities::fixed_power<dim - 1>(grid.cell_size() / n);
    std::vector<double> forces(2 * dim, 0.);
    std::set<unsigned int> wet_cells;
    for (const auto &water : view.water)
      for (const auto &cell : water.points().cells())
        wet_cells.insert(cell.cell);
    for (const unsigned int cell : wet_cells)
      if (const std::uint8_t walls = grid.open_knots(cell); walls != 0 && grid.numbering().has_nodes(cell))
        {
          const auto corners = view.pressure_of_cell(cell);
          for (const unsigned int face : GeometryInfo<dim>::face_indices())
            if ((walls >> face) & 1)
              for (unsigned int i = 0; i < Utilities::fixed_power<dim - 1>(n); ++i)
                {
                  Point<dim> x;
                  for (unsigned int a = 0, rest = i; a < dim; ++a)
                    if (a == face / 2)
                      x[a] = face % 2;
                    else
                      {
                        x[a] = (rest % n + 0.5) / n;
                        rest /= n;
                      }
                  forces[face] += (face % 2 == 0 ? -1. : 1.) * area * std::max(0., pressure_at<dim>(x, corners));
                }
        }
    Utilities::MPI::sum(forces, grid.communicator(), forces);
    return forces;
  }


  template <int dim>
  std::vector<double> WallForces<dim>::collect(const Budget<dim> &totals, const double time, const WaterView<dim> *view)
  {
    std::vector<double> impulses; // face by face: soil, water
    for (const unsigned int face : faces)
      for (const WallImpulses<dim> *walls : { &totals.soil_walls, &totals.water_walls })
        for (unsigned int a = 0; a < dim; ++a)
          impulses.push_back(walls->of_face[face][a]);
    Utilities::MPI::sum(impulses, grid.communicator(), impulses);
    const std::vector<double> pressure = view ? pressure_forces(*view) : std::vector<double>(2 * dim, 0.);

    std::vector<double> forces;
    for (unsigned int i = 0; i < faces.size(); ++i)
      {
        for (unsigned int c = 2 * dim * i; c < 2 * dim * i + (is_wet ? 2 : 1) * dim; ++c)
          forces.push_back(has_start && time > last_time
                               ? (last_impulses[c] - impulses[c]) / (time - last_time) // on the wall
                               : std::numeric_limits<double>::quiet_NaN());
        if (is_wet)
          forces.push_back(pressure[faces[i]]);
      }
    has_start     = true;
    last_time     = time;
    last_impulses = impulses;
    return forces;
  }

  template class WallForces<2>;
  template class WallForces<3>;
} // namespace scree

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/scheme/box_walls.h>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// How far a point may be outside, cells.
    constexpr double farthest = 0.1;

    /// Where it is put, cells.
    constexpr double inside = 1e-6;
  } // namespace


  template <int dim>
  void hold_in_box(const BackgroundGrid<dim> &grid, const std::uint8_t closed_faces, PointSet<dim> &points)
  {
    const double width = grid.cell_size();
    for (const auto &cell : points.cells())
      {
        const unsigned int faces = grid.open_knots(cell.cell) & closed_faces;
        if (faces == 0)
          continue;
        for (unsigned int p = 0; p < cell.n_points; ++p)
          for (unsigned int a = 0; a < dim; ++a)
            {
              double &x          = cell.location_of(p)[a];
              const double lower = grid.lower_corner()[a], upper = grid.upper_corner()[a];
              if (faces >> 2 * a & 1 && x < lower && x > lower - farthest * width)
                x = lower + inside * width;
              if (faces >> (2 * a + 1) & 1 && x > upper && x < upper + farthest * width)
                x = upper - inside * width;
            }
      }
  }

  template void hold_in_box(const BackgroundGrid<2> &, const std::uint8_t, PointSet<2> &);
  template void hold_in_box(const BackgroundGrid<3> &, const std::uint8_t, PointSet<3> &);
} // namespace scree

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/contact/cut_cells/move_inside.h>
#include <scree/particles/point_set.h>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// Least distance of water from walls, sizes of a point.
    constexpr double nearest = 0.05;

    /// How far a point may be outside, cells.
    constexpr double farthest = 0.1;

    /// Where it is put, cells.
    constexpr double inside = 1e-6;
  } // namespace


  template <int dim>
  void keep_off_walls(const BackgroundGrid<dim> &grid,
                      const std::uint8_t closed_faces,
                      const double mass_scaling,
                      WaterPhase<dim> &water,
                      Budget<dim> &balance)
  {
    if (water.own_points() == nullptr)
      return;
    for (const auto &cell : water.own_points()->cells())
      {
        const unsigned int faces = grid.open_knots(cell.cell) & closed_faces;
        if (faces == 0)
          continue;
        for_each_point(cell, [&](const auto &point) {
          const double clearance = nearest * edge_of_cube<dim>(point.properties[water.layout.volume]);
          for (unsigned int f = 0; f < 2 * dim; ++f)
            {
              const unsigned int a = f / 2;
              const double inward  = f % 2 == 0 ? 1. : -1.;
              const double wall    = (f % 2 == 0 ? grid.lower_corner() : grid.upper_corner())[a];
              const double gap     = inward * (point.location[a] - wall);
              if (!(faces >> f & 1) || gap >= clearance || gap <= -farthest * grid.cell_size())
                continue;
              point.location[a] = wall + inward * clearance;
              double &velocity  = point.properties[water.layout.velocity + a];
              if (inward * velocity >= 0.)
                continue;
              const double impulse = -mass_scaling * point.properties[water.layout.mass] * velocity;
              balance.wall_impulse[a] += impulse;
              balance.water_walls.of_face[f][a] += impulse;
              balance.wall_dissipation -= 0.5 * impulse * velocity;
              velocity = 0.;
            }
        });
      }
  }


  template <int dim>
  void move_out_of_ground(const BackgroundGrid<dim> &grid,
                          const std::uint8_t closed_faces,
                          const Tensor<1, dim> &normal,
                          double depth,
                          Point<dim> &place)
  {
    constexpr double parallel = 0.01; // square of the sine of the angle between ground and faces: no room
    Tensor<1, dim> along      = normal;
    for (unsigned int n_faces = 0; n_faces <= dim && along.norm_square() > parallel; ++n_faces)
      {
        const Point<dim> start    = place;
        const double rise_a_metre = along.norm_square();
        bool is_inside            = true;
        place += depth / rise_a_metre * along;
        for (unsigned int a = 0; a < dim; ++a)
          {
            const double lower = grid.lower_corner()[a], upper = grid.upper_corner()[a];
            const bool is_below = closed_faces >> 2 * a & 1 && place[a] < lower;
            if (!is_below && !(closed_faces >> (2 * a + 1) & 1 && place[a] > upper))
              continue;
            is_inside = false;
            place[a]  = is_below ? lower + inside * grid.cell_size() : upper - inside * grid.cell_size();
            along[a]  = 0.;
          }
        if (is_inside)
          return;
        depth -= normal * (place - start);
      }
  }


  template <int dim>
  void move_out_of_ground(const BackgroundGrid<dim> &grid,
                          const RigidBoundary<dim> &ground,
                          const double farthest,
                          const std::uint8_t closed_faces,
                          PointSet<dim> &points,
                          const ActOnGround<dim> &act)
  {
    const double width         = grid.cell_size();
    const FineCells<dim> &fine = grid.fine_cells();
    for (const auto &cell : points.cells())
      {
        if (ground.least_distance(cell.cell) > farthest)
          continue;
        const Point<dim> lower = fine.box().corner(fine.cells()[fine.of_index(cell.cell)].place);
        for_each_batch(cell.n_points, [&](const BatchIndices &indices, const unsigned int n) {
          std::array<Batch, dim> places;
          simd::load_records<dim>(as_constant(BatchPointers<dim>(cell, indices).locations), places.data());
          for (unsigned int a = 0; a < dim; ++a)
            places[a] = (places[a] - lower[a]) * (1. / width);
          const unsigned int below = simd::bits_of(ground.distances(cell.cell, places) < 0.);
          for (unsigned int l = 0; l < n; ++l)
            if (below >> l & 1)
              {
                Point<dim> &location     = cell.location_of(indices[l]);
                const auto place_in_cell = [&] { return Point<dim>((location - lower) / width); };
                const unsigned int part  = ground.nearest_part(cell.cell, place_in_cell());
                SurfaceView<dim> view    = ground.parts()[part].samples->view(cell.cell, place_in_cell());
                act({ cell.cell, cell.properties_of(indices[l]), location, cell.reference_location_of(indices[l]) },
                    part,
                    view.normal);
                // Near an edge the mean normal is not the gradient of the distance.
                for (unsigned int n_moves = 0; view.distance < 0. && n_moves < 3; ++n_moves)
                  {
                    move_out_of_ground(grid, closed_faces, view.normal, inside * width - view.distance, location);
                    view = ground.view(cell.cell, place_in_cell());
                  }
              }
        });
      }
  }

  template decltype(keep_off_walls<2>) keep_off_walls<2>;
  template decltype(keep_off_walls<3>) keep_off_walls<3>;
  template void
  move_out_of_ground(const BackgroundGrid<2> &, const std::uint8_t, const Tensor<1, 2> &, double, Point<2> &);
  template void
  move_out_of_ground(const BackgroundGrid<3> &, const std::uint8_t, const Tensor<1, 3> &, double, Point<3> &);
  template void move_out_of_ground(const BackgroundGrid<2> &,
                                   const RigidBoundary<2> &,
                                   const double,
                                   const std::uint8_t,
                                   PointSet<2> &,
                                   const ActOnGround<2> &);
  template void move_out_of_ground(const BackgroundGrid<3> &,
                                   const RigidBoundary<3> &,
                                   const double,
                                   const std::uint8_t,
                                   PointSet<3> &,
                                   const ActOnGround<3> &);
} // namespace scree

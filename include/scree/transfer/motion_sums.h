// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_transfer_motion_sums_h
#define scree_transfer_motion_sums_h

#include <scree/mesh/background_grid.h>
#include <scree/mesh/cell_basis.h>

namespace scree
{
  /// Mass and motion of points, summed over them (2D: per m).
  ///
  /// @tparam Number double, or Batch for sums lane by lane
  template <int dim, typename Number = double>
  struct MotionSums
  {
    Number mass{};          ///< kg
    Number momentum[dim]{}; ///< N s
    Number moment[dim]{};   ///< mass times place, kg m
    Number kinetic{};       ///< of velocities and affine fields, J

    /// Adds points.
    /// @param velocity m/s
    /// @param location m
    /// @param affine_square see square_of_affine(), m^2/s^2
    void add(const Number &of_point, const Number *velocity, const Number *location, const Number &affine_square)
    {
      Number square = affine_square;
      mass += of_point;
      for (unsigned int a = 0; a < dim; ++a)
        {
          momentum[a] += of_point * velocity[a];
          moment[a] += of_point * location[a];
          square += velocity[a] * velocity[a];
        }
      kinetic += 0.5 * of_point * square;
    }

    /// The sums over the lanes.
    MotionSums<dim> of_lanes() const
    {
      MotionSums<dim> sums;
      for (unsigned int l = 0; l < simd::n_lanes<Number>; ++l)
        {
          sums.mass += simd::lane(mass, l);
          for (unsigned int a = 0; a < dim; ++a)
            {
              sums.momentum[a] += simd::lane(momentum[a], l);
              sums.moment[a] += simd::lane(moment[a], l);
            }
          sums.kinetic += simd::lane(kinetic, l);
        }
      return sums;
    }

    /// Adds other sums.
    MotionSums &operator+=(const MotionSums &other)
    {
      mass += other.mass;
      for (unsigned int a = 0; a < dim; ++a)
        {
          momentum[a] += other.momentum[a];
          moment[a] += other.moment[a];
        }
      kinetic += other.kinetic;
      return *this;
    }
  };


  /// Twice the energy that an affine velocity field C has at the nodes, over the point's mass, m^2/s^2: the sum of
  /// C_ca^2 sum_i phi_i (x_i - x)_a^2, which vanishes across a wall that the point is on.
  /// @param x place in the cell
  /// @param width of the cell, m
  template <int dim, int n, typename Number, typename Place>
  Number square_of_affine(const Number *affine, const Place &x, const OpenKnots open, const double width)
  {
    Number sum = simd::broadcast<Number>(0.);
    for (unsigned int a = 0; a < dim; ++a)
      {
        Number square = simd::broadcast<Number>(0.);
        for (unsigned int c = 0; c < dim; ++c)
          square += affine[c * dim + a] * affine[c * dim + a];
        sum += square * CellBasis<dim, n, Number>::second_moment(x[a], open, a);
      }
    return width * width * sum;
  }


  /// Sums over the points of a set.
  /// @param has_affine_energy see TransferParameters
  template <int dim, typename Layout, typename Points>
  MotionSums<dim> motion_of_points(const BackgroundGrid<dim> &grid,
                                   const Points &points,
                                   const Layout &layout,
                                   const bool has_affine_energy)
  {
    MotionSums<dim> sums;
    with_nodes_1d(grid, [&](auto n) {
      for_each_point(points, [&](const auto &point) {
        const double *properties = point.properties;
        const double square      = has_affine_energy ? square_of_affine<dim, n, double>(properties + layout.affine,
                                                                                   point.reference_location,
                                                                                   grid.open_knots(point.cell),
                                                                                   grid.cell_size())
                                                     : 0.;
        sums.add(properties[layout.mass], properties + layout.velocity, &point.location[0], square);
      });
    });
    return sums;
  }
} // namespace scree

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_transfer_nonlocal_average_h
#define scree_transfer_nonlocal_average_h

#include <scree/bodies/phases.h>
#include <scree/mesh/background_grid.h>
#include <scree/mesh/node_rows.h>
#include <scree/mesh/node_values.h>

namespace scree
{
  /// Sets the over-non-local variable of a law (@source{vermeer1994}; @source{galavi2010}) at the points of a body:
  ///   averaged = (1 - m) own + m mean,  m = 2.
  ///
  /// The mean of the own values is weighted with mass and, about, with a Gaussian whose variance is l^2 along each
  /// axis. It is made on the corners of the cells: points to corners by linear functions, passes from corners to the
  /// mean of each cell that holds points of the body and back, corners to points. The two transfers have a variance of
  /// h^2/3, a pass has h^2/2: (1/4, 1/2, 1/4) along each axis. Of each pass the same part is taken, such that the sum
  /// is l^2. Only cells of the body are coupled, so that no strain goes to another one or across a gap.
  template <int dim>
  class NonlocalAverage
  {
  public:
    /// Keeps a reference to the grid.
    explicit NonlocalAverage(const BackgroundGrid<dim> &grid);

    /// Fits the sums to the grid's current vertices. Collective.
    void reinit();

    /// Sets the variable at all points of the body, which are sorted. Collective.
    void update(SoilBody<dim> &body);

    /// Passes for a length of `ratio` cells.
    static unsigned int n_passes(const double ratio);

  private:
    static constexpr unsigned int n_corners = 1 << dim;
    static constexpr unsigned int value = 0, mass = 1; // sums at a corner: of mass times variable, of mass

    void add_points(const PointSet<dim> &points, const unsigned int offset);
    void smooth(const PointSet<dim> &points, const double ratio);
    void set_points(PointSet<dim> &points, const unsigned int from, const unsigned int to) const;

    const BackgroundGrid<dim> &grid;
    const NodeNumbering<dim> &corners;
    NodeValues<dim, 2> sums, changes;
  };
} // namespace scree

#endif

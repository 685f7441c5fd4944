// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_initial_seepage_field_h
#define scree_initial_seepage_field_h

#include <scree/geometry/level_set.h>
#include <scree/particles/cell_places.h>

#include <string>
#include <utility>
#include <vector>

namespace scree
{
  /// What steady seepage came to.
  struct SeepageReport
  {
    unsigned int n_iterations = 0;     ///< solves
    bool has_converged        = false; ///< whether the last one changed nothing
    double inflow             = 0;     ///< m^3/s (2D: m^2/s)
    double outflow_in_air     = 0;     ///< through faces in air, m^3/s
    double outflow_below      = 0;     ///< to where a head is given, m^3/s
    double exit_height        = 0;     ///< elevation of the highest face in air where water leaves, m; NaN: nowhere

    /// A line for the log.
    std::string text(const unsigned int dim) const;
  };

  /// The pressure head of steady seepage at the corners of the cells with soil, on every rank. As a level set its open
  /// is dry.
  template <int dim>
  class SeepageField : public LevelSet<dim>
  {
  public:
    /// @param box of the mesh
    /// @param first corner of the box's cells that has a value, by its numbers along the axes
    /// @param n values along each axis
    /// @param values of the pressure head, m; NaN where no soil is near
    SeepageField(const CellsOfBox<dim> &box,
                 const CellPlace<dim> &first,
                 const CellPlace<dim> &n,
                 std::vector<double> values,
                 const SeepageReport &report);

    /// Pressure head, m, and its gradient; NaN where no soil is near.
    std::pair<double, dealii::Tensor<1, dim>> pressure_head(const dealii::Point<dim> &x) const;

    /// See LevelSet::is_open(): whether the pressure is negative or unknown.
    bool is_open(const dealii::Point<dim> &x) const override;

    /// See LevelSet::view(): of the surface without pressure, to first order.
    SurfaceView<dim> view(const dealii::Point<dim> &x, const double reach) const override;

    const SeepageReport report; ///< how it was found

  private:
    const CellsOfBox<dim> box;
    const CellPlace<dim> first, n;
    const std::vector<double> values;
  };
} // namespace scree

#endif

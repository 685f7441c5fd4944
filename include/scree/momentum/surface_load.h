// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_momentum_surface_load_h
#define scree_momentum_surface_load_h

#include <scree/mesh/background_grid.h>
#include <scree/bodies/phases.h>

#include <deal.II/base/function_parser.h>
#include <deal.II/base/parameter_handler.h>

#include <list>
#include <memory>
#include <string>
#include <vector>

namespace scree
{
  /// Subsection Surface load: a traction on a flat patch, which moves with the soil.
  struct SurfaceLoadParameters
  {
    std::vector<double> lower_corner{ 0., 0. }, ///< of the patch, m
        upper_corner{ 0., 0. };                 ///< of the patch, m
    std::string traction;                       ///< Pa, of x, y (z) and t, one expression an axis; empty: no load

    /// Declares the subsection and its entries.
    void add_parameters(dealii::ParameterHandler &prm);

    /// Throws EntryError at impossible combinations.
    void check(const GridParameters &grid, const unsigned int dim) const;

    /// Whether there is a load.
    bool is_set() const
    {
      return !traction.empty();
    }

    /// Whether the traction speaks of the time.
    bool changes_with_time() const;

    /// The axis along which the patch has no width.
    unsigned int normal_axis(const unsigned int dim) const;

    /// Where the layer of cells below the patch begins, m, along the axis across it.
    /// @param lower of the box along this axis, m
    double layer_below(const unsigned int axis, const double lower, const double cell_size) const;

    /// Whether a part of the patch acts on the cell with this lower corner, m.
    bool touches_cell(const double *corner, const GridParameters &grid, const unsigned int dim) const;
  };

  /// Markers on the patch, which carry its load to the nodes around them and move with the soil.
  template <int dim>
  class SurfaceLoad
  {
  public:
    static constexpr unsigned int area = 0; ///< a marker's only property: m^2 (2D: m), as it was at the start

    /// Lays the markers. A patch on a face between two cells belongs to the one with the lower coordinate, so that the
    /// load on top of a body finds the body's cells. Collective.
    /// @param markers_per_cell along each axis of the patch: as many as the soil has points, whose sums at the nodes of
    /// a wall differ from those of another number
    SurfaceLoad(const BackgroundGrid<dim> &grid,
                const SurfaceLoadParameters &parameters,
                const unsigned int markers_per_cell);

    /// Throws EntryError if a marker's cell holds no soil, whose nodes could not take its load. Collective.
    void require_soil(const std::list<SoilBody<dim>> &bodies, const MPI_Comm communicator) const;

    /// Force per initial area, Pa, at a place and a time, s.
    dealii::Tensor<1, dim> traction(const dealii::Point<dim> &x, const double time) const;

    /// The axis along which the patch has no width at the start.
    unsigned int normal_axis() const
    {
      return normal;
    }

    /// The markers, which move with the soil.
    PointSet<dim> &points()
    {
      return markers;
    }

    /// Read-only access.
    const PointSet<dim> &points() const
    {
      return markers;
    }

  private:
    const std::vector<double> corner; // as the entry says
    const unsigned int normal;        // axis
    PointSet<dim> markers;
    std::unique_ptr<dealii::FunctionParser<dim>> function;
  };
} // namespace scree

#endif

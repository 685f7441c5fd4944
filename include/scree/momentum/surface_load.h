// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_momentum_surface_load_h
#define scree_momentum_surface_load_h

#include <scree/mesh/background_grid.h>
#include <scree/bodies/phases.h>
#include <scree/mesh/node_values.h>

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
  ///
  /// Along the patch a marker shares its force by its shape functions; across it, in proportion to the area that the
  /// soil's points give to the nodes, sum V d phi_i/dn, as their stress does: then a uniform stress is in balance with
  /// the load however the points lie, and a node that carries next to no soil gets next to no force. (The marker's own
  /// functions across the patch, which need exact integrals of the stress, are wrong by several times the load as soon
  /// as the soil's face has crossed a cell's; shares in proportion to mass leave the top cell without stress.)
  template <int dim>
  class SurfaceLoad
  {
  public:
    static constexpr unsigned int area = 0; ///< a marker's only property: m^2 (2D: m), as it was at the start

    /// Lays the markers. A patch on a face between two cells belongs to the one with the lower coordinate, so that the
    /// load on top of a body finds the body's cells. Keeps a reference to the grid. Collective.
    /// @param markers_per_cell along each axis of the patch: as many as the soil has points, whose sums at the nodes of
    /// a wall differ from those of another number
    SurfaceLoad(const BackgroundGrid<dim> &grid,
                const SurfaceLoadParameters &parameters,
                const unsigned int markers_per_cell);

    /// Throws EntryError if a marker's cell holds no soil, whose nodes could not take its load. Collective.
    void require_soil(const std::list<SoilBody<dim>> &bodies, const MPI_Comm communicator) const;

    /// Fits the nodes to the grid's current partition. Collective.
    void reinit()
    {
      nodes.reinit();
    }

    /// Sums what the soil's points give to the nodes near the markers, before add_to(). Collective.
    void find_areas(const std::list<SoilBody<dim>> &bodies);

    /// Activates the nodes of the markers' cells and adds the load at a time, s, to their force. Returns the sum of
    /// this rank's forces, N (2D: per m).
    dealii::Tensor<1, dim> add_to(NodalField<dim> &field, const double time) const;

    /// Moves the markers with the soil, at most to the faces of the box, after the solve of the step whose load was
    /// that of `time`. The markers are not sorted yet. Returns the load's work over the step, J (2D: per m): that of
    /// add_to()'s force with the nodes' mean velocity.
    double move(const NodalField<dim> &field, const double time, const double time_step);

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
    /// What a node has of the load's surroundings.
    static constexpr unsigned int area_of_soil    = 0; // of its surface, sum V d phi/dn, m^2 (2D: m)
    static constexpr unsigned int mass_of_soil    = 1; // kg
    static constexpr unsigned int area_of_markers = 2; // m^2 (2D: m)

    /// Shares of the nodes of a cell, or their shape functions; entries beyond n_nodes_per_cell() are not used.
    using OfNodes = std::array<double, dealii::Utilities::pow(3, dim)>;

    /// The force on a marker, N (2D: per m).
    template <typename Marker>
    dealii::Tensor<1, dim> force_on(const Marker &marker, const double time) const;

    /// Adds the points of a cell to the nodes' area and mass.
    template <int n>
    void add_soil(const SoilBody<dim> &body, const ConstCellPoints<dim> &cell);

    /// The part of a marker's force that each node of its cell takes; they sum to 1.
    ///
    /// @param shapes of the nodes at the marker
    OfNodes shares(const unsigned int cell, const OfNodes &shapes) const;

    /// The velocity of a marker, m/s: across the patch that of the nodes that take its load, along it that of the soil.
    dealii::Tensor<1, dim> velocity_of(const unsigned int cell,
                                       const OfNodes &shapes,
                                       const OfNodes &share,
                                       const NodalField<dim> &field) const;

    OfNodes shapes_at(const unsigned int cell, const dealii::Point<dim> &reference_location) const;

    /// Two opposite corners of a box around the markers of all ranks, wide enough for all points that share a node with
    /// one. Collective.
    std::array<dealii::Point<dim>, 2> surroundings() const;

    const BackgroundGrid<dim> &grid;
    const std::vector<double> corner; // as the entry says
    const unsigned int normal;        // axis along which the patch has no width at the start
    PointSet<dim> markers;
    NodeValues<dim, 3> nodes;
    std::unique_ptr<dealii::FunctionParser<dim>> function; // traction, Pa
  };
} // namespace scree

#endif

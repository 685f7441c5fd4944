// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_momentum_load_transfer_h
#define scree_momentum_load_transfer_h

#include <scree/mesh/node_values.h>
#include <scree/momentum/surface_load.h>

#include <array>
#include <list>

namespace scree
{
  /// A surface load between its markers and the nodes.
  ///
  /// Along the patch a marker shares its force by its shape functions; across it, in proportion to the area that the
  /// soil's points give to the nodes, sum V d phi_i/dn, as their stress does: then a uniform stress is in balance with
  /// the load however the points lie, and a node that carries next to no soil gets next to no force. (The marker's own
  /// functions across the patch, which need exact integrals of the stress, are wrong by several times the load as soon
  /// as the soil's face has crossed a cell's; shares in proportion to mass leave the top cell without stress.)
  template <int dim>
  class LoadTransfer
  {
  public:
    /// Keeps references to both.
    LoadTransfer(const BackgroundGrid<dim> &grid, SurfaceLoad<dim> &load);

    /// Fits the nodes to the grid's current partition. Collective.
    void reinit();

    /// Sums what the soil's points give to the nodes near the markers, before add_to(). Collective.
    void find_areas(const std::list<SoilBody<dim>> &bodies);

    /// Activates the nodes of the markers' cells and adds the load at a time, s, to their force. Returns the sum of
    /// this rank's forces, N (2D: per m).
    dealii::Tensor<1, dim> add_to(NodalField<dim> &field, const double time) const;

    /// Moves the markers with the soil, at most to the faces of the box, after the solve of the step whose load was
    /// that of `time`. The markers are not sorted yet. Returns the load's work over the step, J (2D: per m): that of
    /// add_to()'s force with the nodes' mean velocity.
    double move(const NodalField<dim> &field, const double time, const double time_step);

    /// The load with its markers.
    SurfaceLoad<dim> &surface_load()
    {
      return load;
    }

  private:
    /// What a node has of the load's surroundings.
    static constexpr unsigned int area        = 0; // of the soil's surface, sum V d phi/dn, m^2 (2D: m)
    static constexpr unsigned int mass        = 1; // of soil, kg
    static constexpr unsigned int marked_area = 2; // of the markers, m^2 (2D: m)

    /// Shares of the nodes of a cell, or their shape functions; entries beyond n_nodes_per_cell() are not used.
    using OfNodes = std::array<double, dealii::Utilities::pow(3, dim)>;

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
    SurfaceLoad<dim> &load;
    NodeValues<dim, 3> nodes;
  };
} // namespace scree

#endif

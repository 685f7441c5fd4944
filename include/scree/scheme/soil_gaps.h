// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_scheme_soil_gaps_h
#define scree_scheme_soil_gaps_h

#include <scree/grid/node_values.h>
#include <scree/scheme/free_surface.h>

#include <vector>

namespace scree
{
  /// Gaps between bodies of wet soil, or between parts of one.
  ///
  /// Nodes that two bodies act on move with both. Where these come together, cells at the gap tell of a strain that
  /// their soil does not have: up to a cell before they touch, it would be pressed together and throw them back. So the
  /// closing of a gap is no strain of the soil beside it.
  ///
  /// A side of a cell with soil is a face if the corners opposite are within the water, those on it at its surface or
  /// beyond, and what fills the cell lies away from it by a tenth of a cell, if it is not full. Beside a gap are faces
  /// that look at each other across one cell without soil, or from one partly full cell to the next.
  template <int dim>
  class SoilGaps
  {
  public:
    /// @param corners the numbering of linear functions on the grid
    SoilGaps(const BackgroundGrid<dim> &grid,
             const NodeNumbering<dim> &corners,
             const FreeSurfaceLocator<dim> &surface);

    /// Fits the gaps to the grid's current nodes.
    void reinit();

    /// Finds the gaps of a step whose surface is known. Collective.
    void find(const Mixture<dim> &mixture);

    /// Whether the soil of a record of the mixture is beside a gap.
    bool is_beside(const unsigned int record) const
    {
      return beside[record];
    }

  private:
    static constexpr unsigned int n_sides = 2 * dim; // 2 a the lower, 2 a + 1 the upper one across axis a

    struct Face
    {
      unsigned int record, side;
      bool is_full; // its cell
      bool is_away; // what fills the cell, if that is not full
    };

    /// What acts on a node, by numbers; without linear functions it lies in the middle of a cell.
    enum Slots : unsigned int
    {
      next = 0,       // from here on, side by side: faces of the cell before the node's, which look at it
      own  = n_sides, // the same: faces of the node's cell, if that is partly full
      soil = 2 * n_sides,
      n_slots
    };

    /// Notes the faces of a cell.
    void add_faces(const unsigned int record, const MixtureCell<dim> &cell);

    /// Calls `act(node)` for the nodes of a cell that are `place` along the axis of a side, and in the middle along the
    /// other ones (linear functions: anywhere).
    template <typename Function>
    void
    for_nodes(const unsigned int cell, const unsigned int side, const unsigned int place, const Function &act) const;

    /// The same for the nodes that a side of a cell looks at.
    template <typename Function>
    void for_nodes_before(const Face &face, const Mixture<dim> &mixture, const Function &act) const
    {
      const unsigned int last = face.side % 2 == 1 ? grid.n_nodes_1d() - 1 : 0;
      for_nodes(mixture.cells()[face.record].cell, face.side, last, act);
    }

    const BackgroundGrid<dim> &grid;
    const NodeNumbering<dim> &corners;
    const FreeSurfaceLocator<dim> &surface;
    NodeValues<dim, n_slots> at_nodes; // Slots
    std::vector<Face> faces;
    std::vector<char> beside; // by record
  };
} // namespace scree

#endif

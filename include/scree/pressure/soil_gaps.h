// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_pressure_soil_gaps_h
#define scree_pressure_soil_gaps_h

#include <scree/mesh/node_values.h>
#include <scree/pressure/free_surface.h>

#include <vector>

namespace scree
{
  /// Gaps between bodies of wet soil, or between parts of one.
  ///
  /// Nodes that two bodies act on move with both. Where these come together, cells at the gap tell of a strain that
  /// their soil does not have: up to a cell before they touch, it would be pressed together and throw them back. So the
  /// closing of a gap does not count as compression of the soil beside it.
  ///
  /// A side of a cell with soil is a face if the vertices opposite are within the water and those on it at its surface
  /// or beyond. Soil is beside a gap if a face of its cell looks at another one across a cell without soil, or from one
  /// partly full cell to the next; in a partly full cell only if what fills it lies away from the face.
  template <int dim>
  class SoilGaps
  {
  public:
    /// @param vertices the numbering of linear functions on the grid
    SoilGaps(const BackgroundGrid<dim> &grid, const NodeNumbering<dim> &vertices, const FreeSurface<dim> &surface);

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
      bool is_away; // what fills the cell, which is not full
    };

    /// Numbers of what is around a node. A spline's lies in the middle of a cell; those of the other bases that a face
    /// looks at lie on its side, where `own` and `soil` stay 0, so that with these faces of neighbours alone meet.
    enum Slots : unsigned int
    {
      ahead = 0,           // from here on, side by side: faces that look at the node from the next cell
      own   = n_sides,     // the same: faces of its cell that what fills it lies away from
      soil  = 2 * n_sides, // its cell, if that has soil at the surface
      n_slots
    };

    /// Notes the faces of a cell.
    void add_faces(const unsigned int record, const MixtureCell<dim> &cell);

    /// Calls `act(node)` for the nodes of a cell that are `place` along the axis of a side, and in the middle along the
    /// other ones (linear functions: anywhere).
    template <typename Function>
    void
    for_nodes(const unsigned int cell, const unsigned int side, const unsigned int place, const Function &act) const;

    /// The same for the nodes that a face looks at.
    template <typename Function>
    void for_nodes_ahead(const Face &face, const Mixture<dim> &mixture, const Function &act) const
    {
      const unsigned int last = face.side % 2 == 1 ? grid.n_nodes_1d() - 1 : 0;
      for_nodes(mixture.cells()[face.record].cell, face.side, last, act);
    }

    const BackgroundGrid<dim> &grid;
    const NodeNumbering<dim> &vertices;
    const FreeSurface<dim> &surface;
    NodeValues<dim, n_slots> at_nodes; // Slots
    std::vector<Face> faces;
    std::vector<char> beside; // by record
  };
} // namespace scree

#endif

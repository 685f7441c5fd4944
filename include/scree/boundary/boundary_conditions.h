// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_boundary_boundary_conditions_h
#define scree_boundary_boundary_conditions_h

#include <scree/boundary/face_entries.h>
#include <scree/mesh/background_grid.h>
#include <scree/boundary/node_constraint.h>

#include <deal.II/base/parameter_handler.h>

#include <array>
#include <string>
#include <vector>

namespace scree
{
  /// What a face of the box does to the soil.
  enum class WallType
  {
    fixed,     ///< no motion
    free_slip, ///< no motion along the normal
    friction,  ///< no motion into the wall, Coulomb friction along it; the soil may lift off
    open       ///< nothing; points may leave
  };

  /// What one face of the box does to the soil.
  struct Wall
  {
    WallType type               = WallType::open; ///< constraint of the soil
    double friction_coefficient = 0;              ///< tan of the friction angle
  };

  /// Subsection Boundaries: one entry a face of the box.
  struct BoundaryParameters : FaceEntries
  {
    BoundaryParameters();

    /// Declares the subsection and its entries.
    void add_parameters(dealii::ParameterHandler &prm);

    /// Throws EntryError if an entry does not read as a wall, or is set for a wall that is not there.
    void check(const unsigned int dim) const;

    /// The walls in deal.II's numbering of the faces.
    std::vector<Wall> walls(const unsigned int dim) const;
  };

  /// Walls of the box acting on the soil at the nodes.
  template <int dim>
  class BoundaryConditions
  {
  public:
    /// Reads the entries; throws EntryError if one does not read as a wall.
    BoundaryConditions(const BackgroundGrid<dim> &grid, const BoundaryParameters &parameters);

    /// What the walls do to the soil at a node that lies on the given faces of the box, see
    /// BackgroundGrid::node_faces().
    std::vector<NodeConstraint<dim>> constraints(const std::uint8_t faces) const;

    /// Which of these faces take the impulses on the soil.
    BearingFaces<dim> bearing_faces(const std::uint8_t faces) const;

    /// One wall a face of the box, in deal.II's numbering.
    const std::vector<Wall> &walls() const
    {
      return wall_list;
    }

    /// Name of the face of the box nearest to a point outside, and whether it is open.
    std::pair<std::string, bool> face_crossed(const dealii::Point<dim> &location) const;

  private:
    const BackgroundGrid<dim> &grid;
    const std::vector<Wall> wall_list;
  };

  /// The face of the box, in deal.II's numbering, beyond which a point outside is farthest.
  template <int dim>
  unsigned int nearest_face(const BackgroundGrid<dim> &grid, const dealii::Point<dim> &location);
} // namespace scree

#endif

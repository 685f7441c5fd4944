// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_boundary_boundary_conditions_h
#define scree_boundary_boundary_conditions_h

#include <scree/boundary/node_constraint.h>
#include <scree/input/input_error.h>
#include <scree/mesh/background_grid.h>

#include <deal.II/base/parameter_handler.h>

namespace scree
{
  /// One entry a face of the box, in a subsection of walls.
  struct FaceEntries
  {
    std::string left, ///< face at the lower end of x
        right,        ///< upper end of x
        front,        ///< lower end of y, 3D
        back,         ///< upper end of y, 3D
        bottom,       ///< lower end of y in 2D, of z in 3D
        top;          ///< upper end of y in 2D, of z in 3D

    /// Names of the faces in deal.II's numbering: lower and upper face of each axis.
    static std::vector<std::string> names(const unsigned int dim)
    {
      if (dim == 2)
        return { "Left", "Right", "Bottom", "Top" };
      return { "Left", "Right", "Front", "Back", "Bottom", "Top" };
    }

    /// The entries in the same order.
    std::vector<std::string> texts(const unsigned int dim) const
    {
      if (dim == 2)
        return { left, right, bottom, top };
      return { left, right, front, back, bottom, top };
    }

    /// Declares the entries in the subsection that is open; `what` goes on after the name of the face.
    void add_parameters(dealii::ParameterHandler &prm, const std::string &what)
    {
      prm.add_parameter("Left", left, "Lower x face" + what);
      prm.add_parameter("Right", right, "Upper x face" + what);
      prm.add_parameter("Front", front, "Lower y face (3D only)" + what);
      prm.add_parameter("Back", back, "Upper y face (3D only)" + what);
      prm.add_parameter("Bottom", bottom, "Lower face of the last axis" + what);
      prm.add_parameter("Top", top, "Upper face of the last axis" + what);
    }

    /// Throws EntryError if an entry of a wall that is not there differs from the default.
    void check(const std::string &subsection, const unsigned int dim, const FaceEntries &defaults) const
    {
      if (dim == 2)
        for (const auto &[name, wall, otherwise] :
             { std::make_tuple("Front", front, defaults.front), std::make_tuple("Back", back, defaults.back) })
          require_entry(wall == otherwise,
                        { subsection, name, wall },
                        "a plane strain run has no such wall. Remove the entry, or write \"Dimension = 3\".");
    }
  };

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
    BoundaryParameters()
        : FaceEntries{ "free slip", "free slip", "free slip", "free slip", "fixed", "open" }
    {
    }

    /// Declares the subsection and its entries.
    void add_parameters(dealii::ParameterHandler &prm);

    /// Throws EntryError if an entry does not read as a wall, or is set for a wall that is not there.
    void check(const unsigned int dim) const
    {
      walls(3);
      FaceEntries::check("Boundaries", dim, BoundaryParameters());
    }

    /// The walls in deal.II's numbering of the faces.
    std::vector<Wall> walls(const unsigned int dim) const;
  };

  /// Walls of the box acting on the soil at the nodes.
  template <int dim>
  class BoundaryConditions
  {
  public:
    /// Reads the entries; throws EntryError if one does not read as a wall.
    BoundaryConditions(const BackgroundGrid<dim> &grid, const BoundaryParameters &parameters)
        : grid(grid)
        , wall_list(parameters.walls(dim))
    {
    }

    /// What the walls do to the soil at a node that lies on the given faces of the box, see
    /// BackgroundGrid::node_faces().
    std::vector<NodeConstraint<dim>> constraints(const std::uint8_t faces) const;

    /// Which of these faces take the impulses on the soil.
    BearingFaces<dim> bearing_faces(const std::uint8_t faces) const
    {
      const auto type = [this](const unsigned int face) { return wall_list[face].type; };
      return BearingFaces<dim>(
          faces,
          [&](const unsigned int face) { return type(face) != WallType::open; },
          [&](const unsigned int face) { return type(face) == WallType::fixed || type(face) == WallType::friction; });
    }

    /// One wall a face of the box, in deal.II's numbering.
    const std::vector<Wall> &walls() const
    {
      return wall_list;
    }

    /// Name of the face of the box nearest to a point outside, and whether it is open.
    std::pair<std::string, bool> face_crossed(const dealii::Point<dim> &location) const
    {
      const unsigned int face = nearest_face(grid, location);
      return { FaceEntries::names(dim)[face], wall_list[face].type == WallType::open };
    }

  private:
    const BackgroundGrid<dim> &grid;
    const std::vector<Wall> wall_list;
  };

  /// The face of the box, in deal.II's numbering, beyond which a point outside is farthest.
  template <int dim>
  unsigned int nearest_face(const BackgroundGrid<dim> &grid, const dealii::Point<dim> &location);
} // namespace scree

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_boundary_water_walls_h
#define scree_boundary_water_walls_h

#include <scree/boundary/boundary_conditions.h>

namespace scree
{
  /// What a face of the box does to the water.
  enum class WaterWallType
  {
    impermeable, ///< no motion along the normal; free slip
    no_slip,     ///< no motion
    drained      ///< its pressure is prescribed; points may leave
  };

  /// What one face of the box does to the water.
  struct WaterWall
  {
    WaterWallType type = WaterWallType::impermeable; ///< constraint of the water
    double pressure    = 0;                          ///< Pa; drained walls only
  };

  /// Subsection Water of subsection Boundaries: one entry a face of the box.
  struct WaterBoundaryParameters : FaceEntries
  {
    WaterBoundaryParameters()
        : FaceEntries{ "impermeable", "impermeable", "impermeable", "impermeable", "impermeable", "drained" }
    {
    }

    /// Declares the subsection and its entries.
    void add_parameters(dealii::ParameterHandler &prm);

    /// Throws EntryError if an entry does not read as a wall, or is set for a wall that is not there.
    void check(const unsigned int dim) const
    {
      walls(3);
      FaceEntries::check("Boundaries/Water", dim, WaterBoundaryParameters());
    }

    /// The walls in deal.II's numbering of the faces.
    std::vector<WaterWall> walls(const unsigned int dim) const;
  };

  /// Walls of the box acting on the water at the nodes. `faces` as in BackgroundGrid::node_faces().
  template <int dim>
  class WaterBoundaryConditions
  {
  public:
    /// Reads the entries; throws EntryError if one does not read as a wall.
    WaterBoundaryConditions(const BackgroundGrid<dim> &grid, const WaterBoundaryParameters &parameters)
        : grid(grid)
        , wall_list(parameters.walls(dim))
    {
    }

    /// The directions along which the water of a node on these faces may not move.
    ConstrainedDirections<dim> held_directions(const std::uint8_t faces) const;

    /// Which of these faces take the impulses on the water.
    BearingFaces<dim> bearing_faces(const std::uint8_t faces) const
    {
      return BearingFaces<dim>(
          faces,
          [&](const unsigned int face) { return !is_drained(face); },
          [&](const unsigned int face) { return wall_list[face].type == WaterWallType::no_slip; });
    }

    /// Whether any of the faces is drained.
    bool prescribes_pressure(const std::uint8_t faces) const
    {
      for (unsigned int f = 0; f < 2 * dim; ++f)
        if ((faces >> f) & 1 && is_drained(f))
          return true;
      return false;
    }

    /// Pressure of the drained ones among the faces, Pa: their mean, or 0 if there is none.
    double pressure(const std::uint8_t faces) const;

    /// Whether the pressure is prescribed on the face.
    bool is_drained(const unsigned int face) const
    {
      return wall_list[face].type == WaterWallType::drained;
    }

    /// The faces that are not drained.
    std::uint8_t closed_faces() const
    {
      std::uint8_t faces = 0;
      for (unsigned int f = 0; f < 2 * dim; ++f)
        faces |= (is_drained(f) ? 0u : 1u) << f;
      return faces;
    }

    /// Name of the face of the box nearest to a point outside, and whether it is drained.
    std::pair<std::string, bool> face_crossed(const dealii::Point<dim> &location) const
    {
      const unsigned int face = nearest_face(grid, location);
      return { FaceEntries::names(dim)[face], is_drained(face) };
    }

  private:
    const BackgroundGrid<dim> &grid;
    const std::vector<WaterWall> wall_list;
  };
} // namespace scree

#endif

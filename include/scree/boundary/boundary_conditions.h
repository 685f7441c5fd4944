// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_boundary_boundary_conditions_h
#define scree_boundary_boundary_conditions_h

#include <scree/boundary/node_constraint.h>
#include <scree/input/expression.h>
#include <scree/input/input_error.h>
#include <scree/mesh/background_grid.h>

#include <deal.II/base/parameter_handler.h>

#include <limits>
#include <map>

namespace scree
{
  /// What one face of the box does to soil or water.
  struct Wall
  {
    /// Which velocity it takes.
    enum class Holds
    {
      nothing, ///< points may leave
      normal,
      all
    };

    Holds holds = Holds::nothing;        ///< while soil does not lift off; of one that it lifts off from, `all`
                                         ///< makes it act on soil that is near, see Constraints::is_fixed()
    bool lets_lift_off          = false; ///< it holds soil that moves into it, with Coulomb friction along it
    double friction_coefficient = 0;     ///< of one that soil lifts off from; may be infinite
    double pressure             = 0;     ///< of the water where it holds nothing, Pa
    std::string level =
        ""; ///< in its place: the level that the water falls to there, m, an expression of t; may be empty
    bool absorbs = false; ///< from the release on it holds nothing, and the ground beyond it acts, see AbsorbingWalls
  };

  /// A kind of wall, as entries have it: its name, or name and number.
  struct WallType
  {
    std::string name;                  ///< as in entries
    std::string number;                ///< what the number or level is, for messages and pages; empty: there is none
    Wall (*make)(const double number); ///< the wall; 0 where there is no number
    double least  = std::numeric_limits<double>::lowest(); ///< of the number
    double below  = std::numeric_limits<double>::max();    ///< limit that it does not reach
    bool is_level = false;                                 ///< an expression of t in place of a number
  };

  /// Adds a type of walls for soil (subsection Boundaries) or water (Boundaries/Water); its source file has one as a
  /// static constant.
  class RegisterWallType
  {
  public:
    /// @param subsection whose entries may have it
    RegisterWallType(const std::string &subsection, const WallType &type);
  };

  /// One entry a face of the box, in a subsection of walls.
  struct FaceEntries
  {
    std::map<std::string, std::string> texts; ///< values by the names() of a box in space

    /// Names of the faces in deal.II's numbering: lower and upper face of each axis.
    static std::vector<std::string> names(const unsigned int dim)
    {
      if (dim == 2)
        return { "Left", "Right", "Bottom", "Top" };
      return { "Left", "Right", "Front", "Back", "Bottom", "Top" };
    }

    /// Declares the subsection and its entries.
    void add_parameters(dealii::ParameterHandler &prm);

    /// Throws EntryError if an entry does not read as a wall, or is set for a wall that is not there.
    void check(const unsigned int dim) const
    {
      walls(3);
      if (dim == 2)
        for (const char *name : { "Front", "Back" })
          require_entry(texts.at(name) == default_side,
                        { subsection, name, texts.at(name) },
                        "a plane strain run has no such wall. Remove the entry, or write \"Dimension = 3\".");
    }

    /// The walls in deal.II's numbering of the faces. Throws EntryError if an entry does not read as a wall.
    std::vector<Wall> walls(const unsigned int dim) const;

  protected:
    /// @param subsection its path
    /// @param phase on which the walls act, for the descriptions of the entries
    /// @param side default of the walls but for bottom and top
    FaceEntries(const std::string &subsection,
                const std::string &phase,
                const std::string &side,
                const std::string &bottom,
                const std::string &top)
        : texts{ { "Left", side }, { "Right", side },    { "Front", side },
                 { "Back", side }, { "Bottom", bottom }, { "Top", top } }
        , subsection(subsection)
        , phase(phase)
        , default_side(side)
    {
    }

  private:
    std::string subsection, phase, default_side;
  };

  /// Subsection Boundaries: the walls for the soil.
  struct BoundaryParameters : FaceEntries
  {
    BoundaryParameters();
  };

  /// Subsection Water of subsection Boundaries: the walls for the water.
  struct WaterBoundaryParameters : FaceEntries
  {
    WaterBoundaryParameters();
  };

  /// Walls of the box acting on soil or water at the nodes. `faces` as in BackgroundGrid::node_faces().
  template <int dim>
  class BoundaryConditions
  {
  public:
    /// Reads the entries; throws EntryError if one does not read as a wall.
    /// @param unit_weight of the water, N/m^3, for walls with a level
    BoundaryConditions(const BackgroundGrid<dim> &grid, const FaceEntries &parameters, const double unit_weight = 0.);

    /// Takes the levels of a time, s.
    void set_time(const double time);

    /// What the walls do at a node that lies on the given faces of the box.
    std::vector<NodeConstraint<dim>> constraints(const std::uint8_t faces) const;

    /// The directions along which walls that cannot be lifted off, as those for the water, hold a node on these faces.
    ConstrainedDirections<dim> held_directions(const std::uint8_t faces) const
    {
      ConstrainedDirections<dim> held;
      for (const NodeConstraint<dim> &constraint : constraints(faces))
        held.hold(constraint.normal);
      return held;
    }

    /// Which of these faces take the impulses.
    BearingFaces<dim> bearing_faces(const std::uint8_t faces) const
    {
      return BearingFaces<dim>(
          faces,
          [this](const unsigned int face) { return !is_open(face); },
          [this](const unsigned int face) {
            return wall_list[face].holds == Wall::Holds::all || wall_list[face].lets_lift_off;
          });
    }

    /// One wall a face of the box, in deal.II's numbering.
    const std::vector<Wall> &walls() const
    {
      return wall_list;
    }

    /// Whether points may leave through a face.
    bool is_open(const unsigned int face) const
    {
      return wall_list[face].holds == Wall::Holds::nothing;
    }

    /// The faces that are open, bit f: face f.
    std::uint8_t open_faces() const
    {
      std::uint8_t faces = 0;
      for (unsigned int f = 0; f < 2 * dim; ++f)
        faces |= (is_open(f) ? 1u : 0u) << f;
      return faces;
    }

    /// The faces that are not.
    std::uint8_t closed_faces() const
    {
      return ((1u << 2 * dim) - 1) & ~open_faces();
    }

    /// Pressure of the open ones among the faces at a height, m, Pa: their mean, or 0 if there is none.
    double pressure(const std::uint8_t faces, const double height) const;

    /// Whether an open face holds a pressure other than 0.
    bool holds_pressure(const unsigned int face) const
    {
      return is_open(face) && (wall_list[face].pressure != 0. || levels[face]);
    }

    /// Whether any does.
    bool has_pressure() const
    {
      bool any = false;
      for (unsigned int f = 0; f < 2 * dim; ++f)
        any = any || holds_pressure(f);
      return any;
    }

    /// Name of the face of the box nearest to a point outside, and whether it is open.
    std::pair<std::string, bool> face_crossed(const dealii::Point<dim> &location) const
    {
      const unsigned int face = nearest_face(grid, location);
      return { FaceEntries::names(dim)[face], is_open(face) };
    }

  private:
    const BackgroundGrid<dim> &grid;
    const std::vector<Wall> wall_list;
    std::array<std::unique_ptr<Expression<1>>, 2 * dim> levels; // m, of t; null: none
    std::array<double, 2 * dim> present_levels{};               // m
    const double unit_weight;                                   // N/m^3
  };

  /// The face of the box, in deal.II's numbering, beyond which a point outside is farthest.
  template <int dim>
  unsigned int nearest_face(const BackgroundGrid<dim> &grid, const dealii::Point<dim> &location);

  /// A face of the box in words: `the wall x = 1 m ("Upper corner")`.
  template <int dim>
  std::string wall_text(const BackgroundGrid<dim> &grid, const unsigned int face)
  {
    const bool is_lower = face % 2 == 0;
    return std::string("the wall ") + "xyz"[face / 2] + " = " +
           coordinate_text((is_lower ? grid.lower_corner() : grid.upper_corner())[face / 2]) + " m (\"" +
           (is_lower ? "Lower" : "Upper") + " corner\")";
  }
} // namespace scree

#endif

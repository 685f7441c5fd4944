// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_geometry_bed_parameters_h
#define scree_geometry_bed_parameters_h

#include <scree/geometry/level_set.h>
#include <scree/geometry/raster.h>

#include <deal.II/base/parameter_handler.h>

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace scree
{
  /// Place of a rigid surface, and the entry of its shape.
  struct ShapeRequest
  {
    std::string subsection;      ///< Bed, or Obstacle NAME
    std::string entry;           ///< such as Profile
    std::string value;           ///< of the entry; of a file its path from the working folder
    dealii::Point<2> map_origin; ///< where the map has the origin of the case's coordinates, m
    std::vector<double> lower;   ///< corner of the box, m
    std::vector<double> upper;   ///< corner of the box, m
    double cell_size;            ///< of the mesh, m

    /// entry_name(), for messages.
    std::string where() const;

    /// Throws EntryError that names entry and value unless the shape is `possible`.
    void require(const bool possible, const std::string &remedy) const;

    /// The same unless ground from `first` to `last` along an axis, but for `rounding`, covers the box; m.
    void require_cover(const unsigned int axis, const double first, const double last, const double rounding) const;
  };

  /// Makes the surface; throws EntryError if the value of the entry or its file is wrong.
  template <int dim>
  using MakeShape = std::function<std::unique_ptr<LevelSet<dim>>(const ShapeRequest &)>;

  /// What the value of an entry is.
  enum class ShapeValue
  {
    text, ///< made once without a box when the case is checked, so that its faults show then
    file
  };

  /// A shape of rigid surfaces: an entry of subsections Bed and Obstacle.
  struct RigidShape
  {
    std::string documentation; ///< of the entry
    ShapeValue value;          ///< what the value of the entry is
    std::string remedy;        ///< for scenes of the dimension that it is not for; empty: it is for both
    MakeShape<2> make_2d;      ///< null: it is for scenes in space only
    MakeShape<3> make_3d;      ///< null: it is for plane scenes only

    /// make_2d or make_3d.
    template <int dim>
    const MakeShape<dim> &make() const
    {
      if constexpr (dim == 2)
        return make_2d;
      else
        return make_3d;
    }
  };

  /// All shapes by their entries: those for all scenes come first, then those of plane ones.
  const std::vector<std::pair<std::string, RigidShape>> &rigid_shapes();

  /// Their entries, for messages.
  std::string names_of_shapes();

  /// Adds a shape; its source file has one as a static constant.
  class RegisterShape
  {
  public:
    /// @param entry its name in subsections Bed and Obstacle
    RegisterShape(const std::string &entry, RigidShape shape);
  };

  /// What a rigid surface does to soil that presses on it.
  enum class BedType
  {
    none,  ///< there is no such surface
    fixed, ///< no slip
    free_slip,
    friction ///< Coulomb's
  };

  /// Subsection Bed: rigid ground that need not follow the mesh. Obstacles have its entries, too.
  struct BedParameters
  {
    std::string subsection = "Bed"; ///< Bed, or Obstacle NAME

    std::string type      = "none";            ///< none | fixed | free slip | friction
    std::string for_water = "impermeable";     ///< impermeable | no slip
    double friction_angle = 0;                 ///< degrees
    std::map<std::string, std::string> shapes; ///< values by entries, see rigid_shapes(); empty: not given
    double turbulent_friction = 0;             ///< xi of Voellmy's law, m/s^2; 0: none; of the bed only

    /// Declares the subsection and its entries.
    void add_parameters(dealii::ParameterHandler &prm);

    /// Where the map has the origin of the case's coordinates, m; set once the case is read.
    dealii::Point<2> map_origin;

    /// Declares the entries in the subsection that the handler is in.
    void add_entries(dealii::ParameterHandler &prm);

    /// Throws EntryError at impossible combinations.
    void check(const unsigned int dim) const;

    /// Entry `Type` as an enum.
    BedType type_kind() const;

    /// Whether free water does not slip along it.
    bool no_slip() const
    {
      return for_water == "no slip";
    }

    /// Whether there is such a surface.
    bool is_set() const
    {
      return type_kind() != BedType::none;
    }

    /// Largest tangential over normal force; infinite if the bed is fixed.
    double friction_coefficient() const;

    /// Entry and value of the shape; empty if none is given.
    std::pair<std::string, std::string> geometry() const;

    /// File of the ground's heights; empty without one.
    std::string raster() const;
  };

  /// The surface; null if there is none. Reads its file; throws EntryError if that is no ground for the box.
  /// @param lower, upper corners of the box, m
  /// @param cell_size of the mesh, m
  template <int dim>
  std::unique_ptr<LevelSet<dim>> make_bed(const BedParameters &parameters,
                                          const std::vector<double> &lower,
                                          const std::vector<double> &upper,
                                          const double cell_size);

  /// Subsection Obstacle NAME: a rigid body that soil and water meet, at rest or moved without turning.
  struct ObstacleParameters
  {
    /// What the names of the subsections begin with.
    static const std::string prefix;

    BedParameters surface; ///< of the start
    std::string velocity;  ///< m/s, of t, one expression an axis; empty: at rest
    std::string pivot;     ///< of the moment, m, one number an axis; empty: the middle of the box's floor

    /// @param subsection prefix and name
    explicit ObstacleParameters(const std::string &subsection);

    /// Declares the subsection and its entries.
    void add_parameters(dealii::ParameterHandler &prm);

    /// Throws EntryError at impossible combinations.
    void check(const unsigned int dim) const;

    /// Without the prefix.
    std::string name() const;

    /// Whether a velocity is given.
    bool is_moving() const
    {
      return !velocity.empty();
    }
  };
} // namespace scree

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_geometry_rigid_shape_h
#define scree_geometry_rigid_shape_h

#include <scree/geometry/level_set.h>

#include <functional>
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
} // namespace scree

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_geometry_obstacle_parameters_h
#define scree_geometry_obstacle_parameters_h

#include <scree/geometry/bed_parameters.h>

namespace scree
{
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

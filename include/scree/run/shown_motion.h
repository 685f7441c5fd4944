// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_run_shown_motion_h
#define scree_run_shown_motion_h

#include <scree/model/scene.h>

#include <string>

namespace scree
{
  /// The column of the progress table that says where a scene is: the front of the soil, or of the water without soil;
  /// on a bed in space, where no axis is that of the motion, the largest speed.
  template <int dim>
  class ShownMotion
  {
  public:
    /// The scene is kept by reference.
    explicit ShownMotion(const Scene<dim> &scene);

    /// Heading of the column, with the unit.
    std::string heading() const;

    /// Value of the column. Collective.
    double value() const;

    /// Kinetic energy of soil and water, J (2D: per m). Collective.
    double kinetic_energy() const;

  private:
    enum class Kind
    {
      soil_front,
      water_front,
      largest_speed
    };

    const Scene<dim> &scene;
    const Kind kind;
  };
} // namespace scree

#endif

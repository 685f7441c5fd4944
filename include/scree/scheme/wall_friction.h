// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_scheme_wall_friction_h
#define scree_scheme_wall_friction_h

#include <scree/grid/boundary_conditions.h>
#include <scree/scheme/drag_pair.h>

#include <vector>

namespace scree
{
  /// Walls with friction in a step of soil and water: the predictor finds out where the soil moves into a wall, which
  /// stops it there until the step's end. Coulomb's law then bounds the tangential impulse by the normal one: soil that
  /// this can hold sticks. Friction acts before the pressure is solved, so that the pressure sees the motion that it
  /// leaves, and follows the change of the normal impulse that the new pressure brings.
  template <int dim>
  class WallFriction
  {
  public:
    WallFriction(const BackgroundGrid<dim> &grid, const BoundaryConditions<dim> &walls);

    /// Fits the contacts to the grid's current nodes.
    void reinit();

    /// No node is in contact, before a new step.
    void clear();

    /// The components of velocity that friction walls stop at an owned node, bit c for component c.
    unsigned int stopped_components(const unsigned int node) const
    {
      return contacts.empty() ? 0 : contacts[node];
    }

    /// Sets them from the velocity that the soil would have without them; returns whether there are any.
    bool find_contact(const unsigned int node, const dealii::Tensor<1, dim> &velocity);

    /// The impulse, N s, of friction on the soil of a node in contact, from the impulses of soil and water without it.
    /// Soil that sticks gets none: all its components are stopped from here on.
    dealii::Tensor<1, dim> resist(const unsigned int node,
                                  const DragPair<dim> &pair,
                                  const dealii::Tensor<1, dim> &soil_impulse,
                                  const dealii::Tensor<1, dim> &water_impulse);

    /// What that impulse changes by, N s, when the wall's reaction does, for soil of a mass, kg, and a velocity.
    dealii::Tensor<1, dim> adjust(const unsigned int node,
                                  const dealii::Tensor<1, dim> &reaction_change,
                                  const double mass,
                                  const dealii::Tensor<1, dim> &velocity) const;

    /// The impulse of resist(), 0 where nothing slides.
    dealii::Tensor<1, dim> resistance(const unsigned int node) const
    {
      return contacts.empty() ? dealii::Tensor<1, dim>() : resistances[node];
    }

  private:
    double bound(const unsigned int node, const dealii::Tensor<1, dim> &reaction) const;

    const BackgroundGrid<dim> &grid;
    const BoundaryConditions<dim> &walls;
    std::vector<std::uint8_t> contacts;                         // by owned node; empty without friction walls
    std::vector<dealii::Tensor<1, dim>> reactions, resistances; // N s, where there is contact
  };
} // namespace scree

#endif

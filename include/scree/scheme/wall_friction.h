// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_scheme_wall_friction_h
#define scree_scheme_wall_friction_h

#include <scree/grid/boundary_conditions.h>
#include <scree/scheme/step_balance.h>

#include <vector>

namespace scree
{
  /// Walls with friction in a step of soil and water: the predictor finds out where the soil moves into a wall, which
  /// stops it there until the step's end; then Coulomb's law bounds the tangential impulse by the normal one.
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

    /// Takes note of the impulse, N s, that stopping the soil took.
    void add_reaction(const unsigned int node, const dealii::Tensor<1, dim> &impulse);

    /// Change of velocity, m/s, by which friction slows the soil at a node that moves at `velocity` and was at `before`
    /// at the start of the step.
    dealii::Tensor<1, dim> slow_down(const unsigned int node,
                                     const double mass,
                                     const dealii::Tensor<1, dim> &before,
                                     const dealii::Tensor<1, dim> &velocity,
                                     StepBalance<dim> &balance) const;

  private:
    const BackgroundGrid<dim> &grid;
    const BoundaryConditions<dim> &walls;
    std::vector<std::uint8_t> contacts;            // by owned node; empty without friction walls
    std::vector<dealii::Tensor<1, dim>> reactions; // N s
  };
} // namespace scree

#endif

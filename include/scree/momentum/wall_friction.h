// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_momentum_wall_friction_h
#define scree_momentum_wall_friction_h

#include <scree/boundary/constraints.h>
#include <scree/boundary/drag_block.h>

#include <vector>

namespace scree
{
  /// Unilateral constraints in a step of soil and water: the predictor finds out where the soil moves into a wall,
  /// which stops it there until the step's end. Coulomb's law then bounds the tangential impulse by the normal one:
  /// soil that this can hold sticks. Friction acts before the pressure is solved, so that the pressure sees the motion
  /// that it leaves, and follows the change of the normal impulse that the new pressure brings.
  template <int dim>
  class WallFriction
  {
  public:
    /// Keeps a reference to the constraints.
    explicit WallFriction(const Constraints<dim> &constraints);

    /// Fits the contacts to the current nodes, `n_owned_nodes` on this rank.
    void reinit(const unsigned int n_owned_nodes);

    /// No node is in contact, before a new step.
    void clear();

    /// The directions along which walls stop the soil of an owned node: the fixed ones and those of its contacts.
    ConstrainedDirections<dim> held(const unsigned int node) const;

    /// Finds the contacts from the velocity that the soil would have without them; returns whether there are any.
    bool find_contact(const unsigned int node, const dealii::Tensor<1, dim> &velocity);

    /// The impulse, N s, of friction on the soil of a node in contact, from the impulses of soil and water without it.
    /// Soil that sticks gets none: all its directions are held from here on.
    dealii::Tensor<1, dim>
    resist(const unsigned int node, const DragBlock<dim> &pair, const SoilAndWater<dim> &impulses);

    /// What that impulse changes by, N s, when the wall's reaction does, for soil of a mass, kg, and a velocity.
    dealii::Tensor<1, dim> adjust(const unsigned int node,
                                  const dealii::Tensor<1, dim> &reaction_change,
                                  const double mass,
                                  const dealii::Tensor<1, dim> &velocity) const;

    /// The impulse of resist(), 0 where nothing slides.
    dealii::Tensor<1, dim> resistance(const unsigned int node) const
    {
      return contacts.empty() ? dealii::Tensor<1, dim>() : contacts[node].resistance;
    }

  private:
    struct Contact
    {
      unsigned int pushing = 0; ///< bit i: the node's constraint i stops the soil
      bool sticks          = false;
      dealii::Tensor<1, dim> reaction, resistance; ///< normal and tangential impulse of the predictor, N s

      bool any() const
      {
        return pushing != 0;
      }
    };

    /// Largest tangential impulse, N s, that a reaction, N s, allows.
    double bound(const unsigned int node, const dealii::Tensor<1, dim> &reaction) const;

    const Constraints<dim> &constraints;
    std::vector<Contact> contacts; // by owned node; empty without unilateral constraints
  };
} // namespace scree

#endif

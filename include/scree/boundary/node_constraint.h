// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_boundary_node_constraint_h
#define scree_boundary_node_constraint_h

#include <scree/boundary/wall_impulses.h>

#include <vector>

namespace scree
{
  /// What Coulomb's law makes of an impulse along a surface.
  template <int dim>
  struct Friction
  {
    dealii::Tensor<1, dim> impulse; ///< on the soil
    bool sticks;                    ///< it stops the motion, and more was available
  };

  /// The tangential impulse, N s, that friction allows for one across a surface; the coefficient may be infinite.
  inline double available_friction(const double coefficient, const double normal_impulse)
  {
    return normal_impulse > 0. ? coefficient * normal_impulse : 0.;
  }

  /// Coulomb's law, in impulses (N s, or m/s for those of a unit mass).
  /// @param needed the impulse along the surface that would stop the motion along it
  /// @param available friction coefficient times normal impulse, not negative
  template <int dim>
  Friction<dim> coulomb_friction(const dealii::Tensor<1, dim> &needed, const double available)
  {
    const double size = needed.norm();
    if (size < available)
      return { needed, true };
    return { size > 0. ? available / size * needed : dealii::Tensor<1, dim>(), false };
  }


  /// The directions along which a velocity is held at 0.
  template <int dim>
  class ConstrainedDirections
  {
  public:
    /// Holds the velocity along a unit vector, too.
    void hold(const dealii::Tensor<1, dim> &direction)
    {
      constexpr double smallest   = 1e-6; // below it, what is held already spans the direction
      dealii::Tensor<1, dim> rest = free_part(direction);
      if (const double size = rest.norm(); size > smallest)
        basis[n_held++] = rest / size;
    }

    /// Holds the velocity along the directions of `other`, too.
    void hold(const ConstrainedDirections &other)
    {
      for (unsigned int i = 0; i < other.n_held; ++i)
        hold(other.basis[i]);
    }

    /// Holds all components of the velocity.
    void hold_all()
    {
      for (unsigned int a = 0; a < dim; ++a)
        {
          basis[a]    = dealii::Tensor<1, dim>();
          basis[a][a] = 1.;
        }
      n_held = dim;
    }

    /// Whether any direction is held.
    bool any() const
    {
      return n_held > 0;
    }

    /// What is left of a vector without its components along the held directions.
    dealii::Tensor<1, dim> free_part(dealii::Tensor<1, dim> vector) const
    {
      if (n_held == dim)
        return dealii::Tensor<1, dim>();
      // Twice: what rounding leaves along the held directions would be magnified by large drag.
      for (unsigned int pass = 0; pass < 2; ++pass)
        for (unsigned int i = 0; i < n_held; ++i)
          vector -= (vector * basis[i]) * basis[i];
      return vector;
    }

    /// The components of a vector along the held directions.
    dealii::Tensor<1, dim> held_part(const dealii::Tensor<1, dim> &vector) const
    {
      dealii::Tensor<1, dim> part;
      for (unsigned int i = 0; i < n_held; ++i)
        part += (vector * basis[i]) * basis[i];
      return part;
    }

  private:
    std::array<dealii::Tensor<1, dim>, dim> basis; // orthonormal
    unsigned int n_held = 0;
  };


  /// One condition on the soil's velocity at a node.
  template <int dim>
  struct NodeConstraint
  {
    /// Kind of a constraint.
    enum class Type
    {
      fixed,     ///< no motion along the normal
      unilateral ///< no motion against the normal, and Coulomb friction while the wall pushes
    };

    dealii::Tensor<1, dim> normal;             ///< unit, from the wall to the soil
    Type type                   = Type::fixed; ///< kind of the constraint
    double friction_coefficient = 0;           ///< of a unilateral one
  };


  /// All that walls do to a node.
  template <int dim>
  struct NodeConstraints
  {
    std::vector<NodeConstraint<dim>> soil;       ///< in the order in which they act on dry soil
    ConstrainedDirections<dim> soil_constraint;  ///< by the fixed ones
    ConstrainedDirections<dim> water_constraint; ///< free slip holds the normal, no slip all directions
    BearingFaces<dim> soil_faces,                ///< the faces of the box that act on the soil
        water_faces;                             ///< those that act on the water
    bool is_rigid = false;                       ///< whether rigid soil stands here, which brings no mass to the node
    dealii::Tensor<1, dim> soil_velocity,        ///< of what holds the soil, m/s: of an inflow, else 0
        water_velocity;                          ///< of what holds the water, m/s: of an inflow, else 0

    /// Adds a constraint of the soil, after those before.
    void add(const NodeConstraint<dim> &constraint)
    {
      soil.push_back(constraint);
      if (constraint.type == NodeConstraint<dim>::Type::fixed)
        soil_constraint.hold(constraint.normal);
    }

    /// Whether anything holds soil or water here.
    bool any() const
    {
      return !soil.empty() || water_constraint.any();
    }

    /// Corrects the end-of-step velocity of dry soil, one constraint after the other; returns where they stop it.
    /// @param wall_velocity m/s
    ConstrainedDirections<dim> apply(dealii::Tensor<1, dim> &velocity,
                                     const dealii::Tensor<1, dim> &wall_velocity) const
    {
      ConstrainedDirections<dim> stopped;
      velocity -= wall_velocity;
      for (const NodeConstraint<dim> &constraint : soil)
        {
          const double normal_speed = velocity * constraint.normal;
          const bool fixed          = constraint.type == NodeConstraint<dim>::Type::fixed;
          if (!fixed && normal_speed >= 0.)
            continue; // The soil lifts off.
          velocity -= normal_speed * constraint.normal;
          stopped.hold(constraint.normal);
          if (fixed)
            continue;
          const auto friction = coulomb_friction<dim>(-velocity, -constraint.friction_coefficient * normal_speed);
          velocity += friction.impulse;
          if (friction.sticks)
            stopped.hold_all();
        }
      velocity += wall_velocity;
      return stopped;
    }
  };
} // namespace scree

#endif

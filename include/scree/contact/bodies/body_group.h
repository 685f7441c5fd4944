// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_contact_bodies_body_group_h
#define scree_contact_bodies_body_group_h

#include <scree/boundary/constraints.h>
#include <scree/mesh/node_values.h>

namespace scree
{
  /// A group of bodies that stick to each other, at the nodes. What it refers to must live on.
  template <int dim>
  struct BodyGroup
  {
    unsigned int number;                 ///< SoilBody::group of its bodies
    NodalField<dim> *field;              ///< nodal field of the group
    const Constraints<dim> *constraints; ///< constraints of its nodes

    /// Whether the group has mass at a node, or is rigid there.
    bool acts_on(const unsigned int node) const
    {
      if ((*field)[node][NodalField<dim>::mass] > 0.)
        return true;
      const NodeConstraints<dim> *walls = constraints->at(node);
      return walls != nullptr && walls->is_rigid;
    }

    /// 1/kg, of a node that it acts on.
    double inverse_mass(const unsigned int node) const
    {
      const NodeConstraints<dim> *walls = constraints->at(node);
      return walls != nullptr && walls->is_rigid ? 0. : 1. / (*field)[node][NodalField<dim>::mass];
    }
  };
} // namespace scree

#endif

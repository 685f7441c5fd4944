// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/contact/bodies/body_contact.h>
#include <scree/contact/node_contact.h>
#include <scree/tensor/vector.h>

#include <algorithm>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// Gap that counts as touching, cell widths.
    constexpr double slack = 0.01;
  } // namespace


  template <int dim>
  BodyContact<dim>::BodyContact(const BackgroundGrid<dim> &grid,
                                const BodyGroup<dim> &first,
                                const BodyGroup<dim> &second,
                                const ContactPair &pair,
                                const std::list<SoilBody<dim>> &bodies)
      : grid(grid)
      , groups{ { first, second } }
      , normals(grid, first, second, pair, bodies)
  {
  }


  template <int dim>
  void BodyContact<dim>::reinit()
  {
    normals.reinit();
  }


  template <int dim>
  void BodyContact<dim>::find()
  {
    normals.find();
    list_meetings();
  }


  template <int dim>
  void BodyContact<dim>::list_meetings()
  {
    meetings.clear();
    for (const unsigned int node : normals.nodes())
      {
        if (!normals.is_between(node))
          continue; // Only one of the groups is there.
        Tensor<1, dim> normal = normals.normal(node);
        for (unsigned int side = 0; side < 2; ++side)
          if (const NodeConstraints<dim> *walls = groups[side].constraints->at(node);
              walls != nullptr && !walls->is_rigid)
            normal = walls->soil_constraint.free_part(normal);
        constexpr double smallest = 1e-6; // below it, walls hold the node
        if (const double size = normal.norm(); size > smallest)
          meetings.push_back({ node,
                               normal / size,
                               normals.gap(node),
                               normals.friction(node),
                               {},
                               { { groups[0].inverse_mass(node), groups[1].inverse_mass(node) } } });
      }
  }


  template <int dim>
  void BodyContact<dim>::solve(const double time_step, Budget<dim> &balance)
  {
    const double touching = slack * grid.cell_size();
    for (Meeting &meeting : meetings)
      {
        double *values[2];
        MovingMass<dim> masses[2];
        for (unsigned int side = 0; side < 2; ++side)
          {
            values[side] = (*groups[side].field)[meeting.node];
            masses[side] = { meeting.inverse_mass[side], vector_of<dim>(values[side] + NodalField<dim>::velocity) };
          }
        const double approach = std::max(0., meeting.gap - touching) / time_step;
        const Tensor<1, dim> impulse =
            contact_impulse(masses[0], masses[1], meeting.normal, approach, meeting.friction);
        if (impulse.norm_square() == 0.)
          continue;
        meeting.impulse += impulse;
        for (unsigned int side = 0; side < 2; ++side)
          {
            const Tensor<1, dim> own = side == 0 ? -impulse : impulse;
            if (masses[side].inverse_mass == 0.)
              {
                balance.wall_impulse -= own; // What rigid soil is given, it gives to the rest of the world.
                continue;
              }
            Tensor<1, dim> velocity = masses[side].velocity + masses[side].inverse_mass * own;
            if (const NodeConstraints<dim> *walls = groups[side].constraints->at(meeting.node))
              stop_at_walls(*walls, masses[side].inverse_mass, velocity, balance);
            for (unsigned int c = 0; c < dim; ++c)
              {
                values[side][NodalField<dim>::velocity_change + c] +=
                    velocity[c] - values[side][NodalField<dim>::velocity + c];
                values[side][NodalField<dim>::velocity + c] = velocity[c];
              }
          }
      }
  }


  template <int dim>
  void BodyContact<dim>::count_dissipation(Budget<dim> &balance) const
  {
    for (const Meeting &meeting : meetings)
      for (unsigned int side = 0; side < 2; ++side)
        {
          const double *values         = (*groups[side].field)[meeting.node];
          const Tensor<1, dim> own     = side == 0 ? -meeting.impulse : meeting.impulse;
          const Tensor<1, dim> working = working_velocity(vector_of<dim>(values + NodalField<dim>::velocity),
                                                          vector_of<dim>(values + NodalField<dim>::velocity_change),
                                                          meeting.inverse_mass[side] * own);
          balance.contact_dissipation -= own * working;
        }
  }

  template class BodyContact<2>;
  template class BodyContact<3>;
} // namespace scree

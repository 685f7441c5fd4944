// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_contact_bodies_body_contact_h
#define scree_contact_bodies_body_contact_h

#include <scree/contact/bodies/contact_normals.h>
#include <scree/step/step_report.h>

#include <array>
#include <list>
#include <vector>

namespace scree
{
  /// Contact of two groups of dry bodies, each with a velocity field of its own, by impulses at the nodes that both act
  /// on (@source{bardenhagen2000}; @source{bardenhagen2001}): opposite, against approach only, and along the
  /// surface by Coulomb's law. Points that do not reach each other along the node's normal (ContactNormals) are no
  /// contact yet: they may close the gap.
  template <int dim>
  class BodyContact
  {
  public:
    /// Keeps references to grid and bodies.
    /// @param pair the two groups and their friction
    BodyContact(const BackgroundGrid<dim> &grid,
                const BodyGroup<dim> &first,
                const BodyGroup<dim> &second,
                const ContactPair &pair,
                const std::list<SoilBody<dim>> &bodies);

    /// Fits the nodes to the grid's current partition. Collective.
    void reinit();

    /// Finds normals and gaps at the nodes that both groups act on; the ghosts of the fields hold values. Collective.
    void find();

    /// Corrects the velocities of owned nodes at the end of a step, s.
    void solve(const double time_step, Budget<dim> &balance);

    /// Adds the energy that the impulses of all calls of solve() since find() have taken to the balance, when the
    /// velocities of the step are known.
    void count_dissipation(Budget<dim> &balance) const;

  private:
    /// A node that both act on.
    struct Meeting
    {
      unsigned int node;
      dealii::Tensor<1, dim> normal;      ///< from the first group to the second, as far as walls leave it
      double gap;                         ///< m; touching below the slack
      double friction;                    ///< coefficient
      dealii::Tensor<1, dim> impulse;     ///< on the second group, N s
      std::array<double, 2> inverse_mass; ///< 1/kg
    };

    void list_meetings();

    const BackgroundGrid<dim> &grid;
    const std::array<BodyGroup<dim>, 2> groups;
    ContactNormals<dim> normals;
    std::vector<Meeting> meetings;
  };
} // namespace scree

#endif

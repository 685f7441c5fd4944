// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_contact_cut_cells_contact_solver_h
#define scree_contact_cut_cells_contact_solver_h

#include <scree/contact/cut_cells/delassus_operator.h>

#include <vector>

namespace scree
{
  /// Where the ground may still change the motion of a contact.
  enum class HeldMotion : unsigned int
  {
    none,
    across, ///< the ground
    all
  };

  /// Soil or water at a segment of rigid ground, and the impulse that the ground takes from it.
  template <int dim>
  struct GroundContact
  {
    unsigned int segment;           ///< its number
    Phase phase;                    ///< soil or water
    bool is_unilateral;             ///< the ground presses only
    double friction;                ///< coefficient; 0: slips, infinite: sticks. Of a bilateral contact one of these
    double area;                    ///< m^(dim-1)
    dealii::Tensor<1, dim> normal;  ///< unit, out of the open
    dealii::Tensor<1, dim> speed;   ///< m/s, beside the ground's own, before any impulse
    dealii::Tensor<1, dim> base;    ///< N s: what the ground has taken in this step already
    dealii::Tensor<1, dim> impulse; ///< N s, additional; holds the initial guess on entry
    HeldMotion held = HeldMotion::none; ///< what has been found: none where it lifts off, across where it slides

    /// What the ground holds while the contact presses and does not slide.
    HeldMotion holds() const
    {
      return friction > 0. ? HeldMotion::all : HeldMotion::across;
    }

    /// The part of a vector in `motion`.
    dealii::Tensor<1, dim> part(const HeldMotion motion, const dealii::Tensor<1, dim> &vector) const
    {
      switch (motion)
        {
        case HeldMotion::none:
          return dealii::Tensor<1, dim>();
        case HeldMotion::across:
          return (vector * normal) * normal;
        default:
          return vector;
        }
    }

    /// Changes the impulse to what the contact's law wants where `left`, m/s, is left of its motion.
    /// @param mobility of the contact, 1/kg
    void obey_law(const dealii::Tensor<1, dim> &left, const double mobility);

  private:
    /// Makes the impulse of a unilateral contact one that presses and does not exceed friction.
    void obey_unilateral_law();
  };


  /// Contacts with rigid ground, and the search for their impulses: N A^-1 N^T l = N v where the ground holds them,
  /// with N and A of DelassusOperator, and Coulomb's law.
  ///
  /// Two sweeps, to and fro, give each contact in turn the impulse that its law wants (projected Gauss-Seidel:
  /// @source{jourdan1998}), which settles what presses and slides; conjugate gradients then find the impulses that act
  /// on nearly the same nodes; until each contact obeys its law.
  template <int dim>
  class ContactSolver
  {
  public:
    using Vector = dealii::Tensor<1, dim>; ///< velocity, m/s, or impulse, N s

    /// Both are kept by reference.
    ContactSolver(const BackgroundGrid<dim> &grid, const CutCells<dim> &cut_cells);

    /// Fits the nodes to the grid's current partition.
    void reinit();

    /// Forgets contacts and nodes. Each rank must do so for each rank's contacts.
    void begin_step();

    /// Forgets the contacts.
    void clear();

    /// Adds a contact.
    void add(const GroundContact<dim> &contact);

    /// All contacts, with the impulses of the last find().
    const std::vector<GroundContact<dim>> &contacts() const
    {
      return list;
    }

    /// Root of the integral of the square of what the ground has to stop, m/s m^((dim-1)/2). Collective.
    double flow() const;

    /// Finds the impulses that leave no more than `tolerance` of flow(), or twice as much where laws are obeyed, too.
    /// Collective.
    void find(const MixtureNodes<dim> &nodes, const TwoPhaseMomentum<dim> &step, const double tolerance);

    /// Takes the impulses from the nodes. Collective.
    void take(const MixtureNodes<dim> &nodes, const TwoPhaseMomentum<dim> &step, Budget<dim> &balance);

  private:
    /// Gives each contact in turn, or in the other direction, what its law wants.
    void sweep(const bool is_to);

    /// Changes the impulses of held motion until less than `tolerance` is left of it, if it is more than `bearable`;
    /// whether it was and could be changed. Collective.
    bool iterate(const double bearable, const double tolerance);

    /// Whether no more than `bearable` is between the impulses and what the contacts' laws want, after iterate().
    /// Collective.
    bool obeys_laws(const double bearable) const;

    /// Those of the contacts.
    const std::vector<Vector> &impulses();

    double sum(const double value) const;

    const BackgroundGrid<dim> &grid;
    DelassusOperator<dim> response;
    std::vector<GroundContact<dim>> list;
    std::vector<double> mobilities;                     // by contact, 1/kg, without walls
    std::vector<Vector> residual, velocities;           // by contact, m/s
    std::vector<Vector> of_contacts, scaled, direction; // by contact, N s: impulses; the residual over mobilities
  };
} // namespace scree

#endif

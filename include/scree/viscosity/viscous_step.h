// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_viscosity_viscous_step_h
#define scree_viscosity_viscous_step_h

#include <scree/contact/cut_cells/cut_cell_contact.h>
#include <scree/viscosity/viscous_force.h>

#include <list>
#include <optional>
#include <vector>

namespace scree
{
  /// Viscosity between predictor and pressure: (A + dt K) v = A v* for soil and water at the nodes, with masses, drag
  /// and walls in A (DragBlock) and the viscosity of the points in K (ViscousForce). While the step is below what K
  /// bears, A v = (A - dt K) v* serves; above it conjugate gradients with A^-1 as preconditioner, so that viscosity
  /// never limits the step. In both cases the impulses are dt K times a velocity, and add up to nothing. Ground that
  /// holds water (CutCellContact) takes part in the second case: what a long step spreads must be spread to it, too.
  template <int dim>
  class ViscousStep
  {
  public:
    /// Keeps references to all but the parameters.
    ViscousStep(const BackgroundGrid<dim> &grid,
                const WaterParameters &parameters,
                const std::list<WaterPhase<dim>> &water,
                dealii::TimerOutput &timer);

    /// Fits what lives on the nodes to the grid's current partition. Collective.
    void reinit();

    /// Changes the predicted velocities of `nodes`, whose ghosts hold values before and after; nothing without
    /// viscosity. Collective; throws if the solve does not converge.
    void apply(const MixtureNodes<dim> &nodes,
               const TwoPhaseMomentum<dim> &step,
               CutCellContact<dim> &bed,
               const double time_step,
               Budget<dim> &balance);

    /// Adds the energy that the impulses of apply() have taken to the balance, when the velocities of the step are
    /// known.
    void count_dissipation(const MixtureNodes<dim> &nodes, Budget<dim> &balance) const;

  private:
    using Vector = std::vector<SoilAndWater<dim>>; // an entry an owned node on which points act

    /// The impulses -dt K v of the water's velocity at the nodes into `impulses`. Collective.
    /// @param bed that takes part, or null
    /// @param ground_share see CutCellContact
    void find_impulses(const NodalField<dim> &velocity,
                       const CutCellContact<dim> *bed,
                       const double ground_share,
                       const double time_step);

    /// Sets the water's velocity in `motion`, ghosts too. Collective.
    void set_motion(const Vector &velocity);

    SoilAndWater<dim> impulses_at(const unsigned int node) const;

    /// Adds to the velocity, which is that of the predictor before. `impulses` are those of it, too. Returns the
    /// iterations.
    unsigned int solve(Vector &velocity, const CutCellContact<dim> *bed, const double time_step);

    /// Largest rate of all ranks, 1/s.
    double largest_rate() const;

    double product(const Vector &a, const Vector &b) const; // of all ranks

    const BackgroundGrid<dim> &grid;
    const std::list<WaterPhase<dim>> &water;
    const double water_viscosity; // Pa s
    dealii::TimerOutput &timer;
    const ViscousForce<dim> force;
    std::vector<unsigned int> active;        // owned nodes on which points act
    std::vector<DragBlock<dim>> pairs;       // A, of each of them
    std::optional<NodalField<dim>> motion;   // velocity that K is applied to
    std::optional<NodalField<dim>> impulses; // N s, where NodalField has forces; soil has none
  };
} // namespace scree

#endif

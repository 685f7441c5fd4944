// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_viscosity_viscous_step_h
#define scree_viscosity_viscous_step_h

#include <scree/contact/cut_cells/cut_cell_contact.h>
#include <scree/momentum/two_phase_momentum.h>
#include <scree/transfer/velocity_transfer.h>

namespace scree
{
  /// Viscous stress 2 mu dev(sym grad v) of velocities at the nodes, and its force on them, -K v = -sum V 2 mu dev(sym
  /// grad v) grad phi_i over the points: symmetric, and blind to motion of a rigid body, so that it changes neither
  /// momentum nor moment of momentum. The transfer between points and nodes does not matter.
  ///
  /// Water has its viscosity in the volume that it takes.
  template <int dim>
  class ViscousForce
  {
  public:
    /// Keeps a reference to the grid.
    /// @param viscosity of the water, Pa s
    ViscousForce(const BackgroundGrid<dim> &grid, const double viscosity)
        : grid(grid)
        , viscosity(viscosity)
    {
    }

    /// Adds the force of the points, of the velocity of `motion`, whose ghosts hold values, to that of `field`.
    void add(const WaterPhase<dim> &water, const NodalField<dim> &motion, NodalField<dim> &field) const;

    /// A bound on the rates, 1/s, at which viscosity slows any motion of nodes with lumped masses, for this rank's
    /// points: the largest eigenvalue of M^-1 K is at most max 2 mu V/m sum |grad phi_i|^2/phi_i, by the inequality of
    /// Cauchy and Schwarz for |sum grad phi_i v_i|^2.
    double largest_rate(const WaterPhase<dim> &water) const;

  private:
    const BackgroundGrid<dim> &grid;
    const double viscosity; // Pa s
  };

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
    void apply(WetNodes<dim> &nodes,
               TwoPhaseMomentum<dim> &step,
               CutCellContact<dim> &bed,
               const double time_step,
               Budget<dim> &balance);

    /// Adds the energy that the impulses of apply() have taken to the balance, when the velocities of the step are
    /// known.
    void count_dissipation(const WetNodes<dim> &nodes, Budget<dim> &balance) const;

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

    /// Of all ranks.
    double product(const Vector &a, const Vector &b) const
    {
      double sum = 0;
      for (unsigned int i = 0; i < a.size(); ++i)
        sum += a[i] * b[i];
      return dealii::Utilities::MPI::sum(sum, grid.communicator());
    }

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

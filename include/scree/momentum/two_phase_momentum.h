// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_momentum_two_phase_momentum_h
#define scree_momentum_two_phase_momentum_h

#include <scree/boundary/body_forces.h>
#include <scree/pressure/pore_pressure.h>
#include <scree/momentum/wall_friction.h>
#include <scree/boundary/wall_gaps.h>

namespace scree
{
  /// Soil and water at the nodes, tied by drag and stopped by walls: the predictor and the corrector of a step.
  template <int dim>
  class TwoPhaseMomentum
  {
  public:
    /// Keeps references to all but the density.
    /// @param water_density kg/m^3
    TwoPhaseMomentum(const BackgroundGrid<dim> &grid,
                     const Constraints<dim> &constraints,
                     const WallGaps<dim> &wall_gaps,
                     const BodyForces<dim> &forcing,
                     const double water_density,
                     dealii::TimerOutput &timer);

    /// Fits what lives on the nodes to the grid's current partition. Collective.
    void reinit();

    /// Before predict(): finds n_i, coupling and drag of the step at the pores, and
    /// the momentum of soil and water from those of the mixture and of the discharge.
    /// @param excess see WaterTransfer::to_grid(), summed over ranks as `nodes`
    void find_flux_inertia(const MixtureNodes<dim> &nodes, const NodalField<dim> &excess, const double time_step);

    /// Adds the force of the old pressure to the sums of soil and water, and finds what they count as where the
    /// pressure moves them (PoreField): at least a part of the water that would fill what B integrates over
    /// (closures::least_inertia).
    void add_pressure_forces(const MixtureNodes<dim> &nodes, PorePressure<dim> &pressure, const double time_step) const;

    /// The nodes as the pressure sees them, after predict().
    void find_pressed_nodes(const MixtureNodes<dim> &nodes, PorePressure<dim> &pressure) const;

    /// A v* = m v + dt f, where A holds masses and drag, and f the force of the old pressure. `nodes` hold the sums of
    /// all ranks before, and velocities and their change afterwards; the pores then hold drag times step, and the
    /// fraction of grains. Collective.
    /// @param kept part of the points' velocity that remains beside that of the nodes, see kept_velocity()
    void predict(const MixtureNodes<dim> &nodes, const double time_step, const double kept, Budget<dim> &balance);

    /// v = v** - dt A^-1 B^T dp with the change of `pressure`. Collective.
    void
    correct(const MixtureNodes<dim> &nodes, PorePressure<dim> &pressure, const double time_step, Budget<dim> &balance);

    /// Adds the work of suction and of the pressure at drained walls, after correct(): as any impulse, they act at the
    /// mean of the velocities before and after. Collective.
    void count_pressure_work(const MixtureNodes<dim> &nodes,
                             PorePressure<dim> &pressure,
                             const double time_step,
                             Budget<dim> &balance) const;

    /// Soil and water at an owned node, after predict().
    DragBlock<dim> drag_block_at(const MixtureNodes<dim> &nodes, const unsigned int node) const;

    /// Gives an owned node further impulses, N s, after predict(): drag and walls see them, too.
    void push(const MixtureNodes<dim> &nodes,
              const unsigned int node,
              const SoilAndWater<dim> &impulses,
              Budget<dim> &balance) const;

    /// Changes the velocities of an owned node, m/s, after predict(). A phase without mass follows the other.
    static void add(const MixtureNodes<dim> &nodes, const unsigned int node, SoilAndWater<dim> change);

  private:
    /// Soil and water at an owned node, as the pressure moves them.
    DragBlock<dim> pressed_block_at(const MixtureNodes<dim> &nodes, const unsigned int node) const;

    /// Of what holds soil and water at the node, m/s.
    SoilAndWater<dim> velocity_of_walls(const unsigned int node) const;

    /// Whether rigid soil stands at an owned node.
    bool is_rigid(const unsigned int node) const;

    /// Gives rigid soil a dummy mass, so that the drag block is defined; its velocity is prescribed.
    void assign_rigid_mass(const MixtureNodes<dim> &nodes, const unsigned int node) const;

    /// Momentum, forces and accelerations over the step, N s.
    SoilAndWater<dim> impulses_at(const MixtureNodes<dim> &nodes,
                                  const unsigned int node,
                                  const double time_step,
                                  Budget<dim> &balance) const;

    /// Adds what the walls of a node give to the balance.
    void count_walls(const unsigned int node, const SoilAndWater<dim> &impulses, Budget<dim> &balance) const;

    /// The predictor at a node, A v* = r: velocities from impulses; finds the contacts with walls and adds their
    /// friction to the impulses. The drag at the node's pores becomes that of the flow.
    SoilAndWater<dim> solve_node(const MixtureNodes<dim> &nodes,
                                 const unsigned int node,
                                 SoilAndWater<dim> &impulses,
                                 const SoilAndWater<dim> &before,
                                 Budget<dim> &balance);

    /// What walls give in the corrector: their reactions to `impulses`, and what friction on sliding soil changes by,
    /// which is added to `change`.
    void correct_at_walls(const unsigned int node,
                          const DragBlock<dim> &pair,
                          const SoilAndWater<dim> &impulses,
                          const SoilAndWater<dim> &before,
                          const dealii::Tensor<1, dim> &soil_predicted,
                          SoilAndWater<dim> &change,
                          Budget<dim> &balance) const;

    const Constraints<dim> &constraints;
    const WallGaps<dim> &wall_gaps;
    const BodyForces<dim> &forcing;
    const BackgroundGrid<dim> &grid;
    const double water_density;
    dealii::TimerOutput &timer;
    WallFriction<dim> friction;
  };
} // namespace scree

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_momentum_two_phase_momentum_h
#define scree_momentum_two_phase_momentum_h

#include <scree/boundary/body_forces.h>
#include <scree/pressure/operators.h>
#include <scree/step/step_report.h>
#include <scree/momentum/wall_friction.h>
#include <scree/boundary/wall_gaps.h>

namespace scree
{
  /// Soil and water at the nodes, tied by drag and stopped by walls: the predictor and the corrector of a step. A holds
  /// masses, drag and walls (DragBlock). In the order of the functions.
  template <int dim>
  class TwoPhaseMomentum
  {
  public:
    /// Keeps references to all but the density.
    /// @param water_density kg/m^3
    TwoPhaseMomentum(WetNodes<dim> &nodes,
                     const Constraints<dim> &constraints,
                     const WallGaps<dim> &wall_gaps,
                     const BodyForces<dim> &forcing,
                     const double water_density,
                     dealii::TimerOutput &timer);

    /// Fits the contacts with walls to the current nodes, of which `n_owned_nodes` are on this rank.
    void reinit(const unsigned int n_owned_nodes)
    {
      friction.reinit(n_owned_nodes);
    }

    /// Finds n_i, coupling and drag of the step from the nodes' sums over ranks, and the momentum of soil and water
    /// from those of the mixture and of the discharge.
    void find_flux_inertia(const double time_step);

    /// Adds the force of the old pressure to the sums of soil and water, and finds what they count as where the
    /// pressure moves them (Pores): at least a part of the water that would fill what B integrates over
    /// (closures::least_inertia).
    /// @param impulses of the pressure on u and q over the step, N s
    void add_pressure_forces(const FlowField<dim> &impulses,
                             const PressureOperators<dim> &operators,
                             const double time_step);

    /// A v* = m v + dt f, with the old pressure in f. The nodes hold velocities and their change afterwards, the pores
    /// C_i of the flow, kg. Collective.
    /// @param kept part of the points' velocity that remains beside that of the nodes, see kept_velocity()
    void predict(const double time_step, const double kept, Budget<dim> &balance);

    /// A at an owned node, after predict().
    DragBlock<dim> drag_block_at(const unsigned int node) const;

    /// The same as the pressure moves soil and water.
    DragBlock<dim> pressed_block_at(const unsigned int node) const;

    /// Gives an owned node further impulses, N s, after predict(): drag and walls see them, too.
    void push(const unsigned int node, const SoilAndWater<dim> &impulses, Budget<dim> &balance);

    /// v = v** - dt A^-1 (B^T dp + N^T t). Collective.
    /// @param of_flow impulses of the change of the pressure and of the ground on u and q, N s
    void correct(const FlowField<dim> &of_flow, Budget<dim> &balance);

    /// Adds the work of suction and of the pressure at drained walls, after the corrector: as any impulse, they act at
    /// the mean of the velocities before and after.
    /// @param of_flow their impulses on u and q, N s
    void count_pressure_work(const FlowField<dim> &of_flow, Budget<dim> &balance) const;

  private:
    /// Of what holds soil and water at the node, m/s.
    SoilAndWater<dim> velocity_of_walls(const unsigned int node) const;

    /// Whether rigid soil stands at an owned node.
    bool is_rigid(const unsigned int node) const;

    /// v^n, m/s, from momenta: water takes soil along by its coupling to the pores.
    SoilAndWater<dim> velocities_at_start(const unsigned int node, const double kept, Budget<dim> &balance) const;

    /// Momentum, forces and accelerations over the step, N s.
    SoilAndWater<dim> impulses_at(const unsigned int node, const double time_step, Budget<dim> &balance) const;

    /// Adds what the walls of a node give to the balance.
    void count_walls(const unsigned int node, const SoilAndWater<dim> &impulses, Budget<dim> &balance) const;

    /// The predictor at a node, A v* = r: velocities from impulses; finds the contacts with walls and their friction.
    /// The drag at the node's pores becomes that of the flow.
    SoilAndWater<dim> solve_node(const unsigned int node,
                                 SoilAndWater<dim> impulses,
                                 const SoilAndWater<dim> &before,
                                 Budget<dim> &balance);

    /// What walls give in the corrector: their reactions to `impulses`, and what friction on sliding soil changes by,
    /// which is added to `change`.
    void correct_at_walls(const unsigned int node,
                          const DragBlock<dim> &pair,
                          const SoilAndWater<dim> &impulses,
                          SoilAndWater<dim> &change,
                          Budget<dim> &balance) const;

    WetNodes<dim> &nodes;
    const Constraints<dim> &constraints;
    const WallGaps<dim> &wall_gaps;
    const BodyForces<dim> &forcing;
    const double water_density;
    dealii::TimerOutput &timer;
    WallFriction<dim> friction;
  };
} // namespace scree

#endif

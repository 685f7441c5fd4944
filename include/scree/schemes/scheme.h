// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_schemes_scheme_h
#define scree_schemes_scheme_h

#include <scree/bodies/phases.h>
#include <scree/boundary/inflow/inflow.h>
#include <scree/contact/contact_parameters.h>
#include <scree/contact/rigid_surface.h>
#include <scree/momentum/nodal_forces.h>
#include <scree/momentum/surface_load.h>
#include <scree/pressure/solver_state.h>
#include <scree/step/step_report.h>
#include <scree/transfer/transfer_parameters.h>
#include <scree/transfer/water_transfer.h>

namespace scree
{
  /// What a case has built, as the schemes see it. All that it refers to must outlive them.
  template <int dim>
  struct Model
  {
    const BackgroundGrid<dim> &grid;              ///< mesh and nodes of the velocity
    const BodyForces<dim> &forces;                ///< accelerations of the nodes
    const TransferParameters &transfer;           ///< entries of subsection Transfer
    const StabilisationParameters &stabilisation; ///< entries of subsection Stabilisation
    std::list<SoilBody<dim>> &bodies;             ///< bodies of soil
    std::list<SurfaceLoad<dim>> &loads;           ///< loads on the surface of the soil
    std::vector<RigidSurface<dim>> surfaces;      ///< the bed and the obstacles
    std::vector<Constraints<dim> *> constraints;  ///< of each group of bodies that stick to each other; with water one
    std::vector<ContactPair> contacts;            ///< of these groups

    std::list<WaterPhase<dim>> &water;             ///< empty in a dry scene
    const WaterParameters &water_parameters;       ///< entries of subsection Water
    const PressureParameters &pressure_parameters; ///< entries of subsection Pressure
    const BoundaryConditions<dim> *water_walls;    ///< null in a dry scene
    const std::list<Inflow<dim>> &inflows;         ///< inflows of soil and water
    const RigidBoundary<dim> *ground;              ///< bed and obstacles; null if there are none
    const CutCells<dim> *cut_cells;                ///< what this leaves of the cells; null: all
    unsigned int soil_points;                      ///< fewest of a body in a cell, along an axis
  };

  /// What a step is. to_grid(), solve() and to_points() are called in this order; then the points are sorted.
  template <int dim>
  class Scheme
  {
  public:
    virtual ~Scheme() = default;

    /// Fits all that lives on the nodes to the grid's current partition. Collective.
    virtual void reinit() = 0;

    /// Fits it to ground that has moved, on the mesh as it was. Collective.
    virtual void follow_ground()
    {
    }

    /// Empties the nodes but for what the points carry and pictures show before the first step. Collective.
    virtual void read_points() = 0;

    /// Sums over the points what the step that begins at `time`, s, needs. Collective.
    virtual void to_grid(const double time) = 0;

    /// Velocity of the nodes at the end of a step of `time_step` s. Collective.
    virtual void solve(const double time_step, StepReport<dim> &report) = 0;

    /// Carries what the nodes have found to the points and moves them; they are not sorted yet. Collective.
    /// @param damping_time of the skeleton, s, see SkeletonDamping
    virtual void to_points(const double time_step, const double damping_time, StepReport<dim> &report) = 0;

    /// All sets of points, in a fixed order.
    virtual std::vector<PointSet<dim> *> point_sets() = 0;

    /// The soil at the nodes, solved. Collective.
    virtual const NodalField<dim> &soil_field() = 0;

    /// What pictures show of the water; null in a dry scene.
    virtual std::unique_ptr<WaterView<dim>> water_view() const
    {
      return nullptr;
    }

    /// From the next step on, or no longer, the soil settles: water keeps place and pressure, walls do not absorb.
    virtual void settle(const bool)
    {
    }

    /// What the next step begins with beside the points. Collective.
    virtual SolverState<dim> solver_state() const
    {
      return {};
    }

    /// Sets what of it this rank has, after reinit(). Collective.
    virtual void set_solver_state(const SolverState<dim> &)
    {
    }

    /// Out-of-balance forces and weights of the nodes of this rank after a step of `time_step` s.
    virtual NodalForces nodal_forces(const double time_step) const = 0;
  };
} // namespace scree

#endif

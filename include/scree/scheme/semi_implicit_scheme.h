// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_scheme_semi_implicit_scheme_h
#define scree_scheme_semi_implicit_scheme_h

#include <scree/grid/boundary_conditions.h>
#include <scree/scheme/drag_pair.h>
#include <scree/scheme/forcing.h>
#include <scree/scheme/mixture_divergence.h>
#include <scree/scheme/pressure_solver.h>
#include <scree/scheme/step_balance.h>
#include <scree/scheme/wall_friction.h>

#include <deal.II/base/timer.h>

#include <list>

namespace scree
{
  /// The step of soil and water at the nodes: explicit soil, implicit drag, and pressure by an incremental fractional
  /// step (Kularathna et al. 2021; Yuan et al. 2023; two sets of points: Xie, Navas & Lopez-Querol 2024).
  ///
  /// 1. Predictor with the old pressure: A v* = m v + dt (f - G p^n), where A holds masses and drag.
  /// 2. Pressure: L dp = -div[(1-n) v_s* + n v_w*], with the drag in L.
  /// 3. Corrector: v = v* - dt A^-1 G dp.
  template <int dim>
  class SemiImplicitScheme
  {
  public:
    SemiImplicitScheme(const BackgroundGrid<dim> &grid,
                       const BoundaryConditions<dim> &walls,
                       const WaterBoundaryConditions<dim> &water_walls,
                       const Forcing<dim> &forcing,
                       const TransferParameters &transfer,
                       const WaterParameters &water,
                       const PressureParameters &pressure);

    /// Fits all fields to the grid's current partition. Collective.
    void reinit();

    /// Sums over the points what the step needs beside the soil's own field, on this rank.
    void gather(const std::list<SoilBody<dim>> &soil, const std::list<WaterPhase<dim>> &water);

    /// One step of `time_step` s. `soil` holds this rank's mass, momentum and force before, and all ranks' velocity and
    /// its change afterwards, ghosts included. Collective.
    /// @param shear_modulus of the soil, Pa: scales the pressure projection
    StepBalance<dim>
    solve(NodalField<dim> &soil, const double time_step, const double shear_modulus, dealii::TimerOutput &timer);

    /// Carries velocity and pressure to the water's points and moves them. Returns their largest speed, m/s.
    double to_points(WaterPhase<dim> &water, const double time_step);

    /// Moves points of free water from where they crowd to where they are few: positions only, by a tenth of a cell at
    /// most. Does nothing without entry Volume correction. Collective.
    void correct_volume(WaterPhase<dim> &water, const double time_step, StepBalance<dim> &balance);

    /// Takes the stress from soil that is looser than entry Fluidisation porosity.
    void fluidise(SoilBody<dim> &soil) const;

    /// Largest step of the water's explicit part, its viscous stress, s; infinite without.
    double largest_step() const;

    const NodalField<dim> &water_field() const
    {
      return water_nodes;
    }

    /// Pressure at the corners of a cell with points, Pa, in deal.II's order.
    std::array<double, (1 << dim)> corner_pressure(const unsigned int cell) const;

    /// Sets the pressure from the water's points, for the output before the first step. Collective.
    void read_pressure(const std::list<SoilBody<dim>> &soil, const std::list<WaterPhase<dim>> &water);

  private:
    void complete_pores();
    void find_pressure();
    void set_mobilities(const double time_step);
    void add_pressure_forces(NodalField<dim> &soil);
    StepBalance<dim> predict(NodalField<dim> &soil, const double time_step);
    void solve_pressure(NodalField<dim> &soil,
                        const double time_step,
                        const double shear_modulus,
                        dealii::TimerOutput &timer,
                        StepBalance<dim> &balance);
    void correct(NodalField<dim> &soil, const double time_step, StepBalance<dim> &balance);

    DragPair<dim> pair_at(const unsigned int node, const NodalField<dim> &soil) const;

    /// Adds a solve to the counts of the run.
    void count(const SolveReport &report, StepBalance<dim> &balance) const;

    static NodeNumbering<dim> numbered(const BackgroundGrid<dim> &grid);
    void reinit_vectors();
    std::array<double, (1 << dim)> at_corners(const CornerVector &values, const unsigned int cell) const;

    const BackgroundGrid<dim> &grid;
    const BoundaryConditions<dim> &walls;
    const WaterBoundaryConditions<dim> &water_walls;
    const Forcing<dim> &forcing;
    WallFriction<dim> friction;
    const Splitting splitting;
    const PreviousPressure previous_pressure;
    const double projection, water_density, bulk_modulus, volume_correction, fluidisation_porosity, viscosity;

    NodeNumbering<dim> corners;
    WaterTransfer<dim> transfer;
    Mixture<dim> mixture;
    PoreField<dim> pores;
    NodalField<dim> water_nodes;
    NodeValues<dim, 2 * dim> correction; // pressure forces of the change of pressure on soil and water, N
    FreeSurfaceLocator<dim> surface;
    MixtureDivergence<dim> divergence;
    PressureSolver<dim> solver;
    CornerVector pressure, kept_pressure, change, source, crowding;

    bool has_grid_pressure = false; // of the last step, in the current partition
  };
} // namespace scree

#endif

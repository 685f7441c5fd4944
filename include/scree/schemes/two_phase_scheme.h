// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_schemes_two_phase_scheme_h
#define scree_schemes_two_phase_scheme_h

#include <scree/contact/cut_cells/cut_cell_contact.h>
#include <scree/boundary/inflow/inflow.h>
#include <scree/momentum/two_phase_momentum.h>
#include <scree/schemes/scheme.h>
#include <scree/momentum/solid_phase.h>
#include <scree/viscosity/viscous_step.h>
#include <scree/momentum/particle_shifting.h>
#include <scree/transfer/water_transfer.h>

namespace scree
{
  /// Soil and water: explicit soil, implicit drag, and pressure by an incremental fractional step (Kularathna et al.
  /// 2021; Yuan et al. 2023; two sets of points: Xie, Navas & Lopez-Querol 2024).
  ///
  /// 1. Predictor with the old pressure: A v* = m v + dt (f - G p^n), where A holds masses and drag (TwoPhaseMomentum).
  ///    Then the viscosity, if there is any: (A + dt K) v** = A v* (ViscousStep).
  /// 2. Pressure: L dp = -div[(1-n) v_s* + n v_w*], with the drag in L (PorePressure).
  /// 3. Corrector: v = v* - dt A^-1 G dp (TwoPhaseMomentum).
  ///    Soil is stopped at the ground after the predictor, soil and water after the corrector (CutCellContact), if
  ///    there is a bed.
  /// 4. Points of free water leave where they crowd (ParticleShifting), if the case asks for it.
  template <int dim>
  class TwoPhaseScheme : public Scheme<dim>
  {
  public:
    /// @param soil_points see Mixture
    /// @param cut_cells what the bed leaves of the cells, may be null, as `bed`
    /// @param inflows of water are looked at
    TwoPhaseScheme(const BackgroundGrid<dim> &grid,
                   Constraints<dim> &constraints,
                   const WaterBoundaryConditions<dim> &water_walls,
                   const BodyForces<dim> &forcing,
                   const TransferParameters &transfer,
                   const StabilisationParameters &stabilisation,
                   const WaterParameters &water_parameters,
                   const PressureParameters &pressure_parameters,
                   std::list<SoilBody<dim>> &bodies,
                   const unsigned int soil_points,
                   std::list<WaterPhase<dim>> &water,
                   std::list<SurfaceLoad<dim>> &loads,
                   const CutCells<dim> *cut_cells,
                   std::unique_ptr<CutCellContact<dim>> bed,
                   const std::list<Inflow<dim>> &inflows,
                   dealii::TimerOutput &timer);

    void reinit() override;
    void follow_ground() override;
    void read_points() override;
    void to_grid(const double time) override;
    void solve(const double time_step, StepReport<dim> &report) override;
    void to_points(const double time_step, StepReport<dim> &report) override;
    std::vector<PointSet<dim> *> point_sets() override;
    const NodalField<dim> &soil_field() override;
    std::unique_ptr<WaterView<dim>> water_view() const override;

  private:
    /// Sums of the water's points and of the soil's pores.
    void gather();

    /// Grains in water, at the nodes; makes all fields active where any is.
    void complete_pores();

    /// The force of the old pressure on soil and water.
    void add_pressure_forces();

    /// Takes the stress from soil that is looser than entry Fluidisation porosity.
    void fluidise();

    const BackgroundGrid<dim> &grid;
    const BodyForces<dim> &forcing;
    const double water_density, fluidisation_porosity;
    double shear_modulus = 0; // largest of the bodies, Pa
    std::list<WaterPhase<dim>> &water;
    const bool limits_volumetric_strain;                            // that soil loses where a solve leaves it closing
    const std::uint8_t faces_closed_to_soil, faces_closed_to_water; // of the box
    const std::list<Inflow<dim>> &inflows;
    dealii::TimerOutput &timer;

    SolidPhase<dim> soil;
    WaterTransfer<dim> transfer;
    Mixture<dim> mixture;
    PoreField<dim> pores;
    NodalField<dim> water_field;
    PorePressure<dim> pressure;
    WallGaps<dim> wall_gaps;
    const double spacing; // of the points at the start, where they are widest apart, m
    TwoPhaseMomentum<dim> step;
    std::unique_ptr<ViscousStep<dim>> viscosity;              // null if there is none
    std::unique_ptr<CutCellContact<dim>> bed;                 // null if there is none
    std::unique_ptr<ParticleShifting<dim>> volume_correction; // null if the case does not ask for it
  };
} // namespace scree

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_transfer_water_transfer_h
#define scree_transfer_water_transfer_h

#include <scree/bodies/drag_law.h>
#include <scree/bodies/water_phase.h>
#include <scree/mixture/mixture.h>
#include <scree/transfer/transfer.h>

#include <algorithm>
#include <optional>

namespace scree
{
  /// Pores at the nodes of the velocity: sums at first, then what the step makes of them.
  template <int dim>
  class PoreField : public NodeValues<dim, 6>
  {
  public:
    static constexpr unsigned int drag           = 0; ///< of slow flow over q, N s/m; then C of the step, kg
    static constexpr unsigned int inertial_drag  = 1; ///< the same over q^2, N s^2/m^2; then over the slip, kg s/m
    static constexpr unsigned int grain_volume   = 2; ///< sum S V_grains phi_i, m^3
    static constexpr unsigned int grain_fraction = 2; ///< then: volume of grains over that of grains and water

    /// sum V_w (1/n_p - 1) phi_i, n_p the porosity about a point of water, m^3
    static constexpr unsigned int local_solid_volume = 3;

    static constexpr unsigned int wet_pores  = 4; ///< sum S n V phi_i of the soil in cells with water, m^3
    static constexpr unsigned int soil_share = 4; ///< then: soil_share(), -

    static constexpr unsigned int flux_inertia = 5; ///< sum V_w (1/n_p^2 - 1) phi_i, m^3
    /// Then: inertia that water has beside its mass, as it passes through pores of different width; of that of the slip
    /// between soil and water, sum m_p phi_i (n_i/n_p)^2 - m_i with n_i the harmonic mean of n_p, kg.
    static constexpr unsigned int coupling = 5;

    /// Makes room on the nodes of the grid, which must live on.
    explicit PoreField(const BackgroundGrid<dim> &grid)
        : NodeValues<dim, 6>(grid.numbering())
    {
    }
  };

  /// Share of the soil's velocity in that of the grains that water passes at a node (PoreVelocity), -: 1, but where the
  /// node has less than a quarter of the grains that are about its water, more than crowded water explains. Points that
  /// have just entered a cell tell the water of their part of it, and not the nodes beyond; there a stress moves soil
  /// of next to no mass at any speed.
  ///
  /// @param grains of the node, as PoreField has them, m^3
  inline double soil_share(const double grains, const double local_solid_volume)
  {
    return local_solid_volume > 0. ? std::min(1., 4. * grains / local_solid_volume) : 1.;
  }

  /// Soil, water and pores at the nodes of the velocity, of one step.
  template <int dim>
  struct MixtureNodes
  {
    NodalField<dim> &soil, ///< mass, momentum and force of the soil, then its velocity
        &water;            ///< mass, momentum and force of the water, then its velocity
    PoreField<dim> &pores; ///< drag, grains and pores

    /// Ghosts get the velocities that their owners have. Collective.
    void update_velocity_ghosts() const
    {
      soil.update_ghosts();
      water.update_ghosts();
    }
  };

  /// The pressure in a cell, Pa, and the part of it that the next step does not start from.
  template <int dim>
  struct CellPressure
  {
    Multilinear<dim> value;                    ///< Pa
    std::optional<Multilinear<dim>> forgotten; ///< none: nothing
  };

  /// Carries what water and pores need from points to cells and nodes, and velocity and pressure back to the water.
  template <int dim>
  class WaterTransfer
  {
  public:
    /// @param pressure_slope 1: the points' pressure travels with its gradient, 0: without
    /// @param by_flux whether the discharge q = n (v_w - v_s) is the unknown beside v_s, or v_w
    WaterTransfer(const BackgroundGrid<dim> &grid,
                  const TransferParameters &transfer,
                  const WaterParameters &water,
                  const double pressure_slope,
                  const bool by_flux = false);

    /// Density of the water at the nodes, kg/m^3.
    double water_density() const
    {
      return density;
    }

    /// Part of the points' velocity that remains over a step beside that of the nodes, see kept_velocity().
    double kept(const double time_step) const;

    /// Adds pores, drag and grains of a body's points to the mixture.
    void soil_to_grid(const SoilBody<dim> &soil, Mixture<dim> &mixture) const;

    /// Adds mass and momentum of the water's points to `field`, volume and pressure to the mixture, and
    /// the pores about its points to `pores`. All soil has to be in.
    /// @param excess gets m (1/n_p - 1) in place of the mass m, and its momentum: what the discharge has in pores
    void to_grid(const WaterPhase<dim> &water,
                 Mixture<dim> &mixture,
                 NodalField<dim> &field,
                 NodalField<dim> &excess,
                 PoreField<dim> &pores) const;

    /// One pass over the water's points at the end of a step: velocity, pressure with its gradient and what the next
    /// step forgets of it, and place, if they are the water's own; else the volume of the pores. Points of the water's
    /// own take the velocity of PoreVelocity. Returns the largest speed, m/s; not a number if any point's is not.
    ///
    /// @param nodes velocities of both phases; masses and pores as to_grid() has left them, summed over ranks
    /// @param mixture as to_grid() has left it
    double to_points(WaterPhase<dim> &water,
                     const MixtureNodes<dim> &nodes,
                     const Mixture<dim> &mixture,
                     const PressureOfCell<dim> &pressure,
                     const ForgottenOfCell<dim> &forgotten,
                     const double time_step) const;

  private:
    template <int n>
    void add_soil(const SoilBody<dim> &soil, Mixture<dim> &mixture) const;

    template <int n, TransferMethod method>
    void add_water(const WaterPhase<dim> &water,
                   Mixture<dim> &mixture,
                   NodalField<dim> &field,
                   NodalField<dim> &excess,
                   PoreField<dim> &pores) const;

    template <int n, TransferMethod method>
    double move_water(WaterPhase<dim> &water,
                      const MixtureNodes<dim> &nodes,
                      const Mixture<dim> &mixture,
                      const PressureOfCell<dim> &pressure,
                      const ForgottenOfCell<dim> &forgotten,
                      const double time_step) const;

    /// Velocity, pressure and, if the points are the water's own, place of a cell's points.
    ///
    /// @param porosity about the cell's points; may be null
    /// @param keep see kept_velocity()
    template <int n, TransferMethod method>
    void move_cell(const WaterPhase<dim> &water,
                   const CellPoints<dim> &cell,
                   const MixtureNodes<dim> &nodes,
                   const PorosityOfParts<dim> *porosity,
                   const CellPressure<dim> &pressure,
                   const double time_step,
                   const double keep,
                   LargestSquare &largest) const;

    const BackgroundGrid<dim> &grid;
    const TransferMethod method;
    const double pic_rate;
    const double pressure_slope;
    const PointSets point_sets;
    const double density; // of the water at the nodes, kg/m^3
    const bool by_flux;
  };
} // namespace scree

#endif

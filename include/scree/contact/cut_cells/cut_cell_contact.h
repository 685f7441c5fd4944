// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_contact_cut_cells_cut_cell_contact_h
#define scree_contact_cut_cells_cut_cell_contact_h

#include <scree/boundary/ground_gaps.h>
#include <scree/contact/cut_cells/traction_solver.h>
#include <scree/contact/rigid_surface.h>
#include <scree/pressure/pore_pressure.h>

#include <list>
#include <vector>

namespace scree
{
  /// Points that meet the ground, and where their quantities lie.
  template <int dim>
  struct MovingPoints
  {
    /// Takes the slots of a layout.
    /// @param layout of soil or water
    /// @param has_affine_energy see TransferParameters
    template <typename Layout>
    MovingPoints(PointSet<dim> &points, const Layout &layout, const bool has_affine_energy, const Phase phase)
        : points(points)
        , velocity(layout.velocity)
        , mass(layout.mass)
        , affine(layout.affine)
        , has_affine_energy(has_affine_energy)
        , phase(phase)
    {
    }

    PointSet<dim> &points;        ///< moved where they are below ground
    const unsigned int velocity,  ///< slot
        mass,                     ///< slot
        affine;                   ///< first slot, if it is there
    const bool has_affine_energy; ///< whether the affine field is there and counts
    const Phase phase;            ///< water has no friction
  };

  /// Rigid ground, the bed and obstacles: takes from soil and water at the nodes what would carry them through it.
  ///
  /// The ground in a cell is a segment for each of its parts; a field's velocity there is its mean over the segment,
  /// beside the segment's own. Soil gets a row each (GroundRows), and so does water in cells without an unknown
  /// pressure; elsewhere the pressure stops the water. PorePressure finds the tractions together with the pressure,
  /// TractionSolver those on soil without water. Soil that is not fixed may lift off, and rubs by Coulomb's law; water
  /// may leave where it has no pressure. It slips along the ground, but where that holds free water.
  template <int dim>
  class CutCellContact
  {
  public:
    /// @param ground all surfaces; null: there is no contact, and all calls return at once
    /// @param surfaces what it consists of, in the order of its parts
    /// @param cut_cells of the ground, null without it
    /// @param gaps between the ground and particles
    CutCellContact(const BackgroundGrid<dim> &grid,
                   const RigidBoundary<dim> *ground,
                   const std::vector<RigidSurface<dim>> &surfaces,
                   const CutCells<dim> *cut_cells,
                   const GroundGaps<dim> &gaps,
                   dealii::TimerOutput &timer);

    /// Fits the facets to the grid's current partition, after the cells have been looked at. Collective.
    void reinit();

    /// Fits it to the ground, after the cells have followed that.
    void follow();

    /// Whether any of the surfaces holds free water.
    bool no_slip() const
    {
      return any_no_slip;
    }

    /// Begins a step, once it is known which cells have water and unknown pressures: nothing is given yet.
    void begin_step(const Mixture<dim> &mixture, const FreeSurface<dim> &surface);

    /// Adds to the force, N, on water at the nodes what the ground that holds water gives to their `motion` in a
    /// viscous solve: -C (u - u_ground) for the mean velocity u over a segment, with C such that water slips as if the
    /// ground were a hundredth of a cell farther away. Across the ground, too: what a long step spreads must not go
    /// through it.
    /// @param motion velocities, m/s, whose ghosts hold values
    /// @param ground_share 1; 0 if they are changes of velocities
    /// @param viscosity of the water, Pa s
    void add_viscous_force(const NodalField<dim> &motion,
                           const double ground_share,
                           const double viscosity,
                           NodalField<dim> &force) const;

    /// Takes down what add_viscous_force() gives in a step of `time_step` s.
    void take_viscous_force(const NodalField<dim> &motion, const double viscosity, const double time_step);

    /// Finds the rows of a step, with the tractions of the last one, from predicted velocities, whose ghosts hold
    /// values; null without ground.
    GroundRows<dim> *find_rows(const WetNodes<dim> &nodes,
                               const Mixture<dim> &mixture,
                               const FreeSurface<dim> &surface,
                               const double time_step);

    /// Finds the rows of a step without water, at segments that soil covers.
    /// @param group of the bodies whose nodes `field` has; solved without ground, and ghosts hold values
    /// @param mass_scaling of the nodes
    GroundRows<dim> &find_rows(const std::list<SoilBody<dim>> &bodies,
                               const unsigned int group,
                               const NodalField<dim> &field,
                               const double mass_scaling,
                               const double time_step);

    /// Books their tractions over the step, as `solver` has found them.
    void count_rows(const TractionSolver<dim> &solver, const double time_step, Budget<dim> &balance);

    /// Books the tractions of the rows over a step, once the nodes have moved; ghosts of `nodes` hold values.
    void count_rows(const WetNodes<dim> &nodes, const double time_step, Budget<dim> &balance);

    /// Adds what obstacles bear of the water's pressure in a step of `time_step` s.
    void count_pressure(const Mixture<dim> &mixture,
                        const PorePressure<dim> &pressure,
                        const double time_step,
                        Budget<dim> &balance) const;

    /// Takes points that have come below the ground in a step of `time_step` s back to it. What the rows of the nodes
    /// have left of their velocity into the ground goes to it, soil with its friction, and so does the slope of their
    /// affine field along the normal: a grain on the ground by itself, whose nodes are light, would else fall at its
    /// place. Returns what that has changed of the points' momentum and energy.
    /// @param mass_scaling see BodyForces
    /// @param largest_speed of the points of this rank, m/s
    /// @param closed_faces of the box, to the points: none is put through them
    MotionSums<dim> project_to_boundary(const MovingPoints<dim> &moving,
                                        const double mass_scaling,
                                        const double time_step,
                                        const double largest_speed,
                                        const std::uint8_t closed_faces,
                                        Budget<dim> &balance) const;

    /// Tractions of the last step at the facets of all ranks, with the places of their cells. Collective.
    std::vector<FacetTractions<dim>> tractions() const;

    /// Sets those of this rank's facets from them.
    void set_tractions(const std::vector<FacetTractions<dim>> &all);

  private:
    /// Of a segment.
    struct OfSegment
    {
      dealii::Tensor<1, dim> normal;  // unit, of the surface at its middle, out of the open
      dealii::Tensor<1, dim> viscous; // N s, out of the open, of add_viscous_force() in this step
      FacetTractions<dim> tractions;  // of the last solve, with which the next one begins
    };

    void make_segments();

    /// Books a force that soil or water has given to a segment, and its work; what of that is momentum, N s.
    /// @param force N s, over the weights of the nodes
    /// @param of_momentum sum of the weights that count as momentum
    /// @param velocity sum of the weights times the velocities with which the force does work
    dealii::Tensor<1, dim> count(const unsigned int segment,
                                 const dealii::Tensor<1, dim> &force,
                                 const double of_momentum,
                                 const dealii::Tensor<1, dim> &velocity,
                                 Budget<dim> &balance) const;

    /// Calls `act(segment)` for the segments in a cell.
    template <typename Function>
    void for_segments(const unsigned int cell, const Function &act) const
    {
      if (const CutCell<dim> *cut = cut_cells->find(cell))
        for (unsigned int s = cut->first_segment; s < cut->first_segment + cut->n_segments; ++s)
          act(s);
    }

    void add_row(const unsigned int segment,
                 const Phase phase,
                 const bool is_unilateral,
                 const double mass_of_cell,
                 const WetNodes<dim> &nodes,
                 const double time_step);

    /// A row of a segment, with the traction of the last solve.
    GroundRow<dim> row_of(const unsigned int segment, const Phase phase) const;

    /// The velocity, m/s, that a row admits; sets whether it holds.
    /// @param velocity of the phase at the segment, m/s
    dealii::Tensor<1, dim>
    admissible_velocity(GroundRow<dim> &row, const dealii::Tensor<1, dim> &velocity, const double time_step) const;

    /// The force of add_viscous_force() at a segment, N.
    dealii::Tensor<1, dim> viscous_force(const unsigned int segment,
                                         const NodalField<dim> &motion,
                                         const double ground_share,
                                         const double viscosity) const;

    /// The mean velocity over a segment, m/s.
    dealii::Tensor<1, dim> mean_velocity(const CutFacet<dim> &segment, const NodalField<dim> &field) const;

    /// The surface that a segment belongs to.
    const RigidSurface<dim> &surface_of(const unsigned int segment) const
    {
      return surfaces[cut_cells->segments()[segment].part];
    }

    /// Whether soil keeps to a segment and neither slips nor lifts off.
    bool is_fixed(const unsigned int segment) const
    {
      return std::isinf(surface_of(segment).friction_coefficient);
    }

    /// What a part of the ground did, if it is an obstacle; else null.
    ObstacleBalance<dim> *balance_of(const unsigned int part, Budget<dim> &balance) const;

    /// Books an impulse of a part on soil or water, N s, at a place, and the energy that these have lost by it, J.
    void book(const unsigned int part,
              const dealii::Point<dim> &place,
              const dealii::Tensor<1, dim> &impulse,
              const double lost,
              Budget<dim> &balance) const;

    const BackgroundGrid<dim> &grid;
    const RigidBoundary<dim> *ground; // may be null
    const std::vector<RigidSurface<dim>> surfaces;
    const unsigned int n_obstacles; // the last of the surfaces
    const CutCells<dim> *cut_cells;
    const GroundGaps<dim> &gaps;
    GroundRows<dim> rows;
    dealii::TimerOutput &timer;
    const bool any_no_slip;
    std::vector<unsigned int> holding;  // segments along which water does not slip in this step, ascending
    std::vector<OfSegment> of_segments; // by segment
    std::vector<char> is_covered;       // the same: whether soil without water is in its cell
  };
} // namespace scree

#endif

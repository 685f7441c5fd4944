// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_contact_cut_cells_cut_cell_contact_h
#define scree_contact_cut_cells_cut_cell_contact_h

#include <scree/boundary/ground_gaps.h>
#include <scree/contact/points/point_contact.h>
#include <scree/contact/cut_cells/contact_solver.h>

#include <cmath>
#include <optional>
#include <vector>

namespace scree
{
  /// Rigid ground, the bed and obstacles, in scenes with water: takes from soil and water at the nodes what would carry
  /// them through it.
  ///
  /// The ground in a cell is one segment, and one of each part that moves; a field's velocity there is its mean over
  /// the segment, beside the segment's own. Impulses on soil and water there, shared out by the means of the shape
  /// functions, stop it: N A^-1 N^T l = N v, v -= A^-1 N^T l, with masses, drag and walls in A, by conjugate gradients.
  /// Predicted soil is stopped by itself, so that the pressure sees how it moves, while the pressure stops the water;
  /// soil and water are stopped after the corrector. Soil that is not fixed may lift off, and rubs by Coulomb's law;
  /// water may leave where it has no pressure. It slips along the ground, but where that holds free water.
  template <int dim>
  class CutCellContact
  {
  public:
    /// @param ground all surfaces; null: there is no contact, and all calls return at once
    /// @param surfaces what it consists of
    /// @param cut_cells of the ground, null without it
    /// @param gaps between the ground and particles
    /// @param relative_tolerance of the velocities through the ground
    CutCellContact(const BackgroundGrid<dim> &grid,
                   const RigidBoundary<dim> *ground,
                   const std::vector<RigidSurface<dim>> &surfaces,
                   const CutCells<dim> *cut_cells,
                   const GroundGaps<dim> &gaps,
                   const double relative_tolerance,
                   dealii::TimerOutput &timer);

    /// Fits the nodes to the grid's current partition, after the cells have been looked at. Collective.
    void reinit();

    /// Fits it to the ground, after the cells have followed that.
    void follow();

    /// Whether any of the surfaces holds free water.
    bool no_slip() const
    {
      return any_holds_water;
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

    /// Stops predicted soil. Ghosts of `nodes` hold values before and after. Collective.
    void predict(const MixtureNodes<dim> &nodes,
                 const Mixture<dim> &mixture,
                 const TwoPhaseMomentum<dim> &step,
                 const double time_step,
                 Budget<dim> &balance);

    /// Stops soil and water after the corrector, as predict().
    void correct(const MixtureNodes<dim> &nodes,
                 const Mixture<dim> &mixture,
                 const TwoPhaseMomentum<dim> &step,
                 const FreeSurface<dim> &surface,
                 const double time_step,
                 Budget<dim> &balance);

    /// Adds what obstacles bear of the water's pressure in a step of `time_step` s.
    void count_pressure(const Mixture<dim> &mixture,
                        const PorePressure<dim> &pressure,
                        const double time_step,
                        Budget<dim> &balance) const;

    /// Takes points that have come below the ground back to it. None has moved farther than `farthest`, m.
    /// @param closed_faces of the box, to the points: none is put through them
    void project_to_boundary(PointSet<dim> &points, const double farthest, const std::uint8_t closed_faces) const;

  private:
    /// What a segment knows.
    struct OfSegment
    {
      dealii::Tensor<1, dim> soil, water; // N s, out of the open: what it has given to a phase in this step
      // What it gave in the last one, N: the searches begin with it.
      dealii::Tensor<1, dim> predicted_soil, corrected_soil, corrected_water;
    };

    /// Adds the step's impulses and their work; ghosts of `nodes` hold values.
    void count(const MixtureNodes<dim> &nodes, Budget<dim> &balance) const;

    /// Calls `act(segment)` for the segments in a cell.
    template <typename Function>
    void for_segments(const unsigned int cell, const Function &act) const
    {
      if (const CutCell<dim> *cut = cut_cells->find(cell))
        for (unsigned int s = cut->first_segment; s < cut->first_segment + cut->n_segments; ++s)
          act(s);
    }

    /// @param base what the ground has taken in this step already, N s
    /// @param first impulse with which the search begins, N s
    void add_contact(const unsigned int segment,
                     const Phase phase,
                     const bool is_unilateral,
                     const MixtureNodes<dim> &nodes,
                     const double time_step,
                     const dealii::Tensor<1, dim> &base,
                     const dealii::Tensor<1, dim> &first);

    /// The force of add_viscous_force() at a segment, N.
    dealii::Tensor<1, dim> viscous_force(const unsigned int segment,
                                         const NodalField<dim> &motion,
                                         const double ground_share,
                                         const double viscosity) const;

    /// Finds the impulses of the contacts and takes them from the nodes. Collective.
    /// @param wanted flow through the ground that may be left, over the largest of the step
    void project(const MixtureNodes<dim> &nodes,
                 const TwoPhaseMomentum<dim> &step,
                 const double wanted,
                 Budget<dim> &balance);

    /// The mean velocity over a segment, m/s.
    dealii::Tensor<1, dim> mean_velocity(const CutFacet<dim> &segment, const NodalField<dim> &field) const;

    /// The surface that a segment belongs to.
    const RigidSurface<dim> &surface_of(const unsigned int segment) const
    {
      return surfaces[surface_numbers[segment]];
    }

    /// Whether soil keeps to a segment and neither slips nor lifts off.
    bool is_fixed(const unsigned int segment) const
    {
      return std::isinf(surface_of(segment).friction_coefficient);
    }

    /// What a segment's surface did, if it is an obstacle; else null.
    ObstacleBalance<dim> *balance_of(const unsigned int segment, Budget<dim> &balance) const;

    /// Finds the segments' surfaces.
    void find_surfaces();

    /// The surface that a segment is of.
    unsigned int find_surface(const CutFacet<dim> &segment) const;

    const BackgroundGrid<dim> &grid;
    const RigidBoundary<dim> *ground; // may be null
    const std::vector<RigidSurface<dim>> surfaces;
    const unsigned int n_obstacles; // the last of the surfaces
    const CutCells<dim> *cut_cells;
    const GroundGaps<dim> &gaps;
    const double relative_tolerance;
    std::optional<ContactSolver<dim>> contacts; // nothing without ground
    dealii::TimerOutput &timer;
    const bool any_holds_water;
    std::vector<unsigned int> holding;         // segments along which water does not slip in this step, ascending
    std::vector<OfSegment> of_segments;        // by segment
    std::vector<unsigned int> surface_numbers; // the same
    double largest_flow = 0;                   // of the step, m/s m^((dim-1)/2)
  };
} // namespace scree

#endif

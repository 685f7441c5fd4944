// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_transfer_transfer_h
#define scree_transfer_transfer_h

#include <scree/mesh/nodal_field.h>
#include <scree/bodies/soil_body.h>
#include <scree/particles/batch_pointers.h>
#include <scree/transfer/f_bar.h>
#include <scree/mixture/mixture.h>
#include <scree/transfer/transfer_parameters.h>

#include <vector>

namespace scree
{
  /// What a pass from the grid to the points found out; cells add up.
  struct MotionReport
  {
    double largest_speed = 0; ///< m/s; not a number if any point's is not
    UpdateReport material;    ///< what the stress updates reported
  };

  /// Carries mass, momentum and force from points to nodes, and velocity back.
  template <int dim>
  class Transfer
  {
  public:
    /// Keeps a reference to the grid; copies the entries.
    Transfer(const BackgroundGrid<dim> &grid,
             const TransferParameters &transfer,
             const StabilisationParameters &stabilisation);

    /// Activates the nodes of the body's cells and adds mass, momentum and internal force of this rank's points:
    /// lumped mass sum m phi_i, momentum sum m phi_i (v + C (x_i - x)) with C = 0 for FLIP and PIC, force -sum V sigma
    /// grad phi_i.
    void to_grid(const SoilBody<dim> &body, NodalField<dim> &field) const;

    /// Velocity of the points at the end of a step, from the nodes; adds the points' mass and momentum to `projected`,
    /// whose nodes get active. For FLIP and PIC. Returns the largest speed, m/s; not a number if any point's is not.
    double update_velocities(SoilBody<dim> &body,
                             const NodalField<dim> &field,
                             const double time_step,
                             NodalField<dim> &projected);

    /// One pass over the cells: velocity, position, volume, F-bar, stress and state of the points at the end of a step
    /// of `time_step` s, from the nodes' end-of-step velocity and its change. The points are not sorted yet.
    ///
    /// @param projected the points' own velocity at the nodes, of which their strain is then, after
    /// update_velocities(); null: the strain is that of the nodes' end-of-step velocity
    /// @param mixture whose cells know factors of the soil's volume; null: none do
    MotionReport to_points(SoilBody<dim> &body,
                           const NodalField<dim> &field,
                           const NodalField<dim> *projected,
                           const double time_step,
                           const Mixture<dim> *mixture = nullptr);

  private:
    template <int n, TransferMethod method>
    void add_points(const SoilBody<dim> &body, NodalField<dim> &field) const;

    /// update_velocities() for cells of n nodes along each axis.
    template <int n, TransferMethod method>
    double update_points(SoilBody<dim> &body,
                         const NodalField<dim> &field,
                         const double time_step,
                         NodalField<dim> &projected) const;

    /// @param move_cell moves the points of a cell, fills `motion` from a number on and includes the squares of speeds
    template <typename MoveCell>
    MotionReport
    move_points(SoilBody<dim> &body, const double time_step, const Mixture<dim> *mixture, const MoveCell &move_cell);

    /// Velocity, place and affine field of a cell's points; into `motion` from number `first` on what the rest needs.
    ///
    /// @param keep see kept_velocity()
    template <int n, TransferMethod method>
    void move_cell(const SoilBody<dim> &body,
                   const CellPoints<dim> &cell,
                   const NodalField<dim> &field,
                   const double time_step,
                   const double keep,
                   const unsigned int first,
                   LargestSquare &largest);

    /// Places of a cell's points, whose velocity has been updated before; into `motion` from number `first` on what the
    /// rest needs, with the gradient of the velocity `projected`.
    template <int n>
    void strain_cell(const SoilBody<dim> &body,
                     const CellPoints<dim> &cell,
                     const NodalField<dim> &field,
                     const NodalField<dim> &projected,
                     const double time_step,
                     const unsigned int first);

    /// Into `motion`, of a batch of points from number `p` on: dF, its determinant, volume and reference volume.
    ///
    /// @param gradient of the velocity, 1/s, row-major
    void set_motion(const SoilBody<dim> &body,
                    const Batch *gradient,
                    const Batch &mass,
                    const Batch &volume,
                    const double time_step,
                    const unsigned int p);

    /// Volume, stress and state of a block of points, of which `cell` is the first one, from `motion`. Throws
    /// PointFault if a point is deformed too much in a step.
    void update_state(const SoilBody<dim> &body,
                      const CellPoints<dim> &cell,
                      const unsigned int n_points,
                      const double time_step,
                      UpdateReport &report);

    /// Points whose stress is updated in one go, unless a cell has more.
    static constexpr unsigned int block_size = 128;

    const BackgroundGrid<dim> &grid;
    const TransferMethod method;
    const double pic_rate;
    const FBar f_bar;
    BlockMotion<dim> motion; // of the points at hand; kept for its memory
  };
} // namespace scree

#endif

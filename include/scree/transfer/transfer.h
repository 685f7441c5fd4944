// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_transfer_transfer_h
#define scree_transfer_transfer_h

#include <scree/bodies/phases.h>
#include <scree/mesh/node_values.h>
#include <scree/particles/point_set.h>
#include <scree/transfer/f_bar.h>
#include <scree/transfer/motion_sums.h>
#include <scree/transfer/skeleton_damping.h>
#include <scree/transfer/transfer_parameters.h>
#include <scree/transfer/volume_projection.h>

#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace scree
{
  /// What a pass from the grid to the points found out; cells add up.
  template <int dim>
  struct MotionReport
  {
    double largest_speed = 0; ///< m/s; not a number if any point's is not
    MotionSums<dim> sums;     ///< at the end of the step
    UpdateReport material;    ///< what the stress updates reported
  };

  /// Carries mass, momentum and force from points to nodes, and velocity back.
  template <int dim>
  class Transfer
  {
  public:
    using Bodies = std::vector<SoilBody<dim> *>; ///< that move with one velocity field
    using Report = std::function<void(const SoilBody<dim> &, const MotionReport<dim> &)>; ///< of one of them

    /// Keeps a reference to the grid; copies the entries.
    Transfer(const BackgroundGrid<dim> &grid,
             const TransferParameters &transfer,
             const StabilisationParameters &stabilisation);

    /// Fits what is kept of the grid to its current partition. Collective.
    void reinit()
    {
      if (projection)
        projection->reinit();
    }

    /// Activates the nodes of the body's cells and adds mass, momentum and internal force of this rank's points:
    /// lumped mass sum m phi_i, momentum sum m phi_i (v + C (x_i - x)) with C = 0 for FLIP, force -sum V sigma grad
    /// phi_i.
    void to_grid(const SoilBody<dim> &body, NodalField<dim> &field) const;

    /// Velocity, position, volume, F-bar, stress and state of the points at the end of a step of `time_step` s, from
    /// the nodes' end-of-step velocity and its change. The points are not sorted yet. Collective.
    /// @param damping_time of the skeleton, s; read if the points have a stress of damping
    /// @param report called for each body
    void to_points(const Bodies &bodies,
                   const NodalField<dim> &field,
                   const double time_step,
                   const double damping_time,
                   const Report &report);

  private:
    template <int n, bool is_affine, bool is_damped>
    void add_points(const SoilBody<dim> &body, NodalField<dim> &field) const;

    /// to_points() for cells of n nodes along each axis.
    template <int n, TransferMethod method>
    void move_points(const Bodies &bodies,
                     const NodalField<dim> &field,
                     const double time_step,
                     const double damping_time,
                     const Report &report);

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
                   LargestSquare &largest,
                   MotionSums<dim, Batch> &sums);

    using Block = CellBlock<dim>;

    /// Calls `act` with the blocks of some cells, which have at most `block_size` points, unless a cell has more.
    template <typename Act>
    static void for_each_block(const Block &cells, const Act &act);

    /// Volume, stress and state of a block of points from `motion`. Throws a PointFault with its name if a point is
    /// deformed too much in a step.
    void update_state(const SoilBody<dim> &body,
                      const Block &block,
                      const double time_step,
                      const double damping_time,
                      UpdateReport &report);

    /// Points whose stress is updated in one go.
    static constexpr unsigned int block_size = 128;

    const BackgroundGrid<dim> &grid;
    const TransferMethod method;
    const double pic_rate;
    const FBar f_bar;
    std::unique_ptr<VolumeProjection<dim>> projection; // with FBar::projected
    SkeletonDamping<dim> damping;
    BlockMotion<dim> motion; // of the points at hand; kept for its memory, as are the following
    std::vector<std::pair<Block, MotionReport<dim>>> moved; // of each body
  };
} // namespace scree

#endif

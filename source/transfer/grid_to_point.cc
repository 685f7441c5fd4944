// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/transfer/transfer.h>
#include <scree/transfer/velocity_transfer.h>

#include <cmath>

namespace scree
{
  using namespace dealii;


  template <int dim>
  Transfer<dim>::Transfer(const BackgroundGrid<dim> &grid,
                          const TransferParameters &transfer,
                          const StabilisationParameters &stabilisation)
      : grid(grid)
      , method(transfer.transfer_method())
      , pic_rate(transfer.pic_rate)
      , f_bar(stabilisation.f_bar_kind())
  {
  }


  template <int dim>
  template <int n, TransferMethod method>
  MotionReport Transfer<dim>::move_points(SoilBody<dim> &body, const NodalField<dim> &field, const double time_step)
  {
    const double keep  = kept_velocity(method, pic_rate, time_step);
    const auto &layout = body.layout;

    MotionReport report;
    double largest_square = 0;
    CellCosts &costs      = body.points.costs();
    costs.start_pass();
    for (const auto &cell : body.points.cells())
      {
        const OpenKnots open = grid.open_knots(cell.cell);
        const CellVelocity<dim, n> nodes(grid.nodes(cell.cell), field, grid.cell_size());
        motion.resize(cell.n_points);
        for (unsigned int p = 0; p < cell.n_points; ++p)
          {
            double *properties = cell.properties_of(p);
            const PointShape<dim, n> shape(cell.reference_location_of(p), open);
            Tensor<2, dim> gradient;
            const double square = nodes.template move<method>(
                shape,
                { properties + layout.velocity, properties + layout.affine, &cell.location_of(p), &gradient },
                keep,
                time_step);
            if (!(square <= largest_square)) // keeps a NaN
              largest_square = square;

            const Tensor<2, dim> increment  = Tensor<2, dim>(unit_symmetric_tensor<dim>()) + time_step * gradient;
            motion.deformation_increment[p] = increment;
            motion.out_of_plane_stretch[p]  = 1.;
            motion.volume_change[p]         = determinant(increment);
            motion.volume[p]                = properties[layout.volume];
            motion.reference_volume[p]      = properties[layout.mass] / body.density;
          }
        update_state(body, cell, report.material);
        costs.finish_cell(cell.cell, cell.n_points);
      }
    report.largest_speed = std::sqrt(largest_square);
    return report;
  }


  template <int dim>
  void Transfer<dim>::update_state(const SoilBody<dim> &body, const CellPoints<dim> &cell, UpdateReport &report)
  {
    const auto points = body.material_points(cell);
    apply_f_bar(f_bar, motion, points);
    for (unsigned int p = 0; p < cell.n_points; ++p)
      {
        double &volume = cell.properties_of(p)[body.layout.volume];
        volume *= motion.volume_change[p];
        motion.volume_ratio[p] = volume / motion.reference_volume[p];
      }
    body.material->update(points, motion.material_motion(), report);
  }


  template <int dim>
  MotionReport Transfer<dim>::to_points(SoilBody<dim> &body, const NodalField<dim> &field, const double time_step)
  {
    const auto dispatch = [&](auto n) {
      switch (method)
        {
        case TransferMethod::flip:
          return move_points<n, TransferMethod::flip>(body, field, time_step);
        case TransferMethod::pic:
          return move_points<n, TransferMethod::pic>(body, field, time_step);
        case TransferMethod::apic:
          return move_points<n, TransferMethod::apic>(body, field, time_step);
        case TransferMethod::aflip:
          return move_points<n, TransferMethod::aflip>(body, field, time_step);
        default:
          return move_points<n, TransferMethod::tpic>(body, field, time_step);
        }
    };
    if (grid.n_nodes_1d() == 2)
      return dispatch(std::integral_constant<int, 2>());
    return dispatch(std::integral_constant<int, 3>());
  }

  template class Transfer<2>;
  template class Transfer<3>;
} // namespace scree

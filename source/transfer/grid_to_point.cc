// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/transfer/affine_field.h>
#include <scree/transfer/cell_velocity.h>
#include <scree/transfer/transfer.h>

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
    const double width = grid.cell_size();
    const double slope = time_step / width;
    const double keep  = method == TransferMethod::flip ? std::exp(-pic_rate * time_step) : 0.;
    const auto &layout = body.layout;

    MotionReport report;
    double largest_square = 0;
    CellCosts &costs      = body.points.costs();
    costs.start_pass();
    for (const auto &cell : body.points.cells())
      {
        const OpenKnots open = grid.open_knots(cell.cell);
        const CellVelocity<dim, n> nodes(grid.nodes(cell.cell), field);
        motion.resize(cell.n_points);

        double *properties = cell.properties;
        for (unsigned int p = 0; p < cell.n_points; ++p, properties += body.points.stride())
          {
            const CellBasis<dim, n> basis(cell.reference_location[p], open);
            const RowFactors<dim, n> rows(basis);
            const NodeRow value_x = make_row(basis.value[0]), derivative_x = make_row(basis.derivative[0]);

            Tensor<2, dim> increment = unit_symmetric_tensor<dim>();
            double square            = 0;
            for (unsigned int c = 0; c < dim; ++c)
              {
                const NodeRow along   = contract(rows.value, nodes.velocity[c]);
                const double velocity = sum(along * value_x);
                increment[c][0] += slope * sum(along * derivative_x);
                for (unsigned int a = 1; a < dim; ++a)
                  increment[c][a] += slope * sum(contract(rows.derivative[a - 1], nodes.velocity[c]) * value_x);

                double &own = properties[layout.velocity + c];
                if (method == TransferMethod::flip)
                  own = keep * (own + sum(contract(rows.value, nodes.change[c]) * value_x)) + (1. - keep) * velocity;
                else
                  own = velocity;
                cell.location[p][c] += time_step * velocity;
                square += own * own;

                double *affine = properties + layout.affine + c * dim;
                if constexpr (method == TransferMethod::apic)
                  affine_moment<dim, n>(
                      basis, rows, open, cell.reference_location[p], width, nodes.velocity[c], affine);
                if constexpr (method == TransferMethod::tpic)
                  for (unsigned int a = 0; a < dim; ++a)
                    affine[a] = (increment[c][a] - (a == c ? 1. : 0.)) / time_step;
              }
            if (!(square <= largest_square)) // keeps a NaN
              largest_square = square;

            motion.deformation_increment[p] = increment;
            motion.out_of_plane_stretch[p]  = 1.;
            motion.volume_change[p]         = determinant(increment);
            motion.volume[p]                = properties[layout.volume];
            motion.reference_volume[p]      = properties[layout.mass] / body.density;
          }

        const auto points = body.material_points(cell);
        apply_f_bar(f_bar, motion, points);
        for (unsigned int p = 0; p < cell.n_points; ++p)
          {
            double &volume = cell.properties[p * body.points.stride() + layout.volume];
            volume *= motion.volume_change[p];
            motion.volume_ratio[p] = volume / motion.reference_volume[p];
          }
        body.material->update(points, motion.material_motion(), report.material);
        costs.finish_cell(cell.cell, cell.n_points);
      }
    report.largest_speed = std::sqrt(largest_square);
    return report;
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

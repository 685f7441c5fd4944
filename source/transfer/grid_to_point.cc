// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/transfer/node_rows.h>
#include <scree/transfer/transfer.h>

#include <cmath>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// End-of-step velocity and its change at a cell's nodes.
    template <int dim, int n>
    struct CellVelocity
    {
      static constexpr unsigned int n_rows = RowFactors<dim, n>::n_rows;

      NodeRow velocity[dim][n_rows];
      NodeRow change[dim][n_rows];

      CellVelocity(const unsigned int *nodes, const NodalField<dim> &field)
      {
        for (unsigned int r = 0; r < n_rows; ++r)
          {
            std::array<const double *, n> node;
            for (unsigned int i = 0; i < n; ++i)
              node[i] = field[nodes[r * n + i]];
            for (unsigned int c = 0; c < dim; ++c)
              {
                std::array<double, n> v, dv;
                for (unsigned int i = 0; i < n; ++i)
                  {
                    v[i]  = node[i][NodalField<dim>::velocity + c];
                    dv[i] = node[i][NodalField<dim>::velocity_change + c];
                  }
                velocity[c][r] = make_row(v);
                change[c][r]   = make_row(dv);
              }
          }
      }
    };

    /// sum over the rows of factor times values
    template <std::size_t n_rows>
    NodeRow contract(const std::array<double, n_rows> &factor, const NodeRow (&values)[n_rows])
    {
      NodeRow result = values[0] * factor[0];
      for (unsigned int r = 1; r < n_rows; ++r)
        result += values[r] * factor[r];
      return result;
    }

    /// APIC's sum phi_i v_i (x_i - x)^T, m^2/s, row `c`.
    template <int dim, int n>
    void affine_moment(const CellBasis<dim, n> &basis,
                       const RowFactors<dim, n> &rows,
                       const OpenKnots open,
                       const Point<dim> &x,
                       const double width,
                       const NodeRow (&velocity)[RowFactors<dim, n>::n_rows],
                       double *moment)
    {
      const auto offset = [&](const unsigned int a, const unsigned int i) {
        return width * (CellBasis<dim, n>::node_positions(open, a)[i] - x[a]);
      };
      std::array<double, n> along_x;
      for (unsigned int i = 0; i < n; ++i)
        along_x[i] = offset(0, i) * basis.value[0][i];
      moment[0] = sum(contract(rows.value, velocity) * make_row(along_x));
      for (unsigned int a = 1; a < dim; ++a)
        {
          auto factor = rows.value;
          for (unsigned int r = 0; r < factor.size(); ++r)
            factor[r] *= offset(a, a == 1 ? r % n : r / n);
          moment[a] = sum(contract(factor, velocity) * make_row(basis.value[0]));
        }
    }
  } // namespace


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
  MotionReport Transfer<dim>::move_points(Phase<dim> &phase, const NodalField<dim> &field, const double time_step)
  {
    const double width = grid.cell_size();
    const double slope = time_step / width;
    const double keep  = method == TransferMethod::flip ? std::exp(-pic_rate * time_step) : 0.;
    const auto &layout = phase.layout;

    MotionReport report;
    double largest_square = 0;
    for (const CellPoints<dim> &cell : phase.points.cells())
      {
        const OpenKnots open = grid.open_knots(cell.cell);
        const CellVelocity<dim, n> nodes(grid.nodes(cell.cell), field);
        motion.resize(cell.n_points);

        double *properties = cell.properties;
        for (unsigned int p = 0; p < cell.n_points; ++p, properties += phase.points.stride())
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
            motion.reference_volume[p]      = properties[layout.mass] / phase.density;
          }

        const auto points = phase.material_points(cell);
        apply_f_bar(f_bar, motion, points);
        for (unsigned int p = 0; p < cell.n_points; ++p)
          {
            double &volume = cell.properties[p * phase.points.stride() + layout.volume];
            volume *= motion.volume_change[p];
            motion.volume_ratio[p] = volume / motion.reference_volume[p];
          }
        phase.material->update(points, motion.material_motion(), report.material);
      }
    report.largest_speed = std::sqrt(largest_square);
    return report;
  }


  template <int dim>
  MotionReport Transfer<dim>::to_points(Phase<dim> &phase, const NodalField<dim> &field, const double time_step)
  {
    const auto dispatch = [&](auto n) {
      switch (method)
        {
        case TransferMethod::flip:
          return move_points<n, TransferMethod::flip>(phase, field, time_step);
        case TransferMethod::pic:
          return move_points<n, TransferMethod::pic>(phase, field, time_step);
        case TransferMethod::apic:
          return move_points<n, TransferMethod::apic>(phase, field, time_step);
        default:
          return move_points<n, TransferMethod::tpic>(phase, field, time_step);
        }
    };
    if (grid.n_nodes_1d() == 2)
      return dispatch(std::integral_constant<int, 2>());
    return dispatch(std::integral_constant<int, 3>());
  }

  template class Transfer<2>;
  template class Transfer<3>;
} // namespace scree

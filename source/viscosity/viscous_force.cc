// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/transfer/cell_sums.h>
#include <scree/viscosity/viscous_force.h>

#include <algorithm>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// 2 dev(sym grad v), 1/s: incompressible beside the pressure.
    template <int dim>
    DEAL_II_ALWAYS_INLINE inline Tensor<2, dim> twice_deviatoric_rate(const Tensor<2, dim> &gradient)
    {
      const double mean = 2. / 3. * trace(gradient);
      Tensor<2, dim> rate;
      for (unsigned int c = 0; c < dim; ++c)
        for (unsigned int a = 0; a < dim; ++a)
          rate[c][a] = gradient[c][a] + gradient[a][c] - (a == c ? mean : 0.);
      return rate;
    }

    /// sum |grad phi_i|^2/phi_i, per square of the cell's width: a sum over the axes, as the others' functions add up
    /// to one. Of splines at most 6 an axis, which is taken for all points away from walls.
    template <int dim, int n>
    double stiffness(const Point<dim> &x, const OpenKnots open)
    {
      if (n == 3 && open == 0)
        return 6. * dim;
      const CellBasis<dim, n> basis(x, open);
      double sum = 0;
      for (unsigned int a = 0; a < dim; ++a)
        for (unsigned int i = 0; i < n; ++i)
          if (const double slope = basis.derivative[a][i]; slope != 0.)
            sum += slope * slope / basis.value[a][i];
      return sum;
    }
  } // namespace


  template <int dim>
  ViscousForce<dim>::ViscousForce(const BackgroundGrid<dim> &grid, const double viscosity)
      : grid(grid)
      , viscosity(viscosity)
  {
  }


  template <int dim>
  template <int n>
  void ViscousForce<dim>::add_points(const WaterPhase<dim> &water,
                                     const NodalField<dim> &motion,
                                     NodalField<dim> &field) const
  {
    for (const auto &cell : water.points().cells())
      {
        const OpenKnots open      = grid.open_knots(cell.cell);
        const unsigned int *nodes = grid.nodes(cell.cell);
        const CellVelocity<dim, n> velocity(nodes, motion, grid.cell_size());
        CellSums<dim, n> sums(grid.cell_size());
        for_each_batch(cell.n_points, [&](const BatchIndices &indices, const unsigned int n_used) {
          RecordPointers<const double> places;
          for (unsigned int l = 0; l < batch_size; ++l)
            places[l] = &cell.reference_location_of(indices[l])[0];
          const auto at_points = velocity.template at<TransferMethod::tpic, true>(BatchShape<dim, n>(places, open));
          for (unsigned int l = 0; l < n_used; ++l)
            {
              const PointShape<dim, n> shape(cell.reference_location_of(indices[l]), open);
              Tensor<2, dim> gradient;
              for (unsigned int c = 0; c < dim; ++c)
                for (unsigned int d = 0; d < dim; ++d)
                  gradient[c][d] = at_points.gradient[c * dim + d][l];
              sums.add_force(shape,
                             viscosity * cell.properties_of(indices[l])[water.layout.volume],
                             twice_deviatoric_rate(gradient));
            }
        });
        field.activate_cell(cell.cell);
        sums.scatter(nodes, field);
      }
  }


  template <int dim>
  template <int n>
  double ViscousForce<dim>::bound(const WaterPhase<dim> &water) const
  {
    double largest = 0;
    for (const auto &cell : water.points().cells())
      for_each_point(cell, [&, open = grid.open_knots(cell.cell)](const auto &point) {
        if (const double product = viscosity * point.properties[water.layout.volume]; product > 0.)
          largest = std::max(largest,
                             product / point.properties[water.layout.mass] *
                                 stiffness<dim, n>(point.reference_location, open));
      });
    return 2. * largest / (grid.cell_size() * grid.cell_size());
  }


  template <int dim>
  void ViscousForce<dim>::add(const WaterPhase<dim> &water, const NodalField<dim> &motion, NodalField<dim> &field) const
  {
    if (grid.n_nodes_1d() == 2)
      add_points<2>(water, motion, field);
    else
      add_points<3>(water, motion, field);
  }


  template <int dim>
  double ViscousForce<dim>::largest_rate(const WaterPhase<dim> &water) const
  {
    return grid.n_nodes_1d() == 2 ? bound<2>(water) : bound<3>(water);
  }

  template class ViscousForce<2>;
  template class ViscousForce<3>;
} // namespace scree

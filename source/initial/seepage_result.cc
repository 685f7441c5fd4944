// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/initial/steady_seepage.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace scree
{
  using namespace dealii;

  template <int dim>
  SeepageReport SteadySeepage<dim>::report(const double scale) const
  {
    const double resolution = 1e-3 * grid.cell_size(); // of heads that count as one: that of one reservoir
    SeepageReport report;
    std::map<long, double> out_to; // flow by heads
    double highest = -std::numeric_limits<double>::infinity();
    for (unsigned int f = 0; f < faces.size(); ++f)
      {
        const double flow = scale * conductance(f) * (head_at(faces[f]) - head_beyond(faces[f]));
        if (!std::isnan(faces[f].head))
          out_to[std::lround(faces[f].head / resolution)] += flow;
        else if (is_leaving[f])
          {
            report.outflow_in_air += flow;
            highest = std::max(highest, faces[f].location[dim - 1]);
          }
      }
    std::map<long, double> of_all;
    for (const auto &of_rank : Utilities::MPI::all_gather(grid.communicator(), out_to))
      for (const auto &[head, flow] : of_rank)
        of_all[head] += flow;
    for (const auto &[head, flow] : of_all)
      (flow > 0. ? report.outflow_below : report.inflow) += std::abs(flow);
    report.outflow_in_air = Utilities::MPI::sum(report.outflow_in_air, grid.communicator());
    highest               = Utilities::MPI::max(highest, grid.communicator());
    report.exit_height    = std::isfinite(highest) ? highest : std::numeric_limits<double>::quiet_NaN();
    return report;
  }


  template <int dim>
  std::shared_ptr<const SeepageField<dim>> SteadySeepage<dim>::field(const SeepageReport &report) const
  {
    const MPI_Comm communicator = grid.communicator();
    const CellsOfBox<dim> &box  = grid.fine_cells().box();
    std::vector<int> lower(dim, std::numeric_limits<int>::max()), upper(dim, 0); // of the cells; MPI reduces no arrays
    for (const Cell &cell : cells)
      for (unsigned int a = 0; a < dim; ++a)
        {
          const int place = box.place_of_corner(cell.corner)[a];
          lower[a]        = std::min(lower[a], place);
          upper[a]        = std::max(upper[a], place);
        }
    Utilities::MPI::min(lower, communicator, lower);
    Utilities::MPI::max(upper, communicator, upper);
    CellPlace<dim> first, n;
    std::size_t n_all = 1;
    for (unsigned int a = 0; a < dim; ++a)
      {
        first[a] = lower[a];
        n[a]     = upper[a] - lower[a] + 2;
        n_all *= n[a];
      }
    std::vector<double> values(n_all, 0.), counts(n_all, 0.);
    for (unsigned int vertex = 0; vertex < vertices.n_owned() && !has_no_soil; ++vertex)
      if (rows.local_element(vertex) >= 0.)
        {
          const Point<dim> &x        = vertices.position(vertex);
          const CellPlace<dim> place = box.place_of_corner(x);
          std::size_t number = 0, step = 1;
          for (unsigned int a = 0; a < dim; ++a, step *= n[a - 1])
            number += (place[a] - first[a]) * step;
          values[number] = heads.local_element(vertex) - x[dim - 1];
          counts[number] = 1.;
        }
    Utilities::MPI::sum(values, communicator, values);
    Utilities::MPI::sum(counts, communicator, counts);
    for (std::size_t i = 0; i < n_all; ++i)
      if (counts[i] == 0.)
        values[i] = std::numeric_limits<double>::quiet_NaN();
    return std::make_shared<const SeepageField<dim>>(box, first, n, std::move(values), report);
  }

  template SeepageReport SteadySeepage<2>::report(const double) const;
  template SeepageReport SteadySeepage<3>::report(const double) const;
  template std::shared_ptr<const SeepageField<2>> SteadySeepage<2>::field(const SeepageReport &) const;
  template std::shared_ptr<const SeepageField<3>> SteadySeepage<3>::field(const SeepageReport &) const;
} // namespace scree

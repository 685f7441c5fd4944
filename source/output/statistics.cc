// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/output/statistics.h>

#include <deal.II/base/mpi.h>

#include <fstream>
#include <iomanip>

namespace scree
{
  using namespace dealii;

  template <int dim>
  void RunTotals<dim>::add(const UpdateReport &report)
  {
    plastic_dissipation += report.plastic_dissipation;
    n_updates += report.n_updates;
    n_substeps += report.n_substeps;
    n_fallbacks += report.n_fallbacks;
    n_vertices += report.n_vertices;
    n_unresolved += report.n_unresolved;
  }


  template <int dim>
  RunTotals<dim> RunTotals<dim>::sum_over_ranks(const MPI_Comm communicator) const
  {
    RunTotals total = *this;
    const auto sum  = [&](auto &value) { value = Utilities::MPI::sum(value, communicator); };
    sum(total.balance.wall_impulse);
    sum(total.balance.body_impulse);
    sum(total.lost_momentum);
    for (double *value : { &total.balance.wall_dissipation,
                           &total.plastic_dissipation,
                           &total.lost_mass,
                           &total.lost_energy,
                           &total.n_lost,
                           &total.n_updates,
                           &total.n_substeps,
                           &total.n_fallbacks,
                           &total.n_vertices,
                           &total.n_unresolved })
      sum(*value);
    return total;
  }


  namespace
  {
    /// Sums over all points of all ranks.
    template <int dim>
    struct PointSums
    {
      double points = 0, mass = 0, kinetic = 0, potential = 0, elastic = 0, pressure = 0;
      Tensor<1, dim> momentum;
      double largest_pressure = 0, height;

      PointSums(const std::list<Phase<dim>> &phases, const BackgroundGrid<dim> &grid, const Tensor<1, dim> &gravity)
          : height(grid.lower_corner()[dim - 1])
      {
        for (const auto &phase : phases)
          for (const auto &cell : phase.points.cells())
            for (unsigned int p = 0; p < cell.n_points; ++p)
              add(phase, cell.location[p], cell.properties + p * phase.points.stride(), gravity);

        std::vector<double> sums{ points, mass, kinetic, potential, elastic, pressure };
        for (unsigned int a = 0; a < dim; ++a)
          sums.push_back(momentum[a]);
        const MPI_Comm communicator = grid.triangulation().get_communicator();
        Utilities::MPI::sum(sums, communicator, sums);
        points = sums[0], mass = sums[1], kinetic = sums[2], potential = sums[3], elastic = sums[4];
        pressure = sums[5];
        for (unsigned int a = 0; a < dim; ++a)
          momentum[a] = sums[6 + a];
        largest_pressure = Utilities::MPI::max(largest_pressure, communicator);
        height           = Utilities::MPI::max(height, communicator);
      }

    private:
      void add(const Phase<dim> &phase, const Point<dim> &x, const double *properties, const Tensor<1, dim> &gravity)
      {
        const double m = properties[phase.layout.mass];
        const Tensor<1, dim> v(
            make_array_view(properties + phase.layout.velocity, properties + phase.layout.velocity + dim));
        const double P = mean_effective_stress(properties + phase.layout.stress);
        points += 1;
        mass += m;
        momentum += m * v;
        kinetic += 0.5 * m * v.norm_square();
        potential -= m * (gravity * (x - Point<dim>()));
        elastic += m / phase.density * phase.material->elastic_energy(properties + phase.layout.left_cauchy_green);
        pressure += P;
        largest_pressure = std::max(largest_pressure, P);
        height           = std::max(height, x[dim - 1]);
      }
    };
  } // namespace


  template <int dim>
  Statistics<dim>::Statistics(const BackgroundGrid<dim> &grid, const Tensor<1, dim> &gravity)
      : grid(grid)
      , gravity(gravity)
  {
  }


  template <int dim>
  void Statistics<dim>::add(const std::string &column, const double value)
  {
    table.add_value(column, value);
    table.set_scientific(column, true);
    table.set_precision(column, 12);
    last_row.emplace_back(column, value);
  }


  template <int dim>
  void Statistics<dim>::collect(const std::list<Phase<dim>> &phases,
                                const RunTotals<dim> &local,
                                const double time,
                                const unsigned long long step,
                                const double time_step,
                                const UpdateReport &last_step)
  {
    const MPI_Comm communicator = grid.triangulation().get_communicator();
    const PointSums<dim> now(phases, grid, gravity);

    const RunTotals<dim> totals  = local.sum_over_ranks(communicator);
    const Tensor<1, dim> impulse = totals.balance.wall_impulse + totals.balance.body_impulse - totals.lost_momentum;

    const double energy = now.kinetic + now.potential + now.elastic;
    if (!has_start)
      {
        has_start      = true;
        start_momentum = now.momentum - impulse;
        start_energy   = energy;
      }
    last_row.clear();

    add("Time (s)", time);
    add("Step", step);
    add("Time step (s)", time_step);
    add("Points", now.points);
    add("Mass (kg)", now.mass);
    for (unsigned int a = 0; a < dim; ++a)
      add(std::string("Momentum ") + "xyz"[a] + " (N s)", now.momentum[a]);
    add("Momentum residual (N s)", (now.momentum - start_momentum - impulse).norm());
    add("Kinetic energy (J)", now.kinetic);
    add("Potential energy (J)", now.potential);
    add("Elastic energy (J)", now.elastic);
    add("Plastic dissipation (J)", totals.plastic_dissipation);
    add("Wall dissipation (J)", totals.balance.wall_dissipation);
    add("Numerical dissipation (J)",
        start_energy - energy - totals.plastic_dissipation - totals.balance.wall_dissipation - totals.lost_energy);
    const auto front = mass_percentiles(phases, grid, 0, { 0.90, 0.99, 0.995 });
    add("Front 90 % (m)", front[0]);
    add("Front 99 % (m)", front[1]);
    add("Front 99.5 % (m)", front[2]);
    add("Height (m)", now.height);
    add("Stress oscillation (-)", stress_oscillation(phases, grid));
    add("Mean P (Pa)", now.points > 0 ? now.pressure / now.points : 0.);
    add("Largest P (Pa)", now.largest_pressure);
    add("Separated points", Utilities::MPI::sum(double(last_step.n_separated), communicator));
    add("Substeps per update", totals.n_updates > 0 ? totals.n_substeps / totals.n_updates : 0.);
    add("Fallbacks", totals.n_fallbacks);
    add("Vertices", totals.n_vertices);
    add("Unresolved", totals.n_unresolved);
    add("Points lost", totals.n_lost);
    add("Mass lost (kg)", totals.lost_mass);
  }


  template <int dim>
  void Statistics<dim>::write(const std::string &file) const
  {
    std::ofstream out(file);
    table.write_text(out, TableHandler::table_with_separate_column_description);
  }


  template <int dim>
  void Statistics<dim>::print_last_row(std::ostream &out) const
  {
    out << std::scientific << std::setprecision(10);
    for (const auto &[column, value] : last_row)
      out << column << ": " << value << '\n';
  }

  template struct RunTotals<2>;
  template struct RunTotals<3>;
  template class Statistics<2>;
  template class Statistics<3>;
} // namespace scree

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/output/measures.h>

#include <deal.II/base/mpi.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/lac/vector.h>

#include <algorithm>
#include <cmath>

namespace scree
{
  using namespace dealii;

  template <int dim>
  double deviatoric_stress(const double *stress)
  {
    const double pressure = mean_effective_stress(stress);
    double sum            = 0;
    for (unsigned int c = 0; c < 3; ++c)
      sum += (stress[c] + pressure) * (stress[c] + pressure);
    for (unsigned int c = 3; c < n_symmetric_components<dim>; ++c)
      sum += 2. * stress[c] * stress[c];
    return std::sqrt(1.5 * sum);
  }


  template <int dim>
  std::vector<double> mass_percentiles(const std::list<Phase<dim>> &phases,
                                       const BackgroundGrid<dim> &grid,
                                       const unsigned int axis,
                                       const std::vector<double> &fractions)
  {
    const MPI_Comm communicator = grid.triangulation().get_communicator();

    // Each pass finds the bin in which the wanted mass is reached and looks into it the next time.
    const auto find = [&](const double fraction) {
      constexpr unsigned int n_bins = 1000;
      double begin = grid.lower_corner()[axis], end = grid.upper_corner()[axis], below = 0, wanted = -1;
      for (unsigned int pass = 0; pass < 5; ++pass)
        {
          std::vector<double> bins(n_bins, 0.);
          for (const auto &phase : phases)
            for (const auto &cell : phase.points.cells())
              for (unsigned int p = 0; p < cell.n_points; ++p)
                {
                  const double position = (cell.location[p][axis] - begin) / (end - begin) * n_bins;
                  if (position >= 0 && position < n_bins)
                    bins[static_cast<unsigned int>(position)] +=
                        cell.properties[p * phase.points.stride() + phase.layout.mass];
                }
          Utilities::MPI::sum(bins, communicator, bins);
          if (wanted < 0)
            for (const double mass : bins)
              wanted = std::max(wanted, 0.) + fraction * mass;
          // Equal masses often add up to just the wanted part: rounding must not choose the point.
          unsigned int bin = 0;
          while (bin + 1 < n_bins && below + bins[bin] < wanted * (1. - 1e-12))
            below += bins[bin++];
          const double width = (end - begin) / n_bins;
          begin += bin * width;
          end = begin + width;
        }
      return 0.5 * (begin + end);
    };

    std::vector<double> result;
    for (const double fraction : fractions)
      result.push_back(find(fraction));
    return result;
  }


  namespace
  {
    /// Moments of a cell's points about a common origin: 1, x, x x^T (rows of the normal matrix of a linear fit) and
    /// the same of P.
    template <int dim>
    struct Moments
    {
      std::array<double, (dim + 1) * (dim + 1)> matrix{};
      std::array<double, dim + 1> rhs{};

      void add(const Point<dim> &x, const double pressure)
      {
        std::array<double, dim + 1> monomials{ { 1. } };
        for (unsigned int a = 0; a < dim; ++a)
          monomials[a + 1] = x[a];
        for (unsigned int i = 0; i <= dim; ++i)
          {
            for (unsigned int j = 0; j <= dim; ++j)
              matrix[i * (dim + 1) + j] += monomials[i] * monomials[j];
            rhs[i] += monomials[i] * pressure;
          }
      }

      void operator+=(const Moments &other)
      {
        for (unsigned int i = 0; i < matrix.size(); ++i)
          matrix[i] += other.matrix[i];
        for (unsigned int i = 0; i < rhs.size(); ++i)
          rhs[i] += other.rhs[i];
      }

      template <class Archive>
      void serialize(Archive &archive, const unsigned int)
      {
        archive &matrix &rhs;
      }
    };

    /// Mean and slopes of the linear fit; slopes that the points do not determine are 0.
    template <int dim>
    Vector<double> fit(const Moments<dim> &moments)
    {
      Vector<double> coefficients(dim + 1);
      if (moments.matrix[0] == 0)
        return coefficients;

      // Centred normal matrix: 1/n x^T x - mean mean^T.
      const double n = moments.matrix[0];
      Tensor<1, dim> mean, slope;
      SymmetricTensor<2, dim> spread;
      for (unsigned int a = 0; a < dim; ++a)
        mean[a] = moments.matrix[a + 1] / n;
      Tensor<1, dim> covariance;
      for (unsigned int a = 0; a < dim; ++a)
        {
          for (unsigned int b = 0; b < dim; ++b)
            spread[a][b] = moments.matrix[(a + 1) * (dim + 1) + b + 1] / n - mean[a] * mean[b];
          covariance[a] = moments.rhs[a + 1] / n - mean[a] * moments.rhs[0] / n;
        }
      for (const auto &[value, axis] : eigenvectors(spread))
        if (value > 1e-6) // of a cell width squared: the points spread along this axis
          slope += (covariance * axis) / value * axis;
      coefficients[0] = moments.rhs[0] / n - slope * mean;
      for (unsigned int a = 0; a < dim; ++a)
        coefficients[a + 1] = slope[a];
      return coefficients;
    }
  } // namespace


  template <int dim>
  double stress_oscillation(const std::list<Phase<dim>> &phases, const BackgroundGrid<dim> &grid)
  {
    const auto &mesh = grid.triangulation();
    std::vector<Moments<dim>> moments(mesh.n_active_cells());
    const auto scaled = [&](const Point<dim> &x) { return Point<dim>((x - grid.lower_corner()) / grid.cell_size()); };

    for (const auto &phase : phases)
      for (const auto &cell : phase.points.cells())
        for (unsigned int p = 0; p < cell.n_points; ++p)
          moments[cell.cell].add(
              scaled(cell.location[p]),
              mean_effective_stress(cell.properties + p * phase.points.stride() + phase.layout.stress));

    using Cell = typename Triangulation<dim>::active_cell_iterator;
    GridTools::exchange_cell_data_to_ghosts<Moments<dim>, parallel::distributed::Triangulation<dim>>(
        mesh,
        [&](const Cell &cell) { return std_cxx17::optional<Moments<dim>>(moments[cell->active_cell_index()]); },
        [&](const Cell &cell, const Moments<dim> &value) { moments[cell->active_cell_index()] = value; });

    // The linear fit around each owned cell that holds points.
    std::vector<Vector<double>> fits(mesh.n_active_cells());
    for (const auto &cell : mesh.active_cell_iterators())
      if (cell->is_locally_owned() && moments[cell->active_cell_index()].matrix[0] > 0)
        {
          std::vector<Cell> patch{ cell };
          for (unsigned int a = 0; a < dim; ++a)
            for (unsigned int i = 0, n = patch.size(); i < n; ++i)
              for (const unsigned int face : { 2 * a, 2 * a + 1 })
                if (const auto near = patch[i]; !near->at_boundary(face))
                  patch.push_back(near->neighbor(face));
          Moments<dim> sum;
          for (const auto &near : patch)
            sum += moments[near->active_cell_index()];
          fits[cell->active_cell_index()] = fit(sum);
        }

    std::vector<double> sums{ 0, 0, 0 }; // points, P, squared residual
    for (const auto &phase : phases)
      for (const auto &cell : phase.points.cells())
        for (unsigned int p = 0; p < cell.n_points; ++p)
          {
            const double pressure =
                mean_effective_stress(cell.properties + p * phase.points.stride() + phase.layout.stress);
            const auto &coefficients = fits[cell.cell];
            const auto x             = scaled(cell.location[p]);
            double residual          = pressure - coefficients[0];
            for (unsigned int a = 0; a < dim; ++a)
              residual -= coefficients[a + 1] * x[a];
            sums[0] += 1;
            sums[1] += pressure;
            sums[2] += residual * residual;
          }
    Utilities::MPI::sum(sums, mesh.get_communicator(), sums);
    return sums[1] > 0 ? std::sqrt(sums[2] / sums[0]) / (sums[1] / sums[0]) : 0.;
  }


  template <int dim>
  double kinetic_to_elastic_energy(const std::list<Phase<dim>> &phases, const MPI_Comm communicator)
  {
    std::vector<double> energies{ 0, 0 };
    for (const auto &phase : phases)
      for (const auto &cell : phase.points.cells())
        for (unsigned int p = 0; p < cell.n_points; ++p)
          {
            const double *properties = cell.properties + p * phase.points.stride();
            const double mass        = properties[phase.layout.mass];
            for (unsigned int a = 0; a < dim; ++a)
              energies[0] += 0.5 * mass * Utilities::fixed_power<2>(properties[phase.layout.velocity + a]);
            energies[1] +=
                mass / phase.density * phase.material->elastic_energy(properties + phase.layout.left_cauchy_green);
          }
    Utilities::MPI::sum(energies, communicator, energies);
    return energies[1] > 0 ? energies[0] / energies[1] : std::numeric_limits<double>::infinity();
  }

  template double kinetic_to_elastic_energy(const std::list<Phase<2>> &, const MPI_Comm);
  template double kinetic_to_elastic_energy(const std::list<Phase<3>> &, const MPI_Comm);
  template double deviatoric_stress<2>(const double *);
  template double deviatoric_stress<3>(const double *);
  template std::vector<double> mass_percentiles(const std::list<Phase<2>> &,
                                                const BackgroundGrid<2> &,
                                                const unsigned int,
                                                const std::vector<double> &);
  template std::vector<double> mass_percentiles(const std::list<Phase<3>> &,
                                                const BackgroundGrid<3> &,
                                                const unsigned int,
                                                const std::vector<double> &);
  template double stress_oscillation(const std::list<Phase<2>> &, const BackgroundGrid<2> &);
  template double stress_oscillation(const std::list<Phase<3>> &, const BackgroundGrid<3> &);
} // namespace scree

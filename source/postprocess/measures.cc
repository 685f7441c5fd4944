// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/postprocess/measures.h>

#include <scree/postprocess/cell_contents.h>
#include <scree/postprocess/point_sums.h>
#include <scree/tensor/invariants.h>

#include <deal.II/base/mpi.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/lac/vector.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// One quantity of a set of points: where it begins among a point's properties.
    template <int dim>
    struct View
    {
      const PointSet<dim> &points;
      const unsigned int slot;
    };

    template <int dim>
    using Views = std::vector<View<dim>>;

    /// Calls visit(point, first double of the quantity) for each point of this rank.
    template <int dim, typename Visit>
    void visit_points(const Views<dim> &views, const Visit &visit)
    {
      for (const auto &view : views)
        for_each_point(view.points, [&](const auto &point) { visit(point, point.properties + view.slot); });
    }


    template <int dim>
    std::vector<double> percentiles(const Views<dim> &masses,
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
            visit_points(masses, [&](const auto &point, const double *mass) {
              const double position = (point.location[axis] - begin) / (end - begin) * n_bins;
              if (position >= 0 && position < n_bins)
                bins[static_cast<unsigned int>(position)] += *mass;
            });
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


    /// Moments of a cell's points about a common origin: 1, x, x x^T (rows of the normal matrix of a linear fit) and
    /// the same of the pressure.
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


    /// @param pressure_of P or p, Pa, from the quantity of the views
    template <int dim, typename Pressure>
    double oscillation(const Views<dim> &views, const BackgroundGrid<dim> &grid, const Pressure &pressure_of)
    {
      const auto &mesh = grid.triangulation();
      std::vector<Moments<dim>> moments(mesh.n_active_cells());
      const auto scaled = [&](const Point<dim> &x) { return Point<dim>((x - grid.lower_corner()) / grid.cell_size()); };

      visit_points(views, [&](const auto &point, const double *quantity) {
        moments[point.cell].add(scaled(point.location), pressure_of(quantity));
      });

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
                  if (const auto near = patch[i]; holds_nodes(near) && !near->at_boundary(face))
                    patch.push_back(near->neighbor(face));
            Moments<dim> sum;
            for (const auto &near : patch)
              sum += moments[near->active_cell_index()];
            fits[cell->active_cell_index()] = fit(sum);
          }

      std::vector<double> sums{ 0, 0, 0 }; // points, pressure, squared residual
      visit_points(views, [&](const auto &point, const double *quantity) {
        const double pressure    = pressure_of(quantity);
        const auto &coefficients = fits[point.cell];
        const auto x             = scaled(point.location);
        double residual          = pressure - coefficients[0];
        for (unsigned int a = 0; a < dim; ++a)
          residual -= coefficients[a + 1] * x[a];
        sums[0] += 1;
        sums[1] += pressure;
        sums[2] += residual * residual;
      });
      Utilities::MPI::sum(sums, mesh.get_communicator(), sums);
      return sums[1] > 0 ? std::sqrt(sums[2] / sums[0]) / (sums[1] / sums[0]) : 0.;
    }
  } // namespace


  template <int dim>
  std::vector<double> mass_percentiles(const std::list<SoilBody<dim>> &bodies,
                                       const BackgroundGrid<dim> &grid,
                                       const unsigned int axis,
                                       const std::vector<double> &fractions)
  {
    Views<dim> masses;
    for (const auto &body : bodies)
      if (!body.is_rigid)
        masses.push_back({ body.points, body.layout.mass });
    return percentiles(masses, grid, axis, fractions);
  }


  template <int dim>
  std::vector<double> mass_percentiles(const std::list<WaterPhase<dim>> &water,
                                       const BackgroundGrid<dim> &grid,
                                       const unsigned int axis,
                                       const std::vector<double> &fractions)
  {
    Views<dim> masses;
    for (const auto &one : water)
      masses.push_back({ one.points(), one.layout.mass });
    return percentiles(masses, grid, axis, fractions);
  }


  template <int dim>
  double stress_oscillation(const std::list<SoilBody<dim>> &bodies, const BackgroundGrid<dim> &grid)
  {
    Views<dim> stresses;
    for (const auto &body : bodies)
      if (!body.is_rigid)
        stresses.push_back({ body.points, body.layout.stress });
    return oscillation(stresses, grid, [](const double *stress) { return mean_effective_stress(stress); });
  }


  template <int dim>
  double pressure_oscillation(const std::list<WaterPhase<dim>> &water, const BackgroundGrid<dim> &grid)
  {
    Views<dim> pressures;
    for (const auto &one : water)
      pressures.push_back({ one.points(), one.layout.pressure });
    return oscillation(pressures, grid, [](const double *pressure) { return *pressure; });
  }


  template <int dim>
  double least_distance(const std::list<SoilBody<dim>> &bodies,
                        const std::list<WaterPhase<dim>> &water,
                        const DiscreteLevelSet<dim> &surface,
                        const MPI_Comm communicator)
  {
    double least       = surface.reach();
    const auto include = [&](const PointSet<dim> &points) {
      for_each_point(points, [&](const auto &point) {
        least = std::min(least, surface.distance_of(point.cell, point.reference_location, point.location));
      });
    };
    for (const auto &body : bodies)
      if (!body.is_rigid)
        include(body.points);
    for (const auto &part : water)
      if (part.carrier() == nullptr)
        include(part.points());
    return Utilities::MPI::min(least, communicator);
  }


  template <int dim>
  double kinetic_to_elastic_energy(const std::list<SoilBody<dim>> &bodies,
                                   const std::list<WaterPhase<dim>> &water,
                                   const MPI_Comm communicator)
  {
    const PointSums<dim> sums(bodies, water, Tensor<1, dim>(), communicator);
    return sums.elastic > 0 ? sums.kinetic / sums.elastic : std::numeric_limits<double>::infinity();
  }


  template <int dim>
  WaterMeasures measure_water(const std::list<SoilBody<dim>> &bodies,
                              const std::list<WaterPhase<dim>> &water,
                              const BackgroundGrid<dim> &grid)
  {
    const MPI_Comm communicator = grid.triangulation().get_communicator();
    const double cell_volume    = Utilities::fixed_power<dim>(grid.cell_size());
    std::vector<double> sums(5, 0.); // water points, water mass, that outside soil, overfull volume, volume
    for (const CellContents &cell : contents_of_cells(bodies, water, grid))
      {
        const double volume = cell.grain_volume + cell.water_volume;
        sums[0] += cell.n_water_points;
        sums[1] += cell.water_mass;
        sums[2] += cell.n_soil_points == 0 ? cell.water_mass : 0.;
        sums[3] += std::max(0., volume - cell_volume);
        sums[4] += volume;
      }
    Utilities::MPI::sum(sums, communicator, sums);

    std::vector<double> largest(3, -std::numeric_limits<double>::infinity()); // -p, p, x
    for (const auto &one : water)
      for_each_point(one.points(), [&](const auto &point) {
        const double pressure = point.properties[one.layout.pressure];
        largest[0]            = std::max(largest[0], -pressure);
        largest[1]            = std::max(largest[1], pressure);
        largest[2]            = std::max(largest[2], point.location[0]);
      });
    Utilities::MPI::max(largest, communicator, largest);

    WaterMeasures measures;
    measures.n_points          = sums[0];
    measures.mass              = sums[1];
    measures.mass_outside_soil = sums[2];
    measures.smallest_pressure = sums[0] > 0 ? -largest[0] : 0.;
    measures.largest_pressure  = sums[0] > 0 ? largest[1] : 0.;
    measures.tip               = sums[0] > 0 ? largest[2] : grid.lower_corner()[0];
    measures.volume_error      = sums[4] > 0 ? sums[3] / sums[4] : 0.;
    return measures;
  }

  template std::vector<double> mass_percentiles(const std::list<SoilBody<2>> &,
                                                const BackgroundGrid<2> &,
                                                const unsigned int,
                                                const std::vector<double> &);
  template std::vector<double> mass_percentiles(const std::list<WaterPhase<2>> &,
                                                const BackgroundGrid<2> &,
                                                const unsigned int,
                                                const std::vector<double> &);
  template double
  kinetic_to_elastic_energy(const std::list<SoilBody<2>> &, const std::list<WaterPhase<2>> &, const MPI_Comm);
  template double least_distance(const std::list<SoilBody<2>> &,
                                 const std::list<WaterPhase<2>> &,
                                 const DiscreteLevelSet<2> &,
                                 const MPI_Comm);
  template double least_distance(const std::list<SoilBody<3>> &,
                                 const std::list<WaterPhase<3>> &,
                                 const DiscreteLevelSet<3> &,
                                 const MPI_Comm);
  template double stress_oscillation(const std::list<SoilBody<2>> &, const BackgroundGrid<2> &);
  template double pressure_oscillation(const std::list<WaterPhase<2>> &, const BackgroundGrid<2> &);
  template WaterMeasures
  measure_water(const std::list<SoilBody<2>> &, const std::list<WaterPhase<2>> &, const BackgroundGrid<2> &);

  template std::vector<double> mass_percentiles(const std::list<SoilBody<3>> &,
                                                const BackgroundGrid<3> &,
                                                const unsigned int,
                                                const std::vector<double> &);
  template std::vector<double> mass_percentiles(const std::list<WaterPhase<3>> &,
                                                const BackgroundGrid<3> &,
                                                const unsigned int,
                                                const std::vector<double> &);
  template double
  kinetic_to_elastic_energy(const std::list<SoilBody<3>> &, const std::list<WaterPhase<3>> &, const MPI_Comm);
  template double stress_oscillation(const std::list<SoilBody<3>> &, const BackgroundGrid<3> &);
  template double pressure_oscillation(const std::list<WaterPhase<3>> &, const BackgroundGrid<3> &);
  template WaterMeasures
  measure_water(const std::list<SoilBody<3>> &, const std::list<WaterPhase<3>> &, const BackgroundGrid<3> &);
} // namespace scree

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/postprocess/measures.h>
#include <scree/tensor/invariants.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// Moments of a cell's points about a common origin: 1, x, x x^T (the upper half of the normal matrix of a linear
    /// fit, row by row) and the same of the pressure.
    template <int dim>
    struct Moments
    {
      std::array<double, (dim + 1) * (dim + 2) / 2> matrix{};
      std::array<double, dim + 1> rhs{};

      static constexpr unsigned int entry(const unsigned int i, const unsigned int j) // i <= j
      {
        return i * (dim + 1) - i * (i + 1) / 2 + j;
      }

      void add(const Point<dim> &x, const double pressure)
      {
        std::array<double, dim + 1> monomials{ { 1. } };
        for (unsigned int a = 0; a < dim; ++a)
          monomials[a + 1] = x[a];
        for (unsigned int i = 0; i <= dim; ++i)
          {
            for (unsigned int j = i; j <= dim; ++j)
              matrix[entry(i, j)] += monomials[i] * monomials[j];
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

    /// Mean and slopes.
    template <int dim>
    using Fit = std::array<double, dim + 1>;

    /// The linear fit to points, of which there is one at least; slopes that they do not determine are 0.
    template <int dim>
    Fit<dim> fit(const Moments<dim> &moments)
    {
      // Centred normal matrix: 1/n x^T x - mean mean^T.
      const double n = moments.matrix[0];
      Tensor<1, dim> mean, slope;
      SymmetricTensor<2, dim> spread;
      for (unsigned int a = 0; a < dim; ++a)
        mean[a] = moments.matrix[a + 1] / n;
      Tensor<1, dim> covariance;
      for (unsigned int a = 0; a < dim; ++a)
        {
          for (unsigned int b = a; b < dim; ++b)
            spread[a][b] = moments.matrix[Moments<dim>::entry(a + 1, b + 1)] / n - mean[a] * mean[b];
          covariance[a] = moments.rhs[a + 1] / n - mean[a] * moments.rhs[0] / n;
        }
      // Of a cell width squared: the points spread along an axis whose principal value is above.
      constexpr double least = 1e-6;
      if (determinant(spread) > least * Utilities::fixed_power<dim - 1>(trace(spread))) // no value is below
        slope = invert(spread) * covariance;
      else
        for (const auto &[value, axis] : eigenvectors(spread))
          if (value > least)
            slope += (covariance * axis) / value * axis;
      Fit<dim> coefficients;
      coefficients[0] = moments.rhs[0] / n - slope * mean;
      for (unsigned int a = 0; a < dim; ++a)
        coefficients[a + 1] = slope[a];
      return coefficients;
    }


    /// The points of a rank, and the moments of the cells that hold some.
    template <int dim>
    class PressureField
    {
    public:
      explicit PressureField(const BackgroundGrid<dim> &grid)
          : grid(grid)
          , entry_of_cell(grid.triangulation().n_active_cells(), none)
      {
      }

      /// @param slot where a point's quantity begins among its properties
      /// @param pressure_of P or p, Pa, from the quantity
      template <typename Pressure>
      void add(const PointSet<dim> &points, const unsigned int slot, const Pressure &pressure_of)
      {
        for (const auto &cell : points.cells())
          {
            const unsigned int entry = entry_of(cell.cell);
            for_each_point(cell, [&](const auto &point) {
              const Point<dim> x((point.location - grid.lower_corner()) / grid.cell_size());
              samples.push_back({ x, pressure_of(point.properties + slot), entry });
              moments[entry].add(x, samples.back().pressure);
            });
          }
      }

      /// Root mean square of what is left of the pressure after the linear fits around the points' cells, over its
      /// mean. Collective.
      double oscillation()
      {
        const unsigned int n_owned = moments.size();
        if (const MPI_Comm communicator = grid.communicator(); Utilities::MPI::n_mpi_processes(communicator) > 1)
          add_ghosts();
        const std::vector<Fit<dim>> fits = fits_around(n_owned);
        std::vector<double> sums{ 0, 0, 0 }; // points, pressure, squared residual
        for (const Sample &sample : samples)
          {
            const Fit<dim> &coefficients = fits[sample.entry];
            double residual              = sample.pressure - coefficients[0];
            for (unsigned int a = 0; a < dim; ++a)
              residual -= coefficients[a + 1] * sample.x[a];
            sums[0] += 1;
            sums[1] += sample.pressure;
            sums[2] += residual * residual;
          }
        Utilities::MPI::sum(sums, grid.communicator(), sums);
        return sums[1] > 0 ? std::sqrt(sums[2] / sums[0]) / (sums[1] / sums[0]) : 0.;
      }

    private:
      static constexpr unsigned int none        = numbers::invalid_unsigned_int;
      static constexpr unsigned int n_neighbors = Utilities::pow(3, dim); // with the cell itself

      struct Sample
      {
        Point<dim> x; // in cells from the lower corner
        double pressure;
        unsigned int entry;
      };

      unsigned int entry_of(const unsigned int cell)
      {
        unsigned int &entry = entry_of_cell[cell];
        if (entry == none)
          {
            entry = moments.size();
            moments.emplace_back();
            cells.push_back(cell);
          }
        return entry;
      }

      void add_ghosts()
      {
        using Cell     = typename Triangulation<dim>::active_cell_iterator;
        using Optional = std::optional<Moments<dim>>;
        GridTools::exchange_cell_data_to_ghosts<Moments<dim>, parallel::distributed::Triangulation<dim>>(
            grid.triangulation(),
            [&](const Cell &cell) {
              const unsigned int entry = entry_of_cell[cell->active_cell_index()];
              return entry == none ? Optional() : Optional(moments[entry]);
            },
            [&](const Cell &cell, const Moments<dim> &value) { moments[entry_of(cell->active_cell_index())] = value; });
      }

      /// The order in which neighbours, numbered along x first, are added up: axis by axis from the cell itself.
      static std::array<unsigned int, n_neighbors> order_of_sums()
      {
        std::array<unsigned int, n_neighbors> order{ { n_neighbors / 2 } };
        for (unsigned int n = 1, stride = 1; n < n_neighbors; n *= 3, stride *= 3)
          for (unsigned int i = 0; i < n; ++i)
            {
              order[n + 2 * i]     = order[i] - stride;
              order[n + 2 * i + 1] = order[i] + stride;
            }
        return order;
      }

      /// The fits to the points of the first cells and of their neighbours.
      std::vector<Fit<dim>> fits_around(const unsigned int n_owned) const
      {
        // Cells by their number in a box that has a layer more on each side. Along the lines of cells around one, those
        // with points are found by pointers that only go forward.
        using Number = std::int64_t;
        std::array<Number, dim> strides;
        for (unsigned int a = 0; a < dim; ++a)
          strides[a] = a == 0 ? 1 : strides[a - 1] * (grid.fine_cells().box().n[a - 1] + 2);
        std::vector<std::pair<Number, unsigned int>> sorted(moments.size());
        for (unsigned int entry = 0; entry < sorted.size(); ++entry)
          {
            const auto &place = grid.fine_cells().cells()[grid.fine_cells().of_index(cells[entry])].place;
            sorted[entry]     = { 0, entry };
            for (unsigned int a = 0; a < dim; ++a)
              sorted[entry].first += place[a] * strides[a];
          }
        std::sort(sorted.begin(), sorted.end());

        constexpr unsigned int n_lines = n_neighbors / 3;
        std::array<Number, n_lines> middle{}; // of a line, from the cell
        for (unsigned int line = 0; line < n_lines; ++line)
          for (unsigned int a = 1, rest = line; a < dim; ++a, rest /= 3)
            middle[line] += (Number(rest % 3) - 1) * strides[a];
        const auto order = order_of_sums();
        std::array<unsigned int, n_lines> first{};
        std::vector<Fit<dim>> fits(n_owned);
        for (const auto &[number, entry] : sorted)
          {
            std::array<unsigned int, n_neighbors> near;
            near.fill(none);
            for (unsigned int line = 0; line < n_lines; ++line)
              {
                const Number begin = number + middle[line] - 1;
                while (first[line] < sorted.size() && sorted[first[line]].first < begin)
                  ++first[line];
                for (unsigned int i = first[line]; i < sorted.size() && sorted[i].first < begin + 3; ++i)
                  near[3 * line + (sorted[i].first - begin)] = sorted[i].second;
              }
            if (entry >= n_owned)
              continue;
            Moments<dim> sum;
            for (const unsigned int neighbor : order)
              if (near[neighbor] != none)
                sum += moments[near[neighbor]];
            fits[entry] = fit(sum);
          }
        return fits;
      }

      const BackgroundGrid<dim> &grid;
      std::vector<unsigned int> entry_of_cell; // among those with points, by active cell index
      std::vector<unsigned int> cells;         // active cell index by entry; those of this rank first
      std::vector<Moments<dim>> moments;       // by entry
      std::vector<Sample> samples;
    };
  } // namespace


  template <int dim>
  double stress_oscillation(const std::list<SoilBody<dim>> &bodies, const BackgroundGrid<dim> &grid)
  {
    PressureField<dim> field(grid);
    for (const auto &body : bodies)
      if (!body.is_rigid)
        field.add(body.points, body.layout.stress, [](const double *stress) { return mean_effective_stress(stress); });
    return field.oscillation();
  }


  template <int dim>
  double pressure_oscillation(const std::list<WaterPhase<dim>> &water, const BackgroundGrid<dim> &grid)
  {
    PressureField<dim> field(grid);
    for (const auto &one : water)
      field.add(one.points(), one.layout.pressure, [](const double *pressure) { return *pressure; });
    return field.oscillation();
  }

  template double stress_oscillation(const std::list<SoilBody<2>> &, const BackgroundGrid<2> &);
  template double stress_oscillation(const std::list<SoilBody<3>> &, const BackgroundGrid<3> &);
  template double pressure_oscillation(const std::list<WaterPhase<2>> &, const BackgroundGrid<2> &);
  template double pressure_oscillation(const std::list<WaterPhase<3>> &, const BackgroundGrid<3> &);
} // namespace scree

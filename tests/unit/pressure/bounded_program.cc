// SPDX-License-Identifier: LGPL-2.1-or-later

// The quadratic program of pressures and tractions, on random matrices, bounds and rows, of which one is there twice:
// the solution meets the conditions of Karush, Kuhn and Tucker, the search for what is held ends by itself, and no
// start makes more energy than it had.
#include "../test.h"

#include <scree/pressure/bounded_program.h>

#include <deal.II/lac/full_matrix.h>

namespace test_bounded_program
{
template <int dim>
class Problem
{
public:
  using Vectors = PressuresAndTractions<dim>;

  explicit Problem(RandomNumbers &random)
      : n_pressures(random.uniform(0., 12.))
      , n_rows(random.uniform(0., 12.))
      , matrix(n_pressures + dim * n_rows)
      , program(
            MPI_COMM_SELF,
            [this](Vectors &target, const Vectors &source) { multiply(target, source); },
            [this](Vectors &target, const Vectors &source) { precondition(target, source); })
  {
    make_rows(random);
    make_matrix(random);
    for (unsigned int i = 0; i < n_pressures; ++i)
      {
        least.push_back(random.uniform(-1., 0.5));
        diagonal.push_back(matrix(i, i));
      }
  }

  /// Solves it and requires what a solution is.
  void solve(RandomNumbers &random, const std::string &name)
  {
    program.begin(n_pressures, &rows);
    for (unsigned int i = 0; i < n_pressures; ++i)
      {
        program.source.pressures[i]   = random.uniform(-1., 1.);
        program.solution.pressures[i] = random.uniform(-1., 1.);
      }
    for (unsigned int k = 0; k < n_rows; ++k)
      {
        program.source.tractions[k]   = random.point<dim>(-1., 1.);
        program.solution.tractions[k] = rows[k].held_part(random.point<dim>(-1., 1.));
      }
    if (n_rows > 1)
      program.source.tractions.back() = program.source.tractions[n_rows - 2];
    const double accepted = 1e-8 * std::sqrt(program.source * program.source);
    program.set_bounds(least, diagonal);
    const double before = energy();
    program.find_residual();
    const auto result = program.iterate(10 * program.most_of_search, accepted);
    require(result.residual <= accepted, name + " has not converged");
    require(result.n < program.most_of_search, name + " searches for " + std::to_string(result.n) + " iterations");
    require(energy() <= before + 1e-12 * std::abs(before), name + " gains energy");
    program.find_residual();
    constexpr double rounding = 10.; // of the residual that the iterations have summed
    for (unsigned int i = 0; i < n_pressures; ++i)
      {
        const double p = program.solution.pressures[i], r = program.residual().pressures[i];
        require(p >= least[i], name + " has a pressure below its bound");
        require((p == least[i] ? r : std::abs(r)) <= rounding * accepted, name + " leaves flow at a pressure");
      }
    for (unsigned int k = 0; k < n_rows; ++k)
      {
        const GroundRow<dim> &row = rows[k];
        const Tensor<1, dim> flow = program.residual().tractions[k];
        const double pressing     = program.solution.tractions[k] * row.normal;
        require(row.holds_across || std::abs(pressing) < 1e-10, name + " has a traction at a row that lifts off");
        require(!row.is_unilateral || pressing > -1e-10, name + " has a row that pulls");
        require((row.holds_across ? std::abs(flow * row.normal) : flow * row.normal) <= rounding * accepted,
                name + " leaves flow into a row");
        require(!row.holds_along || row.along(flow).norm() <= rounding * accepted, name + " leaves flow along a row");
      }
  }

private:
  void make_rows(RandomNumbers &random)
  {
    for (unsigned int k = 0; k < n_rows; ++k)
      {
        GroundRow<dim> row{};
        row.normal = random.point<dim>(-1., 1.);
        row.normal /= row.normal.norm();
        row.is_unilateral = random.uniform(0., 1.) < 0.7;
        row.holds_across  = true;
        row.holds_along   = random.uniform(0., 1.) < 0.5;
        row.compliance    = row.holds_along ? std::max(0., random.uniform(-1., 1.)) : 0.;
        rows.push_back(row);
      }
  }

  /// Of random directions of different size; the last row is the one before it.
  void make_matrix(RandomNumbers &random)
  {
    const unsigned int n = matrix.m();
    FullMatrix<double> directions(2 * n, n);
    for (unsigned int i = 0; i < directions.m(); ++i)
      {
        const double size = random.log_uniform(0.1, 1.);
        for (unsigned int j = 0; j < n; ++j)
          directions(i, j) = size * random.uniform(-1., 1.);
        for (unsigned int c = 0; c < dim && n_rows > 1; ++c)
          directions(i, n - dim + c) = directions(i, n - 2 * dim + c);
      }
    if (n_rows > 1)
      rows.back() = rows[n_rows - 2];
    if (n > 0)
      directions.Tmmult(matrix, directions);
    for (unsigned int k = 0; k < n_rows; ++k)
      {
        for (unsigned int c = 0; c < dim; ++c)
          rows[k].diagonal += matrix(place(k, c), place(k, c)) / dim;
        for (unsigned int c = 0; c < dim; ++c)
          matrix(place(k, c), place(k, c)) += 1e-6 * rows[k].diagonal;
      }
    for (unsigned int i = 0; i < n_pressures; ++i)
      matrix(i, i) *= 1. + 1e-6;
  }

  unsigned int place(const unsigned int row, const unsigned int component) const
  {
    return n_pressures + dim * row + component;
  }

  Vector<double> numbers_of(const Vectors &vectors) const
  {
    Vector<double> result(matrix.m());
    for (unsigned int i = 0; i < n_pressures; ++i)
      result[i] = vectors.pressures[i];
    for (unsigned int k = 0; k < n_rows; ++k)
      for (unsigned int c = 0; c < dim; ++c)
        result[place(k, c)] = vectors.tractions[k][c];
    return result;
  }

  void multiply(Vectors &target, const Vectors &source) const
  {
    Vector<double> product(matrix.m());
    if (product.size() > 0)
      matrix.vmult(product, numbers_of(source));
    for (unsigned int i = 0; i < n_pressures; ++i)
      target.pressures[i] = product[i];
    for (unsigned int k = 0; k < n_rows; ++k)
      {
        for (unsigned int c = 0; c < dim; ++c)
          target.tractions[k][c] = product[place(k, c)];
        if (rows[k].holds_along)
          target.tractions[k] += rows[k].compliance * rows[k].along(source.tractions[k]);
      }
  }

  void precondition(Vectors &target, const Vectors &source) const
  {
    for (unsigned int i = 0; i < n_pressures; ++i)
      target.pressures[i] = source.pressures[i] / matrix(i, i);
    for (unsigned int k = 0; k < n_rows; ++k)
      target.tractions[k] = rows[k].traction_of(source.tractions[k]);
  }

  double energy()
  {
    Vectors product = program.solution;
    multiply(product, program.solution);
    return 0.5 * (program.solution * product) - program.solution * program.source;
  }

  const unsigned int n_pressures, n_rows;
  std::vector<GroundRow<dim>> rows;
  FullMatrix<double> matrix;
  std::vector<double> least, diagonal;
  BoundedProgram<dim> program;
};


template <int dim>
void run_of_dimension()
{
  RandomNumbers random;
  for (unsigned int i = 0; i < 500; ++i)
    Problem<dim>(random).solve(random, std::to_string(dim) + "D, problem " + std::to_string(i));
}


const UnitTest registered("bounded_program", [] {
  run_of_dimension<2>();
  run_of_dimension<3>();
});
} // namespace test_bounded_program

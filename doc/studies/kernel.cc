// SPDX-License-Identifier: LGPL-2.1-or-later
// A yardstick for the speed of a machine: the material point method for one elastic block with nothing around it,
// written by hand for that alone. Quadratic B-splines on a box of equal cells, FLIP, neo-Hookean points, 16 a cell in
// 2D and 8 in 3D; their numbers are sorted by cell in each step, their records every 16. No bodies, laws, walls but a
// floor, ranks, outputs. It prints dimension, points, steps, ns of processor time per point and step (smallest and
// median of the 9 parts of the run) and the block's mean height.
//
//   c++ -std=gnu++17 -O3 -march=native -ffast-math -o kernel kernel.cc && ./kernel 2 && ./kernel 3
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <vector>

namespace
{
  using Vector = double __attribute__((vector_size(64))); // mass, momentum, force; or velocity, its change

  constexpr double young = 5e4, poisson = 0.3, density = 1000., gravity = 9.81;
  constexpr double shear = young / 2 / (1 + poisson), bulk = young / 3 / (1 - 2 * poisson);

  template <int dim>
  struct Point
  {
    double x[dim], v[dim], tau[dim][dim];
    std::array<std::array<double, dim>, dim> F;
  };

  /// Splines of the three nodes of an axis and their slopes, at s from 0 to 1 in the cell.
  struct Weights
  {
    double value[3], slope[3];
    Weights(const double s, const double per_width)
        : value{ 0.5 * (1 - s) * (1 - s), 0.5 + s * (1 - s), 0.5 * s * s }
        , slope{ (s - 1) * per_width, (1 - 2 * s) * per_width, s * per_width }
    {
    }
  };

  template <int dim>
  class Block
  {
  public:
    /// @param n cells along an axis of the block, which stands on the floor in the middle of a box twice as wide
    explicit Block(const int n)
        : n(2 * n)
        , nodes_of_axis(2 * n + 2)
        , width(0.64 / n)
        , volume(std::pow(width / per_axis, dim))
    {
      int n_nodes = 1, n_cells = 1;
      for (int a = 0; a < dim; ++a)
        {
          n_nodes *= nodes_of_axis;
          n_cells *= this->n;
        }
      nodes.resize(n_nodes);
      first.resize(n_cells + 1);
      for (int i = 0; i < std::pow(n * per_axis, dim); ++i)
        {
          Point<dim> point{};
          for (int a = 0, rest = i; a < dim; ++a, rest /= n * per_axis)
            {
              point.x[a]    = (rest % (n * per_axis) + 0.5) * width / per_axis + (a < dim - 1 ? n / 2 * width : 0.);
              point.F[a][a] = 1;
            }
          points.push_back(point);
        }
      cell_of.resize(points.size());
      order.resize(points.size());
      sort(true);
    }

    void step(const bool reorders)
    {
      const double time_step = 0.3 * width / std::sqrt((bulk + 4. / 3 * shear) / density);
      std::fill(nodes.begin(), nodes.end(), Vector{});
      for_each_cell([&](const int node, const int begin, const int end) { to_nodes(node, begin, end); });
      move_nodes(time_step);
      for_each_cell([&](const int node, const int begin, const int end) { to_points(node, begin, end, time_step); });
      sort(reorders);
    }

    std::size_t n_points() const
    {
      return points.size();
    }

    /// Of all points, m.
    double height() const
    {
      double sum = 0;
      for (const auto &point : points)
        sum += point.x[dim - 1];
      return sum / points.size();
    }

  private:
    static constexpr int per_axis = dim == 2 ? 4 : 2, n_rows = dim == 2 ? 3 : 9;

    template <class Work>
    void for_each_cell(const Work &work)
    {
      for (unsigned int cell = 0; cell + 1 < first.size(); ++cell)
        if (first[cell] < first[cell + 1])
          {
            int node = 0;
            for (int a = 0, rest = cell, stride = 1; a < dim; ++a, rest /= n, stride *= nodes_of_axis)
              node += rest % n * stride;
            work(node, first[cell], first[cell + 1]);
          }
    }

    /// The first node of a row of three.
    int row(const int node, const int r) const
    {
      return node + r % 3 * nodes_of_axis + r / 3 * nodes_of_axis * nodes_of_axis;
    }

    std::array<Weights, 3> weights(const Point<dim> &point) const
    {
      const auto of = [&](const int a) {
        const double s = point.x[a] / width;
        return Weights(s - int(s), 1 / width);
      };
      return { of(0), of(1), dim == 3 ? of(dim - 1) : Weights(0, 0) };
    }

    void to_nodes(const int node, const int begin, const int end)
    {
      Vector sums[n_rows][3];
      for (int r = 0; r < n_rows; ++r)
        for (int i = 0; i < 3; ++i)
          sums[r][i] = nodes[row(node, r) + i];
      for (int p = begin; p < end; ++p)
        {
          const Point<dim> &point = points[order[p]];
          const auto w            = weights(point);
          Vector motion{}, stress[dim]{};
          motion[0] = density * volume;
          for (int a = 0; a < dim; ++a)
            {
              motion[1 + a] = density * volume * point.v[a];
              for (int b = 0; b < dim; ++b)
                stress[b][1 + dim + a] = -volume * point.tau[a][b];
            }
          for (int i = 0; i < 3; ++i)
            {
              const Vector x = w[0].value[i] * motion + w[0].slope[i] * stress[0], x1 = w[0].value[i] * stress[1],
                           x2 = dim == 3 ? w[0].value[i] * stress[dim - 1] : Vector{};
              for (int j = 0; j < 3; ++j)
                {
                  const Vector y = w[1].value[j] * x + w[1].slope[j] * x1;
                  if (dim == 2)
                    sums[j][i] += y;
                  else
                    for (int k = 0; k < 3; ++k)
                      sums[3 * k + j][i] += w[2].value[k] * y + w[2].slope[k] * w[1].value[j] * x2;
                }
            }
        }
      for (int r = 0; r < n_rows; ++r)
        for (int i = 0; i < 3; ++i)
          nodes[row(node, r) + i] = sums[r][i];
    }

    void move_nodes(const double time_step)
    {
      const int floor = 2 * nodes.size() / nodes_of_axis; // nodes below and at the floor, almost
      for (int i = 0; i < int(nodes.size()); ++i)
        if (const double mass = nodes[i][0]; mass > 0)
          {
            Vector result{};
            for (int a = 0; a < dim; ++a)
              {
                const double change = time_step * (nodes[i][1 + dim + a] / mass - (a == dim - 1 ? gravity : 0.));
                const double before = nodes[i][1 + a] / mass;
                result[a]           = i < floor ? 0. : before + change;
                result[dim + a]     = result[a] - before;
              }
            nodes[i] = result;
          }
    }

    void to_points(const int node, const int begin, const int end, const double time_step)
    {
      Vector local[n_rows][3];
      for (int r = 0; r < n_rows; ++r)
        for (int i = 0; i < 3; ++i)
          local[r][i] = nodes[row(node, r) + i];
      for (int p = begin; p < end; ++p)
        {
          Point<dim> &point = points[order[p]];
          const auto w      = weights(point);
          Vector value{}, slope[dim]{};
          for (int k = 0; k < (dim == 2 ? 1 : 3); ++k)
            {
              Vector plane{}, along_x{}, along_y{};
              for (int j = 0; j < 3; ++j)
                {
                  Vector line{}, along{};
                  for (int i = 0; i < 3; ++i)
                    {
                      line += w[0].value[i] * local[3 * k + j][i];
                      along += w[0].slope[i] * local[3 * k + j][i];
                    }
                  plane += w[1].value[j] * line;
                  along_x += w[1].value[j] * along;
                  along_y += w[1].slope[j] * line;
                }
              const double z = dim == 2 ? 1 : w[2].value[k];
              value += z * plane;
              slope[0] += z * along_x;
              slope[1] += z * along_y;
              if (dim == 3)
                slope[dim - 1] += w[2].slope[k] * plane;
            }
          for (int a = 0; a < dim; ++a)
            {
              point.x[a] += time_step * value[a];
              point.v[a] += value[dim + a];
            }
          update_stress(point, slope, time_step);
        }
    }

    /// Neo-Hookean: tau = G (F F^T - 1) + lambda/2 (J^2 - 1).
    static void update_stress(Point<dim> &point, const Vector *slope, const double time_step)
    {
      double b[dim][dim];
      std::array<std::array<double, dim>, dim> F;
      for (int a = 0; a < dim; ++a)
        for (int c = 0; c < dim; ++c)
          {
            F[a][c] = point.F[a][c];
            for (int k = 0; k < dim; ++k)
              F[a][c] += time_step * slope[k][a] * point.F[k][c];
          }
      point.F = F;
      for (int a = 0; a < dim; ++a)
        for (int c = 0; c < dim; ++c)
          {
            b[a][c] = 0;
            for (int k = 0; k < dim; ++k)
              b[a][c] += F[a][k] * F[c][k];
          }
      const double J    = dim == 2 ? F[0][0] * F[1][1] - F[0][1] * F[1][0]
                                   : F[0][0] * (F[1][1] * F[2 % dim][2 % dim] - F[1][2 % dim] * F[2 % dim][1]) -
                                      F[0][1] * (F[1][0] * F[2 % dim][2 % dim] - F[1][2 % dim] * F[2 % dim][0]) +
                                      F[0][2 % dim] * (F[1][0] * F[2 % dim][1] - F[1][1] * F[2 % dim][0]);
      const double mean = 0.5 * (bulk - 2. / 3 * shear) * (J * J - 1) - shear;
      for (int a = 0; a < dim; ++a)
        for (int c = 0; c < dim; ++c)
          point.tau[a][c] = shear * b[a][c] + (a == c ? mean : 0.);
    }

    void sort(const bool reorders)
    {
      std::fill(first.begin(), first.end(), 0);
      for (unsigned int p = 0; p < points.size(); ++p)
        {
          int cell = 0;
          for (int a = 0, stride = 1; a < dim; ++a, stride *= n)
            cell += int(points[p].x[a] / width) * stride;
          cell_of[p] = cell;
          ++first[cell + 1];
        }
      for (unsigned int cell = 1; cell < first.size(); ++cell)
        first[cell] += first[cell - 1];
      auto next = first;
      for (unsigned int p = 0; p < points.size(); ++p)
        order[next[cell_of[p]]++] = p;
      if (reorders)
        {
          std::vector<Point<dim>> ordered;
          ordered.reserve(points.size());
          for (unsigned int p = 0; p < points.size(); ++p)
            {
              ordered.push_back(points[order[p]]);
              cell_of[p] = p;
            }
          points.swap(ordered);
          std::copy(cell_of.begin(), cell_of.end(), order.begin());
        }
    }

    const int n, nodes_of_axis;
    const double width, volume;
    std::vector<Vector> nodes;
    std::vector<Point<dim>> points;
    std::vector<int> first, cell_of, order;
  };

  template <int dim>
  void run()
  {
    Block<dim> block(dim == 2 ? 64 : 24);
    constexpr int n_parts = 9, n_steps = dim == 2 ? 96 : 48;
    std::vector<double> ns;
    for (int part = 0; part < n_parts; ++part)
      {
        const std::clock_t start = std::clock();
        for (int step = 0; step < n_steps; ++step)
          block.step(step % 16 == 15);
        ns.push_back(1e9 / CLOCKS_PER_SEC * (std::clock() - start) / n_steps / block.n_points());
      }
    std::sort(ns.begin(), ns.end());
    std::printf(
        "%d %zu %d %.2f %.2f %.6f\n", dim, block.n_points(), n_parts * n_steps, ns[0], ns[n_parts / 2], block.height());
  }
} // namespace

int main(int argc, char *argv[])
{
  if (argc == 2 && std::atoi(argv[1]) == 2)
    run<2>();
  else if (argc == 2 && std::atoi(argv[1]) == 3)
    run<3>();
  else
    {
      std::fprintf(stderr, "kernel: write the dimension, 2 or 3\n");
      return 1;
    }
}

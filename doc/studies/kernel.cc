// SPDX-License-Identifier: LGPL-2.1-or-later
// A yardstick for the speed of a machine: the material point method for one elastic block with nothing around it,
// written by hand for that alone. Quadratic B-splines on a box of equal cells, FLIP, neo-Hookean points, 16 a cell in
// 2D and 8 in 3D. Points of a cell lie in packs of eight, one in each lane of a vector; a point that leaves its cell
// moves to a free lane of the next one. No bodies, laws, walls but a floor, ranks, outputs. It prints dimension,
// points, steps, ns of processor time per point and step (smallest and median of the 9 parts of the run) and the
// block's mean height.
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
  using Vector = double __attribute__((vector_size(64))); // of eight points; or of a node, see Block::nodes
  using Lanes  = long __attribute__((vector_size(64)));   // -1 where true

  constexpr double young = 5e4, poisson = 0.3, density = 1000., gravity = 9.81;
  constexpr double shear = young / 2 / (1 + poisson), bulk = young / 3 / (1 - 2 * poisson);

  /// The sums over the lanes of up to eight vectors, one behind the other.
  inline Vector sums_of_lanes(const Vector *values, const int n)
  {
    const auto two = [&](const int i) {
      const Vector a = values[i], b = i + 1 < n ? values[i + 1] : Vector{};
      return __builtin_shuffle(a, b, Lanes{ 0, 8, 2, 10, 4, 12, 6, 14 }) +
             __builtin_shuffle(a, b, Lanes{ 1, 9, 3, 11, 5, 13, 7, 15 });
    };
    const auto four = [&](const int i) {
      const Vector a = two(i), b = i + 2 < n ? two(i + 2) : Vector{};
      return __builtin_shuffle(a, b, Lanes{ 0, 1, 8, 9, 4, 5, 12, 13 }) +
             __builtin_shuffle(a, b, Lanes{ 2, 3, 10, 11, 6, 7, 14, 15 });
    };
    const Vector a = four(0), b = four(4);
    return __builtin_shuffle(a, b, Lanes{ 0, 1, 2, 3, 8, 9, 10, 11 }) +
           __builtin_shuffle(a, b, Lanes{ 4, 5, 6, 7, 12, 13, 14, 15 });
  }

  /// Splines of the three nodes of an axis and their slopes, at s from 0 to 1 in the cell.
  struct Weights
  {
    Vector value[3], slope[3];
    Weights(const Vector &s, const double per_width)
        : value{ 0.5 * (1. - s) * (1. - s), 0.5 + s * (1. - s), 0.5 * s * s }
        , slope{ (s - 1.) * per_width, (1. - 2. * s) * per_width, s * per_width }
    {
    }
  };

  template <int dim>
  struct Pack
  {
    static constexpr int n_values = 2 * dim + dim * dim + 1;
    Vector x[dim], v[dim], F[dim][dim], volume; // a free lane has no volume

    double *lane(const int l) // its values are eight apart
    {
      return reinterpret_cast<double *>(this) + l;
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
    {
      int n_nodes = 1, n_cells = 1;
      for (int a = 0; a < dim; ++a)
        {
          n_nodes *= nodes_of_axis;
          n_cells *= this->n;
        }
      nodes.resize(n_nodes);
      packs.resize(n_cells * packs_of_cell);
      n_used.resize(n_cells);
      for (int i = 0; i < std::pow(n * per_axis, dim); ++i)
        {
          Leaver point{};
          for (int a = 0, rest = i; a < dim; ++a, rest /= n * per_axis)
            {
              point.values[a] = (rest % (n * per_axis) + 0.5) * width / per_axis + (a < dim - 1 ? n / 2 * width : 0.);
              point.values[2 * dim + a * (dim + 1)] = 1;
            }
          point.values[Pack<dim>::n_values - 1] = std::pow(width / per_axis, dim);
          leavers.push_back(point);
        }
      n_points = leavers.size();
      enter_cells();
    }

    void step()
    {
      const double time_step = 0.3 * width / std::sqrt((bulk + 4. / 3 * shear) / density);
      std::fill(nodes.begin(), nodes.end(), Vector{});
      for_each_cell([&](const int node, const int cell, const int *place) { to_nodes(node, cell, place); });
      move_nodes(time_step);
      for_each_cell([&](const int node, const int cell, const int *place) { to_points(node, cell, place, time_step); });
      enter_cells();
    }

    /// Of all points, m.
    double height()
    {
      double sum = 0;
      for (auto &pack : packs)
        for (int l = 0; l < 8; ++l)
          sum += pack.volume[l] > 0 ? pack.x[dim - 1][l] : 0.;
      return sum / n_points;
    }

    std::size_t n_points;

  private:
    static constexpr int per_axis = dim == 2 ? 4 : 2, n_planes = dim == 2 ? 1 : 3;
    static constexpr int packs_of_cell = dim == 2 ? 4 : 3;

    /// A point on its way from cell to cell.
    struct Leaver
    {
      double values[Pack<dim>::n_values];
    };

    template <class Work>
    void for_each_cell(const Work &work)
    {
      for (unsigned int cell = 0; cell < n_used.size(); ++cell)
        if (n_used[cell] > 0)
          {
            int node = 0, place[3] = {};
            for (int a = 0, rest = cell, stride = 1; a < dim; ++a, rest /= n, stride *= nodes_of_axis)
              node += (place[a] = rest % n) * stride;
            work(node, cell, place);
          }
    }

    int row(const int node, const int j, const int k) const
    {
      return node + (j + k * nodes_of_axis) * nodes_of_axis;
    }

    std::array<Weights, 3> weights(const Pack<dim> &pack, const int *place) const
    {
      const auto of = [&](const int a) { return Weights(pack.x[a] / width - double(place[a]), 1 / width); };
      return { of(0), of(1), dim == 3 ? of(dim - 1) : Weights(Vector{}, 0.) };
    }

    void to_nodes(const int node, const int cell, const int *place)
    {
      for (int p = 0; p < n_used[cell]; ++p)
        {
          const Pack<dim> &pack = packs[cell * packs_of_cell + p];
          const auto w          = weights(pack, place);
          Vector momentum[dim], stress[dim][dim];
          const Vector mass = density * pack.volume;
          for (int a = 0; a < dim; ++a)
            momentum[a] = mass * pack.v[a];
          set_stress(pack, stress);
          for (int k = 0; k < n_planes; ++k)
            for (int j = 0; j < 3; ++j)
              {
                const Vector yz = dim == 2 ? w[1].value[j] : w[1].value[j] * w[2].value[k];
                const Vector y1 = dim == 2 ? w[1].slope[j] : w[1].slope[j] * w[2].value[k];
                Vector force[dim], along[dim];
                for (int a = 0; a < dim; ++a)
                  {
                    along[a] = yz * stress[a][0];
                    force[a] = y1 * stress[a][1];
                    if (dim == 3)
                      force[a] += w[1].value[j] * w[2].slope[k] * stress[a][dim - 1];
                  }
                for (int i = 0; i < 3; ++i)
                  {
                    const Vector weight = w[0].value[i] * yz;
                    Vector sums[8];
                    sums[0] = weight * mass;
                    for (int a = 0; a < dim; ++a)
                      {
                        sums[1 + a]       = weight * momentum[a];
                        sums[1 + dim + a] = w[0].value[i] * force[a] + w[0].slope[i] * along[a];
                      }
                    nodes[row(node, j, k) + i] += sums_of_lanes(sums, 1 + 2 * dim);
                  }
              }
        }
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

    void to_points(const int node, const int cell, const int *place, const double time_step)
    {
      for (int p = 0; p < n_used[cell]; ++p)
        {
          Pack<dim> &pack = packs[cell * packs_of_cell + p];
          const auto w    = weights(pack, place);
          Vector value[2 * dim]{}, slope[dim][dim]{};
          for (int k = 0; k < n_planes; ++k)
            for (int j = 0; j < 3; ++j)
              {
                Vector line[2 * dim]{}, along[dim]{};
                for (int i = 0; i < 3; ++i)
                  {
                    const Vector &at = nodes[row(node, j, k) + i];
                    for (int a = 0; a < 2 * dim; ++a)
                      line[a] += w[0].value[i] * at[a];
                    for (int a = 0; a < dim; ++a)
                      along[a] += w[0].slope[i] * at[a];
                  }
                const Vector yz = dim == 2 ? w[1].value[j] : w[1].value[j] * w[2].value[k];
                const Vector y1 = dim == 2 ? w[1].slope[j] : w[1].slope[j] * w[2].value[k];
                for (int a = 0; a < 2 * dim; ++a)
                  value[a] += yz * line[a];
                for (int a = 0; a < dim; ++a)
                  {
                    slope[a][0] += yz * along[a];
                    slope[a][1] += y1 * line[a];
                    if (dim == 3)
                      slope[a][dim - 1] += w[1].value[j] * w[2].slope[k] * line[a];
                  }
              }
          const auto before = pack;
          for (int a = 0; a < dim; ++a)
            {
              pack.v[a] += value[dim + a];
              pack.x[a] += time_step * value[a];
              for (int c = 0; c < dim; ++c)
                for (int m = 0; m < dim; ++m)
                  pack.F[a][c] += time_step * slope[a][m] * before.F[m][c];
            }
          take_leavers(pack, place);
        }
      while (n_used[cell] > 0 && is_free(packs[cell * packs_of_cell + n_used[cell] - 1]))
        --n_used[cell];
    }

    /// Neo-Hookean: tau = G (F F^T - 1) + lambda/2 (J^2 - 1), times minus the volume.
    static void set_stress(const Pack<dim> &pack, Vector (&stress)[dim][dim])
    {
      const auto &F     = pack.F;
      constexpr int z   = dim - 1;
      const Vector J    = dim == 2 ? F[0][0] * F[1][1] - F[0][1] * F[1][0]
                                   : F[0][0] * (F[1][1] * F[z][z] - F[1][z] * F[z][1]) -
                                      F[0][1] * (F[1][0] * F[z][z] - F[1][z] * F[z][0]) +
                                      F[0][z] * (F[1][0] * F[z][1] - F[1][1] * F[z][0]);
      const Vector mean = 0.5 * (bulk - 2. / 3 * shear) * (J * J - 1.) - shear;
      for (int a = 0; a < dim; ++a)
        for (int c = 0; c <= a; ++c)
          {
            Vector b{};
            for (int k = 0; k < dim; ++k)
              b += F[a][k] * F[c][k];
            stress[a][c] = stress[c][a] = (shear * b + (a == c ? mean : Vector{})) * -pack.volume;
          }
    }

    static bool is_free(const Pack<dim> &pack)
    {
      for (int l = 0; l < 8; ++l)
        if (pack.volume[l] > 0)
          return false;
      return true;
    }

    void take_leavers(Pack<dim> &pack, const int *place)
    {
      Lanes left{};
      for (int a = 0; a < dim; ++a)
        left |= (pack.x[a] < place[a] * width) | (pack.x[a] >= (place[a] + 1) * width);
      long any = 0;
      for (int l = 0; l < 8; ++l)
        any |= left[l];
      for (int l = 0; any && l < 8; ++l)
        if (left[l])
          {
            if (pack.volume[l] > 0)
              {
                leavers.emplace_back();
                for (int i = 0; i < Pack<dim>::n_values; ++i)
                  leavers.back().values[i] = pack.lane(l)[8 * i];
              }
            set_free(pack, l, place); // free lanes move, too
          }
    }

    void set_free(Pack<dim> &pack, const int l, const int *place)
    {
      for (int i = 0; i < Pack<dim>::n_values; ++i)
        pack.lane(l)[8 * i] = 0.;
      for (int a = 0; a < dim; ++a)
        {
          pack.x[a][l]    = (place[a] + 0.5) * width;
          pack.F[a][a][l] = 1.;
        }
    }

    /// Puts the points that have left their cells into free lanes of those they are in.
    void enter_cells()
    {
      for (const Leaver &point : leavers)
        {
          int cell = 0, place[3] = {};
          for (int a = 0, stride = 1; a < dim; ++a, stride *= n)
            cell += (place[a] = int(point.values[a] / width)) * stride;
          int l = 0;
          while (l < 8 * n_used[cell] && packs[cell * packs_of_cell + l / 8].volume[l % 8] > 0)
            ++l;
          if (l == 8 * packs_of_cell)
            {
              std::fprintf(stderr, "kernel: a cell has more points than packs\n");
              std::exit(1);
            }
          Pack<dim> &pack = packs[cell * packs_of_cell + l / 8];
          if (l == 8 * n_used[cell])
            {
              ++n_used[cell];
              for (int other = 0; other < 8; ++other)
                set_free(pack, other, place);
            }
          for (int i = 0; i < Pack<dim>::n_values; ++i)
            pack.lane(l % 8)[8 * i] = point.values[i];
        }
      leavers.clear();
    }

    const int n, nodes_of_axis;
    const double width;
    std::vector<Vector> nodes;    // mass, momentum, force; or velocity, its change
    std::vector<Pack<dim>> packs; // `packs_of_cell` of each cell
    std::vector<int> n_used;      // of the packs of a cell
    std::vector<Leaver> leavers;
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
          block.step();
        ns.push_back(1e9 / CLOCKS_PER_SEC * (std::clock() - start) / n_steps / block.n_points);
      }
    std::sort(ns.begin(), ns.end());
    std::printf(
        "%d %zu %d %.2f %.2f %.6f\n", dim, block.n_points, n_parts * n_steps, ns[0], ns[n_parts / 2], block.height());
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

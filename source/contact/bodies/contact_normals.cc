// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/contact/bodies/contact_normals.h>

#include <deal.II/base/symmetric_tensor.h>

#include <algorithm>
#include <cmath>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// The plane of the regression, the last of the normals to choose from, leans towards the axes: it is taken if the
    /// gap along it is the widest by this margin, cell widths, as at the edges of two bodies.
    constexpr unsigned int regression = 2;
    constexpr double margin           = 0.1;

    /// Gaps within this, cell widths, count as equal, which keeps symmetric set-ups symmetric.
    constexpr double tie = 1e-6;

    /// Cosine of the angle from which on two normals are those of different faces.
    constexpr double same_face = 0.9;
  } // namespace


  template <int dim>
  ContactNormals<dim>::ContactNormals(const BackgroundGrid<dim> &grid,
                                      const BodyGroup<dim> &first,
                                      const BodyGroup<dim> &second,
                                      const ContactPair &pair,
                                      const std::list<SoilBody<dim>> &bodies)
      : grid(grid)
      , groups{ { first, second } }
      , friction_coefficients(pair.friction_coefficients)
      , rough_side(pair.rough == pair.first ? 0 : 1)
      , bodies(bodies)
      , sums(grid.numbering())
      , normals(grid.numbering())
      , averages(grid.numbering())
  {
  }


  template <int dim>
  void ContactNormals<dim>::reinit()
  {
    sums.reinit();
    normals.reinit();
    averages.reinit();
  }


  template <int dim>
  void ContactNormals<dim>::find_cells()
  {
    constexpr char unknown = 2;
    is_shared.assign(grid.numbering().n_local(), unknown);
    cells.clear();
    auto friction = friction_coefficients.begin();
    for (const auto &body : bodies)
      {
        for (unsigned int side = 0; side < 2; ++side)
          if (body.group == groups[side].number)
            for (const auto &cell : body.points.cells())
              {
                bool any = false;
                for (unsigned int i = 0; i < grid.n_nodes_per_cell(); ++i)
                  {
                    const unsigned int node = grid.nodes(cell.cell)[i];
                    if (is_shared[node] == unknown)
                      is_shared[node] = groups[0].acts_on(node) && groups[1].acts_on(node);
                    any = any || is_shared[node];
                  }
                if (any)
                  cells.push_back({ side, &cell, *friction });
              }
        ++friction;
      }
  }


  template <int dim>
  void ContactNormals<dim>::find_normals_of(const unsigned int node)
  {
    const double *moments = sums[node];
    double *of_node       = normals[node];
    if (moments[0] <= 0. || moments[Moments::n_moments] <= 0.)
      return;
    SymmetricTensor<2, dim> covariance;
    Tensor<1, dim> between;
    for (unsigned int side = 0; side < 2; ++side)
      {
        const double *own         = moments + side * Moments::n_moments;
        const Tensor<1, dim> mean = vector_of<dim>(own + Moments::first_moments) / own[0];
        between += (side == 0 ? -1. : 1.) * mean;
        for (unsigned int a = 0, k = Moments::second_moments; a < dim; ++a)
          for (unsigned int b = 0; b <= a; ++b, ++k)
            covariance[a][b] += own[k] / own[0] - mean[a] * mean[b];
        // The volume falls towards the other group.
        const Tensor<1, dim> slope = (side == 0 ? 1. : -1.) * vector_of<dim>(own + Moments::gradient);
        if (const double size = slope.norm(); size > 0.)
          for (unsigned int a = 0; a < dim; ++a)
            of_node[side * dim + a] = slope[a] / size;
      }
    for (unsigned int a = 0; a < dim; ++a)
      covariance[a][a] += 1e-3; // points in a row leave a direction free
    const Tensor<1, dim> across = invert(covariance) * between;
    if (const double size = across.norm(); size > 0.)
      for (unsigned int a = 0; a < dim; ++a)
        of_node[regression * dim + a] = across[a] / size;
    of_node[weight] = 1. / (1. / moments[0] + 1. / moments[Moments::n_moments]);
    of_node[weight + 1] =
        moments[rough_side * Moments::n_moments + Moments::friction] / moments[rough_side * Moments::n_moments];
  }


  template <int dim>
  template <int n>
  void ContactNormals<dim>::find_normals()
  {
    using Shapes = NodeShapes<dim, n>;
    sums.clear();
    normals.clear();
    balls.clear();
    Shapes shapes(0);
    for (const Cell &cell : cells)
      {
        const unsigned int number = cell.points->cell;
        sums.activate_cell(number);
        normals.activate_cell(number);
        const std::size_t first = balls.size();
        for_each_point(*cell.points, [&](const auto &point) {
          const double volume = point.properties[PropertyLayout<dim>::volume];
          balls.push_back({ point.reference_location, volume, 0.5 * edge_of_cube<dim>(volume) / grid.cell_size() });
        });
        if (shapes.open != grid.open_knots(number))
          shapes = Shapes(grid.open_knots(number));
        for (unsigned int b = 0; b < Shapes::n_batches; ++b)
          {
            const unsigned int *nodes = grid.nodes(number) + b * batch_size;
            const unsigned int n_here = std::min(Shapes::n_nodes - b * batch_size, batch_size);
            if (std::none_of(nodes, nodes + n_here, [this](const unsigned int node) { return is_shared[node]; }))
              continue;
            Batch moments[Moments::friction];
            shapes.sum_moments(b, balls.data() + first, balls.data() + balls.size(), moments);
            for (unsigned int l = 0; l < n_here; ++l)
              if (is_shared[nodes[l]])
                {
                  double *of_node = &sums[nodes[l]][cell.side * Moments::n_moments];
                  for (unsigned int k = 0; k < Moments::friction; ++k)
                    of_node[k] += moments[k][l];
                  of_node[Moments::friction] += moments[0][l] * cell.friction;
                }
          }
      }
    sums.add_contributions();
    for (const unsigned int node : normals.active_nodes())
      find_normals_of(node);
    normals.update_ghosts();
  }


  template <int dim>
  template <int n>
  void ContactNormals<dim>::find_reach(const unsigned int n_of)
  {
    constexpr unsigned int most_batches = (CellBasis<dim, n>::n_nodes + batch_size - 1) / batch_size;
    sums.clear();
    const Ball<dim> *ball = balls.data();
    for (const Cell &cell : cells)
      {
        const unsigned int number = cell.points->cell;
        sums.activate_cell(number);
        const double sign    = cell.side == 0 ? 1. : -1.;
        const auto positions = NodeShapes<dim, n>::node_positions(grid.open_knots(number));
        // The reach of a place from the shared nodes, a lane each, is offset + slope . place + radius.
        Batch slope[most_batches][n_normals][dim], offset[most_batches][n_normals], largest[most_batches][n_normals];
        std::array<unsigned int, CellBasis<dim, n>::n_nodes> nodes;
        unsigned int n_nodes = 0;
        for (unsigned int i = 0; i < nodes.size(); ++i)
          if (const unsigned int node = grid.nodes(number)[i]; is_shared[node])
            {
              const unsigned int b = n_nodes / batch_size, l = n_nodes % batch_size;
              for (unsigned int k = 0; k < n_of; ++k)
                {
                  if (l == 0)
                    {
                      offset[b][k] = largest[b][k] = Batch{};
                      std::fill_n(slope[b][k], dim, Batch{});
                    }
                  offset[b][k][l] = reach_of_none;
                  for (unsigned int a = 0; a < dim; ++a)
                    {
                      slope[b][k][a][l] = sign * normals[node][k * dim + a];
                      offset[b][k][l] -= slope[b][k][a][l] * positions[i][a];
                    }
                }
              nodes[n_nodes++] = node;
            }
        const unsigned int n_batches = (n_nodes + batch_size - 1) / batch_size;
        for (unsigned int p = 0; p < cell.points->n_points; ++p, ++ball)
          for (unsigned int b = 0; b < n_batches; ++b)
            for (unsigned int k = 0; k < n_of; ++k)
              {
                Batch reach = offset[b][k] + ball->radius;
                for (unsigned int a = 0; a < dim; ++a)
                  reach += slope[b][k][a] * ball->place[a];
                largest[b][k] = simd::max<Batch>(reach, largest[b][k]);
              }
        for (unsigned int i = 0; i < n_nodes; ++i)
          for (unsigned int k = 0; k < n_of; ++k)
            {
              double &reach = sums[nodes[i]][cell.side * n_normals + k];
              reach         = std::max(reach, largest[i / batch_size][k][i % batch_size]);
            }
      }
    sums.take_largest();
  }


  template <int dim>
  void ContactNormals<dim>::choose_normals()
  {
    for (const unsigned int node : normals.active_nodes())
      if (double *of_node = normals[node]; of_node[weight] > 0.)
        {
          double widest = gap_along(node, regression) - margin * grid.cell_size();
          for (unsigned int k = 0; k < regression; ++k)
            widest = std::max(widest, gap_along(node, k));
          Tensor<1, dim> normal;
          for (unsigned int k = 0; k < regression; ++k)
            if (gap_along(node, k) > widest - tie * grid.cell_size())
              normal += vector_of<dim>(of_node + k * dim);
          if (normal.norm_square() == 0.)
            normal = vector_of<dim>(of_node + regression * dim);
          const double size = normal.norm();
          for (unsigned int a = 0; a < dim; ++a)
            of_node[a] = size > 0. ? normal[a] / size : 0.; // where there is no normal
        }
    normals.update_ghosts();
  }


  template <int dim>
  void ContactNormals<dim>::smooth_normals()
  {
    averages.clear();
    constexpr unsigned int most_nodes = (Utilities::pow(3, dim) + batch_size - 1) / batch_size * batch_size;
    for (const Cell &cell : cells)
      {
        averages.activate_cell(cell.points->cell);
        // The nodes with a normal, a lane each; whole batches of them.
        alignas(Batch) double of_nodes[1 + dim][most_nodes];
        std::array<unsigned int, most_nodes> nodes;
        unsigned int n_nodes = 0;
        for (unsigned int i = 0; i < grid.n_nodes_per_cell(); ++i)
          {
            const unsigned int node = grid.nodes(cell.points->cell)[i];
            const double *of_node   = normals[node];
            if (of_node[weight] == 0.)
              continue;
            for (unsigned int a = 0; a < dim; ++a)
              of_nodes[a][n_nodes] = of_node[a];
            of_nodes[dim][n_nodes] = of_node[weight];
            nodes[n_nodes++]       = node;
          }
        unsigned int n_lanes = n_nodes;
        for (; n_lanes % batch_size > 0; ++n_lanes)
          for (auto &row : of_nodes)
            row[n_lanes] = 0.;
        for (unsigned int i = 0; i < n_nodes; ++i)
          {
            Batch sum[dim] = {};
            for (unsigned int first = 0; first < n_lanes; first += batch_size)
              {
                Batch other[dim], cosine{};
                for (unsigned int a = 0; a < dim; ++a)
                  {
                    other[a] = simd::load(&of_nodes[a][first]);
                    cosine += of_nodes[a][i] * other[a];
                  }
                const Batch part = simd::select<Batch>(cosine > same_face, simd::load(&of_nodes[dim][first]), Batch{});
                for (unsigned int a = 0; a < dim; ++a)
                  sum[a] += part * other[a];
              }
            for (unsigned int a = 0; a < dim; ++a)
              averages[nodes[i]][a] += simd::sum_of_lanes(sum[a]);
          }
      }
    averages.add_contributions();
    for (const unsigned int node : averages.active_nodes())
      {
        const Tensor<1, dim> sum = vector_of<dim>(averages[node]);
        for (unsigned int a = 0; a < dim && sum.norm_square() > 0.; ++a)
          normals[node][a] = sum[a] / sum.norm();
      }
    normals.update_ghosts();
  }


  template <int dim>
  template <int n>
  void ContactNormals<dim>::find()
  {
    find_cells();
    find_normals<n>();
    find_reach<n>(n_normals);
    choose_normals();
    smooth_normals();
    find_reach<n>(1);
  }


  template <int dim>
  void ContactNormals<dim>::find()
  {
    with_nodes_1d(grid, [&](auto n) { find<n>(); });
  }

  template class ContactNormals<2>;
  template class ContactNormals<3>;
} // namespace scree

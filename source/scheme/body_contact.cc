// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/scheme/body_contact.h>
#include <scree/scheme/contact_nodes.h>
#include <scree/scheme/node_contact.h>
#include <scree/simd/records.h>
#include <scree/tensor/vector.h>

#include <deal.II/base/symmetric_tensor.h>

#include <algorithm>
#include <cmath>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// Gap that counts as touching, cell widths.
    constexpr double slack = 0.01;

    /// Added to how far points reach from a node, cell widths, so that 0 stands for no points.
    constexpr double reach_of_none = 16.;

    /// The plane of the regression, the last of the normals to choose from, leans towards the axes: it is taken if the
    /// gap along it is the widest by this margin, cell widths, as at the edges of two bodies.
    constexpr unsigned int regression = 2;
    constexpr double margin           = 0.1;

    /// Gaps as close, cell widths, are the same, whatever rounding says: symmetry leaves both normals.
    constexpr double tie = 1e-6;

    /// Cosine of the angle from which on two normals are those of different faces.
    constexpr double same_face = 0.9;

    /// Node `i` of a cell along an axis.
    template <int n>
    unsigned int along(const unsigned int axis, const unsigned int i)
    {
      return i / Utilities::pow(n, axis) % n;
    }
  } // namespace


  /// The shape functions of a cell's nodes, a lane each, as polynomials c_0 + c_1 s + c_2 s^2 along the axes.
  template <int dim>
  template <int n>
  struct BodyContact<dim>::NodeShapes
  {
    static constexpr unsigned int n_nodes   = CellBasis<dim, n>::n_nodes,
                                  n_batches = (n_nodes + batch_size - 1) / batch_size;

    OpenKnots open;

    explicit NodeShapes(const OpenKnots open)
        : open(open)
    {
      Point<dim> end;
      const CellBasis<dim, n> at_start(end, open);
      for (unsigned int a = 0; a < dim; ++a)
        end[a] = 1.;
      const CellBasis<dim, n> at_end(end, open);
      const auto node_places = node_positions<n>(open);
      for (unsigned int i = 0; i < n_nodes; ++i)
        for (unsigned int a = 0; a < dim; ++a)
          {
            const unsigned int b = i / batch_size, l = i % batch_size, j = along<n>(a, i);
            const double start = at_start.value[a][j], slope = at_start.derivative[a][j];
            position[b][a][l]        = node_places[i][a];
            coefficients[b][a][0][l] = start;
            coefficients[b][a][1][l] = slope;
            coefficients[b][a][2][l] = at_end.value[a][j] - start - slope;
          }
    }

    /// The moments of points, without friction, around the nodes of batch `b`.
    void sum_moments(const unsigned int b, const Ball *ball, const Ball *end, Batch *result) const
    {
      Batch sums[friction] = {};
      for (; ball != end; ++ball)
        {
          Batch value[dim], slope[dim], x[dim];
          for (unsigned int a = 0; a < dim; ++a)
            {
              const Batch *c = coefficients[b][a];
              const double s = ball->place[a];
              x[a]           = s - position[b][a];
              value[a]       = c[0] + s * (c[1] + s * c[2]);
              slope[a]       = c[1] + (2. * s) * c[2];
            }
          Batch part = ball->volume * value[0];
          for (unsigned int a = 1; a < dim; ++a)
            part *= value[a];
          sums[0] += part;
          for (unsigned int a = 0, k = second_moments; a < dim; ++a)
            {
              const Batch moment = part * x[a];
              sums[first_moments + a] += moment;
              for (unsigned int c = 0; c <= a; ++c, ++k)
                sums[k] += moment * x[c];
              Batch along_axis = ball->volume * slope[a];
              for (unsigned int c = 0; c < dim; ++c)
                if (c != a)
                  along_axis *= value[c];
              sums[gradient + a] += along_axis;
            }
        }
      std::copy_n(sums, friction, result);
    }

  private:
    Batch position[n_batches][dim] = {}, coefficients[n_batches][dim][3] = {};
  };


  template <int dim>
  template <int n>
  std::array<Point<dim>, CellBasis<dim, n>::n_nodes> BodyContact<dim>::node_positions(const OpenKnots open)
  {
    std::array<Point<dim>, CellBasis<dim, n>::n_nodes> result;
    for (unsigned int a = 0; a < dim; ++a)
      {
        const auto of_axis = CellBasis<dim, n>::node_positions(open, a);
        for (unsigned int i = 0; i < result.size(); ++i)
          result[i][a] = of_axis[along<n>(a, i)];
      }
    return result;
  }


  template <int dim>
  BodyContact<dim>::BodyContact(const BackgroundGrid<dim> &grid,
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
  void BodyContact<dim>::reinit()
  {
    sums.reinit();
    normals.reinit();
    averages.reinit();
  }


  template <int dim>
  bool BodyContact<dim>::acts_on(const unsigned int side, const unsigned int node) const
  {
    if ((*groups[side].field)[node][NodalField<dim>::mass] > 0.)
      return true;
    const NodeConstraints<dim> *walls = groups[side].constraints->at(node);
    return walls != nullptr && walls->is_rigid;
  }


  template <int dim>
  double BodyContact<dim>::inverse_mass(const unsigned int side, const unsigned int node) const
  {
    const NodeConstraints<dim> *walls = groups[side].constraints->at(node);
    return walls != nullptr && walls->is_rigid ? 0. : 1. / (*groups[side].field)[node][NodalField<dim>::mass];
  }


  template <int dim>
  void BodyContact<dim>::find_cells()
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
                      is_shared[node] = acts_on(0, node) && acts_on(1, node);
                    any = any || is_shared[node];
                  }
                if (any)
                  cells.push_back({ side, &cell, *friction });
              }
        ++friction;
      }
  }


  template <int dim>
  void BodyContact<dim>::find_normals_of(const unsigned int node)
  {
    const double *moments = sums[node];
    double *of_node       = normals[node];
    if (moments[0] <= 0. || moments[n_moments] <= 0.)
      return;
    SymmetricTensor<2, dim> covariance;
    Tensor<1, dim> between;
    for (unsigned int side = 0; side < 2; ++side)
      {
        const double *own         = moments + side * n_moments;
        const Tensor<1, dim> mean = vector_of<dim>(own + first_moments) / own[0];
        between += (side == 0 ? -1. : 1.) * mean;
        for (unsigned int a = 0, k = second_moments; a < dim; ++a)
          for (unsigned int b = 0; b <= a; ++b, ++k)
            covariance[a][b] += own[k] / own[0] - mean[a] * mean[b];
        // The volume falls towards the other group.
        const Tensor<1, dim> slope = (side == 0 ? 1. : -1.) * vector_of<dim>(own + gradient);
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
    of_node[weight]     = 1. / (1. / moments[0] + 1. / moments[n_moments]);
    of_node[weight + 1] = moments[rough_side * n_moments + friction] / moments[rough_side * n_moments];
  }


  template <int dim>
  template <int n>
  void BodyContact<dim>::find_normals()
  {
    using Shapes = NodeShapes<n>;
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
          balls.push_back({ point.reference_location,
                            volume,
                            0.5 * (dim == 2 ? std::sqrt(volume) : std::cbrt(volume)) / grid.cell_size() });
        });
        if (shapes.open != grid.open_knots(number))
          shapes = Shapes(grid.open_knots(number));
        for (unsigned int b = 0; b < Shapes::n_batches; ++b)
          {
            const unsigned int *nodes = grid.nodes(number) + b * batch_size;
            const unsigned int n_here = std::min(Shapes::n_nodes - b * batch_size, batch_size);
            if (std::none_of(nodes, nodes + n_here, [this](const unsigned int node) { return is_shared[node]; }))
              continue;
            Batch moments[friction];
            shapes.sum_moments(b, balls.data() + first, balls.data() + balls.size(), moments);
            for (unsigned int l = 0; l < n_here; ++l)
              if (is_shared[nodes[l]])
                {
                  double *of_node = &sums[nodes[l]][cell.side * n_moments];
                  for (unsigned int k = 0; k < friction; ++k)
                    of_node[k] += moments[k][l];
                  of_node[friction] += moments[0][l] * cell.friction;
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
  void BodyContact<dim>::find_reach(const unsigned int n_of)
  {
    constexpr unsigned int most_batches = (CellBasis<dim, n>::n_nodes + batch_size - 1) / batch_size;
    sums.clear();
    const Ball *ball = balls.data();
    for (const Cell &cell : cells)
      {
        const unsigned int number = cell.points->cell;
        sums.activate_cell(number);
        const double sign    = cell.side == 0 ? 1. : -1.;
        const auto positions = node_positions<n>(grid.open_knots(number));
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
  double BodyContact<dim>::gap_along(const unsigned int node, const unsigned int normal) const
  {
    const double *reach = sums[node];
    return grid.cell_size() * (2. * reach_of_none - reach[normal] - reach[n_normals + normal]);
  }


  template <int dim>
  void BodyContact<dim>::choose_normals()
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
            of_node[a] = size > 0. ? normal[a] / size : 0.; // list_meetings() passes over those without a normal
        }
    normals.update_ghosts();
  }


  template <int dim>
  void BodyContact<dim>::smooth_normals()
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
  void BodyContact<dim>::list_meetings()
  {
    meetings.clear();
    for (const unsigned int node : normals.active_nodes())
      {
        if (normals[node][weight] == 0.)
          continue; // Only one of the groups is there.
        Tensor<1, dim> normal = vector_of<dim>(normals[node]);
        for (unsigned int side = 0; side < 2; ++side)
          if (const NodeConstraints<dim> *walls = groups[side].constraints->at(node);
              walls != nullptr && !walls->is_rigid)
            normal = walls->soil_held.free_part(normal);
        constexpr double smallest = 1e-6; // below it, walls hold the node
        if (const double size = normal.norm(); size > smallest)
          meetings.push_back({ node,
                               normal / size,
                               gap_along(node, 0),
                               normals[node][weight + 1],
                               {},
                               { { inverse_mass(0, node), inverse_mass(1, node) } } });
      }
  }


  template <int dim>
  template <int n>
  void BodyContact<dim>::find()
  {
    find_cells();
    find_normals<n>();
    find_reach<n>(n_normals);
    choose_normals();
    smooth_normals();
    find_reach<n>(1);
    list_meetings();
  }


  template <int dim>
  void BodyContact<dim>::find()
  {
    if (grid.n_nodes_1d() == 2)
      find<2>();
    else
      find<3>();
  }


  template <int dim>
  void BodyContact<dim>::solve(const double time_step, StepBalance<dim> &balance)
  {
    const double touching = slack * grid.cell_size();
    for (Meeting &meeting : meetings)
      {
        double *values[2];
        MovingMass<dim> masses[2];
        for (unsigned int side = 0; side < 2; ++side)
          {
            values[side] = (*groups[side].field)[meeting.node];
            masses[side] = { meeting.inverse_mass[side], vector_of<dim>(values[side] + NodalField<dim>::velocity) };
          }
        const double approach = std::max(0., meeting.gap - touching) / time_step;
        const Tensor<1, dim> impulse =
            contact_impulse(masses[0], masses[1], meeting.normal, approach, meeting.friction);
        if (impulse.norm_square() == 0.)
          continue;
        meeting.impulse += impulse;
        for (unsigned int side = 0; side < 2; ++side)
          {
            const Tensor<1, dim> own = side == 0 ? -impulse : impulse;
            if (masses[side].inverse_mass == 0.)
              {
                balance.wall_impulse -= own; // What rigid soil is given, it gives to the rest of the world.
                continue;
              }
            Tensor<1, dim> velocity = masses[side].velocity + masses[side].inverse_mass * own;
            if (const NodeConstraints<dim> *walls = groups[side].constraints->at(meeting.node))
              stop_at_walls(*walls, masses[side].inverse_mass, velocity, balance);
            for (unsigned int c = 0; c < dim; ++c)
              {
                values[side][NodalField<dim>::velocity_change + c] +=
                    velocity[c] - values[side][NodalField<dim>::velocity + c];
                values[side][NodalField<dim>::velocity + c] = velocity[c];
              }
          }
      }
  }


  template <int dim>
  void BodyContact<dim>::count_dissipation(StepBalance<dim> &balance) const
  {
    for (const Meeting &meeting : meetings)
      for (unsigned int side = 0; side < 2; ++side)
        {
          const double *values               = (*groups[side].field)[meeting.node];
          const Tensor<1, dim> mean_velocity = vector_of<dim>(values + NodalField<dim>::velocity) -
                                               0.5 * vector_of<dim>(values + NodalField<dim>::velocity_change);
          balance.contact_dissipation -= (side == 0 ? -1. : 1.) * (meeting.impulse * mean_velocity);
        }
  }

  template class BodyContact<2>;
  template class BodyContact<3>;
} // namespace scree

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/pressure/filled_part.h>

#include <deal.II/base/geometry_info.h>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// A function of the unit cell with these values at the vertices, linear in each of Kuhn's simplices.
    template <int dim>
    double interpolate(const std::array<double, (1 << dim)> &values, const Point<dim> &x)
    {
      std::array<unsigned int, dim> axes;
      for (unsigned int a = 0; a < dim; ++a)
        axes[a] = a;
      std::sort(axes.begin(), axes.end(), [&](const unsigned int a, const unsigned int b) { return x[a] > x[b]; });
      unsigned int vertex = 0;
      double result       = values[0];
      for (const unsigned int a : axes)
        {
          const unsigned int next = vertex | 1u << a;
          result += x[a] * (values[next] - values[vertex]);
          vertex = next;
        }
      return result;
    }
  } // namespace


  template <int dim>
  FilledPart<dim>::FilledPart(const BackgroundGrid<dim> &grid,
                              const NodeNumbering<dim> &vertices,
                              const FreeSurface<dim> &surface,
                              const CutCells<dim> *cut_cells,
                              const GroundGaps<dim> &gaps)
      : n_rows(Utilities::pow(grid.n_nodes_1d(), dim - 1))
      , grid(grid)
      , vertices(vertices)
      , surface(surface)
      , cut_cells(cut_cells)
      , gaps(gaps)
      , unit_cube(simplices_of_cube(Point<dim>(), 1.))
      , whole(unit_cube)
  {
  }


  template <int dim>
  unsigned int FilledPart<dim>::add_integrals(const CubicWeights<dim> &part, const OpenKnots open)
  {
    const unsigned int number = all_volumes.size() / n_rows;
    all_volumes.resize((number + 1) * n_rows, NodeRow{});
    divergences.resize((number + 1) * grid.n_nodes_per_cell() * dim, VertexRow<dim>{});
    with_nodes_1d(grid, [&](auto n) {
      constexpr unsigned int n_1d = CubicWeights<dim>::n_1d, rows_of_cell = RowFactors<dim, n>::n_rows;
      const auto &points = CubicWeights<dim>::points();
      const double area  = Utilities::fixed_power<dim - 1>(grid.cell_size());
      // First over the points of the other axes: of values and of derivatives, by point of the first axis.
      VertexRow<dim> sums[n_1d][dim][rows_of_cell]{};
      double volumes[n_1d][rows_of_cell]{};
      for (unsigned int s = 0; s < CubicWeights<dim>::n_points / n_1d; ++s)
        {
          Point<dim> x;
          for (unsigned int a = 1, rest = s; a < dim; ++a, rest /= n_1d)
            x[a] = points[rest % n_1d];
          const RowFactors<dim, n> rows(CellBasis<dim, n>(x, open));
          for (unsigned int q = 0; q < n_1d; ++q)
            {
              const double weight       = part.weights[s * n_1d + q];
              x[0]                      = points[q];
              const VertexRow<dim> hats = weight * vertex_values(x);
              for (unsigned int r = 0; r < rows_of_cell; ++r)
                {
                  volumes[q][r] += weight * rows.value[r];
                  sums[q][0][r] += hats * rows.value[r];
                  for (unsigned int c = 1; c < dim; ++c)
                    sums[q][c][r] += hats * rows.derivative[c - 1][r];
                }
            }
        }
      for (unsigned int q = 0; q < n_1d; ++q)
        {
          const CellBasis<dim, n> basis(points[q] * Point<dim>::unit_vector(0), open);
          VertexRow<dim> *of_node = &divergences[number * grid.n_nodes_per_cell() * dim];
          for (unsigned int r = 0; r < rows_of_cell; ++r)
            for (unsigned int i = 0; i < n; ++i, of_node += dim)
              {
                const double value = area * basis.value[0][i];
                all_volumes[number * n_rows + r][i] += grid.cell_size() * value * volumes[q][r];
                of_node[0] += area * basis.derivative[0][i] * sums[q][0][r];
                for (unsigned int c = 1; c < dim; ++c)
                  of_node[c] += value * sums[q][c][r];
              }
        }
    });
    return number;
  }


  template <int dim>
  void FilledPart<dim>::add(const unsigned int cell,
                            const unsigned int record,
                            const CubicWeights<dim> &part,
                            const unsigned int integrals)
  {
    Point<dim> centre;
    for (unsigned int v = 0; v < n_vertices; ++v)
      centre += part.hats[v] / part.fraction * GeometryInfo<dim>::unit_cell_vertex(v);
    with_water.push_back({ cell, record, integrals, part.fraction, {}, {} });
    for (unsigned int v = 0; v < n_vertices; ++v)
      for (unsigned int c = 0; c < dim; ++c)
        with_water.back().hat_slopes[c][v] =
            GeometryInfo<dim>::d_linear_shape_function_gradient(centre, v)[c] / grid.cell_size();
  }


  template <int dim>
  CubicWeights<dim> FilledPart<dim>::part_of(const std::vector<Simplex<dim>> &open, const AtVertices &depths) const
  {
    auto simplices = open;
    for (Simplex<dim> &simplex : simplices)
      for (SimplexCorner<dim> &corner : simplex)
        corner.side = interpolate<dim>(depths, corner.place);
    return CubicWeights<dim>(open_part(std::move(simplices), linear_crossing<dim>));
  }


  template <int dim>
  unsigned int FilledPart<dim>::faces_of_box(const unsigned int cell, const HoldsNode &holds) const
  {
    unsigned int result = 0;
    for (unsigned int rest = grid.open_knots(cell); rest != 0; rest &= rest - 1)
      {
        unsigned int face = 0;
        while (!(rest >> face & 1))
          ++face;
        bool bounds = surface.presses(face);
        if (!bounds && !surface.is_drained(face))
          bounds =
              std::all_of(grid.nodes(cell), grid.nodes(cell) + grid.n_nodes_per_cell(), [&](const unsigned int node) {
                return !(grid.node_faces(node) >> face & 1) || holds(node, face);
              });
        result |= bounds ? 1u << face : 0u;
      }
    return result;
  }


  template <int dim>
  typename FilledPart<dim>::AtVertices FilledPart<dim>::add_face(const SimplexFace<dim> &face,
                                                                 const Tensor<1, dim> &normal,
                                                                 const AtVertices &depths,
                                                                 const OpenKnots open,
                                                                 const unsigned int integrals)
  {
    AtVertices hats{};
    std::vector<SimplexFace<dim>> faces{ face };
    for (SimplexCorner<dim> &corner : faces[0])
      corner.side = interpolate<dim>(depths, corner.place);
    const auto wet = open_part(std::move(faces), linear_crossing<dim>);
    if (wet.empty())
      return hats;
    with_nodes_1d(grid, [&](auto n) {
      static const QWitherdenVincentSimplex<dim - 1> rule(4);
      VertexRow<dim> sums[CellBasis<dim, n>::n_nodes]{}, sum_of_hats{};
      for (const SimplexFace<dim> &part_of_face : wet)
        {
          const double area = area_of<dim>(part_of_face).norm() * Utilities::fixed_power<dim - 1>(grid.cell_size());
          std::array<Point<dim>, dim> corners;
          for (unsigned int i = 0; i < dim; ++i)
            corners[i] = part_of_face[i].place;
          visit_rule<dim>(rule, corners, [&](const Point<dim> &x, const double part) {
            const CellBasis<dim, n> basis(x, open);
            const RowFactors<dim, n> rows(basis);
            const VertexRow<dim> of_point = part * area * vertex_values(x);
            sum_of_hats += of_point;
            for (unsigned int i = 0; i < CellBasis<dim, n>::n_nodes; ++i)
              sums[i] += rows.value[i / n] * basis.value[0][i % n] * of_point;
          });
        }
      VertexRow<dim> *of_node = &divergences[integrals * grid.n_nodes_per_cell() * dim];
      for (const VertexRow<dim> &sum : sums)
        for (unsigned int c = 0; c < dim; ++c)
          *of_node++ -= normal[c] * sum;
      for (unsigned int v = 0; v < n_vertices; ++v)
        hats[v] = sum_of_hats[v];
    });
    return hats;
  }


  template <int dim>
  void FilledPart<dim>::add_box(const std::vector<Simplex<dim>> &simplices,
                                const unsigned int faces,
                                const AtVertices &depths,
                                const OpenKnots open,
                                const unsigned int integrals)
  {
    for (unsigned int f = 0; f < 2 * dim; ++f)
      if (faces >> f & 1)
        for (const Simplex<dim> &simplex : simplices)
          {
            SimplexFace<dim> face;
            unsigned int n_on_face = 0;
            for (const SimplexCorner<dim> &corner : simplex)
              if (std::abs(corner.place[f / 2] - f % 2) < 1e-12 && n_on_face++ < dim)
                face[n_on_face - 1] = corner;
            if (n_on_face == dim)
              add_face(face, (f % 2 ? 1. : -1.) * Point<dim>::unit_vector(f / 2), depths, open, integrals);
          }
  }


  template <int dim>
  void FilledPart<dim>::add_ground(const CutCell<dim> &cut,
                                   const AtVertices &depths,
                                   const OpenKnots open,
                                   const double time_step)
  {
    Cell &cell = with_water.back();
    for (const GroundFace<dim> &face : cut.faces)
      for (unsigned int s = cut.first_segment; s < cut.first_segment + cut.n_segments; ++s)
        if (const CutFacet<dim> &segment = cut_cells->segments()[s];
            segment.part == face.part && gaps.acts(s, time_step))
          {
            const AtVertices hats = add_face(face.corners, face.normal, depths, open, cell.integrals);
            const double speed    = gaps.approach_of_mixture(s, time_step) + cut_cells->velocity(segment) * face.normal;
            for (unsigned int v = 0; v < n_vertices; ++v)
              cell.allowed[v] += speed * hats[v];
          }
  }


  template <int dim>
  void FilledPart<dim>::find(const Mixture<dim> &mixture, const HoldsNode &holds, const double time_step)
  {
    constexpr double smallest = 1e-9; // fraction of a cell
    with_water.clear();
    divergences.resize(integrals_of_whole.size() * grid.n_nodes_per_cell() * dim);
    all_volumes.resize(integrals_of_whole.size() * n_rows);
    AtVertices filled;
    filled.fill(1.);
    const auto kind_of = [&](const unsigned int cell) {
      return grid.open_knots(cell) + (faces_of_box(cell, holds) << 2 * dim);
    };
    for (const MixtureCell<dim> &cell : mixture.cells())
      if (const unsigned int kind = kind_of(cell.cell); integrals_of_whole.count(kind) == 0)
        {
          const OpenKnots open         = grid.open_knots(cell.cell);
          const unsigned int integrals = add_integrals(whole, open);
          add_box(unit_cube, kind >> 2 * dim, filled, open, integrals);
          integrals_of_whole[kind] = integrals;
        }
    for (unsigned int record = 0; record < mixture.cells().size(); ++record)
      {
        const MixtureCell<dim> &cell = mixture.cells()[record];
        if (cell.water_volume <= 0.)
          continue;
        const OpenKnots open    = grid.open_knots(cell.cell);
        const CutCell<dim> *cut = cut_cells ? cut_cells->find(cell.cell) : nullptr;
        AtVertices depths;
        for (unsigned int v = 0; v < n_vertices; ++v)
          depths[v] = surface.depth(vertices.nodes(cell.cell)[v]);
        if (*std::max_element(depths.begin(), depths.end()) <= 0.)
          continue;
        if (*std::min_element(depths.begin(), depths.end()) > 0. && cut == nullptr)
          {
            add(cell.cell, record, whole, integrals_of_whole.at(kind_of(cell.cell)));
            continue;
          }
        const auto &simplices = cut ? cut->open : unit_cube;
        if (const CubicWeights<dim> part = part_of(simplices, depths); part.fraction > smallest)
          {
            add(cell.cell, record, part, add_integrals(part, open));
            add_box(simplices, faces_of_box(cell.cell, holds), depths, open, with_water.back().integrals);
            if (cut)
              add_ground(*cut, depths, open, time_step);
          }
      }
  }

  template class FilledPart<2>;
  template class FilledPart<3>;
} // namespace scree

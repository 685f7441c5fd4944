// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/pressure/filled_part.h>

#include <deal.II/base/geometry_info.h>

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
                              const CutCells<dim> *cut_cells)
      : n_rows(Utilities::pow(grid.n_nodes_1d(), dim - 1))
      , grid(grid)
      , vertices(vertices)
      , surface(surface)
      , cut_cells(cut_cells)
      , unit_cube(simplices_of_cube(Point<dim>(), 1.))
  {
    for (const Simplex<dim> &simplex : unit_cube)
      whole.add(simplex);
  }


  template <int dim>
  template <int n>
  void FilledPart<dim>::integrate(const CubicWeights<dim> &part, const OpenKnots open, NodeRow *integrals) const
  {
    constexpr unsigned int n_1d = CubicWeights<dim>::n_1d, rows_of_cell = RowFactors<dim, n>::n_rows;
    const double volume = Utilities::fixed_power<dim>(grid.cell_size()), area = volume / grid.cell_size();
    for (unsigned int q = 0; q < CubicWeights<dim>::n_points; ++q)
      {
        Point<dim> x;
        for (unsigned int a = 0, rest = q; a < dim; ++a, rest /= n_1d)
          x[a] = CubicWeights<dim>::points()[rest % n_1d];
        const CellBasis<dim, n> basis(x, open);
        const RowFactors<dim, n> rows(basis);
        const NodeRow value_x = make_row(basis.value[0]), derivative_x = make_row(basis.derivative[0]);
        const double weight = part.weights[q];
        std::array<double, n_vertices> hats;
        for (unsigned int v = 0; v < n_vertices; ++v)
          hats[v] = area * weight * GeometryInfo<dim>::d_linear_shape_function(x, v);
        for (unsigned int r = 0; r < rows_of_cell; ++r)
          {
            for (unsigned int c = 0; c < dim; ++c)
              {
                const NodeRow slope =
                    c == 0 ? derivative_x * rows.value[r] : value_x * rows.derivative[c > 0 ? c - 1 : 0][r];
                for (unsigned int v = 0; v < n_vertices; ++v)
                  integrals[(c * n_vertices + v) * rows_of_cell + r] += hats[v] * slope;
              }
            integrals[dim * n_vertices * rows_of_cell + r] += value_x * (volume * weight * rows.value[r]);
          }
      }
  }


  template <int dim>
  unsigned int FilledPart<dim>::add_integrals(const CubicWeights<dim> &part, const OpenKnots open)
  {
    const unsigned int begin = all_integrals.size();
    all_integrals.resize(begin + (dim * n_vertices + 1) * n_rows, NodeRow{});
    if (grid.n_nodes_1d() == 2)
      integrate<2>(part, open, &all_integrals[begin]);
    else
      integrate<3>(part, open, &all_integrals[begin]);
    return begin;
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
    with_water.push_back({ cell, record, integrals, part.fraction, {} });
    for (unsigned int v = 0; v < n_vertices; ++v)
      with_water.back().hat_slopes[v] =
          GeometryInfo<dim>::d_linear_shape_function_gradient(centre, v) / grid.cell_size();
  }


  template <int dim>
  CubicWeights<dim> FilledPart<dim>::part_of(const std::vector<Simplex<dim>> &open,
                                             const std::array<double, n_vertices> &depths) const
  {
    auto simplices = open;
    for (Simplex<dim> &simplex : simplices)
      for (SimplexCorner<dim> &corner : simplex)
        corner.side = interpolate<dim>(depths, corner.place);
    CubicWeights<dim> part;
    for (const Simplex<dim> &simplex : open_part(std::move(simplices), linear_crossing<dim>))
      part.add(simplex);
    return part;
  }


  template <int dim>
  void FilledPart<dim>::find(const Mixture<dim> &mixture)
  {
    constexpr double smallest = 1e-9; // fraction of a cell
    with_water.clear();
    all_integrals.resize(end_of_whole);
    for (const MixtureCell<dim> &cell : mixture.cells())
      if (const OpenKnots open = grid.open_knots(cell.cell); integrals_of_whole.count(open) == 0)
        integrals_of_whole[open] = add_integrals(whole, open);
    end_of_whole = all_integrals.size();
    for (unsigned int record = 0; record < mixture.cells().size(); ++record)
      {
        const MixtureCell<dim> &cell = mixture.cells()[record];
        if (cell.water_volume <= 0.)
          continue;
        const OpenKnots open    = grid.open_knots(cell.cell);
        const CutCell<dim> *cut = cut_cells ? cut_cells->find(cell.cell) : nullptr;
        std::array<double, n_vertices> depths;
        for (unsigned int v = 0; v < n_vertices; ++v)
          depths[v] = surface.depth(vertices.nodes(cell.cell)[v]);
        if (*std::max_element(depths.begin(), depths.end()) <= 0.)
          continue;
        if (*std::min_element(depths.begin(), depths.end()) > 0. && cut == nullptr)
          add(cell.cell, record, whole, integrals_of_whole.at(open));
        else if (const CubicWeights<dim> part = part_of(cut ? cut->open : unit_cube, depths); part.fraction > smallest)
          add(cell.cell, record, part, add_integrals(part, open));
      }
  }

  template class FilledPart<2>;
  template class FilledPart<3>;
} // namespace scree

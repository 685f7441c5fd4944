// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/mesh/cut_cells.h>

#include <deal.II/base/geometry_info.h>
#include <deal.II/base/quadrature_lib.h>

namespace scree
{
  using namespace dealii;

  template <int dim>
  CutFacet<dim> &CutCells<dim>::facet_of(CutCell<dim> &cut, const Point<dim> &middle)
  {
    const bool is_known =
        ground.n_near(cut.cell) == 1 && cut.n_segments == 1; // one part of the ground, which has its facet
    const unsigned int part = is_known ? all_segments.back().part : ground.nearest_part(cut.cell, middle);
    for (unsigned int s = cut.first_segment; s < all_segments.size(); ++s)
      if (all_segments[s].part == part)
        return all_segments[s];
    ++cut.n_segments;
    CutFacet<dim> segment;
    segment.cell = cut.cell;
    segment.part = part;
    segment.shapes.resize(grid.n_nodes_per_cell());
    all_segments.push_back(std::move(segment));
    return all_segments.back();
  }


  template <int dim>
  void CutCells<dim>::integrate_ground(const std::vector<Simplex<dim>> &open, CutCell<dim> &cut)
  {
    static const QWitherdenVincentSimplex<dim - 1> rule(dim == 2 ? 3 : 4); // quadratics along all axes
    cut.first_segment = all_segments.size();
    for (const Simplex<dim> &simplex : open)
      {
        // A simplex with a face on the ground has one corner in the open.
        SimplexFace<dim> face;
        std::array<Point<dim>, dim> places;
        unsigned int n_on_ground = 0;
        Point<dim> inside;
        for (const SimplexCorner<dim> &corner : simplex)
          if (corner.side > 0.)
            inside = corner.place;
          else if (n_on_ground++ < dim)
            {
              face[n_on_ground - 1]   = corner;
              places[n_on_ground - 1] = corner.place;
            }
        if (n_on_ground != dim)
          continue;
        Tensor<1, dim> area = area_of<dim>(face);
        if (area * (inside - places[0]) > 0.)
          area *= -1.;
        Point<dim> middle;
        for (const Point<dim> &corner : places)
          middle += 1. / dim * corner;
        const double size      = area.norm();
        CutFacet<dim> &segment = facet_of(cut, middle);
        if (size > 0. && content == Content::all)
          cut.faces.push_back({ face, area / size, segment.part });
        segment.area += size;
        segment.normal += area;
        visit_rule<dim>(rule, places, [&](const Point<dim> &x, const double part) {
          for (unsigned int v = 0; v < cut.n_vertices; ++v)
            segment.vertex_weights[v] += part * size * GeometryInfo<dim>::d_linear_shape_function(x, v);
          unsigned int i = 0;
          visit_nodes(grid, cut.cell, x, [&](const unsigned int, const double shape) {
            segment.shapes[i++] += part * size * shape;
          });
        });
      }
    finish_facets(cut);
  }


  template <int dim>
  void CutCells<dim>::finish_facets(CutCell<dim> &cut)
  {
    constexpr double smallest_area = 1e-9; // what is less is a corner that touches the ground
    const auto is_small            = [](const CutFacet<dim> &segment) { return segment.normal.norm() < smallest_area; };
    all_segments.erase(std::remove_if(all_segments.begin() + cut.first_segment, all_segments.end(), is_small),
                       all_segments.end());
    cut.n_segments = all_segments.size() - cut.first_segment;
    for (unsigned int s = cut.first_segment; s < all_segments.size(); ++s)
      {
        CutFacet<dim> &segment = all_segments[s];
        for (double &hat : segment.vertex_weights)
          hat /= segment.area;
        for (double &shape : segment.shapes)
          shape /= segment.area;
        const double size = segment.normal.norm();
        segment.area      = size * Utilities::fixed_power<dim - 1>(grid.cell_size());
        segment.normal /= size;
        Point<dim> middle; // in the unit cell
        for (unsigned int v = 0; v < CutCell<dim>::n_vertices; ++v)
          middle += segment.vertex_weights[v] * GeometryInfo<dim>::unit_cell_vertex(v);
        const FineCells<dim> &fine = grid.fine_cells();
        segment.middle = fine.box().corner(fine.cells()[fine.of_index(cut.cell)].place) + grid.cell_size() * middle;
      }
  }


  template <int dim>
  void CutCells<dim>::look_at(const unsigned int cell)
  {
    constexpr double on_ground = 1e-9; // cells: what is nearer lies on the ground
    constexpr double nothing   = 1e-12;
    const bool may_change      = ground.moves_near(cell);
    const double margin        = std::max(thinnest, on_ground);
    if (!(ground.least_distance(cell) < (may_change ? margin : on_ground) * grid.cell_size()))
      return;
    // Ground that moves comes through all places. An open part that is too thin for points would hide it from the
    // water, for no cell without points takes part: the ground is then on the face behind.
    // Ground behind a wall of the box is not moved onto it: it would push what the wall holds.
    const FineCells<dim> &fine = grid.fine_cells();
    const Point<dim> first     = fine.box().corner(fine.cells()[fine.of_index(cell)].place);
    const auto margin_at       = [&](const Point<dim> &place, const SurfaceView<dim> &view) {
      if (!may_change || !ground.parts()[ground.nearest_part(cell, place)].velocity)
        return on_ground;
      for (unsigned int a = 0; a < dim; ++a)
        if (const double foot = first[a] + grid.cell_size() * place[a] - view.distance * view.normal[a];
            foot < grid.lower_corner()[a] - on_ground * grid.cell_size() ||
            foot > grid.upper_corner()[a] + on_ground * grid.cell_size())
          return on_ground;
      return margin;
    };
    auto simplices = unit_cube;
    for (Simplex<dim> &simplex : simplices)
      for (SimplexCorner<dim> &corner : simplex)
        {
          const SurfaceView<dim> view = ground.view(cell, corner.place);
          const double distance       = view.distance / grid.cell_size();
          corner.side = distance > -on_ground && distance < margin_at(corner.place, view) ? 0. : distance;
        }
    CutCell<dim> cut;
    cut.cell       = cell;
    cut.may_change = may_change;
    cut.open       = open_part(std::move(simplices), linear_crossing<dim>);
    integrate_ground(cut.open, cut);
    if (content == Content::segments)
      {
        if (cut.n_segments == 0)
          return;
        cut.open.clear();
        cut.open.shrink_to_fit();
      }
    else
      {
        const CubicWeights<dim> integrals(cut.open);
        cut.open_fraction = integrals.fraction;
        cut.weights       = integrals.weights;
        cut.open_hats     = integrals.hats;
        if (cut.open_fraction > 1. - nothing && cut.n_segments == 0)
          return;
      }
    entry_of_cell[cell] = cut_cells.size();
    cut_cells.push_back(std::move(cut));
  }


  template <int dim>
  void CutCells<dim>::follow()
  {
    std::vector<CutCell<dim>> old_cells;
    std::vector<CutFacet<dim>> old_segments;
    old_cells.swap(cut_cells);
    old_segments.swap(all_segments);
    before.clear();
    for (const auto &cell : grid.fine_cells().cells())
      {
        if (!grid.fine_cells().is_owned(cell))
          continue;
        const unsigned int entry = std::exchange(entry_of_cell[cell.index], none);
        const CutCell<dim> *old  = entry == none ? nullptr : &old_cells[entry];
        const bool may_change    = ground.moves_near(cell.index);
        const unsigned int first = all_segments.size();
        if (may_change || (old && old->may_change))
          look_at(cell.index);
        else if (old)
          {
            entry_of_cell[cell.index] = cut_cells.size();
            cut_cells.push_back(*old);
            cut_cells.back().first_segment = first;
            for (unsigned int s = old->first_segment; s < old->first_segment + old->n_segments; ++s)
              all_segments.push_back(std::move(old_segments[s]));
          }
        for (unsigned int s = first; s < all_segments.size(); ++s)
          {
            before.push_back(none);
            for (unsigned int o = 0; old && o < old->n_segments; ++o)
              if (old_segments[old->first_segment + o].part == all_segments[s].part)
                before.back() = old->first_segment + o;
          }
      }
  }

  template struct CutCell<2>;
  template struct CutCell<3>;
  template class CutCells<2>;
  template class CutCells<3>;
} // namespace scree

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/pressure/soil_gaps.h>
#include <scree/mixture/closures.h>

#include <array>

namespace scree
{
  using namespace dealii;

  template <int dim>
  SoilGaps<dim>::SoilGaps(const BackgroundGrid<dim> &grid,
                          const NodeNumbering<dim> &vertices,
                          const FreeSurface<dim> &surface)
      : grid(grid)
      , vertices(vertices)
      , surface(surface)
      , at_nodes(grid.numbering())
  {
  }


  template <int dim>
  void SoilGaps<dim>::reinit()
  {
    at_nodes.reinit();
  }


  template <int dim>
  void SoilGaps<dim>::add_faces(const unsigned int record, const MixtureCell<dim> &cell)
  {
    const unsigned int *of_cell = vertices.nodes(cell.cell);
    std::array<unsigned int, n_sides> n_unknown{}; // vertices
    for (unsigned int v = 0; v < cell.n_vertices; ++v)
      if (surface.kind(of_cell[v]) == PressureDofType::unknown)
        for (unsigned int a = 0; a < dim; ++a)
          ++n_unknown[2 * a + (v >> a & 1u)];
    const bool is_full = cell.fill >= closures::full_cell_beside_gap;
    for (unsigned int side = 0; side < n_sides; ++side)
      if (n_unknown[side] == 0 && n_unknown[side ^ 1u] == cell.n_vertices / 2)
        {
          const double off = cell.centre()[side / 2] - 0.5;
          faces.push_back(
              { record, side, is_full, !is_full && (side % 2 == 1 ? -off : off) >= closures::least_offset_beside_gap });
        }
  }


  template <int dim>
  template <typename Function>
  void SoilGaps<dim>::for_nodes(const unsigned int cell,
                                const unsigned int side,
                                const unsigned int place,
                                const Function &act) const
  {
    const unsigned int n = grid.n_nodes_1d();
    for (unsigned int i = 0; i < grid.n_nodes_per_cell(); ++i)
      {
        bool is_there = true;
        for (unsigned int a = 0, rest = i; a < dim; ++a, rest /= n)
          is_there = is_there && (a == side / 2 ? rest % n == place : n == 2 || rest % n == 1);
        if (is_there)
          act(grid.nodes(cell)[i]);
      }
  }


  template <int dim>
  void SoilGaps<dim>::find(const Mixture<dim> &mixture)
  {
    const bool has_middle = grid.n_nodes_1d() == 3;
    at_nodes.clear();
    faces.clear();
    beside.assign(mixture.cells().size(), false);
    for (unsigned int record = 0; record < mixture.cells().size(); ++record)
      {
        const MixtureCell<dim> &cell = mixture.cells()[record];
        if (cell.soil_mass == 0. || cell.water_volume == 0. || surface.is_within(cell.cell))
          continue;
        at_nodes.activate_cell(cell.cell);
        if (has_middle)
          at_nodes[grid.nodes(cell.cell)[grid.n_nodes_per_cell() / 2]][soil] += 1.;
        add_faces(record, cell);
      }
    for (const Face &face : faces)
      {
        for_nodes_ahead(face, mixture, [&](const unsigned int node) { at_nodes[node][ahead + face.side] += 1.; });
        if (has_middle && face.is_away)
          for_nodes(mixture.cells()[face.record].cell, face.side, 1, [&](const unsigned int node) {
            at_nodes[node][own + face.side] += 1.;
          });
      }
    at_nodes.add_contributions();
    at_nodes.update_ghosts();
    for (const Face &face : faces)
      if (face.is_full || face.is_away)
        for_nodes_ahead(face, mixture, [&](const unsigned int node) {
          const double *of_node       = at_nodes[node];
          const unsigned int opposite = face.side ^ 1u;
          if ((of_node[soil] == 0. && of_node[ahead + opposite] > 0.) || (face.is_away && of_node[own + opposite] > 0.))
            beside[face.record] = true;
        });
  }

  template class SoilGaps<2>;
  template class SoilGaps<3>;
} // namespace scree

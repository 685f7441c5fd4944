// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/postprocess/visualization/graphics.h>
#include <scree/postprocess/visualization/patch_output.h>

namespace scree
{
  using namespace dealii;

  template <int dim>
  void Graphics<dim>::add_grid(const NodalField<dim> &field,
                               const double time,
                               const WaterView<dim> *view,
                               const Cells &contents,
                               Files &files)
  {
    const auto picture            = std::make_shared<PatchOutput<dim, dim>>();
    PatchOutput<dim, dim> &output = *picture;
    for (const OutputField &field : { fields::velocity, fields::density, fields::mean_effective_stress })
      output.add(field);
    if (view)
      for (const OutputField &field :
           { fields::water_velocity, fields::pressure, fields::porosity, fields::saturation })
        output.add(field);

    const double cell_volume = Utilities::fixed_power<dim>(grid.cell_size());
    for (const auto &cell : grid.triangulation().active_cell_iterators())
      {
        const unsigned int index = cell->active_cell_index();
        const CellContents &sums = contents[index];
        if (sums.is_empty() || !holds_nodes(cell))
          continue;
        typename PatchOutput<dim, dim>::Patch patch;
        patch.patch_index    = output.patches.size();
        patch.n_subdivisions = 1;
        patch.reference_cell = ReferenceCells::get_hypercube<dim>();
        patch.data.reinit(output.names.size(), GeometryInfo<dim>::vertices_per_cell);
        for (const unsigned int v : cell->vertex_indices())
          {
            patch.vertices[v]       = cell->vertex(v);
            unsigned int row        = 0;
            const auto put          = [&](const double value) { patch.data(row++, v) = value; };
            const auto put_velocity = [&](const NodalField<dim> &of) {
              const auto velocity = velocity_at(GeometryInfo<dim>::unit_cell_vertex(v), grid, index, of);
              for (unsigned int c = 0; c < dim; ++c)
                put(velocity[c]);
            };
            put_velocity(field);
            put(sums.soil_mass / cell_volume);
            put(sums.soil_volume > 0 ? sums.soil_pressure / sums.soil_volume : 0.);
            if (!view)
              continue;
            put_velocity(view->field);
            put(view->pressure_of_cell(index)[v]);
            put(sums.porosity());
            put(sums.saturation(cell_volume));
          }
        output.patches.push_back(patch);
      }
    add("grid", grid_files, time, picture, files);
  }

  template void
  Graphics<2>::add_grid(const NodalField<2> &, const double, const WaterView<2> *, const Cells &, Files &);
  template void
  Graphics<3>::add_grid(const NodalField<3> &, const double, const WaterView<3> *, const Cells &, Files &);
} // namespace scree

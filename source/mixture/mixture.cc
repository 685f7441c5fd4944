// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/mixture/mixture.h>

#include <deal.II/base/geometry_info.h>

namespace scree
{
  using namespace dealii;

  template <int dim>
  Mixture<dim>::Mixture(const BackgroundGrid<dim> &grid, const unsigned int soil_points, const CutCells<dim> *cut_cells)
      : grid(grid)
      , soil_points(soil_points)
      , cell_volume(Utilities::fixed_power<dim>(grid.cell_size()))
      , cut_cells(cut_cells)
  {
    reinit();
  }


  template <int dim>
  void Mixture<dim>::reinit()
  {
    records.clear();
    record_of_cell.assign(grid.triangulation().n_active_cells(), numbers::invalid_unsigned_int);
  }


  template <int dim>
  void Mixture<dim>::clear()
  {
    for (const MixtureCell<dim> &cell : records)
      record_of_cell[cell.cell] = numbers::invalid_unsigned_int;
    records.clear();
    porosities.clear();
    entering_water.clear();
  }


  template <int dim>
  unsigned int Mixture<dim>::record(const unsigned int cell)
  {
    unsigned int &record = record_of_cell[cell];
    if (record == numbers::invalid_unsigned_int)
      {
        record = records.size();
        records.emplace_back(cell, cell_volume * (cut_cells ? cut_cells->open_fraction(cell) : 1.));
      }
    return record;
  }


  template <int dim>
  void Mixture<dim>::add_entering(const unsigned int cell, const Point<dim> &place, const double volume)
  {
    const unsigned int record = record_of_cell[cell];
    if (record == numbers::invalid_unsigned_int || records[record].water_volume <= 0)
      return;
    EnteringWater<dim> entering{ cell, {} };
    for (unsigned int v = 0; v < entering.at_vertex.size(); ++v)
      entering.at_vertex[v] = volume * GeometryInfo<dim>::d_linear_shape_function(place, v);
    entering_water.push_back(entering);
  }

  template class Mixture<2>;
  template class Mixture<3>;
} // namespace scree

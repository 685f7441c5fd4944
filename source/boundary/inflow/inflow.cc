// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/boundary/inflow/inflow.h>
#include <scree/tensor/vector.h>

#include <deal.II/base/geometry_info.h>

#include <boost/serialization/utility.hpp>
#include <boost/serialization/vector.hpp>

namespace scree
{
  using namespace dealii;

  template <int dim>
  Inflow<dim>::Inflow(const InflowParameters &parameters,
                      const BackgroundGrid<dim> &grid,
                      const double spacing,
                      const double porosity,
                      const LevelSet<dim> *ground)
      : name(parameters.name())
      , body(parameters.body)
      , region(parameters.region)
      , brings_soil(!parameters.is_water())
      , water_share(!brings_soil              ? 1.
                    : parameters.is_saturated ? porosity
                                              : 0.)
      , grid(grid)
      , hydrograph(parameters)
      , spacing(spacing)
      , end_time(parameters.end_time < 0. ? std::numeric_limits<double>::infinity() : parameters.end_time)
      , is_at_wall(parameters.is_at_wall())
      , tells_discharge(parameters.tells_discharge())
      , face(parameters.face_number(dim))
      , section(is_at_wall ? (face % 2 == 0 ? grid.lower_corner() : grid.upper_corner())[face / 2]
                           : number_of(parameters.section))
      , direction(vector_of<dim>(parameters.unit_direction(dim).data()))
  {
    normal[face / 2] = face % 2 == 0 ? 1. : -1.;
    find_places(parameters, ground);
    on_all_ranks(grid.communicator(), [&] { mean_velocity = velocity_of(hydrograph.value(0.)); });
  }


  template <int dim>
  void Inflow<dim>::find_places(const InflowParameters &parameters, const LevelSet<dim> *ground)
  {
    const Region<dim> region(entry_name(parameters.subsection, "Region"), parameters.region);
    const double lower      = face % 2 == 0 ? section : section - spacing; // of the layer behind the section
    const auto part_of_cube = [&](const Point<dim> &corner, const double width) -> Seed<dim> {
      if (std::abs(corner[face / 2] - lower) > 0.5 * spacing)
        return { {}, corner, 0., 0. };
      const auto [volume, centroid] = region.part_of_cube(corner, width, ground);
      return { {}, centroid, volume, volume };
    };
    std::vector<std::pair<Point<dim>, double>> own; // location and volume
    on_all_ranks(grid.communicator(), [&] {
      const unsigned int points_per_cell = std::lround(grid.cell_size() / spacing);
      for (const Seed<dim> &seed :
           lattice_seeds<dim>(grid.triangulation(), grid.cell_size(), points_per_cell, part_of_cube))
        own.emplace_back(seed.location, seed.volume);
    });
    for (const auto &of_rank : Utilities::MPI::all_gather(grid.communicator(), own))
      for (const auto &[location, volume] : of_rank)
        layer.push_back({ location, volume });
    std::sort(layer.begin(), layer.end(), [](const Place &a, const Place &b) {
      return std::lexicographical_compare(&a.location[0], &a.location[0] + dim, &b.location[0], &b.location[0] + dim);
    });
    for (const Place &place : layer)
      {
        open_area += place.volume / spacing;
        cells_of_layer.push_back(grid.fine_cells().box().place_near(place.location));
      }
    require_entry(!layer.empty(),
                  { parameters.subsection, "Region", parameters.region },
                  std::string("the region is empty behind the section, at ") + "xyz"[face / 2] + " = " +
                      number_text(section) + " m" + (ground ? " and above the ground of subsection Bed" : "") +
                      ". Move the region or the section.");
    std::sort(cells_of_layer.begin(), cells_of_layer.end());
    cells_of_layer.erase(std::unique(cells_of_layer.begin(), cells_of_layer.end()), cells_of_layer.end());
    for (CellPlace<dim> cell : cells_of_layer)
      {
        for (int &along : cell)
          along /= 2;
        section_blocks.push_back(curve_number<dim>(cell));
      }
    make_unique(section_blocks);
  }


  template <int dim>
  bool Inflow<dim>::moves(const unsigned int node) const
  {
    if (!is_at_wall || !((grid.node_faces(node) >> face) & 1))
      return false;
    // Functions of the nodes reach a cell and a half to each side.
    const CellsOfBox<dim> &box = grid.fine_cells().box();
    const Point<dim> &x        = grid.node_position(node);
    const CellPlace<dim> at    = box.place_near(x);
    for (unsigned int i = 0; i < Utilities::fixed_power<dim>(3u); ++i)
      {
        CellPlace<dim> cell = at;
        for (unsigned int a = 0, rest = i; a < dim; ++a, rest /= 3)
          cell[a] += static_cast<int>(rest % 3) - 1;
        bool reaches = cell[face / 2] == at[face / 2];
        for (unsigned int a = 0; a < dim; ++a)
          reaches = reaches &&
                    (a == face / 2 || std::abs(box.corner(cell)[a] + 0.5 * box.width - x[a]) < (1. + 1e-6) * box.width);
        if (reaches && std::binary_search(cells_of_layer.begin(), cells_of_layer.end(), cell))
          return true;
      }
    return false;
  }


  template <int dim>
  double Inflow<dim>::power_of_pressure(const PressureOfCell<dim> &pressure) const
  {
    double force = 0;
    for (const Place &place : layer)
      {
        Point<dim> x = place.location;
        x[face / 2]  = section;
        if (const auto *cell = grid.fine_cells().own_cell_at(x))
          {
            const auto at_vertices   = pressure(cell->index);
            const Point<dim> in_cell = grid.fine_cells().place_in(*cell, x);
            for (unsigned int v = 0; v < at_vertices.size(); ++v)
              force += place.volume / spacing * at_vertices[v] * GeometryInfo<dim>::d_linear_shape_function(in_cell, v);
          }
      }
    return force * (mean_velocity * normal);
  }


  template <int dim>
  void Inflow<dim>::add_to(Mixture<dim> &mixture) const
  {
    const double entered = front - n_layers * spacing;
    if (!is_open || !(entered > 0.))
      return;
    for (const Place &place : layer)
      {
        Point<dim> middle = place.location;
        middle[face / 2]  = section + 0.5 * entered * normal[face / 2];
        if (const auto *cell = grid.fine_cells().own_cell_at(middle))
          mixture.add_entering(
              cell->index, grid.fine_cells().place_in(*cell, middle), place.volume * entered / spacing);
      }
  }

  template class Inflow<2>;
  template class Inflow<3>;
} // namespace scree

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/model/places_of_points.h>
#include <scree/seeding/seeding.h>
#include <scree/seeding/water_seeding.h>

#include <algorithm>

namespace scree
{
  using namespace dealii;

  template <int dim>
  PlacesOfPoints<dim> places_of_points(const Parameters &parameters)
  {
    struct Part
    {
      Region<dim> region;
      unsigned int points_per_cell;
    };
    const auto parts = std::make_shared<std::vector<Part>>();
    const auto soil  = parameters.soil_regions();
    for (unsigned int i = 0; i < soil.size(); ++i)
      parts->push_back({ soil[i].template places<dim>(), parameters.bodies[i].seeding.points_per_cell });
    if (parameters.has_water && parameters.water.point_sets_kind() == PointSets::double_point)
      for (auto &part : water_parts<dim>(parameters.water, soil))
        parts->push_back({ std::move(part.region), parameters.water.points_per_cell });
    struct Section // of an inflow
    {
      Region<dim> region;
      unsigned int axis;
      double lower; // coordinate of the lower side of a layer, m
    };
    const auto sections = std::make_shared<std::vector<Section>>();
    for (const InflowParameters &inflow : parameters.inflows)
      {
        const unsigned int face = inflow.face_number(dim);
        const double x          = inflow.place(parameters.grid);
        sections->push_back({ Region<dim>(entry_name(inflow.subsection, "Region"), inflow.region),
                              face / 2,
                              face % 2 == 0 ? x : x - parameters.grid.cell_size / parameters.points_per_cell(inflow) });
      }
    unsigned int n_places = 0;
    for (const Part &part : *parts)
      n_places += Utilities::fixed_power<dim>(part.points_per_cell) * Region<dim>::n_places_of_cube;
    const auto loaded = [&parameters](const Point<dim> &cell) {
      return parameters.surface_load.touches_cell(&cell[0], parameters.grid, dim);
    };
    const auto fed = [sections, &parameters](const Point<dim> &cell) {
      return std::any_of(sections->begin(), sections->end(), [&](const Section &section) {
        const double beyond = section.lower - cell[section.axis], width = parameters.grid.cell_size;
        return beyond > -1e-6 * width && beyond < (1. - 1e-6) * width && section.region.touches_cube(cell, width);
      });
    };
    const auto in_cell = [parts, loaded, fed, &parameters](const Point<dim> &cell) {
      const auto touches_cell = [&](const Part &part) {
        const unsigned int n = part.points_per_cell;
        const double width   = parameters.grid.cell_size / n;
        for (unsigned int i = 0; i < Utilities::fixed_power<dim>(n); ++i)
          {
            Point<dim> corner = cell;
            for (unsigned int a = 0, rest = i; a < dim; ++a, rest /= n)
              corner[a] += width * (rest % n);
            if (part.region.touches_cube(corner, width))
              return true;
          }
        return false;
      };
      return loaded(cell) || fed(cell) || std::any_of(parts->begin(), parts->end(), touches_cell);
    };
    const auto at_place = [parts, loaded, fed](const Point<dim> &cell, const Point<dim> &x) {
      return loaded(cell) || fed(cell) ||
             std::any_of(parts->begin(), parts->end(), [&](const Part &part) { return part.region.contains(x); });
    };
    return { in_cell, at_place, n_places };
  }

  template PlacesOfPoints<2> places_of_points(const Parameters &);
  template PlacesOfPoints<3> places_of_points(const Parameters &);
} // namespace scree

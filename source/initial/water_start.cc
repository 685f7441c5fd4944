// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/initial/water_start.h>
#include <scree/input/input_error.h>
#include <scree/seeding/water_seeding.h>

#include <algorithm>
#include <cmath>

namespace scree
{
  using namespace dealii;

  template <int dim>
  std::vector<typename Overburden<dim>::Layer> effective_weight_layers(const std::vector<SoilRegion> &soil,
                                                                       const WaterParameters *water)
  {
    std::vector<typename Overburden<dim>::Layer> layers;
    for (const SoilRegion &body : soil)
      layers.emplace_back(body.template places<dim>(), body.bulk_density);
    if (!water || water->initial_pressure_kind() != InitialPressure::hydrostatic)
      return layers;
    const bool has_fringe = water->fringe > 0.;
    for (auto &part : water_parts<dim>(water->without_fringe(), soil))
      if (part.soil)
        layers.emplace_back(std::move(part.region), -(has_fringe ? 1. : 1. - part.porosity) * water->density);
    if (has_fringe)
      for (auto &part : water_parts<dim>(*water, soil))
        if (part.soil)
          layers.emplace_back(std::move(part.region), part.porosity * water->density);
    return layers;
  }


  template <int dim>
  std::vector<typename Overburden<dim>::Layer> water_layers(const WaterParameters &water,
                                                            const std::vector<SoilRegion> &soil)
  {
    // Inside and outside of the soil together: a surface between them adds nothing but its error.
    std::vector<typename Overburden<dim>::Layer> layers;
    if (water.has_levels())
      layers.emplace_back(water.density);
    if (!water.is_where_soil_is() && !water.has_levels())
      layers.emplace_back(Region<dim>(entry_name("Water", "Region"), water.region), water.density);
    else
      for (auto &part : water_parts<dim>(water.without_fringe(), soil))
        if (water.has_levels())
          layers.front().regions.push_back(std::move(part.region));
        else
          layers.emplace_back(std::move(part.region), water.density);
    return layers;
  }


  namespace
  {
    /// Suction of water at rest above the levels of the water, in the fringe; empty without one.
    template <int dim>
    SuctionAbove<dim> suction_above_table(const WaterParameters &water, const Tensor<1, dim> &gravity)
    {
      if (water.fringe == 0. || water.initial_pressure_kind() == InitialPressure::none)
        return {};
      const auto [entry, elevation] = water.place();
      const std::shared_ptr<const Expression<dim>> table =
          parse_expression<dim>(entry_name("Water", entry), elevation, 1);
      const double unit_weight = water.density * gravity.norm(), fringe = water.fringe;
      return [table, unit_weight, fringe](const Point<dim> &x) {
        const double height = x[dim - 1] - table->value(x);
        return height > 0. && height <= fringe ? unit_weight * height : 0.; // Above it the soil is dry.
      };
    }
  } // namespace


  template <int dim>
  SuctionAbove<dim> suction_at_start(const WaterParameters *water,
                                     const std::shared_ptr<const SeepageField<dim>> &seepage,
                                     const BackgroundGrid<dim> &grid,
                                     const std::vector<SoilRegion> &soil,
                                     const Tensor<1, dim> &gravity)
  {
    if (water == nullptr)
      return {};
    if (!seepage)
      return suction_above_table<dim>(*water, gravity);
    const auto water_above =
        std::make_shared<Overburden<dim>>(grid, water_layers<dim>(*water, soil), gravity, grid.cell_size() / 4);
    return [water_above, seepage, unit_weight = water->density * gravity.norm()](const Point<dim> &x) {
      const double head = seepage->pressure_head(x).first;
      return std::isnan(head) ? 0. : water_above->weight_above(x) - unit_weight * std::max(0., head);
    };
  }


  namespace
  {
    /// Horizontal gradient, Pa/m, of the weight above a place with the weight `here`; one-sided beside a face, behind
    /// which there is no water.
    template <int dim>
    Tensor<1, dim> horizontal_gradient(const std::function<double(const Point<dim> &)> &weight_above,
                                       const unsigned int vertical_axis,
                                       const Point<dim> &x,
                                       const double here,
                                       const double reach)
    {
      Tensor<1, dim> gradient;
      for (unsigned int a = 0; a < dim; ++a)
        if (a != vertical_axis)
          {
            const Tensor<1, dim> way = reach * Point<dim>::unit_vector(a);
            const double before = weight_above(x - way), behind = weight_above(x + way);
            const double first = before > 0 ? before : here, last = behind > 0 ? behind : here;
            const int n_sides = (before > 0) + (behind > 0);
            gradient[a]       = n_sides > 0 ? (last - first) / (n_sides * reach) : 0.;
          }
      return gradient;
    }
  } // namespace


  template <int dim>
  void set_hydrostatic_pressure(WaterPhase<dim> &water,
                                Overburden<dim> &water_overburden,
                                const SuctionAbove<dim> &suction,
                                const double reach)
  {
    const Tensor<1, dim> weight = water.density * water_overburden.gravity_vector();
    const auto &layout          = water.layout;
    on_all_ranks(water_overburden.communicator(), [&] {
      for_each_point(water.points(), [&](const auto &point) {
        const double pressure             = water_overburden.weight_above(point.location);
        point.properties[layout.pressure] = pressure;
        Tensor<1, dim> gradient           = weight;
        const unsigned int vertical       = water_overburden.vertical_axis();
        const double pull                 = suction ? suction(point.location) : 0.;
        if (reach > 0 && pull == 0.)
          gradient += horizontal_gradient<dim>([&](const Point<dim> &x) { return water_overburden.weight_above(x); },
                                               vertical,
                                               point.location,
                                               pressure,
                                               reach);
        else if (reach > 0)
          gradient -= horizontal_gradient<dim>(suction, vertical, point.location, pull, reach);
        point.properties[layout.pressure] -= pull;
        for (unsigned int a = 0; a < dim; ++a)
          point.properties[layout.pressure_gradient + a] = gradient[a];
      });
    });
  }


  template <int dim>
  void set_seepage_pressure(WaterPhase<dim> &water,
                            const SeepageField<dim> &field,
                            const SeepageSurvey<dim> &survey,
                            const double gravity,
                            const MPI_Comm communicator)
  {
    const double unit_weight = water.density * gravity;
    const auto &layout       = water.layout;
    const auto up            = Point<dim>::unit_vector(dim - 1);
    on_all_ranks(communicator, [&] {
      for_each_point(water.points(), [&](const auto &point) {
        const Point<dim> &x   = point.location;
        const double depth    = survey.level(x) - x[dim - 1];
        auto [head, gradient] = field.pressure_head(x);
        const bool is_free    = !survey.is_in_soil(x) && depth > 0.;
        if (is_free || std::isnan(head))
          {
            head     = std::isnan(depth) ? 0. : depth;
            gradient = -up;
          }
        point.properties[layout.pressure] = unit_weight * std::max(0., head);
        for (unsigned int a = 0; a < dim; ++a)
          point.properties[layout.pressure_gradient + a] = unit_weight * gradient[a];
      });
    });
  }

  template std::vector<Overburden<2>::Layer> effective_weight_layers<2>(const std::vector<SoilRegion> &,
                                                                        const WaterParameters *);
  template std::vector<Overburden<3>::Layer> effective_weight_layers<3>(const std::vector<SoilRegion> &,
                                                                        const WaterParameters *);
  template std::vector<Overburden<2>::Layer> water_layers<2>(const WaterParameters &, const std::vector<SoilRegion> &);
  template std::vector<Overburden<3>::Layer> water_layers<3>(const WaterParameters &, const std::vector<SoilRegion> &);
  template SuctionAbove<2> suction_at_start(const WaterParameters *,
                                            const std::shared_ptr<const SeepageField<2>> &,
                                            const BackgroundGrid<2> &,
                                            const std::vector<SoilRegion> &,
                                            const Tensor<1, 2> &);
  template SuctionAbove<3> suction_at_start(const WaterParameters *,
                                            const std::shared_ptr<const SeepageField<3>> &,
                                            const BackgroundGrid<3> &,
                                            const std::vector<SoilRegion> &,
                                            const Tensor<1, 3> &);
  template void set_hydrostatic_pressure(WaterPhase<2> &, Overburden<2> &, const SuctionAbove<2> &, const double);
  template void set_hydrostatic_pressure(WaterPhase<3> &, Overburden<3> &, const SuctionAbove<3> &, const double);
  template void set_seepage_pressure(WaterPhase<2> &,
                                     const SeepageField<2> &,
                                     const SeepageSurvey<2> &,
                                     const double,
                                     const MPI_Comm);
  template void set_seepage_pressure(WaterPhase<3> &,
                                     const SeepageField<3> &,
                                     const SeepageSurvey<3> &,
                                     const double,
                                     const MPI_Comm);
} // namespace scree

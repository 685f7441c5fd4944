// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/initial/water_start.h>
#include <scree/input/input_error.h>
#include <scree/seeding/water_seeding.h>

namespace scree
{
  using namespace dealii;

  template <int dim>
  std::vector<typename Overburden<dim>::Layer> effective_weight_layers(const std::vector<SoilRegion> &soil,
                                                                       const WaterParameters *water)
  {
    std::vector<typename Overburden<dim>::Layer> layers;
    for (const SoilRegion &body : soil)
      layers.push_back({ body.template places<dim>(), body.bulk_density });
    if (water && water->initial_pressure_kind() == InitialPressure::hydrostatic)
      for (const WaterPart &part : water_parts(*water, soil))
        if (part.soil)
          layers.push_back(
              { Region<dim>(entry_name("Water", "Region"), part.region), -(1. - part.porosity) * water->density });
    return layers;
  }


  template <int dim>
  std::vector<typename Overburden<dim>::Layer> water_layers(const WaterParameters &water,
                                                            const std::vector<SoilRegion> &soil)
  {
    // Inside and outside of the soil together: a surface between them adds nothing but its error.
    const std::string where = entry_name("Water", "Region");
    std::vector<typename Overburden<dim>::Layer> layers;
    if (!water.is_where_soil_is())
      layers.push_back({ Region<dim>(where, water.region), water.density });
    else
      for (const WaterPart &part : water_parts(water, soil))
        layers.push_back({ Region<dim>(where, part.region), water.density });
    return layers;
  }


  template <int dim>
  void set_hydrostatic_pressure(WaterPhase<dim> &water, Overburden<dim> &water_overburden)
  {
    const Tensor<1, dim> gradient = water.density * water_overburden.gravity_vector();
    const auto &layout            = water.layout;
    on_all_ranks(water_overburden.communicator(), [&] {
      for_each_point(water.points(), [&](const auto &point) {
        point.properties[layout.pressure] = water_overburden.weight_above(point.location);
        for (unsigned int a = 0; a < dim; ++a)
          point.properties[layout.pressure_gradient + a] = gradient[a];
      });
    });
  }

  template std::vector<Overburden<2>::Layer> effective_weight_layers<2>(const std::vector<SoilRegion> &,
                                                                        const WaterParameters *);
  template std::vector<Overburden<3>::Layer> effective_weight_layers<3>(const std::vector<SoilRegion> &,
                                                                        const WaterParameters *);
  template std::vector<Overburden<2>::Layer> water_layers<2>(const WaterParameters &, const std::vector<SoilRegion> &);
  template std::vector<Overburden<3>::Layer> water_layers<3>(const WaterParameters &, const std::vector<SoilRegion> &);
  template void set_hydrostatic_pressure(WaterPhase<2> &, Overburden<2> &);
  template void set_hydrostatic_pressure(WaterPhase<3> &, Overburden<3> &);
} // namespace scree

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_initial_water_start_h
#define scree_initial_water_start_h

#include <scree/initial/geostatic.h>
#include <scree/initial/seepage_cells.h>
#include <scree/initial/seepage_field.h>
#include <scree/seeding/seeding.h>
#include <scree/bodies/water_parameters.h>
#include <scree/bodies/water_phase.h>

#include <vector>

namespace scree
{
  /// The layers whose weight is the effective vertical stress of the soil: each body with its dry bulk density, and,
  /// where it is under water, less that of the water its grains displace, (1 - n) rho_w: total stress less hydrostatic
  /// pressure. The water of a fringe above the table weighs, and lifts nothing.
  /// @param water null: a dry scene; with "Initial pressure = none" nothing lifts the soil either
  template <int dim>
  std::vector<typename Overburden<dim>::Layer> effective_weight_layers(const std::vector<SoilRegion> &soil,
                                                                       const WaterParameters *water);

  /// The layers whose weight is the hydrostatic pressure: the water's region with its density, in soil and outside,
  /// without a fringe above the table.
  template <int dim>
  std::vector<typename Overburden<dim>::Layer> water_layers(const WaterParameters &water,
                                                            const std::vector<SoilRegion> &soil);

  /// How much less than the weight of the water above a place the pressure is, Pa: in the fringe above the levels of
  /// the water, and of steady seepage everywhere. It adds to the effective stress that hydrostatic uplift would leave.
  /// Empty where there is no difference.
  /// @param water null: the scene is dry
  /// @param seepage null: water is at rest
  template <int dim>
  SuctionAbove<dim> suction_at_start(const WaterParameters *water,
                                     const std::shared_ptr<const SeepageField<dim>> &seepage,
                                     const BackgroundGrid<dim> &grid,
                                     const std::vector<SoilRegion> &soil,
                                     const dealii::Tensor<1, dim> &gravity);

  /// Gives the points of water the weight of the water above them, less the suction above the table, as pressure, Pa,
  /// and density times gravity as its gradient, Pa/m. Collective.
  /// @param reach of the differences that give the horizontal gradient below an oblique surface, m; 0: it is 0
  template <int dim>
  void set_hydrostatic_pressure(WaterPhase<dim> &water,
                                Overburden<dim> &water_overburden,
                                const SuctionAbove<dim> &suction = {},
                                const double reach               = 0.);

  /// Gives the points of water the pressure of steady seepage in soil, and the hydrostatic one of the reservoir
  /// outside, with their gradients. Collective.
  template <int dim>
  void set_seepage_pressure(WaterPhase<dim> &water,
                            const SeepageField<dim> &field,
                            const SeepageSurvey<dim> &survey,
                            const double gravity,
                            const MPI_Comm communicator);
} // namespace scree

#endif

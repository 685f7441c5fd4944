// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_initial_geostatic_h
#define scree_initial_geostatic_h

#include <scree/bodies/phases.h>
#include <scree/initial/steady_seepage.h>

namespace scree
{
  /// Suction of water at rest at a place, Pa: 0 below the water table. Empty: none anywhere.
  template <int dim>
  using SuctionAbove = std::function<double(const dealii::Point<dim> &)>;

  /// The weight that lies above a place: bodies are taken as stacked along gravity, each with its bulk density.
  template <int dim>
  class Overburden
  {
  public:
    /// Regions filled with a material: parts of one column, so that none is missed where it is thin.
    struct Layer
    {
      std::vector<Region<dim>> regions; ///< places of the material
      double density;                   ///< kg/m^3; below 0 for what buoyancy lifts

      /// An empty layer.
      explicit Layer(const double density)
          : density(density)
      {
      }

      /// One region.
      Layer(Region<dim> region, const double density)
          : density(density)
      {
        regions.push_back(std::move(region));
      }
    };

    /// @param gravity m/s^2; must lie along an axis (throws otherwise)
    /// @param spacing distance at which the layers are sampled along gravity, m
    Overburden(const BackgroundGrid<dim> &grid,
               std::vector<Layer> layers,
               const dealii::Tensor<1, dim> &gravity,
               const double spacing);

    /// Vertical total stress from the weight above `x`, Pa, compression positive.
    double weight_above(const dealii::Point<dim> &x);

    /// m/s^2
    dealii::Tensor<1, dim> gravity_vector() const
    {
      dealii::Tensor<1, dim> result;
      result[axis] = -up * gravity;
      return result;
    }

    const BackgroundGrid<dim> &grid; ///< the mesh
    unsigned int axis;               ///< of gravity

  private:
    struct Piece
    {
      double begin, end; ///< heights against gravity, m
      double unit_weight;
    };

    std::vector<Piece> pieces_above(const dealii::Point<dim> &x) const;

    std::vector<Layer> layers;
    double gravity;
    double spacing;
    double up; ///< +1 if gravity points to lower coordinates

    std::map<std::array<long, dim - 1>, std::vector<Piece>> columns; // cached: neighbours share a column
  };

  /// Gives the points the geostatic stress of their depth: vertical from the weight above, horizontal K0 times that.
  /// Collective; throws EntryError if the law cannot carry that.
  /// @param modulus entry and value of the soil's stiffness, for messages
  /// @param suction that adds to the weight; empty: none
  template <int dim>
  void set_k0_stress(SoilBody<dim> &body,
                     Overburden<dim> &overburden,
                     const double k0,
                     const std::string &modulus,
                     const SuctionAbove<dim> &suction = {});

  /// Gives the points an isotropic stress, Pa, compression positive. Collective; throws EntryError if the law cannot
  /// carry that.
  /// @param modulus entry and value of the soil's stiffness, for messages
  template <int dim>
  void set_isotropic_stress(SoilBody<dim> &body,
                            const double pressure,
                            const std::string &modulus,
                            const MPI_Comm communicator);

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

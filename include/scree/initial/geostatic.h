// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_initial_geostatic_h
#define scree_initial_geostatic_h

#include <scree/mesh/background_grid.h>
#include <scree/bodies/soil_body.h>
#include <scree/particles/region.h>

#include <deal.II/base/tensor.h>

#include <functional>
#include <map>
#include <vector>

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

    /// Communicator of the mesh.
    MPI_Comm communicator() const
    {
      return grid.communicator();
    }

    /// m/s^2
    dealii::Tensor<1, dim> gravity_vector() const
    {
      dealii::Tensor<1, dim> result;
      result[axis] = -up * gravity;
      return result;
    }

    /// The axis of gravity.
    unsigned int vertical_axis() const
    {
      return axis;
    }

  private:
    struct Piece
    {
      double begin, end; ///< heights against gravity, m
      double unit_weight;
    };

    std::vector<Piece> pieces_above(const dealii::Point<dim> &x) const;

    const BackgroundGrid<dim> &grid;
    std::vector<Layer> layers;
    double gravity;
    double spacing;
    unsigned int axis;
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
} // namespace scree

#endif

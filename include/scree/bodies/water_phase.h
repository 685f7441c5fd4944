// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_bodies_water_phase_h
#define scree_bodies_water_phase_h

#include <scree/bodies/soil_body.h>

namespace scree
{
  /// Where a water point's quantities lie among its ParticleHandler properties (offsets in doubles).
  template <int dim>
  struct WaterLayout
  {
    unsigned int velocity;          ///< m/s, dim
    unsigned int mass;              ///< kg (2D: per m)
    unsigned int volume;            ///< of the water itself, m^3 (2D: per m)
    unsigned int pressure;          ///< Pa, compression positive
    unsigned int pressure_gradient; ///< Pa/m, dim
    unsigned int affine;            ///< dim x dim, row-major
    unsigned int end;               ///< past the last one

    /// @param first slot of the water's quantities: 0 for points of its own, else past those of the soil
    /// @param with_affine whether the transfer carries an affine velocity field
    WaterLayout(const unsigned int first, const bool with_affine)
        : velocity(first)
        , mass(velocity + dim)
        , volume(mass + 1)
        , pressure(volume + 1)
        , pressure_gradient(pressure + 1)
        , affine(pressure_gradient + dim)
        , end(affine + (with_affine ? dim * dim : 0))
    {
    }

    /// Doubles of one point's water.
    unsigned int n_properties() const
    {
      return end - velocity;
    }
  };

  /// Water: where its quantities lie, and the points that carry them. Double-point: points of its own, which move with
  /// the water. Single-point: it rides on the points of one body of soil and fills their pores.
  template <int dim>
  class WaterPhase
  {
  public:
    /// Water with points of its own.
    WaterPhase(const double density,
               const bool with_affine,
               const dealii::Triangulation<dim> &triangulation,
               const dealii::Mapping<dim> &mapping)
        : density(density)
        , layout(0, with_affine)
        , own_set(std::make_unique<PointSet<dim>>(triangulation, mapping, layout.n_properties()))
        , set(own_set.get())
        , soil(nullptr)
    {
    }

    /// Water on the points of `soil`, whose last slots have been set aside for it.
    WaterPhase(const double density, const bool with_affine, SoilBody<dim> &soil)
        : density(density)
        , layout(soil.layout.n_properties - WaterLayout<dim>(0, with_affine).n_properties(), with_affine)
        , set(&soil.points)
        , soil(&soil)
    {
    }

    const double density;          ///< kg/m^3
    const WaterLayout<dim> layout; ///< offsets of the water's quantities
    double affine_inertia = 0;     ///< see TransferParameters::affine_inertia()

    /// Points that carry the water: its own, or those of carrier().
    PointSet<dim> &points()
    {
      return *set;
    }

    /// Read-only access.
    const PointSet<dim> &points() const
    {
      return *set;
    }

    /// The water's own points; null if it rides on those of a body of soil.
    PointSet<dim> *own_points()
    {
      return own_set.get();
    }

    /// The body of soil whose points carry the water; null if it has its own.
    const SoilBody<dim> *carrier() const
    {
      return soil;
    }

  private:
    std::unique_ptr<PointSet<dim>> own_set;
    PointSet<dim> *set;
    const SoilBody<dim> *soil;
  };
} // namespace scree

#endif

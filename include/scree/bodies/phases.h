// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_bodies_phases_h
#define scree_bodies_phases_h

#include <scree/bodies/water_parameters.h>
#include <scree/materials/material.h>
#include <scree/tensor/components.h>

namespace scree
{
  constexpr double smallest_porosity = 1e-3; ///< keeps the drag finite where grains overlap

  /// The drag of water on the grains that it flows past, per volume of saturated soil: (R + (1-n) b |q|) q, N/m^3, with
  /// the superficial velocity q = n (v_w - v_s). Darcy: R = n rho_w g/k and b = 0 with a given conductivity k. Ergun
  /// (@source{ergun1952}), who found the gradient 150 mu (1-n)^2/(n^3 d^2) q + 1.75 rho_w (1-n)/(n^3 d) q^2 of the
  /// pressure in beds of grains of diameter d: R = 150 mu (1-n)^2/(n^2 d^2), b = 1.75 rho_w/(n^2 d), as the drag is n
  /// times that gradient.
  class DragLaw
  {
  public:
    /// @param initial_porosity at which a given conductivity holds
    DragLaw(const WaterParameters &water, const double initial_porosity)
        : unit_weight(water.density * standard_gravity)
        , is_constant(water.grain_diameter == 0 && water.conductivity_law == "constant")
        , per_grains(water.grain_diameter > 0 ? 1.75 * water.density / water.grain_diameter : 0.)
    {
      if (water.grain_diameter > 0)
        factor = unit_weight * water.grain_diameter * water.grain_diameter / (150. * water.viscosity);
      else
        factor = is_constant ? water.conductivity
                             : water.conductivity / kozeny_carman(std::max(initial_porosity, smallest_porosity));
    }

    /// Of slow flow, m/s.
    double conductivity(const double porosity) const
    {
      return is_constant ? factor : factor * kozeny_carman(porosity);
    }

    /// R, N s/m^4.
    double linear(const double porosity) const
    {
      return porosity * unit_weight / conductivity(porosity);
    }

    /// b, N s^2/m^5: per volume of grains.
    double inertial(const double porosity) const
    {
      return per_grains / (porosity * porosity);
    }

  private:
    static constexpr double standard_gravity = 9.81; // m/s^2

    static double kozeny_carman(const double n)
    {
      return n * n * n / ((1. - n) * (1. - n));
    }

    const double unit_weight; // of water, N/m^3, at standard gravity: what defines the conductivity
    const bool is_constant;
    double factor;           // the conductivity, m/s; or what n^3/(1-n)^2 is multiplied with
    const double per_grains; // n^2 b, N s^2/m^5
  };

  /// Where a point's quantities lie among its ParticleHandler properties (offsets in doubles).
  /// Slots that a run does not need (internal variables, affine matrix) are not allocated.
  template <int dim>
  struct PropertyLayout
  {
    static constexpr unsigned int velocity           = 0;       ///< m/s, dim
    static constexpr unsigned int mass               = dim;     ///< kg (2D: per m)
    static constexpr unsigned int volume             = dim + 1; ///< m^3 (2D: per m)
    static constexpr unsigned int left_cauchy_green  = dim + 2; ///< b_e, -
    static constexpr unsigned int stress             = left_cauchy_green + n_symmetric_components<dim>; ///< Cauchy, Pa
    static constexpr unsigned int internal_variables = stress + n_symmetric_components<dim>; ///< as the law says
    unsigned int affine;                                                                     ///< dim x dim, row-major
    unsigned int damping;      ///< stress of the damping of the skeleton, Pa, n_symmetric_components<dim>
    bool has_damping;          ///< whether points have it
    unsigned int start;        ///< location at the start of the run, m, dim
    unsigned int n_properties; ///< doubles of a point in total

    /// @param n_internal_variables of the material law
    /// @param with_affine whether the transfer carries an affine velocity field
    /// @param with_damping whether the skeleton is damped
    /// @param n_further slots behind the soil's own: of water that rides on the points
    PropertyLayout(const unsigned int n_internal_variables,
                   const bool with_affine,
                   const unsigned int n_further = 0,
                   const bool with_damping      = false)
        : affine(internal_variables + n_internal_variables)
        , damping(affine + (with_affine ? dim * dim : 0))
        , has_damping(with_damping)
        , start(damping + (with_damping ? n_symmetric_components<dim> : 0))
        , n_properties(start + dim + n_further)
    {
    }
  };

  /// A body of soil: its points, where their quantities lie, and the law that moves them.
  template <int dim>
  struct SoilBody
  {
    std::string name;                        ///< name of its subsection
    double density;                          ///< bulk density of the dry soil at J = 1, kg/m^3
    double grain_density;                    ///< kg/m^3
    double spacing = 0;                      ///< of its points at the start, m
    std::unique_ptr<Material<dim>> material; ///< the law; holds no state of points
    PropertyLayout<dim> layout;              ///< offsets of the quantities of a point
    PointSet<dim> points;                    ///< its points on this rank
    bool has_affine_energy = false;          ///< see TransferParameters::has_affine_energy()
    bool is_rigid          = false;          ///< its points keep their place and carry any stress
    unsigned int group     = 0;              ///< bodies of a group stick to each other and share a velocity field
    std::optional<DragLaw> drag;             ///< on water; none in a dry scene

    /// Makes a body without points.
    /// @param density bulk density of the dry soil at J = 1, kg/m^3
    /// @param grain_density kg/m^3
    SoilBody(const std::string &name,
             const double density,
             const double grain_density,
             std::unique_ptr<Material<dim>> material,
             const PropertyLayout<dim> &layout,
             const dealii::Triangulation<dim> &triangulation,
             const dealii::Mapping<dim> &mapping)
        : name(name)
        , density(density)
        , grain_density(grain_density)
        , material(std::move(material))
        , layout(layout)
        , points(triangulation, mapping, layout.n_properties)
    {
    }

    /// See Material::wave_speed().
    double wave_speed(const double bulk_modulus, const double compression) const
    {
      return material->wave_speed(bulk_modulus, compression, density);
    }

    /// Volume of a point's pores, m^3 (2D: per m): not positive where grains overlap.
    double pore_volume(const double *properties) const
    {
      return properties[layout.volume] - properties[layout.mass] / grain_density;
    }

    /// Volume of pores over total volume of a point.
    double porosity(const double *properties) const
    {
      return pore_volume(properties) / properties[layout.volume];
    }

    /// The slots of a cell's points that the law reads and writes.
    MaterialPoints<dim> material_points(const CellPoints<dim> &cell) const
    {
      return { cell.n_points,
               points.stride(),
               cell.properties + layout.left_cauchy_green,
               cell.properties + layout.stress,
               cell.properties + layout.internal_variables,
               cell.slots };
    }
  };

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

    const double density;           ///< kg/m^3
    const WaterLayout<dim> layout;  ///< offsets of the water's quantities
    bool has_affine_energy = false; ///< see TransferParameters::has_affine_energy()

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

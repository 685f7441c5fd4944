// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_bodies_suspension_h
#define scree_bodies_suspension_h

#include <deal.II/base/parameter_handler.h>

#include <string>

namespace scree
{
  /// How the viscosity of a suspension follows the volume of its grains.
  enum class SuspensionLaw
  {
    none,             ///< the grains add nothing
    einstein,         ///< mu (1 + 5/2 phi): @source{einstein1911}, dilute
    krieger_dougherty ///< mu (1 - phi/phi_m)^(-5/2 phi_m): @source{krieger1959}, eq. 13
  };

  /// Subsection Suspension of subsection Water.
  struct SuspensionParameters
  {
    std::string law         = "none"; ///< none | Einstein | Krieger-Dougherty
    double densest_packing  = 0.64;   ///< phi_m
    double contact_pressure = 100;    ///< Pa

    /// Declares the entries in the subsection that is open.
    void add_parameters(dealii::ParameterHandler &prm);

    /// Throws EntryError at what nothing reads.
    /// @param viscosity of the water, Pa s
    void check(const double viscosity, const unsigned int n_bodies) const;

    SuspensionLaw law_kind() const; ///< entry `Law` as an enum
  };

  /// Viscosity of water with grains that bear no stress on each other.
  class Suspension
  {
  public:
    /// @param water_viscosity Pa s
    Suspension(const SuspensionParameters &parameters, const double water_viscosity);

    /// Whether grains add anything.
    bool any() const
    {
      return law != SuspensionLaw::none;
    }

    /// Pa s, where grains take this part of the volume. Krieger and Dougherty's law is infinite from the densest
    /// packing on; it is held from 0.99 of that on.
    double viscosity(const double grain_fraction) const;

    /// The part of the soil that is suspended at a mean effective stress, Pa: all of it without stress, nothing from
    /// the contact pressure on, linear between, so that single points do not switch.
    double suspended_part(const double pressure) const;

  private:
    const SuspensionLaw law;
    const double water_viscosity, densest_packing, contact_pressure;
  };
} // namespace scree

#endif

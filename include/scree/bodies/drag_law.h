// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_bodies_drag_law_h
#define scree_bodies_drag_law_h

#include <scree/bodies/water_parameters.h>

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
        , is_constant(water.grain_diameter == 0 && water.conductivity_law_kind() == ConductivityLaw::constant)
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
} // namespace scree

#endif

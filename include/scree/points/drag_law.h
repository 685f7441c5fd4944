// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_points_drag_law_h
#define scree_points_drag_law_h

#include <scree/points/water_parameters.h>

namespace scree
{
  constexpr double smallest_porosity = 1e-3; ///< keeps the drag finite where grains overlap

  /// The drag of water on the grains that it flows past, per volume of saturated soil: (Q + (1-n) b |v_w - v_s|)
  /// (v_w - v_s), N/m^3. Darcy: Q = n^2 rho_w g/k and b = 0 with a given conductivity k. Ergun (1952), who found the
  /// gradient 150 mu (1-n)^2/(n^3 d^2) U + 1.75 rho_w (1-n)/(n^3 d) U^2 of the pressure with U = n |v_w - v_s| in beds
  /// of grains of diameter d: Q = 150 mu (1-n)^2/(n d^2), b = 1.75 rho_w/d, as the drag is n times that gradient.
  class DragLaw
  {
  public:
    /// @param initial_porosity at which a given conductivity holds
    DragLaw(const WaterParameters &water, const double initial_porosity);

    /// Of slow flow, m/s.
    double conductivity(const double porosity) const
    {
      return is_constant ? factor : factor * kozeny_carman(porosity);
    }

    /// Q, N s/m^4.
    double linear(const double porosity) const
    {
      return porosity * porosity * unit_weight / conductivity(porosity);
    }

    /// b, N s^2/m^5: per volume of grains.
    double inertial() const
    {
      return per_grains;
    }

  private:
    static double kozeny_carman(const double n)
    {
      return n * n * n / ((1. - n) * (1. - n));
    }

    const double unit_weight; // of water, N/m^3, at standard gravity: what defines the conductivity
    const bool is_constant;
    double factor; // the conductivity, m/s; or what n^3/(1-n)^2 is multiplied with
    const double per_grains;
  };
} // namespace scree

#endif

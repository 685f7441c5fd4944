// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef scree_materials_inertial_friction_h
#define scree_materials_inertial_friction_h

#include <scree/materials/law_entries.h>
#include <scree/simd/batch.h>

#include <limits>

namespace scree
{
  /// Entries of a law with friction that grows with the rate of shear.
  struct InertialFrictionParameters
  {
    double grain_diameter    = 0;    ///< d, m; 0: friction does not depend on the rate
    double reference_number  = 0.3;  ///< I_0, -
    double friction_increase = 0.26; ///< Delta mu, -

    /// Declares the entries in the subsection that is open.
    void add_parameters(dealii::ParameterHandler &prm);
  };


  /// Friction of grains that flow: tau/p = mu_s + Delta mu/(1 + I_0/I) with the inertial number
  /// I = gamma_dot d sqrt(rho_s/p) (@source{jop2006}), where mu_s is the friction of the law without a rate.
  ///
  /// The overstress is that of Duvaut & Lions (@source{simo1998}, 2.7): of the change that a return map makes to
  /// elastic strain and internal variables, a part x is taken back. With tau_o = G gamma, the overstress before the
  /// part is taken, and I_1, the inertial number if the whole gamma flows in the step,
  ///   x tau_o = Delta mu p/(1 + I_0/((1 - x) I_1)),
  /// a quadratic equation, of which the smaller root lies between 0 and 1.
  class InertialFriction
  {
  public:
    /// Friction that does not depend on the rate if the diameter or the increase is 0.
    explicit InertialFriction(const InertialFrictionParameters &parameters)
        : grain_diameter(parameters.friction_increase > 0 ? parameters.grain_diameter : 0)
        , reference_number(parameters.reference_number)
        , friction_increase(parameters.friction_increase)
    {
    }

    /// Whether friction depends on the rate.
    bool is_active() const
    {
      return grain_diameter > 0;
    }

    /// Grain diameter d, m.
    double diameter() const
    {
      return grain_diameter;
    }

    /// The part x; 0 where there is no pressure.
    /// @param plastic_shear gamma = sqrt(2 e : e) of the change e of the elastic deviator
    /// @param shear_modulus G, Pa
    /// @param pressure p after the return, Pa
    /// @param grain_density kg/m^3
    /// @param time_step s; infinite: slow
    template <typename Number>
    Number kept_part(const Number &plastic_shear,
                     const double shear_modulus,
                     const Number &pressure,
                     const double grain_density,
                     const Number &time_step) const
    {
      constexpr double smallest_pressure = 1e-3; // Pa; I is not defined without pressure
      const Number p                     = simd::max<Number>(pressure, simd::broadcast<Number>(smallest_pressure));
      const Number over                  = shear_modulus * plastic_shear;
      const Number whole =
          plastic_shear * grain_diameter * std::sqrt(grain_density) / (time_step * simd::sqrt<Number>(p));
      const Number limit  = friction_increase * p * whole;
      const Number middle = over * (reference_number + whole) + limit;
      const Number root   = simd::sqrt<Number>(
          simd::max<Number>(middle * middle - 4. * over * whole * limit, simd::broadcast<Number>(0.)));
      const Number part = 2. * limit / simd::max<Number>(middle + root, simd::broadcast<Number>(1e-300));
      return simd::select<Number>(pressure > smallest_pressure, part, simd::broadcast<Number>(0.));
    }

  private:
    const double grain_diameter;    // m
    const double reference_number;  // I_0
    const double friction_increase; // Delta mu
  };
} // namespace scree

#endif

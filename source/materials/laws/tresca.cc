// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/input/case_entries.h>
#include <scree/input/input_error.h>
#include <scree/materials/laws/tresca.h>

using namespace dealii;

namespace scree
{
  namespace
  {
    constexpr char cut_off_text[] = "Pa; largest principal stress. 0: soil in tension comes apart.";

    MohrCoulombParameters mohr_coulomb(const TrescaParameters &parameters)
    {
      MohrCoulombParameters law;
      static_cast<LinearElasticParameters &>(law) = parameters;
      law.friction_angle                          = 0;
      law.cohesion                                = 1; // not read: each point has its own
      law.tension_cut_off                         = parameters.tension_cut_off;
      return law;
    }
  } // namespace


  void TrescaParameters::add_parameters(ParameterHandler &prm)
  {
    prm.add_parameter("Young's modulus", young_modulus, "Pa; Young's modulus.", Patterns::Double(0));
    prm.add_parameter("Poisson's ratio",
                      poisson_ratio,
                      "Poisson's ratio; of clay without drainage, nearly 0.5.",
                      Patterns::Double(-1, 0.5));
    add_place_entry(
        prm,
        "Undrained strength",
        strength,
        strength_of_place,
        "Pa; undrained shear strength s_u, half of the largest difference of principal stresses, at slow shear before "
        "any softening.");
    prm.add_parameter("Tension cut-off", tension_cut_off, cut_off_text, Patterns::Double(0));
    prm.add_parameter("Sensitivity",
                      sensitivity,
                      "Strength before shear over that of remoulded clay, S_t. 1: strength does not fall.",
                      Patterns::Double(1));
    prm.add_parameter(
        "Remoulding strain",
        remoulding_strain,
        "Plastic shear strain (engineering strain: gamma in simple shear) at 95 % of the loss of strength: "
        "1/S_t + (1 - 1/S_t) exp(-3 strain/this).",
        Patterns::Double(0));
    prm.add_parameter(
        "Nonlocal length",
        nonlocal_length,
        "m; length l over which the strain that softens the clay is averaged; cells must not be wider than "
        "l/2. 0: shear bands are one to two cells wide.",
        Patterns::Double(0));
    prm.add_parameter(
        "Rate increase",
        rate_increase,
        "Part by which strength grows if shear is ten times faster; of clay 0.05 to 0.2. 0: strength does "
        "not depend on the rate. Element tests are slow and do not depend on it.",
        Patterns::Double(0, 1));
    prm.add_parameter(
        "Reference rate",
        reference_rate,
        "1/s; rate of plastic shear up to which strength is \"Undrained strength\". 1 % per hour is 3e-6.",
        Patterns::Double(1e-12));
  }


  void TrescaParameters::check(const std::string &subsection) const
  {
    LinearElasticParameters::check(subsection);
    const TrescaParameters defaults;
    const bool softens = sensitivity > 1;
    require_entry(softens || remoulding_strain == 0,
                  { subsection, "Remoulding strain", remoulding_strain },
                  "this entry has no effect without \"Sensitivity\" above 1. Add one, or remove the entry.");
    require_entry(!softens || remoulding_strain > 0,
                  { subsection, "Sensitivity", sensitivity },
                  "strength falls with strain. Add a \"Remoulding strain\", such as 1.");
    require_entry(softens || nonlocal_length == 0,
                  { subsection, "Nonlocal length", nonlocal_length },
                  "this entry has no effect without \"Sensitivity\" above 1. Add one, or remove the entry.");
    require_entry(rate_increase > 0 || reference_rate == defaults.reference_rate,
                  { subsection, "Reference rate", reference_rate },
                  "this entry has no effect without \"Rate increase\". Add one, or remove the entry.");
  }


  HerschelBulkleyParameters::HerschelBulkleyParameters()
  {
    young_modulus  = 1e6;
    strength       = 1e3;
    consistency    = 100;
    strength_entry = "Yield stress";
  }


  void HerschelBulkleyParameters::add_parameters(ParameterHandler &prm)
  {
    prm.add_parameter("Young's modulus",
                      young_modulus,
                      "Pa; Young's modulus below the yield stress. A small one allows long steps.",
                      Patterns::Double(0));
    prm.add_parameter("Poisson's ratio", poisson_ratio, "Poisson's ratio.", Patterns::Double(-1, 0.5));
    add_place_entry(prm,
                    "Yield stress",
                    strength,
                    strength_of_place,
                    "Pa; yield stress tau_y in shear: half of the largest difference of principal stresses.");
    prm.add_parameter("Consistency",
                      consistency,
                      "Pa s^n; K of tau = tau_y + K gamma_dot^n with the rate of plastic shear gamma_dot in 1/s. With "
                      "index 1 the viscosity in Pa s. Element tests are slow and do not depend on it.",
                      Patterns::Double(0));
    prm.add_parameter(
        "Flow index", index, "n; 1: Bingham. Below 1, mud thins with the rate of shear.", Patterns::Double(0.05, 3));
    prm.add_parameter("Tension cut-off", tension_cut_off, cut_off_text, Patterns::Double(0));
  }


  void HerschelBulkleyParameters::check(const std::string &subsection) const
  {
    LinearElasticParameters::check(subsection);
    require_entry(consistency > 0 || index == HerschelBulkleyParameters().index,
                  { subsection, "Flow index", index },
                  "this entry has no effect without \"Consistency\". Write one above 0, or remove the entry.");
  }


  namespace
  {
    const RegisterLaw registered_tresca = RegisterLaw::of<Tresca, TrescaParameters>("Tresca", "Tresca");
    const RegisterLaw registered_herschel_bulkley =
        RegisterLaw::of<Tresca, HerschelBulkleyParameters>("Herschel-Bulkley", "Herschel-Bulkley");
  } // namespace


  Tresca::Tresca(const TrescaParameters &parameters)
      : MohrCoulomb(mohr_coulomb(parameters))
      , rate_of_strength(parameters.rate_increase, parameters.reference_rate, parameters.consistency, parameters.index)
      , scale(1 / parameters.reduction)
      , residual(1 / parameters.sensitivity)
      , decay(parameters.sensitivity > 1 ? 3 / parameters.remoulding_strain : 0)
  {
    internal_quantities.insert(
        internal_quantities.end(),
        { { "softening_strain", "-" }, { "nonlocal_softening_strain", "-" }, { "undrained_strength", "Pa" } });
    nonlocal_variable    = { parameters.nonlocal_length, own_kappa, acting_kappa };
    const double largest = parameters.sensitivity > 1
                               ? shear_modulus * parameters.remoulding_strain / (3 * (1 - 1 / parameters.sensitivity))
                               : std::numeric_limits<double>::infinity();
    const auto fault     = [largest](const double *variables) -> std::string {
      if (!(variables[of_place] > 0))
        return "Write values that are positive in the whole body.";
      return variables[of_place] <= largest
                     ? ""
                     : "Beyond " + number_text(largest) +
                       ", strength falls faster with strain than elastic stress can. Write a "
                           "larger \"Remoulding strain\" or \"Young's modulus\".";
    };
    place_variables = {
      { parameters.strength_entry, "Pa", parameters.strength, parameters.strength_of_place, of_place, nullptr, fault }
    };
  }


  void Tresca::initialise(const PrincipalValues &wanted_stress,
                          PrincipalValues &strain,
                          PrincipalValues &stress,
                          double *internal_variables) const
  {
    internal_variables[plastic_shear] = internal_variables[own_kappa] = internal_variables[acting_kappa] = 0;
    const auto [smallest, largest] = std::minmax_element(wanted_stress.begin(), wanted_stress.end());
    const double strength = slow_strength(internal_variables), shear_stress = 0.5 * (*largest - *smallest);
    const double rounding = 1e-9 * (strength - *smallest);
    AssertThrow(shear_stress <= strength + rounding && *largest <= largest_principal_stress + rounding,
                ExcMessage("the initial stress exceeds the undrained strength or yield stress of " +
                           number_text(strength) + " Pa: shear stress " + number_text(shear_stress) +
                           " Pa. Write a K0 nearer to 1."));
    elastic.initialise(wanted_stress, strain, stress, nullptr);
  }
} // namespace scree

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/input/case_entries.h>
#include <scree/input/input_error.h>
#include <scree/materials/laws/mohr_coulomb.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <numeric>

using namespace dealii;

namespace scree
{
  namespace
  {
    double radians(const double degrees)
    {
      return degrees * numbers::PI / 180;
    }

    constexpr double largest_angle = 89;                  // of friction, degrees
    constexpr char of_plane[] = "direct shear or repose"; // kind of a friction angle: tau/sigma on a plane of shear
  }                                                       // namespace


  double divided_angle(const double degrees, const double factor)
  {
    return std::atan(std::tan(radians(degrees)) / factor) * 180 / numbers::PI;
  }


  void InertialFrictionParameters::add_parameters(ParameterHandler &prm)
  {
    prm.add_parameter(
        "Grain diameter",
        grain_diameter,
        "m; grain diameter d in the inertial number I of dry grains: tau/p grows by 0.26/(1 + 0.3/I) with "
        "the rate of shear. 0: friction does not depend on it. Element tests are slow and do not depend "
        "on it.",
        Patterns::Double(0));
  }


  void SofteningParameters::add_parameters(ParameterHandler &prm)
  {
    prm.add_parameter("Softening strain",
                      strain,
                      "Plastic shear strain kappa of the plane of shear (engineering strain: gamma in simple shear) at "
                      "which the fall from peak to residual strength has reached 63 %: strength = residual + (peak - "
                      "residual) exp(-kappa/this). 0: strength does not depend on strain.",
                      Patterns::Double(0));
    prm.add_parameter(
        "Residual cohesion", cohesion, "Pa; cohesion after much shear. -1: as \"Cohesion\".", Patterns::Double(-1));
    prm.add_parameter("Residual friction angle",
                      friction_angle,
                      "degrees; friction angle after much shear, of the kind of \"Friction angle\". -1: as \"Friction "
                      "angle\".",
                      Patterns::Double(-1, 89));
    prm.add_parameter("Residual dilation angle",
                      dilation_angle,
                      "degrees; dilation angle after much shear. -1: as \"Dilation angle\".",
                      Patterns::Double(-1, 89));
    prm.add_parameter(
        "Nonlocal length",
        nonlocal_length,
        "m; length l over which the strain that softens the soil is averaged. Shear bands are then about two l "
        "wide; cells must not be wider than l/2. 0: shear bands are one to two cells wide.",
        Patterns::Double(0));
  }


  void SofteningParameters::check(const std::string &subsection) const
  {
    const std::pair<const char *, double> residuals[] = { { "Residual cohesion", cohesion },
                                                          { "Residual friction angle", friction_angle },
                                                          { "Residual dilation angle", dilation_angle } };
    bool falls                                        = false;
    for (const auto &[entry, value] : residuals)
      {
        falls = falls || value != as_peak;
        require_entry(
            value >= 0 || value == as_peak, { subsection, entry, value }, "write 0 or more, or -1 for the peak value.");
        require_entry(is_active() || value == as_peak,
                      { subsection, entry, value },
                      "this entry has no effect without \"Softening strain\". Add one, or remove the entry.");
      }
    require_entry(!is_active() || falls,
                  { subsection, "Softening strain", strain },
                  "no strength falls. Add \"Residual cohesion\" or \"Residual friction angle\".");
    require_entry(is_active() || nonlocal_length == 0,
                  { subsection, "Nonlocal length", nonlocal_length },
                  "this entry has no effect without \"Softening strain\". Add one, or remove the entry.");
  }


  void MohrCoulombParameters::add_parameters(ParameterHandler &prm)
  {
    LinearElasticParameters::add_parameters(prm);
    add_place_entry(prm, "Friction angle", friction_angle, friction_angle_of_place, "degrees; friction angle phi.");
    prm.add_parameter("Friction angle kind",
                      angle_kind,
                      "Test that \"Friction angle\" comes from. triaxial: phi is this angle. plane strain: the same. "
                      "direct shear or repose: its tangent is tau/sigma on a plane of shear, and phi is larger.",
                      Patterns::Selection(std::string("triaxial|plane strain|") + of_plane));
    prm.add_parameter("Dilation angle",
                      dilation_angle,
                      "degrees; dilation angle psi, at most the friction angle.",
                      Patterns::Double(0, 89));
    add_place_entry(prm, "Cohesion", cohesion, cohesion_of_place, "Pa; cohesion c.");
    prm.add_parameter("Tension cut-off",
                      cut_off,
                      "Pa; largest principal stress, at most c cot(phi). auto: with water the cohesion, or what it may "
                      "be at most; in dry cases 0.");
    softening.add_parameters(prm);
    inertial_friction.add_parameters(prm);
  }


  double MohrCoulombParameters::sine() const
  {
    const double angle = radians(friction_angle), psi = radians(dilation_angle);
    return angle_kind != of_plane ? std::sin(angle)
                                  : std::tan(angle) / (std::cos(psi) + std::sin(psi) * std::tan(angle));
  }


  double MohrCoulombParameters::apex() const
  {
    if (cohesion == 0)
      return 0;
    const double sine = this->sine();
    return sine > 0 ? cohesion * std::sqrt(1 - sine * sine) / sine : std::numeric_limits<double>::infinity();
  }


  MohrCoulombParameters MohrCoulombParameters::residual() const
  {
    MohrCoulombParameters parameters = *this;
    parameters.softening             = {};
    parameters.cohesion              = softening.residual(softening.cohesion, cohesion);
    parameters.friction_angle        = softening.residual(softening.friction_angle, friction_angle);
    parameters.dilation_angle        = softening.residual(softening.dilation_angle, dilation_angle);
    return parameters;
  }


  void MohrCoulombParameters::check_softening(const std::string &subsection) const
  {
    softening.check(subsection);
    const MohrCoulombParameters last = residual();
    const auto require = [&](const bool is_met, const std::string &entry, const double value, const std::string &text) {
      require_entry(is_met, { subsection, entry, value }, text);
    };
    const auto require_fall =
        [&](const std::string &entry, const double value, const double peak, const std::string &unit) {
          require(value <= peak,
                  "Residual " + entry,
                  value,
                  (entry == "dilation angle" ? "dilation" : "strength") + std::string(" falls from its peak, here ") +
                      number_text(peak) + ' ' + unit + "; lower the value.");
        };
    require_fall("cohesion", last.cohesion, cohesion, "Pa");
    require_fall("friction angle", last.friction_angle, friction_angle, "degrees");
    require_fall("dilation angle", last.dilation_angle, dilation_angle, "degrees");
    require(last.dilation_angle <= last.friction_angle,
            "Residual dilation angle",
            last.dilation_angle,
            "beyond the residual friction angle, here " + number_text(last.friction_angle) +
                ", plastic flow would create energy; lower it.");
    require(last.friction_angle > 0 || last.cohesion > 0,
            "Residual cohesion",
            last.cohesion,
            "without residual friction the soil needs some residual cohesion to have any strength.");
    require(!softening.is_active() || last.cohesion < cohesion || last.friction_angle < friction_angle ||
                last.dilation_angle < dilation_angle,
            "Softening strain",
            softening.strain,
            "no strength falls, as the residual values are those of the peak. Lower one of them.");
    require(tension_cut_off <= last.apex(),
            "Tension cut-off",
            tension_cut_off,
            "residual cohesion and friction allow at most " + number_text(last.apex()) + " Pa; lower it.");
  }


  void MohrCoulombParameters::complete(const std::string &subsection, const bool in_water)
  {
    const MohrCoulombParameters last = residual();
    require_entry(cut_off != "auto" || !in_water || !varies(),
                  { subsection, "Tension cut-off", cut_off },
                  "in water it depends on the strength, which differs from place to place. Write a number, in Pa, at "
                  "most the least cohesion.");
    if (cut_off == "auto")
      tension_cut_off = in_water ? std::min({ cohesion, apex(), last.cohesion, last.apex() }) : 0.;
    else
      tension_cut_off = number_of(cut_off);
    require_entry(std::isfinite(tension_cut_off) && tension_cut_off >= 0.,
                  { subsection, "Tension cut-off", cut_off },
                  "write auto, or a number from 0 on, in Pa.");
  }


  void MohrCoulombParameters::check_varying(const std::string &subsection) const
  {
    const auto [entry, text] = cohesion_of_place.empty() ? std::make_pair("Friction angle", friction_angle_of_place)
                                                         : std::make_pair("Cohesion", cohesion_of_place);
    require_entry(!softening.is_active(),
                  { subsection, entry, text },
                  "a strength that differs from place to place cannot soften. Write a number, or remove \"Softening "
                  "strain\".");
    require_entry(inertial_friction.grain_diameter == 0,
                  { subsection, "Grain diameter", inertial_friction.grain_diameter },
                  "a strength that differs from place to place cannot grow with the rate. Write 0, or numbers for the "
                  "strength.");
  }


  void MohrCoulombParameters::check(const std::string &subsection) const
  {
    LinearElasticParameters::check(subsection);
    require_entry(friction_angle >= 0 && friction_angle <= largest_angle,
                  { subsection, "Friction angle", friction_angle },
                  "write a number from 0 to 89, in degrees.");
    require_entry(cohesion >= 0, { subsection, "Cohesion", cohesion }, "write a number from 0 on, in Pa.");
    if (varies())
      return check_varying(subsection);
    require_entry(dilation_angle <= friction_angle,
                  { subsection, "Dilation angle", dilation_angle },
                  "beyond the friction angle, here " + number_text(friction_angle) +
                      ", plastic flow would create energy; lower it.");
    require_entry(sine() <= std::sin(radians(89.)),
                  { subsection, "Friction angle", friction_angle },
                  "as an angle of direct shear it has no friction angle phi below 89 degrees; lower it, or change "
                  "\"Friction angle kind\".");
    require_entry(inertial_friction.grain_diameter == 0 || sine() + inertial_friction.friction_increase < 1,
                  { subsection, "Grain diameter", inertial_friction.grain_diameter },
                  "with sin(phi) = " + number_text(sine()) + " grains in rapid shear, whose tau/p is larger by " +
                      number_text(inertial_friction.friction_increase) +
                      ", would bear tension. Write a smaller \"Friction angle\", or 0.");
    require_entry(friction_angle > 0 || cohesion > 0,
                  { subsection, "Cohesion", cohesion },
                  "without friction the soil needs some cohesion to have any strength.");
    require_entry(tension_cut_off <= apex(),
                  { subsection, "Tension cut-off", tension_cut_off },
                  "cohesion and friction allow at most c cot(phi) = " + std::to_string(apex()) +
                      " Pa; lower it, or look at the unit of \"Cohesion\", Pa.");
    check_softening(subsection);
  }


  namespace
  {
    /// Divides tan(phi), of phi itself, cohesion and cut-off. The increase of inertial friction stays, as far as the
    /// grains take no tension.
    void divide(MohrCoulombParameters &law, const double factor)
    {
      law.friction_angle = divided_angle(std::asin(law.sine()) * 180. / numbers::PI, factor);
      law.angle_kind     = "triaxial";
      law.dilation_angle = std::min(law.dilation_angle, law.friction_angle);
      law.cohesion /= factor;
      law.tension_cut_off = std::min(law.tension_cut_off / factor, law.apex());
      double &increase    = law.inertial_friction.friction_increase;
      increase            = std::min(increase, 0.999 * (1. - law.sine()));
    }
  } // namespace


  bool MohrCoulombParameters::divide_strength(const double factor)
  {
    if (varies())
      {
        reduction *= factor;
        tension_cut_off /= std::max(factor, 1.); // c cot(phi) of the points stays
        return true;
      }
    MohrCoulombParameters last = residual(); // before the peak changes
    divide(*this, factor);
    if (!softening.is_active())
      return true;
    divide(last, factor);
    softening.cohesion       = last.cohesion;
    softening.friction_angle = last.friction_angle;
    softening.dilation_angle = last.dilation_angle;
    tension_cut_off          = std::min(tension_cut_off, last.tension_cut_off);
    return true;
  }


  namespace
  {
    /// The law of one strength is another one: its yield surfaces are constant.
    template <int dim>
    std::unique_ptr<Material<dim>> make_mohr_coulomb(const LawEntries &entries)
    {
      const auto &parameters = static_cast<const MohrCoulombParameters &>(entries);
      if (parameters.softening.is_active())
        return RegisterLaw::make<dim, SofteningMohrCoulomb, MohrCoulombParameters>(parameters);
      if (parameters.varies())
        return RegisterLaw::make<dim, VaryingMohrCoulomb, MohrCoulombParameters>(parameters);
      return RegisterLaw::make<dim, MohrCoulomb, MohrCoulombParameters>(parameters);
    }

    const RegisterLaw registered_mohr_coulomb({ "Mohr-Coulomb",
                                                "Mohr-Coulomb",
                                                std::make_shared<const MohrCoulombParameters>(),
                                                RegisterLaw::copy<MohrCoulombParameters>,
                                                make_mohr_coulomb<2>,
                                                make_mohr_coulomb<3> });


    MohrCoulombStrength<double> strength_of(const MohrCoulombParameters &parameters)
    {
      const double sine = parameters.sine();
      return { sine,
               std::sin(radians(parameters.dilation_angle)),
               2 * parameters.cohesion * std::sqrt(1 - sine * sine) };
    }


    double tangent_of_angle(const MohrCoulombParameters &parameters)
    {
      const double sine = parameters.sine();
      return sine / std::sqrt(1 - sine * sine);
    }


    double tangent_of_dilation(const MohrCoulombParameters &parameters)
    {
      return std::tan(radians(parameters.dilation_angle));
    }
  } // namespace


  MohrCoulomb::MohrCoulomb(const MohrCoulombParameters &parameters)
      : own_strength(strength_of(parameters))
      , elastic(parameters)
      , bulk(elastic.bulk_modulus(0))
      , vertex(std::min(parameters.tension_cut_off, parameters.apex()))
      , largest_principal_stress(parameters.tension_cut_off)
      , cohesionless(parameters.apex() == 0)
      , inertial_friction(parameters.inertial_friction)
      , surfaces(own_strength,
                 largest_principal_stress,
                 bulk,
                 elastic.shear_modulus,
                 largest_principal_stress < parameters.apex()) // else the cut-off only touches the apex
  {
    shear_modulus = elastic.shear_modulus;
    if (cohesionless)
      plane_friction = own_strength.sine * std::cos(radians(parameters.dilation_angle)) /
                       (1 - own_strength.sine * own_strength.dilation_sine);
    grain_diameter      = inertial_friction.diameter();
    internal_quantities = { { "plastic_shear_strain", "-" } };
  }


  void MohrCoulomb::initialise_inside(const MohrCoulombStrength<double> &strength,
                                      const PrincipalValues &wanted_stress,
                                      PrincipalValues &strain,
                                      PrincipalValues &stress,
                                      double *internal_variables) const
  {
    double scale = 0;
    for (const double value : wanted_stress)
      scale = std::max(scale, std::abs(value));
    const double outside = yield(wanted_stress, strength);
    AssertThrow(outside <= 1e-9 * scale,
                ExcMessage("Mohr-Coulomb cannot bear the initial stress, which is outside the yield surface by " +
                           std::to_string(outside) +
                           " Pa. Remedy: a K0 of at least (1 - sin phi)/(1 + sin phi), or cohesion; look at the units "
                           "of \"Friction angle\", degrees, \"Cohesion\", Pa, and of the unit weights, N/m^3."));
    elastic.initialise(wanted_stress, strain, stress, nullptr);
    internal_variables[0] = 0;
  }


  namespace
  {
    /// What of a law with a strength of each point is the same for all of them: there is no apex.
    MohrCoulombParameters without_strength(const MohrCoulombParameters &parameters)
    {
      MohrCoulombParameters law = parameters;
      law.friction_angle = law.dilation_angle = 0;
      law.cohesion                            = 1; // not read
      return law;
    }
  } // namespace


  VaryingMohrCoulomb::VaryingMohrCoulomb(const MohrCoulombParameters &parameters)
      : MohrCoulomb(without_strength(parameters))
      , scale(1 / parameters.reduction)
      , dilation_tangent(tangent_of_dilation(parameters))
  {
    internal_quantities.insert(internal_quantities.end(), { { "cohesion", "Pa" }, { "friction_tangent", "-" } });
    const auto tangent_of = [parameters](const double degrees) {
      MohrCoulombParameters law = parameters;
      law.friction_angle        = degrees;
      return degrees >= 0 && degrees <= largest_angle ? tangent_of_angle(law) : std::nan("");
    };
    const auto fault_of_cohesion = [cut_off = parameters.tension_cut_off](const double *variables) -> std::string {
      if (!(variables[cohesion] >= 0))
        return "Write values from 0 on, in Pa.";
      if (variables[cohesion] == 0 && variables[tangent] == 0)
        return "Without friction the soil needs some cohesion to have any strength.";
      return variables[cohesion] >= cut_off * variables[tangent]
                 ? ""
                 : "The tension cut-off of " + number_text(cut_off) + " Pa is beyond c cot(phi). Write a smaller one.";
    };
    const auto fault_of_angle = [least    = dilation_tangent,
                                 dilation = parameters.dilation_angle](const double *variables) -> std::string {
      return variables[tangent] >= least
                 ? ""
                 : "Write angles from the dilation angle, " + number_text(dilation) + ", to 89 degrees.";
    };
    place_variables = {
      { "Friction angle",
        "degrees",
        parameters.friction_angle,
        parameters.friction_angle_of_place,
        tangent,
        tangent_of,
        fault_of_angle },
      { "Cohesion", "Pa", parameters.cohesion, parameters.cohesion_of_place, cohesion, nullptr, fault_of_cohesion }
    };
  }


  SofteningMohrCoulomb::SofteningMohrCoulomb(const MohrCoulombParameters &parameters)
      : MohrCoulomb(parameters)
      , softening_strain(parameters.softening.strain)
      , least_limit(1e-9 * parameters.cohesion) // Exponential decay ends there.
  {
    const MohrCoulombParameters last = parameters.residual();
    plane_friction                   = MohrCoulomb(last).plane_friction; // after much strain
    internal_quantities.insert(internal_quantities.end(),
                               { { "softening_strain", "-" }, { "nonlocal_softening_strain", "-" } });
    nonlocal_variable  = { parameters.softening.nonlocal_length, own_kappa, acting_kappa };
    const auto between = [](const double residual, const double peak) { return Falling{ residual, peak - residual }; };
    tangent            = between(tangent_of_angle(last), tangent_of_angle(parameters));
    dilation_tangent   = between(tangent_of_dilation(last), tangent_of_dilation(parameters));
    cohesion           = between(last.cohesion, parameters.cohesion);
  }
} // namespace scree

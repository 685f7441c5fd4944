// SPDX-License-Identifier: LGPL-2.1-or-later

#include <scree/input/input_error.h>
#include <scree/materials/laws/mohr_coulomb_surfaces.h>
#include <scree/materials/laws/softening_mohr_coulomb.h>
#include <scree/materials/principal_batch_material.h>

#include <deal.II/base/numbers.h>

#include <numeric>

using namespace dealii;

namespace scree
{
  namespace
  {
    /// Isotropic tension that friction and cohesion allow, c cot(phi), Pa.
    double apex(const MohrCoulombParameters &parameters)
    {
      if (parameters.cohesion == 0)
        return 0;
      const double sine = parameters.sine();
      return sine > 0 ? parameters.cohesion * std::sqrt(1 - sine * sine) / sine
                      : std::numeric_limits<double>::infinity();
    }


    double product(const PrincipalValues &a, const PrincipalValues &b)
    {
      return std::inner_product(a.begin(), a.end(), b.begin(), 0.);
    }
  } // namespace


  void MohrCoulombParameters::add_parameters(ParameterHandler &prm)
  {
    prm.add_parameter("Young's modulus", young_modulus, "Pa; Young's modulus.", Patterns::Double(0));
    prm.add_parameter("Poisson's ratio", poisson_ratio, "Poisson's ratio.", Patterns::Double(-1, 0.5));
    prm.add_parameter("Friction angle", friction_angle, "degrees; friction angle phi.", Patterns::Double(0, 89));
    prm.add_parameter("Friction angle kind",
                      angle_kind,
                      "Test that \"Friction angle\" comes from. triaxial: phi is this angle. plane strain: the same. "
                      "direct shear or repose: its tangent is tau/sigma on a plane of shear, and phi is larger.",
                      Patterns::Selection(friction_angle_kinds));
    prm.add_parameter("Dilation angle",
                      dilation_angle,
                      "degrees; dilation angle psi, at most the friction angle.",
                      Patterns::Double(0, 89));
    prm.add_parameter("Cohesion", cohesion, "Pa; cohesion c.", Patterns::Double(0));
    prm.add_parameter(
        "Tension cut-off", tension_cut_off, "Pa; largest principal stress, at most c cot(phi).", Patterns::Double(0));
    softening.add_parameters(prm);
    inertial_friction.add_parameters(prm);
  }


  double MohrCoulombParameters::sine() const
  {
    return sine_of_mohr_coulomb(friction_angle, dilation_angle, friction_angle_kind(angle_kind));
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
      require_entry(is_met, subsection, entry, value, text);
    };
    require(last.cohesion <= cohesion,
            "Residual cohesion",
            last.cohesion,
            "strength falls from its peak, here " + number_text(cohesion) + " Pa; lower the value.");
    require(last.friction_angle <= friction_angle,
            "Residual friction angle",
            last.friction_angle,
            "strength falls from its peak, here " + number_text(friction_angle) + " degrees; lower the value.");
    require(last.dilation_angle <= dilation_angle,
            "Residual dilation angle",
            last.dilation_angle,
            "dilation falls from its peak, here " + number_text(dilation_angle) + " degrees; lower the value.");
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
    require(tension_cut_off <= apex(last),
            "Tension cut-off",
            tension_cut_off,
            "residual cohesion and friction allow at most " + number_text(apex(last)) + " Pa; lower it.");
  }


  void MohrCoulombParameters::check(const std::string &subsection) const
  {
    LinearElasticParameters{ young_modulus, poisson_ratio }.check(subsection);
    require_entry(dilation_angle <= friction_angle,
                  subsection,
                  "Dilation angle",
                  dilation_angle,
                  "beyond the friction angle, here " + number_text(friction_angle) +
                      ", plastic flow would create energy; lower it.");
    require_entry(sine() <= std::sin(radians(89.)),
                  subsection,
                  "Friction angle",
                  friction_angle,
                  "as an angle of direct shear it has no friction angle phi below 89 degrees; lower it, or change "
                  "\"Friction angle kind\".");
    require_entry(inertial_friction.grain_diameter == 0 || sine() + inertial_friction.friction_increase < 1,
                  subsection,
                  "Friction increase",
                  inertial_friction.friction_increase,
                  "with sin(phi) = " + number_text(sine()) +
                      " the grains would bear tension. Write less than 1 - sin(phi).");
    require_entry(friction_angle > 0 || cohesion > 0,
                  subsection,
                  "Cohesion",
                  cohesion,
                  "without friction the soil needs some cohesion to have any strength.");
    require_entry(tension_cut_off <= apex(*this),
                  subsection,
                  "Tension cut-off",
                  tension_cut_off,
                  "cohesion and friction allow at most c cot(phi) = " + std::to_string(apex(*this)) + " Pa; lower it.");
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
      law.tension_cut_off = std::min(law.tension_cut_off / factor, apex(law));
      double &increase    = law.inertial_friction.friction_increase;
      increase            = std::min(increase, 0.999 * (1. - law.sine()));
    }
  } // namespace


  void MohrCoulombParameters::divide_strength(const double factor)
  {
    MohrCoulombParameters last = residual(); // before the peak changes
    divide(*this, factor);
    if (!softening.is_active())
      return;
    divide(last, factor);
    softening.cohesion       = last.cohesion;
    softening.friction_angle = last.friction_angle;
    softening.dilation_angle = last.dilation_angle;
    tension_cut_off          = std::min(tension_cut_off, last.tension_cut_off);
  }


  LawEntry MohrCoulombParameters::modulus() const
  {
    return { "Young's modulus", young_modulus };
  }


  namespace
  {
    /// The law without softening is another one: its yield surfaces are constant.
    class MohrCoulombEntries : public EntriesWith<MohrCoulombParameters>
    {
    public:
      std::unique_ptr<LawEntries> clone() const override
      {
        return std::make_unique<MohrCoulombEntries>(*this);
      }
      std::unique_ptr<Material<2>> make_2d() const override
      {
        return make<2>();
      }
      std::unique_ptr<Material<3>> make_3d() const override
      {
        return make<3>();
      }

    private:
      template <int dim>
      std::unique_ptr<Material<dim>> make() const
      {
        if (parameters.softening.is_active())
          return std::make_unique<PrincipalBatchMaterial<dim, SofteningMohrCoulomb>>(SofteningMohrCoulomb(parameters));
        return std::make_unique<PrincipalBatchMaterial<dim, MohrCoulomb>>(MohrCoulomb(parameters));
      }
    };

    const RegisterLaw registered_mohr_coulomb("Mohr-Coulomb", "Mohr-Coulomb", std::make_unique<MohrCoulombEntries>());
  } // namespace


  MohrCoulomb::MohrCoulomb(const MohrCoulombParameters &parameters)
      : inertial_friction(parameters.inertial_friction)
      , elastic(LinearElasticParameters{ parameters.young_modulus, parameters.poisson_ratio })
      , shear(elastic.shear_modulus())
      , bulk(elastic.bulk_modulus(0))
      , vertex(std::min(parameters.tension_cut_off, apex(parameters)))
      , on_plane(parameters.sine() * std::cos(radians(parameters.dilation_angle)) /
                 (1 - parameters.sine() * std::sin(radians(parameters.dilation_angle))))
      , cohesionless(apex(parameters) == 0)
      , largest_principal_stress(parameters.tension_cut_off)
  {
    const double sine     = parameters.sine();
    const double dilation = std::sin(radians(parameters.dilation_angle));
    const double limit    = 2 * parameters.cohesion * std::sqrt(1 - sine * sine);

    using namespace mohr_coulomb_surfaces;
    for (unsigned int s = 0; s < n_surfaces; ++s)
      surfaces.push_back({ direction(s, sine),
                           direction(s, dilation),
                           relaxation(direction(s, dilation), bulk, shear),
                           s < cut_1 ? limit : largest_principal_stress });

    add_active_set({ f13 });
    add_active_set({ f13, f12 });
    add_active_set({ f13, f23 });
    if (largest_principal_stress < apex(parameters)) // else the cut-off only touches the apex
      {
        add_active_set({ cut_1 });
        add_active_set({ cut_1, cut_2 });
        add_active_set({ f13, cut_1 });
        add_active_set({ f13, f12, cut_1 });
        // The edge where four surfaces meet, as two cones.
        add_active_set({ f13, cut_1, cut_2 });
        add_active_set({ f13, f23, cut_1 });
      }
    // The three cut-offs meet at the vertex, which needs no system.
  }


  void MohrCoulomb::add_active_set(const std::vector<unsigned int> &members)
  {
    Tensor<2, 3> matrix;
    for (unsigned int a = members.size(); a < 3; ++a)
      matrix[a][a] = 1;
    for (unsigned int a = 0; a < members.size(); ++a)
      for (unsigned int b = 0; b < members.size(); ++b)
        matrix[a][b] = product(surfaces[members[a]].normal, surfaces[members[b]].relaxation);
    active_sets.push_back({ members, invert(matrix) });
  }


  double MohrCoulomb::shear_modulus() const
  {
    return shear;
  }


  double MohrCoulomb::bulk_modulus(const double) const
  {
    return bulk;
  }


  double MohrCoulomb::energy(const PrincipalValues &strain) const
  {
    PrincipalValues closed = strain; // closes one axis after the other
    std::sort(closed.rbegin(), closed.rend());
    const auto sum    = [](const PrincipalValues &values) { return values[0] + values[1] + values[2]; };
    const double lame = bulk - 2. / 3. * shear;
    for (unsigned int n = 1; n <= 3 && lame * sum(closed) + 2 * shear * closed[n - 1] > largest_principal_stress; ++n)
      {
        const double rest = std::accumulate(closed.begin() + n, closed.end(), 0.);
        std::fill_n(closed.begin(), n, (largest_principal_stress - lame * rest) / (n * lame + 2 * shear));
      }
    return elastic.energy(closed) + largest_principal_stress * (sum(strain) - sum(closed));
  }


  double MohrCoulomb::initial_porosity() const
  {
    return 0;
  }


  double MohrCoulomb::plane_friction() const
  {
    return cohesionless ? on_plane : std::numeric_limits<double>::infinity();
  }


  Response MohrCoulomb::return_map(PrincipalValues &strain,
                                   double *internal_variables,
                                   const double,
                                   PrincipalValues &stress,
                                   UpdateReport &report) const
  {
    return count(respond<double>(strain, internal_variables, stress), report);
  }


  Response MohrCoulomb::count(const PrincipalResponse<double> &response, UpdateReport &report) const
  {
    report.largest_bulk_modulus = bulk;
    report.n_vertices += response.is_vertex;
    report.n_separated += response.is_separated;
    report.n_unresolved += response.is_unresolved;
    return response.is_plastic ? Response::plastic : Response::elastic;
  }


  void MohrCoulomb::initialise(const PrincipalValues &wanted_stress,
                               PrincipalValues &strain,
                               PrincipalValues &stress,
                               double *internal_variables) const
  {
    double scale = surfaces[0].limit;
    for (const double value : wanted_stress)
      scale = std::max(scale, std::abs(value));
    AssertThrow(yield(wanted_stress) <= 1e-9 * scale,
                ExcMessage("Mohr-Coulomb cannot bear the initial stress, which is outside the yield surface by " +
                           std::to_string(yield(wanted_stress)) +
                           " Pa. Remedy: a K0 of at least (1 - sin phi)/(1 + sin phi), or cohesion."));
    elastic.initialise(wanted_stress, strain, stress, nullptr);
    internal_variables[0] = 0;
  }


  std::vector<Quantity> MohrCoulomb::internal_quantities()
  {
    return { { "plastic_shear_strain", "-" } };
  }


  std::vector<Quantity> MohrCoulomb::output_quantities()
  {
    return {};
  }


  void MohrCoulomb::output(const PrincipalValues &, const double *, const double, double *) const
  {
  }
} // namespace scree

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/case/body_parameters.h>

namespace scree
{
  using namespace dealii;

  void BodyParameters::add_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection(name);
    seeding.add_parameters(prm);
    seepage.add_parameters(prm);
    material.add_parameters(prm);
    initial_state.add_parameters(prm);
    prm.leave_subsection();
  }


  void BodyParameters::check(const std::vector<double> &gravity, const WaterParameters *water) const
  {
    seeding.check(name, gravity.size());
    seepage.check(name, water);
    material.check(name);
    initial_state.check(name, gravity);
    if (is_rigid())
      check_rigid();
  }


  void BodyParameters::check_rigid() const
  {
    require_entry(seeding.initial_velocity.empty(),
                  name,
                  "Initial velocity",
                  seeding.initial_velocity,
                  "\"Material = rigid\" does not move. Remove one of the two.");
    require_entry(initial_state.stress_kind() == InitialStress::none,
                  name + "/Initial state",
                  "Type",
                  initial_state.type,
                  "the stress of \"Material = rigid\" is not known. Remove the entry.");
  }


  bool BodyParameters::is_rigid() const
  {
    return material.is_rigid();
  }


  double BodyParameters::initial_porosity() const
  {
    return seeding.initial_porosity < 0 ? make_material<2>(material)->initial_porosity() : seeding.initial_porosity;
  }


  double BodyParameters::bulk_density() const
  {
    return seeding.grain_density * (1. - initial_porosity());
  }


  double BodyParameters::k0() const
  {
    return initial_state.k0_ratio(material.chosen().sine_of_friction());
  }


  double BodyParameters::wave_speed() const
  {
    const auto law = make_material<2>(material);
    return law->wave_speed(law->initial_bulk_modulus(initial_state.pressure), 0., bulk_density());
  }
} // namespace scree

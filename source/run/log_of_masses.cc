// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/run/log_of_masses.h>

#include <deal.II/base/mpi.h>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// Of the points of all ranks, kg (2D: per m). Collective.
    template <int dim>
    double mass_of(const PointSet<dim> &points, const unsigned int mass_slot, const MPI_Comm communicator)
    {
      double mass = 0.;
      for_each_point(points, [&](const auto &point) { mass += point.properties[mass_slot]; });
      return Utilities::MPI::sum(mass, communicator);
    }


    template <int dim>
    double water_mass(const Scene<dim> &scene, const MPI_Comm communicator)
    {
      double mass = 0.;
      for (const auto &part : scene.water)
        mass += mass_of(part.points(), part.layout.mass, communicator);
      return mass;
    }


    template <int dim>
    std::string kilograms(const double mass)
    {
      return number_text(mass) + (dim == 2 ? " kg/m" : " kg");
    }


    template <int dim>
    std::string volume_and_mass(const double volume, const double mass)
    {
      return number_text(volume) + (dim == 2 ? " m^3/m, " : " m^3, ") + kilograms<dim>(mass);
    }


    std::string stress_text(const BodyParameters &body)
    {
      const InitialStateParameters &state = body.initial_state;
      if (state.stress_kind() == InitialStress::k0)
        return "stress by weight, K0 = " + number_text(body.k0());
      if (state.stress_kind() == InitialStress::isotropic)
        return "isotropic stress " + number_text(state.pressure) + " Pa";
      return "no stress (\"Type = none\" in subsection Initial state)";
    }
  } // namespace


  template <int dim>
  void
  log_released(const Parameters &parameters, const Scene<dim> &scene, RunFolder &folder, const MPI_Comm communicator)
  {
    auto entries = parameters.bodies.begin();
    for (const auto &body : scene.bodies)
      {
        const BodyParameters &of_case = *entries++;
        if (of_case.is_rigid())
          continue;
        const double mass        = mass_of(body.points, body.layout.mass, communicator);
        const double porosity    = of_case.initial_porosity();
        const bool is_of_the_law = of_case.seeding.initial_porosity < 0.;
        folder.record(body.name + " at the start: " + volume_and_mass<dim>(mass / body.density, mass) + "; " +
                      number_text(body.density) + " kg/m^3 dry: grains of " + number_text(body.grain_density) +
                      " kg/m^3, porosity " + number_text(porosity) +
                      (of_case.seeding.has_unit_weights() ? " (of the unit weights)"
                       : !is_of_the_law                   ? ""
                       : porosity > 0.                    ? " (of the law)"
                                       : " (no \"Initial porosity\" is set, and \"Material = " + of_case.material.law +
                                             "\" has none of its own)") +
                      "; " + stress_text(of_case));
      }
    if (!scene.water.empty())
      folder.record("Water at the start: " + kilograms<dim>(water_mass(scene, communicator)));
  }


  template <int dim>
  void
  log_balance(const Scene<dim> &scene, const RunTotals<dim> &totals, RunFolder &folder, const MPI_Comm communicator)
  {
    const RunTotals<dim> all = totals.sum_over_ranks(communicator);
    double mass = 0., volume = 0.;
    bool moves = false;
    for (const auto &body : scene.bodies)
      if (!body.is_rigid)
        {
          const double of_body = mass_of(body.points, body.layout.mass, communicator);
          moves                = true;
          mass += of_body;
          volume += of_body / body.density;
        }
    const bool has_inflows = scene.is_fed();
    if (moves)
      folder.record("Soil at the end, at its density of the start: in the box " + volume_and_mass<dim>(volume, mass) +
                    "; lost through open walls " + volume_and_mass<dim>(all.lost_volume, all.lost_mass) + " (" +
                    number_text(all.n_lost) + " points)" +
                    (has_inflows ? "; entered " + kilograms<dim>(all.entered_mass) : ""));
    if (!scene.water.empty())
      folder.record("Water at the end: in the box " + kilograms<dim>(water_mass(scene, communicator)) +
                    "; lost through open walls " + kilograms<dim>(all.lost_water_mass) +
                    (has_inflows ? "; entered " + kilograms<dim>(all.entered_water_mass) : ""));
    if (scene.rain)
      {
        const RainBooks rain = scene.rain->account();
        const double density = scene.water.front().density;
        folder.record("Rain at the end: fell " + kilograms<dim>(density * rain.fell) + "; entered " +
                      kilograms<dim>(density * rain.entered) + "; beside the soil " +
                      kilograms<dim>(density * rain.beside_soil) + "; waiting for a whole drop " +
                      kilograms<dim>(density * rain.waiting));
      }
  }

  template void log_released(const Parameters &, const Scene<2> &, RunFolder &, const MPI_Comm);
  template void log_released(const Parameters &, const Scene<3> &, RunFolder &, const MPI_Comm);
  template void log_balance(const Scene<2> &, const RunTotals<2> &, RunFolder &, const MPI_Comm);
  template void log_balance(const Scene<3> &, const RunTotals<3> &, RunFolder &, const MPI_Comm);
} // namespace scree

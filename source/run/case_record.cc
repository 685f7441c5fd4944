// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/geometry/raster.h>
#include <scree/io/progress.h>
#include <scree/run/case_record.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <sstream>

namespace scree
{
  using namespace dealii;

  void record_case(Parameters &parameters, RunFolder &folder)
  {
    folder.write("original.prm", parameters.original());
    std::ostringstream all_entries;
    parameters.print_into(parameters.output_directory, all_entries);
    folder.write("parameters.prm", all_entries.str());
  }


  namespace
  {
    /// "2D plane strain, dry, FLIP (PIC rate 1 1/s)"
    std::string model_text(const Parameters &parameters)
    {
      const bool has_soil = !parameters.bodies.empty();
      const bool rides    = has_soil && parameters.water.point_sets_kind() == PointSets::single_point;
      return std::string(parameters.dimension == 2 ? "2D plane strain, " : "3D, ") +
             (!parameters.has_water ? "dry"
              : !has_soil           ? "free water"
              : rides               ? "soil and water (single-point)"
                                    : "soil and water (double-point)") +
             ", " + parameters.transfer.text();
    }


    /// What is missing or unusual in a raster also goes to the screen.
    void log_remark(RunFolder &folder, const std::string &remark)
    {
      std::istringstream lines(remark);
      for (std::string line; std::getline(lines, line);)
        if (line.find("Unusual value") != std::string::npos || line.find("NODATA") != std::string::npos)
          folder.log(line);
        else
          folder.record(line);
    }


    /// Warns of ground that cells do not resolve. Collective.
    template <int dim>
    void log_thin_bed(const DiscreteLevelSet<dim> &bed, RunFolder &folder, const MPI_Comm communicator)
    {
      const auto place = bed.thin_place();
      for (const std::string &text : Utilities::MPI::gather(communicator, place ? number_text(*place) : std::string()))
        if (!text.empty())
          {
            folder.log(
                "Bed: at (" + text +
                ") m the ground is thinner than a cell. Points may pass through it there. Write smaller cells, or "
                "thicker ground.");
            return;
          }
    }
  } // namespace


  template <int dim>
  void log_case(const Parameters &parameters, const Scene<dim> &scene, RunFolder &folder, const MPI_Comm communicator)
  {
    log_header(folder,
               { parameters.case_file, parameters.output_directory, model_text(parameters) },
               scene.grid,
               scene.bodies,
               scene.water,
               scene.expected_memory.bytes(Utilities::MPI::n_mpi_processes(communicator)));
    if (const Point<2> &origin = parameters.bed.map_origin; origin != Point<2>())
      folder.record(
          "Local origin: x = 0, y = 0 is " + number_text(origin) +
          " m on the map. Rasters, outlines and maps are in the map's coordinates, all else, the pictures, too, "
          "from this place.");
    if (!parameters.map_system.empty())
      folder.record("Coordinate system of the maps: " + name_of_system(parameters.map_system));
    if (!parameters.text_of_box.empty())
      folder.record(parameters.text_of_box);
    for (const BodyParameters &body : parameters.bodies)
      if (body.seeding.map)
        log_remark(folder, body.seeding.map->remark(body.name));
    if (scene.ground)
      log_remark(folder, scene.ground->remark());
    if (scene.bed)
      log_thin_bed(*scene.bed, folder, communicator);
    if (const std::string forces = scene.forcing.text(); !forces.empty())
      folder.record(forces);
    if (scene.seepage)
      folder.log(scene.seepage->report.text(dim));
    for (const std::string &text : scene.texts_of_inflows())
      folder.record(text);
    if (parameters.water.fringe > 0.)
      folder.log(
          "Water: suction is too small in the uppermost cell of the soil, and cut slopes fail too early. Where the "
          "fringe, " +
          number_text(parameters.water.fringe) +
          " m above the water level, ends inside a cell, the pressure deviates by up to 22 % of the Air entry "
          "pressure. Let it end at a cell face or above the ground.");
    if (scene.rain && std::any_of(scene.bodies.begin(), scene.bodies.end(), [](const auto &b) { return !b.is_rigid; }))
      folder.log("Rain: on deformable soil up to 28 % more water enters than by Darcy's law, if the rate exceeds the "
                 "conductivity. Compare with a body of Material = rigid.");
  }

  template void log_case(const Parameters &, const Scene<2> &, RunFolder &, const MPI_Comm);
  template void log_case(const Parameters &, const Scene<3> &, RunFolder &, const MPI_Comm);


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

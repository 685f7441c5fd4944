// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/run/results.h>
#include <scree/version.h>

#include <unistd.h>

#include <ctime>
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


    constexpr std::size_t right_margin = 79;

    std::string date()
    {
      const std::time_t now = std::time(nullptr);
      char text[64];
      std::strftime(text, sizeof text, "%Y-%m-%d %H:%M:%S %Z", std::localtime(&now));
      return text;
    }

    /// Of all ranks.
    std::string megabytes(const unsigned long kilobytes, const MPI_Comm communicator)
    {
      return std::to_string(std::lround(1.024e-3 * Utilities::MPI::sum(double(kilobytes), communicator))) + " MB";
    }

    Utilities::System::MemoryStats memory()
    {
      Utilities::System::MemoryStats kilobytes;
      Utilities::System::get_memory_stats(kilobytes);
      return kilobytes;
    }

    /// "1 rank", "2 ranks"
    std::string counted(const unsigned long long n, const std::string &what)
    {
      return std::to_string(n) + ' ' + what + (n == 1 ? "" : "s");
    }

    /// "Scree 0.9.0 (c75edbf), 2 ranks" and, at the right margin, the date.
    std::string header_line(const MPI_Comm communicator)
    {
      std::string program      = version_text().substr(0, version_text().find('\n'));
      const std::string before = "(commit ";
      if (const std::size_t place = program.find(before); place != std::string::npos)
        program.replace(place, before.size(), "(");
      program += ", " + counted(Utilities::MPI::n_mpi_processes(communicator), "rank");
      const std::string now = date();
      program.resize(std::max(program.size() + 2, right_margin - std::min(right_margin, now.size())), ' ');
      return program + now;
    }

    /// ", 38480 soil points, 1200 water points"; of several bodies also each one's.
    template <int dim>
    std::string points_text(const std::list<SoilBody<dim>> &bodies, const std::list<WaterPhase<dim>> &water)
    {
      std::string of_each;
      unsigned long long n_soil = 0, n_water = 0;
      for (const auto &body : bodies)
        {
          const unsigned long long n = body.points.handler().n_global_particles();
          of_each += (of_each.empty() ? " (" : ", ") + body.name + ' ' + std::to_string(n);
          n_soil += n;
        }
      for (const auto &part : water)
        if (part.carrier() == nullptr)
          n_water += part.points().handler().n_global_particles();
      return (bodies.empty() ? "" : ", " + counted(n_soil, "soil point")) + (bodies.size() > 1 ? of_each + ')' : "") +
             (n_water > 0 ? ", " + counted(n_water, "water point") : "");
    }


    /// For log.txt alone: libraries, compiler and its flags, process and host.
    void record_environment(RunFolder &folder)
    {
      std::istringstream version(version_text());
      std::string program, libraries, compiler;
      std::getline(version, program);
      std::getline(version, libraries);
      std::getline(version, compiler);
      folder.record("Libraries   " + libraries);
      folder.record("Compiler    " + compiler + ", flags " + single_blanks(compiler_flags()));
      folder.record("Process     " + std::to_string(getpid()) + " on " + Utilities::System::get_hostname() +
                    " (first rank)");
    }


    /// Logs the five lines of the head: program, commit, ranks and date; case and run folder; model and points; mesh;
    /// memory, MB of all ranks. Records libraries, compiler and its flags, process and host. Collective.
    template <int dim>
    void log_header(const Scene<dim> &scene, RunFolder &folder)
    {
      const Parameters &parameters = scene.parameters;
      const auto &grid             = scene.grid;
      const MPI_Comm communicator  = grid.communicator();
      const double expected_bytes  = scene.expected_memory.bytes(Utilities::MPI::n_mpi_processes(communicator));
      folder.log(header_line(communicator));
      folder.log("Case        " + parameters.case_file + " -> " + parameters.output_directory);
      folder.log("Model       " + model_text(parameters) + points_text(scene.bodies, scene.water));
      const double n_cells = Utilities::MPI::sum(double(grid.fine_cells().n_owned()), communicator);
      const double n_all   = grid.n_cells_of_box();
      folder.log("Mesh        " + number_text(n_cells) + " cells of " + number_text(grid.cell_size()) + " m" +
                 (n_cells < n_all ? " around the points, in a box of " + number_text(n_all) : ""));
      folder.log("Memory      " + std::to_string(std::lround(1e-6 * expected_bytes)) + " MB estimated");

      record_environment(folder);
      folder.record("In use      " + megabytes(memory().VmRSS, communicator) + " at the start (all ranks)");
      const unsigned long long n_ghosts =
          Utilities::MPI::sum(grid.numbering().partitioner()->n_ghost_indices(), communicator);
      if (n_ghosts > 0)
        folder.record("Ghost nodes " + std::to_string(n_ghosts));
      if (!folder.dead_run().empty())
        folder.log("The run before this one (" + folder.dead_run() + ") did not come to its end.");
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
  } // namespace


  template <int dim>
  void log_case(const Scene<dim> &scene, RunFolder &folder)
  {
    const Parameters &parameters = scene.parameters;
    log_header(scene, folder);
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
    if (const std::string forces = scene.forcing.text(); !forces.empty())
      folder.record(forces);
    if (scene.seepage)
      folder.log(scene.seepage->report.text(dim));
    for (const Inflow<dim> &inflow : scene.inflows)
      folder.record("Inflow " + inflow.name + ": " + number_text(inflow.area()) + (dim == 2 ? " m" : " m^2") +
                    " are open; " + std::to_string(inflow.places().size()) + " points a layer of " + inflow.body);
    if (scene.rain)
      folder.record("Rain: on " + number_text(scene.rain->area()) + (dim == 2 ? " m" : " m^2") + ", in drops of " +
                    number_text(scene.rain->volume()) + (dim == 2 ? " m^2" : " m^3"));
    if (parameters.water.fringe > 0.)
      folder.log(
          "Water: suction is too small in the uppermost cell of the soil, and cut slopes fail too early. Where the "
          "fringe, " +
          number_text(parameters.water.fringe) +
          " m above the water level, ends inside a cell, the pressure deviates by up to 22 % of the Air entry "
          "pressure. Let it end at a cell face or above the ground.");
    if (scene.rain && std::any_of(scene.bodies.begin(), scene.bodies.end(), [](const auto &b) { return !b.is_rigid; }))
      folder.log("Rain: if the rate exceeds the conductivity of deformable soil, up to 28 % more water enters than by "
                 "Darcy's law, and it stands up to 1.6 times as high on the soil as its volume. Compare with a body of "
                 "Material = rigid.");
  }


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
      if (state.is_k0())
        return "stress by weight, K0 = " + number_text(body.k0());
      if (state.is_isotropic())
        return "isotropic stress " + number_text(state.pressure) + " Pa";
      return "no stress (\"Type = none\" in subsection Initial state)";
    }
  } // namespace


  template <int dim>
  void log_released(const Scene<dim> &scene, RunFolder &folder)
  {
    const MPI_Comm communicator = scene.grid.communicator();
    auto entries                = scene.parameters.bodies.begin();
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
  void log_end(const Scene<dim> &scene, const RunBalance<dim> &totals, RunFolder &folder)
  {
    const MPI_Comm communicator = scene.grid.communicator();
    const RunBalance<dim> all   = totals.sum_over_ranks(communicator);
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
    folder.record("Largest memory: " + megabytes(memory().VmHWM, communicator) + " (all ranks)");
  }

  template decltype(log_case<2>) log_case<2>;
  template decltype(log_case<3>) log_case<3>;
  template decltype(log_released<2>) log_released<2>;
  template decltype(log_released<3>) log_released<3>;
  template decltype(log_end<2>) log_end<2>;
  template decltype(log_end<3>) log_end<3>;
} // namespace scree

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/run/case_record.h>
#include <scree/geometry/raster_formats/coordinate_system.h>
#include <scree/io/log_header.h>

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
} // namespace scree

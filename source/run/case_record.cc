// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/run/case_record.h>
#include <scree/geometry/raster_formats/coordinate_system.h>
#include <scree/io/log_header.h>

#include <deal.II/base/mpi.h>

#include <sstream>

namespace scree
{
  using namespace dealii;

  void record_case(Parameters &parameters, RunFolder &folder, const MPI_Comm communicator)
  {
    folder.write("original.prm", parameters.original());
    std::ostringstream all_entries;
    parameters.print_into(parameters.output_directory, all_entries);
    folder.write("parameters.prm", all_entries.str());
    log_program(folder, communicator);
  }


  namespace
  {
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
    log_size(folder,
             scene.grid,
             scene.bodies,
             scene.water,
             scene.expected_memory.bytes(Utilities::MPI::n_mpi_processes(communicator)));
    folder.log("Transfer: " + parameters.transfer.text());
    if (const Point<2> &origin = parameters.bed.map_origin; origin != Point<2>())
      folder.log("Local origin: x = 0, y = 0 is " + number_text(origin) +
                 " m on the map. Rasters, outlines and maps are in the map's coordinates, all else, the pictures, too, "
                 "from this place.");
    if (!parameters.map_system.empty())
      folder.log("Coordinate system of the maps: " + name_of_system(parameters.map_system));
    if (!parameters.text_of_box.empty())
      folder.log(parameters.text_of_box);
    for (const BodyParameters &body : parameters.bodies)
      if (body.seeding.map)
        if (const std::string remark = body.seeding.map->remark(body.name); !remark.empty())
          folder.log(remark);
    if (scene.ground)
      if (const std::string remark = scene.ground->remark(); !remark.empty())
        folder.log(remark);
    if (scene.bed)
      log_thin_bed(*scene.bed, folder, communicator);
    if (const std::string forces = scene.forcing.text(); !forces.empty())
      folder.log(forces);
    for (const std::string &text : scene.texts_of_inflows())
      folder.log(text);
  }

  template void log_case(const Parameters &, const Scene<2> &, RunFolder &, const MPI_Comm);
  template void log_case(const Parameters &, const Scene<3> &, RunFolder &, const MPI_Comm);
} // namespace scree

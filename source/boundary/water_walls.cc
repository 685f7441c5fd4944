// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/boundary/water_walls.h>

namespace scree
{
  using namespace dealii;

  namespace
  {
    constexpr char accepted_water_walls[] = "impermeable | no slip | drained | drained PRESSURE (Pa)";

    /// Reads one wall, or throws with the words that are allowed.
    WaterWall water_wall_from_text(const std::string &name, const std::string &text)
    {
      if (text == "impermeable")
        return { WaterWallType::impermeable, 0. };
      if (text == "no slip")
        return { WaterWallType::no_slip, 0. };
      if (text == "drained")
        return { WaterWallType::drained, 0. };
      if (text.rfind("drained ", 0) == 0)
        if (const double pressure = number_of(Utilities::trim(text.substr(8))); std::isfinite(pressure))
          return { WaterWallType::drained, pressure };
      throw EntryError(entry_name("Boundaries/Water", name) + " = " + text + ": write one of: " + accepted_water_walls +
                       '.');
    }
  } // namespace


  void WaterBoundaryParameters::add_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Boundaries");
    prm.enter_subsection("Water");
    FaceEntries::add_parameters(prm, std::string(" of the box, for the water: ") + accepted_water_walls + ".");
    prm.leave_subsection();
    prm.leave_subsection();
  }


  std::vector<WaterWall> WaterBoundaryParameters::walls(const unsigned int dim) const
  {
    const auto faces = names(dim), entries = texts(dim);
    std::vector<WaterWall> result;
    for (unsigned int f = 0; f < faces.size(); ++f)
      result.push_back(water_wall_from_text(faces[f], entries[f]));
    return result;
  }


  template <int dim>
  ConstrainedDirections<dim> WaterBoundaryConditions<dim>::held_directions(const std::uint8_t faces) const
  {
    ConstrainedDirections<dim> held;
    for (unsigned int f = 0; f < 2 * dim; ++f)
      if ((faces >> f) & 1)
        {
          if (wall_list[f].type == WaterWallType::no_slip)
            held.hold_all();
          else if (wall_list[f].type == WaterWallType::impermeable)
            held.hold(Point<dim>::unit_vector(f / 2));
        }
    return held;
  }


  template <int dim>
  double WaterBoundaryConditions<dim>::pressure(const std::uint8_t faces) const
  {
    double sum     = 0;
    unsigned int n = 0;
    for (unsigned int f = 0; f < 2 * dim; ++f)
      if ((faces >> f) & 1 && is_drained(f))
        {
          sum += wall_list[f].pressure;
          ++n;
        }
    return n > 0 ? sum / n : 0.;
  }


  template class WaterBoundaryConditions<2>;
  template class WaterBoundaryConditions<3>;
} // namespace scree

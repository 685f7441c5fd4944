// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/boundary/boundary_conditions.h>
#include <scree/boundary/water_walls.h>
#include <scree/input/input_error.h>

#include <cmath>

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
        {
          std::size_t end  = 0;
          double pressure  = 0;
          const auto rest  = Utilities::trim(text.substr(8));
          bool is_a_number = false;
          try
            {
              pressure    = std::stod(rest, &end);
              is_a_number = end == rest.size() && std::isfinite(pressure);
            }
          catch (const std::exception &)
            {
            }
          if (is_a_number)
            return { WaterWallType::drained, pressure };
        }
      throw EntryError(entry_name("Boundaries/Water", name) + " = " + text + ": write one of: " + accepted_water_walls +
                       '.');
    }
  } // namespace


  WaterBoundaryParameters::WaterBoundaryParameters()
      : FaceEntries{ "impermeable", "impermeable", "impermeable", "impermeable", "impermeable", "drained" }
  {
  }


  void WaterBoundaryParameters::add_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Boundaries");
    prm.enter_subsection("Water");
    FaceEntries::add_parameters(prm, std::string(" of the box, for the water: ") + accepted_water_walls + ".");
    prm.leave_subsection();
    prm.leave_subsection();
  }


  void WaterBoundaryParameters::check(const unsigned int dim) const
  {
    walls(3);
    FaceEntries::check("Boundaries/Water", dim, WaterBoundaryParameters());
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
  WaterBoundaryConditions<dim>::WaterBoundaryConditions(const BackgroundGrid<dim> &grid,
                                                        const WaterBoundaryParameters &parameters)
      : grid(grid)
      , wall_list(parameters.walls(dim))
  {
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
  BearingFaces<dim> WaterBoundaryConditions<dim>::bearing_faces(const std::uint8_t faces) const
  {
    return BearingFaces<dim>(
        faces,
        [&](const unsigned int face) { return !is_drained(face); },
        [&](const unsigned int face) { return wall_list[face].type == WaterWallType::no_slip; });
  }


  template <int dim>
  bool WaterBoundaryConditions<dim>::prescribes_pressure(const std::uint8_t faces) const
  {
    for (unsigned int f = 0; f < 2 * dim; ++f)
      if ((faces >> f) & 1 && is_drained(f))
        return true;
    return false;
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


  template <int dim>
  std::uint8_t WaterBoundaryConditions<dim>::closed_faces() const
  {
    std::uint8_t faces = 0;
    for (unsigned int f = 0; f < 2 * dim; ++f)
      faces |= (is_drained(f) ? 0u : 1u) << f;
    return faces;
  }


  template <int dim>
  std::pair<std::string, bool> WaterBoundaryConditions<dim>::face_crossed(const Point<dim> &location) const
  {
    const unsigned int face = nearest_face(grid, location);
    return { FaceEntries::names(dim)[face], is_drained(face) };
  }

  template class WaterBoundaryConditions<2>;
  template class WaterBoundaryConditions<3>;
} // namespace scree

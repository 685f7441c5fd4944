// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/boundary/boundary_conditions.h>

namespace scree
{
  using namespace dealii;

  FaceEntries::FaceEntries(const std::string &subsection,
                           const std::string &phase,
                           const std::string &accepted,
                           const ReadWall read,
                           const std::string &side,
                           const std::string &bottom,
                           const std::string &top)
      : left(side)
      , right(side)
      , front(side)
      , back(side)
      , bottom(bottom)
      , top(top)
      , subsection(subsection)
      , phase(phase)
      , accepted(accepted)
      , default_side(side)
      , read(read)
  {
  }


  void FaceEntries::add_parameters(ParameterHandler &prm)
  {
    const std::string what = " of the box" + phase + ": " + accepted + ".";
    const auto path        = Utilities::split_string_list(subsection, '/');
    for (const std::string &name : path)
      prm.enter_subsection(name);
    prm.add_parameter("Left", left, "Lower x face" + what);
    prm.add_parameter("Right", right, "Upper x face" + what);
    prm.add_parameter("Front", front, "Lower y face (3D only)" + what);
    prm.add_parameter("Back", back, "Upper y face (3D only)" + what);
    prm.add_parameter("Bottom", bottom, "Lower face of the last axis" + what);
    prm.add_parameter("Top", top, "Upper face of the last axis" + what);
    for (unsigned int i = 0; i < path.size(); ++i)
      prm.leave_subsection();
  }


  void FaceEntries::check(const unsigned int dim) const
  {
    walls(3);
    if (dim == 2)
      for (const auto &[name, wall] : { std::make_pair("Front", front), std::make_pair("Back", back) })
        require_entry(wall == default_side,
                      { subsection, name, wall },
                      "a plane strain run has no such wall. Remove the entry, or write \"Dimension = 3\".");
  }


  std::vector<Wall> FaceEntries::walls(const unsigned int dim) const
  {
    const auto faces = names(dim), entries = texts(dim);
    std::vector<Wall> result;
    for (unsigned int f = 0; f < faces.size(); ++f)
      {
        const std::optional<Wall> wall = read(entries[f]);
        if (!wall)
          throw EntryError(entry_name(subsection, faces[f]) + " = " + entries[f] + ": write one of: " + accepted + '.');
        result.push_back(*wall);
      }
    return result;
  }


  namespace
  {
    std::optional<Wall> soil_wall(const std::string &text)
    {
      if (text == "fixed")
        return Wall{ WallType::fixed };
      if (text == "free slip")
        return Wall{ WallType::free_slip };
      if (text == "open")
        return Wall{ WallType::open };
      if (text.rfind("friction ", 0) == 0)
        if (const double angle = number_of(Utilities::trim(text.substr(9))); angle >= 0. && angle < 90.)
          return Wall{ WallType::friction, std::tan(angle * numbers::PI / 180.) };
      return {};
    }


    std::optional<Wall> water_wall(const std::string &text)
    {
      if (text == "impermeable")
        return Wall{ WallType::free_slip };
      if (text == "no slip")
        return Wall{ WallType::fixed };
      if (text == "drained")
        return Wall{ WallType::open };
      if (text.rfind("drained ", 0) == 0)
        if (const double pressure = number_of(Utilities::trim(text.substr(8))); std::isfinite(pressure))
          return Wall{ WallType::open, 0., pressure };
      return {};
    }
  } // namespace


  BoundaryParameters::BoundaryParameters()
      : FaceEntries("Boundaries",
                    "",
                    "fixed | free slip | friction ANGLE (degrees, 0 to below 90) | open",
                    soil_wall,
                    "free slip",
                    "fixed",
                    "open")
  {
  }


  WaterBoundaryParameters::WaterBoundaryParameters()
      : FaceEntries("Boundaries/Water",
                    ", for the water",
                    "impermeable | no slip | drained | drained PRESSURE (Pa)",
                    water_wall,
                    "impermeable",
                    "impermeable",
                    "drained")
  {
  }


  template <int dim>
  std::vector<NodeConstraint<dim>> BoundaryConditions<dim>::constraints(const std::uint8_t faces) const
  {
    using Type = typename NodeConstraint<dim>::Type;
    std::vector<NodeConstraint<dim>> result;
    for (unsigned int f = 0; f < 2 * dim; ++f)
      if ((faces >> f) & 1)
        {
          const Tensor<1, dim> inward = (f % 2 == 0 ? 1. : -1.) * Point<dim>::unit_vector(f / 2);
          switch (wall_list[f].type)
            {
            case WallType::fixed:
              for (unsigned int a = 0; a < dim; ++a)
                result.push_back({ Point<dim>::unit_vector(a), Type::fixed, 0. });
              break;
            case WallType::free_slip:
              result.push_back({ inward, Type::fixed, 0. });
              break;
            case WallType::friction:
              result.push_back({ inward, Type::unilateral, wall_list[f].friction_coefficient });
              break;
            case WallType::open:
              break;
            }
        }
    return result;
  }


  template <int dim>
  double BoundaryConditions<dim>::pressure(const std::uint8_t faces) const
  {
    double sum     = 0;
    unsigned int n = 0;
    for (unsigned int f = 0; f < 2 * dim; ++f)
      if ((faces >> f) & 1 && is_open(f))
        {
          sum += wall_list[f].pressure;
          ++n;
        }
    return n > 0 ? sum / n : 0.;
  }


  template <int dim>
  unsigned int nearest_face(const BackgroundGrid<dim> &grid, const Point<dim> &location)
  {
    unsigned int nearest = 0;
    double largest       = -std::numeric_limits<double>::infinity();
    for (unsigned int f = 0; f < 2 * dim; ++f)
      {
        const double outside =
            f % 2 == 0 ? grid.lower_corner()[f / 2] - location[f / 2] : location[f / 2] - grid.upper_corner()[f / 2];
        if (outside > largest)
          {
            largest = outside;
            nearest = f;
          }
      }
    return nearest;
  }

  template class BoundaryConditions<2>;
  template class BoundaryConditions<3>;
  template unsigned int nearest_face(const BackgroundGrid<2> &, const Point<2> &);
  template unsigned int nearest_face(const BackgroundGrid<3> &, const Point<3> &);
} // namespace scree

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/boundary/boundary_conditions.h>

#include <map>
#include <optional>

namespace scree
{
  using namespace dealii;

  namespace
  {
    constexpr auto soil_walls = "Boundaries", water_walls = "Boundaries/Water";

    /// The types of walls that the entries of a subsection may have.
    std::vector<WallType> &wall_types(const std::string &subsection)
    {
      using Holds = Wall::Holds;
      static std::map<std::string, std::vector<WallType>>
          all = { { soil_walls,
                    { { "fixed", "", [](const double) { return Wall{ Holds::all }; } },
                      { "free slip", "", [](const double) { return Wall{ Holds::normal }; } },
                      { "friction",
                        "ANGLE (degrees, 0 to below 90)",
                        [](const double angle) {
                          return Wall{ Holds::normal, true, std::tan(angle * numbers::PI / 180.) };
                        },
                        0.,
                        90. },
                      { "open", "", [](const double) { return Wall(); } } } },
                  { water_walls,
                    { { "impermeable", "", [](const double) { return Wall{ Holds::normal }; } },
                      { "no slip", "", [](const double) { return Wall{ Holds::all }; } },
                      { "drained", "", [](const double) { return Wall(); } },
                      { "drained level",
                        "LEVEL(t) (m)",
                        [](const double) { return Wall(); },
                        std::numeric_limits<double>::lowest(),
                        std::numeric_limits<double>::max(),
                        true },
                      { "drained", "PRESSURE (Pa)", [](const double pressure) {
                         return Wall{ Holds::nothing, false, 0., pressure };
                       } } } } };
      return all.at(subsection);
    }


    /// What entries may have, for descriptions and messages.
    std::string accepted_walls(const std::string &subsection)
    {
      std::string accepted;
      for (const auto &type : wall_types(subsection))
        accepted += (accepted.empty() ? "" : " | ") + type.name + (type.number.empty() ? "" : ' ' + type.number);
      return accepted + '.';
    }


    /// Nothing if the text is no wall.
    std::optional<Wall> read_wall(const std::string &subsection, const std::string &text)
    {
      for (const WallType &type : wall_types(subsection))
        if (type.number.empty() && text == type.name)
          return type.make(0.);
        else if (!type.number.empty() && text.rfind(type.name + ' ', 0) == 0)
          {
            const std::string rest = Utilities::trim(text.substr(type.name.size()));
            if (type.is_level)
              {
                Wall wall  = type.make(0.);
                wall.level = rest;
                return wall;
              }
            if (const double number = number_of(rest); number >= type.least && number < type.below)
              return type.make(number);
          }
      return {};
    }
  } // namespace


  RegisterWallType::RegisterWallType(const std::string &subsection, const WallType &type)
  {
    wall_types(subsection).push_back(type);
  }


  void FaceEntries::add_parameters(ParameterHandler &prm)
  {
    const std::string what = " of the box" + phase + ": " + accepted_walls(subsection);
    const auto path        = Utilities::split_string_list(subsection, '/');
    for (const std::string &name : path)
      prm.enter_subsection(name);
    const std::string axes[] = { "x face", "y face (3D only)", "face of the last axis" };
    for (unsigned int f = 0; f < 6; ++f)
      prm.add_parameter(names(3)[f], texts[names(3)[f]], (f % 2 == 0 ? "Lower " : "Upper ") + axes[f / 2] + what);
    for (unsigned int i = 0; i < path.size(); ++i)
      prm.leave_subsection();
  }


  std::vector<Wall> FaceEntries::walls(const unsigned int dim) const
  {
    std::vector<Wall> result;
    for (const std::string &face : names(dim))
      {
        const std::optional<Wall> wall = read_wall(subsection, texts.at(face));
        if (!wall)
          throw EntryError(entry_name(subsection, face) + " = " + texts.at(face) +
                           ": write one of: " + accepted_walls(subsection));
        if (!wall->level.empty())
          parse_expression<1>(entry_name(subsection, face), wall->level, 1); // throws if it does not read
        result.push_back(*wall);
        if (wall->absorbs && face == "Bottom")
          result.back().holds = Wall::Holds::all;
      }
    return result;
  }


  BoundaryParameters::BoundaryParameters()
      : FaceEntries(soil_walls, "", "free slip", "fixed", "open")
  {
  }


  WaterBoundaryParameters::WaterBoundaryParameters()
      : FaceEntries(water_walls, ", for the water", "impermeable", "impermeable", "drained")
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
          if (wall_list[f].lets_lift_off)
            result.push_back({ inward, Type::unilateral, wall_list[f].friction_coefficient });
          else if (wall_list[f].holds == Wall::Holds::all)
            for (unsigned int a = 0; a < dim; ++a)
              result.push_back({ Point<dim>::unit_vector(a), Type::fixed, 0. });
          else if (wall_list[f].holds == Wall::Holds::normal)
            result.push_back({ inward, Type::fixed, 0. });
        }
    return result;
  }


  template <int dim>
  BoundaryConditions<dim>::BoundaryConditions(const BackgroundGrid<dim> &grid,
                                              const FaceEntries &parameters,
                                              const double unit_weight)
      : grid(grid)
      , wall_list(parameters.walls(dim))
      , unit_weight(unit_weight)
  {
    for (unsigned int f = 0; f < 2 * dim; ++f)
      if (!wall_list[f].level.empty())
        levels[f] = parse_expression<1>(entry_name(water_walls, FaceEntries::names(dim)[f]), wall_list[f].level, 1);
    set_time(0.);
  }


  template <int dim>
  void BoundaryConditions<dim>::set_time(const double time)
  {
    for (unsigned int f = 0; f < 2 * dim; ++f)
      if (levels[f])
        present_levels[f] = levels[f]->value(Point<1>(time));
  }


  template <int dim>
  double BoundaryConditions<dim>::pressure(const std::uint8_t faces, const double height) const
  {
    double sum     = 0;
    unsigned int n = 0;
    for (unsigned int f = 0; f < 2 * dim; ++f)
      if ((faces >> f) & 1 && is_open(f))
        {
          sum += levels[f] ? std::max(0., unit_weight * (present_levels[f] - height)) : wall_list[f].pressure;
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

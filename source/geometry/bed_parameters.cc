// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/geometry/bed_parameters.h>
#include <scree/geometry/expression_surface.h>
#include <scree/geometry/height_surface.h>
#include <scree/geometry/profile.h>
#include <scree/geometry/triangle_surface.h>
#include <scree/input/input_error.h>
#include <scree/input/named_file.h>

#include <cmath>
#include <limits>

namespace scree
{
  using namespace dealii;

  void BedParameters::add_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection(subsection);
    add_entries(prm);
    add_file_entry(
        prm,
        "Friction angles",
        friction_angles,
        "degrees; 3D. ESRI ASCII grid of the angles, which covers the box; alternative to \"Friction angle\".");
    prm.leave_subsection();
  }


  void BedParameters::add_entries(ParameterHandler &prm)
  {
    prm.add_parameter("Type",
                      type,
                      "Condition for soil that presses on the rigid surface: fixed (no slip), free slip or friction. "
                      "none: no surface. The surface may cut cells at any position and angle.",
                      Patterns::Selection("none|fixed|free slip|friction"));
    prm.add_parameter("Type for water",
                      for_water,
                      "Condition for free water along the surface: impermeable (free slip), or no slip, which needs "
                      "\"Viscosity\" in subsection Water.",
                      Patterns::Selection("impermeable|no slip"));
    prm.add_parameter("Friction angle",
                      friction_angle,
                      "degrees; friction angle of \"Type = friction\", above 0 and below 90.",
                      Patterns::Double(0, 89.99));
    prm.add_parameter("Level set expression",
                      expression,
                      "m; expression of x, y (z): positive in the open, 0 on the surface. A signed distance is best, "
                      "such as (y - 0.2*x)/sqrt(1.04).",
                      Patterns::Anything());
    add_file_entry(
        prm,
        "Profile",
        profile,
        "m; 2D. File of ground points x, y, one per line, with ascending x; alternative to \"Level set expression\".");
    add_file_entry(prm,
                   "Raster",
                   raster,
                   "m; 3D. ESRI ASCII grid of the ground heights; alternative to \"Level set expression\".");
    add_file_entry(prm,
                   "Closed surface",
                   closed_surface,
                   "m; 3D. STL file of the surface of a solid; alternative to \"Level set expression\".");
  }


  BedType BedParameters::type_kind() const
  {
    if (type == "fixed")
      return BedType::fixed;
    if (type == "free slip")
      return BedType::free_slip;
    return type == "friction" ? BedType::friction : BedType::none;
  }


  double BedParameters::friction_coefficient() const
  {
    switch (type_kind())
      {
      case BedType::fixed:
        return std::numeric_limits<double>::infinity();
      case BedType::friction:
        return std::tan(friction_angle * numbers::PI / 180.);
      default:
        return 0.;
      }
  }


  std::pair<std::string, std::string> BedParameters::geometry() const
  {
    if (!profile.empty())
      return { "Profile", profile };
    if (!raster.empty())
      return { "Raster", raster };
    if (!closed_surface.empty())
      return { "Closed surface", closed_surface };
    return { "Level set expression", expression };
  }


  void BedParameters::check(const unsigned int dim) const
  {
    const auto require = [this](const bool possible, const auto &entry, const std::string &remedy) {
      require_entry(possible, subsection, entry.first, entry.second, remedy);
    };
    const auto given        = geometry();
    const bool is_rough     = type_kind() == BedType::friction;
    const int n_given       = !expression.empty() + !profile.empty() + !raster.empty() + !closed_surface.empty();
    const auto type_entry   = std::make_pair(std::string("Type"), type);
    const auto angles_entry = std::make_pair(std::string("Friction angles"), friction_angles);
    require(is_rough || friction_angles.empty(),
            angles_entry,
            "this entry has no effect. Remove it, or write \"Type = friction\".");
    require(
        dim == 3 || friction_angles.empty(), angles_entry, "maps are for scenes in space. Write a \"Friction angle\".");
    require(friction_angle == 0. || friction_angles.empty(),
            angles_entry,
            "friction is given twice. Keep one of \"Friction angle\" and \"Friction angles\".");
    require(is_rough || friction_angle == 0.,
            std::make_pair(std::string("Friction angle"), friction_angle),
            "this entry has no effect. Remove it, or write \"Type = friction\".");
    require(!is_rough || friction_angle > 0. || !friction_angles.empty(),
            std::make_pair(std::string("Friction angle"), friction_angle),
            "write an angle above 0, in degrees, or \"Type = free slip\".");
    require(is_set() || n_given == 0,
            given,
            "\"Type = none\" does not take this entry. Choose another type, or remove the entry.");
    require(is_set() || !no_slip(),
            std::make_pair(std::string("Type for water"), for_water),
            "\"Type = none\" does not take this entry. Choose another type, or remove the entry.");
    if (!is_set())
      return;
    require(n_given > 0,
            type_entry,
            "the surface has no geometry. Write one of \"Level set expression\", \"Profile\" (2D), \"Raster\" and "
            "\"Closed surface\" "
            "(3D).");
    require(n_given < 2, given, "it is given twice. Keep one of expression, profile, raster and closed surface.");
    require(dim == 2 || profile.empty(),
            given,
            "a profile is ground of plane scenes. Write a \"Raster\" or a \"Level set expression\".");
    require(dim == 3 || raster.empty(),
            given,
            "a raster is ground of scenes in space. Write a \"Profile\" or a \"Level set expression\".");
    require(dim == 3 || closed_surface.empty(),
            given,
            "solids of triangles are for scenes in space. Write a \"Profile\" or a \"Level set expression\".");
    if (dim == 2 && !expression.empty())
      ExpressionSurface<2>(entry_name(subsection, given.first), expression, 1.);
    if (dim == 3 && !expression.empty())
      ExpressionSurface<3>(entry_name(subsection, given.first), expression, 1.);
  }


  namespace
  {
    /// Throws EntryError unless ground from `first` to `last` along an axis covers the box.
    void require_cover(const bool covers,
                       const BedParameters &parameters,
                       const std::string &axis,
                       const double first,
                       const double last)
    {
      const auto [entry, value] = parameters.geometry();
      require_entry(
          covers,
          parameters.subsection,
          entry,
          value,
          "the ground reaches from " + axis + " = " + number_text(first) + " to " + number_text(last) +
              " m only and does not cover the box of subsection Mesh. Write a longer ground or a smaller box.");
    }


    std::unique_ptr<LevelSet<2>> make_ground(const BedParameters &parameters,
                                             const std::vector<double> &lower,
                                             const std::vector<double> &upper,
                                             const Point<2> &)
    {
      auto profile =
          std::make_unique<Profile>(read_profile(parameters.profile, entry_name(parameters.subsection, "Profile")));
      require_cover(profile->first_x() <= lower[0] && profile->last_x() >= upper[0],
                    parameters,
                    "x",
                    profile->first_x(),
                    profile->last_x());
      return profile;
    }


    std::unique_ptr<LevelSet<3>>
    make_solid(const BedParameters &parameters, const std::vector<double> &lower, const std::vector<double> &upper)
    {
      auto surface =
          read_triangle_surface(parameters.closed_surface, entry_name(parameters.subsection, "Closed surface"));
      const auto &[first, last] = surface->bounds();
      bool is_in_box            = true;
      for (unsigned int a = 0; a < 3; ++a)
        is_in_box = is_in_box && first[a] < upper[a] && last[a] > lower[a];
      require_entry(is_in_box,
                    parameters.subsection,
                    "Closed surface",
                    parameters.closed_surface,
                    "it reaches from " + number_text(first) + " to " + number_text(last) +
                        " m and lies outside the box of subsection Mesh. Look at its unit of length and its origin.");
      return surface;
    }


    std::unique_ptr<LevelSet<3>> make_ground(const BedParameters &parameters,
                                             const std::vector<double> &lower,
                                             const std::vector<double> &upper,
                                             const Point<3> &)
    {
      if (!parameters.closed_surface.empty())
        return make_solid(parameters, lower, upper);
      Raster raster =
          read_raster(parameters.raster, entry_name(parameters.subsection, "Raster"), parameters.map_origin);
      const double rounding = 1e-6 * raster.spacing;
      const auto covers     = [&](const double first, const double last, const unsigned int axis) {
        return first <= lower[axis] + rounding && last >= upper[axis] - rounding;
      };
      require_cover(covers(raster.x, raster.last_x(), 0), parameters, "x", raster.x, raster.last_x());
      require_cover(covers(raster.y, raster.last_y(), 1), parameters, "y", raster.y, raster.last_y());
      return std::make_unique<HeightSurface>(std::move(raster));
    }
  } // namespace


  Raster
  read_friction(const BedParameters &parameters, const std::vector<double> &lower, const std::vector<double> &upper)
  {
    const std::string where = entry_name(parameters.subsection, "Friction angles");
    Raster raster           = read_raster(parameters.friction_angles, where, parameters.map_origin);
    const auto require      = [&](const bool possible, const std::string &remedy) {
      if (!possible)
        throw EntryError(where + " = " + parameters.friction_angles + ": " + remedy);
    };
    require(raster.x <= lower[0] && raster.last_x() >= upper[0] && raster.y <= lower[1] && raster.last_y() >= upper[1],
            "the angles do not cover the box of subsection Mesh: they reach from " +
                number_text({ raster.x, raster.y }) + " to " + number_text({ raster.last_x(), raster.last_y() }) +
                " m. Write more of them, or a smaller box.");
    for (unsigned int row = 0; row < raster.n_rows; ++row)
      for (unsigned int column = 0; column < raster.n_columns; ++column)
        {
          double &value  = raster.values[std::size_t(row) * raster.n_columns + column];
          const double x = raster.x + column * raster.spacing, y = raster.y + row * raster.spacing;
          const bool counts = x > lower[0] - raster.spacing && x < upper[0] + raster.spacing &&
                              y > lower[1] - raster.spacing && y < upper[1] + raster.spacing;
          require(!counts || (value >= 0. && value < 90.),
                  "at " + number_text({ x, y }) + " m it is " + (std::isnan(value) ? "missing" : number_text(value)) +
                      ". Write angles from 0 to below 90 degrees.");
          value = std::tan(value * numbers::PI / 180.);
        }
    return raster;
  }


  template <int dim>
  std::unique_ptr<LevelSet<dim>> make_bed(const BedParameters &parameters,
                                          const std::vector<double> &lower,
                                          const std::vector<double> &upper,
                                          const double cell_size)
  {
    if (!parameters.is_set())
      return nullptr;
    if (!parameters.expression.empty())
      return std::make_unique<ExpressionSurface<dim>>(
          entry_name(parameters.subsection, "Level set expression"), parameters.expression, cell_size);
    return make_ground(parameters, lower, upper, Point<dim>());
  }

  template std::unique_ptr<LevelSet<2>>
  make_bed<2>(const BedParameters &, const std::vector<double> &, const std::vector<double> &, const double);
  template std::unique_ptr<LevelSet<3>>
  make_bed<3>(const BedParameters &, const std::vector<double> &, const std::vector<double> &, const double);
} // namespace scree

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/geometry/bed_parameters.h>
#include <scree/input/case_entries.h>
#include <scree/input/expression.h>
#include <scree/input/input_error.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// Made at the first call, whichever source file registers first.
    auto &shapes()
    {
      static std::vector<std::pair<std::string, RigidShape>> all;
      return all;
    }


    /// 0: all, 1: plane ones, 2: those in space.
    int scenes_of(const RigidShape &shape)
    {
      return !shape.make_3d ? 1 : !shape.make_2d ? 2 : 0;
    }
  } // namespace


  std::string ShapeRequest::where() const
  {
    return entry_name(subsection, entry);
  }


  void ShapeRequest::require(const bool possible, const std::string &remedy) const
  {
    require_entry(possible, { subsection, entry, value }, remedy);
  }


  void ShapeRequest::require_cover(const unsigned int axis,
                                   const double first,
                                   const double last,
                                   const double rounding) const
  {
    require(first <= lower[axis] + rounding && last >= upper[axis] - rounding,
            std::string("the ground reaches from ") + "xyz"[axis] + " = " + number_text(first) + " to " +
                number_text(last) +
                " m only and does not cover the box of subsection Mesh. Write a longer ground or a smaller box.");
  }


  const std::vector<std::pair<std::string, RigidShape>> &rigid_shapes()
  {
    return shapes();
  }


  std::string names_of_shapes()
  {
    const std::string scenes[] = { "", " (2D)", " (3D)" };
    std::string names;
    for (const auto &one : shapes())
      names += (&one == &shapes().front()  ? ""
                : &one == &shapes().back() ? " and "
                                           : ", ") +
               quoted(one.first) + scenes[scenes_of(one.second)];
    return names;
  }


  RegisterShape::RegisterShape(const std::string &entry, RigidShape shape)
  {
    shapes().emplace_back(entry, std::move(shape));
    std::sort(shapes().begin(), shapes().end(), [](const auto &a, const auto &b) {
      return std::make_pair(scenes_of(a.second), a.first) < std::make_pair(scenes_of(b.second), b.first);
    });
  }


  void BedParameters::add_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection(subsection);
    add_entries(prm);
    prm.add_parameter(
        "Turbulent friction",
        turbulent_friction,
        "m/s^2; coefficient xi of the friction of Voellmy, rho g v^2/xi beside that of the angle. 0: none. "
        "Dry scenes.",
        Patterns::Double(0));
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
    for (const auto &[entry, shape] : rigid_shapes())
      if (shape.value == ShapeValue::file)
        add_file_entry(prm, entry, shapes[entry], shape.documentation);
      else
        prm.add_parameter(entry, shapes[entry], shape.documentation, Patterns::Anything());
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
    std::pair<std::string, std::string> last;
    for (const auto &[entry, shape] : rigid_shapes())
      if (const auto value = shapes.find(entry); value != shapes.end() && !value->second.empty())
        last = *value;
    return last;
  }


  std::string BedParameters::raster() const
  {
    const auto value = shapes.find("Raster");
    return value == shapes.end() ? "" : value->second;
  }


  namespace
  {
    template <int dim>
    std::unique_ptr<LevelSet<dim>> make_shape(const BedParameters &parameters,
                                              const std::vector<double> &lower,
                                              const std::vector<double> &upper,
                                              const double cell_size)
    {
      const auto [given, value] = parameters.geometry();
      for (const auto &[entry, shape] : rigid_shapes())
        if (entry == given)
          return shape.template make<dim>()(
              { parameters.subsection, entry, value, parameters.map_origin, lower, upper, cell_size });
      return nullptr;
    }
  } // namespace


  void BedParameters::check(const unsigned int dim) const
  {
    const auto require = [this](const bool possible, const auto &entry, const std::string &remedy) {
      require_entry(possible, { subsection, entry.first, entry.second }, remedy);
    };
    const auto given    = geometry();
    const bool is_rough = type_kind() == BedType::friction;
    const auto n_given =
        std::count_if(shapes.begin(), shapes.end(), [](const auto &shape) { return !shape.second.empty(); });
    const auto type_entry = std::make_pair(std::string("Type"), type);
    require(is_rough || friction_angle == 0.,
            std::make_pair(std::string("Friction angle"), friction_angle),
            "this entry has no effect. Remove it, or write \"Type = friction\".");
    require(!is_rough || friction_angle > 0.,
            std::make_pair(std::string("Friction angle"), friction_angle),
            "write an angle above 0, in degrees, or \"Type = free slip\".");
    require(is_rough || turbulent_friction == 0.,
            std::make_pair(std::string("Turbulent friction"), turbulent_friction),
            "this entry has no effect. Remove it, or write \"Type = friction\".");
    require(is_set() || n_given == 0,
            given,
            "\"Type = none\" does not take this entry. Choose another type, or remove the entry.");
    require(is_set() || !no_slip(),
            std::make_pair(std::string("Type for water"), for_water),
            "\"Type = none\" does not take this entry. Choose another type, or remove the entry.");
    if (!is_set())
      return;
    require(n_given > 0, type_entry, "the surface has no geometry. Write one of " + names_of_shapes() + '.');
    require(n_given < 2, given, "it is given twice. Keep one of " + names_of_shapes() + '.');
    for (const auto &[entry, shape] : rigid_shapes())
      if (entry == given.first)
        {
          require(dim == 2 ? bool(shape.make_2d) : bool(shape.make_3d), given, shape.remedy);
          if (shape.value == ShapeValue::text)
            dim == 2 ? void(make_shape<2>(*this, {}, {}, 1.)) : void(make_shape<3>(*this, {}, {}, 1.));
        }
  }


  template <int dim>
  std::unique_ptr<LevelSet<dim>> make_bed(const BedParameters &parameters,
                                          const std::vector<double> &lower,
                                          const std::vector<double> &upper,
                                          const double cell_size)
  {
    return parameters.is_set() ? make_shape<dim>(parameters, lower, upper, cell_size) : nullptr;
  }

  template decltype(make_bed<2>) make_bed<2>;
  template decltype(make_bed<3>) make_bed<3>;


  const std::string ObstacleParameters::prefix = "Obstacle ";


  ObstacleParameters::ObstacleParameters(const std::string &subsection)
  {
    surface.subsection = subsection;
  }


  std::string ObstacleParameters::name() const
  {
    return surface.subsection.substr(prefix.size());
  }


  void ObstacleParameters::add_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection(surface.subsection);
    surface.add_entries(prm);
    prm.add_parameter("Velocity",
                      velocity,
                      "m/s; velocity from t = 0 on: one expression of t per axis, separated by semicolons, such as 0; "
                      "if(t < 1, 0.5, 0). The obstacle translates without rotation. Empty: at rest.",
                      Patterns::Anything());
    prm.add_parameter("Moment about",
                      pivot,
                      "m; place about which the moment on the obstacle is computed, one coordinate per axis. Empty: "
                      "the middle of the floor of the box.",
                      Patterns::List(Patterns::Double(), 0, 3));
    prm.leave_subsection();
  }


  void ObstacleParameters::check(const unsigned int dim) const
  {
    surface.check(dim);
    if (!velocity.empty())
      parse_expression<1>(entry_name(surface.subsection, "Velocity"), velocity, dim);
    require_entry(pivot.empty() || Utilities::split_string_list(pivot).size() == dim,
                  { surface.subsection, "Moment about", pivot },
                  "write " + std::to_string(dim) + " numbers in m, separated by commas.");
  }
} // namespace scree

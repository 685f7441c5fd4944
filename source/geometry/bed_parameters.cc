// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/geometry/bed_parameters.h>
#include <scree/geometry/rigid_shape.h>
#include <scree/input/input_error.h>
#include <scree/input/named_file.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace scree
{
  using namespace dealii;

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
      require_entry(possible, subsection, entry.first, entry.second, remedy);
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

  template std::unique_ptr<LevelSet<2>>
  make_bed<2>(const BedParameters &, const std::vector<double> &, const std::vector<double> &, const double);
  template std::unique_ptr<LevelSet<3>>
  make_bed<3>(const BedParameters &, const std::vector<double> &, const std::vector<double> &, const double);
} // namespace scree

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/case/unusual_units.h>
#include <scree/particles/region.h>

#include <deal.II/base/mpi.h>

#include <cmath>

namespace scree
{
  namespace
  {
    class Questions
    {
    public:
      /// Asks about a value that is neither 0 nor from `low` to `high`.
      void ask(const std::string &subsection,
               const std::string &entry,
               const double value,
               const double low,
               const double high,
               const std::string &unit)
      {
        if (value != 0 && !(value >= low && value <= high))
          list.push_back("Unusual value: " + entry_message(subsection,
                                                           entry,
                                                           number_text(value),
                                                           "the unit is " + unit + ", and usual values lie between " +
                                                               number_text(low) + " and " + number_text(high) + '.'));
      }

      std::vector<std::string> list;
    };


    /// Bodies that shear within themselves before they slide on a base of this friction coefficient.
    void ask_of_base(const Parameters &parameters,
                     const std::string &subsection,
                     const std::string &entry,
                     const double friction,
                     Questions &questions)
    {
      constexpr double rounding = 1.005; // an angle with three digits
      for (const BodyParameters &body : parameters.bodies)
        {
          const double of_body = make_material<2>(body.material)->plane_friction();
          if (friction > rounding * of_body)
            questions.list.push_back(
                "Base stronger than the soil: " +
                entry_message(subsection,
                              entry,
                              number_text(std::atan(friction) * 180 / dealii::numbers::PI) + " degrees",
                              body.name + " shears on a plane at " +
                                  number_text(std::atan(of_body) * 180 / dealii::numbers::PI) +
                                  " degrees. It does not slide on this base, and its lowest cells shear as on a fixed "
                                  "one. An angle of repose is \"Friction angle kind = direct shear or repose\"."));
        }
    }


    /// Shear bands of a length that the cells do not resolve.
    void ask_of_length(const BodyParameters &body, const double cell_size, Questions &questions)
    {
      const double length = make_material<2>(body.material)->nonlocal_variable().length;
      if (constexpr double rounding = 1e-9; length > 0 && cell_size > length / 2 * (1 + rounding))
        questions.list.push_back("Unusual value: " +
                                 entry_message(body.material.path(body.name),
                                               "Nonlocal length",
                                               number_text(length),
                                               "shear bands depend on cells wider than half of it, here " +
                                                   number_text(cell_size) + " m. Use cells of at most " +
                                                   number_text(length / 2) + " m."));
    }


    constexpr char conductivity_unit[] = "m/s (1 m/d = 1.16e-5 m/s)";
    constexpr char diameter_unit[]     = "m (1 mm = 1e-3 m)";


    void
    ask_of_law(const MaterialParameters &material, const std::string &body, const bool is_wet, Questions &questions)
    {
      double cohesion = 0.;
      for (const UsualRange &range : material.chosen().usual_ranges())
        {
          questions.ask(material.path(body), range.entry, range.value, range.lowest, range.highest, range.unit);
          if (range.entry == "Cohesion")
            cohesion = range.value;
          if (range.entry == "Tension cut-off" && range.value == 0. && cohesion > 0. && is_wet)
            questions.list.push_back(
                "Unusual value: " +
                entry_message(material.path(body),
                              range.entry,
                              "0",
                              "with cohesion, here " + number_text(cohesion) +
                                  " Pa, soil in water opens in small waves, and the suction of the "
                                  "pores slows it. Write a cut-off above 0, such as the cohesion."));
        }
    }


    /// Rain in mm/h; the largest rate of its time.
    void ask_of_rain(const Parameters &parameters, Questions &questions)
    {
      constexpr unsigned int n_times = 1000;
      if (!parameters.rain.is_set())
        return;
      const auto rate = parse_expression<1>(entry_name("Rain", "Rate"), parameters.rain.rate, 1);
      double largest  = 0.;
      for (unsigned int i = 0; i <= n_times; ++i)
        largest = std::max(largest, rate->value(dealii::Point<1>(i * parameters.end_time / n_times)));
      questions.ask("Rain", "Rate", largest, 1e-10, 0.1, "m/s (1 mm/h = 2.78e-7 m/s)");
    }


    /// A water table more than a cell above all soil. Collective.
    template <int dim>
    void ask_of_table(const Parameters &parameters,
                      const std::list<SoilBody<dim>> &bodies,
                      const MPI_Comm communicator,
                      Questions &questions)
    {
      const auto [entry, value] = parameters.water.place();
      if (entry.rfind("Phreatic", 0) != 0 || !parameters.water.reservoir_level.empty())
        return;
      const Region<dim> wet(entry_name("Water", entry),
                            parameters.water.without_fringe().region_in_soil(dim),
                            nullptr,
                            parameters.water.table<dim>());
      bool is_below = true;
      for (const auto &body : bodies)
        for_each_point(body.points, [&](const auto &point) {
          is_below = is_below && wet.contains(point.location +
                                              parameters.grid.cell_size * dealii::Point<dim>::unit_vector(dim - 1));
        });
      if (dealii::Utilities::MPI::min(int(is_below), communicator) == 1)
        questions.list.push_back(
            "Unusual value: " +
            entry_message("Water",
                          entry,
                          value,
                          "all soil lies more than a cell below it, and no water stands outside the soil. Check unit "
                          "(m) and datum; write a \"Reservoir level\" for water above the ground."));
    }
  } // namespace


  template <int dim>
  std::vector<std::string>
  unusual_values(const Parameters &parameters, const std::list<SoilBody<dim>> &bodies, const MPI_Comm communicator)
  {
    Questions questions;
    questions.list = parameters.unread_laws;
    for (const BodyParameters &body : parameters.bodies)
      {
        questions.ask(
            body.name, "Grain density", body.seeding.grain_density, 500, 2e4, "kg/m^3 (1 g/cm^3 = 1e3 kg/m^3)");
        questions.ask(body.name + "/Initial state", "Pressure", body.initial_state.pressure, 50, 1e9, unit_of_pressure);
        ask_of_law(body.material, body.name, parameters.has_water, questions);
        ask_of_length(body, parameters.grid.cell_size, questions);
        questions.ask(body.name, "Hydraulic conductivity", body.seepage.conductivity, 1e-13, 1, conductivity_unit);
        questions.ask(body.name, "Grain diameter", body.seepage.grain_diameter, 1e-7, 3, diameter_unit);
      }
    questions.ask("Bed", "Turbulent friction", parameters.bed.turbulent_friction, 20, 2e4, "m/s^2");
    const auto walls = parameters.boundaries.walls(3);
    for (unsigned int face = 0; face < walls.size(); ++face)
      {
        questions.ask("Boundaries",
                      FaceEntries::names(3)[face],
                      std::atan(walls[face].friction_coefficient) * 180 / dealii::numbers::PI,
                      2,
                      60,
                      unit_of_angle);
        if (FaceEntries::names(3)[face] == "Bottom")
          ask_of_base(parameters, "Boundaries", "Bottom", walls[face].friction_coefficient, questions);
      }
    if (parameters.bed.type_kind() == BedType::friction && parameters.bed.friction_angles.empty())
      ask_of_base(parameters, "Bed", "Friction angle", parameters.bed.friction_coefficient(), questions);
    if (parameters.has_water)
      {
        const WaterParameters &water = parameters.water;
        questions.ask("Water", "Density", water.density, 500, 2e3, "kg/m^3 (1 g/cm^3 = 1e3 kg/m^3)");
        questions.ask("Water", "Hydraulic conductivity", water.conductivity, 1e-13, 1, conductivity_unit);
        questions.ask("Water", "Grain diameter", water.grain_diameter, 1e-7, 3, diameter_unit);
        questions.ask("Water", "Viscosity", water.viscosity, 1e-4, 1e3, "Pa s (1 mPa s = 1e-3 Pa s)");
        questions.ask("Water", "Bulk modulus", water.bulk_modulus, 1e4, 1e10, unit_of_pressure);
        ask_of_rain(parameters, questions);
        ask_of_table(parameters, bodies, communicator, questions);
      }
    return questions.list;
  }

  template std::vector<std::string> unusual_values(const Parameters &, const std::list<SoilBody<2>> &, const MPI_Comm);
  template std::vector<std::string> unusual_values(const Parameters &, const std::list<SoilBody<3>> &, const MPI_Comm);
} // namespace scree

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/case/case_remarks.h>
#include <scree/materials/laws/mohr_coulomb.h>
#include <scree/particles/region.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace scree
{
  namespace
  {
    /// Bodies that shear within themselves before they slide on a base of this friction coefficient.
    void add_stronger_base(const Parameters &parameters,
                           const std::string &subsection,
                           const std::string &entry,
                           const double friction,
                           std::vector<std::string> &remarks)
    {
      constexpr double rounding = 1.005; // an angle with three digits
      for (const BodyParameters &body : parameters.bodies)
        if (const double inside = make_material<2>(body.material)->plane_friction(); friction > rounding * inside)
          remarks.push_back(
              "Base stronger than the soil: " +
              entry_message(subsection,
                            entry,
                            number_text(std::atan(friction) * 180 / dealii::numbers::PI) + " degrees",
                            body.name + " shears on a plane at " +
                                number_text(std::atan(inside) * 180 / dealii::numbers::PI) +
                                " degrees. It does not slide on this base, and its lowest cells shear as on a fixed "
                                "one. An angle of repose is \"Friction angle kind = direct shear or repose\"."));
    }


    /// Shear bands of a length that the cells do not resolve.
    void add_unresolved_length(const BodyParameters &body, const double cell_size, std::vector<std::string> &remarks)
    {
      constexpr double rounding = 1e-9;
      const double length       = make_material<2>(body.material)->nonlocal_variable().length;
      if (length > 0 && cell_size > length / 2 * (1 + rounding))
        remarks.push_back("Unusual value: " + entry_message(body.material.path(body.name),
                                                            "Nonlocal length",
                                                            number_text(length),
                                                            "shear bands depend on cells wider than half of it, here " +
                                                                number_text(cell_size) + " m. Use cells of at most " +
                                                                number_text(length / 2) + " m."));
    }


    /// Cohesion without a tensile strength in water.
    void add_opening_soil(const BodyParameters &body, std::vector<std::string> &remarks)
    {
      if (body.material.law != "Mohr-Coulomb")
        return;
      const auto &law = body.material.of<MohrCoulombParameters>();
      if (law.cohesion > 0. && law.tension_cut_off == 0.)
        remarks.push_back(
            "Unusual value: " +
            entry_message(body.material.path(body.name),
                          "Tension cut-off",
                          "0",
                          "with cohesion, here " + number_text(law.cohesion) +
                              " Pa, soil in water opens in small waves, and the suction of the pores slows it. Write a "
                              "cut-off above 0, such as the cohesion."));
    }


    /// Water in units other than SI.
    void add_unusual_water(const Parameters &parameters, std::vector<std::string> &remarks)
    {
      constexpr unsigned int n_times = 1000;
      double rain                    = 0.; // largest rate of its time
      if (parameters.rain.is_set())
        {
          const auto rate = parse_expression<1>(entry_name("Rain", "Rate"), parameters.rain.rate, 1);
          for (unsigned int i = 0; i <= n_times; ++i)
            rain = std::max(rain, rate->value(dealii::Point<1>(i * parameters.end_time / n_times)));
        }
      const auto ask = [&](const std::string &subsection,
                           const std::string &entry,
                           const double value,
                           const double lowest,
                           const double highest,
                           const std::string &unit) {
        if (value != 0. && !(value >= lowest && value <= highest))
          remarks.push_back("Unusual value: " +
                            entry_message(subsection, entry, number_text(value), "the unit is " + unit + "."));
      };
      constexpr char conductivity_unit[] = "m/s (1 m/d = 1.16e-5 m/s)";
      const WaterParameters &water       = parameters.water;
      for (const BodyParameters &body : parameters.bodies)
        ask(body.name, "Hydraulic conductivity", body.seepage.conductivity, 1e-13, 1., conductivity_unit);
      ask("Water", "Density", water.density, 500., 2e3, "kg/m^3 (1 g/cm^3 = 1e3 kg/m^3)");
      ask("Water", "Hydraulic conductivity", water.conductivity, 1e-13, 1., conductivity_unit);
      ask("Water", "Grain diameter", water.grain_diameter, 1e-7, 3., "m (1 mm = 1e-3 m)");
      ask("Water", "Viscosity", water.viscosity, 1e-4, 1e3, "Pa s (1 mPa s = 1e-3 Pa s)");
      ask("Water", "Bulk modulus", water.bulk_modulus, 1e4, 1e10, "Pa (1 kPa = 1e3 Pa, 1 MPa = 1e6 Pa)");
      ask("Rain", "Rate", rain, 1e-10, 0.1, "m/s (1 mm/h = 2.78e-7 m/s)");
    }


    /// A water table more than a cell above all soil. Collective.
    template <int dim>
    void add_table_above_soil(const Parameters &parameters,
                              const std::list<SoilBody<dim>> &bodies,
                              const MPI_Comm communicator,
                              std::vector<std::string> &remarks)
    {
      const auto [entry, value] = parameters.water.place();
      if (entry.rfind("Phreatic", 0) != 0 || !parameters.water.reservoir_level.empty())
        return;
      const Region<dim> wet(entry_name("Water", entry),
                            parameters.water.without_fringe().region_in_soil(dim),
                            nullptr,
                            parameters.water.table<dim>());
      const auto up = parameters.grid.cell_size * dealii::Point<dim>::unit_vector(dim - 1);
      bool is_below = true;
      for (const auto &body : bodies)
        for_each_point(body.points,
                       [&](const auto &point) { is_below = is_below && wet.contains(point.location + up); });
      if (dealii::Utilities::MPI::min(int(is_below), communicator) == 1)
        remarks.push_back("Unusual value: " +
                          entry_message("Water",
                                        entry,
                                        value,
                                        "all soil lies more than a cell below it, and no water stands outside the "
                                        "soil. Check unit (m) and datum; write a \"Reservoir level\" for water above "
                                        "the ground."));
    }
  } // namespace


  template <int dim>
  std::vector<std::string>
  remarks_on(const Parameters &parameters, const std::list<SoilBody<dim>> &bodies, const MPI_Comm communicator)
  {
    std::vector<std::string> remarks = parameters.unread_laws;
    for (const BodyParameters &body : parameters.bodies)
      add_unresolved_length(body, parameters.grid.cell_size, remarks);
    const auto walls = parameters.boundaries.walls(3);
    const auto names = FaceEntries::names(3);
    for (unsigned int face = 0; face < walls.size(); ++face)
      if (names[face] == "Bottom")
        add_stronger_base(parameters, "Boundaries", names[face], walls[face].friction_coefficient, remarks);
    if (parameters.bed.type_kind() == BedType::friction)
      add_stronger_base(parameters, "Bed", "Friction angle", parameters.bed.friction_coefficient(), remarks);
    if (parameters.has_water)
      {
        for (const BodyParameters &body : parameters.bodies)
          add_opening_soil(body, remarks);
        add_unusual_water(parameters, remarks);
        add_table_above_soil(parameters, bodies, communicator, remarks);
      }
    return remarks;
  }

  template std::vector<std::string> remarks_on(const Parameters &, const std::list<SoilBody<2>> &, const MPI_Comm);
  template std::vector<std::string> remarks_on(const Parameters &, const std::list<SoilBody<3>> &, const MPI_Comm);
} // namespace scree

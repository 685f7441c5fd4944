// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/boundary/inflow/inflow_parameters.h>

namespace scree
{
  using namespace dealii;

  const std::string InflowParameters::prefix = "Inflow ";


  void InflowParameters::add_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection(subsection);
    prm.add_parameter("Body", body, "Material that enters: the name of a soil body, or Water.");
    prm.add_parameter("Saturated", is_saturated, "true: soil enters with its pores full of water.");
    prm.add_parameter("Face",
                      face,
                      "Face of the box through which the material enters, along the inward normal.",
                      Patterns::Selection("Left|Right|Front|Back|Bottom|Top"));
    prm.add_parameter("Section",
                      section,
                      "m; coordinate of the inflow section along the normal of the face, a multiple of the point "
                      "spacing away from it. Empty: at the face.");
    prm.add_parameter("Region",
                      region,
                      "Open part of the section, where this expression of x, y (z), in m, is true. The part below the "
                      "bed is left out.");
    prm.add_parameter("Speed", speed, "m/s; inflow speed, not negative: an expression of t, such as 2*min(t/5, 1).");
    add_file_entry(prm,
                   "Hydrograph",
                   hydrograph,
                   "File of the time (s) and the speed or discharge, one pair per line, separated by a comma; "
                   "alternative to \"Speed\". Values are linear between lines and 0 outside the record.");
    prm.add_parameter("Hydrograph of",
                      hydrograph_of,
                      "Quantity in the hydrograph. speed: m/s. discharge: m^3/s (2D: m^2/s) of soil with its pores, "
                      "through the whole open part.",
                      Patterns::Selection("speed|discharge"));
    prm.add_parameter("Direction",
                      direction,
                      "Inflow direction, one component per axis; the length does not matter. Empty: the inward "
                      "normal of the face.",
                      Patterns::List(Patterns::Double(), 0, 3));
    prm.add_parameter("End time",
                      end_time,
                      "s; time at which the inflow ends; -1: with the run. Afterwards the condition of subsection "
                      "Boundaries holds at the section.",
                      Patterns::Double(-1));
    prm.leave_subsection();
  }


  std::vector<double> InflowParameters::unit_direction(const unsigned int dim) const
  {
    std::vector<double> result(dim, 0.);
    const unsigned int number = face_number(dim);
    if (direction.empty())
      result[number / 2] = number % 2 == 0 ? 1. : -1.;
    else
      {
        double largest = 0, square = 0;
        const auto texts = Utilities::split_string_list(direction);
        for (unsigned int a = 0; a < dim; ++a)
          largest = std::max(largest, std::abs(result[a] = number_of(texts[a])));
        for (double &component : result)
          square += std::pow(component /= largest, 2);
        for (double &component : result)
          component /= std::sqrt(square);
      }
    return result;
  }


  void
  InflowParameters::check(const GridParameters &grid, const unsigned int dim, const unsigned int points_per_cell) const
  {
    require_entry(face_number(dim) < 2 * dim,
                  { subsection, "Face", face },
                  "there is no such wall in 2D. Write Left, Right, Bottom or Top.");
    check_section(grid, dim, points_per_cell);
    check_direction(dim);
    check_expression(dim, entry_name(subsection, "Region"), region, 1);
    require_entry(speed.empty() != hydrograph.empty(),
                  { subsection, speed.empty() ? "Speed" : "Hydrograph", speed.empty() ? "" : hydrograph },
                  speed.empty() ? "write how fast it enters, such as 1.5, or name a file as \"Hydrograph\"."
                                : "\"Speed\" = " + speed + " tells the same. Remove one of the two.");
    require_entry(!hydrograph.empty() || hydrograph_of == "speed",
                  { subsection, "Hydrograph of", hydrograph_of },
                  "this entry has no effect, as there is no \"Hydrograph\". Remove it.");
    require_entry(end_time == -1 || end_time > 0,
                  { subsection, "End time", end_time },
                  "write a time above 0, in s, or -1 for an inflow that lasts as long as the run.");
    Hydrograph{ *this };
  }


  void InflowParameters::check_section(const GridParameters &grid,
                                       const unsigned int dim,
                                       const unsigned int points_per_cell) const
  {
    if (is_at_wall())
      return;
    require_entry(!is_water(),
                  { subsection, "Section", section },
                  "water enters at a face of the box, which holds it from behind. Remove the entry.");
    const unsigned int axis = face_number(dim) / 2;
    const double x = place(grid), lower = grid.lower_corner[axis], upper = grid.upper_corner[axis];
    const double spacing = grid.cell_size / points_per_cell;
    require_entry(x > lower - 1e-9 * spacing && x < upper + 1e-9 * spacing,
                  { subsection, "Section", section },
                  std::string("write a coordinate along ") + "xyz"[axis] + " in the box, from " + number_text(lower) +
                      " to " + number_text(upper) + " m.");
    const double layers = (x - lower) / spacing;
    require_entry(std::abs(layers - std::round(layers)) < 1e-6,
                  { subsection, "Section", section },
                  "points stand " + number_text(spacing) +
                      " m apart, and the section has to lie between two of them. "
                      "Write " +
                      number_text(lower + std::round(layers) * spacing) + ".");
  }


  Hydrograph::Hydrograph(const InflowParameters &parameters)
      : where(entry_name(parameters.subsection, "Speed") + " = " + parameters.speed)
  {
    if (parameters.hydrograph.empty())
      {
        expression = parse_expression<1>(entry_name(parameters.subsection, "Speed"), parameters.speed, 1);
        return;
      }
    const std::string quantity = parameters.tells_discharge() ? "discharge (m^3/s)" : "speed (m/s)";
    for (const auto &numbers : read_number_table(
             parameters.hydrograph, entry_name(parameters.subsection, "Hydrograph"), { "time (s)", quantity }))
      {
        require_entry(numbers[1] >= 0,
                      { parameters.subsection, "Hydrograph", parameters.hydrograph },
                      "at " + number_text(numbers[0]) + " s it is " + number_text(numbers[1]) +
                          ", and nothing flows out of a section. Write 0 or more.");
        record.add(numbers[0], numbers[1]);
      }
  }


} // namespace scree

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/parameters.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <fstream>
#include <set>
#include <sstream>

namespace scree
{
  using namespace dealii;

  void BodyParameters::add_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection(name);
    seeding.add_parameters(prm);
    material.add_parameters(prm);
    initial_state.add_parameters(prm);
    prm.leave_subsection();
  }



  void BodyParameters::check(const unsigned int dim) const
  {
    seeding.check(name, dim);
    material.check(name);
    initial_state.check(name);
  }



  double BodyParameters::bulk_density() const
  {
    const double porosity =
      seeding.initial_porosity < 0 ? make_material<2>(material)->initial_porosity() : seeding.initial_porosity;
    return seeding.grain_density * (1. - porosity);
  }



  namespace
  {
    std::string text_of_file(const std::string &file)
    {
      std::ifstream     in(file);
      std::stringstream text;
      text << in.rdbuf();
      if (!in)
        throw InputError("The case file '" + file + "' cannot be read. Check the path; cases are in the folder prm.");
      return text.str();
    }
  } // namespace



  Parameters::Parameters()
  {
    bodies.resize(1);
    bodies[0].name = "Soil";
    declare(handler);
  }



  Parameters::Parameters(const std::string &file)
    : original_text(text_of_file(file))
  {
    try
      {
        // The names of the bodies are names of subsections: read them first.
        ParameterHandler names;
        names.add_parameter("Bodies", body_names, "", Patterns::List(Patterns::Anything(), 1));
        std::istringstream first(original_text);
        const bool         skip_undefined = true;
        names.parse_input(first, file, "", skip_undefined);
        for (const auto &name : body_names)
          {
            bodies.emplace_back();
            bodies.back().name = name;
          }

        declare(handler);
        std::istringstream second(original_text);
        handler.parse_input(second, file);
        check();
      }
    catch (const ExceptionBase &error)
      {
        std::ostringstream message;
        error.print_info(message);
        throw InputError("File '" + file + "': " + Utilities::trim(message.str()));
      }
  }



  void Parameters::declare(ParameterHandler &prm)
  {
    prm.add_parameter("Dimension", dimension, "2 (plane strain) or 3.", Patterns::Integer(2, 3));
    prm.add_parameter("End time", end_time, "When the run ends, s.", Patterns::Double(1e-12));
    prm.add_parameter("Output directory", output_directory, "The run folder; made if it is not there.", Patterns::Anything());
    prm.add_parameter("Gravity", gravity, "Acceleration of gravity, m/s^2, one number an axis.", Patterns::List(Patterns::Double(), 2, 3));
    prm.add_parameter("Bodies",
                      body_names,
                      "Names of the bodies of soil, separated by commas; each has a subsection of its name.",
                      Patterns::List(Patterns::Anything(), 1));
    body_force.add_parameters(prm);
    grid.add_parameters(prm);
    time_step.add_parameters(prm);
    transfer.add_parameters(prm);
    stabilisation.add_parameters(prm);
    for (auto &body : bodies)
      body.add_parameters(prm);
    boundaries.add_parameters(prm);
    settling.add_parameters(prm);
    output.add_parameters(prm);
  }



  void Parameters::check() const
  {
    AssertThrow(gravity.size() == dimension,
                ExcMessage("'Gravity' has " + std::to_string(gravity.size()) + " numbers, but Dimension is " +
                           std::to_string(dimension) + ". Write " + std::to_string(dimension) +
                           " numbers, separated by commas."));
    static const std::set<std::string> taken{
      "Mesh", "Time step", "Transfer", "Stabilisation", "Boundaries", "Settling", "Output", "Water"};
    std::set<std::string> seen;
    for (const auto &body : bodies)
      AssertThrow(!body.name.empty() && taken.count(body.name) == 0 && seen.insert(body.name).second,
                  ExcMessage("'Bodies' names '" + body.name +
                             "', which is empty, named twice, or the name of another subsection. Choose another name."));
    grid.check(dimension);
    boundaries.check();
    body_force.check(dimension);
    settling.check(dimension);
    for (const auto &body : bodies)
      body.check(dimension);
  }



  const std::string &Parameters::original() const
  {
    return original_text;
  }



  void Parameters::print(std::ostream &out)
  {
    handler.print_parameters(out, ParameterHandler::Text);
  }
} // namespace scree

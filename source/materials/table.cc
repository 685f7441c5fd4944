// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/input/case_entries.h>
#include <scree/materials/table.h>


using namespace dealii;

namespace scree
{
  namespace
  {
    /// Made at the first call, whichever source file registers first.
    std::vector<RegisteredLaw> &laws()
    {
      static std::vector<RegisteredLaw> all;
      return all;
    }
  } // namespace


  const std::vector<RegisteredLaw> &registered_laws()
  {
    return laws();
  }


  RegisterLaw::RegisterLaw(RegisteredLaw law)
  {
    const auto place = std::find_if(
        laws().begin(), laws().end(), [&](const auto &other) { return lower_case(other.name) > lower_case(law.name); });
    laws().insert(place, std::move(law));
  }


  namespace
  {
    const char rigid_name[] = "rigid";

    const RegisteredLaw &registered(const std::string &name)
    {
      const auto &laws = registered_laws();
      const auto found = std::find_if(laws.begin(), laws.end(), [&](const auto &law) { return law.name == name; });
      AssertThrow(found != laws.end(), ExcMessage("There is no material \"" + name + "\"."));
      return *found;
    }
  } // namespace


  MaterialParameters::MaterialParameters(const MaterialParameters &other)
      : law(other.law)
  {
    for (const auto &[name, entries] : other.all)
      all[name] = registered(name).copy(*entries);
  }


  void MaterialParameters::add_parameters(ParameterHandler &prm)
  {
    prm.add_parameter("Material",
                      law,
                      "Constitutive law; its entries are in the subsection of its name. rigid: the body does not move "
                      "and has no stress; water flows through its pores.",
                      Patterns::Selection(boost::algorithm::join(names_of(registered_laws()), "|")));
    for (const RegisteredLaw &one : registered_laws())
      if (!one.subsection.empty())
        {
          prm.enter_subsection(one.subsection);
          all.at(one.name)->add_parameters(prm);
          prm.leave_subsection();
        }
  }


  const LawEntries &MaterialParameters::chosen() const
  {
    return *all.at(registered(law).name);
  }


  std::string MaterialParameters::path(const std::string &subsection) const
  {
    return subsection_path(subsection, registered(law).subsection);
  }


  void MaterialParameters::complete(const std::string &subsection, const bool in_water)
  {
    all.at(registered(law).name)->complete(path(subsection), in_water);
  }


  bool MaterialParameters::divide_strength(const double factor)
  {
    return all.at(registered(law).name)->divide_strength(factor);
  }


  bool MaterialParameters::is_rigid() const
  {
    return law == rigid_name;
  }


  template <int dim>
  std::unique_ptr<Material<dim>> make_material(const MaterialParameters &parameters)
  {
    if constexpr (dim == 2)
      return registered(parameters.law).make_2d(parameters.chosen());
    else
      return registered(parameters.law).make_3d(parameters.chosen());
  }


  template std::unique_ptr<Material<2>> make_material<2>(const MaterialParameters &);
  template std::unique_ptr<Material<3>> make_material<3>(const MaterialParameters &);


  template <int dim>
  PlaceVariables<dim>::PlaceVariables(const std::vector<PlaceVariable> &variables,
                                      const std::string &subsection,
                                      const Point<2> &origin)
  {
    for (const PlaceVariable &variable : variables)
      {
        const std::string entry = entry_name(subsection, variable.entry), &text = variable.of_place;
        require_entry(text != " ",
                      { subsection, variable.entry, "" },
                      "write a number in " + variable.unit + ", an expression or the name of a file.");
        fields.push_back({ variable, entry + " = " + (text.empty() ? number_text(variable.constant) : text), nullptr });
        if (!text.empty())
          fields.back().field =
              std::make_shared<const PlaceField<dim>>(entry,
                                                      text,
                                                      variable.entry + " (" + variable.unit + ')',
                                                      variable.unit == "Pa" ? "5e3 + 2e3*depth" : "30 - 0.5*depth",
                                                      origin);
      }
  }


  template <int dim>
  bool PlaceVariables<dim>::has_depth() const
  {
    return std::any_of(fields.begin(), fields.end(), [](const Field &field) { return uses_depth(field.of_place); });
  }


  template <int dim>
  void PlaceVariables<dim>::set(const Point<dim> &place, const double depth, double *internal_variables) const
  {
    for (const Field &field : fields)
      {
        const double value               = field.value(place, depth);
        internal_variables[field.number] = field.stored ? field.stored(value) : value;
      }
    for (const Field &field : fields)
      if (const std::string fault = field.fault(internal_variables); !fault.empty())
        throw ValueError(field.name + ": the value at " + number_text(place) + " m is " +
                         number_text(field.value(place, depth)) + ". " + fault);
  }

  template class PlaceVariables<2>;
  template class PlaceVariables<3>;
} // namespace scree

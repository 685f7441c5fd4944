// SPDX-License-Identifier: LGPL-2.1-or-later

#include <scree/input/input_error.h>
#include <scree/materials/table.h>

#include <algorithm>

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


  MaterialParameters::MaterialParameters()
  {
    for (const RegisteredLaw &one : registered_laws())
      all[one.name] = one.copy(*one.entries);
  }


  MaterialParameters::MaterialParameters(const MaterialParameters &other)
      : law(other.law)
  {
    for (const auto &[name, entries] : other.all)
      all[name] = registered(name).copy(*entries);
  }


  MaterialParameters &MaterialParameters::operator=(MaterialParameters other)
  {
    std::swap(law, other.law);
    std::swap(all, other.all);
    return *this;
  }


  void MaterialParameters::add_parameters(ParameterHandler &prm)
  {
    std::string names;
    for (const RegisteredLaw &one : registered_laws())
      names += (names.empty() ? "" : "|") + one.name;
    prm.add_parameter("Material",
                      law,
                      "Constitutive law; its entries are in the subsection of its name. rigid: the body does not move "
                      "and has no stress; water flows through its pores.",
                      Patterns::Selection(names));
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


  void MaterialParameters::check(const std::string &subsection) const
  {
    chosen().check(path(subsection));
  }


  bool MaterialParameters::divide_strength(const double factor)
  {
    return all.at(registered(law).name)->divide_strength(factor);
  }


  bool MaterialParameters::is_rigid() const
  {
    return law == rigid_name;
  }


  void MaterialParameters::throw_too_stiff(const std::string &subsection, const std::string &remedy) const
  {
    const LawEntry entry = chosen().stiffest();
    throw EntryError(entry_message({ path(subsection), entry.name, number_text(entry.value) }, remedy));
  }


  std::string MaterialParameters::modulus_text(const std::string &subsection) const
  {
    const LawEntry modulus = chosen().modulus();
    return entry_name(path(subsection), modulus.name) + " = " + number_text(modulus.value);
  }


  template <int dim>
  std::unique_ptr<Material<dim>> make_material(const MaterialParameters &parameters)
  {
    if constexpr (dim == 2)
      return registered(parameters.law).make_2d(parameters.chosen());
    else
      return registered(parameters.law).make_3d(parameters.chosen());
  }


  template <int dim>
  PlaceVariableValues<dim>::PlaceVariableValues(const PlaceVariable &variable, const std::string &subsection)
      : variable(variable)
      , name(entry_name(subsection, variable.entry) + " = " + variable.expression)
      , expression(
            parse_expression<dim>(entry_name(subsection, variable.entry), variable.expression, 1, false, "5e3 - 2e3*y"))
  {
  }


  template <int dim>
  void PlaceVariableValues<dim>::set(const Point<dim> &place, const double depth, double *internal_variables) const
  {
    const double value = expression->value(place) + variable.gradient * depth;
    const auto fault   = [&](const std::string &remedy) {
      return ValueError(name + ": the value at " + number_text(place) + " m is " + number_text(value) + ". " + remedy);
    };
    if (!(value > 0))
      throw fault("Write an expression that is positive in the whole body.");
    if (value > variable.largest)
      throw fault("Beyond " + number_text(variable.largest) + ", " + variable.remedy);
    internal_variables[variable.number] = value;
  }

  template class PlaceVariableValues<2>;
  template class PlaceVariableValues<3>;
  template std::unique_ptr<Material<2>> make_material<2>(const MaterialParameters &);
  template std::unique_ptr<Material<3>> make_material<3>(const MaterialParameters &);
} // namespace scree

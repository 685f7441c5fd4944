// SPDX-License-Identifier: LGPL-2.1-or-later

#include <scree/input/input_error.h>
#include <scree/materials/table.h>

#include <algorithm>

using namespace dealii;

namespace scree
{
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
      all[one.name] = one.entries->clone();
  }


  MaterialParameters::MaterialParameters(const MaterialParameters &other)
      : law(other.law)
  {
    for (const auto &[name, entries] : other.all)
      all[name] = entries->clone();
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
      return parameters.chosen().make_2d();
    else
      return parameters.chosen().make_3d();
  }


  template std::unique_ptr<Material<2>> make_material<2>(const MaterialParameters &);
  template std::unique_ptr<Material<3>> make_material<3>(const MaterialParameters &);
} // namespace scree

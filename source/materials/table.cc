// SPDX-License-Identifier: LGPL-2.1-or-later
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


  template class PlaceVariableValues<2>;
  template class PlaceVariableValues<3>;
  template std::unique_ptr<Material<2>> make_material<2>(const MaterialParameters &);
  template std::unique_ptr<Material<3>> make_material<3>(const MaterialParameters &);
} // namespace scree

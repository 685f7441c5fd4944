// SPDX-License-Identifier: LGPL-2.1-or-later

#include <scree/input/input_error.h>
#include <scree/materials/batch_material.h>
#include <scree/materials/laws/mohr_coulomb_return.h>
#include <scree/materials/laws/nor_sand_return.h>
#include <scree/materials/principal_batch_material.h>
#include <scree/materials/laws/rigid.h>
#include <scree/materials/table.h>

using namespace dealii;

namespace scree
{
  namespace
  {
    const char linear_elastic_name[] = "linear elastic";
    const char mohr_coulomb_name[]   = "Mohr-Coulomb";
    const char nor_sand_name[]       = "Nor-Sand";
    const char rigid_name[]          = "rigid";

    const char linear_elastic_subsection[] = "Linear elastic";
  } // namespace


  void MaterialParameters::add_parameters(ParameterHandler &prm)
  {
    prm.add_parameter(
        "Material",
        law,
        "Constitutive law; its entries are in the subsection of its name. rigid: the body does not move, whatever acts "
        "on it, and costs no stress; water flows through its pores.",
        Patterns::Selection(std::string(linear_elastic_name) + "|" + mohr_coulomb_name + "|" + nor_sand_name + "|" +
                            rigid_name));
    prm.enter_subsection(linear_elastic_subsection);
    linear_elastic.add_parameters(prm);
    prm.leave_subsection();
    prm.enter_subsection(mohr_coulomb_name);
    mohr_coulomb.add_parameters(prm);
    prm.leave_subsection();
    prm.enter_subsection(nor_sand_name);
    nor_sand.add_parameters(prm);
    prm.leave_subsection();
  }


  void MaterialParameters::check(const std::string &subsection) const
  {
    switch (law_kind())
      {
      case LawKind::linear_elastic:
        linear_elastic.check(subsection_path(subsection, linear_elastic_subsection));
        break;
      case LawKind::mohr_coulomb:
        mohr_coulomb.check(subsection_path(subsection, mohr_coulomb_name));
        break;
      case LawKind::nor_sand:
        nor_sand.check(subsection_path(subsection, nor_sand_name));
        break;
      case LawKind::rigid:
        break;
      }
  }


  LawKind MaterialParameters::law_kind() const
  {
    if (law == linear_elastic_name)
      return LawKind::linear_elastic;
    if (law == mohr_coulomb_name)
      return LawKind::mohr_coulomb;
    if (law == rigid_name)
      return LawKind::rigid;
    AssertThrow(law == nor_sand_name, ExcMessage("There is no material \"" + law + "\"."));
    return LawKind::nor_sand;
  }


  void MaterialParameters::throw_too_stiff(const std::string &subsection, const std::string &remedy) const
  {
    const auto error = [&](const std::string &law_subsection, const std::string &entry, const double value) {
      return EntryError(entry_message(subsection_path(subsection, law_subsection), entry, number_text(value), remedy));
    };
    const std::string modulus = "Young's modulus";
    if (law_kind() == LawKind::linear_elastic)
      throw error(linear_elastic_subsection, modulus, linear_elastic.young_modulus);
    if (law_kind() == LawKind::mohr_coulomb)
      throw error(mohr_coulomb_name, modulus, mohr_coulomb.young_modulus);
    constexpr double pressure = 1e5; // Pa, of a few metres of soil
    if (nor_sand.shear_modulus > pressure / nor_sand.swelling_index)
      throw error(nor_sand_name, "Shear modulus", nor_sand.shear_modulus);
    throw error(nor_sand_name, "Swelling index", nor_sand.swelling_index);
  }


  std::string MaterialParameters::modulus_text(const std::string &subsection) const
  {
    const LawKind law      = law_kind();
    const bool is_nor_sand = law == LawKind::nor_sand, is_mohr_coulomb = law == LawKind::mohr_coulomb;
    const std::string part = is_nor_sand       ? nor_sand_name
                             : is_mohr_coulomb ? mohr_coulomb_name
                                               : linear_elastic_subsection;
    return entry_name(subsection_path(subsection, part), is_nor_sand ? "Shear modulus" : "Young's modulus") + " = " +
           number_text(is_nor_sand       ? nor_sand.shear_modulus
                       : is_mohr_coulomb ? mohr_coulomb.young_modulus
                                         : linear_elastic.young_modulus);
  }


  template <int dim>
  std::unique_ptr<Material<dim>> make_material(const MaterialParameters &parameters)
  {
    switch (parameters.law_kind())
      {
      case LawKind::linear_elastic:
        return std::make_unique<BatchMaterial<dim, LinearElastic>>(LinearElastic(parameters.linear_elastic));
      case LawKind::mohr_coulomb:
        return std::make_unique<PrincipalBatchMaterial<dim, MohrCoulomb>>(MohrCoulomb(parameters.mohr_coulomb));
      case LawKind::rigid:
        return std::make_unique<Rigid<dim>>();
      default:
        return std::make_unique<BatchMaterial<dim, NorSand>>(NorSand(parameters.nor_sand));
      }
  }


  template std::unique_ptr<Material<2>> make_material<2>(const MaterialParameters &);
  template std::unique_ptr<Material<3>> make_material<3>(const MaterialParameters &);
} // namespace scree

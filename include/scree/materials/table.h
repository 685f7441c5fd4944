// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef scree_materials_table_h
#define scree_materials_table_h

#include <scree/materials/laws/linear_elastic.h>
#include <scree/materials/material.h>
#include <scree/materials/laws/mohr_coulomb.h>
#include <scree/materials/laws/nor_sand.h>

#include <memory>

namespace scree
{
  /// The laws that entry "Material" knows.
  enum class LawKind
  {
    linear_elastic,
    mohr_coulomb,
    nor_sand,
    rigid
  };

  /// Entry "Material" and the subsections of all laws; those of laws that are not chosen are read but not used.
  struct MaterialParameters
  {
    std::string law = "Nor-Sand";
    LinearElasticParameters linear_elastic;
    MohrCoulombParameters mohr_coulomb;
    NorSandParameters nor_sand;

    /// Declare entry and subsections inside whatever subsection `prm` has entered.
    void add_parameters(dealii::ParameterHandler &prm);

    /// Check the chosen law; `subsection` is the path of the enclosing subsection for messages, e.g. "Soil".
    void check(const std::string &subsection) const;

    /// Throws dealii::ExcMessage if there is no law of that name.
    LawKind law_kind() const;

    /// Entry and value of the modulus that limits elastic strains, in the body's `subsection`, as messages begin.
    std::string modulus_text(const std::string &subsection) const;

    /// Throws EntryError that names the entry of the law, in the body's `subsection`, which makes waves so fast that a
    /// run is too long, and the `remedy`.
    [[noreturn]] void throw_too_stiff(const std::string &subsection, const std::string &remedy) const;
  };

  /// The law `parameters.law` names. Throws dealii::ExcMessage if there is none of that name.
  template <int dim>
  std::unique_ptr<Material<dim>> make_material(const MaterialParameters &parameters);
} // namespace scree

#endif

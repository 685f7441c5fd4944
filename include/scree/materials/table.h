// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_materials_table_h
#define scree_materials_table_h

#include <scree/geometry/place_field.h>
#include <scree/input/input_error.h>
#include <scree/materials/law_entries.h>

#include <map>
#include <typeinfo>

namespace scree
{
  /// Entry "Material" and the subsections of all laws; those of laws that are not chosen are read but not used.
  class MaterialParameters
  {
  public:
    std::string law = "Nor-Sand"; ///< entry Material: name of the chosen law

    /// With the default values of all laws.
    MaterialParameters()
    {
      for (const RegisteredLaw &one : registered_laws())
        all[one.name] = one.copy(*one.entries);
    }
    MaterialParameters(const MaterialParameters &other); ///< copies the entries of all laws
    MaterialParameters(MaterialParameters &&) = default; ///< takes the entries of all laws

    /// Copies or takes the entries of all laws.
    MaterialParameters &operator=(MaterialParameters other)
    {
      std::swap(law, other.law);
      std::swap(all, other.all);
      return *this;
    }

    /// Declare entry and subsections inside whatever subsection `prm` has entered.
    void add_parameters(dealii::ParameterHandler &prm);

    /// Completes the chosen law, see LawEntries; `subsection` is that of check().
    void complete(const std::string &subsection, const bool in_water);

    /// Check the chosen law; `subsection` is the path of the enclosing subsection for messages, e.g. "Soil".
    void check(const std::string &subsection) const
    {
      chosen().check(path(subsection));
    }

    /// Divides the strength of the chosen law by a factor, for a safety of slopes. Returns whether it has any.
    bool divide_strength(const double factor);

    /// Whether the body does not move: it has no law.
    bool is_rigid() const;

    /// The entries of the chosen law. Throws dealii::ExcMessage if there is no law of that name.
    const LawEntries &chosen() const;

    /// The entries of any law by their struct, such as MohrCoulombParameters.
    template <typename Entries>
    Entries &of() const
    {
      for (auto &[name, pointer] : all)
        if (LawEntries &entries = *pointer; typeid(entries) == typeid(Entries))
          return static_cast<Entries &>(entries);
      throw dealii::ExcMessage("This law is not registered.");
    }

    /// The subsection of the chosen law, in the body's `subsection`.
    std::string path(const std::string &subsection) const;

    /// Entry and value of the modulus that limits elastic strains, in the body's `subsection`, as messages begin.
    std::string modulus_text(const std::string &subsection) const
    {
      const LawEntry modulus = chosen().modulus();
      return entry_name(path(subsection), modulus.name) + " = " + number_text(modulus.value);
    }

    /// Throws EntryError that names the entry of the law, in the body's `subsection`, which makes waves so fast that a
    /// run is too long, and the `remedy`.
    [[noreturn]] void throw_too_stiff(const std::string &subsection, const std::string &remedy) const
    {
      const LawEntry entry = chosen().stiffest();
      throw EntryError(entry_message({ path(subsection), entry.name, number_text(entry.value) }, remedy));
    }

  private:
    std::map<std::string, std::unique_ptr<LawEntries>> all; // by the laws' names
  };

  /// The law that `parameters.law` names. Throws dealii::ExcMessage if there is none of that name.
  template <int dim>
  std::unique_ptr<Material<dim>> make_material(const MaterialParameters &parameters);


  /// Gives points the variables of their law that depend on the place, see PlaceVariable.
  template <int dim>
  class PlaceVariables
  {
  public:
    /// Reads expressions and files. Throws EntryError, which names the entry in this subsection, if one does not read.
    /// @param origin see PlaceField
    PlaceVariables(const std::vector<PlaceVariable> &variables,
                   const std::string &subsection,
                   const dealii::Point<2> &origin = {});

    /// Whether they depend on the depth.
    bool has_depth() const;

    /// Sets the variables at a place. Throws ValueError if the law cannot follow them.
    /// @param depth of soil above the place, m
    void set(const dealii::Point<dim> &place, const double depth, double *internal_variables) const;

  private:
    struct Field : PlaceVariable
    {
      std::string name;                             // of the entry, and its text
      std::shared_ptr<const PlaceField<dim>> field; // null: constant

      double value(const dealii::Point<dim> &place, const double depth) const
      {
        return field ? field->value(place, depth) : this->constant;
      }
    };

    std::vector<Field> fields;
  };
} // namespace scree

#endif

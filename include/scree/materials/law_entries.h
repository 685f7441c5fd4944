// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_materials_law_entries_h
#define scree_materials_law_entries_h

#include <scree/materials/hencky_material.h>

#include <deal.II/base/parameter_handler.h>

#include <memory>
#include <optional>

namespace scree
{
  /// An entry of a law and its value.
  struct LawEntry
  {
    std::string name; ///< name of the entry
    double value;     ///< value in the unit of the entry
  };


  /// Base class of the entries of a law for one body, with what a law may leave out.
  struct LawEntries
  {
    virtual ~LawEntries() = default;

    /// Declares the entries inside the subsection of the law.
    virtual void add_parameters(dealii::ParameterHandler &prm) = 0;

    /// Finds the values of entries that are auto, before check(). Throws EntryError if an entry cannot be read.
    virtual void complete(const std::string & /* subsection */, const bool /* in_water */)
    {
    }

    /// Throws EntryError if a combination is impossible; `subsection` is the path of the law's.
    virtual void check(const std::string &subsection) const = 0;

    /// The modulus that limits elastic strains, Pa.
    virtual LawEntry modulus() const = 0;

    /// The entry that makes waves fast.
    virtual LawEntry stiffest() const
    {
      return modulus();
    }

    /// Divides the strength by a factor, for a safety of slopes. Returns whether the law has any.
    virtual bool divide_strength(const double)
    {
      return false;
    }

    /// Sine of the friction angle; nothing if the law has no angle.
    virtual std::optional<double> sine_of_friction() const
    {
      return {};
    }
  };


  /// A law that entry "Material" can name.
  struct RegisteredLaw
  {
    std::string name;                                                   ///< value of the entry
    std::string subsection;                                             ///< of its entries; empty: it has none
    std::shared_ptr<const LawEntries> entries;                          ///< with default values
    std::unique_ptr<LawEntries> (*copy)(const LawEntries &entries);     ///< copies entries
    std::unique_ptr<Material<2>> (*make_2d)(const LawEntries &entries); ///< the law of the entries, for plane strain
    std::unique_ptr<Material<3>> (*make_3d)(const LawEntries &entries); ///< the same in three dimensions
  };

  /// All laws, in the order of their names.
  const std::vector<RegisteredLaw> &registered_laws();

  /// Adds a law; its source file has one as a static constant.
  class RegisterLaw
  {
  public:
    /// See RegisteredLaw.
    explicit RegisterLaw(RegisteredLaw law);

    /// A law that is made from entries `Entries`.
    template <typename Law, typename Entries>
    static RegisterLaw of(const std::string &name, const std::string &subsection)
    {
      return RegisterLaw({ name,
                           subsection,
                           std::make_shared<const Entries>(),
                           copy<Entries>,
                           make<2, Law, Entries>,
                           make<3, Law, Entries> });
    }

    /// For RegisteredLaw::copy.
    template <typename Entries>
    static std::unique_ptr<LawEntries> copy(const LawEntries &entries)
    {
      return std::make_unique<Entries>(static_cast<const Entries &>(entries));
    }

    /// For RegisteredLaw::make_2d and make_3d.
    template <int dim, typename Law, typename Entries>
    static std::unique_ptr<Material<dim>> make(const LawEntries &entries)
    {
      return std::make_unique<HenckyMaterial<dim, Law>>(Law(static_cast<const Entries &>(entries)));
    }
  };
} // namespace scree

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_materials_law_entries_h
#define scree_materials_law_entries_h

#include <scree/materials/material.h>

#include <deal.II/base/parameter_handler.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace scree
{
  /// An entry of a law and its value.
  struct LawEntry
  {
    std::string name; ///< name of the entry
    double value;     ///< value in the unit of the entry
  };

  /// The entries of a law for one body, and the law that they make. Each law registers its own by RegisterLaw.
  class LawEntries
  {
  public:
    virtual ~LawEntries() = default;

    /// A copy with the same values.
    virtual std::unique_ptr<LawEntries> clone() const = 0;

    /// Declares the entries inside the subsection of the law.
    virtual void add_parameters(dealii::ParameterHandler &prm) = 0;

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

    /// Makes the law with these values, for plane strain.
    virtual std::unique_ptr<Material<2>> make_2d() const = 0;

    /// Makes the law with these values, in three dimensions.
    virtual std::unique_ptr<Material<3>> make_3d() const = 0;

    /// Sine of the friction angle; nothing if the law has no angle.
    virtual std::optional<double> sine_of_friction() const
    {
      return {};
    }
  };

  /// Those that are a struct `Parameters` with the members of a law's struct (see MohrCoulombParameters).
  template <typename Parameters>
  class EntriesWith : public LawEntries
  {
  public:
    Parameters parameters; ///< entries of the law

    void add_parameters(dealii::ParameterHandler &prm) override
    {
      parameters.add_parameters(prm);
    }
    void check(const std::string &subsection) const override
    {
      parameters.check(subsection);
    }
    LawEntry modulus() const override
    {
      return parameters.modulus();
    }
    LawEntry stiffest() const override
    {
      return stiffest_of(parameters, 0);
    }
    std::optional<double> sine_of_friction() const override
    {
      return sine_of(parameters, 0);
    }
    bool divide_strength(const double factor) override
    {
      return divide_strength_of(parameters, factor, 0);
    }

  private:
    /// A struct without a member stiffest() has modulus().
    template <typename Law>
    static auto stiffest_of(const Law &law, int) -> decltype(law.stiffest())
    {
      return law.stiffest();
    }
    template <typename Law>
    static LawEntry stiffest_of(const Law &law, long)
    {
      return law.modulus();
    }

    /// A struct without a member sine() has no angle.
    template <typename Law>
    static auto sine_of(const Law &law, int) -> decltype(std::optional<double>(law.sine()))
    {
      return law.sine();
    }
    template <typename Law>
    static std::optional<double> sine_of(const Law &, long)
    {
      return {};
    }

    /// A struct without a member divide_strength() has no strength.
    template <typename Law>
    static auto divide_strength_of(Law &law, const double factor, int) -> decltype(law.divide_strength(factor), true)
    {
      law.divide_strength(factor);
      return true;
    }
    template <typename Law>
    static bool divide_strength_of(Law &, const double, long)
    {
      return false;
    }
  };

  /// Those of a law that Points<dim, Law> brings to several points at a time.
  template <typename Parameters, template <int, typename> class Points, typename Law>
  class EntriesOf : public EntriesWith<Parameters>
  {
  public:
    std::unique_ptr<LawEntries> clone() const override
    {
      return std::make_unique<EntriesOf>(*this);
    }
    std::unique_ptr<Material<2>> make_2d() const override
    {
      return std::make_unique<Points<2, Law>>(Law(this->parameters));
    }
    std::unique_ptr<Material<3>> make_3d() const override
    {
      return std::make_unique<Points<3, Law>>(Law(this->parameters));
    }
  };

  /// A law that entry "Material" can name.
  struct RegisteredLaw
  {
    std::string name;                    ///< value of the entry
    std::string subsection;              ///< of its entries; empty: it has none
    std::unique_ptr<LawEntries> entries; ///< with default values
  };

  /// All laws, in the order of their names.
  const std::vector<RegisteredLaw> &registered_laws();

  /// Adds a law; its source file has one as a static constant.
  class RegisterLaw
  {
  public:
    /// @param name value of entry Material
    /// @param subsection of the entries; empty: there is none
    /// @param entries with default values
    RegisterLaw(const std::string &name, const std::string &subsection, std::unique_ptr<LawEntries> entries);
  };
} // namespace scree

#endif

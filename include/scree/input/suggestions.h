// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_input_suggestions_h
#define scree_input_suggestions_h

#include <deal.II/base/parameter_handler.h>

#include <string>
#include <vector>

namespace scree
{
  /// The entries and subsections that a ParameterHandler declares, and which of them a misspelt name may mean.
  /// A `path` is that of the subsection in which a name stands, such as Soil/Initial state; empty at the top of the
  /// file.
  class DeclaredNames
  {
  public:
    /// Of an entry or a subsection; the latter has neither pattern nor documentation.
    struct Name
    {
      std::string path,  ///< of the subsection in which it stands
          name,          ///< of entry or subsection
          pattern,       ///< deal.II's description of allowed values
          documentation; ///< text of the manual
    };

    /// Collects the names that `prm` declares.
    explicit DeclaredNames(const dealii::ParameterHandler &prm);

    /// The entry, or nullptr if there is none.
    const Name *entry(const std::string &path, const std::string &name) const;

    /// Whether `path` has a subsection of this name.
    bool has_subsection(const std::string &path, const std::string &name) const;

    /// `Did you mean "Cell size"?`, or where an entry of that name stands, or nothing if no name is close.
    std::string suggest_entry(const std::string &path, const std::string &written) const;

    /// The same for a subsection.
    std::string suggest_subsection(const std::string &path, const std::string &written) const;

    /// The paths of all subsections, in the order of their names.
    std::vector<std::string> subsection_paths() const;

  private:
    std::vector<Name> entries, subsections;
  };

  /// The names closest to `written`, all of them equally close; none if no name is close.
  std::vector<std::string> nearest(const std::vector<std::string> &names, const std::string &written);

  /// What to write instead of a `value` that does not match the pattern of the entry, and what the entry means.
  std::string value_remedy(const DeclaredNames::Name &entry, const std::string &value);
} // namespace scree

#endif

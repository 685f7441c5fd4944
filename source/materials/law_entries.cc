// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/input/input_error.h>
#include <scree/materials/law_entries.h>

#include <algorithm>

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


  RegisterLaw::RegisterLaw(const std::string &name, const std::string &subsection, std::unique_ptr<LawEntries> entries)
  {
    const auto place = std::find_if(
        laws().begin(), laws().end(), [&](const auto &law) { return lower_case(law.name) > lower_case(name); });
    laws().insert(place, { name, subsection, std::move(entries) });
  }
} // namespace scree

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/boundary/body_forces.h>

#include <map>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// Made at the first call, whichever source file registers first.
    auto &kinds_of_body_force()
    {
      static std::map<std::string, std::unique_ptr<BodyForceEntries> (*)()> all;
      return all;
    }
  } // namespace


  void register_body_force(const std::string &name, std::unique_ptr<BodyForceEntries> (*make)())
  {
    kinds_of_body_force()[name] = make;
  }


  BodyForceParameters::BodyForceParameters()
  {
    for (const auto &[name, make] : kinds_of_body_force())
      kinds.push_back(make());
  }


  template std::vector<std::unique_ptr<BodyForce<2>>> BodyForceParameters::make() const;
  template std::vector<std::unique_ptr<BodyForce<3>>> BodyForceParameters::make() const;
} // namespace scree

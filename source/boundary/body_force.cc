// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/boundary/body_force.h>

#include <algorithm>
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


  void BodyForceEntries::check(const unsigned int dim) const
  {
    if (is_set() && dim == 2)
      make_2d();
    if (is_set() && dim == 3)
      make_3d();
  }


  BodyForceParameters::BodyForceParameters()
  {
    for (const auto &[name, make] : kinds_of_body_force())
      kinds.push_back(make());
  }


  void BodyForceParameters::add_parameters(ParameterHandler &prm)
  {
    for (const auto &kind : kinds)
      kind->add_parameters(prm);
  }


  void BodyForceParameters::check(const unsigned int dim) const
  {
    for (const auto &kind : kinds)
      kind->check(dim);
  }


  bool BodyForceParameters::is_set() const
  {
    return std::any_of(kinds.begin(), kinds.end(), [](const auto &kind) { return kind->is_set(); });
  }


  template <int dim>
  std::vector<std::unique_ptr<BodyForce<dim>>> BodyForceParameters::make() const
  {
    std::vector<std::unique_ptr<BodyForce<dim>>> forces;
    for (const auto &kind : kinds)
      if (kind->is_set())
        {
          if constexpr (dim == 2)
            forces.push_back(kind->make_2d());
          else
            forces.push_back(kind->make_3d());
        }
    return forces;
  }

  template std::vector<std::unique_ptr<BodyForce<2>>> BodyForceParameters::make() const;
  template std::vector<std::unique_ptr<BodyForce<3>>> BodyForceParameters::make() const;
} // namespace scree

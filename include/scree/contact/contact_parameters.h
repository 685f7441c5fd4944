// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_contact_contact_parameters_h
#define scree_contact_contact_parameters_h

#include <deal.II/base/parameter_handler.h>

#include <string>
#include <vector>

namespace scree
{
  /// Subsection Contact NAME: two bodies of soil that slide on each other and come apart, instead of sticking.
  struct ContactParameters
  {
    /// What the names of the subsections begin with.
    static const std::string prefix;

    std::string subsection;    ///< prefix and name
    std::string bodies;        ///< names, separated by a comma; empty: no contact
    double friction_angle = 0; ///< degrees

    /// @param subsection prefix and name
    explicit ContactParameters(const std::string &subsection)
        : subsection(subsection)
    {
    }

    /// Declares the subsection and its entries.
    void add_parameters(dealii::ParameterHandler &prm);

    /// Whether the entry `Bodies` is given.
    bool is_set() const
    {
      return !bodies.empty();
    }

    /// Tangent of the friction angle.
    double friction_coefficient() const;
  };

  /// Two groups of bodies that slide on each other.
  struct ContactPair
  {
    unsigned int first,                        ///< number of a group
        second;                                ///< number of another group, larger than the first one
    unsigned int rough;                        ///< that of the two whose bodies tell the friction
    std::vector<double> friction_coefficients; ///< by number of body; of those of the rough group
  };

  /// The groups of bodies that stick to each other.
  struct ContactGroups
  {
    std::vector<unsigned int> of_body; ///< numbers of groups, from 0 in the order of their first bodies
    unsigned int n = 1;                ///< number of groups
    std::vector<ContactPair> pairs;    ///< any two groups
  };

  /// What contacts need to know of a body.
  struct ContactBody
  {
    std::string name; ///< name of its subsection
    bool is_rigid;    ///< whether it keeps its place
  };

  /// Sorts bodies into groups. Throws EntryError at contacts that do not fit the bodies or each other.
  ContactGroups contact_groups(const std::vector<ContactParameters> &contacts, const std::vector<ContactBody> &bodies);
} // namespace scree

#endif

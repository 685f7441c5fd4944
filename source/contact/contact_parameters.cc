// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/input/input_error.h>
#include <scree/contact/contact_parameters.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace scree
{
  using namespace dealii;

  const std::string ContactParameters::prefix = "Contact ";


  void ContactParameters::add_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection(subsection);
    prm.add_parameter("Bodies",
                      bodies,
                      "Names of the two bodies that slide on each other and separate, with a comma between them. "
                      "Bodies without such a subsection stick to each other.",
                      Patterns::Anything());
    prm.add_parameter("Friction angle",
                      friction_angle,
                      "degrees; friction angle of the contact, from 0 (smooth) to below 90.",
                      Patterns::Double(0, 89.99));
    prm.leave_subsection();
  }


  double ContactParameters::friction_coefficient() const
  {
    return std::tan(friction_angle * numbers::PI / 180.);
  }


  namespace
  {
    using Numbers      = std::pair<unsigned int, unsigned int>; // of two bodies, the lower one first
    using GivenContact = std::pair<Numbers, const ContactParameters *>;

    void require_bodies(const ContactParameters &contact, const bool possible, const std::string &remedy)
    {
      require_entry(possible, { contact.subsection, "Bodies", contact.bodies }, remedy);
    }

    Numbers bodies_of(const ContactParameters &contact, const std::vector<ContactBody> &bodies)
    {
      const std::vector<std::string> names = Utilities::split_string_list(contact.bodies);
      require_bodies(contact, names.size() == 2, "write the names of two bodies, separated by a comma.");
      unsigned int number[2];
      for (unsigned int i = 0; i < 2; ++i)
        {
          const auto body =
              std::find_if(bodies.begin(), bodies.end(), [&](const ContactBody &one) { return one.name == names[i]; });
          require_bodies(contact,
                         body != bodies.end(),
                         "there is no body " + quoted(names[i]) + ". Entry \"Bodies\" at the top lists " +
                             (bodies.empty() ? "none" : boost::algorithm::join(names_of(bodies), ", ")) + '.');
          number[i] = body - bodies.begin();
        }
      require_bodies(contact,
                     number[0] != number[1],
                     "a body does not slide on itself. Write the names of two bodies, or divide it into two.");
      require_bodies(contact,
                     !(bodies[number[0]].is_rigid && bodies[number[1]].is_rigid),
                     "both are of \"Material = rigid\" and do not move. Remove the subsection.");
      return std::minmax(number[0], number[1]);
    }

    /// The groups that bodies form when all but these pairs stick to each other.
    template <typename Slide>
    std::vector<unsigned int> groups_of_bodies(const unsigned int n_bodies, const Slide &slide)
    {
      std::vector<unsigned int> label(n_bodies), group(n_bodies);
      std::iota(label.begin(), label.end(), 0);
      for (unsigned int j = 0; j < n_bodies; ++j)
        for (unsigned int i = 0; i < j; ++i)
          if (!slide({ i, j }))
            std::replace(label.begin(), label.end(), unsigned(label[j]), unsigned(label[i]));
      unsigned int n = 0;
      for (unsigned int i = 0; i < n_bodies; ++i)
        {
          const unsigned int first = std::find(label.begin(), label.end(), label[i]) - label.begin();
          group[i]                 = first < i ? group[first] : n++;
        }
      return group;
    }

    /// Two groups, any two bodies of which are given a contact.
    ContactPair pair_of_groups(const unsigned int first,
                               const unsigned int second,
                               const std::vector<unsigned int> &group_of_body,
                               const std::vector<GivenContact> &given)
    {
      const ContactParameters *last = nullptr;
      for (const unsigned int rough : { second, first })
        {
          ContactPair pair{ first, second, rough, std::vector<double>(group_of_body.size(), -1.) };
          bool is_one_each = true;
          for (const auto &[bodies, contact] : given)
            if (const unsigned int a = group_of_body[bodies.first], b = group_of_body[bodies.second];
                std::minmax(a, b) == std::minmax(first, second))
              {
                double &friction = pair.friction_coefficients[a == rough ? bodies.first : bodies.second];
                is_one_each      = is_one_each && (friction < 0. || friction == contact->friction_coefficient());
                friction         = contact->friction_coefficient();
                last             = contact;
              }
          if (is_one_each)
            return pair;
        }
      require_entry(false,
                    { last->subsection, "Friction angle", last->friction_angle },
                    "of two groups of bodies, each of which sticks together, one must tell the angle: the same for all "
                    "bodies of the other. Write such angles, or let more bodies slide.");
      return {};
    }
  } // namespace


  ContactGroups contact_groups(const std::vector<ContactParameters> &contacts, const std::vector<ContactBody> &bodies)
  {
    std::vector<GivenContact> given;
    for (const ContactParameters &contact : contacts)
      {
        require_entry(contact.is_set() || contact.friction_angle == 0.,
                      { contact.subsection, "Friction angle", contact.friction_angle },
                      "the contact has no bodies. Write their names in \"Bodies\".");
        if (!contact.is_set())
          continue;
        const Numbers pair = bodies_of(contact, bodies);
        for (const auto &[other, first] : given)
          require_bodies(contact,
                         other != pair,
                         "subsection " + first->subsection + " tells of these two already. Keep one of them.");
        given.emplace_back(pair, &contact);
      }
    const auto slide = [&](const Numbers &pair) {
      return std::any_of(given.begin(), given.end(), [&](const auto &one) { return one.first == pair; });
    };

    ContactGroups groups;
    groups.of_body = groups_of_bodies(bodies.size(), slide);
    groups.n       = groups.of_body.empty() ? 1 : *std::max_element(groups.of_body.begin(), groups.of_body.end()) + 1;
    for (const auto &[pair, contact] : given)
      {
        const auto [first, second] = pair;
        if (groups.of_body[first] == groups.of_body[second])
          for (unsigned int k = 0; k < bodies.size(); ++k)
            require_bodies(*contact,
                           k == first || slide(std::minmax(k, first)),
                           quoted(bodies[k].name) + " sticks to " + quoted(bodies[first].name) +
                               " and, by itself or by others, to " + quoted(bodies[second].name) +
                               ", so that these two cannot slide. Write a subsection Contact of " +
                               quoted(bodies[k].name) + " and one of them, too.");
      }
    for (unsigned int b = 0; b < groups.n; ++b)
      for (unsigned int a = 0; a < b; ++a)
        groups.pairs.push_back(pair_of_groups(a, b, groups.of_body, given));
    return groups;
  }
} // namespace scree

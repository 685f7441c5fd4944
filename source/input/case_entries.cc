// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/input/case_entries.h>

#include <deal.II/base/utilities.h>

#include <boost/property_tree/json_parser.hpp>

#include <sstream>

namespace scree
{
  using namespace dealii;

  void
  add_file_entry(ParameterHandler &prm, const std::string &entry, std::string &path, const std::string &documentation)
  {
    prm.add_parameter(entry,
                      path,
                      documentation + " The path is relative to the folder of the case file.",
                      Patterns::FileName(Patterns::FileName::input));
  }


  namespace
  {
    using Tree = boost::property_tree::ptree;

    constexpr char separator = '\t'; // neither names nor values have tabs

    void collect(const Tree &tree, const std::string &path, std::vector<CaseEntry> &entries)
    {
      const auto is_entry = [](const Tree &child) { return child.count("pattern_description") > 0; };
      for (const auto &[name, child] : tree)
        if (is_entry(child))
          entries.push_back({ path,
                              name,
                              child.get<std::string>("value"),
                              "",
                              child.get<std::string>("pattern_description"),
                              child.get<std::string>("documentation") });
      for (const auto &[name, child] : tree)
        if (!is_entry(child))
          collect(child, subsection_path(path, name), entries);
    }
  } // namespace


  CaseEntries::CaseEntries(const ParameterHandler &prm)
  {
    std::stringstream json;
    prm.print_parameters(json, ParameterHandler::JSON);
    Tree tree;
    boost::property_tree::read_json(json, tree);
    collect(tree, "", entries);
  }


  CaseEntries::CaseEntries(const std::string &text)
  {
    std::istringstream in(text);
    CaseEntry entry;
    while (std::getline(in, entry.subsection, separator) && std::getline(in, entry.name, separator) &&
           std::getline(in, entry.value, separator) && std::getline(in, entry.checksum))
      entries.push_back(entry);
  }


  std::string CaseEntries::text() const
  {
    std::string result;
    for (const CaseEntry &entry : entries)
      result += entry.subsection + separator + entry.name + separator + single_blanks(entry.value) + separator +
                entry.checksum + '\n';
    return result;
  }


  bool CaseEntries::has_subsection(const std::string &path) const
  {
    return std::any_of(
        entries.begin(), entries.end(), [&](const CaseEntry &entry) { return entry.subsection == path; });
  }


  bool same_value(const CaseEntry &first, const CaseEntry &second)
  {
    if (!first.checksum.empty() && !second.checksum.empty())
      return first.checksum == second.checksum;
    const auto a = Utilities::split_string_list(single_blanks(first.value));
    const auto b = Utilities::split_string_list(single_blanks(second.value));
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const std::string &one, const std::string &other) {
      return one == other || number_of(one) == number_of(other);
    });
  }
} // namespace scree

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/input/case_entries.h>

#include <deal.II/base/utilities.h>

#include <boost/property_tree/json_parser.hpp>

#include <regex>
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
    constexpr char place_text[] =
        " It may be an expression of x, y (z), m, of the place at the start and of depth, m of soil above it. Or it "
        "names a file of values on the map: a raster (.asc, .tif), or lines of x, y (z) and value (.csv, .txt), of "
        "which the nearest counts.";

    bool ends_with_one_of(const std::string &text, const std::string &ends)
    {
      return std::regex_search(text, std::regex("\\.(" + ends + ")$", std::regex::icase));
    }
  } // namespace


  void add_place_entry(ParameterHandler &prm,
                       const std::string &entry,
                       double &number,
                       std::string &of_place,
                       const std::string &documentation)
  {
    prm.declare_entry(
        entry, of_place.empty() ? number_text(number) : of_place, Patterns::Anything(), documentation + place_text);
    prm.add_action(entry, [&number, &of_place](const std::string &value) {
      const double read = number_of(value);
      of_place          = std::isfinite(read) ? "" : value.empty() ? " " : value; // which does not read
      number            = std::isfinite(read) ? read : number;
    });
  }


  bool names_place_file(const std::string &value)
  {
    return is_raster(value) || ends_with_one_of(value, "csv|txt");
  }


  bool is_raster(const std::string &file)
  {
    return ends_with_one_of(file, "asc|tiff?");
  }


  bool uses_depth(const std::string &text)
  {
    return std::regex_search(text, std::regex("\\bdepth\\b"));
  }


  bool CaseEntry::names_file(const std::string &value) const
  {
    return std::isnan(number_of(value)) &&
           (pattern == Patterns::FileName(Patterns::FileName::input).description() ||
            (documentation.find(place_text) != std::string::npos && names_place_file(value)));
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

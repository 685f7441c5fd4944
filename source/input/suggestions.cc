// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/input/input_error.h>
#include <scree/input/suggestions.h>

#include <deal.II/base/table.h>
#include <deal.II/base/utilities.h>

#include <boost/property_tree/json_parser.hpp>

#include <algorithm>
#include <sstream>

namespace scree
{
  using namespace dealii;

  namespace
  {
    using Name = DeclaredNames::Name;
    using Tree = boost::property_tree::ptree;

    /// Adds the names of a subsection and all in it.
    void collect(const Tree &tree, const std::string &path, std::vector<Name> &entries, std::vector<Name> &subsections)
    {
      for (const auto &[name, child] : tree)
        if (const auto pattern = child.get_optional<std::string>("pattern_description"))
          entries.push_back({ path, name, *pattern, child.get<std::string>("documentation") });
        else
          {
            subsections.push_back({ path, name, "", "" });
            collect(child, subsection_path(path, name), entries, subsections);
          }
    }

    const Name *find(const std::vector<Name> &names, const std::string &path, const std::string &name)
    {
      const auto found =
          std::find_if(names.begin(), names.end(), [&](const Name &n) { return n.path == path && n.name == name; });
      return found == names.end() ? nullptr : &*found;
    }

    /// Letters to insert, delete, change or swap with the next one (Damerau 1964), whatever their case.
    unsigned int edit_distance(const std::string &first, const std::string &second)
    {
      const std::string a = lower_case(first), b = lower_case(second);
      Table<2, unsigned int> distance(a.size() + 1, b.size() + 1);
      for (unsigned int i = 0; i <= a.size(); ++i)
        for (unsigned int j = 0; j <= b.size(); ++j)
          if (i == 0 || j == 0)
            distance(i, j) = i + j;
          else
            {
              distance(i, j) = std::min(
                  { distance(i - 1, j) + 1, distance(i, j - 1) + 1, distance(i - 1, j - 1) + (a[i - 1] != b[j - 1]) });
              if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                distance(i, j) = std::min(distance(i, j), distance(i - 2, j - 2) + 1);
            }
      return distance(a.size(), b.size());
    }

    /// 0: the same; large: no relation.
    unsigned int strangeness(const std::string &written, const std::string &meant)
    {
      constexpr unsigned int unrelated = 1000;
      const unsigned int distance      = edit_distance(written, meant);
      const std::size_t shorter        = std::min(written.size(), meant.size());
      if (distance <= std::max<std::size_t>(1, shorter / 3) && distance < shorter)
        return distance;
      const auto within = [](const std::string &part, const std::string &whole) {
        return part.size() >= 4 && lower_case(whole).find(lower_case(part)) != std::string::npos;
      };
      return within(written, meant) || within(meant, written) ? unrelated / 2 + distance : unrelated;
    }

    /// The names closest to `written`: those in the subsection `path` if there are any, else those elsewhere.
    std::vector<Name> closest(const std::vector<Name> &names, const std::string &path, const std::string &written)
    {
      std::vector<Name> result;
      for (const bool here : { true, false })
        {
          unsigned int least = 1000;
          for (const Name &name : names)
            if ((name.path == path) == here)
              {
                const unsigned int strange = strangeness(written, name.name);
                if (strange < least)
                  result.clear();
                if (strange < 1000 && strange <= least)
                  result.push_back(name);
                least = std::min(least, strange);
              }
          if (!result.empty())
            break;
        }
      return result;
    }

    /// `"Cell size"`, `"Cell size" in subsection Mesh`, `"K0" in subsection Sand/Initial state or Clay/Initial state`.
    std::string description(const std::vector<Name> &names, const std::string &path)
    {
      std::string result = quoted(names.front().name);
      if (names.front().path == path)
        return result;
      std::string separator = " in subsection ";
      for (const Name &name : names)
        if (name.name == names.front().name)
          {
            result += name.path.empty() ? " at the top of the file" : separator + name.path;
            separator = " or ";
          }
      return result;
    }

    /// `Did you mean "Mesh"?`, or where the name stands if it is right, or nothing.
    std::string suggestion(const std::vector<Name> &names, const std::string &path, const std::string &written)
    {
      const auto close = closest(names, path, written);
      if (close.empty())
        return "";
      if (close.front().name == written)
        return "There is " + description(close, path) + "; move it there, or look for a wrong \"end\" above.";
      return "Did you mean " + description(close, path) + '?';
    }

    /// The text between two marks; to the end if there is no second one.
    std::string between(const std::string &text, const std::string &first, const std::string &second)
    {
      const std::size_t begin = text.find(first) + first.size();
      return text.substr(begin, text.find(second, begin) - begin);
    }

    /// The choices of a Patterns::Selection.
    std::vector<std::string> selection(const std::string &pattern)
    {
      return Utilities::split_string_list(between(pattern, "[Selection ", " ]"), '|');
    }

    std::string range_text(const std::string &what, const std::string &lower, const std::string &upper)
    {
      // Declarations exclude 0 by a tiny bound.
      constexpr double tiny = 1e-9;
      const auto is_bound   = [](const std::string &text) { return text.find("MAX_") == std::string::npos; };
      const bool from_above = is_bound(lower) && std::stod(lower) > 0 && std::stod(lower) <= tiny;
      std::string result    = what;
      if (from_above)
        result += " above 0";
      else if (is_bound(lower))
        result += " from " + lower + (is_bound(upper) ? "" : " up");
      if (is_bound(upper))
        result += " to " + upper;
      return result;
    }

    /// What a pattern of deal.II asks for, in words.
    std::string pattern_as_words(const std::string &pattern)
    {
      const auto starts_with = [&](const std::string &begin) { return pattern.rfind(begin, 0) == 0; };
      if (starts_with("[List of <"))
        {
          const std::string tail  = pattern.substr(pattern.rfind(">") + 1);
          const std::string least = between(tail, "length ", "..."), most = between(tail, "...", " ");
          const std::string each = pattern_as_words(pattern.substr(10, pattern.rfind(">") - 10));
          return least +
                 (most.size() > 9 ? " or more"
                  : least == most ? ""
                                  : " or " + most) +
                 " values, separated by commas" + (each.empty() ? "" : ", each " + each);
        }
      if (starts_with("[Double "))
        return range_text("a number", between(pattern, "[Double ", "..."), between(pattern, "...", " "));
      if (starts_with("[Integer range "))
        return range_text("a whole number", between(pattern, "[Integer range ", "..."), between(pattern, "...", " "));
      if (starts_with("[Selection "))
        {
          std::string choices;
          for (const auto &choice : selection(pattern))
            choices += (choices.empty() ? "" : ", ") + quoted(choice);
          return "one of " + choices;
        }
      return starts_with("[Bool") ? "true or false" : "";
    }
  } // namespace


  DeclaredNames::DeclaredNames(const ParameterHandler &prm)
  {
    std::stringstream json;
    prm.print_parameters(json, ParameterHandler::JSON);
    Tree tree;
    boost::property_tree::read_json(json, tree);
    collect(tree, "", entries, subsections);
  }


  const DeclaredNames::Name *DeclaredNames::entry(const std::string &path, const std::string &name) const
  {
    return find(entries, path, name);
  }


  bool DeclaredNames::has_subsection(const std::string &path, const std::string &name) const
  {
    return find(subsections, path, name) != nullptr;
  }


  std::string DeclaredNames::suggest_entry(const std::string &path, const std::string &written) const
  {
    return suggestion(entries, path, written);
  }


  std::string DeclaredNames::suggest_subsection(const std::string &path, const std::string &written) const
  {
    return suggestion(subsections, path, written);
  }


  std::vector<std::string> DeclaredNames::subsection_paths() const
  {
    std::vector<std::string> paths;
    for (const Name &name : subsections)
      paths.push_back(subsection_path(name.path, name.name));
    return paths;
  }


  std::vector<std::string> nearest(const std::vector<std::string> &names, const std::string &written)
  {
    std::vector<Name> all;
    for (const std::string &name : names)
      all.push_back({ "", name, "", "" });
    std::vector<std::string> result;
    for (const Name &name : closest(all, "", written))
      result.push_back(name.name);
    return result;
  }


  std::string value_remedy(const DeclaredNames::Name &entry, const std::string &value)
  {
    std::string remedy = "write " + pattern_as_words(entry.pattern) + '.';
    if (entry.pattern.rfind("[Selection ", 0) == 0)
      {
        std::vector<Name> choices;
        for (const auto &choice : selection(entry.pattern))
          choices.push_back({ "", choice, "", "" });
        const std::string choice = suggestion(choices, "", value);
        remedy += (choice.empty() ? "" : " ") + choice;
      }
    return remedy + (entry.documentation.empty() ? "" : " Meaning: " + entry.documentation);
  }
} // namespace scree

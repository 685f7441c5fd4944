// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/input/suggestions.h>
#include <scree/case/parameters.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

namespace scree
{
  using namespace dealii;

  void Parameters::print(std::ostream &out)
  {
    handler.print_parameters(out, ParameterHandler::PRM);
  }


  void Parameters::print_json(std::ostream &out)
  {
    handler.print_parameters(out, ParameterHandler::JSON | ParameterHandler::KeepDeclarationOrder);
  }


  namespace
  {
    /// The paths whose last names, or which as a whole, are closest to `path`, in words; empty: none is.
    std::string meant_subsections(const std::vector<std::string> &paths, const std::string &path)
    {
      const auto last_name = [](const std::string &one) { return one.substr(one.rfind('/') + 1); };
      std::vector<std::string> last_names;
      for (const std::string &one : paths)
        last_names.push_back(last_name(one));
      std::vector<std::string> close = nearest(paths, path);
      if (close.empty() || lower_case(close.front()) != lower_case(path))
        if (const auto names = nearest(last_names, last_name(path)); !names.empty())
          {
            close.clear();
            for (const std::string &one : paths)
              if (std::find(names.begin(), names.end(), last_name(one)) != names.end())
                close.push_back(one);
          }
      std::string text;
      for (const std::string &one : close)
        text += (text.empty() ? " Did you mean " : " or ") + quoted(one);
      return text.empty() ? "" : text + '?';
    }
  } // namespace


  void Parameters::print_sections(const std::string &path, std::ostream &out)
  {
    for (const std::string &one : DeclaredNames(handler).subsection_paths())
      if (path.empty() || (one + '/').rfind(path + '/', 0) == 0)
        out << one << '\n';
  }


  void Parameters::print_subsection(const std::string &path, std::ostream &out)
  {
    const auto paths    = DeclaredNames(handler).subsection_paths();
    const bool is_there = std::find(paths.begin(), paths.end(), path) != paths.end();
    if (!is_there && !case_file.empty() && path.rfind("Soil", 0) != 0)
      try
        {
          return Parameters().print_subsection(path, out); // The case does not have it yet: the defaults.
        }
      catch (const InputError &)
        {
        } // No case has it.
    if (!is_there)
      throw InputError("command line: there is no subsection " + quoted(path) + '.' + meant_subsections(paths, path) +
                       (case_file.empty()
                            ? " scree --print-parameters --sections lists all of them; \"Soil\" stands "
                              "for any body. A case file adds its own names."
                            : " scree " + case_file + " --print-parameters --sections lists all of them."));
    std::stringstream all;
    print(all);
    std::vector<std::string> open; // subsections
    for (std::string line; std::getline(all, line);)
      {
        const std::string statement = Utilities::trim(line);
        if (statement.rfind("subsection ", 0) == 0)
          open.push_back(subsection_path(open.empty() ? "" : open.back(), statement.substr(11)));
        if (!open.empty() && (open.back() + '/').rfind(path + '/', 0) == 0)
          out << line << '\n';
        if (statement == "end")
          open.pop_back();
      }
  }


  void Parameters::set(const std::string &path, const std::string &entry, const std::string &value)
  {
    const std::vector<std::string> subsections = Utilities::split_string_list(path, '/');
    for (const std::string &subsection : subsections)
      handler.enter_subsection(subsection);
    handler.set(entry, value);
    for (unsigned int s = 0; s < subsections.size(); ++s)
      handler.leave_subsection();
  }


  void Parameters::print_into(const std::string &folder, std::ostream &out)
  {
    for (const NamedFile &named : named_files)
      set(named.subsection, named.entry, std::filesystem::relative(named.path, folder));
    print(out);
    for (const NamedFile &named : named_files)
      set(named.subsection, named.entry, named.path);
  }
} // namespace scree

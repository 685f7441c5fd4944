// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/input/suggestions.h>
#include <scree/case/parameters.h>

#include <deal.II/base/utilities.h>

#include <filesystem>
#include <sstream>

namespace scree
{
  using namespace dealii;

  void Parameters::print(std::ostream &out)
  {
    handler.print_parameters(out, ParameterHandler::Text);
  }


  void Parameters::print_json(std::ostream &out)
  {
    handler.print_parameters(out, ParameterHandler::JSON | ParameterHandler::KeepDeclarationOrder);
  }


  void Parameters::print_subsection(const std::string &path, std::ostream &out)
  {
    const std::size_t slash  = path.rfind('/');
    const std::string parent = slash == std::string::npos ? "" : path.substr(0, slash);
    const std::string name   = slash == std::string::npos ? path : path.substr(slash + 1);
    const DeclaredNames declared(handler);
    if (!declared.has_subsection(parent, name))
      throw InputError("command line: there is no subsection " + quoted(path) + ". " +
                       declared.suggest_subsection(parent, name) +
                       " scree --print-parameters lists all of them; those of any body are those of Soil.");
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


  void Parameters::print_into(const std::string &folder, std::ostream &out)
  {
    const auto set = [this](const NamedFile &named, const std::string &path) {
      const std::vector<std::string> subsections = Utilities::split_string_list(named.subsection, '/');
      for (const std::string &subsection : subsections)
        handler.enter_subsection(subsection);
      handler.set(named.entry, path);
      for (unsigned int s = 0; s < subsections.size(); ++s)
        handler.leave_subsection();
    };
    for (const NamedFile &named : named_files)
      set(named, std::filesystem::relative(named.path, folder));
    print(out);
    for (const NamedFile &named : named_files)
      set(named, named.path);
  }
} // namespace scree

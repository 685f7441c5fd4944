// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/input_error.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/table.h>
#include <deal.II/base/utilities.h>

#include <boost/property_tree/json_parser.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace scree
{
  using namespace dealii;

  namespace
  {
    std::string quoted(const std::string &text)
    {
      return '"' + text + '"';
    }

    std::string shown(const std::string &value)
    {
      return value.empty() ? "(empty)" : value;
    }

    std::string joined(const std::string &path, const std::string &name)
    {
      return path.empty() ? name : path + '/' + name;
    }

    /// One blank for tabs, ends of lines and several blanks, as deal.II reads a line.
    std::string single_blanks(const std::string &text)
    {
      std::istringstream in(text);
      std::string word, result;
      while (in >> word)
        result += (result.empty() ? "" : " ") + word;
      return result;
    }

    std::string lower_case(std::string text)
    {
      std::transform(text.begin(), text.end(), text.begin(), [](const unsigned char c) { return std::tolower(c); });
      return text;
    }


    std::string read_text(const std::string &file, const std::string &remedy)
    {
      std::ifstream in(file);
      std::ostringstream text;
      if (in && !std::filesystem::is_directory(file))
        text << std::string(std::istreambuf_iterator<char>(in), {});
      else
        throw InputError(file + ": this is no file that can be read. " + remedy);
      return text.str();
    }


    // Declared names --------------------------------------------------------------------------------------------------

    struct Entry
    {
      std::string path, name, pattern, documentation;
    };

    struct Subsection
    {
      std::string path, name; ///< of the subsection it stands in, and its own
    };

    struct Declared
    {
      std::vector<Entry> entries;
      std::vector<Subsection> subsections;

      explicit Declared(const ParameterHandler &prm)
      {
        std::stringstream json;
        prm.print_parameters(json, ParameterHandler::JSON);
        boost::property_tree::ptree tree;
        boost::property_tree::read_json(json, tree);
        collect(tree, "");
      }

    private:
      void collect(const boost::property_tree::ptree &tree, const std::string &path)
      {
        for (const auto &[name, child] : tree)
          if (const auto pattern = child.get_optional<std::string>("pattern_description"))
            entries.push_back({ path, name, *pattern, child.get<std::string>("documentation") });
          else
            {
              subsections.push_back({ path, name });
              collect(child, joined(path, name));
            }
      }
    };

    template <class Name>
    const Name *find(const std::vector<Name> &names, const std::string &path, const std::string &name)
    {
      const auto found =
          std::find_if(names.begin(), names.end(), [&](const Name &n) { return n.path == path && n.name == name; });
      return found == names.end() ? nullptr : &*found;
    }


    // Suggestions -----------------------------------------------------------------------------------------------------

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
    template <class Name>
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
    template <class Name>
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

    /// ` Did you mean "Mesh"?`, or ` It stands at ...` if the name is right, or nothing.
    template <class Name>
    std::string suggestion(const std::vector<Name> &names, const std::string &path, const std::string &written)
    {
      const auto close = closest(names, path, written);
      if (close.empty())
        return "";
      if (close.front().name == written)
        return " There is " + description(close, path) + "; move it there, or look for a wrong \"end\" above.";
      return " Did you mean " + description(close, path) + '?';
    }


    // Values ----------------------------------------------------------------------------------------------------------

    /// The text between two marks; to the end if there is no second one.
    std::string between(const std::string &text, const std::string &first, const std::string &second)
    {
      const std::size_t begin = text.find(first) + first.size();
      return text.substr(begin, text.find(second, begin) - begin);
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
    std::string pattern_text(const std::string &pattern)
    {
      const auto starts_with = [&](const std::string &begin) { return pattern.rfind(begin, 0) == 0; };
      if (starts_with("[List of <"))
        {
          const std::string tail  = pattern.substr(pattern.rfind(">") + 1);
          const std::string least = between(tail, "length ", "..."), most = between(tail, "...", " ");
          const std::string each = pattern_text(pattern.substr(10, pattern.rfind(">") - 10));
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
          for (const auto &choice : Utilities::split_string_list(between(pattern, "[Selection ", " ]"), '|'))
            choices += (choices.empty() ? "" : ", ") + quoted(choice);
          return "one of " + choices;
        }
      return starts_with("[Anything") ? "" : pattern;
    }

    std::string value_remedy(const Entry &entry, const std::string &value)
    {
      std::string remedy = "write " + pattern_text(entry.pattern) + '.';
      if (entry.pattern.rfind("[Selection ", 0) == 0)
        {
          std::vector<Subsection> choices;
          for (const auto &choice : Utilities::split_string_list(between(entry.pattern, "[Selection ", " ]"), '|'))
            choices.push_back({ "", choice });
          remedy += suggestion(choices, "", value);
        }
      return remedy + (entry.documentation.empty() ? "" : " Meaning: " + entry.documentation);
    }
  } // namespace


  std::string entry_name(const std::string &subsection, const std::string &entry)
  {
    return (subsection.empty() ? "" : "subsection " + subsection + ", ") + "entry " + quoted(entry);
  }


  void require_entry(const bool possible,
                     const std::string &subsection,
                     const std::string &entry,
                     const std::string &value,
                     const std::string &remedy)
  {
    if (!possible)
      throw EntryError(entry_name(subsection, entry) + " = " + shown(value) + ": " + remedy);
  }


  std::string number_text(const double value)
  {
    std::ostringstream text;
    text << value;
    return text.str();
  }


  std::string number_text(const std::vector<double> &values)
  {
    std::string text;
    for (const double value : values)
      text += (text.empty() ? "" : ", ") + number_text(value);
    return text;
  }


  std::string plain_text(const ExceptionBase &error)
  {
    std::ostringstream text;
    error.print_info(text);
    return single_blanks(text.str());
  }


  void throw_on_all_ranks(const std::string &fault, const MPI_Comm communicator)
  {
    const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(communicator);
    const unsigned int rank    = Utilities::MPI::this_mpi_process(communicator);
    const unsigned int first   = Utilities::MPI::min(fault.empty() ? n_ranks : rank, communicator);
    if (first < n_ranks)
      throw EntryError(Utilities::MPI::broadcast(communicator, fault, first));
  }


  InputFile::InputFile(const std::string &file)
      : file_name(file)
      , whole_text(read_text(file, "Check the path; cases are in the folder prm."))
  {
    std::vector<Statement> open;
    read(whole_text, file, open);
    if (!open.empty())
      throw open.back().error("subsection " + joined(open.back().path, open.back().name) +
                              " is still open where the file ends. Write \"end\" after its last entry.");
  }


  void InputFile::read(const std::string &text, const std::string &file, std::vector<Statement> &open)
  {
    std::istringstream in(text);
    std::string line, statement;
    unsigned int n_lines = 0, first_line = 0;
    while (std::getline(in, line))
      {
        ++n_lines;
        if (statement.empty())
          first_line = n_lines;
        line                = Utilities::trim(line);
        const bool to_go_on = !line.empty() && line.back() == '\\';
        statement += to_go_on ? line.substr(0, line.size() - 1) : line;
        if (to_go_on && !in.eof())
          continue;
        read_line(
            single_blanks(statement.substr(0, statement.find('#'))), { Kind::set, file, first_line, "", "", "" }, open);
        statement.clear();
      }
  }


  void InputFile::read_line(const std::string &line, const Statement &place, std::vector<Statement> &open)
  {
    if (line.empty())
      return;
    Statement statement = place;
    if (!open.empty())
      statement.path = joined(open.back().path, open.back().name);
    const std::size_t blank   = line.find(' ');
    const std::string keyword = line.substr(0, blank);
    const std::string rest    = blank == std::string::npos ? "" : line.substr(blank + 1);
    const std::size_t equals  = rest.find('=');

    if (keyword == "subsection" || keyword == "SUBSECTION")
      {
        statement.kind = Kind::subsection;
        statement.name = rest;
        open.push_back(statement);
      }
    else if (keyword == "end" || keyword == "END")
      {
        statement.kind = Kind::end;
        if (!rest.empty())
          throw statement.error(quoted(line) + " does not read. Write \"end\" alone in its line.");
        if (open.empty())
          throw statement.error("this \"end\" closes no subsection. Remove it, or look for a wrong \"end\" above.");
        open.pop_back();
      }
    else if ((keyword == "set" || keyword == "SET") && equals != std::string::npos)
      {
        statement.name  = Utilities::trim(rest.substr(0, equals));
        statement.value = Utilities::trim(rest.substr(equals + 1));
      }
    else if (keyword == "set" || keyword == "SET")
      throw statement.error((statement.path.empty() ? "" : "subsection " + statement.path + ", ") + quoted(line) +
                            " has no '='. Write: set ENTRY = VALUE");
    else if (keyword == "include" || keyword == "INCLUDE")
      {
        read(read_text(rest,
                       "It is included in " + place.file + ", line " + std::to_string(place.line) +
                           "; the path counts from where scree is started."),
             rest,
             open);
        return;
      }
    else
      throw statement.error((statement.path.empty() ? "" : "subsection " + statement.path + ", ") + quoted(line) +
                            " does not read. A line begins with set, subsection, end, include or #.");
    statements.push_back(statement);
  }


  InputError InputFile::Statement::error(const std::string &message) const
  {
    return InputError(file + ", line " + std::to_string(line) + ": " + message);
  }


  std::string InputFile::value(const std::string &entry, const std::string &otherwise) const
  {
    std::string result = otherwise;
    for (const Statement &statement : statements)
      if (statement.kind == Kind::set && statement.path.empty() && statement.name == entry)
        result = statement.value;
    return result;
  }


  void InputFile::check(const ParameterHandler &prm) const
  {
    const Declared declared(prm);
    for (const Statement &statement : statements)
      if (statement.kind == Kind::subsection && !find(declared.subsections, statement.path, statement.name))
        {
          const std::string path = joined(statement.path, statement.name);
          const bool is_body =
              statement.path.empty() && std::any_of(statements.begin(), statements.end(), [&](const Statement &other) {
                return other.kind == Kind::set && other.path == path && other.name == "Region";
              });
          const std::string remedy = is_body
                                         ? " It is no body either: entry \"Bodies\" lists " + value("Bodies", "Soil") +
                                               ". Add " + quoted(statement.name) + " there."
                                         : suggestion(declared.subsections, statement.path, statement.name);
          throw statement.error("subsection " + path + ": there is no such subsection." +
                                (remedy.empty() ? " scree --print-parameters lists all of them." : remedy));
        }
      else if (statement.kind == Kind::set)
        {
          const std::string where = entry_name(statement.path, statement.name) + " = " + shown(statement.value) + ": ";
          const Entry *entry      = find(declared.entries, statement.path, statement.name);
          if (!entry)
            {
              const std::string remedy = suggestion(declared.entries, statement.path, statement.name);
              throw statement.error(where + "there is no such entry" + (statement.path.empty() ? "" : " here") + '.' +
                                    (remedy.empty() ? " scree --print-parameters lists all of them." : remedy));
            }
          if (!Patterns::pattern_factory(entry->pattern)->match(statement.value))
            throw statement.error(where + value_remedy(*entry, statement.value));
        }
  }


  InputError InputFile::error(const std::string &message) const
  {
    for (auto statement = statements.rbegin(); statement != statements.rend(); ++statement)
      if (statement->kind == Kind::set && message.rfind(entry_name(statement->path, statement->name) + " =", 0) == 0)
        return statement->error(message);
    return InputError(file_name + ": " + message);
  }
} // namespace scree

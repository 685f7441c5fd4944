// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/input/input_file.h>

#include <deal.II/base/table.h>
#include <deal.II/base/utilities.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// A subsection, or an entry with the same name, and the subsection in which it stands.
    using Name = CaseEntry;

    bool has_name(const std::vector<Name> &names, const std::string &path, const std::string &name)
    {
      return std::any_of(
          names.begin(), names.end(), [&](const Name &one) { return one.subsection == path && one.name == name; });
    }

    /// The subsections of entries, each once, behind those around it.
    std::vector<Name> subsections_of(const CaseEntries &entries)
    {
      std::vector<Name> subsections;
      for (const CaseEntry &entry : entries.all())
        {
          std::string around;
          for (const std::string &name : Utilities::split_string_list(entry.subsection, '/'))
            {
              if (!has_name(subsections, around, name))
                subsections.push_back({ around, name });
              around = subsection_path(around, name);
            }
        }
      return subsections;
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
            if ((name.subsection == path) == here)
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
      if (names.front().subsection == path)
        return result;
      std::string separator = " in subsection ";
      for (const Name &name : names)
        if (name.name == names.front().name)
          {
            result += name.subsection.empty() ? " at the top of the file" : separator + name.subsection;
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

    /// The choices of a Patterns::Selection; none of another pattern.
    std::vector<std::string> selection(const std::string &pattern)
    {
      std::smatch parts;
      return std::regex_match(pattern, parts, std::regex("\\[Selection (.*) \\]"))
                 ? Utilities::split_string_list(parts[1], '|')
                 : std::vector<std::string>();
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
      static const std::regex list("\\[List of <(.*)> of length (\\d+)\\.\\.\\.(\\d+) .*"),
          range("\\[(Double|Integer range) (\\S+)\\.\\.\\.(\\S+) .*");
      std::smatch parts;
      if (std::regex_match(pattern, parts, list))
        {
          const std::string least = parts[2], most = parts[3], each = pattern_as_words(parts[1]);
          return least +
                 (most.size() > 9 ? " or more"
                  : least == most ? ""
                                  : " or " + most) +
                 " values, separated by commas" + (each.empty() ? "" : ", each " + each);
        }
      if (std::regex_match(pattern, parts, range))
        return range_text(parts[1] == "Double" ? "a number" : "a whole number", parts[2], parts[3]);
      std::vector<std::string> choices = selection(pattern);
      std::transform(choices.begin(), choices.end(), choices.begin(), quoted);
      if (!choices.empty())
        return "one of " + boost::algorithm::join(choices, ", ");
      return pattern.rfind("[Bool", 0) == 0 ? "true or false" : "";
    }

    /// What to write instead of a `value` that does not match the pattern of the entry, and what the entry means.
    std::string value_remedy(const Name &entry, const std::string &value)
    {
      std::vector<Name> choices;
      for (const auto &choice : selection(entry.pattern))
        choices.push_back({ "", choice });
      const std::string choice = suggestion(choices, "", value);
      return "write " + pattern_as_words(entry.pattern) + '.' + (choice.empty() ? "" : " " + choice) +
             (entry.documentation.empty() ? "" : " Meaning: " + entry.documentation);
    }
  } // namespace


  std::vector<std::string> subsection_paths(const ParameterHandler &prm)
  {
    std::vector<std::string> paths;
    for (const Name &name : subsections_of(CaseEntries(prm)))
      paths.push_back(subsection_path(name.subsection, name.name));
    return paths;
  }


  std::vector<std::string> nearest(const std::vector<std::string> &names, const std::string &written)
  {
    std::vector<Name> all;
    for (const std::string &name : names)
      all.push_back({ "", name });
    return names_of(closest(all, "", written));
  }


  namespace
  {
    /// The path from the working folder of a file that `reader` names.
    std::string path_beside(const std::string &reader, const std::string &file)
    {
      return file.empty() ? file : (std::filesystem::path(reader).parent_path() / file).string();
    }

    /// The checksum of a file's contents, in hexadecimal digits; empty if it is no regular file that can be read.
    std::string checksum_of_file(const std::string &path)
    {
      std::error_code error;
      std::ifstream in;
      if (std::filesystem::is_regular_file(path, error)) // A pipe can be read once, and a device may have no end.
        in.open(path, std::ios::binary);
      if (!in.is_open())
        return "";
      Checksum checksum;
      std::array<char, 1 << 16> part;
      while (in.read(part.data(), part.size()) || in.gcount() > 0)
        checksum.process_bytes(part.data(), in.gcount());
      std::ostringstream text;
      text << std::hex << checksum.checksum();
      return text.str();
    }

    std::string read_text(const std::string &file, const std::string &remedy)
    {
      std::ifstream in(file);
      // A pipe may be read, too; a device such as /dev/zero may have no end.
      if (!in || std::filesystem::is_directory(file) || std::filesystem::is_block_file(file) ||
          std::filesystem::is_character_file(file))
        throw InputError(file + ": this is no file that can be read. " + remedy);
      std::string text(std::istreambuf_iterator<char>(in), {});
      const std::string byte_order_mark = "\xEF\xBB\xBF";
      if (text.rfind(byte_order_mark, 0) == 0)
        text.erase(0, byte_order_mark.size());
      if (text.find('\0') != std::string::npos)
        throw InputError(file + ": this is no plain text, but holds zero bytes. Save it as UTF-8, not UTF-16.");
      return text;
    }

    /// Whether the bytes are characters of UTF-8.
    bool is_utf8(const std::string &text)
    {
      unsigned int n_to_follow = 0;
      for (const unsigned char c : text)
        if (n_to_follow > 0 && c >= 0x80 && c < 0xC0)
          --n_to_follow;
        else if (n_to_follow == 0 && (c < 0x80 || (c >= 0xC2 && c < 0xF5)))
          n_to_follow = c < 0x80 ? 0 : c < 0xE0 ? 1 : c < 0xF0 ? 2 : 3;
        else
          return false;
      return n_to_follow == 0;
    }
  } // namespace


  InputFile::InputFile(const std::string &file)
      : file_name(file)
      , whole_text(read_text(file, "Check the path; cases are in the folder prm."))
  {
    Open open;
    read(whole_text, file, open);
    if (!open.subsections.empty())
      throw open.subsections.back().error("subsection " +
                                          subsection_path(open.subsections.back().path, open.subsections.back().name) +
                                          " is still open where the file ends. Write \"end\" after its last entry.");
  }


  void InputFile::read(const std::string &text, const std::string &file, Open &open)
  {
    open.files.push_back(file);
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
    open.files.pop_back();
  }


  void InputFile::include(const std::string &name, const Statement &place, Open &open)
  {
    const std::string file = path_beside(place.file, name);
    const std::string text = read_text(file,
                                       "It is included in " + place.file + ", line " + std::to_string(place.line) +
                                           "; the path counts from the folder of that file.");
    std::string loop;
    for (const std::string &reader : open.files)
      if (!loop.empty() || std::filesystem::equivalent(reader, file))
        loop += reader + " -> ";
    if (!loop.empty())
      throw place.error("files include each other in a loop: " + loop + file + ". Remove one of these includes.");
    read(text, file, open);
  }


  void InputFile::read_line(const std::string &line, const Statement &place, Open &open)
  {
    if (line.empty())
      return;
    if (!is_utf8(line))
      throw place.error(quoted(line) +
                        " holds letters that are not UTF-8. Save the file as UTF-8, or write them without accents.");
    Statement statement = place;
    if (!open.subsections.empty())
      statement.path = subsection_path(open.subsections.back().path, open.subsections.back().name);
    const std::size_t blank   = line.find(' ');
    const std::string keyword = line.substr(0, blank);
    const std::string rest    = blank == std::string::npos ? "" : line.substr(blank + 1);
    const std::size_t equals  = rest.find('=');

    if (keyword == "subsection" || keyword == "SUBSECTION")
      {
        statement.kind = Kind::subsection;
        statement.name = rest;
        open.subsections.push_back(statement);
      }
    else if (keyword == "end" || keyword == "END")
      {
        statement.kind = Kind::end;
        if (!rest.empty())
          throw statement.error(quoted(line) + " does not read. Write \"end\" alone in its line.");
        if (open.subsections.empty())
          throw statement.error("this \"end\" closes no subsection. Remove it, or look for a wrong \"end\" above.");
        open.subsections.pop_back();
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
        include(rest, place, open);
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


  std::vector<NamedFile> InputFile::named_files(const ParameterHandler &prm)
  {
    const CaseEntries declared(prm);
    std::vector<NamedFile> result;
    for (Statement &statement : statements)
      if (const CaseEntry *entry = declared.find(statement.path, statement.name);
          statement.kind == Kind::set && entry && entry->names_file(statement.value))
        {
          statement.path_of_file = path_beside(statement.file, statement.value);
          if (!statement.value.empty() && find(statement.path, statement.name) == &statement) // The last one counts.
            result.push_back({ statement.path,
                               statement.name,
                               statement.path_of_file,
                               statement.value,
                               checksum_of_file(statement.path_of_file) });
        }
    return result;
  }


  std::string InputFile::text_of(const std::vector<Statement> &statements)
  {
    std::string result;
    for (const Statement &statement : statements)
      if (statement.kind == Kind::subsection)
        result += "subsection " + statement.name + '\n';
      else if (statement.kind == Kind::end)
        result += "end\n";
      else // The mark of a comment keeps a backslash at the end of a value from joining lines.
        result += "set " + statement.name + " = " +
                  (statement.path_of_file.empty() ? statement.value : statement.path_of_file) + " #\n";
    return result;
  }


  const InputFile::Statement *InputFile::find(const std::string &subsection, const std::string &entry) const
  {
    const auto last = std::find_if(statements.rbegin(), statements.rend(), [&](const Statement &statement) {
      return statement.kind == Kind::set && statement.path == subsection && statement.name == entry;
    });
    return last == statements.rend() ? nullptr : &*last;
  }


  std::pair<std::string, std::string> InputFile::changed_entry(const std::string &subsection,
                                                               const ParameterHandler &prm) const
  {
    const std::vector<std::string> path = Utilities::split_string_list(subsection, '/');
    for (const Statement &statement : statements)
      if (statement.kind == Kind::set && statement.path == subsection &&
          statement.value != prm.get(path, statement.name))
        return { statement.name, statement.value };
    return {};
  }


  std::vector<std::string> InputFile::subsections(const std::string &prefix) const
  {
    std::vector<std::string> names;
    for (const Statement &statement : statements)
      if (statement.kind == Kind::subsection && statement.path.empty() && statement.name.rfind(prefix, 0) == 0 &&
          std::find(names.begin(), names.end(), statement.name) == names.end())
        names.push_back(statement.name);
    return names;
  }


  void InputFile::take_up_to(const std::string &prefix, const std::string &last)
  {
    std::vector<Statement> result;
    const auto name_at_top = [&](const Statement &statement) {
      const std::string path =
          statement.kind == Kind::subsection ? subsection_path(statement.path, statement.name) : statement.path;
      return path.substr(0, path.find('/'));
    };
    std::set<std::pair<std::string, std::string>> seen; // names and the files in which they stand
    for (const Statement &statement : statements)
      if (name_at_top(statement).rfind(prefix, 0) != 0)
        result.push_back(statement);
      else
        {
          left_out.push_back(statement);
          if (statement.kind == Kind::subsection && statement.path.empty() &&
              !seen.insert({ statement.name, statement.file }).second)
            throw statement.error("subsection " + statement.name +
                                  " stands in this file before. Write another name, or one subsection.");
        }
    bool counts = !last.empty();
    for (const std::string &name : subsections(prefix))
      {
        for (const bool is_inner : { false, true }) // What stands directly in a stage comes before its subsections.
          for (Statement statement : statements)
            {
              const bool is_frame =
                  statement.kind == Kind::subsection ? statement.path.empty() : statement.path == name;
              if (!counts || name_at_top(statement) != name || is_inner == is_frame || (is_frame && name != last))
                continue;
              if (is_inner)
                statement.path.erase(0, name.size() + 1);
              else
                (statement.kind == Kind::subsection ? statement.name : statement.path) = Utilities::trim(prefix);
              result.push_back(statement);
            }
        counts = counts && name != last;
      }
    statements = result;
  }


  void InputFile::check(const ParameterHandler &prm,
                        const std::string &last_remedy,
                        const SubsectionRemedy &subsection_remedy) const
  {
    const CaseEntries declared(prm);
    const std::vector<Name> subsections = subsections_of(declared);
    for (const Statement &statement : statements)
      if (statement.kind == Kind::subsection && !has_name(subsections, statement.path, statement.name))
        {
          const std::string path = subsection_path(statement.path, statement.name);
          std::string remedy     = subsection_remedy ? subsection_remedy(path) : "";
          if (remedy.empty())
            remedy = suggestion(subsections, statement.path, statement.name);
          throw statement.error("subsection " + path + ": there is no such subsection. " +
                                (remedy.empty() ? last_remedy : remedy));
        }
      else if (statement.kind == Kind::set)
        {
          const auto error = [&](const std::string &remedy) {
            return statement.error(entry_message({ statement.path, statement.name, statement.value }, remedy));
          };
          const CaseEntry *entry = declared.find(statement.path, statement.name);
          if (entry == nullptr)
            {
              const std::string remedy = suggestion(declared.all(), statement.path, statement.name);
              throw error(std::string("there is no such entry") + (statement.path.empty() ? ". " : " here. ") +
                          (remedy.empty() ? last_remedy : remedy));
            }
          if (!Patterns::pattern_factory(entry->pattern)->match(statement.value))
            throw error(value_remedy(*entry, statement.value));
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

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_input_input_file_h
#define scree_input_input_file_h

#include <scree/input/case_entries.h>

#include <functional>
#include <utility>

namespace scree
{
  /// The paths of all subsections that `prm` declares, such as Soil/Initial state, in the order of their names.
  std::vector<std::string> subsection_paths(const dealii::ParameterHandler &prm);

  /// The names closest to `written`, all of them equally close; none if no name is close.
  std::vector<std::string> nearest(const std::vector<std::string> &names, const std::string &written);

  /// The statements of a `.prm` file: finds faults before deal.II does, and says where they are and what helps.
  class InputFile
  {
  public:
    /// No file.
    InputFile() = default;

    /// Reads `file` and the files it includes. Throws InputError at what is no statement, at open subsections and at
    /// files that include each other.
    explicit InputFile(const std::string &file);

    /// The text of the file as it was read.
    const std::string &text() const
    {
      return whole_text;
    }

    /// The files that entries name, as `prm` declares those (see add_file_entry()). From here on their values in
    /// statements_text() are paths from the working folder.
    std::vector<NamedFile> named_files(const dealii::ParameterHandler &prm);

    /// The statements of the file and those it includes, for ParameterHandler::parse_input().
    std::string statements_text() const
    {
      return text_of(statements);
    }

    /// Those that take_up_to() has taken from their places.
    std::string left_out_text() const
    {
      return text_of(left_out);
    }

    /// The value of an entry of the subsection, or `otherwise` if the file does not set it.
    std::string value(const std::string &subsection, const std::string &entry, const std::string &otherwise) const
    {
      const Statement *statement = find(subsection, entry);
      return statement == nullptr ? otherwise : statement->value;
    }

    /// Whether the file sets the entry of the subsection.
    bool sets(const std::string &subsection, const std::string &entry) const
    {
      return find(subsection, entry) != nullptr;
    }

    /// Whether the file has a subsection of that path.
    bool has_subsection(const std::string &path) const
    {
      return std::any_of(statements.begin(), statements.end(), [&](const Statement &statement) {
        return statement.kind == Kind::subsection && subsection_path(statement.path, statement.name) == path;
      });
    }

    /// The first entry of a subsection with a value that is not the default of `prm`, and the value; empty: there is
    /// none.
    std::pair<std::string, std::string> changed_entry(const std::string &subsection,
                                                      const dealii::ParameterHandler &prm) const;

    /// The names of the subsections at the top that begin with `prefix`, each once.
    std::vector<std::string> subsections(const std::string &prefix) const;

    /// Takes the entries of subsections at the top that begin with `prefix` as entries of the case: those of the ones
    /// up to `last`, in the order of the file, come after all others, as if they stood at the top. Entries directly in
    /// the last one go into a subsection that is named `prefix`, without its blank at the end; those of later ones go.
    /// @param last empty: none of them counts
    void take_up_to(const std::string &prefix, const std::string &last);

    /// What helps if this subsection is not declared; empty: check() suggests the closest name.
    using SubsectionRemedy = std::function<std::string(const std::string &subsection)>;

    /// Throws InputError at the first entry or subsection that `prm` does not declare, and at the first value that does
    /// not fit; suggests the closest declared name, or the `last_remedy` if no name is close.
    void check(const dealii::ParameterHandler &prm,
               const std::string &last_remedy,
               const SubsectionRemedy &subsection_remedy = {}) const;

    /// The message with the file before it, and the line if it begins with entry_name() of an entry that the file sets.
    InputError error(const std::string &message) const;

  private:
    enum class Kind
    {
      subsection,
      end,
      set
    };

    struct Statement
    {
      Kind kind;
      std::string file;
      unsigned int line;
      std::string path; ///< subsection it stands in, such as Soil/Initial state
      std::string name, value;
      std::string path_of_file = ""; ///< that the value names, from the working folder; empty if it names none

      InputError error(const std::string &message) const;
    };

    /// What is open where the reader is.
    struct Open
    {
      std::vector<Statement> subsections;
      std::vector<std::string> files; ///< each included by the one before
    };

    static std::string text_of(const std::vector<Statement> &statements);
    void read(const std::string &text, const std::string &file, Open &open);
    void read_line(const std::string &line, const Statement &place, Open &open);
    void include(const std::string &name, const Statement &place, Open &open);

    /// The last statement that sets the entry; null if there is none.
    const Statement *find(const std::string &subsection, const std::string &entry) const;

    std::string file_name, whole_text;
    std::vector<Statement> statements, left_out;
  };
} // namespace scree

#endif

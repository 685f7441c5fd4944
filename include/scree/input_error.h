// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_input_error_h
#define scree_input_error_h

#include <deal.II/base/parameter_handler.h>

#include <mpi.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace scree
{
  /// A fault of the user's input; what() is the whole message. All ranks throw it alike, so that one can speak for all.
  class InputError : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };

  /// An InputError that names the entry but not the file; InputFile::error() completes it.
  class EntryError : public InputError
  {
  public:
    using InputError::InputError;
  };

  /// `subsection Soil/Initial state, entry "K0"`, as messages begin; an empty path is the top of the file.
  std::string entry_name(const std::string &subsection, const std::string &entry);

  /// Throws EntryError that names subsection, entry, value and the given remedy, unless the value is `possible`.
  void require_entry(const bool possible,
                     const std::string &subsection,
                     const std::string &entry,
                     const std::string &value,
                     const std::string &remedy);

  /// A number as a user would write it.
  std::string number_text(const double value);

  /// Several numbers, separated by commas.
  std::string number_text(const std::vector<double> &values);

  /// What an exception of deal.II says, without its banner and in one line.
  std::string plain_text(const dealii::ExceptionBase &error);

  /// Throws EntryError on all ranks if any rank has found a `fault` (not empty). Collective.
  void throw_on_all_ranks(const std::string &fault, const MPI_Comm communicator);

  /// The statements of a `.prm` file: finds faults before deal.II does, and says where they are and what helps.
  class InputFile
  {
  public:
    /// No file.
    InputFile() = default;

    /// Reads `file` and the files it includes. Throws InputError at what is no statement and at open subsections.
    explicit InputFile(const std::string &file);

    /// The text of the file as it was read.
    const std::string &text() const
    {
      return whole_text;
    }

    /// The value of an entry outside subsections, or `otherwise` if the file does not set it.
    std::string value(const std::string &entry, const std::string &otherwise) const;

    /// Throws InputError at the first entry or subsection that `prm` does not declare, and at the first value that does
    /// not fit; suggests the closest declared name.
    void check(const dealii::ParameterHandler &prm) const;

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

      InputError error(const std::string &message) const;
    };

    void read(const std::string &text, const std::string &file, std::vector<Statement> &open);
    void read_line(const std::string &line, const Statement &place, std::vector<Statement> &open);

    std::string file_name, whole_text;
    std::vector<Statement> statements;
  };
} // namespace scree

#endif

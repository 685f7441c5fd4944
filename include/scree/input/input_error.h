// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_input_input_error_h
#define scree_input_input_error_h

#include <deal.II/base/exceptions.h>
#include <deal.II/base/point.h>

#include <boost/algorithm/string/join.hpp>
#include <mpi.h>

#include <stdexcept>
#include <string>
#include <type_traits>
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

  /// An entry whose value fails at one place or time, which a single rank may meet; what() is the whole message.
  class ValueError : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };

  /// `Soil/Initial state` of `Soil` and `Initial state`; an empty path is the top of the file.
  std::string subsection_path(const std::string &path, const std::string &name);

  /// `subsection Soil/Initial state, entry "K0"`, as messages begin; an empty path is the top of the file.
  std::string entry_name(const std::string &subsection, const std::string &entry);

  /// The number that a text is; NaN if it is none.
  double number_of(const std::string &text);

  /// A number as a user would write it.
  std::string number_text(const double value);

  /// A coordinate, m: those of maps, of some 1e6 m, to the centimetre.
  std::string coordinate_text(const double value);

  /// An entry with its value, as messages begin.
  struct EntryValue
  {
    std::string subsection, ///< path; empty at the top of the file
        entry,              ///< its name
        value;              ///< as text

    /// A value that is a text.
    EntryValue(const std::string &subsection, const std::string &entry, const std::string &value)
        : subsection(subsection)
        , entry(entry)
        , value(value)
    {
    }
    /// A value that is a number.
    template <typename Number, typename = std::enable_if_t<std::is_arithmetic_v<Number>>>
    EntryValue(const std::string &subsection, const std::string &entry, const Number value)
        : EntryValue(subsection, entry, number_text(double(value)))
    {
    }
  };

  /// entry_name(), value and remedy: `entry "Colour" = red: there is no such entry.`
  std::string entry_message(const EntryValue &entry, const std::string &remedy);

  /// Throws EntryError with the entry_message() unless the value is `possible`.
  void require_entry(const bool possible, const EntryValue &entry, const std::string &remedy);

  /// Several numbers, separated by commas.
  std::string number_text(const std::vector<double> &values);

  /// The coordinates of a place.
  template <int dim>
  std::string number_text(const dealii::Point<dim> &x)
  {
    return number_text(std::vector<double>(&x[0], &x[0] + dim));
  }

  /// The names of all of them.
  template <typename Named>
  std::vector<std::string> names_of(const Named &all)
  {
    std::vector<std::string> names;
    for (const auto &one : all)
      names.push_back(one.name);
    return names;
  }

  /// The text between double quotes.
  std::string quoted(const std::string &text);

  /// The text with lower-case ASCII letters.
  std::string lower_case(std::string text);

  /// One blank for tabs, ends of lines and several blanks, as deal.II reads a line.
  std::string single_blanks(const std::string &text);

  /// What an exception of deal.II says, without its banner and in one line.
  std::string plain_text(const dealii::ExceptionBase &error);

  /// The fault of the first rank that has one, on all ranks; empty: none has. Collective.
  std::string first_fault(const std::string &fault, const MPI_Comm communicator);

  /// Throws EntryError on all ranks if any rank has found a `fault` (not empty). Collective.
  void throw_on_all_ranks(const std::string &fault, const MPI_Comm communicator);

  /// Does `work`, in which ranks do not wait for each other; a ValueError of any rank becomes an EntryError of all.
  /// Collective.
  template <typename Work>
  void on_all_ranks(const MPI_Comm communicator, const Work &work)
  {
    std::string fault;
    try
      {
        work();
      }
    catch (const ValueError &error)
      {
        fault = error.what();
      }
    throw_on_all_ranks(fault, communicator);
  }
} // namespace scree

#endif

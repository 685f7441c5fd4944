// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/input/input_error.h>

#include <deal.II/base/mpi.h>

#include <boost/algorithm/string/trim_all.hpp>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <iomanip>
#include <limits>
#include <sstream>

namespace scree
{
  using namespace dealii;

  std::string subsection_path(const std::string &path, const std::string &name)
  {
    return path.empty() ? name : path + '/' + name;
  }


  std::string entry_name(const std::string &subsection, const std::string &entry)
  {
    return (subsection.empty() ? "" : "subsection " + subsection + ", ") + "entry " + quoted(entry);
  }


  std::string entry_message(const EntryValue &entry, const std::string &remedy)
  {
    return entry_name(entry.subsection, entry.entry) + " = " + (entry.value.empty() ? "(empty)" : entry.value) + ": " +
           remedy;
  }


  void require_entry(const bool possible, const EntryValue &entry, const std::string &remedy)
  {
    if (!possible)
      throw EntryError(entry_message(entry, remedy));
  }


  double number_of(const std::string &text)
  {
    char *end           = nullptr;
    const double number = std::strtod(text.c_str(), &end);
    return text.empty() || *end != 0 ? std::numeric_limits<double>::quiet_NaN() : number;
  }


  std::string number_text(const double value)
  {
    std::ostringstream text;
    text << value;
    return text.str();
  }


  std::string coordinate_text(const double value)
  {
    std::ostringstream text;
    text << std::setprecision(std::abs(value) < 1e5 ? 6 : 9) << value;
    return text.str();
  }


  std::string number_text(const std::vector<double> &values)
  {
    std::vector<std::string> words;
    for (const double value : values)
      words.push_back(coordinate_text(value));
    return boost::algorithm::join(words, ", ");
  }


  std::string quoted(const std::string &text)
  {
    return '"' + text + '"';
  }


  std::string lower_case(std::string text)
  {
    std::transform(text.begin(), text.end(), text.begin(), [](const unsigned char c) { return std::tolower(c); });
    return text;
  }


  std::string single_blanks(const std::string &text)
  {
    return boost::algorithm::trim_fill_copy(text, " ");
  }


  std::string plain_text(const ExceptionBase &error)
  {
    std::ostringstream text;
    error.print_info(text);
    return single_blanks(text.str());
  }


  std::string first_fault(const std::string &fault, const MPI_Comm communicator)
  {
    const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(communicator);
    const unsigned int rank    = Utilities::MPI::this_mpi_process(communicator);
    const unsigned int first   = Utilities::MPI::min(fault.empty() ? n_ranks : rank, communicator);
    return first < n_ranks ? Utilities::MPI::broadcast(communicator, fault, first) : "";
  }


  void throw_on_all_ranks(const std::string &fault, const MPI_Comm communicator)
  {
    if (const std::string first = first_fault(fault, communicator); !first.empty())
      throw EntryError(first);
  }
} // namespace scree

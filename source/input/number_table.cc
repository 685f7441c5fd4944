// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/input/input_error.h>
#include <scree/input/number_table.h>

#include <cmath>
#include <regex>
#include <sstream>
#include <utility>

namespace scree
{
  namespace
  {
    /// The numbers of a line; NaN where a word is none.
    std::vector<double> numbers_of(std::string line)
    {
      line = line.substr(0, line.find('#'));
      std::replace(line.begin(), line.end(), ',', ' ');
      std::istringstream words(line);
      std::vector<double> numbers;
      for (std::string word; words >> word;)
        numbers.push_back(number_of(word));
      return numbers;
    }
  } // namespace


  std::ifstream open_file(const std::string &file, const std::string &name)
  {
    std::ifstream in(file);
    if (!in)
      throw EntryError(
          name + "the file cannot be read. Write its path from the folder of the file in which the entry stands.");
    if (in.peek() == 0xEF) // A mark of byte order may come first.
      {
        char mark[3];
        if (!in.read(mark, 3) || mark[1] != '\xBB' || mark[2] != '\xBF')
          {
            in.clear();
            in.seekg(0);
          }
      }
    return in;
  }


  std::vector<std::vector<double>> read_number_table(const std::string &file,
                                                     const std::string &where,
                                                     const std::vector<std::string> &columns,
                                                     const FirstColumn first_column)
  {
    const std::string name   = where + " = " + file + ": ";
    const std::string wanted = boost::algorithm::join(columns, ", ");
    std::ifstream in         = open_file(file, name);

    std::vector<std::vector<double>> rows;
    bool may_name_columns = true;
    std::string line;
    for (unsigned int number = 1; std::getline(in, line); ++number)
      {
        const std::vector<double> row = numbers_of(line);
        if (row.empty())
          continue;
        const auto is_number = [](const double value) { return std::isfinite(value); };
        const bool is_whole  = row.size() == columns.size() && std::all_of(row.begin(), row.end(), is_number);
        if (std::exchange(may_name_columns, false) && std::none_of(row.begin(), row.end(), is_number))
          continue;
        const std::string place = name + "line " + std::to_string(number) + ' ';
        if (!is_whole)
          throw EntryError(
              place + "is no row of " + std::to_string(columns.size()) + " numbers. Write " + wanted +
              " in each line, separated by commas" +
              (std::regex_search(line, std::regex("[0-9],[0-9]")) ? "; decimals have a point: 0.5, not 0,5." : "."));
        if (first_column == FirstColumn::ascending && !rows.empty() && !(row[0] > rows.back()[0]))
          throw EntryError(place + "has " + number_text(row[0]) + " after " + number_text(rows.back()[0]) +
                           " in the first column. Sort the rows by ascending " + columns[0] + ", each once.");
        rows.push_back(row);
      }
    if (rows.size() < 2)
      throw EntryError(name + "there are fewer than two rows. Write " + wanted + " in each line.");
    return rows;
  }
} // namespace scree

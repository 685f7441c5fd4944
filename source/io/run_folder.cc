// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/io/progress.h>
#include <scree/io/run_folder.h>

#include <boost/algorithm/string/trim.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <regex>

namespace scree
{
  using namespace dealii;

  void RunFolder::remove_old_results()
  {
    if (writer)
      {
        const auto remove_files =
            [this](const std::string &folder, const std::string &begin, const std::set<std::string> &extensions) {
              std::error_code is_missing;
              for (const auto &entry : std::filesystem::directory_iterator(file(folder), is_missing))
                if (entry.is_regular_file() && extensions.count(entry.path().extension()) > 0 &&
                    entry.path().filename().string().rfind(begin, 0) == 0)
                  std::filesystem::remove(entry.path());
            };
        remove_files("solution", "", { ".vtu", ".pvtu", ".pvd" });
        remove_files("maps", "", { ".asc", ".prj", ".tif", ".csv" });
        for (const std::string name : { "statistics", "statistics.csv", "checks.csv" })
          std::filesystem::remove(file(name));
        remove_files(".", "probe_", { "", ".csv" });
        std::filesystem::remove_all(file("checkpoint"));
        log_file.close();
        log_file.open(file("log.txt"), std::ios::trunc);
      }
    MPI_Barrier(communicator); // Nobody may write before the old is gone.
  }


  void RunFolder::try_to_write(const std::string &name, const std::function<void()> &write)
  {
    if (!writer)
      return;
    try
      {
        write();
        if (refused.erase(name) > 0)
          log(file(name) + ": is written again, and nothing of it is missing.");
      }
    catch (const FileError &error)
      {
        if (is_present()) // or else require_presence() reports it
          tell_once(name, std::string(error.what()) + " The run goes on, and tries again each time.");
      }
  }


  std::string table_head(const std::vector<std::string> &columns)
  {
    std::string lines;
    for (unsigned int i = 0; i < columns.size(); ++i)
      lines += "# " + std::to_string(i + 1) + ": " + columns[i] + '\n';
    return lines;
  }


  std::string table_row(const std::vector<double> &values)
  {
    std::string line;
    for (const double value : values)
      line += formatted("%.12e ", value);
    return line + '\n';
  }


  std::string csv_name(const std::string &column)
  {
    static const std::regex with_unit("(.*) \\((.*)\\)"), not_of_unit("[^A-Za-z0-9/]"),
        not_of_word("[\\x01-/:-@\\[-`{-\\x7F]+"); // letters may lie beyond ASCII
    std::smatch parts;
    const bool has_unit     = std::regex_match(column, parts, with_unit);
    const std::string words = std::regex_replace(lower_case(has_unit ? parts[1] : column), not_of_word, "_");
    const std::string name  = boost::algorithm::trim_copy_if(words, [](const char c) { return c == '_'; });
    std::string unit        = has_unit ? parts[2] : std::string();
    unit                    = unit == "%" ? "percent" : std::regex_replace(unit, not_of_unit, "");
    std::replace(unit.begin(), unit.end(), '/', '_');
    return unit.empty() ? name : name + '_' + unit;
  }


  std::string csv_head(const std::vector<std::string> &columns)
  {
    std::vector<std::string> names;
    for (const std::string &column : columns)
      {
        const std::string wanted = csv_name(column);
        std::string name         = wanted;
        for (unsigned int n = 2; std::find(names.begin(), names.end(), name) != names.end(); ++n)
          name = wanted + '_' + std::to_string(n);
        names.push_back(name);
      }
    return boost::algorithm::join(names, ",") + '\n';
  }


  std::string csv_row(const std::vector<double> &values)
  {
    std::vector<std::string> words;
    for (const double value : values)
      words.push_back(std::isnan(value) ? "nan" : formatted("%.13g", value)); // some machines would write -nan
    return boost::algorithm::join(words, ",") + '\n';
  }


  void TableFile::append(const std::vector<std::string> &columns, const std::vector<std::vector<double>> &rows)
  {
    if (!folder.is_writer())
      return;
    for (File &file : files)
      {
        std::string text = file.rows.is_empty() ? file.head(columns) : "";
        for (const std::vector<double> &row : rows)
          text += file.row(row);
        folder.try_to_write(file.name, [&] { file.rows.append(text); });
      }
  }


  void TableFile::cut()
  {
    if (!folder.is_writer())
      return;
    for (File &file : files)
      if (const std::string missing = file.rows.cut(); !missing.empty())
        folder.log(missing);
  }


  void TableFile::complete()
  {
    if (!folder.is_writer())
      return;
    std::optional<FileError> refusal;
    for (File &file : files)
      try
        {
          if (!file.rows.is_complete())
            file.rows.append("");
        }
      catch (const FileError &error)
        {
          refusal = refusal.value_or(error); // the other file may have room
        }
    if (refusal)
      throw *refusal;
  }
} // namespace scree

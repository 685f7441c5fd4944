// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/io/progress.h>
#include <scree/io/run_folder.h>

#include <boost/algorithm/string/join.hpp>
#include <boost/algorithm/string/replace.hpp>

#include <cmath>

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
        for (const std::string name : { "statistics.csv", "checks.csv" })
          std::filesystem::remove(file(name));
        remove_files(".", "probe_", { ".csv" });
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


  std::string csv_head(const std::vector<std::string> &columns)
  {
    std::vector<std::string> names = columns;
    for (std::string &name : names)
      if (name.find_first_of(",\"") != std::string::npos) // from the name of an obstacle
        name = '"' + boost::algorithm::replace_all_copy(name, "\"", "\"\"") + '"';
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
    std::string text = file.is_empty() ? csv_head(columns) : "";
    for (const std::vector<double> &row : rows)
      text += csv_row(row);
    folder.try_to_write(name, [&] { file.append(text); });
  }
} // namespace scree

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_io_table_file_h
#define scree_io_table_file_h

#include <scree/io/row_file.h>
#include <scree/io/run_folder.h>

#include <string>
#include <vector>

namespace scree
{
  /// The lines `# NUMBER: NAME (UNIT)` that name the columns of a table.
  std::string table_head(const std::vector<std::string> &columns);

  /// A row of a table, with its end of line.
  std::string table_row(const std::vector<double> &values);

  /// The name of a column in a `.csv`: words in lower case, then the unit as it is, joined by `_`. `Front 90 % (m)` is
  /// `front_90_m`, `Stress oscillation (-)` is `stress_oscillation`. In units, `/` becomes `_`, and blanks and `^` are
  /// left out: `Momentum x (N s)` is `momentum_x_Ns`, a density in kg/m^3 ends in `_kg_m3`; % is `percent`.
  std::string csv_name(const std::string &column);

  /// The line that names the columns of a `.csv`; of equal names the second one ends in `_2`.
  std::string csv_head(const std::vector<std::string> &columns);

  /// A row of a `.csv`: numbers with 13 digits, separated by commas; `nan` where there is none.
  std::string csv_row(const std::vector<double> &values);

  /// A table of a run that grows by rows, in two files with the same numbers: `NAME` with aligned numbers, and
  /// `NAME.csv`. Both go on where they were when a run is resumed, see RowFile. The rank that writes holds the rows.
  class TableFile
  {
  public:
    /// @param folder is kept by reference
    /// @param name of the first file in the folder
    TableFile(RunFolder &folder, const std::string &name);

    /// Adds rows, below the names of the columns if they are the first ones. If the disk does not take them, standard
    /// error has that once, and they are written with the next ones.
    void append(const std::vector<std::string> &columns, const std::vector<std::vector<double>> &rows);

    /// Brings the rows to the disk, before a checkpoint counts on them.
    void sync();

    /// After the state has been read from a checkpoint: cuts off the rows that were written after it.
    void cut();

    /// Writes rows that the disk did not take. Throws FileError if it still refuses them.
    void complete();

    /// Saves or loads the state of the files (Boost).
    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      for (File &file : files)
        archive &file.rows;
    }

  private:
    struct File
    {
      std::string name;
      std::string (*head)(const std::vector<std::string> &columns);
      std::string (*row)(const std::vector<double> &values);
      RowFile rows;
    };

    RunFolder &folder;
    std::vector<File> files;
  };
} // namespace scree

#endif

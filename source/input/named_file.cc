// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/input/checksum.h>
#include <scree/input/named_file.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace scree
{
  using namespace dealii;

  void
  add_file_entry(ParameterHandler &prm, const std::string &entry, std::string &path, const std::string &documentation)
  {
    prm.add_parameter(entry,
                      path,
                      documentation + " The path is relative to the folder of the case file.",
                      Patterns::FileName(Patterns::FileName::input));
  }


  bool is_file_pattern(const std::string &pattern)
  {
    return pattern == Patterns::FileName(Patterns::FileName::input).description();
  }


  std::string path_beside(const std::string &reader, const std::string &file)
  {
    return file.empty() ? file : (std::filesystem::path(reader).parent_path() / file).string();
  }


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
} // namespace scree

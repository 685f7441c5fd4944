// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/input/checksum.h>
#include <scree/io/checkpoint_files.h>
#include <scree/io/whole_file.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <iomanip>
#include <limits>
#include <map>
#include <sstream>

namespace scree
{
  namespace
  {
    namespace fs = std::filesystem;

    const std::string name_of_manifest = "manifest", name_of_step = "step-";
    const std::string format_line    = "Scree checkpoint, format 17";
    const std::string checksum_label = "checksum: ";

    std::uint64_t checksum_of(const std::string &content)
    {
      Checksum checksum;
      checksum.process_bytes(content.data(), content.size());
      return checksum.checksum();
    }

    std::string checksum_line(const std::string &text)
    {
      std::ostringstream line;
      line << checksum_label << std::hex << std::setw(16) << std::setfill('0') << checksum_of(text) << '\n';
      return line.str();
    }

    /// The number behind `step-`, or -1.
    long long step_of(const fs::path &folder)
    {
      const std::string name = folder.filename();
      std::istringstream digits(name.rfind(name_of_step, 0) == 0 ? name.substr(name_of_step.size()) : "");
      long long step = -1;
      digits >> step;
      return digits && digits.eof() ? step : -1;
    }

    void remove_folder(const std::string &folder)
    {
      std::error_code error;
      fs::remove_all(folder, error);
      if (error)
        throw FileError(folder + ": cannot be removed: " + error.message());
    }
  } // namespace


  CheckedFile checked_file(const std::string &name, const std::string &content)
  {
    return { name, content.size(), checksum_of(content) };
  }


  std::string read_checked_file(const std::string &folder, const CheckedFile &file)
  {
    const std::string path = folder + '/' + file.name;
    std::error_code error;
    if (const auto size = fs::file_size(path, error); !error && size != file.size)
      throw FileError(path + ": has " + std::to_string(size) + " bytes, but " + std::to_string(file.size) +
                      " were written");
    std::string content = read_whole_file(path);
    if (content.size() != file.size || checksum_of(content) != file.checksum)
      throw FileError(path + ": is not what was written (its checksum differs)");
    return content;
  }


  void Manifest::write(const std::string &folder) const
  {
    std::ostringstream text;
    text << std::setprecision(std::numeric_limits<double>::max_digits10) << format_line << "\nprogram: " << program
         << "\ndimension: " << dimension << "\ntime: " << time << "\nstep: " << step << '\n';
    for (const CheckedFile &file : files)
      text << "file: " << file.name << ' ' << file.size << ' ' << std::hex << file.checksum << std::dec << '\n';
    const std::string content = text.str() + checksum_line(text.str());
    write_whole_file(folder + '/' + name_of_manifest, content);
    read_checked_file(folder, checked_file(name_of_manifest, content));
  }


  Manifest Manifest::read(const std::string &folder)
  {
    const std::string path = folder + '/' + name_of_manifest, text = read_whole_file(path);
    const std::size_t end  = std::min(text.rfind(checksum_label), text.size());
    const std::string head = text.substr(0, end);
    if (text.substr(end) != checksum_line(head))
      throw FileError(path + ": is not what was written (its checksum differs)");

    std::istringstream in(head);
    std::string line, label;
    std::getline(in, line);
    if (line != format_line)
      throw FileError(path + ": begins with \"" + line + "\", but this program reads \"" + format_line + '"');
    Manifest manifest;
    in >> label >> std::ws;
    std::getline(in, manifest.program);
    in >> label >> manifest.dimension >> label >> manifest.time >> label >> manifest.step;
    CheckedFile file;
    while (in >> label >> file.name >> file.size >> std::hex >> file.checksum >> std::dec)
      manifest.files.push_back(file);
    if (const auto step = step_of(folder); step >= 0 && std::uint64_t(step) != manifest.step)
      throw FileError(path + ": belongs to step " + std::to_string(manifest.step) + ", not to this folder");
    return manifest;
  }


  const CheckedFile &Manifest::file(const std::string &name) const
  {
    const auto found =
        std::find_if(files.begin(), files.end(), [&](const CheckedFile &file) { return file.name == name; });
    if (found == files.end())
      throw FileError(name_of_manifest + ": names no file " + name);
    return *found;
  }


  std::uint64_t Manifest::size() const
  {
    std::uint64_t sum = 0;
    for (const CheckedFile &file : files)
      sum += file.size;
    return sum;
  }


  CheckpointFolder::CheckpointFolder(const std::string &run_folder)
      : unfinished(run_folder + "/checkpoint/unfinished")
      , folder(run_folder + "/checkpoint")
  {
  }


  std::string CheckpointFolder::begin() const
  {
    abandon();
    std::error_code error;
    fs::create_directories(unfinished, error);
    if (error)
      {
        errno = error.value();
        throw error_of_writing(unfinished, 0);
      }
    return unfinished;
  }


  void CheckpointFolder::finish(const Manifest &manifest) const
  {
    manifest.write(unfinished);
    const std::string name = folder + '/' + name_of_step + std::to_string(manifest.step);
    // One of that name is of another future: a damaged one, or the run went on from an older one.
    remove_folder(name);
    if (std::rename(unfinished.c_str(), name.c_str()) != 0)
      throw error_of_writing(name, manifest.size());
    sync_folder(folder);

    unsigned int n_older = 0;
    for (const std::string &other : all())
      if (const auto step = std::uint64_t(step_of(other));
          step != manifest.step && (step > manifest.step || n_older++ > 0))
        remove_folder(other);
  }


  void CheckpointFolder::abandon() const
  {
    std::error_code ignored;
    fs::remove_all(unfinished, ignored);
  }


  std::vector<std::string> CheckpointFolder::all() const
  {
    std::map<long long, std::string, std::greater<>> folders;
    std::error_code error;
    for (const auto &entry : fs::directory_iterator(folder, error))
      if (const long long step = step_of(entry.path()); step >= 0)
        folders[step] = entry.path();
    std::vector<std::string> result;
    for (const auto &[step, path] : folders)
      result.push_back(path);
    return result;
  }


  std::vector<std::string> CheckpointFolder::whole() const
  {
    std::vector<std::string> result;
    for (const std::string &path : all())
      try
        {
          for (const CheckedFile &file : Manifest::read(path).files)
            read_checked_file(path, file);
          result.push_back(path);
        }
      catch (const FileError &)
        {
        }
    return result;
  }
} // namespace scree

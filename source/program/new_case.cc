// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/input/input_error.h>
#include <scree/input/suggestions.h>
#include <scree/program/new_case.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <vector>

namespace scree
{
  using namespace dealii;

  namespace
  {
    namespace fs = std::filesystem;

    /// A file of a scene: the case, which comes first, or one that it names.
    struct SceneFile
    {
      const char *scene, *name, *text;
    };

    const SceneFile scene_files[] = {
#include <scene_files.h> // made of files of prm/, see source/cmake/scene_files.cmake
    };


    std::vector<SceneFile> files_of(const std::string &scene)
    {
      std::vector<SceneFile> files;
      for (const SceneFile &file : scene_files)
        if (file.scene == scene)
          files.push_back(file);
      return files;
    }


    std::vector<std::string> names_of_scenes()
    {
      std::vector<std::string> names;
      for (const SceneFile &file : scene_files)
        if (names.empty() || names.back() != file.scene)
          names.push_back(file.scene);
      return names;
    }


    std::string content_of(const fs::path &file)
    {
      std::ifstream in(file, std::ios::binary);
      return { std::istreambuf_iterator<char>(in), {} };
    }


    /// Writes what is not there yet; returns what is wrong, in words, or nothing.
    std::string write_files(const std::vector<std::pair<fs::path, std::string>> &files, const bool overwrite)
    {
      for (const auto &[path, text] : files)
        if (!overwrite && fs::exists(path) && content_of(path) != text)
          return path.string() + ": the file exists. " +
                 (path == files[0].first
                      ? "Choose another name (scree --new SCENE other.prm)"
                      : "The case needs it. Choose another folder (scree --new SCENE folder/case.prm)") +
                 ", or replace it with \"--overwrite\".";
      for (const auto &[path, text] : files)
        {
          std::ofstream out(path, std::ios::binary);
          out << text;
          if (!out.flush())
            return path.string() + ": the file cannot be written. Go to a folder in which you may write.";
        }
      return "";
    }
  } // namespace


  std::string list_of_scenes()
  {
    std::string list = "Scenes for scree --new SCENE:\n";
    for (const std::string &name : names_of_scenes())
      {
        const std::string text        = files_of(name).front().text;
        const std::size_t first       = text.find_first_not_of("# ");
        const std::string description = text.substr(first, text.find('\n') - first);
        list += "  " + name + std::string(std::max<std::size_t>(12, name.size() + 1) - name.size(), ' ') + description +
                '\n';
      }
    return list;
  }


  std::string
  write_new_case(const std::string &scene, const std::string &file, const bool overwrite, const MPI_Comm communicator)
  {
    const std::vector<SceneFile> of_scene = files_of(scene);
    if (of_scene.empty())
      {
        const auto close = nearest(names_of_scenes(), scene);
        throw InputError("command line: there is no scene " + quoted(scene) + '.' +
                         (close.empty() ? "" : " Did you mean " + quoted(close.front()) + '?') +
                         " scree --new lists all of them.");
      }
    const fs::path case_file = file.empty() ? scene + ".prm" : file;
    std::vector<std::pair<fs::path, std::string>> files;
    for (const SceneFile &one : of_scene)
      files.emplace_back(files.empty() ? case_file : case_file.parent_path() / one.name, one.text);
    files[0].second = std::regex_replace(
        files[0].second, std::regex("(\n *set Output directory *= ).*"), "$1results/" + case_file.stem().string());

    const bool writes = Utilities::MPI::this_mpi_process(communicator) == 0;
    const std::string fault =
        Utilities::MPI::broadcast(communicator, writes ? write_files(files, overwrite) : std::string());
    if (!fault.empty())
      throw InputError(fault);
    std::string text = "Written:";
    for (const auto &[path, content] : files)
      text += ' ' + path.string();
    return text + "\nNext: scree " + case_file.string() + " --advise, then scree " + case_file.string() + '\n';
  }
} // namespace scree

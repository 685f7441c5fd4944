// SPDX-License-Identifier: LGPL-2.1-or-later

#include <scree/element/element_driver.h>

#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>

namespace
{
  using namespace scree;

  /// Contents of `file`. Throws if it cannot be read.
  std::string read(const std::string &file)
  {
    std::ifstream in(file);
    AssertThrow(in && std::filesystem::is_regular_file(file),
                dealii::ExcMessage("The file cannot be read. Remedy: scree-element FILE.prm with an existing file; "
                                   "prm/element holds some."));
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
  }


  /// Path of the subsection that is open in line `n_lines` of `text`; deal.II's messages name the line only.
  std::string subsection_at(const std::string &text, const unsigned int n_lines)
  {
    std::vector<std::string> open;
    std::istringstream in(text);
    std::string line;
    for (unsigned int i = 1; i < n_lines && std::getline(in, line); ++i)
      {
        std::istringstream words(line);
        std::string word, name;
        words >> word;
        std::getline(words >> std::ws, name);
        if (word == "subsection")
          open.push_back(name);
        else if (word == "end" && !open.empty())
          open.pop_back();
      }
    std::string path;
    for (const std::string &name : open)
      path += (path.empty() ? "" : "/") + name;
    return path.empty() ? "(top)" : path;
  }


  /// Read `text`, the contents of `file`, into the entries of `prm`. Throws naming line, subsection and entry.
  void parse(const std::string &text, const std::string &file, dealii::ParameterHandler &prm)
  {
    std::istringstream in(text);
    try
      {
        prm.parse_input(in, file);
      }
    catch (const dealii::ExceptionBase &error)
      {
        std::ostringstream message;
        error.print_info(message);
        const std::string mark = "Line <";
        const std::size_t line = message.str().find(mark);
        if (line != std::string::npos)
          message << "    This is in subsection "
                  << subsection_at(text, std::stoul(message.str().substr(line + mark.size()))) << ".\n";
        throw std::runtime_error(message.str() +
                                 "    Remedy: correct the line; scree-element --help lists all entries.");
      }
  }


  /// `text` into `directory`/`name`.
  void write(const std::string &directory, const std::string &name, const std::string &text)
  {
    const std::filesystem::path file = std::filesystem::path(directory) / name;
    std::ofstream out(file);
    out << text;
    AssertThrow(out.flush(),
                dealii::ExcMessage("entry \"Output directory\" = " + directory + ": " + name +
                                   " cannot be written there. Remedy: a directory you may write to."));
  }


  void run(const std::string &file)
  {
    const std::string original = read(file);
    dealii::ParameterHandler prm;
    ElementParameters parameters;
    parameters.add_parameters(prm);
    parse(original, file, prm);
    parameters.check();

    ElementDriver driver(parameters);
    driver.run();

    std::error_code failure; // write() tells.
    std::filesystem::create_directories(parameters.output_directory, failure);
    std::ostringstream table, all_entries;
    driver.write_table(table);
    prm.print_parameters(all_entries, dealii::ParameterHandler::PRM);
    write(parameters.output_directory, "table.txt", table.str());
    write(parameters.output_directory, "original.prm", original);
    write(parameters.output_directory, "parameters.prm", all_entries.str());
    driver.print_summary(std::cout);
  }


  void print_help()
  {
    std::cout << "scree-element FILE.prm\n\n"
                 "One material point along the path of a laboratory test. All entries and their defaults:\n\n";
    dealii::ParameterHandler prm;
    ElementParameters parameters;
    parameters.add_parameters(prm);
    prm.print_parameters(std::cout, dealii::ParameterHandler::PRM);
  }
} // namespace


int main(int argc, char *argv[])
{
  const std::string argument = argc == 2 ? argv[1] : "";
  if (argument == "--help")
    {
      print_help();
      return 0;
    }
  if (argument.empty())
    {
      std::cerr << "scree-element needs one argument. Remedy: scree-element FILE.prm, or scree-element --help.\n";
      return 1;
    }
  try
    {
      run(argument);
    }
  catch (const dealii::ExceptionBase &error)
    {
      std::cerr << "scree-element: " << argument << ":\n";
      error.print_info(std::cerr);
      return 1;
    }
  catch (const std::exception &error)
    {
      std::cerr << "scree-element: " << argument << ":\n" << error.what() << '\n';
      return 1;
    }
  return 0;
}

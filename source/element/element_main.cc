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
  std::string
  read(const std::string &file)
  {
    std::ifstream in(file);
    AssertThrow(in && std::filesystem::is_regular_file(file),
                dealii::ExcMessage("The file cannot be read. Remedy: scree-element FILE.prm with an existing file; "
                                   "prm/element holds some."));
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
  }


  /// `text` into `directory`/`name`.
  void
  write(const std::string &directory, const std::string &name, const std::string &text)
  {
    const std::filesystem::path file = std::filesystem::path(directory) / name;
    std::ofstream out(file);
    out << text;
    AssertThrow(out.flush(),
                dealii::ExcMessage("entry \"Output directory\" = " + directory + ": " + name +
                                   " cannot be written there. Remedy: a directory you may write to."));
  }


  void
  run(const std::string &file)
  {
    const std::string original = read(file);
    dealii::ParameterHandler prm;
    ElementParameters parameters;
    parameters.add_parameters(prm);
    std::istringstream in(original);
    prm.parse_input(in, file);
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


  void
  print_help()
  {
    std::cout << "scree-element FILE.prm\n\n"
                 "One material point along the path of a laboratory test. All entries and their defaults:\n\n";
    dealii::ParameterHandler prm;
    ElementParameters parameters;
    parameters.add_parameters(prm);
    prm.print_parameters(std::cout, dealii::ParameterHandler::PRM);
  }
} // namespace


int
main(int argc, char *argv[])
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
      std::cerr << "scree-element --help lists all entries.\n";
      return 1;
    }
  catch (const std::exception &error)
    {
      std::cerr << "scree-element: " << argument << ":\n" << error.what() << '\n';
      return 1;
    }
  return 0;
}

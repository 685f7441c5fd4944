// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/element/element_command_line.h>
#include <scree/element/element_driver.h>
#include <scree/input/input_file.h>
#include <scree/input/suggestions.h>
#include <scree/version.h>

#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>

namespace scree
{
  namespace
  {
    /// `text` into `directory`/`name`.
    void write(const std::string &directory, const std::string &name, const std::string &text)
    {
      const std::filesystem::path file = std::filesystem::path(directory) / name;
      std::ofstream out(file);
      out << text;
      require_entry(bool(out.flush()),
                    "",
                    "Output directory",
                    directory,
                    name + " cannot be written there. Name a folder in which you may write.");
    }


    void run(const InputFile &input)
    {
      dealii::ParameterHandler prm;
      ElementParameters parameters;
      parameters.add_parameters(prm);
      input.check(prm, "scree-element --help lists all of them.");
      prm.parse_input_from_string(input.statements_text());
      parameters.check();

      ElementDriver driver(parameters);
      driver.run();

      std::error_code failure; // write() tells.
      std::filesystem::create_directories(parameters.output_directory, failure);
      std::ostringstream table, all_entries;
      driver.write_table(table);
      prm.print_parameters(all_entries, dealii::ParameterHandler::PRM);
      write(parameters.output_directory, "table.txt", table.str());
      write(parameters.output_directory, "original.prm", input.text());
      write(parameters.output_directory, "parameters.prm", all_entries.str());
      driver.print_summary(std::cout);
    }


    void run(const std::string &file)
    {
      const InputFile input(file);
      try
        {
          run(input);
        }
      catch (const EntryError &error)
        {
          throw input.error(error.what());
        }
      catch (const dealii::ExceptionBase &error)
        {
          throw input.error(plain_text(error));
        }
    }


    void print_help()
    {
      std::cout << "Usage: scree-element FILE.prm     run a path\n"
                   "       scree-element --version    version and commit, libraries, compiler\n"
                   "       scree-element --help, -h   this text\n\n"
                   "One material point along the path of a laboratory test. All entries and their defaults:\n\n";
      dealii::ParameterHandler prm;
      ElementParameters parameters;
      parameters.add_parameters(prm);
      prm.print_parameters(std::cout, dealii::ParameterHandler::PRM);
    }
  } // namespace


  int run_element_command_line(const std::vector<std::string> &arguments)
  {
    const std::string argument = arguments.size() == 1 ? arguments[0] : "";
    if (argument == "--help" || argument == "-h")
      {
        print_help();
        return 0;
      }
    if (argument == "--version")
      {
        std::cout << version_text();
        return 0;
      }
    if (argument.empty())
      {
        std::cerr << "scree-element needs one argument. Remedy: scree-element FILE.prm, or scree-element --help.\n";
        return 1;
      }
    try
      {
        if (argument.rfind('-', 0) == 0)
          {
            const auto close = nearest({ "--version", "--help" }, argument);
            throw InputError("command line: there is no option " + quoted(argument) + '.' +
                             (close.empty() ? "" : " Did you mean " + quoted(close.front()) + '?') +
                             " scree-element --help lists all options.");
          }
        run(argument);
      }
    catch (const std::exception &error)
      {
        std::cerr << "scree-element: " << error.what() << '\n';
        return 1;
      }
    return 0;
  }
} // namespace scree

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/element/element_command_line.h>
#include <scree/element/element_driver.h>
#include <scree/input/input_file.h>
#include <scree/version.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>
#include <unistd.h>

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
                    { "", "Output directory", directory },
                    name + " cannot be written there. Name a folder in which you may write.");
    }


    void run(const InputFile &input)
    {
      dealii::ParameterHandler prm;
      ElementParameters parameters;
      parameters.add_parameters(prm);
      input.check(prm, "scree-element --help lists all of them.");
      prm.parse_input_from_string(input.statements_text());
      parameters.material.complete("", /* in_water */ false);
      parameters.check();

      ElementDriver driver(parameters);
      driver.run();

      std::error_code failure; // write() reports it.
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
      std::cout
          << "Usage: scree-element FILE.prm ...       run paths\n"
             "       scree-element --fit FILE.toml    fit entries of a law to laboratory tests (scree-fit --help)\n"
             "       scree-element --version          version and commit, libraries, compiler\n"
             "       scree-element --help, -h         this text\n\n"
             "One material point along the path of a laboratory test. All entries and their defaults:\n\n";
      dealii::ParameterHandler prm;
      ElementParameters parameters;
      parameters.add_parameters(prm);
      prm.print_parameters(std::cout, dealii::ParameterHandler::PRM);
    }


    /// Replaces this process by scree-fit, a command of the Python package beside this program or on the PATH. Returns
    /// only if there is none: the exit code.
    int become_fit(std::vector<std::string> arguments)
    {
      std::error_code failure; // execvp() reports it.
      const auto beside    = std::filesystem::read_symlink("/proc/self/exe", failure).replace_filename("scree-fit");
      const bool is_beside = std::filesystem::exists(beside, failure);
      arguments[0]         = is_beside ? beside.string() : "scree-fit";
      std::vector<char *> words;
      for (std::string &argument : arguments)
        words.push_back(argument.data());
      words.push_back(nullptr);
      execvp(words[0], words.data());
      std::cerr
          << "scree-element: --fit cannot start scree-fit: " << std::strerror(errno)
          << ". CMake makes this command of the Python package beside scree-element. Remedy: cmake -S . -B build, "
             "or add the folder of scree-fit to PATH.\n";
      return 1;
    }


    /// Throws an InputError if one of the arguments is an option.
    void check_files(const std::vector<std::string> &arguments)
    {
      for (const std::string &argument : arguments)
        if (argument.rfind('-', 0) == 0)
          {
            const auto close = nearest({ "--fit", "--version", "--help" }, argument);
            throw InputError("command line: " +
                             (argument == "--fit"
                                  ? std::string("--fit stands first: scree-element --fit FILE.toml.")
                                  : "there is no option " + quoted(argument) + '.' +
                                        (close.empty() ? "" : " Did you mean " + quoted(close.front()) + '?')) +
                             " scree-element --help lists all options.");
          }
    }


    /// Runs `work`; what it throws goes to standard error. Returns the exit code.
    template <typename Work>
    int exit_code_of(const Work &work)
    {
      try
        {
          work();
        }
      catch (const std::exception &error)
        {
          std::cerr << "scree-element: " << error.what() << '\n';
          return 1;
        }
      return 0;
    }
  } // namespace


  int run_element_command_line(const std::vector<std::string> &arguments)
  {
    const auto has = [&](const std::string &option) {
      return std::find(arguments.begin(), arguments.end(), option) != arguments.end();
    };
    if (arguments.empty())
      {
        std::cerr << "scree-element needs an argument. Remedy: scree-element FILE.prm, or scree-element --help.\n";
        return 1;
      }
    if (arguments[0] == "--fit")
      return become_fit(arguments);
    if (has("--help") || has("-h"))
      {
        print_help();
        return 0;
      }
    if (has("--version"))
      {
        std::cout << version_text();
        return 0;
      }
    int code = exit_code_of([&] { check_files(arguments); });
    if (code == 0)
      for (const std::string &file : arguments)
        code |= exit_code_of([&] { run(file); }); // A path that fails does not stop the others.
    return code;
  }
} // namespace scree

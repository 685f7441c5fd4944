// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/advice/advise.h>
#include <scree/program/command_line.h>
#include <scree/run/safety.h>
#include <scree/version.h>

#include <boost/algorithm/string/replace.hpp>
#include <unistd.h>

#include <cstdlib>

#include <iterator>
#include <regex>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// What a command line asks for.
    enum class Task
    {
      run,
      resume,
      safety,
      show,
      advise,
      print_parameters,
      new_case,
      version,
      help
    };

    /// A command line, read.
    struct Arguments
    {
      Task task = Task::run; ///< what to do
      std::string case_file; ///< to read; of Task::new_case to write; may be empty where the task needs none
      std::string name;      ///< subsection of Task::print_parameters, scene of Task::new_case; may be empty
      double accuracy = default_accuracy;   ///< of Task::advise, relative error
      double n_ranks  = 0;                  ///< of Task::advise; 0: those of this program
      std::string stage;                    ///< after which Task::safety searches; empty: the last one
      std::vector<std::string> options;     ///< names of all of them
      std::vector<std::string> other_words; ///< that are no options

      bool has(const std::string &option) const
      {
        return std::find(options.begin(), options.end(), option) != options.end();
      }
    };


    /// An option of the command line.
    struct Option
    {
      std::string name;
      std::optional<Task> task; ///< that it asks for; nothing: it belongs to another option
      std::string belongs_to;   ///< that option
    };

    const std::vector<Option> options{ { "--resume", Task::resume, "" },
                                       { "--safety", Task::safety, "" },
                                       { "--stage", {}, "--safety" },
                                       { "--show", Task::show, "" },
                                       { "--advise", Task::advise, "" },
                                       { "--accuracy", {}, "--advise" },
                                       { "--ranks", {}, "--advise" },
                                       { "--print-parameters", Task::print_parameters, "" },
                                       { "--json", {}, "--print-parameters" },
                                       { "--sections", {}, "--print-parameters" },
                                       { "--new", Task::new_case, "" },
                                       { "--overwrite", {}, "--new" },
                                       { "--version", Task::version, "" },
                                       { "--help", Task::help, "" },
                                       { "-h", Task::help, "" } };


    InputError fault(const std::string &text)
    {
      return InputError("command line: " + text + " scree --help lists all options.");
    }


    /// " Did you mean ...?", or nothing.
    std::string meant(const std::string &word)
    {
      const std::size_t first  = word.find_first_not_of('-');
      const std::string dashed = "--" + (first == std::string::npos ? "" : word.substr(first));
      const auto close         = nearest(names_of(options), dashed);
      return close.empty() ? "" : " Did you mean " + quoted(close.front()) + '?';
    }


    const Option &find_option(const std::string &word)
    {
      const auto found =
          std::find_if(options.begin(), options.end(), [&](const Option &option) { return option.name == word; });
      if (found == options.end())
        throw fault("there is no option " + quoted(word) + '.' + meant(word));
      return *found;
    }


    /// The words with --option=value as two.
    std::vector<std::string> split_values(const std::vector<std::string> &words)
    {
      std::vector<std::string> result;
      for (const std::string &word : words)
        if (const std::size_t equals = word.find('='); word.rfind("--", 0) == 0 && equals != std::string::npos)
          {
            result.push_back(word.substr(0, equals));
            result.push_back(word.substr(equals + 1));
          }
        else
          result.push_back(word);
      return result;
    }


    /// The options of a command line, and the words that are none; sets the task and the accuracy.
    Arguments sort_words(const std::vector<std::string> &words)
    {
      Arguments sorted;
      std::string task_option;
      for (std::size_t w = 0; w < words.size(); ++w)
        if (words[w].size() < 2 || words[w][0] != '-')
          sorted.other_words.push_back(words[w]);
        else
          {
            const Option &option = find_option(words[w]);
            sorted.options.push_back(option.name);
            if (option.name == "--accuracy")
              {
                if (++w == words.size())
                  throw fault("after \"--accuracy\", a relative error is missing. Write one, such as 0.05.");
                sorted.accuracy = number_of(words[w]);
                if (!(sorted.accuracy > 0 && sorted.accuracy < 1))
                  throw fault("\"--accuracy\" is " + quoted(words[w]) +
                              ". Write a relative error between 0 and 1, such as 0.05.");
              }
            if (option.name == "--stage")
              {
                if (++w == words.size())
                  throw fault("after \"--stage\", the name of a stage is missing. Write one of the case.");
                sorted.stage = words[w];
              }
            if (option.name == "--ranks")
              {
                sorted.n_ranks = ++w < words.size() ? number_of(words[w]) : 0.;
                if (!(sorted.n_ranks >= 1. && sorted.n_ranks <= 1e6 && sorted.n_ranks == std::floor(sorted.n_ranks)))
                  throw fault("\"--ranks\" is " + (w < words.size() ? quoted(words[w]) : std::string("the last word")) +
                              ". Write a whole number behind it, such as 64.");
              }
            if (!option.task)
              continue;
            if (!task_option.empty() && sorted.task != *option.task)
              throw fault(scree::quoted(task_option) + " and " + quoted(option.name) +
                          " exclude each other. Write one of them.");
            task_option = option.name;
            sorted.task = *option.task;
          }
      for (const std::string &name : sorted.options)
        if (const Option &option = find_option(name); !option.belongs_to.empty() && !sorted.has(option.belongs_to))
          throw fault(quoted(name) + " has no effect without " + quoted(option.belongs_to) +
                      ". Remove it, or add that.");
      return sorted;
    }


    bool is_case_file(const std::string &word)
    {
      const std::string end = ".prm";
      return word.size() > end.size() && word.compare(word.size() - end.size(), end.size(), end) == 0;
    }


    /// Takes the one case file out of the words.
    void take_case_file(Arguments &arguments)
    {
      const std::vector<std::string> &words = arguments.other_words;
      if (words.empty())
        throw fault("a case file is missing. Write one, such as scree case.prm; scree --new makes one.");
      if (words.size() > 1)
        throw fault("there is one case file, " + quoted(words[0]) + ", and then " + quoted(words[1]) + '.' +
                    (is_case_file(words[1]) ? " Write one case file." : meant(words[1])));
      arguments.case_file = words[0];
    }


    /// Takes a case file and a name, both of which may be left out; `names` in words.
    void take_name_and_case_file(const std::string &names, Arguments &arguments)
    {
      for (const std::string &word : arguments.other_words)
        {
          std::string &place = is_case_file(word) ? arguments.case_file : arguments.name;
          if (!place.empty())
            throw fault(scree::quoted(place) + " and " + quoted(word) + " are " +
                        (is_case_file(word) ? "case files" : names) +
                        ". Write one of them; a name with blanks stands between quotes.");
          place = word;
        }
    }


    /// Reads the words behind `scree`; options may stand before or after the case file. Throws InputError at an unknown
    /// option, with the closest one, and at words that are missing, too many or without effect.
    Arguments read_arguments(const std::vector<std::string> &words)
    {
      Arguments arguments = sort_words(split_values(words));
      switch (arguments.task)
        {
        case Task::run:
        case Task::resume:
        case Task::safety:
        case Task::show:
        case Task::advise:
          take_case_file(arguments);
          break;
        case Task::print_parameters:
          take_name_and_case_file("subsections", arguments);
          if (arguments.has("--json") && !(arguments.name.empty() && arguments.case_file.empty()))
            throw fault("\"--json\" prints all entries with their defaults. Remove the subsection and the case file.");
          if (arguments.has("--json") && arguments.has("--sections"))
            throw fault("\"--json\" and \"--sections\" exclude each other. Write one of them.");
          break;
        case Task::new_case:
          take_name_and_case_file("scenes", arguments);
          if (arguments.name.empty() && (!arguments.case_file.empty() || arguments.has("--overwrite")))
            throw fault(
                "after \"--new\", a scene is missing. Write one, such as scree --new slope case.prm; scree --new "
                "lists them.");
          break;
        default:
          if (!arguments.other_words.empty())
            throw fault(scree::quoted(arguments.options[0]) + " stands alone. Remove " +
                        scree::quoted(arguments.other_words[0]) + '.');
        }
      return arguments;
    }


    /// The text of `--help`.
    std::string usage()
    {
      return "Usage: scree case.prm             run a case\n"
             "       scree case.prm --resume    continue from the newest checkpoint in its run folder\n"
             "       scree case.prm --safety [--stage NAME]\n"
             "                                  factor of safety of a slope by strength reduction, at the start or\n"
             "                                  after a stage (the last one without its name)\n"
             "       scree case.prm --show      draw the scene before it runs, into scene/scene.png of its run folder\n"
             "       scree case.prm --advise [--accuracy 0.05] [--ranks 64]\n"
             "                                  regime, estimated cost and recommendations\n"
             "       scree --new                list of scenes to start from\n"
             "       scree --new SCENE [case.prm] [--overwrite]\n"
             "                                  write the case of a scene, by default into SCENE.prm\n"
             "       scree --print-parameters [SUBSECTION] [case.prm]\n"
             "                                  all entries with values and descriptions, or those of a subsection;\n"
             "                                  defaults, or the values of a case\n"
             "       scree --print-parameters --sections [case.prm]\n"
             "                                  names of all subsections\n"
             "       scree --print-parameters --json\n"
             "                                  all entries with their types, as JSON\n"
             "       scree --version            version and commit, libraries, compiler\n"
             "       scree --help, -h           this text\n"
             "Options may stand before or after the case file.\n"
             "In parallel: mpirun -np 2 scree case.prm\n"
             "Exit code: 0 finished, 1 error, 3 stopped on request before the end time (--resume continues, unless the "
             "run "
             "was settling)\n";
    }


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


    /// The scenes that a case may start from, one per line, each with its description.
    std::string list_of_scenes()
    {
      std::string list = "Scenes for scree --new SCENE:\n";
      for (const std::string &name : names_of_scenes())
        {
          const std::string text        = files_of(name).front().text;
          const std::size_t first       = text.find_first_not_of("# ");
          const std::string description = text.substr(first, text.find('\n') - first);
          list += "  " + name + std::string(std::max<std::size_t>(12, name.size() + 1) - name.size(), ' ') +
                  description + '\n';
        }
      return list;
    }


    /// Writes the case of a scene and the files that it names; its run folder is named after the case file.
    /// @param file to write; empty: SCENE.prm in the working folder. Its other files stand beside it.
    /// @param overwrite whether files that differ are replaced
    /// @return what was written and what to do next, in words
    ///
    /// Throws InputError if there is no such scene, or if a file is there already or cannot be written. Collective.
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
      // --advise looks at the points of the start and refuses cases whose points enter.
      const bool has_inflow   = files[0].second.find("\nsubsection Inflow") != std::string::npos;
      const std::string first = has_inflow ? "" : " --advise, then scree " + case_file.string();
      return text + "\nNext: scree " + case_file.string() + first + '\n';
    }


    constexpr int exit_code_of_a_stop = 3;

    void print_parameters(const Arguments &arguments, std::ostream &out)
    {
      Parameters parameters = arguments.case_file.empty() ? Parameters() : Parameters(arguments.case_file);
      if (arguments.has("--sections"))
        parameters.print_sections(arguments.name, out);
      else if (arguments.has("--json"))
        parameters.print(out, ParameterHandler::JSON | ParameterHandler::KeepDeclarationOrder);
      else if (arguments.name.empty())
        parameters.print(out);
      else
        parameters.print_subsection(arguments.name, out);
    }


    /// Reads the case, and calls `run` with its dimension and entries; completes its errors. Returns the exit code of
    /// the run's end.
    template <typename Run>
    int run_case(const Arguments &arguments, const Run &run)
    {
      Parameters parameters(arguments.case_file);
      // A terminal shows that the set-up goes on, until the first line of the log is over it.
      if (arguments.task != Task::advise && parameters.output.screen_kind() == Screen::progress &&
          dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0 && isatty(STDOUT_FILENO) != 0)
        std::cout << "Setting up " + arguments.case_file + " ...\r" << std::flush;
      try
        {
          const End end = parameters.dimension == 2 ? run(std::integral_constant<int, 2>(), parameters)
                                                    : run(std::integral_constant<int, 3>(), parameters);
          return end == End::stopped ? exit_code_of_a_stop : 0;
        }
      catch (const EntryError &error)
        {
          throw parameters.error(error);
        }
      catch (const ValueError &error)
        {
          throw ValueError(parameters.error(EntryError(error.what())).what());
        }
    }


    /// Writes the points of the start into folder `scene` of the run folder, and draws them. Collective.
    template <int dim>
    void show_scene(Parameters &parameters, const MPI_Comm communicator)
    {
      parameters.output_directory      = (fs::path(parameters.output_directory) / "scene").string();
      parameters.settling.maximum_time = 0;
      parameters.output.graphics       = "points";
      Simulation<dim>(parameters, Start::fresh, communicator).write_picture();
      if (dealii::Utilities::MPI::this_mpi_process(communicator) != 0)
        return;
      const std::string program = fs::read_symlink("/proc/self/exe").parent_path() / "scree-render";
      const auto in_quotes      = [](const std::string &text) {
        return "'" + boost::algorithm::replace_all_copy(text, "'", "'\\''") + "'";
      };
      if (std::system((in_quotes(program) + " --scene " + in_quotes(parameters.output_directory)).c_str()) != 0)
        throw InputError("--show: no picture is drawn. The points are in " + parameters.output_directory +
                         "; scree-render --scene draws them where Python and matplotlib are.");
    }


    int perform(const Arguments &arguments, const MPI_Comm communicator, std::ostream &out)
    {
      switch (arguments.task)
        {
        case Task::help:
          out << usage();
          return 0;
        case Task::version:
          out << version_text();
          return 0;
        case Task::print_parameters:
          print_parameters(arguments, out);
          return 0;
        case Task::new_case:
          out << (arguments.name.empty()
                      ? list_of_scenes()
                      : write_new_case(
                            arguments.name, arguments.case_file, arguments.has("--overwrite"), communicator));
          return 0;
        case Task::safety:
          return run_case(arguments, [&](const auto dim, Parameters &parameters) {
            if (!arguments.stage.empty())
              parameters.end_after_stage(arguments.stage);
            return find_safety<dim()>(parameters, communicator);
          });
        case Task::show:
          return run_case(arguments, [&](const auto dim, Parameters &parameters) {
            show_scene<dim()>(parameters, communicator);
            return End::complete;
          });
        case Task::advise:
          return run_case(arguments, [&](const auto dim, Parameters &parameters) {
            advise<dim()>(parameters, arguments.accuracy, arguments.n_ranks, communicator, out);
            return End::complete;
          });
        default:
          return run_case(arguments, [&](const auto dim, Parameters &parameters) {
            const Start start = arguments.task == Task::resume ? Start::resume : Start::fresh;
            return run_in_phases<dim()>(parameters, start, communicator);
          });
        }
    }
  } // namespace


  Ending run_command_line(const std::vector<std::string> &arguments, const MPI_Comm communicator)
  {
    const unsigned int rank    = dealii::Utilities::MPI::this_mpi_process(communicator);
    const unsigned int n_ranks = dealii::Utilities::MPI::n_mpi_processes(communicator);

    // All ranks meet the same input errors, so one speaks; anything else may strike a single rank.
    std::ostream silent(nullptr);
    const auto tell = [&](const std::string &fault) {
      std::cerr << "scree: stopped" + (n_ranks > 1 ? " on rank " + std::to_string(rank) : "") + ": " + fault + "\n";
    };
    Ending ending{ 1, false };
    try
      {
        ending.exit_code = perform(read_arguments(arguments), communicator, rank == 0 ? std::cout : silent);
      }
    catch (const InputError &error)
      {
        if (rank == 0)
          std::cerr << "scree: " + std::string(error.what()) + "\n";
      }
    catch (const std::exception &error)
      {
        const auto *of_deal_ii = dynamic_cast<const dealii::ExceptionBase *>(&error);
        tell(of_deal_ii ? plain_text(*of_deal_ii) : error.what());
        ending.others_may_wait = n_ranks > 1;
      }
    return ending;
  }
} // namespace scree

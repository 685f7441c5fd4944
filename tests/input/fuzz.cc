// SPDX-License-Identifier: LGPL-2.1-or-later
// Case files with random faults: in entries, values, expressions, structure, bytes and included files. Each must be
// accepted, or refused with one line that begins with the file at fault. What is accepted and small is also built and
// filled with points. A crash, a hang (20 s) and any other exception fail.
//
// fuzz COUNT            checks COUNT cases in the folder where it is started
// fuzz COUNT FOLDERS    writes COUNT cases into FOLDERS/0, FOLDERS/1, ... for a program to be started with them

#include <scree/case/memory.h>
#include <scree/model/scene.h>

#include <deal.II/base/mpi.h>

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iostream>
#include <random>
#include <sstream>

using namespace scree;

namespace
{
  using Lines = std::vector<std::string>;

  std::mt19937 generator(20240229); // the standard fixes its numbers

  unsigned int number_below(const unsigned int n)
  {
    return generator() % n;
  }

  std::string one_of(const Lines &choices)
  {
    return choices[number_below(choices.size())];
  }

  const Lines bases = {
    "set End time = 1e-5\nsubsection Mesh\nset Cell size = 0.25\nend\nsubsection Soil\nset Region = y < 0.5\nend",
    "set End time = 1e-5\nset Bodies = Base, Cover\nsubsection Mesh\nset Cell size = 0.25\nend\n"
    "subsection Base\nset Region = y < 0.5\nset Material = Mohr-Coulomb\nset Initial velocity = 0; -x\nend\n"
    "subsection Cover\nset Region = x < 0.5 && y >= 0.5 && y < 0.7\nset Material = linear elastic\nend\n"
    "subsection Surface load\nset Lower corner = 0, 0.7\nset Upper corner = 0.25, 0.7\nset Traction = 0; -100*t\nend",
    "set End time = 1e-5\nsubsection Mesh\nset Cell size = 0.25\nend\n"
    "subsection Soil\nset Region = x < 0.5 && y < 0.5\nsubsection Initial state\nset Type = K0\nend\nend\n"
    "subsection Water\nset Region = y < 0.6\nset Initial velocity = -y; 0\nset Bulk modulus = 1e8\nend\n"
    "subsection Boundaries\nset Bottom = friction 20\nsubsection Water\nset Right = drained 100\nend\nend",
    "set End time = 1e-5\nsubsection Mesh\nset Cell size = 0.25\nend\nsubsection Soil\nset Region = y < 0.5 && x < "
    "0.7\nend\n"
    "subsection Bed\nset Type = friction\nset Friction angle = 20\nset Level set expression = y - 0.1*x\nend\n"
    "subsection Obstacle Wall\nset Type = fixed\nset Level set expression = 0.7 - x\nset Velocity = t; 0\nend",
    "set End time = 1e-5\nsubsection Mesh\nset Cell size = 0.25\nend\n"
    "subsection Soil\nset Material = Mohr-Coulomb\nset Initial porosity = 0.4\nend\n"
    "subsection Inflow Torrent\nset Body = Soil\nset Saturated = true\nset Region = y < 0.3\nset Speed = 1 + t\nset "
    "Direction = "
    "1, -0.2\nend\n"
    "subsection Inflow Spring\nset Body = Water\nset Face = Bottom\nset Region = x > 0.5\nset Speed = 2\nset End time "
    "= 5e-6\nend\n"
    "subsection Water\nset Region = 0\nend",
    "set End time = 1e-5\nsubsection Mesh\nset Cell size = 0.25\nend\nsubsection Soil\nset Grain density = 2000\nend\n"
    "subsection Inflow Jet\nset Body = Soil\nset Face = Right\nset Section = 0.5\nset Region = y < 0.3\nset Speed = "
    "sin(t)^2\nend",
    "set Dimension = 3\nset End time = 1e-5\nset Gravity = 0, 0, -9.81\nset Body force = 0; sin(t); 0\n"
    "subsection Mesh\nset Lower corner = 0, 0, 0\nset Upper corner = 1, 1, 1\nset Cell size = 0.5\nend\n"
    "subsection Soil\nset Region = z < 0.5\nset Points per cell = 2\nend\n"
    "subsection Water\nset Point sets = single\nend\nsubsection Transfer\nset Method = TPIC\nend",
  };

  const Lines values = { "0",           "0.5",        "0.3",   "10",       "1e3",  "1e4",    "-1",
                         "1",           "2",          "3",     "0.25",     "0.1",  "24",     "1e-300",
                         "1e-12",       "1e6",        "1e300", "-1e300",   "nan",  "inf",    "1e999",
                         "0,5",         "1 m",        "",      "0x10",     "1e",   "{1}",    "none",
                         "same",        "K0",         "1, 1",  "0, 0, 1",  "1,1,", "-1, -1", "1e5, 1e5",
                         "friction 24", "drained 1e", "open",  "\xC2\xB5", "#",    "\\" };

  const Lines pieces = { "x", "y", "z",   "t",   "0.5", "0,5",  "1",     "0",      "-",       "+",
                         "*", "/", "^",   "<",   ">",   "=",    "==",    "&&",     "||",      "&",
                         "(", ")", ",",   ";",   "if(", "log(", "sqrt(", "sin(",   "max(",    "pi",
                         "e", " ", "nan", "1/0", "!",   "?",    ":",     "rand()", "x < 0.5", "y < 0.5" };

  const Lines bytes = {
    "\xEF\xBB\xBF", "\xFF\xFE", "\r", std::string(1, '\0'), "\t", "\xC2\xA0", "\xE2\x80\x9C", "\\", "=", "#",
    "end\n",        "\n"
  };

  /// A case file, and one that it may include.
  struct Case
  {
    std::string text, part;
  };

  Lines lines_of(const std::string &text)
  {
    Lines lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);)
      lines.push_back(line);
    return lines;
  }

  std::string text_of(const Lines &lines)
  {
    std::string text;
    for (const auto &line : lines)
      text += line + '\n';
    return text;
  }

  /// All entries, as statements in their subsections.
  Lines declared_entries()
  {
    std::stringstream out;
    Parameters().print(out);
    Lines path, entries;
    for (std::string line; std::getline(out, line);)
      {
        line = single_blanks(line.substr(0, line.find('#')));
        if (line.rfind("subsection ", 0) == 0)
          path.push_back(line);
        else if (line == "end")
          path.pop_back();
        else if (line.rfind("set ", 0) == 0)
          entries.push_back(text_of(path) + line.substr(0, line.find('=') + 1) + "%" + [&] {
            std::string ends;
            for (unsigned int i = 0; i < path.size(); ++i)
              ends += "\nend";
            return ends;
          }());
      }
    return entries;
  }

  std::string random_expression()
  {
    std::string text;
    for (unsigned int i = 0, n = 1 + number_below(7); i < n; ++i)
      text += one_of(pieces);
    return text;
  }

  std::string random_value()
  {
    return number_below(8) == 0 ? random_expression() : one_of(values);
  }

  /// Another value for an entry that the case sets, or an entry that is there and the case does not set.
  void change_entry(Lines &lines, const Lines &entries)
  {
    const unsigned int line = number_below(lines.size());
    if (const auto equals = lines[line].find('='); equals != std::string::npos)
      {
        lines[line] = lines[line].substr(0, equals + 1) + " " + random_value();
        return;
      }
    std::string entry = one_of(entries);
    lines.push_back(entry.replace(entry.find('%'), 1, random_value()));
  }

  void change_expression(Lines &lines)
  {
    for (auto &line : lines)
      if (line.find("Region") != std::string::npos || line.find("velocity") != std::string::npos ||
          line.find("Traction") != std::string::npos || line.find("force") != std::string::npos)
        if (number_below(2) == 0)
          line.insert(line.find('=') + 1 + number_below(line.size() - line.find('=')), one_of(pieces));
  }

  void change_structure(Lines &lines)
  {
    const unsigned int line = number_below(lines.size()), other = number_below(lines.size());
    switch (number_below(3))
      {
      case 0:
        lines.erase(lines.begin() + line);
        break;
      case 1:
        std::swap(lines[line], lines[other]);
        break;
      default:
        lines.insert(lines.begin() + line, lines[other]);
      }
  }

  void change_bytes(std::string &text)
  {
    const unsigned int place = number_below(text.size());
    switch (number_below(5))
      {
      case 0:
        text.erase(place, 1 + number_below(3));
        break;
      case 1:
        text.insert(number_below(2) * place, one_of(bytes));
        break;
      case 2:
        text[place] = static_cast<char>(number_below(256));
        break;
      case 3:
        text.erase(place);
        break;
      default:
        std::swap(text[place], text[number_below(text.size())]);
      }
  }

  void add_include(Case &one)
  {
    Lines lines = lines_of(one.text);
    lines.insert(lines.begin() + number_below(lines.size() + 1),
                 "include " + one_of({ "part.prm", "./part.prm", "case.prm", "missing.prm", ".", "", "/dev/zero" }));
    one.text = text_of(lines);
    one.part = one_of({ "",
                        "set End time = 2e-5\n",
                        "include case.prm\n",
                        "include part.prm\n",
                        "subsection Soil\n",
                        "end\n",
                        "\xEF\xBB\xBFset End time = 2e-5\n",
                        "set Ende = 1\n" });
  }

  Case random_case(const Lines &entries)
  {
    Case one{ one_of(bases), "" };
    for (unsigned int i = 0, n = 1 + number_below(3) / 2; i < n; ++i)
      {
        Lines lines = lines_of(one.text);
        if (lines.empty())
          break;
        const unsigned int kind = number_below(10);
        if (kind < 4)
          change_entry(lines, entries);
        else if (kind < 6)
          change_expression(lines);
        else if (kind < 7)
          change_structure(lines);
        one.text = text_of(lines);
        if (kind == 7 || kind == 8)
          change_bytes(one.text);
        else if (kind == 9)
          add_include(one);
      }
    return one;
  }

  template <int dim>
  void build_if_small(const Parameters &parameters)
  {
    MemoryEstimate estimate;
    on_all_ranks(MPI_COMM_WORLD, [&] { estimate = estimate_memory<dim>(parameters); });
    constexpr double small = 3e4;
    if (estimate.n_cells + estimate.n_soil_points + estimate.n_water_points < small)
      Scene<dim>(parameters, MPI_COMM_WORLD).fill();
  }

  /// What is wrong with how the case was received; empty: nothing.
  std::string judge(const std::string &file, bool &accepted)
  {
    std::unique_ptr<Parameters> parameters;
    std::string message;
    try
      {
        try
          {
            parameters = std::make_unique<Parameters>(file);
            if (parameters->dimension == 2)
              build_if_small<2>(*parameters);
            else
              build_if_small<3>(*parameters);
            accepted = true;
            return "";
          }
        catch (const EntryError &error)
          {
            if (!parameters)
              throw;
            message = parameters->error(error).what();
          }
      }
    catch (const InputError &error)
      {
        message = error.what();
      }
    catch (const std::exception &error)
      {
        return std::string("another exception: ") + error.what();
      }
    const std::size_t colon = message.find(": "), comma = message.find(", line");
    const std::string place = message.substr(0, std::min(colon, comma));
    if (place != file && !std::filesystem::exists(place) &&
        message.find("no file that can be read") == std::string::npos)
      return "no file is named: " + message;
    if (message.find("----") != std::string::npos || message.size() < place.size() + 10)
      return "not a message for users: " + message;
    return "";
  }

  void write(const std::filesystem::path &folder, const Case &one)
  {
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "case.prm") << one.text;
    std::ofstream(folder / "part.prm") << one.part;
  }
} // namespace


int main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const Lines entries        = declared_entries();
  const unsigned int n_cases = std::stoul(argv[1]);
  unsigned int n_accepted = 0, n_faults = 0;
  for (unsigned int i = 0; i < n_cases; ++i)
    {
      const bool is_base = i < bases.size(); // right as it is
      const Case one     = is_base ? Case{ bases[i], "" } : random_case(entries);
      write(argc > 2 ? std::filesystem::path(argv[2]) / std::to_string(i) : ".", one);
      if (argc > 2)
        continue;
      alarm(20); // ends the program
      bool accepted     = false;
      std::string fault = judge("case.prm", accepted);
      if (is_base && !accepted)
        fault += " It must be accepted.";
      n_accepted += accepted;
      if (fault.empty())
        continue;
      ++n_faults;
      std::cout << "Case " << i << ": " << fault << "\n----\n" << one.text << "---- part.prm\n" << one.part << "----\n";
    }
  std::cout << n_cases << " cases, of them accepted " << n_accepted << ", wrongly received " << n_faults << '\n';
  // Were nearly all refused at their first statements, the faults would hide what is behind these.
  return n_faults > 0 || (argc == 2 && n_accepted < n_cases / 20);
}

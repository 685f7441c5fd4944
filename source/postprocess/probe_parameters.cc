// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/input/input_error.h>
#include <scree/postprocess/probe_parameters.h>

#include <deal.II/base/utilities.h>

#include <cctype>
#include <cmath>
#include <set>

namespace scree
{
  using namespace dealii;

  namespace
  {
    constexpr char subsection[] = "Probes";

    /// The coordinates of a point; none if the text is no list of `n` numbers.
    std::vector<double> coordinates(const std::string &text, const unsigned int n)
    {
      std::vector<double> numbers;
      for (const std::string &word : Utilities::split_string_list(text))
        {
          char *end          = nullptr;
          const double value = std::strtod(word.c_str(), &end);
          if (word.empty() || *end != '\0' || !std::isfinite(value))
            return {};
          numbers.push_back(value);
        }
      return numbers.size() == n ? numbers : std::vector<double>();
    }

    bool is_file_name(const std::string &name)
    {
      for (const unsigned char letter : name)
        if (!std::isalnum(letter) && letter != '_' && letter != '-')
          return false;
      return !name.empty();
    }

    /// `n_points` points of `n_coordinates` each a name, as in "toe: 0.4, 0.1; crest: 1, 2".
    std::vector<NamedPlace> read_list(const std::string &entry,
                                      const std::string &text,
                                      const unsigned int n_points,
                                      const unsigned int n_coordinates,
                                      const std::string &shape)
    {
      std::vector<NamedPlace> list;
      if (text.empty())
        return list;
      for (const std::string &part : Utilities::split_string_list(text, ';'))
        {
          const std::size_t colon = part.find(':');
          NamedPlace place{ Utilities::trim(part.substr(0, colon)), {} };
          if (colon != std::string::npos)
            for (const std::string &point : Utilities::split_string_list(part.substr(colon + 1), " to "))
              place.points.push_back(coordinates(point, n_coordinates));
          bool reads = is_file_name(place.name) && place.points.size() == n_points;
          for (const auto &point : place.points)
            reads = reads && !point.empty();
          require_entry(reads,
                        subsection,
                        entry,
                        text,
                        quoted(part) + " does not read. Write " + shape +
                            " in m, with a name of letters, digits, _ and -; separate several by semicolons.");
          constexpr std::size_t longest = 200; // Names of files have 255 bytes at most.
          require_entry(place.name.size() <= longest,
                        subsection,
                        entry,
                        text,
                        scree::quoted(place.name) + " has " + std::to_string(place.name.size()) +
                            " letters, and the name of a probe, which is that of its file, at most " +
                            std::to_string(longest) + ". Write a shorter name.");
          list.push_back(place);
        }
      return list;
    }

    void require_inside(const std::string &entry,
                        const std::string &text,
                        const std::vector<NamedPlace> &list,
                        const GridParameters &grid)
    {
      for (const NamedPlace &place : list)
        for (const auto &point : place.points)
          for (unsigned int a = 0; a < point.size(); ++a)
            require_entry(point[a] >= grid.lower_corner[a] && point[a] <= grid.upper_corner[a],
                          subsection,
                          entry,
                          text,
                          quoted(place.name) + " lies outside the box of subsection Mesh, from " +
                              number_text(grid.lower_corner) + " to " + number_text(grid.upper_corner) +
                              ". Move it, or a corner of the box.");
    }
  } // namespace


  void ProbeParameters::add_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection(subsection);
    prm.add_parameter(
        "Places",
        places,
        "m; places whose state is written with each row of statistics. Format: NAME: x, y; NAME: x, y; ...",
        Patterns::Anything());
    prm.add_parameter(
        "Lines",
        lines,
        "m; lines along which the state is written with each graphics output. Format: NAME: x, y to x, y; ...",
        Patterns::Anything());
    prm.add_parameter("Places a line",
                      places_a_line,
                      "Number of places on each line, equally spaced, ends included.",
                      Patterns::Integer(2, 100000));
    prm.add_parameter("Verticals",
                      verticals,
                      "m; places on the ground above which the height of the soil surface and the water level are "
                      "written with each row of statistics. Format: NAME: x; ... (3D: NAME: x, y; ...).",
                      Patterns::Anything());
    prm.add_parameter("Front thickness",
                      front_thickness,
                      "m; thickness that defines the fronts. The smallest and largest x at which soil and water are "
                      "this thick are written with each row of statistics. 0: none.",
                      Patterns::Double(0));
    prm.add_parameter("Wall forces",
                      wall_forces,
                      "true: the force on each face of the box is written with each row of statistics.",
                      Patterns::Bool());
    prm.add_parameter("Displacement",
                      displacement,
                      "true: the graphics output has the displacement of the soil points since the start. It is always "
                      "there if the soil settles.",
                      Patterns::Bool());
    prm.leave_subsection();
  }


  std::vector<NamedPlace> ProbeParameters::list_of_places(const unsigned int dim) const
  {
    return read_list("Places", places, 1, dim, dim == 2 ? "NAME: x, y" : "NAME: x, y, z");
  }


  std::vector<NamedPlace> ProbeParameters::list_of_lines(const unsigned int dim) const
  {
    return read_list("Lines", lines, 2, dim, dim == 2 ? "NAME: x, y to x, y" : "NAME: x, y, z to x, y, z");
  }


  std::vector<NamedPlace> ProbeParameters::list_of_verticals(const unsigned int dim) const
  {
    return read_list("Verticals", verticals, 1, dim - 1, dim == 2 ? "NAME: x" : "NAME: x, y");
  }


  void ProbeParameters::check(const GridParameters &grid, const unsigned int dim, const bool has_soil) const
  {
    std::set<std::string> names{ "front", "walls" };
    const auto check_list =
        [&](const std::string &entry, const std::string &text, const std::vector<NamedPlace> &list) {
          require_inside(entry, text, list, grid);
          for (const NamedPlace &place : list)
            require_entry(names.insert(place.name).second,
                          subsection,
                          entry,
                          text,
                          quoted(place.name) + " is the name of another probe. Each has a file of its own name: write "
                                               "another one.");
        };
    check_list("Places", places, list_of_places(dim));
    check_list("Lines", lines, list_of_lines(dim));
    check_list("Verticals", verticals, list_of_verticals(dim));
    for (const NamedPlace &line : list_of_lines(dim))
      require_entry(line.points[0] != line.points[1],
                    subsection,
                    "Lines",
                    lines,
                    "both ends of " + quoted(line.name) + " are the same. Move one, or write it among the \"Places\".");
    require_entry(has_soil || !displacement,
                  subsection,
                  "Displacement",
                  "true",
                  "this entry has no effect, as there is no soil: entry \"Bodies\" is none. Remove it.");
  }
} // namespace scree

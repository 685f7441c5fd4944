// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/advice/advise.h>

#include <set>
#include <sstream>

namespace scree
{
  using namespace dealii;

  namespace
  {
    const struct
    {
      const char *scene, *name, *text;
    } tables[] = {
#include <choices.h> // made of choices.table, see source/cmake/scene_files.cmake
    };

    using Words = std::set<std::string>;

    /// What holds for a scene, in the words of choices.table.
    Words words_of(const SceneNumbers &scene)
    {
      constexpr double small_strain = 0.01, least_time_factor = 0.1;
      constexpr double least_grain = 0.005; // of the height; smaller ones hardly slow the flow
      const Groups groups          = groups_of(scene);
      Words words;
      for (const auto &[word, holds] : std::initializer_list<std::pair<const char *, bool>>{
               { "soil", scene.has_soil },
               { "water", scene.has_water },
               { "elastic", scene.is_elastic },
               { "falls", scene.falls() },
               { "sticks", scene.sticks },
               { "on a bed", scene.is_layer },
               { "saturated", scene.has_soil && scene.water_fills_soil },
               { "changing forces", scene.has_changing_forces },
               { "coarse grains", scene.grain_diameter > least_grain * scene.height },
               { "small strain", groups.own_strain < small_strain },
               { "drains", groups.drainage < thresholds::drained_below },
               { "holds water", groups.drainage > thresholds::undrained_above },
               { "consolidates", !(groups.time_factor < thresholds::consolidates_above) },
               { "ends early", groups.time_factor < least_time_factor } })
        if (holds)
          words.insert(word);
      return words;
    }


    /// Whether all words of a list hold.
    bool hold(const std::vector<std::string> &list, const Words &words)
    {
      return std::all_of(list.begin(), list.end(), [&](const std::string &word) {
        const bool is_turned = word.rfind("not ", 0) == 0;
        return (words.count(is_turned ? word.substr(4) : word) > 0) != is_turned;
      });
    }


    /// The columns behind the words of the first row that holds; empty ones at the end are missing.
    std::vector<std::string> row_of(const std::string &table, const Words &words)
    {
      std::istringstream in(tables[0].text);
      for (std::string line; std::getline(in, line);)
        {
          const auto columns = Utilities::split_string_list(line, '|');
          if (columns.size() > 1 && columns[0] == table && hold(Utilities::split_string_list(columns[1], ','), words))
            return { columns.begin() + 2, columns.end() };
        }
      AssertThrow(false, ExcMessage("choices.table has no row of " + table + " for this scene."));
      return {};
    }


    /// With the name of its model.
    Words all_words_of(const SceneNumbers &scene)
    {
      Words words = words_of(scene);
      words.insert(row_of("model", words)[0]);
      return words;
    }
  } // namespace


  Choice model_for(const SceneNumbers &scene)
  {
    const Groups groups = groups_of(scene);
    const auto row      = row_of("model", words_of(scene));
    std::string reason  = row[1];
    for (const auto &[name, number] :
         std::initializer_list<std::pair<const char *, double>>{ { "{drainage}", groups.drainage },
                                                                 { "{T_v}", groups.time_factor },
                                                                 { "{drained}", thresholds::drained_below },
                                                                 { "{undrained}", thresholds::undrained_above },
                                                                 { "{consolidates}", thresholds::consolidates_above } })
      reason = Utilities::replace_in_string(reason, name, short_text(number));
    return { row[0], reason };
  }


  Choice water_points_for(const SceneNumbers &scene)
  {
    const auto row = row_of("water points", all_words_of(scene));
    return { row[0], row[1] };
  }


  ErrorLaw error_law_of(const SceneNumbers &scene)
  {
    const Words words = all_words_of(scene);
    const auto text   = [](const std::vector<std::string> &row, const unsigned int column) {
      return column < row.size() ? row[column] : "";
    };
    const auto row = row_of("error", words);
    return { row[0],       Utilities::string_to_double(row[1]), Utilities::string_to_double(row[2]),
             text(row, 3), text(row_of("gap", words), 0),       text(row_of("remedy", words), 0) };
  }


  double cell_size_for(const GridParameters &grid, const double height, const double cells)
  {
    const double largest = height / cells, present = grid.cell_size;
    // The cell size at hand divides the box: at worst a whole part of it does.
    const double at_worst = present / std::ceil(present / largest), size = grid.size_that_divides(largest, at_worst);
    return size > 0. ? size : at_worst;
  }


  TimeStepParameters time_step_for(const SceneNumbers &scene, TimeStepParameters present)
  {
    // Measured, doc/developer/development_log.md: Terzaghi's error is the same at Courant numbers 0.1 and 0.9; the dam
    // breaks ran with 0.04 s/m.
    constexpr double free_water_step_over_cell = 0.04; // s/m
    present.courant = scene.is_elastic && scene.has_water && scene.water_fills_soil ? "0.9" : "auto";
    present.choose(scene.has_water, scene.courant_of_transfer, scene.gravity, scene.cell_size);
    if (!scene.has_soil)
      present.maximum_time_step = free_water_step_over_cell * scene.cell_size;
    return present;
  }
} // namespace scree

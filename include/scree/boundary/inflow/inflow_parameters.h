// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_boundary_inflow_inflow_parameters_h
#define scree_boundary_inflow_inflow_parameters_h

#include <scree/boundary/boundary_conditions.h>
#include <scree/input/number_table.h>
#include <scree/mesh/background_grid.h>
#include <scree/particles/region.h>

namespace scree
{
  /// Subsection Inflow NAME: soil or water that enters during the run.
  struct InflowParameters
  {
    /// What the names of the subsections begin with.
    static const std::string prefix;

    std::string subsection;              ///< prefix and name
    std::string body;                    ///< name of a body, or Water
    bool is_saturated = false;           ///< whether soil brings water in its pores
    std::string face  = "Left";          ///< of the box: what enters moves away from it
    std::string section;                 ///< coordinate along the face's normal, m; empty: the face itself
    std::string region = "1";            ///< the open part of the section, as an expression
    std::string speed;                   ///< m/s, of t
    std::string hydrograph;              ///< file of time and speed or discharge
    std::string hydrograph_of = "speed"; ///< speed | discharge
    std::string direction;               ///< one number an axis; empty: the face's inward normal
    double end_time = -1;                ///< s; below 0: that of the run

    /// @param subsection prefix and name
    explicit InflowParameters(const std::string &subsection)
        : subsection(subsection)
    {
    }

    /// Declares the subsection and its entries.
    void add_parameters(dealii::ParameterHandler &prm);

    /// Throws EntryError at impossible combinations.
    /// @param points_per_cell of the body or the water along each axis
    void check(const GridParameters &grid, const unsigned int dim, const unsigned int points_per_cell) const;

    /// Without the prefix.
    std::string name() const
    {
      return subsection.substr(prefix.size());
    }

    /// Whether it brings water without soil.
    bool is_water() const
    {
      return body == "Water";
    }

    /// Whether the file has m^3/s (2D: m^2/s) in place of m/s.
    bool tells_discharge() const
    {
      return !hydrograph.empty() && hydrograph_of == "discharge";
    }

    /// The face in deal.II's numbering.
    unsigned int face_number(const unsigned int dim) const
    {
      const auto names = FaceEntries::names(dim);
      return std::find(names.begin(), names.end(), face) - names.begin();
    }

    /// The section's coordinate along the normal of its face, m.
    double place(const GridParameters &grid) const
    {
      const unsigned int number = face_number(grid.lower_corner.size());
      return !is_at_wall()     ? number_of(section)
             : number % 2 == 0 ? grid.lower_corner[number / 2]
                               : grid.upper_corner[number / 2];
    }

    /// Whether the section is the face itself.
    bool is_at_wall() const
    {
      return section.empty();
    }

    /// Unit vector along which points enter, one number an axis.
    std::vector<double> unit_direction(const unsigned int dim) const;

  private:
    void check_direction(const unsigned int dim) const
    {
      if (direction.empty())
        return;
      const unsigned int number = face_number(dim);
      const auto texts          = dealii::Utilities::split_string_list(direction);
      require_entry(texts.size() == dim,
                    { subsection, "Direction", direction },
                    "write " + std::to_string(dim) + " numbers, separated by commas.");
      require_entry(number_of(texts[number / 2]) * (number % 2 == 0 ? 1. : -1.) > 0,
                    { subsection, "Direction", direction },
                    "it does not lead away from \"Face\" = " + face + ". Turn it, or write another face.");
    }
    void check_section(const GridParameters &grid, const unsigned int dim, const unsigned int points_per_cell) const;
  };


  /// Speed or discharge of an inflow over time: an expression of t, or linear between the rows of a file and 0 before
  /// and after them.
  class Hydrograph
  {
  public:
    /// Throws EntryError if a row is negative or the file does not read.
    explicit Hydrograph(const InflowParameters &parameters);

    /// At a time, s. Throws ValueError if the expression is negative or no number.
    double value(const double time) const
    {
      if (!expression)
        return record.value(time);
      const double value = expression->value(dealii::Point<1>(time));
      if (value < 0.)
        throw ValueError(where + ": it is " + number_text(value) + " m/s at t = " + number_text(time) +
                         " s, and nothing flows out of a section. Write max(0, ...) around it.");
      return value;
    }

    /// The integral from `begin` to `end`, s: of a file exact, of an expression by Gauss' rule of two places.
    double integral(const double begin, const double end) const
    {
      if (!expression)
        return record.integral(end) - record.integral(begin);
      const double middle = 0.5 * (begin + end), away = 0.5 * (end - begin) / std::sqrt(3.);
      return 0.5 * (end - begin) * (value(middle - away) + value(middle + away));
    }

  private:
    const std::string where;                   // entry_name() of the expression
    std::unique_ptr<Expression<1>> expression; // null if there is a file
    TimeRecord<double> record;                 // m/s or m^3/s; of the file
  };
} // namespace scree

#endif

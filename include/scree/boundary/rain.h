// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_boundary_rain_h
#define scree_boundary_rain_h

#include <scree/input/expression.h>
#include <scree/mesh/background_grid.h>

namespace scree
{
  /// Subsection Rain.
  struct RainParameters
  {
    std::string rate; ///< m/s, of t; empty: no rain

    /// Declares the subsection and its entries.
    void add_parameters(dealii::ParameterHandler &prm)
    {
      prm.enter_subsection("Rain");
      prm.add_parameter(
          "Rate",
          rate,
          "m/s; rain on the surface of the soil, not negative: volume per time and horizontal area, an "
          "expression of t such as if(t < 60, 1e-4, 0). 50 mm/h are 1.39e-5 m/s. What does not enter runs "
          "off. Empty: no rain.");
      prm.leave_subsection();
    }

    /// Whether it rains.
    bool is_set() const
    {
      return !rate.empty();
    }

    /// Throws EntryError at impossible combinations.
    /// @param gravity m/s^2, one number an axis
    /// @param has_own_points whether there is water with points of its own
    /// @param air_entry pressure of the water, Pa
    void check(const std::vector<double> &gravity,
               const bool has_own_points,
               const double air_entry,
               const unsigned int n_bodies) const;
  };

  /// What rain enters.
  struct RainedSoil
  {
    double spacing;  ///< of the points, m
    double porosity; ///< at the start
  };

  /// Where the rain is that fell, m^3 (2D: m^2).
  struct RainBooks
  {
    double fell     = 0, ///< in all
        entered     = 0, ///< as points of water
        beside_soil = 0, ///< on columns without soil
        waiting     = 0; ///< for a whole drop, less what waited at the start

    /// What a run that goes on needs.
    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &fell &entered &beside_soil &waiting;
    }
  };

  /// Rain on the soil: drops that appear at its surface, each a point of water at rest.
  ///
  /// The box is cut into upright columns as wide as the spacing of the water's points. The depth of rain of a column is
  /// counted, and a drop of the depth that fills the pores of one spacing falls as often as this depth is reached;
  /// columns take turns. A drop fills the pores at the surface, if they are empty, or else lies on the soil or on the
  /// water there.
  template <int dim>
  class Rain
  {
  public:
    /// A drop.
    struct Drop
    {
      unsigned int column;         ///< number
      dealii::Point<dim> location; ///< m
    };

    /// What the columns hold.
    struct Columns
    {
      std::vector<double> soil;   ///< heights of the highest points, m; minus infinity: there are none
      std::vector<double> water;  ///< the same of the water
      std::vector<int> has_soil;  ///< by column and slot, from the soil's surface down to half a cell
      std::vector<double> filled; ///< the same, by water, as a part of the pores
    };

    /// @param spacing of the water's points, m
    Rain(const RainParameters &parameters,
         const BackgroundGrid<dim> &grid,
         const double spacing,
         const RainedSoil &soil);

    /// Counts what falls in a step, s; returns whether drops are due.
    bool count(const double time, const double time_step)
    {
      const double away = 0.5 * time_step / std::sqrt(3.), middle = time + 0.5 * time_step; // Gauss
      const double first  = rate->value(dealii::Point<1>(middle - away)),
                   second = rate->value(dealii::Point<1>(middle + away));
      AssertThrow(
          first >= 0. && second >= 0.,
          dealii::ExcMessage("subsection Rain, entry \"Rate\": it is below 0 at t = " + number_text(time) + " s."));
      const double fallen = 0.5 * time_step * (first + second);
      bool is_due         = false;
      for (unsigned int column = 0; column < due.size(); ++column)
        is_due = (due[column] += fallen) >= depth || is_due;
      books.fell += fallen * area();
      return is_due && fallen > 0.;
    }

    /// Columns without anything.
    Columns no_columns() const
    {
      const std::vector<double> nowhere(due.size(), -std::numeric_limits<double>::infinity());
      const std::size_t n = due.size() * n_slots;
      return { nowhere, nowhere, std::vector<int>(n, 0), std::vector<double>(n, 0.) };
    }

    /// Takes a point of soil or of water at `x` into account in the heights.
    void find_top(const dealii::Point<dim> &x, std::vector<double> &heights) const
    {
      // No column between two points misses both.
      for_columns_near(x, 0.75 * std::max(soil.spacing, spacing), [&](const unsigned int column) {
        heights[column] = std::max(heights[column], x[dim - 1]);
      });
    }

    /// Fills slots with a point of soil at `x`, once all heights are known.
    void fill_with_soil(const dealii::Point<dim> &x, Columns &columns) const
    {
      for_columns_near(x, 0.75 * std::max(soil.spacing, spacing), [&](const unsigned int column) {
        const double below = (surface(column, columns) - x[dim - 1]) / spacing;
        const double reach = 0.75 * std::max(soil.spacing / spacing, 1.);
        const int last     = std::min(int(n_slots) - 1, int(std::floor(below + reach - 0.5)));
        for (int slot = std::max(0, int(std::ceil(below - reach - 0.5))); slot <= last; ++slot)
          columns.has_soil[column * n_slots + slot] = 1;
      });
    }

    /// The same with a point of water.
    /// @param volume m^3
    void fill_with_water(const dealii::Point<dim> &x, const double volume, Columns &columns) const
    {
      for_columns_near(x, 0.5 * spacing, [&](const unsigned int column) {
        const double below = (surface(column, columns) - x[dim - 1]) / spacing;
        if (below >= 0. && below < n_slots)
          columns.filled[column * n_slots + int(below)] += volume / this->volume();
      });
    }

    /// The drops that are due; columns without soil have none. Their depth is taken off. All ranks see the same.
    /// @param columns of all ranks
    std::vector<Drop> drops(const Columns &columns);

    /// Volume of a drop, m^3 (2D: per m).
    double volume() const
    {
      return depth * std::pow(spacing, dim - 1);
    }

    /// Counts a drop again that found no cell.
    void postpone(const Drop &drop)
    {
      take(drop.column, -depth, books.entered);
    }

    /// Where the rain is.
    RainBooks account() const
    {
      RainBooks result = books;
      result.waiting += std::accumulate(due.begin(), due.end(), 0.) * std::pow(spacing, dim - 1);
      return result;
    }

    /// Area on which it rains, m^2 (2D: m).
    double area() const
    {
      return due.size() * std::pow(spacing, dim - 1);
    }

    /// What a run that goes on needs.
    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &due &books;
    }

  private:
    /// Takes a depth off what is due in a column, and adds it to a volume.
    void take(const unsigned int column, const double taken, double &volume)
    {
      due[column] -= taken;
      volume += taken * std::pow(spacing, dim - 1);
    }

    /// Middle of a column at the box's floor.
    dealii::Point<dim> foot(const unsigned int column) const
    {
      dealii::Point<dim> x = grid.lower_corner();
      unsigned int rest    = column;
      for (unsigned int a = 0; a + 1 < dim; ++a, rest /= n[a - 1])
        x[a] += (rest % n[a] + 0.5) * spacing;
      return x;
    }

    /// Calls `act(column)` for the columns whose middle is at most `reach` away from `x` along each axis.
    template <typename Function>
    void for_columns_near(const dealii::Point<dim> &x, const double reach, const Function &act) const
    {
      std::array<int, dim - 1> first, last;
      for (unsigned int a = 0; a + 1 < dim; ++a)
        {
          const double at = (x[a] - grid.lower_corner()[a]) / spacing - 0.5;
          first[a]        = std::max(0, int(std::ceil(at - reach / spacing)));
          last[a]         = std::min(int(n[a]) - 1, int(std::floor(at + reach / spacing)));
        }
      for (int i = first[0]; i <= last[0]; ++i)
        if constexpr (dim == 2)
          act(i);
        else
          for (int j = first[1]; j <= last[1]; ++j)
            act(i + int(n[0]) * j);
    }

    /// Height of the soil's surface in a column.
    double surface(const unsigned int column, const Columns &columns) const
    {
      return columns.soil[column] + 0.5 * soil.spacing;
    }

    /// Whether the slots of a cell's width have room for a drop, and the uppermost of the column is empty.
    bool has_room(const unsigned int column, const Columns &columns) const
    {
      if (columns.has_soil[column * n_slots] == 0 || columns.filled[column * n_slots] > 0.)
        return false;
      double pores = 0., filled = 0.;
      for_columns_near(foot(column), (0.5 + 1e-9) * grid.cell_size(), [&](const unsigned int other) {
        for (unsigned int slot = other * n_slots; slot < (other + 1) * n_slots; ++slot)
          {
            pores += columns.has_soil[slot];
            filled += columns.filled[slot];
          }
      });
      return filled + 0.5 < pores;
    }

    /// Where a drop appears.
    double height_of_drop(const unsigned int column, const Columns &columns) const
    {
      const double top = surface(column, columns);
      return has_room(column, columns) ? top - 0.5 * spacing
                                       : std::max(top, columns.water[column] + 0.5 * spacing) + 0.5 * spacing;
    }

    const BackgroundGrid<dim> &grid;
    const double spacing; // m
    const RainedSoil soil;
    const double depth; // of a drop, m
    std::unique_ptr<Expression<1>> rate;
    std::array<unsigned int, dim - 1> n; // columns along the axes
    unsigned int n_slots;                // of a column, one spacing high
    std::vector<double> due;             // depth of rain that has not become a drop, m
    RainBooks books;
  };
} // namespace scree

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_postprocess_statistics_soil_motion_h
#define scree_postprocess_statistics_soil_motion_h

#include <scree/io/check_result.h>
#include <scree/mesh/discrete_level_set.h>
#include <scree/postprocess/columns.h>

#include <boost/serialization/vector.hpp>

namespace scree
{
  /// How fast the soil of all ranks is, and how far it has come since the start (2D: per m). doc/output.md has the
  /// definitions.
  struct MotionNumbers
  {
    double speed        = 0; ///< that 1 % of the mass exceeds, m/s
    double moving_part  = 0; ///< of the mass, faster than rest_speed()
    double thickness    = 0; ///< of moving (at the start: all) soil, normal to the ground, median by volume, cells
    double length       = 0; ///< horizontal length L of the path, m
    double fall         = 0; ///< its height H, m
    double area         = 0; ///< of the deposit, m^2 (2D: m)
    double volume       = 0; ///< of the deposit, m^3 (2D: m^2)
    double travel_angle = 0; ///< atan(H/L), degrees
  };

  /// Whether the soil has come to rest, how well the cells resolve what moves, and the path of the run-out.
  template <int dim>
  class SoilMotion
  {
  public:
    /// Keeps references.
    /// @param gravity m/s^2
    /// @param bed null: the ground is normal to the last axis
    SoilMotion(const BackgroundGrid<dim> &grid,
               const dealii::Tensor<1, dim> &gravity,
               const DiscreteLevelSet<dim> *bed);

    /// Looks at the soil; the first look is the start. Collective.
    MotionNumbers look(const std::list<SoilBody<dim>> &bodies, const double time);

    /// Thickness of the moving soil in cells, at the look with the largest kinetic energy; empty if nothing moved.
    std::vector<CheckResult> results() const;

    /// The lines `Motion` and `Run-out` of the last look; empty without soil, or without gravity.
    std::string text() const;

    /// Saves or loads the start and the last look (Boost).
    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &start_thickness &start_height &largest_kinetic &thickness_then &last_time &has_soil;
      archive &last.speed &last.moving_part &last.length &last.fall &last.area &last.volume &last.travel_angle;
    }

  private:
    /// Soil below this speed rests, m/s.
    double rest_speed() const;

    /// Path and deposit: what columns have lost and gained.
    void find_path(const std::vector<double> &thickness, const std::vector<double> &height);

    const BackgroundGrid<dim> &grid;
    const dealii::Tensor<1, dim> gravity;
    const DiscreteLevelSet<dim> *bed;
    const CellColumns<dim> columns;
    std::vector<double> start_thickness, start_height; // of the columns, m
    MotionNumbers last;
    double largest_kinetic = 0; // J
    double thickness_then  = 0; // in cells
    double last_time       = 0; // s
    bool has_soil          = false;
  };
} // namespace scree

#endif

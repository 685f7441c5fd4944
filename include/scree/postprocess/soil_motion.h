// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_postprocess_soil_motion_h
#define scree_postprocess_soil_motion_h

#include <scree/io/progress.h>
#include <scree/postprocess/measures.h>

namespace scree
{
  /// How fast the soil of all ranks is, and how far it has come since the start (2D: per m). doc/output.md has the
  /// definitions.
  struct MotionNumbers
  {
    double height           = 0; ///< between the highest and the lowest place of soil so far, at least a cell, m
    double failed_mass      = 0; ///< of soil that has moved by more than 1.25 % of this height on the map, kg
    double mean_speed       = 0; ///< of failed soil along its displacement, without it of all, m/s
    double toe_speed        = 0; ///< of the toe, along the motion, m/s
    double speed            = 0; ///< that 1 % of the mass exceeds, m/s
    double thickness        = 0; ///< of moving (at the start: all) soil, normal to the ground, median by volume, cells
    double length           = 0; ///< horizontal length L of the path, from the scarp to the toe along the motion, m
    double fall             = 0; ///< its height H, m
    double toe_displacement = 0; ///< of the toe, along the motion, m
    double largest_displacement = 0; ///< that 0.1 % of the mass exceeds, m
    double area                 = 0; ///< of the deposit, m^2 (2D: m)
    double volume               = 0; ///< of the deposit, m^3 (2D: m^2)

    double ratio        = 0; ///< H/L
    double travel_angle = 0; ///< atan(H/L), degrees

    /// Saves or loads all of it (Boost).
    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &height &failed_mass &mean_speed &toe_speed &speed &thickness;
      archive &length &fall &toe_displacement &largest_displacement &area &volume &ratio &travel_angle;
    }
  };

  /// Whether the soil has come to rest, how well the cells resolve what moves, and the path of the run-out.
  template <int dim>
  class SoilMotion
  {
  public:
    /// Cells over the thickness of moving soil.
    static constexpr double least_cells = 3.;
    /// By which the toe of dry soil deviates at most (study `resolution`).
    static constexpr double toe_cells = 5.;

    /// Keeps references.
    /// @param gravity m/s^2
    /// @param bed null: the ground is normal to the last axis
    SoilMotion(const BackgroundGrid<dim> &grid, const dealii::Tensor<1, dim> &gravity, const DiscreteLevelSet<dim> *bed)
        : grid(grid)
        , gravity(gravity)
        , bed(bed)
        , columns(grid)
    {
    }

    /// Looks at the soil; the first look is the start. Collective.
    /// @param lost_masses of soil that has left through each face of the box, of all ranks, kg
    MotionNumbers
    look(const std::list<SoilBody<dim>> &bodies, const dealii::Tensor<1, 2 * dim> &lost_masses, const double time);

    /// Path, displacements and speeds of failed soil and its toe; the rest is 0. Collective.
    MotionNumbers path(const std::list<SoilBody<dim>> &bodies) const;

    /// Thickness of the moving soil in cells, at the look with the largest kinetic energy, and whether failed soil has
    /// come to rest; what does not apply is left out.
    std::vector<CheckResult> results() const;

    /// The lines `Motion` and `Run-out` of the last look; empty without soil, or without gravity.
    std::string text() const;

    /// Saves or loads the start and the last look (Boost).
    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &start_thickness &largest_kinetic &thickness_then &last_time &soil_mass &lost &last;
    }

  private:
    /// Soil below this speed rests, m/s.
    double rest_speed() const
    {
      constexpr double part = 4e-3; // of sqrt(g H): in sqrt(H/g) it moves by 0.4 % of H
      return part * std::sqrt(gravity.norm() * last.height);
    }
    bool is_at_rest() const
    {
      return std::max(std::abs(last.mean_speed), std::abs(last.toe_speed)) <= rest_speed();
    }

    const BackgroundGrid<dim> &grid;
    const dealii::Tensor<1, dim> gravity;
    const DiscreteLevelSet<dim> *bed;
    const CellColumns<dim> columns;
    std::vector<double> start_thickness; // of the columns, m
    MotionNumbers last;
    dealii::Tensor<1, 2 * dim> lost; // see look()
    double soil_mass       = 0;      // in the box, kg
    double largest_kinetic = 0;      // J
    double thickness_then  = 0;      // in cells
    double last_time       = 0;      // s
  };
} // namespace scree

#endif

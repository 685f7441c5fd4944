// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_postprocess_checks_h
#define scree_postprocess_checks_h

#include <scree/boundary/body_forces.h>
#include <scree/boundary/boundary_conditions.h>
#include <scree/postprocess/statistics.h>

#include <unordered_map>

namespace scree
{
  /// Looks at the points now and then for what a sound run does not do, and logs where and when it first did.
  template <int dim>
  class RunChecks
  {
  public:
    /// All are kept by reference.
    /// @param bed null: none
    /// @param walls of the box; null: they are structures that soil may hit
    /// @param inflow_faces that soil enters through, in deal.II's numbering
    RunChecks(const BackgroundGrid<dim> &grid,
              const dealii::Tensor<1, dim> &gravity,
              const DiscreteLevelSet<dim> *bed,
              const BoundaryConditions<dim> *walls,
              const std::set<unsigned int> &inflow_faces,
              RunFolder &folder)
        : grid(grid)
        , gravity(gravity)
        , bed(bed)
        , walls(walls)
        , inflow_faces(inflow_faces)
        , folder(folder)
    {
    }

    /// Looks at the points if the last look is `least_age` steps old. Collective.
    /// @param n_lost points of soil that this rank has lost so far
    void look(const std::list<SoilBody<dim>> &bodies,
              const std::list<WaterPhase<dim>> &water,
              const double n_lost,
              const double time,
              const unsigned long long step,
              const unsigned int least_age);

    /// The worst that was seen. What does not apply is left out. Complete on the rank that writes alone.
    std::vector<CheckResult> results() const;

    /// Saves or loads the worst so far (Boost).
    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &worst &is_told &last_step &has_looked &has_soil &usual_speed_of_soil &usual_speed_of_water;
    }

  private:
    /// What a run watches itself for.
    enum Check : unsigned int
    {
      speed,     ///< fastest point over the largest speed so far that 0.1 % of the points, ten at most, exceed
      depth,     ///< of a point below the bed, over the cell size
      shrinkage, ///< V_0/V of soil
      dilation,  ///< V/V_0 of soil in contact, mean of a cell
      stress, ///< p' or vertical stress, the smaller, over rho g H of the soil, H from its lowest to its highest point;
              ///< the 99.9 % quantile by volume
      peak,   ///< the same of the point with the largest one, at any time: a point that closes a gap, for instance
      wall,   ///< displacement, m, of soil within a cell of a closed side wall, by more than a cell to it or up it
      slide,  ///< the same of soil that has moved by more than a cell along a wall at which it has stood
      lost,   ///< points of soil that left the box
      suction, ///< part of the water with suction at the start that has lost half of it at the second look
      n_checks
    };

    /// The point that is worst in a check.
    struct Suspect
    {
      double value = 0.; ///< see Check
      double found =
          0.; ///< of the point: speed, m/s, depth, m, V/V_0, way, m, the number of those lost, or suction, Pa
      std::string point; ///< body, number and place, in words
      double time = 0.;  ///< s

      template <class Archive>
      void serialize(Archive &archive, const unsigned int)
      {
        archive &value &found &point &time;
      }
    };
    using Suspects = std::array<Suspect, n_checks>;

    /// Takes a point of this rank if it is worse than those before.
    template <class Name>
    void suspect(const Check check, const double value, const double found, const Name &name);

    void look_at_places(const std::list<SoilBody<dim>> &bodies, const std::list<WaterPhase<dim>> &water);
    void look_at_dilation(const SoilBody<dim> &body);
    void look_at_walls(const std::list<SoilBody<dim>> &bodies);

    /// Keeps the pressures of points with suction at the first look. Collective.
    void keep_suction(const std::list<WaterPhase<dim>> &water);

    /// Compares those of the second look with them. Collective.
    void look_at_suction(const std::list<WaterPhase<dim>> &water);

    /// @param usual the largest speed so far that 0.1 % of the points, ten at most, exceed, m/s
    template <class Phases>
    void look_at_speeds(const Phases &phases, double &usual);

    /// A check in words; without a text it does not apply.
    CheckResult result(const unsigned int check) const;

    const BackgroundGrid<dim> &grid;
    const dealii::Tensor<1, dim> gravity;
    const DiscreteLevelSet<dim> *bed;
    const BoundaryConditions<dim> *walls;
    const std::set<unsigned int> inflow_faces;
    RunFolder &folder;
    double usual_speed_of_soil = 0., usual_speed_of_water = 0.; // see look_at_speeds(), m/s
    Suspects now, worst;
    std::array<bool, n_checks> is_told{};
    // Pressures at the first look of points with more than a quarter of the largest suction, Pa, by number, for each
    // phase of water; none after the second look, and without suction.
    std::vector<std::unordered_map<dealii::types::particle_index, double>> pressures_at_start;
    unsigned long long last_step = 0;
    bool has_looked              = false;
    bool has_soil                = false;
  };

  /// Watches mass, momentum and energy of a run in each step from its start on. The energy gain is the largest fall of
  /// the numerical dissipation, or from some steps to the next that of a channel (walls, bed, an obstacle, ...), over
  /// the released energy: that of the start which the run has turned into motion or stored, and work done on it. With
  /// mass scaling, momentum and energy are those of the scaled masses, and the kinetic energy over the work W shows
  /// whether the motion was slow: its integral over time, over that of W(end) - W. So it does not depend on the time
  /// after the motion.
  template <int dim>
  class BalanceChecks
  {
  public:
    /// @param forces besides gravity alone, they do work that is not in the energy balance
    BalanceChecks(const BackgroundGrid<dim> &grid, const BodyForces<dim> &forces)
        : grid(grid)
        , gravity(forces.gravity())
        , energy_is_closed(forces.is_gravity_alone())
        , mass_scaling(forces.mass_scaling())
    {
    }

    /// Compares the end of a step with the start, which the first look is at.
    void look(const BalanceState<dim> &now);

    /// Whether it knows the start.
    bool has_looked() const
    {
      return has_start;
    }

    /// The worst of all looks. What does not apply is left out.
    std::vector<CheckResult> results() const;

    /// Saves or loads start and worst values (Boost).
    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &has_start &soil_mass &water_mass &mass_error &mass_time;
      archive &momentum_residual &momentum_time &momentum_scale;
      archive &start_kinetic &start_potential &start_elastic &least_potential &largest_work;
      archive &dissipation &largest_dissipation &gain &gain_time;
      archive &largest_of_channels &channel_gain &channel_time &worst_channel &n_looks;
      archive &start_time &last_time &work &work_in_time &motion;
    }

  private:
    void look_at_channels(const RunBalance<dim> &totals, const double time);

    /// Energy below which nothing has moved, J.
    double least_energy() const
    {
      constexpr double of_a_cell = 1e-3; // a fall of this part of the cell size
      return of_a_cell * (soil_mass + water_mass) * gravity.norm() * grid.cell_size();
    }

    /// Energy that the run had to spend, J; 0 if too little of it for percentages.
    double released_energy() const
    {
      // Motion and elasticity of the start, fall, work. Scenes at rest release next to nothing.
      const double set_free = start_kinetic + start_potential - least_potential + largest_work;
      return set_free > least_energy() || gravity.norm() == 0. ? set_free + start_elastic : 0.;
    }

    const BackgroundGrid<dim> &grid;
    const dealii::Tensor<1, dim> gravity;
    const bool energy_is_closed;
    const double mass_scaling;

    bool has_start             = false;
    double soil_mass           = 0; // at the start, kg
    double water_mass          = 0;
    double mass_error          = 0; // largest, relative
    double mass_time           = 0; // of the largest, s
    double momentum_residual   = 0; // largest, N s
    double momentum_time       = 0; // of the largest, s
    double momentum_scale      = 0; // N s
    double start_kinetic       = 0; // J
    double start_potential     = 0;
    double start_elastic       = 0;
    double least_potential     = 0; // with that of what has left, without that of what has entered
    double largest_work        = 0; // of loads, obstacles and volume correction, J
    double dissipation         = 0; // numerical, now, J
    double largest_dissipation = -std::numeric_limits<double>::infinity(); // so far, J
    double gain                = 0;                                        // largest fall from it, J
    double gain_time           = 0;                                        // of its end, s
    std::vector<double> largest_of_channels;                               // so far, J
    double channel_gain = 0;                                               // largest fall from one of them, J
    double channel_time = 0;                                               // of its end, s
    std::string worst_channel;                                             // that fell most
    unsigned long long n_looks = 0;
    double start_time = 0, last_time = 0; // s
    double work         = 0;              // of loads, obstacles and gravity since the start, J
    double work_in_time = 0;              // its integral, J s
    double motion       = 0;              // that of the kinetic energy, J s
  };
} // namespace scree

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_step_step_report_h
#define scree_step_step_report_h

#include <scree/boundary/wall_impulses.h>
#include <scree/materials/material.h>
#include <scree/transfer/motion_sums.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/timer.h>

#include <boost/serialization/vector.hpp>

#include <vector>

namespace scree
{
  /// An archive that lists where all numbers of an object are, in the order of its serialize().
  struct NumbersOf
  {
    std::vector<double *> list; ///< valid as long as the object

    /// Lists those of an object.
    template <class T>
    explicit NumbersOf(T &object)
    {
      list.reserve(128); // more than most have
      object.serialize(*this, 0);
    }

    /// Lists these.
    NumbersOf(const std::initializer_list<double *> &numbers)
        : list(numbers)
    {
    }

    /// Replaces each number by its sum over ranks. Collective.
    void sum_over_ranks(const MPI_Comm communicator) const
    {
      std::vector<double> none;
      sum_over_ranks(communicator, none);
    }

    /// The same, and replaces others by the largest of all ranks, with one message for all. Collective.
    void sum_over_ranks(const MPI_Comm communicator, std::vector<double> &largest) const;

    /// Appends the numbers of an object.
    template <class T>
    NumbersOf &operator&(T &object)
    {
      object.serialize(*this, 0);
      return *this;
    }
    /// Appends a number.
    NumbersOf &operator&(double &number)
    {
      list.push_back(&number);
      return *this;
    }
    /// Appends the components of a vector.
    template <int dim>
    NumbersOf &operator&(dealii::Tensor<1, dim> &vector)
    {
      for (unsigned int a = 0; a < dim; ++a)
        list.push_back(&vector[a]);
      return *this;
    }
    /// Appends what is in a list.
    template <class T>
    NumbersOf &operator&(std::vector<T> &objects)
    {
      for (T &object : objects)
        *this &object;
      return *this;
    }
  };

  /// What an obstacle gave to soil and water and took from them (2D: per m).
  template <int dim>
  struct ObstacleBalance
  {
    /// Components of a moment: about z in 2D.
    static constexpr unsigned int n_rotations = dim == 2 ? 1 : 3;

    dealii::Tensor<1, dim> impulse;                ///< on soil and water but for the next, N s
    dealii::Tensor<1, dim> pressure_impulse;       ///< against the water's pressure, N s; Budget has it in its own
    dealii::Tensor<1, n_rotations> moment_impulse; ///< of both about the obstacle's pivot, N m s
    double work        = 0;                        ///< of both at the obstacle's velocity, on soil and water, J
    double dissipation = 0;                        ///< energy that is lost in contact, J

    /// Adds the moment of an impulse, N s, on an arm from the pivot, m.
    void add_moment(const dealii::Tensor<1, dim> &arm, const dealii::Tensor<1, dim> &of_impulse)
    {
      if constexpr (dim == 2)
        moment_impulse[0] += arm[0] * of_impulse[1] - arm[1] * of_impulse[0];
      else
        moment_impulse += cross_product_3d(arm, of_impulse);
    }

    /// Saves or loads all members (Boost).
    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &impulse &pressure_impulse &moment_impulse &work &dissipation;
    }
  };

  /// What a step gave to and took from soil and water at the nodes of this rank (2D: per m), and what its pressure
  /// solve took. Steps add up.
  template <int dim>
  struct Budget
  {
    dealii::Tensor<1, dim> wall_impulse; ///< N s
    WallImpulses<dim> soil_walls,        ///< of each face on the soil, without what is damped, N s; see WallForces
        water_walls;                     ///< of each face on the water, N s
    dealii::Tensor<1, dim> body_impulse; ///< gravity and body force, N s
    dealii::Tensor<1, dim>
        pressure_impulse;                ///< sum over soil and water of -V grad p: walls and surfaces push back, N s
    dealii::Tensor<1, dim> load_impulse; ///< of the surface load, N s
    dealii::Tensor<1, dim> bed_impulse;  ///< of the bed, N s
    std::vector<ObstacleBalance<dim>> obstacles; ///< of each; empty until the first step
    double wall_dissipation    = 0;              ///< energy that walls took, J
    double dashpot_dissipation = 0;              ///< of it, by dashpots of absorbing walls, J
    double bed_dissipation     = 0;              ///< energy that the bed took, J
    double contact_dissipation = 0;              ///< energy lost where bodies meet, J
    double drag_dissipation    = 0;              ///< between soil and water, J
    double viscous_dissipation = 0;              ///< of water and suspended soil, J
    double load_work           = 0;              ///< of loads, ground beyond walls, base motion (dry), J
    double correction_work     = 0;              ///< of the volume correction against gravity, J
    double pressure_work       = 0;              ///< of suction and of pressure at drained walls, J
    double motion              = 0; ///< integral of the kinetic energy over time, only with mass scaling, J s

    // Counts; doubles hold them exactly and travel like the rest.
    double n_iterations         = 0, ///< of pressure solves; on the writing rank only
        n_preconditioners       = 0; ///< set up anew; on the writing rank only
    double n_viscous_iterations = 0; ///< of viscous solves; on the writing rank only
    double n_cavitating         = 0; ///< vertices of this rank held at the cavitation pressure

    /// Adds the members of another budget, those of obstacles one by one.
    Budget &operator+=(const Budget &other)
    {
      if (obstacles.size() < other.obstacles.size())
        obstacles.resize(other.obstacles.size());
      Budget addend = other;
      addend.obstacles.resize(obstacles.size());
      const NumbersOf sums(*this), addends(addend);
      for (std::size_t i = 0; i < sums.list.size(); ++i)
        *sums.list[i] += *addends.list[i];
      return *this;
    }

    /// Impulse of all obstacles without that against the water's pressure, N s.
    dealii::Tensor<1, dim> obstacle_impulse() const
    {
      dealii::Tensor<1, dim> sum;
      for (const ObstacleBalance<dim> &obstacle : obstacles)
        sum += obstacle.impulse;
      return sum;
    }

    /// Work less dissipation of all obstacles, J.
    double obstacle_energy() const
    {
      double sum = 0.;
      for (const ObstacleBalance<dim> &obstacle : obstacles)
        sum += obstacle.work - obstacle.dissipation;
      return sum;
    }

    /// Saves or loads all members (Boost).
    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &wall_impulse &body_impulse &pressure_impulse &load_impulse &bed_impulse;
      archive &soil_walls &water_walls &obstacles;
      archive &wall_dissipation &dashpot_dissipation &bed_dissipation &contact_dissipation;
      archive &drag_dissipation &viscous_dissipation &load_work &correction_work &pressure_work &motion;
      archive &n_iterations &n_preconditioners &n_viscous_iterations &n_cavitating;
    }
  };

  /// The parts of a step whose time is reported.
  enum class TimerSection
  {
    nonlocal, ///< averages over space
    points_to_grid,
    nodes,
    bed,      ///< contact with it
    contacts, ///< of bodies
    pressure_system,
    pressure_solve,
    stress, ///< grid to soil points, and their law
    water_points,
    sort,
    waiting, ///< for the slowest rank
    repartition,
    output
  };

  /// Their names in the log.
  constexpr const char *names_of_parts[] = { "non-local strain",
                                             "points to grid",
                                             "nodes",
                                             "contact with the bed",
                                             "contact between bodies",
                                             "pressure: system",
                                             "pressure: solve",
                                             "grid to points, stress",
                                             "grid to water points",
                                             "sort into cells and ranks",
                                             "waiting for other ranks",
                                             "repartition",
                                             "output" };

  /// What the user reads.
  inline std::string name_of(const TimerSection part)
  {
    return names_of_parts[static_cast<unsigned int>(part)];
  }

  /// All parts, in the order in which they are reported.
  inline std::vector<TimerSection> step_parts()
  {
    std::vector<TimerSection> parts;
    for (unsigned int part = 0; part < std::size(names_of_parts); ++part)
      parts.push_back(static_cast<TimerSection>(part));
    return parts;
  }

  /// Adds the time from its construction to its end to a part.
  class TimedPart
  {
  public:
    /// Starts the timing of `part`.
    TimedPart(dealii::TimerOutput &timer, const TimerSection part)
        : scope(timer, name_of(part))
    {
    }

  private:
    dealii::TimerOutput::Scope scope;
  };

  /// Wall time of a part on this rank since the timer's reset, s.
  inline double seconds_of(const dealii::TimerOutput &timer, const TimerSection part)
  {
    const auto seconds = timer.get_summary_data(dealii::TimerOutput::total_wall_time);
    const auto found   = seconds.find(name_of(part));
    return found == seconds.end() ? 0. : found->second;
  }

  /// Speeds that limit the next step.
  struct Speeds
  {
    double wave   = 0; ///< largest of pressure waves in the soil, m/s
    double points = 0; ///< largest of a point of soil or water, m/s; not a number if any point's is not

    /// Takes in the speed of a pressure wave, m/s.
    void include_wave(const double speed)
    {
      wave = speed > wave ? speed : wave;
    }

    /// Takes in the speed of a point, m/s.
    void include_point(const double speed)
    {
      if (!(speed <= points) && !std::isnan(points))
        points = speed;
    }
  };

  /// What a step did, on this rank.
  template <int dim>
  struct StepReport
  {
    Budget<dim> balance;   ///< momentum and energy at the nodes
    UpdateReport material; ///< what the stress updates reported
    Speeds speeds;         ///< of the points at the end of the step
    MotionSums<dim> soil,  ///< of what moves, at the end of the step; what ground pushes out counts in the next one
        water;             ///< at the end of the step
    double n_updates = 0;  ///< points of soil and water that moved
  };
} // namespace scree

#endif

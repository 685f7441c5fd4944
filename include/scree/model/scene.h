// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_model_scene_h
#define scree_model_scene_h

#include <scree/case/case_checks.h>
#include <scree/initial/steady_seepage.h>
#include <scree/postprocess/statistics.h>
#include <scree/schemes/explicit_scheme.h>

namespace scree
{
  /// What a stage removes and adds, kg (2D: per m).
  struct StageMasses
  {
    double removed_soil  = 0; ///< of all bodies
    double removed_water = 0; ///< also of that in their pores
    double added_soil    = 0; ///< of the bodies that appear
  };

  /// What a case describes: the mesh, its walls, bodies of soil, water and loads.
  template <int dim>
  class Scene
  {
  public:
    /// Makes all of it, without points but for the markers of loads. Collective; throws EntryError if the memory is too
    /// small for the case.
    Scene(const Parameters &parameters, const MPI_Comm communicator);

    /// Fills bodies and water with points, and gives them the state that the case starts from. Collective; throws
    /// EntryError where the case does not fit itself.
    void fill();

    /// At the start of a stage: removes the points of its region, and seeds its bodies, without stress. Displacements
    /// count from here. Collective; throws EntryError where the case does not fit itself.
    StageMasses begin_stage();

    /// What acts on the soil in the step, s, that comes.
    void begin_step(const double time, const double time_step);

    /// Whether anything enters during the run.
    bool is_fed() const
    {
      return !inflows.empty() || rain;
    }

    /// Puts in the layers that enter with a step, s, from `time` on, and the drops of rain, and books them. Collective.
    /// @param pressure of the water, for its points that enter; read in scenes with water
    void
    let_in(const double time, const double time_step, const PressureOfCell<dim> &pressure, RunBalance<dim> &totals);

    /// Adds the speeds of what enters.
    void include_inflows(Speeds &speeds) const;

    /// Fits what depends on the mesh and its partition to them. Collective.
    void reinit();

    /// The blocks in which this rank's points are, and those they come through in the next `time`, s, at their
    /// velocity.
    Blocks blocks_of_points(const double time) const;

    /// The scheme that moves the points of this scene, to which it refers: chosen here and nowhere else.
    std::unique_ptr<Scheme<dim>> make_scheme(dealii::TimerOutput &timer);

    /// The speeds of the points of all ranks, before the first step. Collective.
    Speeds speeds() const;

    /// Throws EntryError, with the entry, if the viscosity is too large to compute with, or if the run would take more
    /// steps than any run can: the time would not move.
    /// @param stable_step s, at these `speeds` of all ranks
    void require_steps(const double stable_step, const Speeds &speeds) const;

    /// Soil and water do not move in this region of a gate until it is opened. Collective.
    void close_gate(const std::string &region)
    {
      for (Constraints<dim> &of_nodes : constraints)
        of_nodes.close_gate(std::make_unique<Region<dim>>(entry_name("Settling", "Gate"), region));
    }

    /// Removes the constraints of close_gate().
    void open_gate()
    {
      for (Constraints<dim> &of_nodes : constraints)
        of_nodes.open_gate();
    }

    /// Stops all points: no velocity, no affine field of velocity.
    void stop();

    /// From here on, displacements count.
    void mark_start();

    const Parameters &parameters;                         ///< the case
    const MemoryEstimate expected_memory;                 ///< estimate from the entries
    BackgroundGrid<dim> grid;                             ///< mesh and nodes of the velocity
    BoundaryConditions<dim> walls;                        ///< faces of the box acting on the soil
    std::unique_ptr<BoundaryConditions<dim>> water_walls; ///< null in a dry scene
    std::list<Constraints<dim>> constraints; ///< of the nodes; for what slides on rigid bodies, others last
    BodyForces<dim> forcing;                 ///< gravity, body force and motion of the base
    std::list<SoilBody<dim>> bodies;         ///< bodies of soil, in the order of the case
    std::list<WaterPhase<dim>> water;        ///< empty in a dry scene; one with points of its own, or one a body
    std::list<SurfaceLoad<dim>> loads;       ///< surface loads, in the order of the case
    std::list<Obstacle<dim>> obstacles;      ///< obstacles, in the order of the case
    std::list<Inflow<dim>> inflows;          ///< inflows, in the order of the case
    std::map<std::string, PlaceVariables<dim>> places_of_inflows; ///< by body; read when the first points enter
    std::optional<Rain<dim>> rain;                                ///< on the soil; nothing if it does not rain
    std::unique_ptr<LevelSet<dim>> ground;                        ///< null without a bed
    std::unique_ptr<DiscreteLevelSet<dim>> bed;                   ///< the same as the mesh sees it
    std::unique_ptr<LevelSet<dim>> union_level_set;               ///< bed and obstacles as one; null without obstacles
    std::unique_ptr<RigidBoundary<dim>> rigid_ground;             ///< bed and obstacles; null without both
    std::shared_ptr<const SeepageField<dim>> seepage;             ///< steady, before the first step; null without
    std::unique_ptr<CutCells<dim>> cut_cells;                     ///< where these cut the cells; null without both

    /// Whether suction, or water at a drained wall that holds a pressure, does work.
    bool has_pressure_work() const
    {
      return !water.empty() && (parameters.water.air_entry_pressure > 0. || water_walls->has_pressure());
    }

  private:
    void make_bodies();
    void join_ground();

    /// What bounds the water: bed and obstacles as one, if there are any.
    const LevelSet<dim> *ground_of_water() const
    {
      return union_level_set ? union_level_set.get() : ground.get();
    }

    /// The soil as steady seepage sees it. Collective.
    SeepageSurvey<dim> seepage_survey() const;

    /// Holds the nodes on which points of rigid bodies act, for soil that sticks to them. Collective.
    void hold_rigid_nodes();

    /// Fewest and most of all bodies, along an axis; without bodies as many as there are numbers, and 1.
    std::pair<unsigned int, unsigned int> points_per_cell() const;
    void fill_with_points();
    Lattice<dim> lattice_of_soil() const
    {
      return { grid.triangulation(), grid.cell_size(), ground.get(), parameters.has_water };
    }
    void set_velocity_gradients();

    /// Tells the nodes which inflow moves them. Until the next step begins they are at rest.
    void hold_at_inflows()
    {
      if (inflows.empty())
        return;
      std::vector<unsigned int> inflow_of_node(grid.numbering().n_local(), Constraints<dim>::free);
      std::vector<typename Constraints<dim>::MovedByInflow> moved;
      for (const Inflow<dim> &inflow : inflows)
        {
          for (unsigned int node = 0; node < inflow_of_node.size(); ++node)
            if (inflow.is_open && inflow.moves(node))
              inflow_of_node[node] = moved.size();
          moved.push_back({ dealii::Tensor<1, dim>(), inflow.brings_soil });
        }
      constraints.front().set_inflows(inflow_of_node, moved);
    }

    /// A point that enters.
    struct Entrant
    {
      unsigned int number;         ///< in the list of places
      dealii::Point<dim> location; ///< m
      unsigned int cell;           ///< active cell index
      dealii::Point<dim> place;    ///< in the cell, from 0 to 1 along each axis
    };

    /// Puts in points with a velocity, m/s, and books their momentum and energy; returns which of them are in cells of
    /// this rank.
    /// @param locations m, the same on all ranks
    /// @param fill writes the properties of an Entrant, which are 0 before
    template <typename Layout, typename Fill>
    std::vector<int> add_points(PointSet<dim> &points,
                                const Layout &layout,
                                const std::vector<dealii::Point<dim>> &locations,
                                const dealii::Tensor<1, dim> &velocity,
                                const Fill &fill,
                                RunBalance<dim> &totals) const;
    /// The soil and water under the rain. Collective.
    typename Rain<dim>::Columns columns_of_rain();
    /// The drops of rain of let_in().
    void
    let_rain(const double time, const double time_step, const PressureOfCell<dim> &pressure, RunBalance<dim> &totals);

    /// A layer of an inflow, at these places; see add_points().
    std::vector<int>
    add_soil(const Inflow<dim> &inflow, const std::vector<dealii::Point<dim>> &locations, RunBalance<dim> &totals);

    /// Writes the properties of a point of water that enters, and books its mass.
    /// @param volume m^3 (2D: per m)
    /// @param pressure at the corners of its cell, Pa
    void fill_with_water(const Entrant &entrant,
                         const double volume,
                         const std::array<double, (1 << dim)> &pressure,
                         std::vector<double> &properties,
                         RunBalance<dim> &totals) const
    {
      const auto &layout        = water.front().layout;
      properties[layout.mass]   = water.front().density * volume;
      properties[layout.volume] = volume;
      totals.entered_water_mass += properties[layout.mass];
      for (unsigned int v = 0; v < pressure.size(); ++v)
        {
          properties[layout.pressure] +=
              pressure[v] * dealii::GeometryInfo<dim>::d_linear_shape_function(entrant.place, v);
          const dealii::Tensor<1, dim> slope =
              dealii::GeometryInfo<dim>::d_linear_shape_function_gradient(entrant.place, v);
          for (unsigned int a = 0; a < dim; ++a)
            properties[layout.pressure_gradient + a] += pressure[v] * slope[a] / grid.cell_size();
        }
    }
    void require_points_outside_obstacles() const;

    /// The bed and the obstacles: what points in contact have slots for, in this order.
    std::vector<RigidSurface<dim>> rigid_surfaces() const;
    void set_initial_state();
    WaterParameters water_at_start; // with the surface of steady seepage once it is known
    const ContactGroups groups;
    const MPI_Comm communicator;
  };
} // namespace scree

#endif

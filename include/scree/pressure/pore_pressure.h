// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_pressure_pore_pressure_h
#define scree_pressure_pore_pressure_h

#include <scree/pressure/free_surface.h>
#include <scree/pressure/pressure_solver.h>
#include <scree/step/step_report.h>

namespace scree
{
  /// The pore pressure p at the vertices of the cells: where the water ends, p at the start of a step, and the system
  /// for its change dp, S dp = T^T (B u** - c - H T p) (SchurOperator), with the drag in S.
  template <int dim>
  class PorePressure
  {
  public:
    using AtVertices = std::array<double, (1 << dim)>; ///< a number a vertex of a cell, in deal.II's order

    /// @param cut_cells what rigid ground leaves of the cells; null: all
    PorePressure(const BackgroundGrid<dim> &grid,
                 const BoundaryConditions<dim> &walls,
                 const PressureParameters &parameters,
                 const WaterParameters &water,
                 const CutCells<dim> *cut_cells,
                 const GroundGaps<dim> &ground_gaps,
                 dealii::TimerOutput &timer);

    /// Fits the vectors to the grid's current vertices. Collective.
    void reinit();

    /// Fits it to ground that has moved, on the mesh as it was. Collective.
    void follow_ground()
    {
      surface.follow_ground();
    }

    /// Finds the water's surface and the pressure at the start of a step. Collective.
    void locate(const Mixture<dim> &mixture);

    /// Solves for the change of the pressure over a step, and for the tractions of the ground, from the predicted
    /// velocities, whose ghosts hold values. Collective.
    /// @param mixture gets the mobilities of its cells
    /// @param rows of the ground; null: there is none
    /// @param holds_pressure the pressure stays as it is, the ground alone acts
    void solve(Mixture<dim> &mixture,
               const MixtureNodes<dim> &nodes,
               GroundRows<dim> *rows,
               const bool holds_pressure,
               const double time_step,
               Budget<dim> &balance);

    /// See FreeSurface.
    void find_soil_depths(Mixture<dim> &mixture)
    {
      surface.find_soil_depths(mixture);
    }

    /// Finds divergence and force of a step, once the nodes' sums over ranks are known. Collective.
    /// @param volume sum V_p phi_i/n_p of the water at an owned node, m^3
    /// @param holds see FilledPart
    void find_pair(const Mixture<dim> &mixture,
                   const std::function<double(unsigned int node)> &volume,
                   const typename FilledPart<dim>::HoldsNode &holds,
                   const double time_step)
    {
      part.find(mixture, holds, time_step);
      schur.begin_step();
      pair.find_moments(volume);
    }

    /// Impulses of the pressure in a step, N s, at the owned nodes: of u, then of q beside it. Collective.
    const FlowField<dim> &impulses(const double time_step)
    {
      return schur.impulses(pressure, time_step, surface.suction_behind());
    }

    /// The same of its change over the step and of the ground.
    const FlowField<dim> &impulses_of_change(const double time_step)
    {
      return schur.impulses(change, time_step, nullptr, &tractions);
    }

    /// Whether there is suction, or a drained wall holds a pressure other than 0.
    bool prescribes_values() const
    {
      return surface.prescribes_values();
    }

    /// The same of suction and of the pressure at drained walls, which do work. Collective.
    const FlowField<dim> &prescribed_impulses(const double time_step);

    /// The same of the potential as of a pressure.
    const FlowField<dim> &impulses_of_potential(const double time_step)
    {
      return schur.impulses(potential, time_step);
    }

    /// What the water of find_pair() fills under the function of an owned node, m^3.
    double filled_volume(const unsigned int node) const
    {
      return pair.filled_volume(node);
    }

    /// The nodes of a step, to be set before solve().
    PressedNodes<dim> pressed_nodes;

    /// Adds the change to the pressure, which is that of the end of the step from here on. Collective.
    void accept_change();

    /// Finds the potential whose flux, with the matrix of the last solve(), is `source`, m^3/s. Collective.
    void solve_potential(const VertexVector &source, Budget<dim> &balance);

    /// Writes what the next step's solves begin with into a state, of all ranks. Collective.
    void save(SolverState<dim> &state) const;

    /// Sets what of it this rank has, after reinit(). Collective.
    void load(const SolverState<dim> &state);

    /// Pressure at the vertices of a cell with points, Pa, in deal.II's order.
    AtVertices pressure_of(const unsigned int cell) const
    {
      AtVertices result = at_vertices(pressure, cell);
      if (const VertexVector *suction = surface.suction_behind())
        for (unsigned int v = 0; v < result.size(); ++v)
          result[v] += suction->local_element(vertices.nodes(cell)[v]);
      return result;
    }

    /// Values of a vector at the vertices of a cell.
    AtVertices at_vertices(const VertexVector &values, const unsigned int cell) const;

    /// The free surface, as locate() has found it.
    const FreeSurface<dim> &free_surface() const
    {
      return surface;
    }

    /// The vertices of a cell of this rank, in deal.II's order.
    const unsigned int *vertices_of(const unsigned int cell) const
    {
      return vertices.nodes(cell);
    }

    /// Makes room for a number a vertex.
    void reinit(VertexVector &vector) const
    {
      vector.reinit(vertices.partitioner());
    }

  private:
    void reinit_vectors();

    /// What a pressure gradient does to the flow in the cells.
    void find_mobilities(Mixture<dim> &mixture, const double time_step) const;

    /// Adds a solve to the counts of the run.
    void count(const SolveReport &report, Budget<dim> &balance) const;

    const BackgroundGrid<dim> &grid;
    const double relative_tolerance, bulk_modulus, cavitation_pressure;
    dealii::TimerOutput &timer;

    const NodeNumbering<dim> &vertices;
    FreeSurface<dim> surface;
    FilledPart<dim> part;
    PressurePair<dim> pair;
    SchurOperator<dim> schur;
    PressureSolver<dim> solver;
    VertexVector pressure, change, source, potential;
    typename GroundRows<dim>::Vectors tractions; // of the last solve, Pa
  };
} // namespace scree

#endif

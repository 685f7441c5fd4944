// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_pressure_schur_operator_h
#define scree_pressure_schur_operator_h

#include <scree/boundary/drag_block.h>
#include <scree/pressure/ground_rows.h>
#include <scree/pressure/pressure_pair.h>
#include <scree/transfer/water_transfer.h>

#include <vector>

namespace scree
{
  /// A node as the pressure sees it: soil and water with their drag, where walls leave them free to move.
  template <int dim>
  struct PressedNode
  {
    unsigned int node;     ///< owned
    double porosity;       ///< n_i: of soil alone 0; of water alone, or that sees no grains, 1: soil feels no pressure
    DragMobility mobility; ///< without walls; of the soil 0 where no soil takes part
    unsigned int held;     ///< number of its DragBlock among those that walls hold, or `free`

    static constexpr unsigned int free = dealii::numbers::invalid_unsigned_int; ///< no wall holds it
  };

  /// The nodes of a step that soil or water act on.
  template <int dim>
  struct PressedNodes
  {
    std::vector<PressedNode<dim>> all;        ///< owned
    std::vector<DragBlock<dim>> held;         ///< see PressedNode
    std::vector<unsigned int> without_grains; ///< with soil that no water sees; also ghosts

    /// Takes the pair's force on the discharge as one on u, where the force of rows on soil would else be mixed with
    /// it: there the discharge of the pair is that of the water alone.
    void pass_on_forces(FlowField<dim> &forces) const
    {
      for (const unsigned int node : without_grains)
        for (unsigned int c = 0; c < dim; ++c)
          {
            forces[node][c] += forces[node][dim + c];
            forces[node][dim + c] = 0.;
          }
    }

    /// Its transpose: writes u to the discharge that the pair reads, after rows have read theirs.
    void pass_on_flow(FlowField<dim> &flow) const
    {
      for (const unsigned int node : without_grains)
        std::copy_n(flow[node], dim, flow[node] + dim);
    }

    /// What a force on u and one on q beside it, in a node's numbers of a FlowField, give soil and water, N.
    static SoilAndWater<dim> forces(const PressedNode<dim> &node, const double *of_flow)
    {
      SoilAndWater<dim> result;
      for (unsigned int c = 0; c < dim; ++c)
        {
          result.water[c] = node.porosity * (of_flow[c] + of_flow[dim + c]);
          result.soil[c]  = node.porosity < 1.        ? of_flow[c] - result.water[c]
                            : node.mobility.soil > 0. ? -of_flow[dim + c]
                                                      : 0.; // of rows alone
        }
      return result;
    }

    /// Writes the flow of velocities of soil and water, m/s.
    static void set_flow(const PressedNode<dim> &node, const SoilAndWater<dim> &velocity, double *of_flow)
    {
      for (unsigned int c = 0; c < dim; ++c)
        {
          const double soil = node.porosity < 1. || node.mobility.soil > 0. ? velocity.soil[c] : 0.;
          of_flow[dim + c]  = node.porosity * (velocity.water[c] - soil);
          of_flow[c]        = soil + of_flow[dim + c];
        }
    }

    /// Velocities, m/s, that impulses on soil and water, N s, give.
    SoilAndWater<dim> solve(const PressedNode<dim> &node, const SoilAndWater<dim> &impulses) const
    {
      if (node.held != PressedNode<dim>::free)
        return held[node.held].solve(impulses);
      return { node.mobility.soil * impulses.soil + node.mobility.other * impulses.water,
               node.mobility.other * impulses.soil + node.mobility.water * impulses.water };
    }
  };

  /// The matrix of the pressure and of the tractions of rigid ground,
  ///
  ///     [ T^T (dt B A^-1 B^T + H) T    T^T dt B A^-1 N^T ]
  ///     [ dt N A^-1 B^T T              dt N A^-1 N^T     ],
  ///
  /// on the unknown vertices and the rows of the ground, applied and never stored: B of PressurePair, T of FreeSurface,
  /// N of GroundRows, masses, drag and walls in A, and H, which sees what B^T does not: the pressures of a cell that
  /// are not linear, at a hundredth of what a gradient of that size costs, in proportion to the part of the cell that
  /// is wet.
  template <int dim>
  class SchurOperator
  {
  public:
    /// All are kept by reference.
    SchurOperator(const BackgroundGrid<dim> &grid,
                  const NodeNumbering<dim> &vertices,
                  FreeSurface<dim> &surface,
                  const FilledPart<dim> &part,
                  const PressurePair<dim> &pair);

    /// Fits it to the grid's current partition.
    void reinit();

    /// Makes room for the flow of the cells that have a part, before a new step.
    void begin_step();

    using RowVectors = typename GroundRows<dim>::Vectors; ///< a vector a row of the ground

    /// Sets the matrix of a step; nodes and rows must live on.
    /// @param rows of this rank; null: none on any
    void assemble(const Mixture<dim> &mixture,
                  const PressedNodes<dim> &nodes,
                  const GroundRows<dim> *rows,
                  const double time_step);

    /// Sets `target` to the flow, m^dim/s, of a pressure at the unknown owned vertices (the other ones of `pressure`
    /// are not read) and of tractions, Pa, and `flows` to that into the ground. Collective.
    void vmult(VertexVector &target, RowVectors &flows, const VertexVector &pressure, const RowVectors &tractions);

    /// Sets `target` to the diagonal of S at the unknown owned vertices, m^3/(Pa s), nearly: each cell counts by
    /// itself. To be called after assemble(). Collective.
    void find_diagonal(VertexVector &target);

    /// For GroundRows::set_mobilities(), without walls and with ghosts; to be read before the next call. Collective.
    const FlowField<dim> &mobilities();

    /// Sets `target` to T^T (B u - c - H p), m^3/s, with c of the ground that is not yet reached or moves.
    /// Collective.
    /// @param pressure at all vertices, with ghosts
    void find_source(const MixtureNodes<dim> &of_mixture, const VertexVector &pressure, VertexVector &target);

    /// Sets impulses of a pressure, N s, at the owned nodes: of u, then of q beside it. Collective.
    /// @param pressure at all vertices, with ghosts
    /// @param suction the same, of the discharge alone; may be null
    /// @param tractions of the ground, Pa; may be null
    const FlowField<dim> &impulses(const VertexVector &pressure,
                                   const double time_step,
                                   const VertexVector *suction = nullptr,
                                   const RowVectors *tractions = nullptr);

  private:
    /// Adds `factor` H p.
    void add_hourglass(const double factor, const VertexVector &pressure, VertexVector &sums) const;

    void clear_flow();

    const BackgroundGrid<dim> &grid;
    const NodeNumbering<dim> &vertices;
    FreeSurface<dim> &surface;
    const FilledPart<dim> &part;
    const PressurePair<dim> &pair;
    const PressedNodes<dim> *nodes = nullptr;
    const GroundRows<dim> *rows    = nullptr;
    std::vector<PressedNode<dim>> reached; // of the nodes, by the parts and rows of any rank
    double time_step = 0;
    std::vector<double> stiffness; // of H in a part's cell, m^3/(Pa s)
    FlowField<dim> flow;
    VertexVector full;
  };
} // namespace scree

#endif

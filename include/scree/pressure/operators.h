// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_pressure_operators_h
#define scree_pressure_operators_h

#include <scree/boundary/drag_block.h>
#include <scree/pressure/filled_part.h>
#include <scree/pressure/ground_rows.h>

namespace scree
{
  /// The operators of a step: divergence B, force of a pressure B^T, and the matrix of pressure and tractions S.
  ///
  /// B and its transpose act on the flow at the nodes. As they are transposes, the pressure's work is what B leaves of
  /// the divergence, and pressure makes no energy, whatever the part of the cells that water fills is taken to be.
  ///
  /// (B u)_a = - int psi_a div u + int_Gamma psi_a u.nu + sum_c grad psi_a . sum_i delta_ci q_i
  ///
  /// over the part of the cells that water fills, and the ground and walls Gamma that bound it, but for walls that no
  /// point has reached; nu points out of it. So what walls give the soil is the effective stress. The sum makes gravity
  /// on scattered points a gradient of pressure, nearly: Delta_i = sum V_p phi_i/n_p - int phi_i is what the water's
  /// points have at a node beside the part; each cell takes its share of it but for the mean, which is passed on to the
  /// nodes. sum_i delta_ci = 0, so that a uniform flow has no divergence, and forces add up to 0.
  ///
  /// The matrix of the pressure and of the tractions of rigid ground,
  ///
  ///     S = [ T^T (dt B A^-1 B^T + H) T    T^T dt B A^-1 N^T ]
  ///         [ dt N A^-1 B^T T              dt N A^-1 N^T     ],
  ///
  /// on the unknown vertices and the rows of the ground, is applied and never stored: T of FreeSurface, N of
  /// GroundRows, masses, drag and walls in A, and H, which sees what B^T does not: the pressures of a cell that are not
  /// linear, at a hundredth of what a gradient of that size costs, in proportion to the part of the cell that is wet.
  template <int dim>
  class PressureOperators
  {
  public:
    /// A at an owned node.
    using BlockAt = std::function<DragBlock<dim>(const unsigned int node)>;
    /// A number of an owned node.
    using AtNode = std::function<double(const unsigned int node)>;
    /// Of pressures and tractions.
    using Vector = PressuresAndTractions<dim>;

    /// All are kept by reference.
    /// @param vertices the numbering of linear functions on the grid
    /// @param cut_cells what rigid ground leaves of the cells; null: all
    PressureOperators(const BackgroundGrid<dim> &grid,
                      const NodeNumbering<dim> &vertices,
                      FreeSurface<dim> &surface,
                      const CutCells<dim> *cut_cells,
                      const GroundGaps<dim> &gaps);

    /// Fits them to the grid's current partition.
    void reinit();

    /// Finds B of a step whose surface is known. Collective.
    /// @param volume sum V_p phi_i/n_p of the water at an owned node, m^dim
    /// @param holds see FilledPart
    void integrate(const Mixture<dim> &mixture,
                   const AtNode &volume,
                   const typename FilledPart<dim>::HoldsNode &holds,
                   const double time_step);

    /// Finds A and H of a step, after integrate(). Rows must live on.
    /// @param block_at A, as the pressure moves soil and water
    /// @param rows of this rank; null: none on any
    void assemble(const Mixture<dim> &mixture,
                  const WetNodes<dim> &nodes,
                  const BlockAt &block_at,
                  const GroundRows<dim> *rows,
                  const double time_step);

    /// Sets `target` to S times `source`: the flow, m^dim/s, of pressures and of tractions, Pa. Collective.
    void vmult(Vector &target, const Vector &source);

    /// Sets `target` to the diagonal of S at the owned unknowns, m^dim/(Pa s), nearly: each cell counts by itself.
    /// Collective.
    void find_diagonal(std::vector<double> &target);

    /// For GroundRows::set_responses(), without walls and with ghosts; to be read before the next call. Collective.
    const FlowField<dim> &inverse_masses();

    /// Sets `target` to T^T (B u - c - H p), m^dim/s, by owned unknown, with c of the ground that is not yet reached or
    /// moves. Collective.
    /// @param pressure at all vertices, with ghosts
    void find_source(const WetNodes<dim> &nodes, const VertexVector &pressure, std::vector<double> &target);

    /// Sets impulses of a pressure, N s, at the owned nodes: of u, then of q beside it. Collective.
    /// @param pressure at all vertices, with ghosts
    /// @param suction the same, of the discharge alone; may be null
    /// @param tractions of the ground, Pa; may be null
    const FlowField<dim> &impulses(const VertexVector &pressure,
                                   const double time_step,
                                   const VertexVector *suction                        = nullptr,
                                   const typename GroundRows<dim>::Vectors *tractions = nullptr);

    /// Adds B of a flow whose ghosts hold values to `sums`, m^dim/s; owned vertices hold this rank's part.
    void add_divergence(const FlowField<dim> &flow, VertexVector &sums) const;

    /// Adds -B^T p to forces, N: this rank's part.
    /// @param pressure Pa, with ghosts
    void add_force(const VertexVector &pressure, FlowField<dim> &forces) const;

    /// int phi_i over the filled parts, of an owned node, m^dim.
    double filled_volume(const unsigned int node) const
    {
      return defects[node][volume];
    }

    /// Where water fills the cells.
    const FilledPart<dim> &filled_part() const
    {
      return part;
    }

  private:
    /// A node as the pressure sees it: soil and water with their drag, where walls leave them free to move.
    struct Node
    {
      unsigned int node;     // owned
      double porosity;       // n_i
      InverseMasses inverse; // without walls; of the soil 0 where there is none
      unsigned int held;     // number of its DragBlock among those that walls hold, or `free`

      static constexpr unsigned int free = dealii::numbers::invalid_unsigned_int;
    };

    /// Of a node.
    enum Defect : unsigned int
    {
      volume, // int phi_i, m^dim
      surplus // Delta_i, m^dim
    };

    /// Finds the volumes and the moments delta_ci.
    void find_moments(const AtNode &bulk_volume);
    /// A pass of these: cells take their shares, and pass their means on to the nodes.
    void share_surplus();

    /// Adds to the force on the discharge that of a pressure which acts on this alone, N: - int phi_i grad t.
    void add_suction(const VertexVector &pressure, FlowField<dim> &forces) const;

    /// Sets the flow to the forces of pressure and tractions on u and q, N, of all ranks.
    void find_forces(const VertexVector &pressure,
                     const VertexVector *suction,
                     const typename GroundRows<dim>::Vectors *tractions);

    /// Calls `write(node, numbers of the flow there)` at the reached nodes; ghosts follow. Collective.
    template <typename Function>
    void find_flow(const Function &write);

    /// Sets `full` to B of the flow: this rank's part.
    void find_divergence();

    /// Velocities, m/s, that impulses on soil and water, N s, give: A^-1.
    SoilAndWater<dim> solve(const Node &node, const SoilAndWater<dim> &impulses) const;

    /// Adds `factor` H p.
    void add_hourglass(const double factor, const VertexVector &pressure, VertexVector &sums) const;

    void clear_flow();

    const BackgroundGrid<dim> &grid;
    const NodeNumbering<dim> &vertices;
    FreeSurface<dim> &surface;
    FilledPart<dim> part;
    NodeValues<dim, 2> defects;   // Defect
    NodeValues<dim, 1> passed_on; // what is surplus next, m^dim
    std::vector<NodeRow> moments; // delta_ci: rows of the parts' cells

    std::vector<Node> reached;                // owned nodes, by the parts and rows of any rank
    std::vector<DragBlock<dim>> held;         // see Node
    std::vector<unsigned int> without_mass;   // owned nodes that they reach, but no point
    std::vector<unsigned int> without_grains; // nodes with soil that no water sees; also ghosts
    const GroundRows<dim> *rows = nullptr;
    double time_step            = 0;
    std::vector<double> stiffness; // of H in a part's cell, m^dim/(Pa s)
    FlowField<dim> flow;
    VertexVector full, sums;
  };
} // namespace scree

#endif

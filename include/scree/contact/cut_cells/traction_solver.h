// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_contact_cut_cells_traction_solver_h
#define scree_contact_cut_cells_traction_solver_h

#include <scree/boundary/constraints.h>
#include <scree/mesh/node_rows.h>
#include <scree/pressure/ground_rows.h>
#include <scree/step/step_report.h>

#include <vector>

namespace scree
{
  /// Finds the tractions of rigid ground on soil without water: the least of the kinetic energy under the constraints
  /// of GroundRows, by an accelerated projected gradient (@source{nesterov1983}) in which each row has a step of its
  /// own. With water, PorePressure finds them.
  ///
  /// Nodes on walls of the box do not move into them. The result does not depend on the number of ranks but for
  /// rounding.
  template <int dim>
  class TractionSolver
  {
  public:
    /// Keeps references to both.
    TractionSolver(const BackgroundGrid<dim> &grid, const Constraints<dim> &constraints);

    /// Fits the messages to the grid's current partition.
    void reinit()
    {
      messages.reinit();
      number_of_node.assign(grid.numbering().n_local(), none);
    }

    /// Finds the tractions of the rows, from those that they hold, and the velocities after them. Collective.
    /// @param field solved without ground; ghosts hold values, before and after
    void solve(GroundRows<dim> &rows, NodalField<dim> &field, const double time_step, Budget<dim> &balance);

    /// Flow at a row, m^dim/s, of the velocities with which the tractions did work in the step, see
    /// working_velocity().
    dealii::Tensor<1, dim> working_flow(const GroundRows<dim> &rows, const unsigned int row) const
    {
      return to_vector<dim>(flow_of_motions(rows, row));
    }

  private:
    static constexpr unsigned int none = dealii::numbers::invalid_unsigned_int;

    struct Node
    {
      unsigned int node;             // of the grid
      dealii::Tensor<1, dim> before; // velocity without the tractions, m/s
    };

    /// Lists the nodes of the rows. Collective.
    void begin(const GroundRows<dim> &rows, const NodalField<dim> &field);
    void add_node(const unsigned int node, const NodalField<dim> &field);

    /// Sums `forces` over ranks: owned nodes hold the whole afterwards. Collective.
    /// @param field given: nodes of other ranks' rows alone are listed, too
    void add_at_owners(const NodalField<dim> *field = nullptr);

    /// Hands them to the ranks with rows at these nodes. Collective.
    void take_from_owners();

    /// The force of a node, N, for a message.
    void write_force(const unsigned int node, double *numbers) const
    {
      for (unsigned int c = 0; c < dim; ++c)
        numbers[c] = forces[number_of_node[node]][c];
    }

    /// Sets the steps of the rows: 1 over the sum of a row of dt N A^-1 N^T. Collective.
    void find_steps(const GroundRows<dim> &rows, const NodalField<dim> &field, const double time_step);

    /// Sets the changes of velocity by tractions on the rows. Collective.
    /// @param is_last at owned nodes alone
    void find_motions(const GroundRows<dim> &rows,
                      const typename GroundRows<dim>::Vectors &tractions,
                      const double time_step,
                      const bool is_last);

    NodeRow flow_of_motions(const GroundRows<dim> &rows, const unsigned int row) const
    {
      const unsigned int n = grid.n_nodes_per_cell();
      NodeRow flow{};
      for (unsigned int i = 0; i < n; ++i)
        flow += rows.weight(row, i) * motions[number_of_corner[row * n + i]];
      return flow;
    }

    /// Writes the velocities to the field, ghosts included, where walls are not gone into, books what they get, and
    /// sets the motions to the working velocities. Collective.
    void write(NodalField<dim> &field, const double time_step, Budget<dim> &balance);

    const BackgroundGrid<dim> &grid;
    const Constraints<dim> &constraints;
    NodeMessages<dim> messages;
    std::vector<unsigned int> number_of_node;   // of the grid's nodes; `none`: not there
    std::vector<unsigned int> number_of_corner; // of the nodes of the rows, a row's behind each other
    std::vector<Node> nodes;
    std::vector<NodeRow> motions, inverse_masses, forces; // by number: m/s, 1/kg along each axis, N on the ground
    std::vector<double> steps;                            // by row
    typename GroundRows<dim>::Vectors last, extrapolated; // tractions
  };
} // namespace scree

#endif

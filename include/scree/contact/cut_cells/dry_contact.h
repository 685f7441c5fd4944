// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_contact_cut_cells_dry_contact_h
#define scree_contact_cut_cells_dry_contact_h

#include <scree/boundary/constraints.h>
#include <scree/pressure/bounded_program.h>
#include <scree/step/step_report.h>

#include <vector>

namespace scree
{
  /// The tractions of rigid ground on soil without water: the program of PorePressure without pressures, whose matrix
  /// is dt N M^-1 N^T. Directions that walls of the box hold at a node take no part.
  template <int dim>
  class DryContact
  {
  public:
    using Vectors = typename GroundRows<dim>::Vectors; ///< a vector a row

    /// Keeps references to both.
    DryContact(const BackgroundGrid<dim> &grid, const Constraints<dim> &constraints);

    /// Fits it to the grid's current nodes.
    void reinit()
    {
      messages.reinit();
      flow.reinit();
      inverse_masses.resize(grid.numbering().n_local());
    }

    /// Finds the tractions of the rows, from those that they hold, and the velocities after them. Returns the flows at
    /// the rows, m^dim/s, of the velocities with which the tractions do work in the step, see working_velocity().
    /// Collective.
    /// @param field solved without ground; ghosts hold values, before and after
    Vectors solve(GroundRows<dim> &rows, NodalField<dim> &field, const double time_step, Budget<dim> &balance);

  private:
    using Vector = PressuresAndTractions<dim>;

    /// Finds the masses of the nodes of the rows. Collective.
    void find_inertia(GroundRows<dim> &rows, const NodalField<dim> &field, const double time_step);

    /// Lists the nodes of the rows that other ranks own. Collective.
    void list_ghosts();

    /// Hands the owners' flow at these nodes to this rank: `n` numbers. Collective.
    void take_from_owners(const unsigned int n = dim)
    {
      messages.from_owners(
          n,
          [&](const unsigned int node, double *numbers) { std::copy_n(flow[node], n, numbers); },
          [&](const unsigned int node, const double *numbers) { std::copy_n(numbers, n, flow[node]); });
    }

    /// Sets the flow at owned nodes to what tractions, Pa, give to them, N. Collective.
    void find_forces(const Vectors &tractions);

    /// Solves the program. Collective.
    void find_tractions();

    /// Writes the velocities to the field, ghosts included, where walls are not gone into, books what they get, and
    /// sets the flow to the working velocities. Collective.
    void write(NodalField<dim> &field, const double time_step, Budget<dim> &balance);

    const BackgroundGrid<dim> &grid;
    const Constraints<dim> &constraints;
    BoundedProgram<dim> program;
    GroundRows<dim> *rows = nullptr; // of a solve
    double step           = 0.;      // s
    FlowField<dim> flow;             // of u
    NodeMessages<dim> messages;
    std::vector<unsigned int> ghosts;                   // of the rows
    std::vector<dealii::Tensor<1, dim>> inverse_masses; // of active owned nodes of the flow, along each axis, 1/kg
  };
} // namespace scree

#endif

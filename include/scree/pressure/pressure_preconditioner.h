// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_pressure_pressure_preconditioner_h
#define scree_pressure_pressure_preconditioner_h

#include <scree/pressure/pressure_operator.h>

#include <deal.II/lac/trilinos_precondition.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <vector>

namespace scree
{
  /// Preconditioner of the vertices that were unknown when it was made: algebraic multigrid, or of small systems on few
  /// ranks a direct solver of each rank's block.
  template <int dim>
  class PressurePreconditioner
  {
  public:
    /// Stores the matrix and factorises it. Collective.
    explicit PressurePreconditioner(const PressureOperator<dim> &system);

    /// Sets `preconditioned` to what the preconditioner makes of `remainder`, both by owned unknown: vertices that have
    /// become unknown since it was made get that over their own diagonal. Collective.
    void vmult(std::vector<double> &preconditioned, const std::vector<double> &remainder);

  private:
    void choose();
    void make_multigrid(const unsigned int most_on_coarsest);

    const PressureOperator<dim> &system;
    dealii::TrilinosWrappers::SparseMatrix matrix; // The others refer to it.
    dealii::TrilinosWrappers::PreconditionAMG multigrid;
    dealii::TrilinosWrappers::PreconditionBlockwiseDirect blocks;
    dealii::TrilinosWrappers::PreconditionBase *chosen = nullptr; // null: there was no unknown

    std::vector<unsigned int> unknowns; // owned vertices of the rows
    VertexVector source, result;        // by row
  };
} // namespace scree

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/grid/node_numbering.h>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_bernstein.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_tools.h>
#include <deal.II/lac/la_parallel_vector.h>

#include <algorithm>

namespace scree
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    std::unique_ptr<FiniteElement<dim>> make_element(const Basis basis)
    {
      if (basis == Basis::linear)
        return std::make_unique<FE_Q<dim>>(1);
      return std::make_unique<FE_Bernstein<dim>>(2);
    }
  } // namespace


  template <int dim>
  NodeNumbering<dim>::NodeNumbering(const Basis basis)
      : basis(basis)
  {
  }


  template <int dim>
  void NodeNumbering<dim>::distribute(const parallel::distributed::Triangulation<dim> &mesh, const double width)
  {
    const auto fe = make_element<dim>(basis);
    DoFHandler<dim> dof_handler(mesh);
    dof_handler.distribute_dofs(*fe);

    const unsigned int n = n_nodes_1d(), n_nodes = n_nodes_per_cell();
    const auto lexicographic = FETools::lexicographic_to_hierarchic_numbering<dim>(n - 1);

    cell_nodes.assign(std::size_t(mesh.n_active_cells()) * n_nodes, numbers::invalid_unsigned_int);
    cell_open_knots.assign(mesh.n_active_cells(), 0);

    // The free coefficient behind each shape function of each owned cell: an index on an interior C1 face stands for
    // the coefficient inside the neighbour.
    std::vector<types::global_dof_index> masters(cell_nodes.size(), numbers::invalid_dof_index), dofs(n_nodes);
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          OpenKnots open = 0;
          for (const unsigned int f : cell->face_indices())
            if (basis != Basis::spline || cell->at_boundary(f))
              open |= 1 << f;
          cell_open_knots[cell->active_cell_index()] = open;

          for (unsigned int i = 0; i < n_nodes; ++i)
            {
              auto owner         = cell;
              unsigned int index = 0;
              for (unsigned int a = 0, rest = i, stride = 1; a < dim; ++a, rest /= n, stride *= n)
                {
                  const unsigned int position = rest % n;
                  const unsigned int face     = 2 * a + (position == n - 1);
                  const bool on_face          = position == 0 || position == n - 1;
                  if (on_face && !((open >> face) & 1))
                    {
                      owner = owner->neighbor(face);
                      index += stride; // its interior coefficient
                    }
                  else
                    index += stride * position;
                }
              owner->get_dof_indices(dofs);
              masters[cell->active_cell_index() * n_nodes + i] = dofs[lexicographic[index]];
            }
        }

    // Number the free coefficients compactly and find out the numbers of the ghosts.
    std::vector<types::global_dof_index> used;
    std::copy_if(masters.begin(), masters.end(), std::back_inserter(used), [](const auto dof) {
      return dof != numbers::invalid_dof_index;
    });
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());

    const IndexSet &owned_dofs = dof_handler.locally_owned_dofs();
    IndexSet ghost_dofs(dof_handler.n_dofs());
    ghost_dofs.add_indices(used.begin(), used.end());
    LinearAlgebra::distributed::Vector<double> number(owned_dofs, ghost_dofs, mesh.get_communicator());

    const types::global_dof_index n_owned =
        std::count_if(used.begin(), used.end(), [&](const auto dof) { return owned_dofs.is_element(dof); });
    const IndexSet owned = Utilities::MPI::create_ascending_partitioning(
        mesh.get_communicator(), n_owned)[Utilities::MPI::this_mpi_process(mesh.get_communicator())];

    auto next = owned.begin();
    for (const auto dof : used)
      if (owned_dofs.is_element(dof))
        number(dof) = *next++;
    number.update_ghost_values();

    IndexSet ghosts(owned.size());
    for (const auto dof : used)
      if (!owned_dofs.is_element(dof))
        ghosts.add_index(static_cast<types::global_dof_index>(number(dof)));
    distribution = std::make_shared<Utilities::MPI::Partitioner>(owned, ghosts, mesh.get_communicator());

    // Where the nodes are.
    positions.assign(n_owned + ghosts.n_elements(), Point<dim>());
    face_flags.assign(positions.size(), 0);
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const unsigned int c = cell->active_cell_index();
          const OpenKnots open = cell_open_knots[c];
          for (unsigned int i = 0; i < n_nodes; ++i)
            {
              const unsigned int node = distribution->global_to_local(
                  static_cast<types::global_dof_index>(number(masters[std::size_t(c) * n_nodes + i])));
              cell_nodes[std::size_t(c) * n_nodes + i] = node;
              for (unsigned int a = 0, rest = i; a < dim; ++a, rest /= n)
                {
                  const unsigned int position = rest % n;
                  const unsigned int face     = 2 * a + (position == n - 1);
                  positions[node][a] =
                      cell->vertex(0)[a] + width * (n == 3 ? CellBasis<dim, 3>::node_positions(open, a)[position]
                                                           : CellBasis<dim, 2>::node_positions(open, a)[position]);
                  if ((position == 0 || position == n - 1) && cell->at_boundary(face))
                    face_flags[node] |= 1 << face;
                }
            }
        }
  }

  template class NodeNumbering<2>;
  template class NodeNumbering<3>;
} // namespace scree

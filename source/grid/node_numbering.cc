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


    template <int dim>
    std::vector<OpenKnots> open_knots_of_cells(const Triangulation<dim> &mesh, const Basis basis)
    {
      std::vector<OpenKnots> result(mesh.n_active_cells(), 0);
      for (const auto &cell : mesh.active_cell_iterators())
        if (cell->is_locally_owned())
          for (const unsigned int f : cell->face_indices())
            if (basis != Basis::spline || cell->at_boundary(f))
              result[cell->active_cell_index()] |= 1 << f;
      return result;
    }


    /// The free coefficient behind each shape function of each owned cell: an index on an interior C1 face stands for
    /// the coefficient inside the neighbour.
    template <int dim>
    std::vector<types::global_dof_index> free_coefficients(const DoFHandler<dim> &dof_handler,
                                                           const std::vector<OpenKnots> &open_knots)
    {
      const auto &fe       = dof_handler.get_fe();
      const unsigned int n = fe.degree + 1, n_nodes = fe.n_dofs_per_cell();
      const auto lexicographic = FETools::lexicographic_to_hierarchic_numbering<dim>(fe.degree);
      std::vector<types::global_dof_index> masters(open_knots.size() * n_nodes, numbers::invalid_dof_index),
          dofs(n_nodes);
      for (const auto &cell : dof_handler.active_cell_iterators())
        if (cell->is_locally_owned())
          for (unsigned int i = 0; i < n_nodes; ++i)
            {
              auto owner         = cell;
              unsigned int index = 0;
              for (unsigned int a = 0, rest = i, stride = 1; a < dim; ++a, rest /= n, stride *= n)
                {
                  const unsigned int position = rest % n;
                  const unsigned int face     = 2 * a + (position == n - 1);
                  const bool on_face          = position == 0 || position == n - 1;
                  if (on_face && !((open_knots[cell->active_cell_index()] >> face) & 1))
                    {
                      owner = owner->neighbor(face);
                      index += stride; // its interior coefficient
                    }
                  else
                    index += stride * position;
                }
              owner->get_dof_indices(dofs);
              masters[std::size_t(cell->active_cell_index()) * n_nodes + i] = dofs[lexicographic[index]];
            }
      return masters;
    }


    /// Numbers the free coefficients compactly, which replaces those of `masters` by their new numbers, and finds out
    /// the numbers of the ghosts. Collective.
    template <int dim>
    std::shared_ptr<const Utilities::MPI::Partitioner> number_compactly(const DoFHandler<dim> &dof_handler,
                                                                        std::vector<types::global_dof_index> &masters)
    {
      const MPI_Comm communicator = dof_handler.get_communicator();
      std::vector<types::global_dof_index> used;
      std::copy_if(masters.begin(), masters.end(), std::back_inserter(used), [](const auto dof) {
        return dof != numbers::invalid_dof_index;
      });
      std::sort(used.begin(), used.end());
      used.erase(std::unique(used.begin(), used.end()), used.end());

      const IndexSet &owned_dofs = dof_handler.locally_owned_dofs();
      IndexSet ghost_dofs(dof_handler.n_dofs());
      ghost_dofs.add_indices(used.begin(), used.end());
      LinearAlgebra::distributed::Vector<double> number(owned_dofs, ghost_dofs, communicator);

      const types::global_dof_index n_owned =
          std::count_if(used.begin(), used.end(), [&](const auto dof) { return owned_dofs.is_element(dof); });
      const IndexSet owned = Utilities::MPI::create_ascending_partitioning(
          communicator, n_owned)[Utilities::MPI::this_mpi_process(communicator)];

      auto next = owned.begin();
      for (const auto dof : used)
        if (owned_dofs.is_element(dof))
          number(dof) = *next++;
      number.update_ghost_values();

      IndexSet ghosts(owned.size());
      for (const auto dof : used)
        if (!owned_dofs.is_element(dof))
          ghosts.add_index(static_cast<types::global_dof_index>(number(dof)));
      for (auto &master : masters)
        if (master != numbers::invalid_dof_index)
          master = static_cast<types::global_dof_index>(number(master));
      return std::make_shared<Utilities::MPI::Partitioner>(owned, ghosts, communicator);
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

    cell_open_knots   = open_knots_of_cells(mesh, basis);
    auto global_nodes = free_coefficients(dof_handler, cell_open_knots);
    distribution      = number_compactly(dof_handler, global_nodes);
    place_nodes(mesh, width, global_nodes);
  }


  template <int dim>
  void NodeNumbering<dim>::place_nodes(const Triangulation<dim> &mesh,
                                       const double width,
                                       const std::vector<types::global_dof_index> &global_nodes)
  {
    const unsigned int n = n_nodes_1d(), n_nodes = n_nodes_per_cell();
    cell_nodes.assign(global_nodes.size(), numbers::invalid_unsigned_int);
    positions.assign(distribution->locally_owned_size() + distribution->n_ghost_indices(), Point<dim>());
    face_flags.assign(positions.size(), 0);
    for (const auto &cell : mesh.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const std::size_t first = std::size_t(cell->active_cell_index()) * n_nodes;
          const OpenKnots open    = cell_open_knots[cell->active_cell_index()];
          for (unsigned int i = 0; i < n_nodes; ++i)
            {
              const unsigned int node = distribution->global_to_local(global_nodes[first + i]);
              cell_nodes[first + i]   = node;
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

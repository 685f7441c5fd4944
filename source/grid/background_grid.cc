// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/grid/background_grid.h>
#include <scree/input/input_error.h>

#include <deal.II/fe/fe_bernstein.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_tools.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/lac/la_parallel_vector.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace scree
{
  using namespace dealii;

  namespace
  {
    Basis basis_from_name(const std::string &name)
    {
      static const std::map<std::string, Basis> table{ { "spline", Basis::spline },
                                                       { "quadratic", Basis::quadratic },
                                                       { "linear", Basis::linear } };
      return table.at(name);
    }

    template <int dim>
    Point<dim> point_from_list(const std::vector<double> &list)
    {
      Point<dim> point;
      std::copy_n(list.begin(), dim, point.begin_raw());
      return point;
    }

    template <int dim>
    std::unique_ptr<FiniteElement<dim>> make_element(const Basis basis)
    {
      if (basis == Basis::linear)
        return std::make_unique<FE_Q<dim>>(1);
      return std::make_unique<FE_Bernstein<dim>>(2);
    }
  } // namespace


  void GridParameters::add_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Mesh");
    prm.add_parameter("Lower corner",
                      lower_corner,
                      "Lower corner of the box, m, one number an axis.",
                      Patterns::List(Patterns::Double(), 2, 3));
    prm.add_parameter("Upper corner",
                      upper_corner,
                      "Upper corner of the box, m, one number an axis.",
                      Patterns::List(Patterns::Double(), 2, 3));
    prm.add_parameter(
        "Cell size", cell_size, "Width of the cubic cells, m; must divide the box.", Patterns::Double(1e-12));
    prm.add_parameter("Basis",
                      basis,
                      "Shape functions: spline (C1 quadratic B-splines), quadratic (C0) or linear (hat functions).",
                      Patterns::Selection("spline|quadratic|linear"));
    prm.leave_subsection();
  }


  void GridParameters::check(const unsigned int dim) const
  {
    for (const auto &[name, corner] :
         { std::make_pair("Lower corner", lower_corner), { "Upper corner", upper_corner } })
      require_entry(corner.size() == dim,
                    "Mesh",
                    name,
                    number_text(corner),
                    "entry \"Dimension\" is " + std::to_string(dim) + ". Write " + std::to_string(dim) +
                        " coordinates in m, separated by commas.");
    double n_cells = 1;
    for (unsigned int a = 0; a < dim; ++a)
      {
        const std::string axis = std::string(1, "xyz"[a]);
        const double length    = upper_corner[a] - lower_corner[a];
        require_entry(length > 0,
                      "Mesh",
                      "Upper corner",
                      number_text(upper_corner),
                      "the box has no width along " + axis + ", since \"Lower corner\" = " + number_text(lower_corner) +
                          ". Write a larger coordinate.");
        const double cells = length / cell_size;
        require_entry(std::abs(cells - std::round(cells)) < 1e-6 && std::round(cells) >= 1,
                      "Mesh",
                      "Cell size",
                      cell_size,
                      "it does not divide the box: " + number_text(length) + " m along " + axis + " are " +
                          number_text(cells) + " cells. Try " + number_text(length / std::max(1., std::round(cells))) +
                          ", or move a corner.");
        n_cells *= cells;
      }
    constexpr double most_cells = 1e9; // beyond the memory of any machine this runs on
    require_entry(n_cells <= most_cells,
                  "Mesh",
                  "Cell size",
                  cell_size,
                  "the box would have " + number_text(n_cells) +
                      " cells, and at most 1e9 are allowed. Write a larger size.");
  }


  template <int dim>
  BackgroundGrid<dim>::BackgroundGrid(const GridParameters &parameters, const MPI_Comm communicator)
      : basis(basis_from_name(parameters.basis))
      , width(parameters.cell_size)
      , lower(point_from_list<dim>(parameters.lower_corner))
      , upper(point_from_list<dim>(parameters.upper_corner))
      , mesh(communicator,
             Triangulation<dim>::none,
             parallel::distributed::Triangulation<dim>::no_automatic_repartitioning)
      , dof_handler(mesh)
  {
    mesh.refine_global(make_coarse_mesh());
    distribute_nodes();
  }


  template <int dim>
  void BackgroundGrid<dim>::load(const std::string &file)
  {
    dof_handler.clear();
    mesh.clear();
    make_coarse_mesh();
    mesh.load(file);
    distribute_nodes();
  }


  template <int dim>
  unsigned int BackgroundGrid<dim>::make_coarse_mesh()
  {
    // As many refinements as every axis allows: p4est copies the coarse cells to all ranks.
    std::vector<unsigned int> cells(dim);
    for (unsigned int a = 0; a < dim; ++a)
      cells[a] = static_cast<unsigned int>(std::lround((upper[a] - lower[a]) / width));

    unsigned int n_refinements = 0;
    while (std::all_of(cells.begin(), cells.end(), [](const unsigned int n) { return n % 2 == 0; }))
      {
        for (unsigned int &n : cells)
          n /= 2;
        ++n_refinements;
      }

    const bool number_the_walls = true;
    GridGenerator::subdivided_hyper_rectangle(mesh, cells, lower, upper, number_the_walls);
    return n_refinements;
  }


  template <int dim>
  void BackgroundGrid<dim>::distribute_nodes()
  {
    const auto fe = make_element<dim>(basis);
    dof_handler.reinit(mesh);
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
    partitioner = std::make_shared<Utilities::MPI::Partitioner>(owned, ghosts, mesh.get_communicator());

    // Where the nodes are.
    node_positions.assign(n_owned + ghosts.n_elements(), Point<dim>());
    node_face_flags.assign(node_positions.size(), 0);
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const unsigned int c = cell->active_cell_index();
          const OpenKnots open = cell_open_knots[c];
          for (unsigned int i = 0; i < n_nodes; ++i)
            {
              const unsigned int node = partitioner->global_to_local(
                  static_cast<types::global_dof_index>(number(masters[std::size_t(c) * n_nodes + i])));
              cell_nodes[std::size_t(c) * n_nodes + i] = node;
              for (unsigned int a = 0, rest = i; a < dim; ++a, rest /= n)
                {
                  const unsigned int position = rest % n;
                  const unsigned int face     = 2 * a + (position == n - 1);
                  node_positions[node][a] =
                      cell->vertex(0)[a] + width * (n == 3 ? CellBasis<dim, 3>::node_positions(open, a)[position]
                                                           : CellBasis<dim, 2>::node_positions(open, a)[position]);
                  if ((position == 0 || position == n - 1) && cell->at_boundary(face))
                    node_face_flags[node] |= 1 << face;
                }
            }
        }
  }

  template class BackgroundGrid<2>;
  template class BackgroundGrid<3>;
} // namespace scree

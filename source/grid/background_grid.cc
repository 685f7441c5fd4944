// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/grid/background_grid.h>
#include <scree/input/input_error.h>

#include <deal.II/grid/grid_generator.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace scree
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    Point<dim> point_from_list(const std::vector<double> &list)
    {
      Point<dim> point;
      std::copy_n(list.begin(), dim, point.begin_raw());
      return point;
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
                      "Shape functions: spline (C1 quadratic B-splines), quadratic (C0) or linear.",
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


  Basis GridParameters::basis_kind() const
  {
    static const std::map<std::string, Basis> table{ { "spline", Basis::spline },
                                                     { "quadratic", Basis::quadratic },
                                                     { "linear", Basis::linear } };
    return table.at(basis);
  }


  template <int dim>
  BackgroundGrid<dim>::BackgroundGrid(const GridParameters &parameters, const MPI_Comm communicator)
      : width(parameters.cell_size)
      , lower(point_from_list<dim>(parameters.lower_corner))
      , upper(point_from_list<dim>(parameters.upper_corner))
      , mesh(communicator,
             Triangulation<dim>::none,
             parallel::distributed::Triangulation<dim>::no_automatic_repartitioning)
      , nodes_of_mesh(parameters.basis_kind())
  {
    mesh.refine_global(make_coarse_mesh());
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
    nodes_of_mesh.distribute(mesh, width);
  }

  template class BackgroundGrid<2>;
  template class BackgroundGrid<3>;
} // namespace scree

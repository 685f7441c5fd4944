// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/mesh/background_grid.h>
#include <scree/tensor/vector.h>

#include <deal.II/grid/grid_generator.h>

namespace scree
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    CellsOfBox<dim> cells_of_box(const GridParameters &parameters)
    {
      CellsOfBox<dim> box{ Point<dim>(vector_of<dim>(parameters.lower_corner.data())), parameters.cell_size, {} };
      for (unsigned int a = 0; a < dim; ++a)
        box.n[a] = static_cast<int>(parameters.n_cells_along(a));
      return box;
    }


    /// Coarse cells along each axis of the box, each halved `n_levels` times.
    template <int dim>
    std::vector<unsigned int> coarse_cells(const CellsOfBox<dim> &box, const unsigned int n_levels)
    {
      std::vector<unsigned int> n;
      for (const int along : box.n)
        n.push_back((along + (1 << n_levels) - 1) >> n_levels);
      return n;
    }


    /// As many levels as every axis allows: p4est copies the coarse cells to all ranks.
    template <int dim>
    unsigned int levels_that_divide(const CellsOfBox<dim> &box)
    {
      unsigned int n_levels = 0;
      while (std::all_of(box.n.begin(), box.n.end(), [&](const int n) { return n % (2 << n_levels) == 0; }))
        ++n_levels;
      return n_levels;
    }


    /// So many that the coarse cells are few.
    template <int dim>
    unsigned int levels_of_box(const CellsOfBox<dim> &box)
    {
      constexpr double few  = 100;
      unsigned int n_levels = 0;
      const auto n_coarse   = [&] {
        double product = 1;
        for (const unsigned int n : coarse_cells(box, n_levels))
          product *= n;
        return product;
      };
      while (n_coarse() > few)
        ++n_levels;
      return n_levels;
    }


    template <int dim>
    unsigned int levels(const GridParameters &parameters)
    {
      const CellsOfBox<dim> box = cells_of_box<dim>(parameters);
      return parameters.is_adaptive() ? levels_of_box(box) : levels_that_divide(box);
    }


  } // namespace


  void GridParameters::add_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Mesh");
    prm.add_parameter("Lower corner",
                      lower_corner,
                      "m; lower corner of the box, one coordinate per axis. If neither corner is set and subsection "
                      "Bed has a \"Raster\", the raster gives the box.",
                      Patterns::List(Patterns::Double(), 2, 3));
    prm.add_parameter("Upper corner",
                      upper_corner,
                      "m; upper corner of the box, one coordinate per axis. 3D without both corners, with a bed of a "
                      "raster: in x and y the part of the raster that whole cells cover, in z from two cells below its "
                      "lowest height to above the soil.",
                      Patterns::List(Patterns::Double(), 2, 3));
    prm.add_parameter("Cell size",
                      cell_size,
                      "m; width of the cubic cells. The box lengths must be integer multiples of it.",
                      Patterns::Double(1e-12));
    prm.add_parameter("Basis",
                      basis,
                      "Shape functions: spline (C1 quadratic B-splines) or linear.",
                      Patterns::Selection("spline|linear"));
    prm.leave_subsection();
  }


  void GridParameters::check(const unsigned int dim) const
  {
    for (const auto &[name, corner] :
         { std::make_pair("Lower corner", lower_corner), { "Upper corner", upper_corner } })
      require_entry(corner.size() == dim,
                    { "Mesh", name, number_text(corner) },
                    "entry \"Dimension\" is " + std::to_string(dim) + ". Write " + std::to_string(dim) +
                        " coordinates in m, separated by commas.");
    double n_cells = 1;
    for (unsigned int a = 0; a < dim; ++a)
      {
        const std::string axis = std::string(1, "xyz"[a]);
        const double length    = upper_corner[a] - lower_corner[a];
        require_entry(length > 0,
                      { "Mesh", "Upper corner", number_text(upper_corner) },
                      "the box has no width along " + axis + ", since \"Lower corner\" = " + number_text(lower_corner) +
                          ". Write a larger coordinate.");
        const double cells = length / cell_size;
        require_entry(std::abs(cells - std::round(cells)) < 1e-6 && std::round(cells) >= 1,
                      { "Mesh", "Cell size", cell_size },
                      "it does not divide the box: " + number_text(length) + " m along " + axis + " are " +
                          number_text(cells) + " cells. Try " + number_text(length / std::max(1., std::round(cells))) +
                          ", or move a corner.");
        n_cells *= cells;
      }
    constexpr double most_cells = 1e9; // beyond the memory of any machine this runs on
    require_entry(n_cells <= most_cells,
                  { "Mesh", "Cell size", cell_size },
                  "the box would have " + number_text(n_cells) +
                      " cells, and at most 1e9 are allowed. Write a larger size.");
  }


  template <int dim>
  BackgroundGrid<dim>::BackgroundGrid(const GridParameters &parameters,
                                      const unsigned int n_levels,
                                      const bool follows,
                                      const MPI_Comm communicator)
      : width(parameters.cell_size)
      , lower(vector_of<dim>(parameters.lower_corner.data()))
      , upper(vector_of<dim>(parameters.upper_corner.data()))
      , box(cells_of_box<dim>(parameters))
      , n_levels(n_levels)
      , follows(follows)
      , mesh(communicator,
             Triangulation<dim>::none,
             parallel::distributed::Triangulation<dim>::no_automatic_repartitioning)
      , cells(mesh, box)
      , nodes_of_mesh(parameters.basis_kind())
      , after_repartition(mesh.signals.post_distributed_repartition.connect([this] { cells.reinit(); }))
  {
    const std::vector<unsigned int> n = coarse_cells(box, n_levels);
    Point<dim> end                    = upper;
    for (unsigned int a = 0; a < dim; ++a)
      if (const int along = n[a] << n_levels; along != box.n[a])
        end[a] = lower[a] + along * width;
    GridGenerator::subdivided_hyper_rectangle(mesh, n, lower, end);
  }


  template <int dim>
  BackgroundGrid<dim>::BackgroundGrid(const GridParameters &parameters, const MPI_Comm communicator)
      : BackgroundGrid(parameters, levels_that_divide(cells_of_box<dim>(parameters)), /* follows */ false, communicator)
  {
    mesh.refine_global(n_levels);
    cells.reinit();
    distribute_nodes();
  }


  template <int dim>
  BackgroundGrid<dim>::BackgroundGrid(const GridParameters &parameters,
                                      const PlacesOfPoints<dim> &places,
                                      const MPI_Comm communicator)
      : BackgroundGrid(parameters, levels<dim>(parameters), parameters.is_adaptive(), communicator)
  {
    if (follows)
      refine(with_surroundings(occupied_blocks(box, places, communicator)), Shares::even);
    else
      {
        mesh.refine_global(n_levels);
        cells.reinit();
      }
    distribute_nodes();
  }


  template <int dim>
  void BackgroundGrid<dim>::append_blocks(const Point<dim> &x, const Tensor<1, dim> &path, Blocks &blocks) const
  {
    const auto block_at = [&](const Point<dim> &y) {
      CellPlace<dim> place = box.place_near(y);
      for (int &along : place)
        along /= 2;
      return curve_number<dim>(place);
    };
    const std::uint64_t first = block_at(x);
    if (!blocks.empty() && blocks.back() == first)
      return;
    // A way that is no number, or as long as the box, has no end.
    double length = 0;
    for (unsigned int a = 0; a < dim; ++a)
      length = std::max(length, std::min(std::abs(path[a]), upper[a] - lower[a]));
    const unsigned int n = std::isfinite(path.norm()) ? static_cast<unsigned int>(length / (2. * width)) : 0;
    for (unsigned int i = n; i > 0; --i)
      blocks.push_back(block_at(x + double(i) / n * path));
    blocks.push_back(first);
  }


  template <int dim>
  Blocks BackgroundGrid<dim>::with_surroundings(const Blocks &blocks) const
  {
    const CellPlace<dim> n = box.n_blocks();
    double n_all           = 1;
    for (const int along : n)
      n_all *= along;
    const Blocks around = with_margin<dim>(all_blocks(blocks, communicator_of(mesh)), GridParameters::margin / 2, n);
    if (around.size() <= GridParameters::most_of_box * n_all)
      return around;
    return with_margin<dim>({ 0 }, *std::max_element(n.begin(), n.end()), n);
  }


  template <int dim>
  void BackgroundGrid<dim>::refine(const Blocks &blocks, const Shares shares)
  {
    for (bool is_first = true; set_flags(blocks) || is_first; is_first = false)
      {
        mesh.execute_coarsening_and_refinement();
        if (shares == Shares::even)
          mesh.repartition();
      }
    for (const auto &cell : mesh.active_cell_iterators())
      cell->clear_coarsen_flag();
    cells.reinit();
  }


  template <int dim>
  bool BackgroundGrid<dim>::set_flags(const Blocks &blocks)
  {
    bool refines = false;
    for (const auto &cell : mesh.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          // A cell of this level is 2^s cells wide, hence an aligned cube of 2^(dim (s - 1)) blocks.
          const unsigned int s     = n_levels - cell->level();
          const CellPlace<dim> own = box.place_of_corner(cell->vertex(0));
          const auto is_wanted     = [&](const unsigned int s) {
            const std::uint64_t number = curve_number<dim>(own) >> (dim * s) << (dim * (s - 1));
            return has_any(blocks, number, std::uint64_t(1) << (dim * (s - 1)));
          };
          if (s > 0 && is_wanted(s))
            {
              cell->set_refine_flag();
              refines = true;
            }
          else if (cell->level() > 0 && !is_wanted(s + 1))
            cell->set_coarsen_flag();
        }
    return Utilities::MPI::max(int(refines), communicator_of(mesh)) == 1;
  }

  template class BackgroundGrid<2>;
  template class BackgroundGrid<3>;
} // namespace scree

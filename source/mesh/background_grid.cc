// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/mesh/background_grid.h>
#include <scree/tensor/vector.h>

#include <deal.II/grid/grid_generator.h>

#include <iomanip>
#include <sstream>

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


  std::vector<double> GridParameters::lengths() const
  {
    std::vector<double> lengths;
    for (unsigned int a = 0; a < lower_corner.size(); ++a)
      lengths.push_back(upper_corner[a] - lower_corner[a]);
    return lengths;
  }


  double GridParameters::size_that_divides(const double largest, const double smallest) const
  {
    const std::vector<double> all = lengths();
    const double shortest         = *std::min_element(all.begin(), all.end());
    constexpr double rounding     = 1e-9;
    for (double n = std::max(1., std::ceil(shortest / largest * (1. - rounding)));
         n * smallest <= shortest * (1. + rounding);
         ++n)
      if (std::all_of(all.begin(), all.end(), [&](const double length) {
            return std::abs(length / shortest * n - std::round(length / shortest * n)) < 1e-6;
          }))
        return shortest / n;
    return 0.;
  }


  std::string GridParameters::remedy_for_cells() const
  {
    const auto exact_text = [](const double value) { // With these digits it divides the box, too.
      std::ostringstream text;
      text << std::setprecision(10) << value;
      return text.str();
    };
    const double size = size_that_divides(1.2 * cell_size, 0.5 * cell_size);
    std::vector<std::string> corner;
    for (unsigned int a = 0; a < upper_corner.size(); ++a)
      corner.push_back(exact_text(lower_corner[a] + cell_size * std::max(1., std::round(lengths()[a] / cell_size))));
    return "Write " + (size > 0. ? exact_text(size) + ", which divides all its lengths, or " : "") +
           "\"Upper corner\" = " + boost::algorithm::join(corner, ", ") + '.';
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
                          number_text(cells) + " cells. " + remedy_for_cells());
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
             static_cast<typename Mesh::Settings>(Mesh::no_automatic_repartitioning |
                                                  Mesh::communicate_vertices_to_p4est)) // for ranks_at()
      , cells(mesh, box)
      , nodes_of_mesh(parameters.basis_kind())
      , vertices_of_mesh(Basis::linear)
  {
    make_coarse_cells();
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
      {
        const Blocks blocks = with_surroundings(occupied_blocks(box, places, communicator));
        change_cells(&blocks);
      }
    else
      {
        mesh.refine_global(n_levels);
        cells.reinit();
      }
    distribute_nodes();
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


  namespace
  {
    /// p4est's copy of a mesh, on its way to the next one at once: deal.II refines and coarsens by one level at a time,
    /// and makes all cells anew each time.
    template <int dim>
    class Forest
    {
    public:
      Forest(const parallel::distributed::Triangulation<dim> &mesh,
             const CellsOfBox<dim> &box,
             const unsigned int n_levels)
          : n_levels(n_levels)
          , forest(Functions::copy_forest(const_cast<typename Types::forest *>(mesh.get_p4est()), /* data */ false))
      {
        forest->user_pointer = this;
        for (const auto coarse_cell : mesh.get_p4est_tree_to_coarse_cell_permutation())
          corners.push_back(box.place_of_corner(
              typename Triangulation<dim>::cell_iterator(&mesh, 0, static_cast<int>(coarse_cell))->vertex(0)));
      }

      Forest(const Forest &) = delete;

      ~Forest()
      {
        Functions::destroy(forest);
      }

      /// Refines what holds a block, and coarsens all else as far as neighbours differ by one level only. Collective.
      void refine(const Blocks &blocks)
      {
        wanted = &blocks;
        Functions::coarsen(forest, /* recursive */ 1, is_coarsened, nullptr);
        Functions::refine(forest, /* recursive */ 1, is_refined, nullptr);
        Functions::balance(forest, all_neighbours(), nullptr);
      }

      /// Gives all ranks about as many points. Collective.
      void share_out(PointsOfCells &&points)
      {
        std::sort(points.begin(), points.end());
        n_points = std::move(points);
        Functions::partition(forest, /* families stay whole */ 1, weight);
      }

      /// Makes these the cells of a mesh, which has the coarse cells only. Collective.
      void load_into(parallel::distributed::Triangulation<dim> &mesh)
      {
        forest->connectivity = mesh.get_p4est()->connectivity;
        mesh.load(forest);
        mesh.signals.post_distributed_refinement(); // which load() leaves out
      }

    private:
      using Types     = dealii::internal::p4est::types<dim>;
      using Functions = dealii::internal::p4est::functions<dim>;

      static typename Types::balance_type all_neighbours()
      {
        if constexpr (dim == 2)
          return P4EST_CONNECT_FULL;
        else
          return P8EST_CONNECT_FULL;
      }

      static int
      is_refined(typename Types::forest *of, const typename Types::topidx tree, typename Types::quadrant *cell)
      {
        return static_cast<const Forest *>(of->user_pointer)->holds_blocks(tree, *cell, cell->level);
      }

      static int
      is_coarsened(typename Types::forest *of, const typename Types::topidx tree, typename Types::quadrant *family[])
      {
        return !static_cast<const Forest *>(of->user_pointer)->holds_blocks(tree, *family[0], family[0]->level - 1);
      }

      static int weight(typename Types::forest *of, const typename Types::topidx tree, typename Types::quadrant *cell)
      {
        constexpr int of_cell = 1, of_point = 100; // an empty cell takes memory, and time when the mesh changes
        const auto &self = *static_cast<const Forest *>(of->user_pointer);
        int weight       = of_cell;
        if (static_cast<unsigned int>(cell->level) == self.n_levels && !self.n_points.empty())
          {
            const std::uint64_t number = curve_number<dim>(self.place_of(tree, *cell));
            for (auto at = std::lower_bound(self.n_points.begin(), self.n_points.end(), std::make_pair(number, 0u));
                 at != self.n_points.end() && at->first == number;
                 ++at)
              weight += of_point * static_cast<int>(at->second);
          }
        return weight;
      }

      /// Place of the lower corner of a cell, in fine cells.
      CellPlace<dim> place_of(const typename Types::topidx tree, const typename Types::quadrant &cell) const
      {
        constexpr unsigned int most_levels = dim == 2 ? P4EST_MAXLEVEL : P8EST_MAXLEVEL;
        CellPlace<dim> place               = corners[tree];
        place[0] += cell.x >> (most_levels - n_levels);
        place[1] += cell.y >> (most_levels - n_levels);
        if constexpr (dim == 3)
          place[2] += cell.z >> (most_levels - n_levels);
        return place;
      }

      /// Whether the cell of this level with the corner of `cell` holds one of the blocks and is larger than a fine
      /// cell.
      bool holds_blocks(const typename Types::topidx tree,
                        const typename Types::quadrant &cell,
                        const unsigned int level) const
      {
        if (level >= n_levels)
          return false;
        // It is 2^s fine cells wide, hence an aligned cube of 2^(dim (s - 1)) blocks.
        const unsigned int s       = n_levels - level;
        const std::uint64_t number = curve_number<dim>(place_of(tree, cell)) >> (dim * s) << (dim * (s - 1));
        return has_any(*wanted, number, std::uint64_t(1) << (dim * (s - 1)));
      }

      const unsigned int n_levels;
      typename Types::forest *const forest;
      std::vector<CellPlace<dim>> corners; // of the coarse cells, in the order of p4est
      const Blocks *wanted = nullptr;
      PointsOfCells n_points; // ascending; a cell may stand there for each set of points
    };
  } // namespace


  template <int dim>
  void BackgroundGrid<dim>::make_coarse_cells()
  {
    const std::vector<unsigned int> n = coarse_cells(box, n_levels);
    Point<dim> end                    = upper;
    for (unsigned int a = 0; a < dim; ++a)
      if (const int along = n[a] << n_levels; along != box.n[a])
        end[a] = lower[a] + along * width;
    GridGenerator::subdivided_hyper_rectangle(mesh, n, lower, end);
  }


  template <int dim>
  void BackgroundGrid<dim>::change_cells(const Blocks *fine, PointsOfCells points)
  {
    Forest<dim> forest(mesh, box, n_levels);
    if (fine != nullptr)
      forest.refine(*fine);
    forest.share_out(std::move(points));
    mesh.clear();
    make_coarse_cells();
    forest.load_into(mesh);
    cells.reinit();
  }


  template class BackgroundGrid<2>;
  template class BackgroundGrid<3>;
} // namespace scree

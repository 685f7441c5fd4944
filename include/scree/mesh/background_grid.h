// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_mesh_background_grid_h
#define scree_mesh_background_grid_h

#include <scree/deal_ii_versions.h>
#include <scree/input/input_error.h>
#include <scree/mesh/node_numbering.h>

#include <deal.II/base/parameter_handler.h>
#include <deal.II/fe/mapping_cartesian.h>

#include <map>

namespace scree
{
  /// Subsection Mesh: a box of equal cubes.
  struct GridParameters
  {
    std::vector<double> lower_corner{ 0., 0. }, ///< of the box, m
        upper_corner{ 1., 1. };                 ///< of the box, m
    double cell_size  = 0.1;                    ///< m
    std::string basis = "spline";               ///< spline | linear

    /// Declares the subsection and its entries.
    void add_parameters(dealii::ParameterHandler &prm);

    /// Throws EntryError unless the corners have `dim` coordinates and the cell size divides the box.
    void check(const unsigned int dim) const;

    /// Entry `Basis` as an enum.
    Basis basis_kind() const
    {
      static const std::map<std::string, Basis> table{ { "spline", Basis::spline }, { "linear", Basis::linear } };
      return table.at(basis);
    }

    /// Of the box along the axes, m.
    std::vector<double> lengths() const;

    /// The largest size of cells from `smallest` to `largest`, m, that divides the box along all axes; 0: there is
    /// none.
    double size_that_divides(const double largest, const double smallest) const;

    /// Cells of this size along an axis of the box.
    long n_cells_along(const unsigned int axis) const
    {
      return std::lround((upper_corner[axis] - lower_corner[axis]) / cell_size);
    }

    /// Cells of this size that fill the box.
    double n_cells() const
    {
      double n = 1;
      for (unsigned int a = 0; a < upper_corner.size(); ++a)
        n *= n_cells_along(a);
      return n;
    }

    /// Whether cells are larger where no points are: in boxes of many cells. Few take less memory than the program, and
    /// so little time that to follow the points would cost more.
    bool is_adaptive() const
    {
      constexpr double few = 2e4;
      return n_cells() > few;
    }

    /// Cells beside points and their ways that are fine, too, at least.
    static constexpr unsigned int margin = 2;

    /// With more than this part of the box, all of it is made fine: that costs less than to follow the points.
    static constexpr double most_of_box = 0.5;

    /// Cells ahead of points that move are fine, too: so many times those around the points...
    static constexpr double most_ahead = 3.;

    /// ...or so many, which take less memory than the program.
    static constexpr double least_ahead = 5e4;

  private:
    /// Cell sizes and a corner with which the cells fit the box, for the message that they do not.
    std::string remedy_for_cells() const;
  };

  /// Numbers of points in fine cells of this rank, each with the number of the cell's place on the curve.
  using PointsOfCells = std::vector<std::pair<std::uint64_t, unsigned int>>;

  /// The background mesh and the nodes of the velocity.
  ///
  /// Cells are fine, of the size that the user asks for, where points are and some way around; the others are larger,
  /// the more so the further away, and hold no nodes. The mesh consists of coarse cells that p4est halves; it may reach
  /// beyond the upper walls of the box, since a box need not be a multiple of coarse cells.
  template <int dim>
  class BackgroundGrid
  {
  public:
    /// Fine cells everywhere. Collective.
    BackgroundGrid(const GridParameters &parameters, const MPI_Comm communicator);

    /// Fine cells where points are; everywhere if the box has few cells. Collective.
    BackgroundGrid(const GridParameters &parameters, const PlacesOfPoints<dim> &places, const MPI_Comm communicator);

    /// Builds the nodes for the current mesh and partition. Collective; called again after change_cells().
    void distribute_nodes()
    {
      nodes_of_mesh.distribute(cells);
      vertices_of_mesh.distribute(cells);
    }

    /// The blocks of all ranks with a margin around them, or all of the box if that makes little difference.
    /// Collective.
    /// @param blocks of this rank, in which points are
    Blocks with_surroundings(const Blocks &blocks) const;

    /// Makes the cells of some blocks fine, and others larger, and shares all cells out to the ranks. Collective; no
    /// points may be on the mesh.
    /// @param fine blocks of all ranks; null keeps the cells
    /// @param points of which all ranks are to get about as many; of none at all, as many cells
    void change_cells(const Blocks *fine, PointsOfCells points = {});

    /// Ranks of the cells around places in the mesh, of this rank or not.
    std::vector<dealii::types::subdomain_id> ranks_at(const std::vector<dealii::Point<dim>> &places)
    {
      return mesh.find_point_owner_rank(places);
    }

    /// This rank's blocks of fine cells.
    Blocks fine_blocks() const
    {
      Blocks blocks;
      for (const auto &cell : cells.cells())
        if (cells.is_owned(cell))
          blocks.push_back(cell.number >> dim);
      make_unique(blocks);
      return blocks;
    }

    /// Whether cells may be larger than the fine ones where no points are.
    bool follows_points() const
    {
      return follows;
    }

    /// The block of the cell of the box that is nearest to a place `x`, m.
    std::uint64_t block_at(const dealii::Point<dim> &x) const
    {
      return curve_number<dim>(box.place_near(x)) >> dim;
    }

    /// The cells that hold nodes.
    const FineCells<dim> &fine_cells() const
    {
      return cells;
    }

    /// Cells of the finest size that fill the box.
    double n_cells_of_box() const
    {
      return box.n_cells();
    }

    /// The nodes, see NodeNumbering.
    const NodeNumbering<dim> &numbering() const
    {
      return nodes_of_mesh;
    }

    /// The vertices of the fine cells: nodes of linear functions.
    const NodeNumbering<dim> &vertices() const
    {
      return vertices_of_mesh;
    }

    /// @{
    /// See NodeNumbering.
    unsigned int n_nodes_1d() const
    {
      return nodes_of_mesh.n_nodes_1d();
    }
    unsigned int n_nodes_per_cell() const
    {
      return nodes_of_mesh.n_nodes_per_cell();
    }
    const unsigned int *nodes(const unsigned int cell) const
    {
      return nodes_of_mesh.nodes(cell);
    }
    OpenKnots open_knots(const unsigned int cell) const
    {
      return nodes_of_mesh.open_knots(cell);
    }
    unsigned int n_owned_nodes() const
    {
      return nodes_of_mesh.n_owned();
    }
    const dealii::Point<dim> &node_position(const unsigned int node) const
    {
      return nodes_of_mesh.position(node);
    }
    std::uint8_t node_faces(const unsigned int node) const
    {
      return nodes_of_mesh.faces(node);
    }
    /// @}

    /// The distributed mesh; cells may lie beyond the upper walls of the box.
    const dealii::parallel::distributed::Triangulation<dim> &triangulation() const
    {
      return mesh;
    }

    /// Communicator of the mesh.
    MPI_Comm communicator() const
    {
      return communicator_of(mesh);
    }

    /// Mapping of the cells, cubes along the axes.
    const dealii::Mapping<dim> &mapping() const
    {
      return cartesian;
    }

    /// Width h of a fine cell, m.
    double cell_size() const
    {
      return width;
    }

    /// Corner of the box, m.
    const dealii::Point<dim> &lower_corner() const
    {
      return lower;
    }

    /// Corner of the box, m.
    const dealii::Point<dim> &upper_corner() const
    {
      return upper;
    }

  private:
    using Mesh = dealii::parallel::distributed::Triangulation<dim>;

    /// Without fine cells.
    BackgroundGrid(const GridParameters &parameters,
                   const unsigned int n_levels,
                   const bool follows,
                   const MPI_Comm communicator);

    /// Fills the empty mesh with the coarse cells.
    void make_coarse_cells();

    const double width;
    dealii::Point<dim> lower, upper;
    const CellsOfBox<dim> box;
    const unsigned int n_levels; // from the coarse cells to the fine ones
    const bool follows;

    Mesh mesh;
    dealii::MappingCartesian<dim> cartesian;
    FineCells<dim> cells;
    NodeNumbering<dim> nodes_of_mesh, vertices_of_mesh;
  };

  /// Calls `act` with the number of a cell's nodes along an axis, 2 or 3, as a constant.
  template <int dim, typename Act>
  auto with_nodes_1d(const BackgroundGrid<dim> &grid, const Act &act)
  {
    if (grid.n_nodes_1d() == 2)
      return act(std::integral_constant<int, 2>());
    return act(std::integral_constant<int, 3>());
  }

  /// Calls `visit(node, shape value)` for the nodes that act at the place `x` (in cell widths from the lower corner) of
  /// a cell of this rank. For output and the like: the kernels of the transfer work on rows of nodes.
  template <int dim, typename Visit>
  void
  visit_nodes(const BackgroundGrid<dim> &grid, const unsigned int cell, const dealii::Point<dim> &x, const Visit &visit)
  {
    with_nodes_1d(grid, [&](auto n) {
      const CellBasis<dim, n> basis(x, grid.open_knots(cell));
      for (unsigned int i = 0; i < grid.n_nodes_per_cell(); ++i)
        {
          double value = 1.;
          for (unsigned int a = 0, rest = i; a < dim; ++a, rest /= n)
            value *= basis.value[a][rest % n];
          visit(grid.nodes(cell)[i], value);
        }
    });
  }
} // namespace scree

#endif

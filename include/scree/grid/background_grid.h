// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_grid_background_grid_h
#define scree_grid_background_grid_h

#include <scree/grid/cell_basis.h>

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/partitioner.h>
#include <deal.II/distributed/tria.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/mapping_cartesian.h>

#include <memory>
#include <string>
#include <vector>

namespace scree
{
  /// Shape functions of the background grid.
  enum class Basis
  {
    spline,    ///< C1 quadratic B-splines with open knots at the walls
    quadratic, ///< C0 quadratic Bernstein polynomials
    linear     ///< hat functions
  };

  /// Subsection Mesh: a box of equal cubes.
  struct GridParameters
  {
    std::vector<double> lower_corner{ 0., 0. }, upper_corner{ 1., 1. }; ///< m
    double cell_size  = 0.1;                                            ///< m
    std::string basis = "spline";

    void add_parameters(dealii::ParameterHandler &prm);

    /// Throws EntryError unless the corners have `dim` coordinates and the cell size divides the box.
    void check(const unsigned int dim) const;
  };

  /// The background mesh and its nodes.
  ///
  /// deal.II has no B-splines, but the free coefficients of the C1 quadratic splines are those Bernstein coefficients
  /// that sit inside a cell or on the boundary of the box: a coefficient on an interior face is the mean of its two
  /// neighbours. A *node* is such a free coefficient; each cell stores the 3^dim nodes (2^dim with hats) that act on
  /// it. Nodes are numbered compactly: [0, n_owned_nodes()) are this rank's, then come the ghosts.
  template <int dim>
  class BackgroundGrid
  {
  public:
    BackgroundGrid(const GridParameters &parameters, const MPI_Comm communicator);

    /// Replaces the mesh by a saved one of the same box. Collective.
    void load(const std::string &file);

    /// Builds the nodes for the current partition of the mesh. Collective; called again after a repartition.
    void distribute_nodes();

    /// Nodes along one axis of a cell: 3 (quadratic) or 2 (linear).
    unsigned int n_nodes_1d() const
    {
      return basis == Basis::linear ? 2 : 3;
    }

    unsigned int n_nodes_per_cell() const
    {
      return dealii::Utilities::pow(n_nodes_1d(), dim);
    }

    /// This rank's node indices on a locally owned cell, lexicographic, n_nodes_per_cell() of them.
    const unsigned int *nodes(const unsigned int cell) const
    {
      return &cell_nodes[std::size_t(cell) * n_nodes_per_cell()];
    }

    OpenKnots open_knots(const unsigned int cell) const
    {
      return cell_open_knots[cell];
    }

    unsigned int n_owned_nodes() const
    {
      return partitioner->locally_owned_size();
    }

    /// The distribution of nodes over ranks.
    const std::shared_ptr<const dealii::Utilities::MPI::Partitioner> &node_partitioner() const
    {
      return partitioner;
    }

    /// Where a node sits (Greville abscissa), m.
    const dealii::Point<dim> &node_position(const unsigned int node) const
    {
      return node_positions[node];
    }

    /// The faces of the box a node lies on: bit f for face f (deal.II's numbering).
    std::uint8_t node_faces(const unsigned int node) const
    {
      return node_face_flags[node];
    }

    const dealii::parallel::distributed::Triangulation<dim> &triangulation() const
    {
      return mesh;
    }
    dealii::parallel::distributed::Triangulation<dim> &triangulation()
    {
      return mesh;
    }
    const dealii::Mapping<dim> &mapping() const
    {
      return cartesian;
    }
    double cell_size() const
    {
      return width;
    }
    const dealii::Point<dim> &lower_corner() const
    {
      return lower;
    }
    const dealii::Point<dim> &upper_corner() const
    {
      return upper;
    }

  private:
    /// Makes the coarse mesh; returns how often it is to be refined.
    unsigned int make_coarse_mesh();

    const Basis basis;
    const double width;
    dealii::Point<dim> lower, upper;

    dealii::parallel::distributed::Triangulation<dim> mesh;
    dealii::MappingCartesian<dim> cartesian;
    dealii::DoFHandler<dim> dof_handler;

    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> partitioner;
    std::vector<unsigned int> cell_nodes;   // of owned cells, by active cell index
    std::vector<OpenKnots> cell_open_knots; // by active cell index
    std::vector<dealii::Point<dim>> node_positions;
    std::vector<std::uint8_t> node_face_flags;
  };
} // namespace scree

#endif

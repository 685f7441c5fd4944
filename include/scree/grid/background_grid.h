// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_grid_background_grid_h
#define scree_grid_background_grid_h

#include <scree/grid/node_numbering.h>

#include <deal.II/base/parameter_handler.h>
#include <deal.II/fe/mapping_cartesian.h>

#include <string>
#include <vector>

namespace scree
{
  /// Subsection Mesh: a box of equal cubes.
  struct GridParameters
  {
    std::vector<double> lower_corner{ 0., 0. }, upper_corner{ 1., 1. }; ///< m
    double cell_size  = 0.1;                                            ///< m
    std::string basis = "spline";

    void add_parameters(dealii::ParameterHandler &prm);

    /// Throws EntryError unless the corners have `dim` coordinates and the cell size divides the box.
    void check(const unsigned int dim) const;

    Basis basis_kind() const;
  };

  /// The background mesh and the nodes of the velocity.
  template <int dim>
  class BackgroundGrid
  {
  public:
    BackgroundGrid(const GridParameters &parameters, const MPI_Comm communicator);

    /// Builds the nodes for the current partition of the mesh. Collective; called again after a repartition.
    void distribute_nodes();

    /// The nodes, see NodeNumbering.
    const NodeNumbering<dim> &numbering() const
    {
      return nodes_of_mesh;
    }

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

    const double width;
    dealii::Point<dim> lower, upper;

    dealii::parallel::distributed::Triangulation<dim> mesh;
    dealii::MappingCartesian<dim> cartesian;
    NodeNumbering<dim> nodes_of_mesh;
  };
} // namespace scree

#endif

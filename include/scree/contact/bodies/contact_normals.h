// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_contact_bodies_contact_normals_h
#define scree_contact_bodies_contact_normals_h

#include <scree/bodies/phases.h>
#include <scree/boundary/constraints.h>
#include <scree/contact/contact_parameters.h>
#include <scree/contact/node_shapes.h>
#include <scree/mesh/node_values.h>
#include <scree/tensor/vector.h>

#include <array>
#include <list>
#include <vector>

namespace scree
{
  /// A group of bodies that stick to each other, at the nodes. What it refers to must live on.
  template <int dim>
  struct BodyGroup
  {
    unsigned int number;                 ///< SoilBody::group of its bodies
    NodalField<dim> *field;              ///< nodal field of the group
    const Constraints<dim> *constraints; ///< constraints of its nodes

    /// Whether the group has mass at a node, or is rigid there.
    bool acts_on(const unsigned int node) const
    {
      if ((*field)[node][NodalField<dim>::mass] > 0.)
        return true;
      const NodeConstraints<dim> *walls = constraints->at(node);
      return walls != nullptr && walls->is_rigid;
    }

    /// 1/kg, of a node that it acts on.
    double inverse_mass(const unsigned int node) const
    {
      const NodeConstraints<dim> *walls = constraints->at(node);
      return walls != nullptr && walls->is_rigid ? 0. : 1. / (*field)[node][NodalField<dim>::mass];
    }
  };

  /// Normals and gaps at the nodes that two groups of bodies act on.
  ///
  /// The normal at a node, one for both groups, is the best of three: along the gradient of the first group's volume,
  /// along that of the second's, and across the plane that parts the points around the node by linear regression
  /// (Fisher's discriminant; @source{nairn2020} part them by regression, too). The best is the one along
  /// which the points, as balls of their size, are the furthest apart, or overlap the least: as bodies that do not
  /// overlap are parted by some plane, this tells the face of one body from the edge of the other. Then normals of
  /// nodes with a cell in common are averaged, as each is rough by the places of points, unless there is a corner
  /// between them.
  template <int dim>
  class ContactNormals
  {
  public:
    /// Keeps references to grid and bodies.
    /// @param pair the two groups and their friction
    ContactNormals(const BackgroundGrid<dim> &grid,
                   const BodyGroup<dim> &first,
                   const BodyGroup<dim> &second,
                   const ContactPair &pair,
                   const std::list<SoilBody<dim>> &bodies);

    /// Fits the nodes to the grid's current partition. Collective.
    void reinit();

    /// Finds them; the ghosts of the groups' fields hold values. Collective.
    void find();

    /// The owned nodes of cells with points that may be near both groups.
    const std::vector<unsigned int> &nodes() const
    {
      return normals.active_nodes();
    }

    /// Whether points of both groups are around a node of nodes().
    bool is_between(const unsigned int node) const
    {
      return normals[node][weight] != 0.;
    }

    /// From the first group to the second; 0 where there is none.
    dealii::Tensor<1, dim> normal(const unsigned int node) const
    {
      return vector_of<dim>(normals[node]);
    }

    /// Along the normal, m.
    double gap(const unsigned int node) const
    {
      return gap_along(node, 0);
    }

    /// Coefficient.
    double friction(const unsigned int node) const
    {
      return normals[node][weight + 1];
    }

  private:
    using Moments = MomentLayout<dim>;

    static constexpr unsigned int n_normals = 3;               ///< to choose from
    static constexpr unsigned int weight    = n_normals * dim; ///< in averages of normals: its place behind them

    /// Added to how far points reach from a node, cell widths, so that 0 stands for no points.
    static constexpr double reach_of_none = 16.;

    /// The cells of a group's points with nodes that both act on.
    struct Cell
    {
      unsigned int side; ///< 0: of the first group, 1: of the second
      const ConstCellPoints<dim> *points;
      double friction; ///< coefficient that their body tells
    };

    /// Lists these cells.
    void find_cells();

    /// Finds the normals to choose from.
    template <int n>
    void find_normals();

    /// The same of a node from its moments: unit vectors from the first to the second group, and what lies behind them;
    /// zero where a group is not there.
    void find_normals_of(const unsigned int node);

    /// Finds how far the points of either group reach along the first `n_of` of them.
    template <int n>
    void find_reach(const unsigned int n_of);

    /// The gap, m, along a normal of a node.
    double gap_along(const unsigned int node, const unsigned int normal) const
    {
      const double *reach = sums[node];
      return grid.cell_size() * (2. * reach_of_none - reach[normal] - reach[n_normals + normal]);
    }

    /// Chooses.
    void choose_normals();

    /// Puts averages of the chosen ones in the place of the first ones.
    void smooth_normals();

    template <int n>
    void find();

    const BackgroundGrid<dim> &grid;
    const std::array<BodyGroup<dim>, 2> groups;
    const std::vector<double> friction_coefficients; // by number of body
    const unsigned int rough_side;                   // whose bodies they are of
    const std::list<SoilBody<dim>> &bodies;
    NodeValues<dim, 2 * Moments::n_moments> sums; // moments; then how far points reach along the normals
    NodeValues<dim, n_normals * dim + 2> normals; // behind them the weight in averages and the friction coefficient
    NodeValues<dim, dim> averages;                // times weights
    std::vector<char> is_shared;                  // by node of cells with points
    std::vector<Cell> cells;
    std::vector<Ball<dim>> balls; // of the points of these cells
  };
} // namespace scree

#endif

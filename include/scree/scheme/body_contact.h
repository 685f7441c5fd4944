// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_scheme_body_contact_h
#define scree_scheme_body_contact_h

#include <scree/grid/cell_basis.h>
#include <scree/grid/constraints.h>
#include <scree/grid/nodal_field.h>
#include <scree/points/soil_body.h>
#include <scree/scheme/contact_parameters.h>
#include <scree/scheme/step_balance.h>

#include <array>
#include <list>
#include <vector>

namespace scree
{
  /// A group of bodies that stick to each other, at the nodes. What it refers to must live on.
  template <int dim>
  struct BodyGroup
  {
    unsigned int number; ///< SoilBody::group of its bodies
    NodalField<dim> *field;
    const Constraints<dim> *constraints;
  };

  /// Contact of two groups of dry bodies, each with a velocity field of its own, by impulses at the nodes that both act
  /// on (Bardenhagen, Brackbill & Sulsky 2000; Bardenhagen et al. 2001): opposite, against approach only, and along the
  /// surface by Coulomb's law.
  ///
  /// The normal at a node, one for both groups, is the best of three: along the gradient of the first group's volume,
  /// along that of the second's, and across the plane that parts the points around the node by linear regression
  /// (Fisher's discriminant; Nairn, Hammerquist & Smith 2020 part them by regression, too). The best is the one along
  /// which the points, as balls of their size, are the furthest apart, or overlap the least: as bodies that do not
  /// overlap are parted by some plane, this tells the face of one body from the edge of the other. Then normals of
  /// nodes with a cell in common are averaged, as each is rough by the places of points, unless there is a corner
  /// between them. Balls that do not reach each other along the normal are no contact yet: they may close the gap.
  template <int dim>
  class BodyContact
  {
  public:
    BodyContact(const BackgroundGrid<dim> &grid,
                const BodyGroup<dim> &first,
                const BodyGroup<dim> &second,
                const ContactPair &pair,
                const std::list<SoilBody<dim>> &bodies);

    /// Fits the nodes to the grid's current partition. Collective.
    void reinit();

    /// Finds normals and gaps at the nodes that both groups act on; the ghosts of the fields hold values. Collective.
    void find();

    /// Corrects the velocities of owned nodes at the end of a step, s.
    void solve(const double time_step, StepBalance<dim> &balance);

    /// Adds the energy that the impulses of all calls of solve() since find() have taken to the balance, when the
    /// velocities of the step are known.
    void count_dissipation(StepBalance<dim> &balance) const;

  private:
    /// Of a group's points around a node, weighted by volume and shape function: volume, m^3, first and second moments
    /// of the place from the node in cell widths, the gradient of the volume with the place, and the volume times the
    /// friction coefficient.
    static constexpr unsigned int first_moments = 1, second_moments = first_moments + dim,
                                  gradient = second_moments + dim * (dim + 1) / 2, friction = gradient + dim,
                                  n_moments = friction + 1;

    static constexpr unsigned int n_normals = 3;               ///< to choose from
    static constexpr unsigned int weight    = n_normals * dim; ///< in averages of normals: its place behind them

    /// The cells of a group's points with nodes that both act on.
    struct Cell
    {
      unsigned int side; ///< 0: of the first group, 1: of the second
      const ConstCellPoints<dim> *points;
      double friction; ///< coefficient that their body tells
    };

    /// A node that both act on.
    struct Meeting
    {
      unsigned int node;
      dealii::Tensor<1, dim> normal;      ///< from the first group to the second, as far as walls leave it
      double gap;                         ///< m; touching below the slack
      double friction;                    ///< coefficient
      dealii::Tensor<1, dim> impulse;     ///< on the second group, N s
      std::array<double, 2> inverse_mass; ///< 1/kg
    };

    /// A point, as a ball of its size.
    struct Ball
    {
      dealii::Point<dim> place; ///< in its cell
      double volume;            ///< m^3
      double radius;            ///< cell widths
    };

    template <int n>
    struct NodeShapes;

    /// Of a cell's nodes, cell widths from its lower corner.
    template <int n>
    static std::array<dealii::Point<dim>, CellBasis<dim, n>::n_nodes> node_positions(const OpenKnots open);

    bool acts_on(const unsigned int side, const unsigned int node) const;
    double inverse_mass(const unsigned int side, const unsigned int node) const;

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
    double gap_along(const unsigned int node, const unsigned int normal) const;

    /// Chooses.
    void choose_normals();

    /// Puts averages of the chosen ones in the place of the first ones.
    void smooth_normals();

    template <int n>
    void find();

    void list_meetings();

    const BackgroundGrid<dim> &grid;
    const std::array<BodyGroup<dim>, 2> groups;
    const std::vector<double> friction_coefficients; // by number of body
    const unsigned int rough_side;                   // whose bodies they are of
    const std::list<SoilBody<dim>> &bodies;
    NodeValues<dim, 2 * n_moments> sums;          // moments; then how far points reach along the normals
    NodeValues<dim, n_normals * dim + 2> normals; // behind them the weight in averages and the friction coefficient
    NodeValues<dim, dim> averages;                // times weights
    std::vector<char> is_shared;                  // by node of cells with points
    std::vector<Cell> cells;
    std::vector<Ball> balls; // of the points of these cells
    std::vector<Meeting> meetings;
  };
} // namespace scree

#endif

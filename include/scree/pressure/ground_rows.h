// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_pressure_ground_rows_h
#define scree_pressure_ground_rows_h

#include <scree/mesh/cut_cells.h>
#include <scree/mesh/node_rows.h>
#include <scree/mixture/wet_nodes.h>

#include <vector>

namespace scree
{
  /// Soil or water, of which a node has both.
  enum class Phase : unsigned int
  {
    soil,
    water
  };

  /// What soil and water give to the ground in a cell.
  template <int dim>
  struct FacetTractions
  {
    std::uint64_t cell = 0;       ///< FineCells::Cell::number
    unsigned int part  = 0;       ///< of RigidBoundary
    unsigned int group = 0;       ///< of the bodies
    dealii::Tensor<1, dim> soil;  ///< of the soil, Pa, out of the open
    dealii::Tensor<1, dim> water; ///< of the water, Pa

    /// For the state of a run.
    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &cell &part &group &soil &water;
    }
  };

  /// Soil or water at a facet of rigid ground: its mean velocity there must not go into the ground, and by Coulomb's
  /// law the ground resists its sliding.
  template <int dim>
  struct GroundRow
  {
    unsigned int segment;            ///< number of the facet
    Phase phase;                     ///< soil or water
    bool is_unilateral;              ///< the ground presses only
    double friction;                 ///< coefficient; 0: slips, infinite: sticks. Of a bilateral row one of these
    double area;                     ///< m^(dim-1)
    dealii::Tensor<1, dim> normal;   ///< unit, out of the open
    dealii::Tensor<1, dim> flow;     ///< m^dim/s: area times the velocity beside what is admissible, without tractions
    dealii::Tensor<1, dim> traction; ///< on the ground, Pa; holds the initial guess before the solve
    bool holds_across = false;       ///< in the current solve: the motion into the ground
    bool holds_along  = false;       ///< that along it, as far as the compliance of its friction lets it
    double compliance = 0.;          ///< flow along the ground over the traction along it, m^dim/(Pa s); 0: sticks
    double diagonal   = 0.; ///< of dt N A^-1 N^T, as if no walls held the nodes, m^dim/(Pa s); see set_responses()

    /// The part of a vector that the ground holds.
    dealii::Tensor<1, dim> held_part(const dealii::Tensor<1, dim> &vector) const
    {
      if (holds_across)
        return holds_along ? vector : (vector * normal) * normal;
      return holds_along ? along(vector) : dealii::Tensor<1, dim>();
    }

    /// The traction, Pa, that alone would take a flow from what is held, m^dim/s.
    dealii::Tensor<1, dim> traction_of(const dealii::Tensor<1, dim> &flow) const
    {
      const dealii::Tensor<1, dim> taken = held_part(flow), tangential = along(taken);
      return (taken - tangential) / diagonal + tangential / (diagonal + compliance);
    }

    /// The part of a vector along the ground.
    dealii::Tensor<1, dim> along(const dealii::Tensor<1, dim> &vector) const
    {
      return vector - (vector * normal) * normal;
    }
  };

  /// The rows of a step, and their matrix N: means of the shape functions over the facets, times their areas. A row
  /// acts on soil or water, in the variables of the pressure: a force f on soil is (f, -f) on u and q, one on water (f,
  /// (1/n - 1) f).
  template <int dim>
  class GroundRows
  {
  public:
    using Vectors = std::vector<dealii::Tensor<1, dim>>; ///< a vector a row

    /// No rows; keeps a reference to the grid.
    explicit GroundRows(const BackgroundGrid<dim> &grid)
        : grid(grid)
    {
    }

    /// Drops all rows.
    void clear();

    /// Adds a row at a facet, whose shape functions are limited by the mass of the phase at a node: where that is
    /// light, it hardly counts. Finds the flow of the velocity alone.
    /// @param least_mass at which a node counts wholly, kg
    /// @param phase of the row; ghosts hold values
    /// @param nodes of a mixture; null: soil without water
    void add(const GroundRow<dim> &row,
             const CutFacet<dim> &facet,
             const double least_mass,
             const NodalField<dim> &phase,
             const WetNodes<dim> *nodes = nullptr);

    /// Adds the forces of the ground under tractions, Pa, to those on u and q, N: this rank's part of -N^T t.
    void add_forces(const Vectors &tractions, FlowField<dim> &forces) const;

    /// Flow into the ground at the rows, m^dim/s: N times a flow whose ghosts hold values.
    void find_flows(const FlowField<dim> &flow, Vectors &result) const;

    /// Finds the diagonal of the rows, and what precondition() needs.
    /// @param inverse_masses of a node's soil (first number) and water (second), with drag, 1/kg
    void set_responses(const FlowField<dim> &inverse_masses, const double time_step);

    /// Sets `tractions` to those of one symmetric sweep of Gauss-Seidel over this rank's rows, from 0: an approximate
    /// inverse of dt N A^-1 N^T with the compliances, symmetric and positive, on what the ground holds.
    void precondition(const Vectors &flows, Vectors &tractions);

    /// Shape function of a row at a node of its cell times the area, m^(dim-1).
    double weight(const unsigned int row, const unsigned int i) const
    {
      return of_flow[row * grid.n_nodes_per_cell() + i];
    }

    /// Their sum over the nodes.
    double weight_of_row(const unsigned int row) const
    {
      double sum = 0.;
      for (unsigned int i = 0; i < grid.n_nodes_per_cell(); ++i)
        sum += weight(row, i);
      return sum;
    }

    /// The cell of a row.
    unsigned int cell(const unsigned int row) const
    {
      return facets[row]->cell;
    }

    /// The nodes of that.
    const unsigned int *nodes(const unsigned int row) const
    {
      return grid.nodes(cell(row));
    }

    std::vector<GroundRow<dim>> all; ///< with the tractions of the last solve

  private:
    const BackgroundGrid<dim> &grid;
    std::vector<const CutFacet<dim> *> facets; // by row
    // A row's nodes behind each other: shape functions in u and in q, and velocities of a phase's nodes for a unit
    // traction at the row; their numbers among those that rows act on.
    std::vector<double> of_flow, of_discharge, responses;
    std::vector<unsigned int> corners;
    std::vector<unsigned int> number_of_node; // by node and phase
    std::vector<NodeRow> motions;             // by number, m/s
  };

  /// Pressures by owned unknown, Pa, and tractions by row of the ground, Pa; or flows, m^dim/s.
  template <int dim>
  struct PressuresAndTractions
  {
    std::vector<double> pressures;               ///< by owned unknown
    typename GroundRows<dim>::Vectors tractions; ///< by row

    /// All is 0.
    void clear(const std::size_t n_pressures, const std::size_t n_rows)
    {
      pressures.assign(n_pressures, 0.);
      tractions.assign(n_rows, dealii::Tensor<1, dim>());
    }

    /// *this = factor * *this + other_factor * other.
    void sadd(const double factor, const double other_factor, const PressuresAndTractions &other)
    {
      for (unsigned int i = 0; i < pressures.size(); ++i)
        pressures[i] = factor * pressures[i] + other_factor * other.pressures[i];
      for (unsigned int k = 0; k < tractions.size(); ++k)
        tractions[k] = factor * tractions[k] + other_factor * other.tractions[k];
    }

    /// This rank's part of the scalar product.
    double operator*(const PressuresAndTractions &other) const
    {
      double sum = 0.;
      for (unsigned int i = 0; i < pressures.size(); ++i)
        sum += pressures[i] * other.pressures[i];
      for (unsigned int k = 0; k < tractions.size(); ++k)
        sum += tractions[k] * other.tractions[k];
      return sum;
    }
  };
} // namespace scree

#endif

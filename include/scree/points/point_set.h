// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_points_point_set_h
#define scree_points_point_set_h

#include <scree/points/cell_costs.h>

#include <deal.II/base/point.h>
#include <deal.II/fe/mapping.h>
#include <deal.II/particles/particle_handler.h>

#include <cstddef>
#include <type_traits>
#include <vector>

namespace scree
{
  /// The points of one cell, contiguous in memory. Pointers are to the first point.
  ///
  /// @tparam Number double, or const double for points that must not change
  template <int dim, typename Number = double>
  struct CellPoints
  {
    using Location = std::conditional_t<std::is_const_v<Number>, const dealii::Point<dim>, dealii::Point<dim>>;

    unsigned int cell; ///< active cell index
    unsigned int n_points;
    unsigned int stride; ///< doubles from one point's properties to the next one's
    Number *properties;
    Location *location; ///< m
    const dealii::Point<dim> *reference_location;

    /// Properties of the cell's point `p`.
    Number *properties_of(const unsigned int p) const
    {
      return properties + std::size_t(p) * stride;
    }
  };

  /// The points of one cell of a set that must not change.
  template <int dim>
  using ConstCellPoints = CellPoints<dim, const double>;

  /// One point of a set, as for_each_point() shows it.
  template <int dim, typename Number>
  struct PointView
  {
    unsigned int cell; ///< active cell index
    Number *properties;
    typename CellPoints<dim, Number>::Location &location; ///< m
    const dealii::Point<dim> &reference_location;
  };

  /// A point that lay outside the mesh when the set was sorted.
  template <int dim>
  struct LostPoint
  {
    dealii::Point<dim> location; ///< m
    std::vector<double> properties;
  };

  /// A set of material points on a distributed mesh: a ParticleHandler, seen cell by cell.
  template <int dim>
  class PointSet
  {
  public:
    PointSet(const dealii::Triangulation<dim> &triangulation,
             const dealii::Mapping<dim> &mapping,
             const unsigned int n_properties);

    /// Hands every point to the cell and rank it lies in now; cheap while no point of any rank has left its cell.
    /// Collective. Points outside the mesh leave the set and are appended to lost().
    void sort();

    /// The first half of sort(), of this rank alone: sets the points' places in their cells. Returns whether all points
    /// of this rank are still in their cells; unless this holds on all ranks, hand_over() must follow.
    bool update_places();

    /// The other half of sort(). Collective.
    void hand_over();

    /// Refreshes cells(): after points were inserted or unpacked.
    void update_cells();

    /// This rank's cells that hold points. Valid until the next sort().
    const std::vector<CellPoints<dim>> &cells()
    {
      return cell_list;
    }
    const std::vector<ConstCellPoints<dim>> &cells() const
    {
      return const_cell_list;
    }

    /// This rank's points that left the mesh since the list was last cleared.
    std::vector<LostPoint<dim>> &lost()
    {
      return lost_points;
    }

    /// What the points cost in the passes that move them, cell by cell.
    CellCosts &costs()
    {
      return cell_costs;
    }
    const CellCosts &costs() const
    {
      return cell_costs;
    }

    /// Doubles from one point's properties to the next one's.
    unsigned int stride() const
    {
      return n_properties;
    }

    dealii::Particles::ParticleHandler<dim> &handler()
    {
      return particle_handler;
    }
    const dealii::Particles::ParticleHandler<dim> &handler() const
    {
      return particle_handler;
    }

  private:
    const MPI_Comm communicator;
    const unsigned int n_properties;
    dealii::Particles::ParticleHandler<dim> particle_handler;
    std::vector<CellPoints<dim>> cell_list;
    std::vector<ConstCellPoints<dim>> const_cell_list; // the same cells
    std::vector<LostPoint<dim>> lost_points;
    CellCosts cell_costs;
  };


  /// Calls `act(point)` with a PointView of each of a cell's points. Inlined by force: out of line, a kernel's sums
  /// would go through memory (a sixth more time from points to nodes).
  template <int dim, typename Number, typename Act>
  DEAL_II_ALWAYS_INLINE inline void for_each_point(const CellPoints<dim, Number> &cell, const Act &act)
  {
    for (unsigned int p = 0; p < cell.n_points; ++p)
      act(PointView<dim, Number>{ cell.cell, cell.properties_of(p), cell.location[p], cell.reference_location[p] });
  }


  /// Calls `act(point)` with a PointView of each of this rank's points, cell by cell.
  template <int dim, typename Act>
  void for_each_point(PointSet<dim> &points, const Act &act)
  {
    for (const auto &cell : points.cells())
      for_each_point(cell, act);
  }


  /// The same for points that must not change.
  template <int dim, typename Act>
  void for_each_point(const PointSet<dim> &points, const Act &act)
  {
    for (const auto &cell : points.cells())
      for_each_point(cell, act);
  }
} // namespace scree

#endif

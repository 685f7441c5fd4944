// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_particles_point_exchange_h
#define scree_particles_point_exchange_h

#include <scree/particles/cell_table.h>

#include <deal.II/grid/cell_id.h>
#include <deal.II/particles/property_pool.h>

#include <map>
#include <vector>

namespace scree
{
  /// What a point carries from cell to cell or rank to rank.
  template <int dim>
  struct PointRecord
  {
    dealii::CellId::binary_type cell; ///< where it goes
    dealii::Point<dim> location;      ///< m
    dealii::types::particle_index id; ///< lasting number of the point
    std::vector<double> properties;   ///< in the layout of its set

    /// Saves or loads all members (Boost).
    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &cell &location &id &properties;
    }
  };


  /// The points of one set that go from rank to rank.
  template <int dim>
  class PointExchange
  {
  public:
    using CellIterator = typename CellTable<dim>::Iterator; ///< iterator over the cells of the mesh

    /// @param triangulation mesh of the points; must live on
    explicit PointExchange(const dealii::Triangulation<dim> &triangulation);

    /// Adds a point to those that leave for the rank of this ghost cell.
    void add(const CellIterator &cell, PointRecord<dim> &record);

    /// Whether no point of this rank leaves.
    bool is_empty() const
    {
      return emigrants.empty();
    }

    /// Sends the points that leave and returns those that come. Collective.
    std::vector<PointRecord<dim>> exchange();

  private:
    using Record = PointRecord<dim>;

    const dealii::Triangulation<dim> &mesh;
    std::map<unsigned int, std::vector<Record>> emigrants; // by rank
  };
} // namespace scree

#endif

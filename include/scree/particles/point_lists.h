// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_particles_point_lists_h
#define scree_particles_point_lists_h

#include <scree/particles/cell_points.h>
#include <scree/particles/cell_table.h>

#include <deal.II/particles/particle_handler.h>

#include <cstdint>
#include <vector>

namespace scree
{
  /// A rank's points, cell by cell: the same points in the same order as in the lists of a ParticleHandler, the cells
  /// in the order of the curve through the mesh.
  template <int dim>
  class PointLists
  {
  public:
    /// A cell with points.
    struct FilledCell
    {
      std::uint64_t number;  ///< of the cell on the curve through the mesh
      unsigned int in_table; ///< its number there
      unsigned int n_points; ///< number of points in the cell
    };

    /// Keeps references to both; list_all() fills the lists.
    PointLists(dealii::Particles::ParticleHandler<dim> &handler, CellTable<dim> &table);

    /// Lists filled cells and their slots anew, as the handler has them.
    void list_all();

    /// Takes a point out of those of a filled cell, as the handler does: the last one takes its number. cells() keeps
    /// it until update().
    void remove(const unsigned int cell, const unsigned int point)
    {
      unsigned int *own = slots.data() + (cell_list[cell].slots - slots.data());
      own[point]        = own[--filled[cell].n_points];
    }

    /// Adds a point that has got this slot in the cell with this number in the table; it is among cells() after
    /// update().
    void insert(const unsigned int number, const unsigned int slot)
    {
      entrants.push_back({ table[number].number, static_cast<unsigned int>(entrants.size()), number, slot });
    }

    /// Whether update() has anything to put in.
    bool has_entrants() const
    {
      return !entrants.empty();
    }

    /// Puts the entrants into the lists and drops empty cells.
    void update();

    /// The cells with points.
    const std::vector<CellPoints<dim>> &cells()
    {
      return cell_list;
    }

    /// Read-only access to the points.
    const std::vector<ConstCellPoints<dim>> &cells() const
    {
      return const_cell_list;
    }

    /// The same cells in the table.
    const std::vector<FilledCell> &filled_cells() const
    {
      return filled;
    }

    /// Number of this rank's points.
    unsigned int n_points() const
    {
      return slots.size() - points_ahead;
    }

  private:
    using CellIterator = typename CellTable<dim>::Iterator;

    /// A point that has come into a cell since cells() was made.
    struct Entrant
    {
      bool operator<(const Entrant &other) const
      {
        return number < other.number || (number == other.number && turn < other.turn);
      }

      std::uint64_t number;  // of the cell, as above
      unsigned int turn;     // among all entrants
      unsigned int in_table; // the cell's number there
      unsigned int slot;
    };

    /// Appends a cell with `n` of its slots and those entrants from `entrant` on that are its own to the new lists;
    /// returns the first one that is not.
    const Entrant *
    append_cell(const FilledCell &cell, const unsigned int *first_slot, const Entrant *entrant, const Entrant *end);

    /// Makes cells() from the lists.
    void point_to_records();

    dealii::Particles::ParticleHandler<dim> &handler;
    CellTable<dim> &table;

    std::vector<FilledCell> filled, new_filled;
    /// Of all points, cell by cell; behind them so many that kernels may look ahead.
    std::vector<unsigned int> slots = std::vector<unsigned int>(points_ahead), new_slots;
    std::vector<CellPoints<dim>> cell_list;
    std::vector<ConstCellPoints<dim>> const_cell_list; // the same cells
    std::vector<Entrant> entrants;
  };
} // namespace scree

#endif

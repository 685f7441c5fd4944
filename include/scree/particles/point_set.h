// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_particles_point_set_h
#define scree_particles_point_set_h

#include <scree/deal_ii_versions.h>
#include <scree/particles/cell_points.h>
#include <scree/simd/records.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>
#include <deal.II/fe/mapping.h>
#include <deal.II/grid/cell_id.h>
#include <deal.II/particles/property_pool.h>

#include <cmath>
#include <functional>
#include <map>
#include <memory>

namespace scree
{
  /// Edge of the square or cube that has a volume, m: the size of a point.
  template <int dim>
  double edge_of_cube(const double volume)
  {
    return dim == 2 ? std::sqrt(volume) : std::cbrt(volume);
  }

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


  /// A point that lay outside the mesh when the set was sorted.
  template <int dim>
  struct LostPoint
  {
    dealii::Point<dim> location;    ///< m
    std::vector<double> properties; ///< in the layout of its set
  };

  /// What it takes to bring all points into the cells and to the ranks that they lie in now; the ranks do what the
  /// largest of their answers says.
  enum class Disorder
  {
    none,            ///< nothing
    beside_a_border, ///< a point lies in a cell of a neighbouring rank
    scattered,       ///< the records of cells lie too far apart in memory
    far              ///< a point lies outside the mesh or beyond its neighbours
  };

  /// A set of material points on a distributed mesh: a ParticleHandler, seen cell by cell.
  ///
  /// Points that change cells keep their record's slot: the handler only lists it in another cell, or passes it on to
  /// the neighbouring rank. So a step costs nothing for empty cells and little for points that stay. Now and then all
  /// points are taken off the mesh and put back, which brings the records of a cell together in memory again; when that
  /// is done changes no result.
  template <int dim>
  class PointSet
  {
  public:
    /// How often a rank's points change cells, on average, before records are put in order in memory again.
    static constexpr double most_moved = 2.;

    /// Makes an empty set on a mesh with its mapping, which must live on.
    /// @param n_properties doubles of a point
    PointSet(const dealii::Triangulation<dim> &triangulation,
             const dealii::Mapping<dim> &mapping,
             const unsigned int n_properties);
    ~PointSet();

    /// Hands every point to the cell and rank it lies in, and brings the records of a cell together in memory:
    /// deal.II's sort, for any state of the handler. Collective. Points outside the mesh leave the set and are appended
    /// to lost().
    void sort()
    {
      particle_handler.sort_particles_into_subdomains_and_cells();
      n_moved = 0;
      list_all_cells();
      set_places(); // as hand_over() does: those of deal.II 9.6 and later differ in the last digit
    }

    /// The same after cells() moved, at the cost of the points that leave their cells. Collective.
    void hand_over()
    {
      const int disorder = static_cast<int>(update_places());
      hand_over(static_cast<Disorder>(dealii::Utilities::MPI::max(disorder, communicator_of(mesh))));
    }

    /// The first half of hand_over(), of this rank alone: sets the points' places in their cells, and takes those out
    /// that left for another rank. What is left to do is for the other half, with the largest answer of all ranks.
    Disorder update_places();

    /// The other half. Collective.
    void hand_over(const Disorder disorder);

    /// Puts a point into a cell of this rank; it is among cells() after finish_adding().
    /// @param properties as many as stride()
    void add(const typename dealii::Triangulation<dim>::active_cell_iterator &cell,
             const dealii::Point<dim> &location,
             const dealii::types::particle_index id,
             const std::vector<double> &properties)
    {
      insert(table.number_of(cell), location, id, properties);
    }

    /// Puts the added points into the lists.
    void finish_adding()
    {
      if (!entrants.empty())
        update_lists();
    }

    /// Takes all points off the mesh, before its cells or their ranks change.
    void lift();

    /// Ranks of the cells around these places.
    using RanksAt = std::function<std::vector<dealii::types::subdomain_id>(const std::vector<dealii::Point<dim>> &)>;

    /// Puts them back on the mesh, which has the same coarse cells and cells as large as before or smaller where points
    /// were. Collective.
    /// @param ranks_at needed if ranks of cells have changed
    void put_down(const RanksAt &ranks_at = {});

    /// Whether one of this rank's points has got into a cell that is no CellUse::inner one, in the step before or since
    /// it was put there.
    bool is_at_edge() const
    {
      return at_edge;
    }

    /// Whether all cells() are inner ones, as a step needs it.
    bool is_in_inner_cells() const
    {
      return std::all_of(filled.begin(), filled.end(), [this](const auto &cell) {
        return use_of(table[cell.in_table].iterator) == CellUse::inner;
      });
    }

    /// This rank's cells that hold points, in the order of the curve through the mesh, so that it depends on the cells'
    /// places only. Valid until the points move on.
    const std::vector<CellPoints<dim>> &cells()
    {
      return cell_list;
    }

    /// Read-only access to the points.
    const std::vector<ConstCellPoints<dim>> &cells() const
    {
      return const_cell_list;
    }

    /// The lasting numbers of the points of cells()[cell], in their order: unique in the set over all ranks; a point
    /// keeps its own from cell to cell, rank to rank and through checkpoints.
    std::vector<dealii::types::particle_index> ids(const unsigned int cell) const
    {
      const auto &pool                   = particle_handler.get_property_pool();
      const ConstCellPoints<dim> &points = const_cell_list[cell];
      std::vector<dealii::types::particle_index> result;
      for (unsigned int p = 0; p < points.n_points; ++p)
        result.push_back(pool.get_id(points.slots[p]));
      return result;
    }

    /// The lasting number of the point that is added next, the same on all ranks.
    dealii::types::particle_index next_id = 0;

    /// Number of this rank's points.
    unsigned int n_points() const
    {
      return slots.size() - points_ahead;
    }

    /// This rank's points that left the mesh since the list was last cleared.
    std::vector<LostPoint<dim>> &lost()
    {
      return lost_points;
    }

    /// Doubles from one point's properties to the next one's.
    unsigned int stride() const
    {
      return n_properties;
    }

    /// deal.II's list of the points. Call sort() after points have changed cells in it.
    dealii::Particles::ParticleHandler<dim> &handler()
    {
      return particle_handler;
    }

    /// Read-only access.
    const dealii::Particles::ParticleHandler<dim> &handler() const
    {
      return particle_handler;
    }

  private:
    using CellIterator = typename CellTable<dim>::Iterator;
    using Record       = PointRecord<dim>;

    /// A cell with points.
    struct FilledCell
    {
      std::uint64_t number;  // of the cell on the curve through the mesh
      unsigned int in_table; // its number there
      unsigned int n_points;
    };

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

    /// A point that is no longer in its cell.
    struct Leaver
    {
      unsigned int from;  // number in the list of filled cells
      unsigned int point; // number in the cell
      unsigned int to;    // number in the table
    };

    /// What points carry from mesh to mesh.
    struct Lifted;

    /// Sets the places of the points that are still in their cells, and lists the others in `leavers`. Returns whether
    /// the cells of all were found.
    bool set_places();

    /// Takes a point out of the handler's and the own lists.
    void take_out(const Leaver &leaver, Record &record);

    /// Puts it into the cell with this number in the table, or among the emigrants.
    void hand_on(const unsigned int to, Record &record)
    {
      const CellIterator &cell = table[to].iterator;
      if (cell->is_locally_owned())
        return insert(to, record.location, record.id, record.properties);
      record.cell = cell->id().template to_binary<dim>();
      emigrants[cell->subdomain_id()].push_back(record);
    }

    /// Sends the points that leave to ranks beside this one, and puts in those that come. Collective.
    void exchange();

    /// Puts in the points that have come from another rank.
    void receive(const std::vector<Record> &records)
    {
      for (const Record &one : records)
        insert(table.number_of(active_cell(one.cell, one.location)), one.location, one.id, one.properties);
    }

    /// The cell of the mesh around a place that was in a cell with this number, or this rank's larger one there if it
    /// is another rank's.
    CellIterator active_cell(const dealii::CellId::binary_type &id, const dealii::Point<dim> &x) const;

    /// Gives the handler a point of the cell with this number in the table; returns its slot.
    unsigned int insert_into(const unsigned int number,
                             const dealii::Point<dim> &location,
                             const dealii::types::particle_index id,
                             const dealii::ArrayView<const double> &properties)
    {
      const auto place = table[number].template place_of<double>(location);
      dealii::Point<dim> reference_location;
      std::copy(place.begin(), place.end(), &reference_location[0]);
      return particle_handler.insert_particle(location, reference_location, id, table[number].iterator, properties)
          ->get_local_index();
    }

    /// The same with a point that becomes an entrant: it is among cells() after update_lists().
    void insert(const unsigned int number,
                const dealii::Point<dim> &location,
                const dealii::types::particle_index id,
                const std::vector<double> &properties)
    {
      const unsigned int slot = insert_into(number, location, id, dealii::make_array_view(properties));
      entrants.push_back({ table[number].number, static_cast<unsigned int>(entrants.size()), number, slot });
    }

    /// Takes out the points in cells beyond the walls.
    void lose_points_outside();

    /// Makes cells() anew, as the handler has them.
    void list_all_cells();

    /// Puts the entrants into the lists and drops empty cells.
    void update_lists();

    /// Appends a cell with `n` of its slots and those entrants from `entrant` on that are its own to the new lists;
    /// returns the first one that is not.
    const Entrant *
    append_cell(const FilledCell &cell, const unsigned int *first_slot, const Entrant *entrant, const Entrant *end)
    {
      new_slots.insert(new_slots.end(), first_slot, first_slot + cell.n_points);
      unsigned int n_points = cell.n_points;
      for (; entrant != end && entrant->number == cell.number; ++entrant, ++n_points)
        new_slots.push_back(entrant->slot);
      if (n_points > 0)
        new_filled.push_back({ cell.number, cell.in_table, n_points });
      return entrant;
    }

    /// Makes cells() from the lists.
    void point_to_records();

    const dealii::Triangulation<dim> &mesh;
    const unsigned int n_properties;
    dealii::Particles::ParticleHandler<dim> particle_handler;
    CellTable<dim> table;
    boost::signals2::scoped_connection refinement_signal, repartition_signal;

    // The same points in the same order as in the lists of the handler.
    std::vector<FilledCell> filled, new_filled;
    /// Of all points, cell by cell; behind them so many that kernels may look ahead.
    std::vector<unsigned int> slots = std::vector<unsigned int>(points_ahead), new_slots;
    std::vector<CellPoints<dim>> cell_list;
    std::vector<ConstCellPoints<dim>> const_cell_list; // the same cells
    std::vector<Entrant> entrants;

    std::vector<Leaver> leavers;
    std::vector<Record> carried;                           // the leavers, between two cells
    std::map<unsigned int, std::vector<Record>> emigrants; // by rank
    std::size_t n_moved = 0;                               // points that changed cells since the last sort()
    std::vector<LostPoint<dim>> lost_points;
    std::unique_ptr<Lifted> lifted;
    bool at_edge = false;
  };


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

  /// Where the records of a batch of a cell's points lie.
  template <int dim>
  struct BatchPointers
  {
    RecordPointers<double> properties,   ///< properties of each point
        locations;                       ///< location of each point, m
    RecordPointers<const double> places; ///< in the cell, from 0 to 1

    /// @param indices of points in the cell
    BatchPointers(const CellPoints<dim> &cell, const BatchIndices &indices)
    {
      for (unsigned int l = 0; l < batch_size; ++l)
        {
          properties[l] = apart(cell.properties_of(indices[l]));
          locations[l]  = apart(&cell.location_of(indices[l])[0]);
          places[l]     = apart(&cell.reference_location_of(indices[l])[0]);
        }
    }

    /// Properties from a slot on.
    RecordPointers<double> slots_at(const unsigned int slot) const
    {
      RecordPointers<double> slots = properties;
      for (double *&pointer : slots)
        pointer = apart(pointer + slot);
      return slots;
    }
  };


  /// The largest of squares of speeds, m^2/s^2, lane by lane; not a number if any was not.
  struct LargestSquare
  {
    Batch of_lanes = simd::broadcast<Batch>(0.); ///< largest square so far

    /// Takes in the first `n` of a batch.
    void include(const Batch &squares, const unsigned int n)
    {
      const simd::Mask<Batch> is_larger = simd::first_lanes(n) & !(squares <= of_lanes) & (of_lanes == of_lanes);
      of_lanes                          = simd::select<Batch>(is_larger, squares, of_lanes);
    }

    /// Largest speed, m/s.
    double speed() const
    {
      double largest = 0;
      for (unsigned int l = 0; l < batch_size; ++l)
        if (!(of_lanes[l] <= largest))
          largest = of_lanes[l];
      return simd::any(of_lanes != of_lanes) ? std::numeric_limits<double>::quiet_NaN() : std::sqrt(largest);
    }
  };
} // namespace scree

#endif

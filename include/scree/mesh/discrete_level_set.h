// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_mesh_discrete_level_set_h
#define scree_mesh_discrete_level_set_h

#include <scree/geometry/level_set.h>
#include <scree/mesh/background_grid.h>

#include <unordered_map>

namespace scree
{
  /// Whether a surface may move.
  enum class SurfaceMotion
  {
    none,
    rigid ///< without turning
  };

  /// A rigid surface as this rank's fine cells near it see it: distance and normal at the corners of a lattice of such
  /// cells, multilinear between. The normals are those of the corners and not the gradient of the distance, which jumps
  /// between cells. The lattice moves with the surface, which so keeps its shape; at rest it is that of the mesh.
  template <int dim>
  class DiscreteLevelSet
  {
  public:
    /// Both are kept by reference.
    DiscreteLevelSet(const BackgroundGrid<dim> &grid,
                     const LevelSet<dim> &surface,
                     const SurfaceMotion motion = SurfaceMotion::none);

    /// Looks at the surface from the grid's current cells. Collective; throws EntryError if an expression is no number
    /// at one of the corners.
    /// @param displacement from where the level set has it, m; 0 unless it may move
    void reinit(const dealii::Tensor<1, dim> &displacement = {})
    {
      place(displacement);
      look();
    }

    /// The same on the mesh as it was, at little cost. Collective.
    void move_to(const dealii::Tensor<1, dim> &displacement)
    {
      if (place(displacement))
        look();
    }

    /// How far from the surface cells are near, m.
    double reach() const
    {
      // A point crosses a cell in a step at most, and touches from less than a cell away.
      return 3. * grid.cell_size();
    }

    /// Whether a cell is within some cells of the surface, so that the other functions may be asked.
    bool is_near(const unsigned int cell) const
    {
      return entry_of_cell[cell] != none;
    }

    /// The smallest distance of a cell's corners, m: none of its places is nearer. Infinite if it is not near.
    double least_distance(const unsigned int cell) const
    {
      return is_near(cell) ? least[entry_of_cell[cell]] : std::numeric_limits<double>::infinity();
    }

    /// The surface from a place (from 0 to 1) in a near cell.
    SurfaceView<dim> view(const unsigned int cell, const dealii::Point<dim> &place) const;

    /// How far a place is from a surface at rest, m; three cells if it is not near. Where the cells see it inside, it
    /// is so only if it truly is: they do not resolve ground that is thinner than they are.
    /// @param x the place, m
    /// @param enough m, at most 0: a larger distance that the cells see is returned as it is
    double distance_of(const unsigned int cell,
                       const dealii::Point<dim> &place,
                       const dealii::Point<dim> &x,
                       const double enough = 0.) const
    {
      if (!is_near(cell))
        return reach();
      const double seen = view(cell, place).distance;
      return seen >= enough || is_moving() ? seen : std::max(seen, surface.view(x, grid.cell_size()).distance);
    }

    /// Its distance alone, m, from several places in a near cell; equal to that of view() but for rounding.
    Batch distances(const unsigned int cell, const std::array<Batch, dim> &places) const;

  private:
    static constexpr unsigned int n_vertices = 1u << dim;
    static constexpr unsigned int none       = dealii::numbers::invalid_unsigned_int;

    bool is_moving() const
    {
      return motion == SurfaceMotion::rigid;
    }

    /// Returns whether the lattice lies in other cells now.
    bool place(const dealii::Tensor<1, dim> &displacement)
    {
      const CellPlace<dim> before = whole_cells;
      for (unsigned int a = 0; a < dim; ++a)
        {
          const double cells = displacement[a] / grid.cell_size();
          whole_cells[a]     = static_cast<int>(std::floor(cells));
          part_of_cell[a]    = cells - whole_cells[a];
        }
      return whole_cells != before;
    }

    void look()
    {
      entry_of_cell.assign(grid.triangulation().n_active_cells(), none);
      corners.clear();
      least.clear();
      on_all_ranks(grid.communicator(), [&] { sample(); });
    }
    void sample();

    /// The surface from a corner of the lattice.
    const SurfaceView<dim> &at_vertex(const CellPlace<dim> &corner);

    const BackgroundGrid<dim> &grid;
    const LevelSet<dim> &surface;
    const SurfaceMotion motion;
    const unsigned int n_1d;               // corners a cell and axis: a lattice that moves has two cells there
    const unsigned int n_of_cell;          // corners
    std::array<unsigned int, dim> strides; // of a cell's corners along the axes
    std::array<unsigned int, n_vertices> corner_offset;       // of the corners of one cell of the lattice
    CellPlace<dim> whole_cells{};                             // that the surface has moved
    dealii::Tensor<1, dim> part_of_cell;                      // the rest, from 0 to 1
    std::unordered_map<std::uint64_t, SurfaceView<dim>> seen; // of cells, now or before
    std::vector<unsigned int> entry_of_cell;                  // by active cell index
    std::vector<SurfaceView<dim>> corners;                    // of the near cells
    std::vector<double> least;
  };

  /// A part of rigid ground. What it refers to must live on.
  template <int dim>
  struct GroundPart
  {
    const DiscreteLevelSet<dim> *samples;             ///< its surface, sampled on the mesh
    const dealii::Tensor<1, dim> *velocity = nullptr; ///< in the current step, m/s; null if it never moves
  };

  /// Rigid ground as the mesh sees it: all that is at rest as one part, and each part that moves. What is inside any of
  /// them is inside.
  template <int dim>
  class RigidBoundary
  {
  public:
    /// @param parts at least one
    explicit RigidBoundary(const std::vector<GroundPart<dim>> &parts);

    /// The parts in the order of the constructor's.
    const std::vector<GroundPart<dim>> &parts() const
    {
      return all_parts;
    }

    /// Whether any part may move.
    bool moves() const
    {
      return any_moves;
    }

    /// Whether a part that may move is near a cell.
    bool moves_near(const unsigned int cell) const
    {
      return any_moves && std::any_of(all_parts.begin(), all_parts.end(), [cell](const GroundPart<dim> &part) {
               return part.velocity != nullptr && part.samples->is_near(cell);
             });
    }

    /// Number of parts that are near a cell.
    unsigned int n_near(const unsigned int cell) const
    {
      return std::count_if(all_parts.begin(), all_parts.end(), [cell](const GroundPart<dim> &part) {
        return part.samples->is_near(cell);
      });
    }

    /// As DiscreteLevelSet: the least of all parts'.
    double least_distance(const unsigned int cell) const
    {
      double least = std::numeric_limits<double>::infinity();
      for (const GroundPart<dim> &part : all_parts)
        least = std::min(least, part.samples->least_distance(cell));
      return least;
    }

    /// The part that is nearest to a place (from 0 to 1) in a cell that is near one, or deepest around it.
    unsigned int nearest_part(const unsigned int cell, const dealii::Point<dim> &place) const;

    /// How fast a part moves, m/s.
    dealii::Tensor<1, dim> velocity(const unsigned int part) const
    {
      const dealii::Tensor<1, dim> *of_part = all_parts[part].velocity;
      return of_part == nullptr ? dealii::Tensor<1, dim>() : *of_part;
    }

    /// As DiscreteLevelSet, of the nearest part.
    SurfaceView<dim> view(const unsigned int cell, const dealii::Point<dim> &place) const
    {
      const unsigned int part = all_parts.size() == 1 ? 0 : nearest_part(cell, place);
      return all_parts[part].samples->view(cell, place);
    }

    /// As DiscreteLevelSet, from a cell that is near a part.
    Batch distances(const unsigned int cell, const std::array<Batch, dim> &places) const
    {
      Batch nearest = simd::broadcast<Batch>(std::numeric_limits<double>::infinity());
      for (const GroundPart<dim> &part : all_parts)
        if (part.samples->is_near(cell))
          nearest = simd::min<Batch>(nearest, part.samples->distances(cell, places));
      return nearest;
    }

  private:
    const std::vector<GroundPart<dim>> all_parts;
    const bool any_moves;
  };
} // namespace scree

#endif

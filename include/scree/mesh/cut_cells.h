// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_mesh_cut_cells_h
#define scree_mesh_cut_cells_h

#include <scree/mesh/discrete_level_set.h>

namespace scree
{
  /// A piece of the ground in a cell.
  template <int dim>
  struct GroundFace
  {
    SimplexFace<dim> corners;      ///< in the unit cell
    dealii::Tensor<1, dim> normal; ///< unit, out of the open
    unsigned int part;             ///< of RigidBoundary
  };

  /// What rigid ground leaves open of a cell. The ground is plane in each simplex of the cell (Kuhn's), between
  /// distances at the corners.
  template <int dim>
  struct CutCell
  {
    static constexpr unsigned int n_vertices = 1 << dim; ///< vertices of a cell
    using AtVertices = std::array<double, n_vertices>;   ///< a number a vertex, in deal.II's order

    unsigned int cell    = 0;                                  ///< active cell index
    double open_fraction = 0.;                                 ///< of the volume
    std::array<double, CubicWeights<dim>::n_points> weights{}; ///< see CubicWeights, of the open part
    AtVertices open_hats{}; ///< integrals of the corners' linear functions over the open part, over the cell's volume

    std::vector<Simplex<dim>> open;     ///< what they integrate over
    std::vector<GroundFace<dim>> faces; ///< of that, on the ground

    unsigned int first_segment = 0,     ///< its first one in CutCells::segments()
        n_segments             = 0;     ///< how many it has there
    bool may_change            = false; ///< whether ground that moves is near
  };

  /// What a cell has of one part of the ground.
  template <int dim>
  struct CutFacet
  {
    unsigned int cell = 0; ///< active cell index
    unsigned int part = 0; ///< of RigidBoundary

    double area = 0.;                                   ///< what its normals add up to, m^(dim-1)
    dealii::Tensor<1, dim> normal;                      ///< unit, mean over the segment, out of the open
    dealii::Point<dim> middle;                          ///< m
    typename CutCell<dim>::AtVertices vertex_weights{}; ///< means of the corners' linear functions over the segment
    std::vector<double> shapes;                         ///< the same of the velocity's functions
  };

  /// The cells of this rank that are not all open: cut by rigid ground, beside it, or below it.
  template <int dim>
  class CutCells
  {
  public:
    /// What is looked at of a cell.
    enum class Content
    {
      all,
      segments ///< no volumes, which only water needs; find() gives cells with segments alone
    };

    /// Both are kept by reference.
    /// @param thinnest open part of a cell beside ground that moves, cells: what is thinner counts as closed
    CutCells(const BackgroundGrid<dim> &grid,
             const RigidBoundary<dim> &ground,
             const double thinnest = 0.,
             const Content content = Content::all)
        : grid(grid)
        , ground(ground)
        , thinnest(thinnest)
        , content(content)
        , unit_cube(simplices_of_cube(dealii::Point<dim>(), 1.))
    {
      reinit();
    }

    /// Looks at the cells anew, after the ground has.
    void reinit()
    {
      entry_of_cell.assign(grid.triangulation().n_active_cells(), none);
      cut_cells.clear();
      all_segments.clear();
      for (const auto &cell : grid.fine_cells().cells())
        if (grid.fine_cells().is_owned(cell))
          look_at(cell.index);
    }

    /// The same on the mesh as it was, where ground moves.
    void follow();

    /// For each segment its number before follow(), `none` if it is new.
    const std::vector<unsigned int> &numbers_before() const
    {
      return before;
    }

    /// What the ground does to a cell; null if that is all open and has none on its faces.
    const CutCell<dim> *find(const unsigned int cell) const
    {
      const unsigned int entry = entry_of_cell[cell];
      return entry == none ? nullptr : &cut_cells[entry];
    }

    /// Part of a cell that is open: at least so much that what has got into a closed one fills it.
    double open_fraction(const unsigned int cell) const
    {
      const CutCell<dim> *cut = find(cell);
      return cut == nullptr ? 1. : std::max(cut->open_fraction, smallest);
    }

    /// Cells of this rank that are not all open.
    const std::vector<CutCell<dim>> &cells() const
    {
      return cut_cells;
    }

    /// The ground in all cells, cell by cell.
    const std::vector<CutFacet<dim>> &segments() const
    {
      return all_segments;
    }

    /// How fast the ground is at a segment, m/s.
    dealii::Tensor<1, dim> velocity(const CutFacet<dim> &segment) const
    {
      return ground.velocity(segment.part);
    }

    static constexpr double smallest   = 1e-9;                                  ///< lower bound of open_fraction()
    static constexpr unsigned int none = dealii::numbers::invalid_unsigned_int; ///< stands for no cell or segment

  private:
    /// Adds a cell, if it is not all open, and its segments.
    void look_at(const unsigned int cell);

    /// Adds the segments of a cell.
    void integrate_ground(const std::vector<Simplex<dim>> &simplices, CutCell<dim> &cut);

    /// The facet of the ground's part that is nearest to a place of the unit cell; made where there is none yet.
    CutFacet<dim> &facet_of(CutCell<dim> &cut, const dealii::Point<dim> &middle);

    /// Makes means of the sums over a cell's facets, and drops those without size.
    void finish_facets(CutCell<dim> &cut);

    const BackgroundGrid<dim> &grid;
    const RigidBoundary<dim> &ground;
    const double thinnest;
    const Content content;
    const std::vector<Simplex<dim>> unit_cube;
    std::vector<unsigned int> entry_of_cell; // by active cell index
    std::vector<CutCell<dim>> cut_cells;
    std::vector<CutFacet<dim>> all_segments;
    std::vector<unsigned int> before;
  };
} // namespace scree

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_initial_steady_seepage_h
#define scree_initial_steady_seepage_h

#include <scree/bodies/water_parameters.h>
#include <scree/boundary/water_walls.h>
#include <scree/geometry/level_set.h>
#include <scree/mesh/background_grid.h>
#include <scree/particles/cell_places.h>
#include <scree/pressure/free_surface.h>
#include <scree/seeding/seeding.h>

#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace scree
{
  /// A cell with soil, divided into equal parts.
  template <int dim>
  struct SeepageCell
  {
    static constexpr unsigned int n_1d    = dim == 2 ? 4 : 3;                  ///< parts along an axis
    static constexpr unsigned int n_parts = dealii::Utilities::pow(n_1d, dim); ///< parts of a cell

    unsigned int index;                       ///< active cell index
    dealii::Point<dim> corner;                ///< lower one, m
    std::array<double, n_parts> conductivity; ///< m/s; 0 outside the soil
  };

  /// A piece of the soil's surface that water can cross.
  template <int dim>
  struct SeepageFace
  {
    unsigned int cell;           ///< in the list of cells
    dealii::Point<dim> location; ///< m
    dealii::Point<dim> place;    ///< in the cell, from 0 to 1 along each axis
    double area;                 ///< m^2 (2D: m)
    double conductivity;         ///< of the soil, m/s
    double head;                 ///< that is given, m; NaN in air, where water only leaves
  };

  /// Properties of the soil that the flow depends on.
  struct SeepageSoil
  {
    std::vector<SoilRegion> bodies;     ///< where they are
    std::vector<double> conductivities; ///< of each, m/s; 0: no flow
  };

  /// Finds the cells with soil of this rank, and its faces, by the centres of equal parts of the cells.
  template <int dim>
  class SeepageSurvey
  {
  public:
    /// @param ground only its open holds soil; null: all
    SeepageSurvey(const BackgroundGrid<dim> &grid,
                  const SeepageSoil &soil,
                  const WaterParameters &water,
                  const WaterBoundaryConditions<dim> &walls,
                  const double unit_weight,
                  const LevelSet<dim> *ground);

    /// Appends the cells of this rank and their faces. Throws ValueError if a reservoir is higher than the box, or an
    /// expression is no number.
    void find(std::vector<SeepageCell<dim>> &cells, std::vector<SeepageFace<dim>> &faces) const;

    /// Elevation of free water at a place, m; NaN without a reservoir.
    double level(const dealii::Point<dim> &x) const;

    /// Whether a body with flow is there.
    bool is_in_soil(const dealii::Point<dim> &x) const
    {
      return kind(x) >= 0;
    }

  private:
    using Cell               = SeepageCell<dim>;
    static constexpr int air = -1, closed = -2;
    static constexpr unsigned int n_wide = Cell::n_1d + 2, n_around = dealii::Utilities::pow(n_wide, dim);

    /// Number of the body at a place, or air, or closed: ground and soil without flow.
    int kind(const dealii::Point<dim> &x) const;

    /// The kinds at the centres of the parts of a cell and one part around it. False: no soil is in the cell.
    bool look_at(const dealii::Point<dim> &corner, std::array<int, n_around> &kinds) const;

    /// Appends the faces in air of a cell.
    void add_free_faces(const std::array<int, n_around> &kinds,
                        const dealii::Point<dim> &corner,
                        const unsigned int cell,
                        std::vector<SeepageFace<dim>> &faces) const;

    /// Appends the faces of a cell at walls of the box with a head, or drained.
    void add_faces_at_walls(const std::array<int, n_around> &kinds,
                            const dealii::Point<dim> &corner,
                            const unsigned int cell,
                            std::vector<SeepageFace<dim>> &faces) const;

    /// The head of a wall at a height of it; nothing if it is closed there.
    std::optional<double> head_of_wall(const unsigned int face, const double height) const;

    /// Whether a place is beyond this face of the box.
    bool is_beyond(const dealii::Point<dim> &x, const unsigned int face) const;

    const BackgroundGrid<dim> &grid;
    const WaterBoundaryConditions<dim> &walls;
    const LevelSet<dim> *ground;
    const double unit_weight; // of water, N/m^3
    const std::vector<double> heads;
    std::vector<Region<dim>> regions;
    std::vector<double> conductivities;
    std::unique_ptr<Expression<dim>> reservoir;
    const std::string reservoir_text;
  };

  /// How far the conductivity of seepage follows the pressure in an iteration: less and less while the changes of the
  /// head do not fall. Soil that water crosses without filling it needs that.
  class SeepageDamping
  {
  public:
    /// The share of the way after an iteration with the largest change of the head, m.
    double share(const double change)
    {
      constexpr double progress = 0.9, factor = 0.7, least = 0.005;
      constexpr unsigned int patience = 5; // iterations without progress
      n_without                       = change < progress * best ? 0 : n_without + 1;
      if (n_without == 0 || n_without == patience)
        best = change;
      if (n_without == patience)
        {
          current   = std::max(least, factor * current);
          n_without = 0;
        }
      return current;
    }

  private:
    double current         = 0.5;
    double best            = std::numeric_limits<double>::max(); // m
    unsigned int n_without = 0;
  };

  /// What steady seepage came to.
  struct SeepageReport
  {
    unsigned int n_iterations = 0;     ///< solves
    bool has_converged        = false; ///< whether the last one changed nothing
    double inflow             = 0;     ///< m^3/s (2D: m^2/s)
    double outflow_in_air     = 0;     ///< through faces in air, m^3/s
    double outflow_below      = 0;     ///< to where a head is given, m^3/s
    double exit_height        = 0;     ///< elevation of the highest face in air where water leaves, m; NaN: nowhere

    /// A line for the log.
    std::string text(const unsigned int dim) const;
  };

  /// The pressure head of steady seepage at the corners of the cells with soil, on every rank. As a level set its open
  /// is dry.
  template <int dim>
  class SeepageField : public LevelSet<dim>
  {
  public:
    /// @param box of the mesh
    /// @param first corner of the box's cells that has a value, by its numbers along the axes
    /// @param n values along each axis
    /// @param values of the pressure head, m; NaN where no soil is near
    SeepageField(const CellsOfBox<dim> &box,
                 const CellPlace<dim> &first,
                 const CellPlace<dim> &n,
                 std::vector<double> values,
                 const SeepageReport &report);

    /// Pressure head, m, and its gradient; NaN where no soil is near.
    std::pair<double, dealii::Tensor<1, dim>> pressure_head(const dealii::Point<dim> &x) const;

    /// See LevelSet::is_open(): whether the pressure is negative or unknown.
    bool is_open(const dealii::Point<dim> &x) const override;

    /// See LevelSet::view(): of the surface without pressure, to first order.
    SurfaceView<dim> view(const dealii::Point<dim> &x, const double reach) const override;

    const SeepageReport report; ///< how it was found

  private:
    const CellsOfBox<dim> box;
    const CellPlace<dim> first, n;
    const std::vector<double> values;
  };

  /// Steady flow of water through soil, div(k_r k grad phi) = 0 with the head phi, on the corners of the cells with
  /// soil. Above the free surface the conductivity falls to next to nothing (@source{bathe1979}); at faces in air water
  /// leaves where its pressure would be positive, and does not enter. Both are found by iterations.
  template <int dim>
  class SteadySeepage
  {
  public:
    /// Takes the soil from the survey. Collective; throws EntryError if no soil touches a given head.
    SteadySeepage(const BackgroundGrid<dim> &grid, const SeepageSurvey<dim> &survey);

    /// Iterates until nothing changes. Collective.
    /// @param gravity m/s^2; conductivities hold at 9.81
    std::shared_ptr<const SeepageField<dim>> solve(const double gravity);

  private:
    using Cell                               = SeepageCell<dim>;
    static constexpr unsigned int n_vertices = 1 << dim;
    using Shape                              = std::array<double, n_vertices>;
    using CellMatrix                         = std::array<Shape, n_vertices>;

    /// Value of the hat functions of a cell at a place in it, from 0 to 1 along each axis.
    static Shape hats(const dealii::Point<dim> &place);

    void integrate_parts();
    void number_rows();
    void make_pattern();

    /// Sets matrix and right-hand side of the conductivities and faces as they are.
    void assemble();

    /// Solves for the heads; returns the largest change, m. Collective.
    double solve_system();

    /// Follows the heads with the conductivities; `share` of the way.
    void update_conductivities(const double share);

    /// Follows the heads at the faces in air; returns whether any has changed. Collective.
    bool update_faces();

    /// Head at a face, m.
    double head_at(const SeepageFace<dim> &face) const;

    /// Flow through a face over the difference of heads, m^(dim-1)/s.
    double conductance(const unsigned int face) const;

    /// Head beyond a face, m: in air without pressure.
    static double head_beyond(const SeepageFace<dim> &face);

    /// What went through the faces.
    /// @param scale of the flow, for gravity
    SeepageReport report(const double scale) const;
    std::shared_ptr<const SeepageField<dim>> field(const SeepageReport &report) const;

    /// The row of a vertex.
    dealii::types::global_dof_index row(const unsigned int vertex) const
    {
      return static_cast<dealii::types::global_dof_index>(rows.local_element(vertex));
    }

    const BackgroundGrid<dim> &grid;
    NodeNumbering<dim> vertices;
    std::vector<Cell> cells;
    std::vector<SeepageFace<dim>> faces;
    std::vector<std::array<double, Cell::n_parts>> relative; // conductivity over that of full pores
    std::vector<char> is_leaving;                            // of the faces in air
    std::array<Shape, Cell::n_parts> shapes;                 // in the middle of a part
    std::array<CellMatrix, Cell::n_parts> laplacian;         // of a part

    VertexVector heads, rows; // at the vertices; number of the row, -1 where there is none
    VertexVector scales;      // of the rows
    double smallest_conductivity = std::numeric_limits<double>::max(); // at a face, m/s
    bool has_no_soil             = false;                              // of this rank: its one row stands for itself
    dealii::TrilinosWrappers::SparseMatrix matrix;
    VertexVector source, solution; // by row
  };
} // namespace scree

#endif

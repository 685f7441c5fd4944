// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_initial_steady_seepage_h
#define scree_initial_steady_seepage_h

#include <scree/initial/seepage_cells.h>
#include <scree/initial/seepage_field.h>
#include <scree/pressure/free_surface.h>

#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <limits>
#include <memory>
#include <vector>

namespace scree
{
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

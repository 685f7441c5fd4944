// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_pressure_free_surface_h
#define scree_pressure_free_surface_h

#include <scree/mesh/node_values.h>
#include <scree/boundary/boundary_conditions.h>
#include <scree/mixture/mixture.h>

#include <deal.II/lac/la_parallel_vector.h>

#include <algorithm>

namespace scree
{
  /// A number a vertex of the cells, distributed over ranks, with ghosts.
  using VertexVector = dealii::LinearAlgebra::distributed::Vector<double>;

  /// What the pressure is at a vertex of the cells.
  enum class PressureDofType : char
  {
    dry,        ///< 0
    unknown,    ///< a degree of freedom
    surface,    ///< extrapolated from unknown neighbours, so that it vanishes at the surface beside the vertex
    beyond,     ///< the same from those of kind surface that are inside the water
    prescribed, ///< by a drained wall
  };

  /// Where the water ends: kinds of the vertices, and the pressure at those beside the surface.
  ///
  /// The fill F of a vertex (volume of water and the grains about it, under the linear function) gives its signed
  /// distance d from a surface along the cells: F = (1 + d)^2/2 outside the water, 1 - (1 - d)^2/2 inside. Unknown are
  /// the vertices at least .15 of a cell inside: no depth that rows of a lattice of points give, which would make a
  /// vertex unknown in one step and not in the next. Those beside them hold p = d sum p_j / sum d_j of their unknown
  /// neighbours: p is linear and vanishes at the surface, wherever that is in the cell.
  template <int dim>
  class FreeSurface
  {
  public:
    /// @param vertices the numbering of linear functions on the grid
    /// @param cut_cells what rigid ground leaves of the cells; null: all
    /// @param air_entry pressure of the soil, Pa; 0: its water has no suction at the surface
    FreeSurface(const BackgroundGrid<dim> &grid,
                const NodeNumbering<dim> &vertices,
                const BoundaryConditions<dim> &walls,
                const CutCells<dim> *cut_cells,
                const double air_entry = 0.);

    /// Fits the surface to the grid's current vertices. Collective.
    void reinit();

    /// Fits it to ground that has moved, on the mesh as it was. Collective.
    void follow_ground()
    {
      find_open();
    }

    /// Finds how deep the vertices are in the soil of a mixture, by what of their surroundings it fills. Collective.
    void find_soil_depths(Mixture<dim> &mixture);

    /// Finds the surface, and fills `pressure` at the unknown vertices from the mixture's points (0 elsewhere but at
    /// drained walls). Collective.
    void locate(const Mixture<dim> &mixture, VertexVector &pressure);

    /// Sets a pressure at the vertices beside the surface from the unknown ones, whose ghosts hold values: p <- T p.
    /// Collective; ghosts hold values afterwards.
    void extend(VertexVector &pressure);

    /// Sets a pressure at all wet vertices from the numbers of unknowns(): T. Collective; ghosts hold values
    /// afterwards.
    void extend(const std::vector<double> &unknown, VertexVector &pressure);

    /// How restrict_to_unknown() weights a vertex beside the surface.
    enum class Shares
    {
      as_they_are, ///< the transpose of extend()
      squared      ///< for the diagonal of a matrix between extend() and its transpose
    };

    /// Sums this rank's parts of `sums` over ranks, and adds to the unknowns what the vertices beside the surface have:
    /// T^T, by owned unknown. Collective.
    void
    restrict_to_unknown(VertexVector &sums, std::vector<double> &result, const Shares shares = Shares::as_they_are);

    /// The owned vertices whose pressure is a degree of freedom.
    const std::vector<unsigned int> &unknowns() const
    {
      return unknown_vertices;
    }

    /// Sets `result` to a vector's values at these.
    void take(const VertexVector &values, std::vector<double> &result) const
    {
      result.clear();
      for (const unsigned int vertex : unknown_vertices)
        result.push_back(values.local_element(vertex));
    }

    /// Sets the wet vertices to 0, ghosts too.
    void clear(VertexVector &values) const;

    /// Signed distance of a vertex from the surface along the cells, cells; positive in the water.
    double depth(const unsigned int vertex) const
    {
      return distances[vertex];
    }

    /// What dry soil behind the surface adds to the pressure of extend(), Pa, for the discharge alone; with ghosts.
    /// Null: nothing.
    const VertexVector *suction_behind() const
    {
      return has_suction() ? &suction : nullptr;
    }

    /// Type of a vertex of this rank's cells, ghosts included, as locate() has found it.
    PressureDofType kind(const unsigned int vertex) const
    {
      return kinds[vertex];
    }

    /// Pressure at `surface_vertex` over that at an unknown vertex of the same cell, as the preconditioner sees it: at
    /// most 1, also where ground leaves a deep vertex no room, so that its matrix stays positive.
    double ratio(const unsigned int surface_vertex, const unsigned int unknown_vertex) const
    {
      return std::min(distances[surface_vertex] / distances[unknown_vertex], 1.);
    }

    /// Volume of water under the linear function of an owned vertex, m^3.
    double water_volume(const unsigned int vertex) const
    {
      return filling[vertex][Filling::water];
    }

    /// Whether no grains are under the linear function of an owned vertex.
    bool is_free_water(const unsigned int vertex) const
    {
      return filling[vertex][Filling::filled] <= filling[vertex][Filling::water] * (1. + 1e-12);
    }

    /// Fill of an owned vertex's linear function, 1 if it is full of water and wet grains.
    double fill(const unsigned int vertex) const
    {
      return filling[vertex][Filling::filled] / volume_under(vertex);
    }

    /// Integral of a vertex's linear function over what is open of the box, m^3.
    double volume_under(const unsigned int vertex) const
    {
      return open[vertex].volume;
    }

    /// The same over a cell of this rank that has the vertex as its `v`th.
    double volume_in_cell(const unsigned int cell, const unsigned int v) const;

    /// Whether a face of the box prescribes the pressure.
    bool is_drained(const unsigned int face) const
    {
      return walls.is_open(face);
    }

    /// Whether it prescribes one other than 0.
    bool presses(const unsigned int face) const
    {
      return walls.holds_pressure(face);
    }

    /// Whether any does, or there is suction.
    bool prescribes_values() const
    {
      return has_suction() || walls.has_pressure();
    }

    /// Whether a cell of this rank has an unknown vertex.
    bool has_unknown(const unsigned int cell) const
    {
      const unsigned int *nodes = vertices.nodes(cell);
      return std::any_of(nodes, nodes + (1 << dim), [this](const unsigned int vertex) {
        return kinds[vertex] == PressureDofType::unknown;
      });
    }

    /// The owned vertices of cells with water.
    const std::vector<unsigned int> &wet_vertices() const
    {
      return filling.active_nodes();
    }

  private:
    /// Sums over the points under a vertex's linear function; the number of wet cells around it, each as far as it is
    /// open.
    enum Filling : unsigned int
    {
      water,             // m^3
      filled,            // by water and the grains about it, m^3
      weighted_pressure, // Pa m^3
      wet_cells
    };

    /// Of the neighbours inside the water of a vertex beside the surface.
    enum Neighbours : unsigned int
    {
      number,
      sum_of_distances // cells
    };

    /// What rigid ground leaves of a vertex's surroundings.
    struct Open
    {
      double volume; // see volume_under()
      double cells;  // in the box around it, each as far as it is open
      bool has_room; // more than rounding: else no flow determines its pressure
    };

    /// Vertices beside the surface of one kind, and what they follow.
    struct Followers
    {
      PressureDofType followed;
      std::vector<unsigned int> vertices;                       // ghosts too, these more than once
      std::vector<std::pair<unsigned int, unsigned int>> pairs; // with their neighbours, cell by cell
    };

    /// Whether dry soil behind the surface pulls at the water.
    bool has_suction() const
    {
      return air_entry > 0.;
    }

    /// Finds what rigid ground leaves of the vertices' surroundings. Collective.
    void find_open();

    /// Kind of a wet vertex by its distance, beside what follows others, and its pressure, Pa.
    double classify(const unsigned int vertex);

    /// The dry vertices beside those of another kind (inside the water, if they are not unknown) get `kind`.
    /// Collective.
    Followers find_followers(const Mixture<dim> &mixture, const PressureDofType followed, const PressureDofType kind);

    void sum_filling(const Mixture<dim> &mixture);

    /// Finds suction_behind(). Collective.
    void find_suction();

    /// What a vertex beside the surface takes of the sum of its neighbours.
    double share(const unsigned int vertex) const
    {
      return distances[vertex] / neighbours[vertex][sum_of_distances];
    }

    const BackgroundGrid<dim> &grid;
    const NodeNumbering<dim> &vertices;
    const BoundaryConditions<dim> &walls;
    const CutCells<dim> *cut_cells; // may be null
    NodeValues<dim, 4> filling;     // Filling
    NodeValues<dim, 1> soil;        // grains and pores under a vertex's linear function, m^3
    NodeValues<dim, 2> neighbours;  // Neighbours
    const double air_entry;         // Pa
    std::vector<PressureDofType> kinds;
    std::vector<double> distances;              // cells; positive in the water
    std::vector<Open> open;                     // by vertex, ghosts too
    std::vector<unsigned int> unknown_vertices; // see unknowns()
    // Owned vertices that any rank's water may touch, and ghosts that this rank's water touches: these more than once.
    std::vector<unsigned int> touched;
    std::array<Followers, 2> followers;
    VertexVector scratch; // 0 between calls
    VertexVector suction; // see suction_behind()
  };
} // namespace scree

#endif

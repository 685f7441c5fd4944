// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_pressure_free_surface_h
#define scree_pressure_free_surface_h

#include <scree/boundary/water_walls.h>
#include <scree/mixture/menisci.h>
#include <scree/bodies/pressure_parameters.h>
#include <scree/mixture/closures.h>
#include <scree/mixture/mixture.h>

#include <deal.II/lac/la_parallel_vector.h>

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
    beyond,     ///< extrapolated from those of kind surface that are inside the water
    prescribed, ///< by a drained wall
  };

  /// Where the water ends: kinds of the vertices, and the pressure at those beside the surface.
  ///
  /// The fill F of a vertex (volume of water and wet grains under its linear function) gives its signed distance d from
  /// a surface along the cells: F = (1 + d)^2/2 outside the water, 1 - (1 - d)^2/2 inside. What gently inclined ground
  /// takes of the surroundings of free water counts as full, as it lies below its surface. Unknown are the vertices at
  /// least a quarter of a cell inside. Those beside them hold p = d sum p_j / sum d_j of their unknown neighbours: p
  /// is linear and vanishes at the surface, wherever that is in the cell. At the face of soil, vertices no less than
  /// half full between two unknown ones where p is not negative are unknown, too: what closes there, a gap between two
  /// bodies, has the pressure of both.
  template <int dim>
  class FreeSurface
  {
  public:
    /// @param vertices the numbering of linear functions on the grid
    /// @param gravity m/s^2
    /// @param cut_cells what rigid ground leaves of the cells; null: all
    /// @param air_entry pressure of the soil, Pa; 0: its water has no suction at the surface
    /// @param by_flux whether the fill is that of the water's points with the grains about them
    FreeSurface(const BackgroundGrid<dim> &grid,
                const NodeNumbering<dim> &vertices,
                const WaterBoundaryConditions<dim> &walls,
                const dealii::Tensor<1, dim> &gravity,
                const CutCells<dim> *cut_cells,
                const double air_entry = 0.,
                const bool by_flux     = false);

    /// Fits the surface to the grid's current vertices. Collective.
    void reinit();

    /// Fits it to ground that has moved, on the mesh as it was. Collective.
    void follow_ground()
    {
      find_closed();
    }

    /// Finds how deep the vertices are in the soil of a mixture, by what of their surroundings it fills. Collective.
    void find_soil_depths(Mixture<dim> &mixture);

    /// Finds the surface, and fills `pressure` at the unknown vertices from the mixture's points (0 elsewhere but at
    /// drained walls). Collective.
    void locate(const Mixture<dim> &mixture, VertexVector &pressure);

    /// Sets a pressure (or its change) at the vertices beside the surface. Collective; ghosts hold values afterwards.
    void extrapolate(const Mixture<dim> &mixture, VertexVector &pressure);

    /// Sets a pressure at the vertices beside the surface from the unknown ones, whose ghosts hold values: p <- T p.
    /// Collective; ghosts hold values afterwards.
    void extend(VertexVector &pressure);

    /// The transpose of extend(): adds to the unknown owned vertices what those beside the surface have. Collective.
    void restrict_to_unknown(VertexVector &sums);

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
      return by_flux && menisci.exist() ? &suction : nullptr;
    }

    /// Whether menisci in the pores make the pressure at the surface differ from 0, in extrapolate_with_menisci().
    bool has_menisci() const
    {
      return !by_flux && menisci.exist();
    }

    /// As extrapolate(), with the pressure of menisci at the surface.
    /// @param is_start whether `pressure` is that of the start of a step, or its change
    /// @param pull becomes what they add at each vertex: the grains bear a force of its gradient, the
    ///        reaction of the menisci. Its ghosts hold values afterwards
    void extrapolate_with_menisci(const Mixture<dim> &mixture,
                                  const bool is_start,
                                  VertexVector &pressure,
                                  VertexVector &pull);

    /// The least pressure that an unknown vertex can have, Pa.
    /// @param cavitation pressure, Pa
    double least_pressure(const unsigned int vertex, const double cavitation) const
    {
      return menisci.least_pressure(vertex, cavitation);
    }

    /// Type of a vertex of this rank's cells, ghosts included, as locate() has found it.
    PressureDofType kind(const unsigned int vertex) const
    {
      return kinds[vertex];
    }

    /// Pressure at `surface_vertex` over that at an unknown vertex of the same cell, as the matrix sees it.
    double ratio(const unsigned int surface_vertex, const unsigned int unknown_vertex) const
    {
      return distances[surface_vertex] / depth(unknown_vertex, surface_vertex);
    }

    /// Volume of water under the linear function of an owned vertex, m^3.
    double water_volume(const unsigned int vertex) const
    {
      return filling[vertex][Filling::water];
    }

    /// What the water's points forget of the pressure under the linear function of an owned vertex, 0 to 1.
    double forgotten(const unsigned int vertex) const
    {
      return filling[vertex][Filling::weighted_forgotten] / water_volume(vertex);
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
    double volume_under(const unsigned int vertex) const;

    /// The same over a cell of this rank that has the vertex as its `v`th.
    double volume_in_cell(const unsigned int cell, const unsigned int v) const;

    /// Whether a face of the box prescribes the pressure.
    bool is_drained(const unsigned int face) const
    {
      return walls.is_drained(face);
    }

    /// Whether it prescribes one other than 0.
    bool presses(const unsigned int face) const
    {
      return is_drained(face) && walls.pressure(1u << face) != 0.;
    }

    /// Whether the pressure keeps the water of a cell of this rank out of the ground.
    bool keeps_from_ground(const unsigned int cell) const
    {
      return by_flux && has_unknown(cell);
    }

    /// Whether a cell of this rank has an unknown vertex.
    bool has_unknown(const unsigned int cell) const
    {
      const unsigned int *nodes = vertices.nodes(cell);
      return std::any_of(nodes, nodes + (1 << dim), [this](const unsigned int vertex) {
        return kinds[vertex] == PressureDofType::unknown;
      });
    }

    /// Whether all vertices of a cell of this rank are unknown.
    bool is_within(const unsigned int cell) const
    {
      const unsigned int *nodes = vertices.nodes(cell);
      return std::all_of(nodes, nodes + (1 << dim), [this](const unsigned int vertex) {
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
      water,              // m^3
      filled,             // by water and wet grains, m^3
      weighted_pressure,  // Pa m^3
      weighted_forgotten, // m^3
      wet_cells,
      by_scatter // of `filled`: grains that are wet because the scatter of points explains what water lacks, m^3
    };

    /// Of the neighbours inside the water of a vertex beside the surface.
    enum Neighbours : unsigned int
    {
      number,
      sum_of_distances, // cells
      sum_of_pressures, // Pa
      sum_of_pulls      // Pa
    };

    /// Distance of a vertex from the surface that is beside its neighbour, cells. Fills near 1 tell it badly, and not
    /// at all beyond one cell: a vertex deeper than its neighbour in the water is taken to be a cell deeper.
    double depth(const unsigned int vertex, const unsigned int neighbour) const
    {
      const double own = distances[vertex], from_neighbour = 1. + distances[neighbour];
      if (by_flux || distances[neighbour] <= 0. || own < 0.5)
        return own;
      return own + std::min(4. * (own - 0.5), 1.) * std::max(from_neighbour - own, 0.);
    }

    /// Calls `act(vertex, neighbour)` for the vertices of a kind and those of another kind (inside the water, if they
    /// are not unknown) in the same cell, cell by cell.
    template <typename Function>
    void for_pairs(const Mixture<dim> &mixture,
                   const PressureDofType kind,
                   const PressureDofType kind_of_neighbour,
                   const Function &act) const;

    /// Integral of a vertex's linear function over the box, m^3.
    double whole_volume(const unsigned int vertex) const;

    /// Whether rigid ground leaves more than rounding of a vertex's surroundings: else no flow determines its pressure.
    bool has_room(const unsigned int vertex) const;

    /// Cells around a vertex.
    unsigned int cells_in_box(const unsigned int vertex) const;

    /// The same, each as far as it is open.
    double open_cells_around(const unsigned int vertex) const;

    /// Finds what rigid ground takes from the vertices' surroundings. Collective.
    void find_closed();

    /// The fill of a vertex's linear function with what ground below free water takes of it, from that of the open
    /// part.
    double fill_with_ground(const unsigned int vertex, const double fill) const;
    /// Whether all cells around a vertex hold water.
    bool is_among_wet_cells(const unsigned int vertex) const;
    void sum_filling(const Mixture<dim> &mixture);

    /// Whether grains take a part of what fills a vertex's linear function that is no scatter.
    bool is_in_soil(const unsigned int vertex) const
    {
      const double *sums = filling[vertex];
      return sums[filled] - sums[water] >= closures::least_solid_fraction * sums[filled] && sums[filled] > 0.;
    }

    /// Whether menisci keep water with a suction at a vertex beside the surface.
    bool keeps_water(const unsigned int vertex);

    /// The pressure of a vertex's points, Pa.
    double pressure_of_points(const unsigned int vertex) const
    {
      return filling[vertex][weighted_pressure] / filling[vertex][water];
    }

    /// Sums what the soil of a mixture fills under the vertices' linear functions. Collective.
    void sum_soil(const Mixture<dim> &mixture);
    void find_suction();

    /// Makes the vertices in gaps unknown. Collective.
    void close_gaps(const Mixture<dim> &mixture, VertexVector &pressure);

    /// Calls `act(vertex)` for the owned vertices that any rank's water may touch, and for the ghosts that this rank's
    /// water touches: for these more than once.
    template <typename Function>
    void for_all_wet_vertices(const Mixture<dim> &mixture, const Function &act) const
    {
      for (const unsigned int vertex : filling.active_nodes())
        act(vertex);
      for (const MixtureCell<dim> &cell : mixture.cells())
        if (cell.water_volume > 0)
          for (unsigned int v = 0; v < cell.n_vertices; ++v)
            if (const unsigned int vertex = vertices.nodes(cell.cell)[v]; vertex >= vertices.n_owned())
              act(vertex);
    }

    /// Vertices beside the surface of one kind, and what they follow.
    struct Followers
    {
      PressureDofType followed;
      std::vector<unsigned int> vertices;                       // ghosts too, these more than once
      std::vector<std::pair<unsigned int, unsigned int>> pairs; // with their neighbours, cell by cell
    };

    /// What a vertex beside the surface takes of the sum of its neighbours.
    double share(const unsigned int vertex) const
    {
      return distances[vertex] / neighbours[vertex][sum_of_distances];
    }

    const BackgroundGrid<dim> &grid;
    const NodeNumbering<dim> &vertices;
    const WaterBoundaryConditions<dim> &walls;
    const bool by_flux;
    const dealii::Tensor<1, dim> down; // unit, or 0
    const CutCells<dim> *cut_cells;    // may be null
    NodeValues<dim, 6> filling;        // Filling
    NodeValues<dim, 1> soil;           // grains and pores under a vertex's linear function, m^3
    NodeValues<dim, 4> neighbours;     // Neighbours
    const double air_entry;            // Pa
    Menisci<dim> menisci;
    NodeValues<dim, 2 * dim> sides; // number of neighbours that press, on each side along each axis
    std::vector<PressureDofType> kinds;
    std::vector<double> distances; // cells; positive in the water
    std::array<Followers, 2> followers;
    VertexVector scratch; // 0 between calls
    VertexVector suction; // see suction_behind()

    // Without ground they are empty.
    std::vector<double> closed_volume; // under a vertex's linear function, m^3
    std::vector<double> closed_cells;  // around a vertex, each as far as it is closed
    std::vector<double> full_ground;   // part of a vertex's linear function that lies in ground below level water
  };
} // namespace scree

#endif

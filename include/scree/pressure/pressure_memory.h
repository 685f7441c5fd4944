// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_pressure_pressure_memory_h
#define scree_pressure_pressure_memory_h

#include <scree/bodies/water_parameters.h>
#include <scree/pressure/free_surface.h>

#include <functional>

namespace scree
{
  /// What part of a step's pressure the next one starts from.
  ///
  /// Reusing p^n stores energy: a solve leaves a part of the divergence in partly full cells, p builds up over several
  /// steps, and returns what an impact has lost. Then p changes by a good part of itself in each step. So the next step
  /// starts from (1 - f) p, f = min(.8, (s r)^2), with r = sum m |p - p^n| / sum max(|p|, |p^n|) over the unknown
  /// vertices of the cells around a vertex. m^2 = min(1, 100 rho_w v^2/p) min(1, rho_w v h/mu) of a cell, with the
  /// largest p of its vertices and v the differences of the mixture's velocity between its nodes, says whether what
  /// moves could have made p: where soil bears a load or water seeps, and where viscosity makes the differences, p is
  /// kept however it changes. f varies smoothly, as a step of it between vertices is a force of its own.
  template <int dim>
  class PressureMemory
  {
  public:
    using AtVertices  = std::array<double, (1 << dim)>; ///< a number a vertex of a cell, in deal.II's order
    using SpeedOfCell = std::function<double(const unsigned int cell)>; ///< v^2 of a cell, m^2/s^2

    /// @param steepness s; 0: nothing is forgotten
    /// @param cell_size h, m
    PressureMemory(const NodeNumbering<dim> &vertices,
                   const double steepness,
                   const WaterParameters &water,
                   const double cell_size);

    /// Whether the next step starts from less than the whole pressure.
    bool is_on() const
    {
      return steepness > 0.;
    }

    /// Fits the memory to the grid's current vertices.
    void reinit();

    /// Takes what the points forget from a pressure at unknown vertices, Pa, which has no ghosts yet.
    void fade(const FreeSurface<dim> &surface, VertexVector &pressure);

    /// Finds what is to be forgotten of the `pressure` at the end of the step, Pa, whose ghosts hold values.
    /// Collective.
    /// @param difference v^2 of a cell, m^2/s^2
    void find_forgotten(const Mixture<dim> &mixture,
                        const FreeSurface<dim> &surface,
                        const VertexVector &pressure,
                        const SpeedOfCell &difference);

    /// f at vertices (local indices of a cell's).
    AtVertices forgotten_at(const unsigned int *vertices_of_cell) const;

  private:
    /// Sums over the cells around a vertex, Pa.
    enum Sums : unsigned int
    {
      changes,
      sizes
    };

    /// m of a cell, 0 to 1.
    /// @param difference v^2, m^2/s^2
    /// @param largest p, Pa
    double made_by_motion(const double difference, const double largest) const;

    const double steepness, water_density, viscosity, cell_size;
    VertexVector start;         // p^n before anything is forgotten
    NodeValues<dim, 2> changed; // Sums
    const NodeNumbering<dim> &vertices;
  };
} // namespace scree

#endif

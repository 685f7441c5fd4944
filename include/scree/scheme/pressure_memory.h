// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_scheme_pressure_memory_h
#define scree_scheme_pressure_memory_h

#include <scree/scheme/free_surface.h>

namespace scree
{
  /// What part of a step's pressure the next one starts from.
  ///
  /// p^n is a spring: a solve leaves a part of the divergence in partly full cells, p builds up over several steps, and
  /// gives back what an impact has lost. Then p changes by a good part of itself in each step. So does the next step
  /// start from (1 - f) p, f = min(.7, (s r)^2), with r = sum |p - p^n| / sum (max(|p|, |p^n|) + p_0) over the unknown
  /// corners of the cells around a corner, and p_0 = .002 rho_w (h/dt)^2, which moves water by .002 h in a step. A
  /// steady pressure is kept whole, and so is any as dt goes to 0; f varies smoothly, as a step of it between corners
  /// is a force of its own.
  template <int dim>
  class PressureMemory
  {
  public:
    using AtCorners = std::array<double, (1 << dim)>;

    /// @param steepness s; 0: nothing is forgotten
    PressureMemory(const NodeNumbering<dim> &corners, const double steepness);

    /// Fits the memory to the grid's current corners.
    void reinit();

    /// Takes what the points forget from a pressure at unknown corners, Pa, which has no ghosts yet.
    void fade(const FreeSurfaceLocator<dim> &surface, CornerVector &pressure);

    /// Finds what is to be forgotten of the `pressure` at the end of the step, Pa, whose ghosts hold values.
    /// Collective.
    /// @param least p_0, Pa
    void find_forgotten(const Mixture<dim> &mixture,
                        const FreeSurfaceLocator<dim> &surface,
                        const CornerVector &pressure,
                        const double least);

    /// f at corners (local indices of a cell's).
    AtCorners forgotten_at(const unsigned int *corners_of_cell) const;

  private:
    /// Sums over the cells around a corner, Pa.
    enum Sums : unsigned int
    {
      changes,
      sizes
    };

    const double steepness;
    CornerVector start;         // p^n before anything is forgotten
    NodeValues<dim, 2> changed; // Sums
    const NodeNumbering<dim> &corners;
  };
} // namespace scree

#endif

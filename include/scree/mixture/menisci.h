// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_mixture_menisci_h
#define scree_mixture_menisci_h


#include <vector>

namespace scree
{
  /// Menisci at the water's surface in soil, by the vertices beside it: they bear a suction up to the air entry
  /// pressure.
  ///
  /// Where dry soil lies behind the surface the suction is that pressure. Where the soil ends with its water, menisci
  /// hold the water in the pores and the suction is what the water beside them has, as long as it is less.
  template <int dim>
  class Menisci
  {
  public:
    /// @param air_entry pressure, Pa; 0: there are none
    explicit Menisci(const double air_entry)
        : air_entry(air_entry)
    {
    }

    /// Whether there are any.
    bool exist() const
    {
      return air_entry > 0.;
    }

    /// Fits them to the current vertices.
    void reinit(const unsigned int n_vertices)
    {
      if (!exist())
        return;
      behind.assign(n_vertices, 0.);
      held.assign(n_vertices, 0.);
      closed.assign(n_vertices, false);
    }

    /// Finds for a vertex of this rank's wet cells whether dry soil lies behind the surface beside it.
    /// @param distance of the surface, cells
    /// @param of_soil what soil fills of the vertex's surroundings
    void find_behind(const unsigned int vertex, const double distance, const double of_soil);

    /// Part of what lies behind the surface at a vertex that is dry soil.
    double dry_soil_behind(const unsigned int vertex) const
    {
      return behind[vertex];
    }

    /// Whether the soil ends with its water at a vertex.
    bool end_soil(const unsigned int vertex) const;

    /// Makes menisci keep the water at a vertex where it has a suction: its pressure is unknown.
    void close(const unsigned int vertex)
    {
      closed[vertex] = true;
    }

    /// The least pressure of a vertex, Pa, if it is larger than `other`.
    double least_pressure(const unsigned int vertex, const double other) const;

    /// The pressure at the surface beside a vertex at the start of a step, Pa.
    /// @param inside mean pressure at its neighbours in the water, Pa
    /// @param bears whether the surface is that of soil
    double start_pressure(const unsigned int vertex, const double inside, const bool bears);

    /// How it changes with that mean.
    double change(const unsigned int vertex, const double inside) const
    {
      return held[vertex] * inside;
    }

  private:
    const double air_entry;     // Pa
    std::vector<double> behind, // part of what lies behind the surface that is dry soil
        held;                   // part of the surface beside a vertex whose pressure follows that inside
    std::vector<char> closed;
  };
} // namespace scree

#endif

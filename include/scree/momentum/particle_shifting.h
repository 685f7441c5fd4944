// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_momentum_particle_shifting_h
#define scree_momentum_particle_shifting_h

#include <scree/bodies/phases.h>
#include <scree/boundary/constraints.h>
#include <scree/pressure/pore_pressure.h>

#include <optional>

namespace scree
{
  /// Moves points of free water from where they crowd to where they are few: positions only, by a tenth of a cell at
  /// most. Inside the water surplus and lack count; beside its surface the surplus alone, since there a vertex that is
  /// not full is no lack of water. Water at rest stays.
  template <int dim>
  class ParticleShifting
  {
  public:
    /// @param rate at which the surplus of a vertex decays, 1/s; 0: points are not moved
    ParticleShifting(const BackgroundGrid<dim> &grid,
                     const Constraints<dim> &constraints,
                     const FreeSurface<dim> &surface,
                     PorePressure<dim> &pressure,
                     const dealii::Tensor<1, dim> &gravity,
                     const double rate);

    /// Fits what lives on nodes and vertices to the grid's current partition. Collective.
    void reinit();

    /// Moves points of water's own, after the step's solve and before they are sorted. Collective.
    void apply(WaterPhase<dim> &water,
               const Mixture<dim> &mixture,
               const WetNodes<dim> &nodes,
               const double time_step,
               Budget<dim> &balance);

  private:
    /// Finds the vertices all of whose cells have unknown pressures only: their volume under psi of such cells.
    void find_inside(const Mixture<dim> &mixture);

    /// A flow that takes its part of the surplus out of each vertex, S chi = (1 - exp(-rate dt)) (F - 1) integral psi /
    /// dt with the matrix S of the last solve. Returns whether there is any surplus. Collective.
    bool find_potential(const Mixture<dim> &mixture, const double time_step, Budget<dim> &balance);

    /// The way of the nodes, m, that this flow makes of water.
    void find_shifts(const Mixture<dim> &mixture, const WetNodes<dim> &nodes, const double time_step);

    /// Moves the points with the nodes.
    void move(WaterPhase<dim> &water, Budget<dim> &balance) const;

    const BackgroundGrid<dim> &grid;
    const Constraints<dim> &constraints;
    const FreeSurface<dim> &surface;
    PorePressure<dim> &pressure;
    const dealii::Tensor<1, dim> gravity;
    const double rate; // 1/s
    VertexVector volume_inside;
    std::vector<double> source;                 // by owned unknown, m^3/s
    std::optional<NodeValues<dim, dim>> shifts; // of water, m
  };
} // namespace scree

#endif

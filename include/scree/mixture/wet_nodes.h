// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_mixture_wet_nodes_h
#define scree_mixture_wet_nodes_h

#include <scree/mesh/node_values.h>
#include <scree/tensor/vector.h>

namespace scree
{
  /// A vector of the soil and one of the water at a node.
  template <int dim>
  struct SoilAndWater
  {
    dealii::Tensor<1, dim> soil, ///< vector of the soil
        water;                   ///< vector of the water

    /// Adds others.
    SoilAndWater &operator+=(const SoilAndWater &other)
    {
      soil += other.soil;
      water += other.water;
      return *this;
    }

    /// Scales both.
    SoilAndWater &operator*=(const double factor)
    {
      soil *= factor;
      water *= factor;
      return *this;
    }

    /// Sum, phase by phase.
    friend SoilAndWater operator+(SoilAndWater a, const SoilAndWater &b)
    {
      return a += b;
    }

    /// Difference, phase by phase.
    friend SoilAndWater operator-(const SoilAndWater &a, const SoilAndWater &b)
    {
      return { a.soil - b.soil, a.water - b.water };
    }

    /// Both times a factor.
    friend SoilAndWater operator*(const double factor, SoilAndWater vectors)
    {
      return vectors *= factor;
    }

    /// Sum of the scalar products of both phases: of impulses and velocities their work.
    friend double operator*(const SoilAndWater &a, const SoilAndWater &b)
    {
      return a.soil * b.soil + a.water * b.water;
    }
  };

  /// Flow at the nodes, and what the pressure does to it: the mixture's velocity u = v_s + q, m/s, and the discharge q,
  /// m/s; or a force on u and one on q beside it, N.
  template <int dim>
  using FlowField = NodeValues<dim, 2 * dim>;

  /// What a force on u and one on q beside it, in a node's numbers of a FlowField, give soil and water, N.
  /// @param porosity n_i: with 1 soil feels no pressure
  /// @param has_soil whether q holds forces of ground alone where n_i is 1: they act on the soil
  template <int dim>
  SoilAndWater<dim> forces_of_flow(const double *of_flow, const double porosity, const bool has_soil)
  {
    SoilAndWater<dim> result;
    for (unsigned int c = 0; c < dim; ++c)
      {
        result.water[c] = porosity * (of_flow[c] + of_flow[dim + c]);
        result.soil[c]  = porosity < 1. ? of_flow[c] - result.water[c] : has_soil ? -of_flow[dim + c] : 0.;
      }
    return result;
  }

  /// Writes the flow of velocities of soil and water, m/s, to such numbers.
  template <int dim>
  void write_flow(const SoilAndWater<dim> &velocity, const double porosity, const bool has_soil, double *of_flow)
  {
    for (unsigned int c = 0; c < dim; ++c)
      {
        const double soil = porosity < 1. || has_soil ? velocity.soil[c] : 0.;
        of_flow[dim + c]  = porosity * (velocity.water[c] - soil);
        of_flow[c]        = soil + of_flow[dim + c];
      }
  }

  /// Numbers of the pores at a node: sums of the water's points at first, then what the step makes of them.
  struct Pores
  {
    /// n_p is the porosity about a point of water, n_i its harmonic mean at a node.
    enum : unsigned int
    {
      drag,                                ///< of slow flow over q, N s/m; then C + e of the step, kg
      inertial_drag,                       ///< the same over q^2, N s^2/m^2; then over the slip, kg s/m
      local_solid_volume,                  ///< sum V_w (1/n_p - 1) phi_i, m^3
      grain_fraction = local_solid_volume, ///< then: 1 - n_i, -
      flux_inertia,                        ///< sum V_w (1/n_p^2 - 1) phi_i, m^3
      /// Then e: inertia of the slip between soil and water beside the mass of water, as it passes through pores of
      /// different width, sum m_p phi_i (n_i/n_p)^2 - m_w, kg
      coupling = flux_inertia,
      pressed_soil,    ///< what the soil counts as where the pressure moves it, over its mass: 1 or more, -
      pressed_water,   ///< the same of the water
      excess_momentum, ///< sum m (1/n_p - 1) v phi_i, kg m/s: what the discharge has in pores; a number an axis
    };
  };

  /// Soil, water and pores at the nodes of the velocity, of one step: sums of the points' masses, momenta and forces at
  /// first; then velocities and their change over the step.
  template <int dim>
  class WetNodes
  {
  public:
    /// Keeps references to both.
    WetNodes(const BackgroundGrid<dim> &grid, NodalField<dim> &soil)
        : soil(soil)
        , water(grid)
        , pores(grid.numbering())
    {
    }

    /// Fits water and pores to the grid's current nodes.
    void reinit()
    {
      water.reinit();
      pores.reinit();
    }

    /// Empties water and pores, before a new step.
    void clear()
    {
      water.clear();
      pores.clear();
    }

    /// Marks the nodes of a cell as active.
    void activate_cell(const unsigned int cell)
    {
      soil.activate_cell(cell);
      water.activate_cell(cell);
      pores.activate_cell(cell);
    }

    /// Sums over ranks; masses and momenta times a factor then. Collective.
    void add_contributions(const double mass_scaling)
    {
      soil.add_contributions();
      water.add_contributions();
      pores.add_contributions();
      soil.scale_inertia(mass_scaling);
      water.scale_inertia(mass_scaling);
      for (const unsigned int node : active())
        for (unsigned int c = 0; mass_scaling != 1. && c < dim; ++c)
          pores[node][Pores::excess_momentum + c] *= mass_scaling;
    }

    /// Ghosts get the velocities that their owners have. Collective.
    void update_velocity_ghosts()
    {
      soil.update_ghosts();
      water.update_ghosts();
    }

    /// The owned nodes on which any rank's points act.
    const std::vector<unsigned int> &active() const
    {
      return pores.active_nodes();
    }

    /// Whether neither soil nor water is at a node: another rank may see one on which no point acts.
    bool is_empty(const unsigned int node) const
    {
      return !has_soil(node) && !has_water(node);
    }

    /// Whether soil is at a node.
    bool has_soil(const unsigned int node) const
    {
      return soil[node][Field::mass] > 0.;
    }

    /// Whether water is at a node.
    bool has_water(const unsigned int node) const
    {
      return water[node][Field::mass] > 0.;
    }

    /// Calls `act(node)` for the active nodes that are not empty.
    template <typename Function>
    void for_occupied(const Function &act) const
    {
      for (const unsigned int node : active())
        if (!is_empty(node))
          act(node);
    }

    /// n_i: of soil alone 0; of water alone, or that sees no grains, 1.
    double porosity(const unsigned int node) const
    {
      return 1. - pores[node][Pores::grain_fraction];
    }

    /// Velocities at the end of the step, m/s, once it is solved.
    SoilAndWater<dim> velocities(const unsigned int node) const
    {
      return vectors(node, Field::velocity);
    }

    /// The same at its start.
    SoilAndWater<dim> velocities_before(const unsigned int node) const
    {
      return velocities(node) - vectors(node, Field::velocity_change);
    }

    /// A vector of each phase, from a component on.
    SoilAndWater<dim> vectors(const unsigned int node, const unsigned int first) const
    {
      return { vector_of<dim>(soil[node] + first), vector_of<dim>(water[node] + first) };
    }

    /// Writes velocities at the start and at the end of the step, m/s.
    void set_velocities(const unsigned int node, const SoilAndWater<dim> &before, const SoilAndWater<dim> &after)
    {
      for (unsigned int c = 0; c < dim; ++c)
        {
          soil[node][Field::velocity + c]         = after.soil[c];
          water[node][Field::velocity + c]        = after.water[c];
          soil[node][Field::velocity_change + c]  = after.soil[c] - before.soil[c];
          water[node][Field::velocity_change + c] = after.water[c] - before.water[c];
        }
    }

    /// Changes velocities and their change, m/s.
    void add_to_velocities(const unsigned int node, const SoilAndWater<dim> &change)
    {
      for (const unsigned int first : { Field::velocity, Field::velocity_change })
        add(node, first, change);
    }

    /// Adds to a vector of each phase, from a component on.
    void add(const unsigned int node, const unsigned int first, const SoilAndWater<dim> &vectors)
    {
      for (unsigned int c = 0; c < dim; ++c)
        {
          soil[node][first + c] += vectors.soil[c];
          water[node][first + c] += vectors.water[c];
        }
    }

    NodalField<dim> &soil;                               ///< mass, momentum and force; then velocity
    NodalField<dim> water;                               ///< the same of the water
    NodeValues<dim, Pores::excess_momentum + dim> pores; ///< Pores

  private:
    using Field = NodalField<dim>;
  };
} // namespace scree

#endif

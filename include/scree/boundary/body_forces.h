// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_boundary_body_forces_h
#define scree_boundary_body_forces_h

#include <scree/mesh/background_grid.h>

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/point.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

namespace scree
{
  /// An acceleration of soil and water beside gravity.
  template <int dim>
  class BodyForce
  {
  public:
    virtual ~BodyForce() = default;

    /// The step, s, whose acceleration is asked for next.
    virtual void set_step(const double time, const double time_step) = 0;

    /// As set_step() before the release.
    virtual void set_start() = 0;

    /// Whether it is the same everywhere.
    virtual bool is_uniform() const = 0;

    /// Acceleration at a place in the step, m/s^2.
    virtual dealii::Tensor<1, dim> at(const dealii::Point<dim> &x) const = 0;

    /// What the log says of it; empty: nothing.
    virtual std::string text() const
    {
      return "";
    }
  };

  /// The entries of a kind of body force. Each kind registers its own by RegisterBodyForce.
  class BodyForceEntries
  {
  public:
    virtual ~BodyForceEntries() = default;

    /// Declares the entries at the top of the case, or in a subsection there.
    virtual void add_parameters(dealii::ParameterHandler &prm) = 0;

    /// Whether the case has such a force.
    virtual bool is_set() const = 0;

    /// The force of a plane scene; throws EntryError if its entries or files are wrong.
    virtual std::unique_ptr<BodyForce<2>> make_2d() const = 0;

    /// The force of a scene in space; throws EntryError if its entries or files are wrong.
    virtual std::unique_ptr<BodyForce<3>> make_3d() const = 0;
  };

  /// A kind of body force that one text gives; empty: the case has none.
  /// @tparam Force made of the text
  template <template <int> class Force>
  class BodyForceText : public BodyForceEntries
  {
  public:
    bool is_set() const override
    {
      return !text.empty();
    }
    std::unique_ptr<BodyForce<2>> make_2d() const override
    {
      return std::make_unique<Force<2>>(text);
    }
    std::unique_ptr<BodyForce<3>> make_3d() const override
    {
      return std::make_unique<Force<3>>(text);
    }

  protected:
    std::string text; ///< value of the entry
  };

  /// The entries of all kinds.
  class BodyForceParameters
  {
  public:
    /// With the default values of all kinds.
    BodyForceParameters();

    /// Declares the entries of all kinds.
    void add_parameters(dealii::ParameterHandler &prm)
    {
      for (const auto &kind : kinds)
        kind->add_parameters(prm);
    }

    /// Throws EntryError if entries of a kind are impossible: makes the forces to see.
    void check(const unsigned int dim) const
    {
      if (dim == 2)
        make<2>();
      else
        make<3>();
    }

    /// Whether the case has a force of any kind.
    bool is_set() const
    {
      return std::any_of(kinds.begin(), kinds.end(), [](const auto &kind) { return kind->is_set(); });
    }

    /// Those that are set.
    template <int dim>
    std::vector<std::unique_ptr<BodyForce<dim>>> make() const
    {
      std::vector<std::unique_ptr<BodyForce<dim>>> forces;
      for (const auto &kind : kinds)
        if (kind->is_set())
          {
            if constexpr (dim == 2)
              forces.push_back(kind->make_2d());
            else
              forces.push_back(kind->make_3d());
          }
      return forces;
    }

  private:
    std::vector<std::unique_ptr<BodyForceEntries>> kinds;
  };

  /// @param make the entries of the kind, with default values
  void register_body_force(const std::string &name, std::unique_ptr<BodyForceEntries> (*make)());

  /// Adds a kind of body force by its class of entries; its source file has one as a static constant.
  template <typename Entries>
  class RegisterBodyForce
  {
  public:
    /// @param name of the kind; kinds are in the order of their names
    explicit RegisterBodyForce(const std::string &name)
    {
      register_body_force(name, [] { return std::unique_ptr<BodyForceEntries>(std::make_unique<Entries>()); });
    }
  };

  /// What acts on all nodes besides stress, pressure and walls: gravity, all kinds of body force, and the
  /// damping of the trials of a factor search.
  template <int dim>
  class BodyForces
  {
  public:
    /// Makes the forces that are set; throws EntryError if that fails.
    /// @param gravity m/s^2, one number an axis
    /// @param mass_scaling mass that resists acceleration over mass that has weight
    BodyForces(const BackgroundGrid<dim> &grid,
               const std::vector<double> &gravity,
               const BodyForceParameters &parameters,
               const double mass_scaling = 1.)
        : grid(grid)
        , own_gravity(dealii::make_array_view(gravity))
        , forces(parameters.make<dim>())
        , scaling(mass_scaling)
        , uniform(fall())
    {
      for (const auto &force : forces)
        if (!force->is_uniform())
          varying.push_back(force.get());
    }

    /// Gravity without other forces, m/s^2.
    const dealii::Tensor<1, dim> &gravity() const
    {
      return own_gravity;
    }

    /// Mass that resists acceleration over mass that has weight: that of the nodes over that of the points.
    double mass_scaling() const
    {
      return scaling;
    }

    /// Acceleration of what falls, m/s^2.
    dealii::Tensor<1, dim> fall() const
    {
      return own_gravity / scaling;
    }

    /// Acceleration of the uniform ones besides gravity, m/s^2.
    dealii::Tensor<1, dim> shaking() const
    {
      return uniform - fall();
    }

    /// Whether nothing acts besides gravity.
    bool is_gravity_alone() const
    {
      return forces.empty();
    }

    /// The step, s, whose accelerations are asked for next.
    void set_step(const double time, const double time_step)
    {
      for (const auto &force : forces)
        force->set_step(time, time_step);
      sum_uniform();
    }

    /// As set_step() before the release.
    void set_start()
    {
      for (const auto &force : forces)
        force->set_start();
      sum_uniform();
    }

    /// What the log says of them, in lines; empty: nothing.
    std::string text() const
    {
      std::string lines;
      for (const auto &force : forces)
        if (const std::string line = force->text(); !line.empty())
          lines += (lines.empty() ? "" : "\n") + line;
      return lines;
    }

    /// Acceleration of a node, m/s^2.
    dealii::Tensor<1, dim> acceleration(const unsigned int node) const
    {
      dealii::Tensor<1, dim> sum = uniform;
      for (const BodyForce<dim> *force : varying)
        sum += force->at(grid.node_position(node)) / scaling;
      return sum;
    }

    /// Velocity decays at `rate`, 1/s; 0: it does not.
    void set_damping(const double rate)
    {
      damping_rate = rate;
    }

    /// Whether there is damping.
    bool is_damped() const
    {
      return damping_rate > 0.;
    }

    /// What damping leaves of a velocity after a step.
    double decay(const double time_step) const
    {
      return std::exp(-damping_rate * time_step);
    }

  private:
    void sum_uniform()
    {
      uniform = fall();
      for (const auto &force : forces)
        if (force->is_uniform())
          uniform += force->at(dealii::Point<dim>()) / scaling;
    }

    const BackgroundGrid<dim> &grid;
    const dealii::Tensor<1, dim> own_gravity;
    const std::vector<std::unique_ptr<BodyForce<dim>>> forces;
    const double scaling;                        // of masses
    std::vector<const BodyForce<dim> *> varying; // those that are not uniform
    dealii::Tensor<1, dim> uniform;              // gravity, and the other ones, over the scaling
    double damping_rate = 0;
  };
} // namespace scree

#endif

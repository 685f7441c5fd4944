// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_boundary_body_force_h
#define scree_boundary_body_force_h

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/point.h>

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

    /// Throws EntryError if entries are impossible; the force that is set is made to see.
    virtual void check(const unsigned int dim) const;

    /// The force of a plane scene; throws EntryError if its entries or files are wrong.
    virtual std::unique_ptr<BodyForce<2>> make_2d() const = 0;

    /// The force of a scene in space; throws EntryError if its entries or files are wrong.
    virtual std::unique_ptr<BodyForce<3>> make_3d() const = 0;
  };

  /// The entries of all kinds.
  class BodyForceParameters
  {
  public:
    /// With the default values of all kinds.
    BodyForceParameters();

    /// Declares the entries of all kinds.
    void add_parameters(dealii::ParameterHandler &prm);

    /// Throws EntryError if entries of a kind are impossible.
    void check(const unsigned int dim) const;

    /// Whether the case has a force of any kind.
    bool is_set() const;

    /// Those that are set.
    template <int dim>
    std::vector<std::unique_ptr<BodyForce<dim>>> make() const;

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
} // namespace scree

#endif

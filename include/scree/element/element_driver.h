// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef scree_element_element_driver_h
#define scree_element_element_driver_h

#include <scree/element/element_parameters.h>

namespace scree
{
  /// One material point along a prescribed path, as in a laboratory test. Axis y is vertical.
  ///
  /// Each step prescribes the increment of one stretch or of the shear; where a stress is held, the stretch that holds
  /// it is found by the secant method. Stresses are Cauchy stresses, strains logarithmic.
  class ElementDriver
  {
  public:
    /// The point after a step.
    struct State
    {
      double strain       = 0; ///< Prescribed: vertical logarithmic strain, compression positive, or shear strain
      double volume_ratio = 1; ///< J
      std::array<double, 6> left_cauchy_green; ///< elastic b_e, six components
      std::array<double, 6> stress;            ///< Cauchy stress, six components, Pa, tension positive
      std::vector<double> internal_variables;  ///< in the order of Material::internal_quantities()

      double mean_effective_stress() const; ///< p', Pa
      double deviatoric_stress() const;     ///< q, Pa
      double stress_ratio() const;          ///< q/p'; 0 without pressure
      double mobilised_ratio() const;       ///< Shear over vertical stress; 0 without stress
    };

    /// Makes the material; run() does the rest.
    explicit ElementDriver(const ElementParameters &parameters)
        : parameters(parameters)
        , path(parameters.path())
        , strain_step(parameters.final_strain / parameters.n_steps)
        , material(make_material<3>(parameters.material))
    {
    }

    /// Go along the path. Throws dealii::ExcMessage if the material cannot follow.
    void run();

    /// States from the start on.
    const std::vector<State> &history() const
    {
      return states;
    }

    /// What the updates of the accepted steps reported.
    const UpdateReport &report() const
    {
      return accepted;
    }

    /// All states, a row each; the first row names the columns and their units.
    void write_table(std::ostream &out) const;

    /// Peak and final values of order one, a line each.
    void print_summary(std::ostream &out) const;

  private:
    State start() const;

    /// `state` after the increment with the free stretch `stretch`.
    State advance(const State &state, const double stretch, UpdateReport &report) const;

    /// Relative distance of the held stress from its value.
    double held_stress_error(const State &state) const;

    /// The stretch that holds the stress over the next step, from that of the step before.
    double find_stretch(const State &state, const double guess) const;

    const ElementParameters parameters;
    const ElementParameters::Path path;
    const double strain_step;
    std::unique_ptr<const Material<3>> material;
    std::vector<State> states;
    UpdateReport accepted;
  };
} // namespace scree

#endif

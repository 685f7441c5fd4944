// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_bodies_pressure_parameters_h
#define scree_bodies_pressure_parameters_h

#include <deal.II/base/parameter_handler.h>

#include <string>

namespace scree
{
  /// Subsection Pressure of subsection Water.
  struct PressureParameters
  {
    double relative_tolerance       = 1e-4;         ///< of the residual, over the right-hand side
    unsigned int maximum_iterations = 500;          ///< the run ends with an error beyond them
    std::string step                = "fractional"; ///< fractional | variational
    std::string previous_pressure   = "affine";     ///< affine | average
    double fading                   = 0;            ///< steepness s of PressureMemory
    double projection               = 0;            ///< tau of the pressure projection, in units of 1/(2 G)
    double cavitation_pressure      = -1e5;         ///< Pa

    /// Declares the entries in the subsection that is open.
    void add_parameters(dealii::ParameterHandler &prm);

    /// Throws EntryError at impossible combinations.
    /// @param bulk_modulus of the water, Pa; 0: incompressible
    void check(const unsigned int n_bodies, const double bulk_modulus) const;

    /// Whether the pressure's force is the transpose of its divergence (SchurOperator), or both are approximate.
    bool is_variational() const
    {
      return step == "variational";
    }

    /// Whether the pressure of the points counts with its gradient (affine), or as it is (average).
    bool uses_pressure_gradient() const
    {
      return previous_pressure == "affine";
    }
  };
} // namespace scree

#endif

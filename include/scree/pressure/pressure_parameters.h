// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_pressure_pressure_parameters_h
#define scree_pressure_pressure_parameters_h

#include <deal.II/base/parameter_handler.h>

#include <string>

namespace scree
{
  /// What the correction of the velocities knows of the drag.
  enum class Splitting
  {
    drag_in_correction, ///< pressure and drag are solved together
    classical           ///< the drag acts in the predictor only
  };

  /// Where the water ends inside the cells.
  enum class FreeSurface
  {
    distance,   ///< at a distance from the nodes, from their fill
    empty_cell, ///< p = 0 at nodes next to a cell without water
    half_full   ///< p = 0 at nodes less than half full
  };

  /// The form of the mixture's divergence.
  enum class Divergence
  {
    expanded, ///< psi div u, u = (1-n) v_s + n v_w of the nodes: Galilean-invariant
    flux      ///< -grad psi . u
  };

  /// Where a step's pressure at its start comes from.
  enum class PreviousPressure
  {
    affine,  ///< from the water points, with their pressure gradient
    average, ///< from the water points
    grid,    ///< from the grid's last step
    dropped  ///< 0
  };

  /// Subsection Pressure of subsection Water.
  struct PressureParameters
  {
    double relative_tolerance       = 1e-4;
    unsigned int maximum_iterations = 500;
    std::string splitting           = "drag in correction";
    std::string free_surface        = "distance";
    std::string divergence          = "expanded";
    std::string previous_pressure   = "affine";
    double fading                   = 0;    ///< steepness s of PressureMemory
    double projection               = 0;    ///< tau of the pressure projection, in units of 1/(2 G)
    double cavitation_pressure      = -1e5; ///< Pa

    /// Declares the entries in the subsection that is open.
    void add_parameters(dealii::ParameterHandler &prm);

    /// Throws EntryError at impossible combinations.
    /// @param bulk_modulus of the water, Pa; 0: incompressible
    void check(const unsigned int n_bodies, const double bulk_modulus) const;

    Splitting splitting_kind() const;
    FreeSurface free_surface_kind() const;
    Divergence divergence_kind() const;
    PreviousPressure previous_pressure_kind() const;
  };
} // namespace scree

#endif

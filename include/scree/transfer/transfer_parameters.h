// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_transfer_transfer_parameters_h
#define scree_transfer_transfer_parameters_h

#include <deal.II/base/parameter_handler.h>

#include <cmath>
#include <string>
#include <type_traits>

namespace scree
{
  /// How velocity travels between points and nodes.
  enum class TransferMethod
  {
    flip, ///< points keep their velocity and take the nodes' change; it relaxes to the nodes' at a rate in 1/s
    tpic, ///< points take the nodes' velocity and its gradient (Taylor expansion)
    aflip ///< as FLIP, and the nodes get the points' velocity gradient, too, as in TPIC (@source{fei2021})
  };

  /// Whether points keep a velocity of their own, which relaxes at a rate.
  constexpr bool keeps_velocity(const TransferMethod method)
  {
    return method == TransferMethod::flip || method == TransferMethod::aflip;
  }

  /// Whether points carry the nodes' velocity gradient, an affine velocity field.
  constexpr bool carries_affine(const TransferMethod method)
  {
    return method == TransferMethod::tpic || method == TransferMethod::aflip;
  }

  /// Calls `act` with the method as a constant.
  template <typename Act>
  auto with_method(const TransferMethod method, const Act &act)
  {
    switch (method)
      {
      case TransferMethod::flip:
        return act(std::integral_constant<TransferMethod, TransferMethod::flip>());
      case TransferMethod::aflip:
        return act(std::integral_constant<TransferMethod, TransferMethod::aflip>());
      default:
        return act(std::integral_constant<TransferMethod, TransferMethod::tpic>());
      }
  }

  /// Treatment of volumetric locking and stress oscillation.
  enum class FBar
  {
    none,
    standard, ///< the cell's mean volume change drives the material (@source{coombs2018})
    modified, ///< and stored elastic volume strain and volume follow the cell's mean (after @source{xie2024})
    projected ///< volume change by linear functions of the vertices, see VolumeProjection
  };

  /// Subsection Transfer.
  struct TransferParameters
  {
    std::string method = "AFLIP"; ///< FLIP | TPIC | AFLIP
    std::string rate   = "auto";  ///< entry "PIC rate": a number in 1/s, or auto
    double pic_rate    = 1;       ///< 1/s, what choose_rate() has made of the entry

    /// Declares the subsection and its entries.
    void add_parameters(dealii::ParameterHandler &prm);

    /// Throws EntryError at a rate that is none, or that the method does not read.
    void check() const;

    /// Sets the PIC rate. `auto` is 1 1/s with FLIP; with AFLIP 5 sqrt(g/h), without gravity c/h.
    ///
    /// @param gravity g, m/s^2
    /// @param wave_speed c of the stiffest soil, m/s
    /// @param cell_size h, m
    void choose_rate(const double gravity, const double wave_speed, const double cell_size);

    /// The method, and its rate if it has one, as in the log.
    std::string text() const;

    /// Entry `Method` as an enum.
    TransferMethod transfer_method() const;

    /// Whether points carry an affine velocity field, see carries_affine().
    bool carries_affine_field() const;

    /// Whether a point's affine velocity field has an energy, see square_of_affine(): with AFLIP; TPIC sets it anew in
    /// each step.
    bool has_affine_energy() const
    {
      return transfer_method() == TransferMethod::aflip;
    }

    /// Courant number at which elastic soil is stable, with spline and linear bases, wherever its points are, and
    /// fronts do not depend on the time step (doc/theory/single_phase.md, doc/verification/convergence.md).
    double courant_number(const bool has_water) const
    {
      return transfer_method() == TransferMethod::aflip && !has_water ? 0.8 : 0.6;
    }
  };

  /// Subsection Stabilisation.
  struct StabilisationParameters
  {
    std::string f_bar       = "projected"; ///< projected | none | standard | modified
    double skeleton_damping = 0.5;         ///< damping time over cell size per wave speed, see SkeletonDamping

    /// Declares the subsection and its entries.
    void add_parameters(dealii::ParameterHandler &prm);

    /// Entry `F-bar` as an enum.
    FBar f_bar_kind() const;

    /// Largest Courant number at which the damping, explicit as the stress, is stable: dt^2 + 2 x dt = 1 in units of
    /// cell size per wave speed.
    double courant_number() const
    {
      return std::sqrt(1. + skeleton_damping * skeleton_damping) - skeleton_damping;
    }
  };
} // namespace scree

#endif

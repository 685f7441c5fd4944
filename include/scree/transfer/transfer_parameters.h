// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_transfer_transfer_parameters_h
#define scree_transfer_transfer_parameters_h

#include <deal.II/base/parameter_handler.h>

#include <string>

namespace scree
{
  /// How velocity travels between points and nodes.
  enum class TransferMethod
  {
    flip, ///< points keep their velocity and take the nodes' change; blended with PIC at a rate in 1/s
    pic,  ///< points take the nodes' velocity
    apic, ///< as PIC, with an affine field per point that keeps angular momentum (Jiang et al. 2015)
    tpic  ///< as PIC, with the velocity gradient per point (Taylor expansion)
  };

  /// Treatment of volumetric locking and stress oscillation.
  enum class FBar
  {
    none,
    standard, ///< the cell's mean volume change drives the material (Coombs et al. 2018)
    modified  ///< and stored elastic volume strain and volume follow the cell's mean (after Xie et al. 2024)
  };

  /// Subsection Transfer.
  struct TransferParameters
  {
    std::string method = "FLIP";
    double pic_rate    = 1; ///< 1/s

    void add_parameters(dealii::ParameterHandler &prm);

    /// Throws EntryError at an entry that the method does not read.
    void check() const;

    TransferMethod transfer_method() const;
    bool carries_affine_field() const;
  };

  /// Subsection Stabilisation.
  struct StabilisationParameters
  {
    std::string f_bar = "modified";

    void add_parameters(dealii::ParameterHandler &prm);
    FBar f_bar_kind() const;
  };
} // namespace scree

#endif

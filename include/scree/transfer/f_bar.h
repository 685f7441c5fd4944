// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_transfer_f_bar_h
#define scree_transfer_f_bar_h

#include <scree/material/material.h>
#include <scree/transfer/transfer_parameters.h>

#include <deal.II/base/tensor.h>

#include <vector>

namespace scree
{
  /// The motion of one cell's points over a step: what the material update reads.
  template <int dim>
  struct CellMotion
  {
    std::vector<dealii::Tensor<2, dim>> deformation_increment; ///< dF
    std::vector<double> out_of_plane_stretch;                  ///< dF_zz
    std::vector<double> volume_change;                         ///< dJ of the points' volume
    std::vector<double> volume;                                ///< V at the start of the step, m^3
    std::vector<double> volume_ratio;                          ///< J = V/V_0 at its end
    std::vector<double> reference_volume;                      ///< V_0, m^3

    /// Makes room for the points of a cell; memory only grows.
    void resize(const unsigned int n_points)
    {
      if (n_points <= deformation_increment.size())
        return;
      deformation_increment.resize(n_points);
      for (auto *list : { &out_of_plane_stretch, &volume_change, &volume, &volume_ratio, &reference_volume })
        list->resize(n_points);
    }

    MaterialMotion<dim> material_motion() const
    {
      return {
        deformation_increment.data(), out_of_plane_stretch.data(), volume_ratio.data(), reference_volume.data()
      };
    }
  };

  /// Cell averages against volumetric locking, on the motion and the stored elastic state of one cell's points.
  ///
  /// Standard (Coombs et al. 2018): dF becomes (mean dJ / dJ)^(1/3) dF with the cell's volume-weighted mean of dJ.
  /// Modified (after Xie, Navas & Lopez-Querol 2024): the same, and before it ln J_e of every point becomes the cell's
  /// volume-weighted mean; the deviator stays. Separated points count in the mean: their gap has to close. The points'
  /// volume follows the mean dJ, too: with the points' own dJ the volumes of a cell drift apart unfelt, until dense
  /// points dilate against loose ones (doc/verification.md has the measurement).
  template <int dim>
  void apply_f_bar(const FBar kind, CellMotion<dim> &motion, const MaterialPoints<dim> &points);
} // namespace scree

#endif

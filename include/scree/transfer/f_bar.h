// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_transfer_f_bar_h
#define scree_transfer_f_bar_h

#include <scree/materials/material.h>
#include <scree/simd/records.h>
#include <scree/transfer/transfer_parameters.h>

#include <vector>

namespace scree
{
  /// The motion of a block of points over a step, cell by cell: what the material update reads. Behind the last point
  /// there is room for a batch, so that the last one of a cell may be stored whole; the next cell writes over it.
  template <int dim>
  struct BlockMotion
  {
    std::vector<double> deformation_increment; ///< dF, dim x dim arrays of `pitch`, row-major
    std::vector<double> out_of_plane_stretch;  ///< dF_zz
    std::vector<double> volume_change;         ///< dJ of the points' volume
    std::vector<double> volume;                ///< V at the start of the step, m^3
    std::vector<double> volume_ratio;          ///< J = V/V_0 at its end
    std::vector<double> elastic_ratio;         ///< J_e at the start, 0 of points without stress; for apply_f_bar()
    std::vector<double> reference_volume;      ///< V_0, m^3
    std::size_t pitch = 0;                     ///< doubles from one component of dF to the next

    /// Makes room for the points of a block; memory only grows.
    void resize(const unsigned int n_points)
    {
      if (n_points + batch_size <= pitch)
        return;
      pitch = n_points + batch_size;
      deformation_increment.resize(dim * dim * pitch);
      for (auto *list :
           { &out_of_plane_stretch, &volume_change, &volume, &volume_ratio, &elastic_ratio, &reference_volume })
        list->resize(pitch);
    }

    /// The motion as the laws read it; valid until resize().
    /// @param time_step s
    /// @param grain_density kg/m^3
    MaterialMotion<dim> material_motion(const double time_step, const double grain_density) const
    {
      return { deformation_increment.data(),
               out_of_plane_stretch.data(),
               volume_ratio.data(),
               reference_volume.data(),
               pitch,
               time_step,
               grain_density };
    }
  };

  /// Cell averages against volumetric locking, on the motion of one cell's points.
  ///
  /// Standard (@source{coombs2018}): dF becomes (mean dJ / dJ)^(1/3) dF with the cell's volume-weighted mean of dJ.
  /// Modified (after @source{xie2024}, who take the mean of ln J_e): dF is scaled such that all points under stress
  /// have the trial elastic volume ratio of the cell, J_e = sum V dJ / sum (V/J_e), and the volumes of these points
  /// change by as much as their J_e. So V/J_e, the volume without stress, stays that of each point, and the sum of the
  /// volumes is that of their own dJ. Points without stress (separated grains) keep their own dJ and take no part in
  /// the sums: with them, gaps would become pores of soil in contact (doc/developer/development_log.md, "Stress
  /// averaging").
  ///
  /// @param first of the cell's points in the block
  template <int dim>
  void
  apply_f_bar(const FBar kind, const unsigned int first, const MaterialPoints<dim> &points, BlockMotion<dim> &motion);
} // namespace scree

#endif

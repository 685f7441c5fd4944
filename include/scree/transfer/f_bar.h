// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_transfer_f_bar_h
#define scree_transfer_f_bar_h

#include <scree/materials/material.h>
#include <scree/particles/cell_points.h>
#include <scree/simd/records.h>
#include <scree/tensor/matrix.h>
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

    /// The motion from a point on, as the laws read it; valid until resize().
    /// @param first number of the point
    /// @param time_step s
    /// @param grain_density kg/m^3
    MaterialMotion<dim>
    material_motion(const unsigned int first, const double time_step, const double grain_density) const
    {
      return { &deformation_increment[first],
               &out_of_plane_stretch[first],
               &volume_ratio[first],
               &reference_volume[first],
               pitch,
               time_step,
               grain_density };
    }
  };

  /// Of a batch of points: J_e^2 = det b_e of those under stress, else 0, and the trace of the stress, Pa.
  template <int dim>
  DEAL_II_ALWAYS_INLINE inline std::pair<Batch, Batch> elastic_square_under_stress(const MaterialPoints<dim> &points,
                                                                                   const BatchIndices &indices)
  {
    RecordPointers<const double> states, stresses;
    for (unsigned int l = 0; l < batch_size; ++l)
      {
        const std::size_t offset = points.offset(indices[l]);
        states[l]                = apart<const double>(points.left_cauchy_green + offset);
        stresses[l]              = apart<const double>(points.stress + offset);
      }
    Batch b[n_symmetric_components<dim>], stress[3];
    simd::load_records<n_symmetric_components<dim>>(states, b);
    simd::load_records<3>(stresses, stress); // the normal ones
    const Batch zero   = simd::broadcast<Batch>(0.);
    const Batch square = stress[0] * stress[0] + stress[1] * stress[1] + stress[2] * stress[2];
    return { simd::select<Batch>(square > 0., determinant_of_components<dim>(b), zero),
             stress[0] + stress[1] + stress[2] };
  }

  /// Cells one behind the other, and the points in them.
  template <int dim>
  struct CellBlock
  {
    const CellPoints<dim> *begin; ///< first cell
    const CellPoints<dim> *end;   ///< past the last one
    unsigned int first    = 0;    ///< number of the first point in BlockMotion
    unsigned int n_points = 0;    ///< points of the cells

    /// Calls `act(cell, number of its first point)`.
    template <typename Act>
    void for_each_cell(const Act &act) const
    {
      unsigned int number = first;
      for (const CellPoints<dim> *cell = begin; cell != end; number += (cell++)->n_points)
        act(*cell, number);
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

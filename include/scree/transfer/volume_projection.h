// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_transfer_volume_projection_h
#define scree_transfer_volume_projection_h

#include <scree/bodies/phases.h>
#include <scree/mesh/node_rows.h>
#include <scree/mesh/node_values.h>
#include <scree/transfer/f_bar.h>

#include <memory>
#include <utility>
#include <vector>

namespace scree
{
  /// Volume change of the points under stress in the space of the pore pressure, the linear functions psi_a of the
  /// cells' vertices, against volumetric locking and oscillation of the stress:
  ///
  ///   dJ_p = (sum_a psi_a m_a(x_p)) exp(-r_p),   r_p = sum_a c_a psi_a (ln J_e,p - l_a(x_p)),
  ///
  /// in which l_a is the linear function that fits ln J_e about the vertex by least squares with the weights V psi_a,
  /// m_a that of the points' own dJ with a part of its slope, and c_a = 1 - exp(-k gamma_a) with the mean shear gamma_a
  /// of the step. So elastic volume strain relaxes to what linear functions carry, as far as the soil shears. The
  /// volume of a point changes by dJ_p, and V/J_e stays that of the point.
  ///
  /// m_a is of the points of one body. l_a is of all bodies that move together, one pressure divided by the modulus M
  /// of waves of each: in place of ln J_e it fits M ln J_e, with the weights V psi_a/M.
  ///
  /// sum V dJ is that of the own dJ but for terms of r, sum V r is 0, a linear ln J_e passes but for a ridge, and the
  /// stored energy does not grow by relaxation (doc/theory/single_phase.md). Points without stress (separated grains)
  /// keep their own dJ and take no part.
  template <int dim>
  class VolumeProjection
  {
  public:
    /// Keeps a reference to the grid.
    explicit VolumeProjection(const BackgroundGrid<dim> &grid)
        : grid(grid)
        , shared(grid.vertices())
    {
    }

    /// Fits the sums to the grid's current vertices. Collective.
    void reinit()
    {
      shared.reinit();
      if (own)
        own->reinit();
    }

    /// Empties the sums, before the points of the bodies that move together.
    /// @param are_several always the same; with one body the modulus cancels out
    void clear(const unsigned int n_points, const bool are_several)
    {
      if (are_several && !own)
        {
          own = std::make_unique<Sums>(grid.vertices());
          own->reinit();
        }
      shared.clear();
      for (auto *list : { &elastic_strain, &weight, &stress_volume, &shear_of_step, &compliance })
        list->resize(n_points + batch_size);
      work = simd::broadcast<Batch>(0.);
    }

    /// Adds the points of some cells, as they are at the start of the step but for their motion.
    void add(const SoilBody<dim> &body, const CellBlock<dim> &block, const BlockMotion<dim> &motion);

    /// Fits the linear functions to the sums of all ranks. Collective.
    void fit()
    {
      fit(shared);
    }

    /// Before apply() on the points of a body, all its cells: fits the functions of its volume change. Collective.
    void fit_changes(const CellBlock<dim> &cells, const BlockMotion<dim> &motion);

    /// Sets dJ of the points of a cell and scales their dF.
    /// @param first of the cell's points in `motion`
    void apply(const CellPoints<dim> &cell, const unsigned int first, BlockMotion<dim> &motion);

    /// Work of the stress on the points' own volume change less that on its average without relaxation, since the last
    /// call, J: what the nodes have given and the points have not stored. Sum over the points of this rank.
    double take_kept_work()
    {
      return simd::sum_of_lanes(std::exchange(work, simd::broadcast<Batch>(0.)));
    }

  private:
    static constexpr unsigned int n_vertices = 1 << dim, n_terms = 1 + dim, n_moments = n_terms * (n_terms + 1) / 2;

    // Sums at a vertex: products of 1 and the distance from it in cells (weights V psi_a/M); these two times ln J_e and
    // times dJ - 1 (V psi_a: for the fit of M ln J_e and M (dJ - 1)); shear (V psi_a/M); V psi_a. Filled up to fours.
    static constexpr unsigned int volume = 0, strain = n_moments, change = strain + n_terms, shear = change + n_terms,
                                  plain_volume = shear + 1, n_sums = plain_volume / 4 * 4 + 4;

    // After fit(), in their place: value and slope of the linear function of dJ - 1; c_a; c_a times those of ln J_e.
    static constexpr unsigned int new_change = 0, relaxed = n_terms, new_strain = relaxed + 1,
                                  n_fits = new_strain + n_terms;

    using Sums = NodeValues<dim, n_sums>;

    void add_cell(const CellPoints<dim> &cell, const unsigned int first, const BlockMotion<dim> &motion, Sums &sums);

    void fit(Sums &sums);

    const BackgroundGrid<dim> &grid;
    Sums shared;               // of all bodies
    std::unique_ptr<Sums> own; // of the body at hand; null if there is one only

    // Of the points, as in BlockMotion
    std::vector<double> elastic_strain; // ln J_e at the start of the step; not a number without stress
    std::vector<double> weight;         // V, m^3; 0 without stress
    std::vector<double> stress_volume;  // V tr(sigma)/3, J
    std::vector<double> shear_of_step;  // gamma
    std::vector<double> compliance;     // 1/M of a cell's points, 1/Pa, where its first one is; 1 for a single body
    Batch work;                         // see take_kept_work(), lane by lane
  };
} // namespace scree

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_transfer_skeleton_damping_h
#define scree_transfer_skeleton_damping_h

#include <scree/bodies/phases.h>
#include <scree/tensor/matrix.h>
#include <scree/transfer/f_bar.h>

#include <vector>

namespace scree
{
  /// Kelvin-Voigt damping of the skeleton of soil in water: the stress theta (d sigma'/dt - W sigma' + sigma' W), with
  /// the spin W and the damping time theta, acts beside the effective stress sigma'.
  ///
  /// Without it, Coulomb friction on the effective stress of an undrained elastic layer flutters: waves of the normal
  /// stress grow until the layer sticks. As the rate is that of the elastic stress, steady plastic flow is not damped.
  template <int dim>
  class SkeletonDamping
  {
  public:
    /// Keeps the effective stress at the start of the step of `n_points` points, of which `cell` is the first one.
    void begin(const SoilBody<dim> &body, const CellPoints<dim> &cell, const unsigned int n_points)
    {
      before.resize(std::size_t(n) * n_points);
      for (unsigned int p = 0; p < n_points; ++p)
        std::copy_n(cell.properties_of(p) + body.layout.stress, n, &before[std::size_t(n) * p]);
    }

    /// Sets the damping stress from what the law has made of the stress in the step.
    /// @param rate damping time over time step
    void finish(const SoilBody<dim> &body,
                const CellPoints<dim> &cell,
                const unsigned int n_points,
                const MaterialMotion<dim> &motion,
                const double rate) const
    {
      for (unsigned int p = 0; p < n_points; ++p)
        {
          const double *old  = &before[std::size_t(n) * p];
          double *properties = cell.properties_of(p), *now = properties + body.layout.stress,
                 *damping = properties + body.layout.damping;
          for (unsigned int c = 0; c < n; ++c)
            damping[c] = rate * (now[c] - old[c]);
          // W sigma - sigma W, with W dt the skew part of dF
          const auto stress    = matrix_of_components<dim>(old);
          const auto increment = motion.deformation_increment_of(p);
          double spin[dim][dim], turn[dim][dim] = {};
          for (unsigned int i = 0; i < dim; ++i)
            for (unsigned int j = 0; j < dim; ++j)
              spin[i][j] = 0.5 * (increment[i][j] - increment[j][i]);
          for (unsigned int i = 0; i < dim; ++i)
            for (unsigned int j = 0; j < dim; ++j)
              for (unsigned int k = 0; k < dim; ++k)
                turn[i][j] += spin[i][k] * stress[k][j] - stress[i][k] * spin[k][j];
          for (unsigned int i = 0; i < dim; ++i)
            damping[i] -= rate * turn[i][i];
          for (unsigned int i = 0, c = 3; i < dim; ++i)
            for (unsigned int j = i + 1; j < dim; ++j, ++c)
              damping[c] -= rate * turn[i][j];
        }
    }

  private:
    static constexpr unsigned int n = n_symmetric_components<dim>;
    std::vector<double> before; // stress at the start of the step, point by point, Pa
  };
} // namespace scree

#endif

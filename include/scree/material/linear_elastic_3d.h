// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_material_linear_elastic_3d_h
#define scree_material_linear_elastic_3d_h

#include <scree/material/hencky_material.h>
#include <scree/material/linear_elastic.h>
#include <scree/tensor/logarithm.h>

namespace scree
{
  /// Linear elasticity in three dimensions needs no principal directions where strains are moderate: the stress follows
  /// from ln b itself, at a fifth of the cost. (In plane strain the principal directions come in closed form.)
  class LinearElastic3D : public HenckyMaterial<3, LinearElastic>
  {
  public:
    explicit LinearElastic3D(const LinearElastic &law)
        : HenckyMaterial<3, LinearElastic>(law)
        , shear(law.shear_modulus())
        , bulk(law.bulk_modulus(0.))
    {
    }

    void update(const MaterialPoints<3> &points, const MaterialMotion<3> &motion, UpdateReport &report) const override
    {
      UpdateReport own;
      own.largest_bulk_modulus = bulk;
      for (unsigned int p = 0; p < points.n_points; ++p)
        {
          double *b = points.left_cauchy_green + points.offset(p), *stress = points.stress + points.offset(p);
          double trial[6], log_b[6];
          trial_left_cauchy_green(motion.deformation_increment[p], 1., b, trial);

          // A point turned inside out would pass as its mirror image: the general update refuses it.
          if (!(motion.volume_ratio[p] > 0. && logarithm_near_sphere(trial, log_b)))
            {
              this->update_point(p, points, motion, own);
              continue;
            }
          ++own.n_substeps;
          std::copy(trial, trial + 6, b);

          // tau = K tr(eps) I + 2 G dev(eps), eps = ln(b)/2; sigma = tau/J
          const double inverse_J = 1. / motion.volume_ratio[p], volume_strain = 0.5 * (log_b[0] + log_b[1] + log_b[2]);
          const double shear_part  = shear * inverse_J;
          const double volume_part = (bulk - 2. / 3. * shear) * volume_strain * inverse_J;
          for (unsigned int c = 0; c < 6; ++c)
            stress[c] = shear_part * log_b[c] + (c < 3 ? volume_part : 0.);

          // Gershgorin's bound of the principal values: exact along the axes.
          const double xy = std::abs(stress[3]), xz = std::abs(stress[4]), yz = std::abs(stress[5]);
          const double least      = std::min({ stress[0] - xy - xz, stress[1] - xy - yz, stress[2] - xz - yz });
          own.largest_compression = std::max(own.largest_compression, -least * motion.volume_ratio[p]);
        }
      own.n_updates = points.n_points;
      report.add(own);
    }

  private:
    const double shear, bulk; // Pa
  };
} // namespace scree

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/transfer/f_bar.h>

#include <scree/tensor/matrix.h>

#include <cmath>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// Cube root of a ratio of volumes. Near 1 by two steps of Halley's method from the tangent, which is exact to
    /// rounding and takes a quarter of the time of std::cbrt.
    inline double cube_root(const double x)
    {
      if (!(std::abs(x - 1.) < 0.1))
        return std::cbrt(x);
      double root = 1. + (x - 1.) / 3.;
      for (unsigned int step = 0; step < 2; ++step)
        {
          const double cube = root * root * root;
          root *= (cube + 2. * x) / (2. * cube + x);
        }
      return root;
    }


    /// Gives all points the cell's mean of ln J_e = 1/2 ln det b_e.
    template <int dim>
    void average_elastic_volume_strain(const CellMotion<dim> &motion, const MaterialPoints<dim> &points)
    {
      if (points.n_points == 1)
        return;
      double weighted = 0, volume = 0;
      for (unsigned int p = 0; p < points.n_points; ++p)
        {
          const double *b = points.left_cauchy_green + points.offset(p);
          weighted += motion.volume[p] * std::log(determinant_of_components<dim>(b));
          volume += motion.volume[p];
        }
      // b scales by exp(2/3 (mean ln J_e - ln J_e)) = (exp(mean ln det b) / det b)^(1/3)
      const double mean = std::exp(weighted / volume);
      for (unsigned int p = 0; p < points.n_points; ++p)
        {
          double *b          = points.left_cauchy_green + points.offset(p);
          const double scale = cube_root(mean / determinant_of_components<dim>(b));
          for (unsigned int c = 0; c < n_symmetric_components<dim>; ++c)
            b[c] *= scale;
        }
    }

    template <int dim>
    void average_volume_change(const FBar kind, CellMotion<dim> &motion, const unsigned int n_points)
    {
      double weighted = 0, volume = 0;
      for (unsigned int p = 0; p < n_points; ++p)
        {
          weighted += motion.volume[p] * motion.volume_change[p];
          volume += motion.volume[p];
        }
      const double mean = weighted / volume;
      for (unsigned int p = 0; p < n_points; ++p)
        {
          const double scale = cube_root(mean / motion.volume_change[p]);
          motion.deformation_increment[p] *= scale;
          motion.out_of_plane_stretch[p] = scale;
          if (kind == FBar::modified)
            motion.volume_change[p] = mean;
        }
    }
  } // namespace


  template <int dim>
  void apply_f_bar(const FBar kind, CellMotion<dim> &motion, const MaterialPoints<dim> &points)
  {
    if (kind == FBar::none)
      return;
    if (kind == FBar::modified)
      average_elastic_volume_strain(motion, points);
    average_volume_change(kind, motion, points.n_points);
  }

  template void apply_f_bar(const FBar, CellMotion<2> &, const MaterialPoints<2> &);
  template void apply_f_bar(const FBar, CellMotion<3> &, const MaterialPoints<3> &);
} // namespace scree

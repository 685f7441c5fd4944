// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_tests_unit_one_point_h
#define scree_tests_unit_one_point_h

#include <scree/materials/hencky_material.h>

#include <functional>
#include <iostream>
#include <string>

#include "../expect.h"
#include "../random_numbers.h"

namespace scree
{
/// The return of a law for one point, in principal values; says whether it changed anything, and counts in `report`.
template <typename Law>
bool return_point(const Law &law,
                  PrincipalValues &strain,
                  double *internal_variables,
                  const double volume_ratio,
                  PrincipalValues &stress,
                  UpdateReport &report,
                  const double time_step     = std::numeric_limits<double>::infinity(),
                  const double grain_density = 0)
{
  const LawResponse<double> response = respond<double>(
      law, LawStep<double>{ volume_ratio, time_step, grain_density }, strain, internal_variables, stress);
  report.n_vertices += response.is_vertex;
  report.n_separated += response.is_separated;
  report.n_fallbacks += response.is_searched;
  report.n_unresolved += response.is_unresolved;
  report.largest_bulk_modulus = std::max(report.largest_bulk_modulus, response.bulk_modulus);
  for (const double value : stress)
    report.largest_compression = std::max(report.largest_compression, -value);
  return response.is_plastic;
}


/// The kinematics of HenckyMaterial in plain formulas, one point after the other: what it is compared with.
template <int dim, typename Law>
class OnePointMaterial : public HenckyMaterial<dim, Law>
{
public:
  explicit OnePointMaterial(const Law &law)
      : HenckyMaterial<dim, Law>(law)
      , law(law)
  {
  }

  void update(const MaterialPoints<dim> &points, const MaterialMotion<dim> &motion, UpdateReport &report) const override
  {
    for (unsigned int p = 0; p < points.n_points; ++p)
      {
        const std::size_t offset = points.offset(p);
        report.plastic_dissipation += motion.reference_volume[p] * advance(p,
                                                                           motion,
                                                                           points.left_cauchy_green + offset,
                                                                           points.internal_variables + offset,
                                                                           points.stress + offset,
                                                                           report);
      }
    report.n_updates += points.n_points;
  }

private:
  /// Returns the dissipation per reference volume, J/m^3.
  double advance(const unsigned int p,
                 const MaterialMotion<dim> &motion,
                 double *b,
                 double *internal_variables,
                 double *stress,
                 UpdateReport &report) const
  {
    const double stretch = dim == 2 ? motion.out_of_plane_stretch[p] : 1, J = motion.volume_ratio[p];
    dealii::Tensor<2, dim> change = motion.deformation_increment_of(p); // dF - I
    double largest_change = std::abs(stretch - 1), dissipation = 0;
    for (unsigned int i = 0; i < dim; ++i)
      {
        change[i][i] -= 1;
        for (unsigned int j = 0; j < dim; ++j)
          largest_change = std::max(largest_change, std::abs(change[i][j]));
      }
    const auto n           = static_cast<unsigned int>(std::max(1., std::ceil(largest_change / law.substep_strain())));
    const auto n_separated = report.n_separated; // A point counts once, by its state in the end.
    for (unsigned int k = 0; k < n; ++k)
      {
        dealii::Tensor<2, dim> before = (static_cast<double>(k) / n) * change; // F_{k-1}
        for (unsigned int i = 0; i < dim; ++i)
          before[i][i] += 1;
        dealii::Tensor<2, dim> f = (1. / n) * change * invert(before);
        for (unsigned int i = 0; i < dim; ++i)
          f[i][i] += 1;
        const double stretch_change = (stretch - 1) / n;
        double trial[n_symmetric_components<dim>];
        trial_left_cauchy_green<dim>(&f[0][0], 1 + stretch_change / (1 + k * stretch_change), b, trial);
        const PrincipalFrame<dim> frame(trial);
        const PrincipalValues trial_strain = log_strain(frame.values());
        PrincipalValues strain             = trial_strain, tau;
        report.n_separated                 = n_separated;
        ++report.n_substeps;
        if (return_point(law, strain, internal_variables, J, tau, report, motion.time_step, motion.grain_density))
          left_cauchy_green_of(frame, strain, b);
        else
          std::copy(trial, trial + n_symmetric_components<dim>, b);
        for (unsigned int i = 0; i < 3; ++i)
          {
            dissipation += tau[i] * (trial_strain[i] - strain[i]);
            tau[i] /= J;
          }
        frame.compose(tau, stress);
      }
    return dissipation;
  }

  const Law law;
};


/// Strains of `size` around a mean that is from compression to some tension.
inline PrincipalValues random_strain(RandomNumbers &random, const double size)
{
  const double mean = random.uniform(-1, 0.3) * size;
  PrincipalValues strain;
  for (double &value : strain)
    value = mean + size * random.uniform(-1, 1);
  return strain;
}


/// 20 points of a law with `n_internal` variables side by side on a path of random increments of this size: lanes and
/// the path point by point agree, and the points shear by more than `least_shear`. `start` sets the internal variables
/// of a point.
template <int dim, unsigned int n_internal, typename Law>
void test_lanes(
    const std::string &name,
    const Law &law,
    const double size,
    const double least_shear,
    RandomNumbers &random,
    const std::function<void(unsigned int, double *)> &start = [](unsigned int, double *) {})
{
  constexpr unsigned int n = n_symmetric_components<dim>, n_points = 20, stride = 2 * n + n_internal;
  const OnePointMaterial<dim, Law> one_by_one(law);
  const HenckyMaterial<dim, Law> in_lanes(law);
  std::vector<double> lanes(n_points * stride);
  for (unsigned int p = 0; p < n_points; ++p)
    {
      double *record = &lanes[p * stride], stress[6] = { -1e4, -1e4, -1e4 };
      start(p, record + 2 * n);
      in_lanes.initialise(stress, record, record + n, record + 2 * n);
    }
  std::vector<double> points = lanes, increment(dim * dim * n_points), one(n_points, 1.);
  UpdateReport report;
  double largest = 0, largest_shear = 0;
  for (unsigned int step = 0; step < 2000; ++step)
    {
      for (unsigned int c = 0; c < dim * dim; ++c)
        for (unsigned int p = 0; p < n_points; ++p)
          increment[c * n_points + p] = (c % (dim + 1) == 0 ? 1 : 0) + size * random.uniform(-1, 1);
      const MaterialMotion<dim> motion{ increment.data(), one.data(), one.data(), one.data(), n_points, 1e-3 };
      const auto update = [&](const Material<dim> &material, std::vector<double> &records) {
        material.update({ n_points, stride, &records[0], &records[n], &records[2 * n] }, motion, report);
      };
      update(in_lanes, lanes);
      update(one_by_one, points);
    }
  for (unsigned int i = 0; i < lanes.size(); ++i)
    {
      const unsigned int c = i % stride;
      const double scale   = c >= n && c < 2 * n ? 1e5 : 1;
      largest              = std::max(largest, std::abs(lanes[i] - points[i]) / scale);
      largest_shear        = c == 2 * n + 1 ? std::max(largest_shear, lanes[i]) : largest_shear;
    }
  AssertThrow(report.n_unresolved == 0, dealii::ExcMessage(name + ": unresolved"));
  AssertThrow(largest_shear > least_shear, dealii::ExcMessage(name + ": the points did not shear"));
  expect(largest, 0, 1e-7, name + ": difference of lanes");
  std::cout << dim << "D, " << name << ", in lanes: OK" << std::endl;
}
} // namespace scree

#endif

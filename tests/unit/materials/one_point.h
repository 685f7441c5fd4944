// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_tests_unit_one_point_h
#define scree_tests_unit_one_point_h

#include "../test.h"

#include <scree/materials/hencky_material.h>
#include <scree/materials/laws/mohr_coulomb.h>
#include <scree/materials/laws/tresca.h>
#include <scree/materials/table.h>

#include <deal.II/base/symmetric_tensor.h>

#include <functional>

namespace scree
{
/// Clay whose cohesion falls from 20 to 5 kPa.
inline MohrCoulombParameters softening_clay()
{
  MohrCoulombParameters parameters;
  parameters.young_modulus            = 1e7;
  parameters.cohesion                 = 2e4;
  parameters.friction_angle           = 0;
  parameters.softening.strain         = 0.05;
  parameters.softening.cohesion       = 5e3;
  parameters.softening.friction_angle = 0;
  return parameters;
}


/// Clay that softens with strain, of 20 kPa.
inline TrescaParameters sensitive_clay()
{
  TrescaParameters parameters;
  parameters.strength          = 20e3;
  parameters.sensitivity       = 5;
  parameters.remoulding_strain = 0.15;
  return parameters;
}


/// A point of a material and its path.
template <int dim>
struct PointOfMaterial
{
  std::unique_ptr<Material<dim>> material;
  double left_cauchy_green[6], stress[6], internal[4] = {}, J = 1;
  UpdateReport report;

  PointOfMaterial(const std::string &law, const double vertical, const double lateral)
  {
    MaterialParameters parameters;
    parameters.law        = law;
    material              = make_material<dim>(parameters);
    const double start[6] = { lateral, vertical, lateral, 0, 0, 0 };
    material->initialise(start, left_cauchy_green, stress, internal);
  }

  void update(const dealii::Tensor<2, dim> &increment, const double stretch = 1)
  {
    const double one = 1;
    J *= stretch * determinant(increment);
    material->update({ 1, 0, left_cauchy_green, stress, internal }, { &increment[0][0], &stretch, &J, &one }, report);
  }
};


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


/// Strength, Pa, that falls with the plastic shear strain by exp(-rate gamma_p).
struct FallingStrength
{
  double peak, residual, rate;
};


/// Pure shear to `gamma` of a law without friction against tau = residual + (peak - residual) exp(-rate (gamma -
/// tau/G)) beyond the peak: the largest error over the peak in 1000 steps, and the gain of four times as many, which
/// is 4.
template <typename Law>
void test_falling_shear(const Law &law,
                        const double gamma,
                        const FallingStrength &strength,
                        const double bound,
                        const double bound_of_gain)
{
  const double G   = law.shear_modulus;
  const auto error = [&](const unsigned int n) {
    PrincipalValues strain = { { -0.01, -0.01, -0.01 } }, stress;
    double internal[4] = { 0, 0, 0, strength.peak }, largest = 0; // the last one is that of Tresca's soil
    UpdateReport report;
    for (unsigned int step = 1; step <= n; ++step)
      {
        const double now = gamma * step / n;
        strain[0] += gamma / 2 / n;
        strain[2] -= gamma / 2 / n;
        return_point(law, strain, internal, 1, stress, report);
        double exact = std::min(G * now, strength.peak);
        for (unsigned int i = 0; i < 200 && G * now >= strength.peak; ++i)
          exact =
              strength.residual + (strength.peak - strength.residual) * std::exp(-strength.rate * (now - exact / G));
        largest = std::max(largest, std::abs((stress[0] - stress[2]) / 2 - exact) / strength.peak);
      }
    return largest;
  };
  const double coarse = error(1000);
  expect(coarse, 0, bound, "error of tau in 1000 steps");
  expect(coarse / error(4000), 4, bound_of_gain, "gain of four times as many steps"); // first order
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
    const Tensor<2, dim> one = unit_symmetric_tensor<dim>(), change = motion.deformation_increment_of(p) - one;
    double largest_change = std::abs(stretch - 1), dissipation = 0;
    for (unsigned int i = 0; i < dim * dim; ++i)
      largest_change = std::max(largest_change, std::abs(change[i / dim][i % dim]));
    const auto n           = static_cast<unsigned int>(std::max(1., std::ceil(largest_change / law.substep_strain)));
    const auto n_separated = report.n_separated; // A point counts once, by its state in the end.
    for (unsigned int k = 0; k < n; ++k)
      {
        const Tensor<2, dim> before = one + (static_cast<double>(k) / n) * change; // F_{k-1}
        const Tensor<2, dim> f      = one + (1. / n) * change * invert(before);
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
    const auto sigma = matrix_of_components<dim>(stress);
    double work      = dim == 2 ? stress[2] * (stretch - 1) : 0;
    for (unsigned int i = 0; i < dim * dim; ++i)
      work += sigma[i / dim][i % dim] * change[i / dim][i % dim];
    report.elastic_energy += motion.reference_volume[p] * (this->elastic_energy(b) - 0.5 * J * work);
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


/// Energy that a return takes, J/m^3, and the size of its terms; throws at what is not a number.
inline std::pair<double, double>
energy_taken(const PrincipalValues &trial, const PrincipalValues &strain, const PrincipalValues &stress)
{
  double energy = 0, size = 0;
  for (unsigned int k = 0; k < 3; ++k)
    {
      energy += stress[k] * (trial[k] - strain[k]);
      size += std::abs(stress[k]) * (std::abs(trial[k]) + std::abs(strain[k]));
    }
  require(std::isfinite(energy), "A return is not a number.");
  return { energy, size };
}


/// Derivative of the energy along principal axis k, over +- `step`, Pa; exact but where the axis opens or closes.
template <typename Law>
double energy_slope(const Law &law, const PrincipalValues &strain, const unsigned int k, const double step)
{
  PrincipalValues more = strain, less = strain;
  more[k] += step;
  less[k] -= step;
  return (energy_of<double>(law, more) - energy_of<double>(law, less)) / (2 * step);
}


/// A random strain and what a law makes of it.
struct RandomReturn
{
  PrincipalValues trial, strain, stress;
  double size; ///< of the strains
  double internal[4] = {};
  double time_step   = std::numeric_limits<double>::infinity(); ///< s
  double scale;                                                 ///< of stress, Pa
  bool is_plastic, is_at_vertex;
};


/// A million random returns of a law. `start` sets internal variables and time step and gives the strength, Pa; `check`
/// looks at the result. All are resolved, none makes energy, and `n_plastic` at least are plastic.
template <typename Law, typename Start, typename Check>
void random_returns(const std::string &name,
                    const Law &law,
                    RandomNumbers &random,
                    const unsigned int n_plastic,
                    const Start &start,
                    const Check &check)
{
  UpdateReport report;
  unsigned int n = 0;
  for (unsigned int i = 0; i < 1000000; ++i)
    {
      RandomReturn point;
      point.size  = random.log_uniform(1e-6, 1e-1);
      point.trial = point.strain = random_strain(random, point.size);
      point.scale                = start(point) + law.bulk_modulus(0) * point.size;
      const auto n_before        = report.n_vertices + report.n_separated;
      point.is_plastic   = return_point(law, point.strain, point.internal, 1, point.stress, report, point.time_step);
      point.is_at_vertex = report.n_vertices + report.n_separated > n_before;
      n += point.is_plastic;
      const double dissipation = energy_taken(point.trial, point.strain, point.stress).first;
      require(dissipation / (point.scale * point.size) >= -1e-12, name + ": energy made");
      check(point);
    }
  require(report.n_unresolved == 0, name + ": unresolved");
  require(n > n_plastic, name + ": plastic states were not visited");
}


inline double largest_difference(const PrincipalValues &a, const PrincipalValues &b)
{
  double largest = 0;
  for (unsigned int k = 0; k < 3; ++k)
    largest = std::max(largest, std::abs(a[k] - b[k]));
  return largest;
}
} // namespace scree

#endif

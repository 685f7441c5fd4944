// SPDX-License-Identifier: LGPL-2.1-or-later
// Laws in batches against the same laws point by point, at random and odd states; what comes out of a point is the same
// to the last bit wherever it stands among the others.
#include "one_point.h"

#include <scree/materials/laws/nor_sand.h>
#include <scree/materials/laws/tresca.h>
#include <scree/materials/laws/viscoinertial_grains.h>

#include <numeric>

namespace test_material_batches
{
/// Records of points and their motion over a step.
template <int dim>
struct States
{
  static constexpr unsigned int n_components = n_symmetric_components<dim>;
  static constexpr unsigned int stride       = 2 * n_components + 5; // one at least is not the law's

  explicit States(const unsigned int n)
      : records(n * stride, 7.)
      , increment(n)
      , stretch(n, 1.)
      , volume_ratio(n)
      , reference_volume(n)
  {
  }

  double *record(const unsigned int p)
  {
    return &records[p * stride];
  }

  /// Updates `n` points from `first` on, which `slots` names.
  UpdateReport update(const Material<dim> &material,
                      const std::vector<unsigned int> &slots,
                      const unsigned int first,
                      unsigned int n)
  {
    std::vector<double> F(dim * dim * n), zz, J, V0;
    for (unsigned int i = first; i < first + n; ++i)
      {
        for (unsigned int c = 0; c < dim * dim; ++c)
          F[c * n + i - first] = increment[slots[i]][c / dim][c % dim];
        zz.push_back(stretch[slots[i]]);
        J.push_back(volume_ratio[slots[i]]);
        V0.push_back(reference_volume[slots[i]]);
      }
    UpdateReport report;
    material.update({ n, stride, record(0), record(0) + n_components, record(0) + 2 * n_components, &slots[first] },
                    { F.data(), zz.data(), J.data(), V0.data(), n, time_step, grain_density },
                    report);
    return report;
  }

  static constexpr double time_step = 1e-3, grain_density = 2650; // s, kg/m^3; of laws that know a rate

  std::vector<double> records;
  std::vector<Tensor<2, dim>> increment;
  std::vector<double> stretch, volume_ratio, reference_volume;
};


/// What random states are like.
struct Kind
{
  std::string name;
  double smallest_increment, largest_increment;
  double smallest_pressure, largest_pressure; // Pa
  double largest_ratio;                       // q/P
  double overconsolidation;
  double share_of_quick; // whose increments are larger by the factor that needs sub-steps
  std::function<void(double *, RandomNumbers &)> set_internal{}; // values of the law's variables
  bool is_independent = true; // of the other points of a batch, which Tresca's iterations with a rate are to 1e-13 only
};


template <int dim>
void set_random(States<dim> &states, const Material<dim> &material, const Kind &kind, RandomNumbers &random)
{
  for (unsigned int p = 0; p < states.increment.size(); ++p)
    {
      SymmetricTensor<2, 3> stress;
      for (unsigned int c = 0; c < states.n_components; ++c)
        stress.access_raw_entry(c) = random.uniform(-1, 1);
      const double pressure = random.log_uniform(kind.smallest_pressure, kind.largest_pressure);
      const double q        = pressure * random.uniform(0, kind.largest_ratio);
      stress *= q / (std::sqrt(1.5) * deviator(stress).norm());
      stress         = deviator(stress) - pressure * unit_symmetric_tensor<3>();
      double *record = states.record(p), *internal = record + 2 * states.n_components;
      if (kind.set_internal)
        kind.set_internal(internal, random);
      material.initialise(stress.begin_raw(), record, record + states.n_components, internal);
      internal[0] *= random.uniform(1, kind.overconsolidation);
      if (kind.set_internal)
        kind.set_internal(internal, random);

      double size = random.log_uniform(kind.smallest_increment, kind.largest_increment);
      if (random.uniform(0, 1) < kind.share_of_quick)
        size *= 20;
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          states.increment[p][i][j] = (i == j ? 1. : 0.) + size * random.uniform(-1, 1);
      if (dim == 2)
        states.stretch[p] = 1 + 0.2 * size * random.uniform(-1, 1);
      states.volume_ratio[p]     = random.log_uniform(0.9, 1.2);
      states.reference_volume[p] = random.log_uniform(1e-4, 1e-2);
    }
}


/// The largest difference of two sets of records: of b, stress over its size and a pascal, internal variables.
template <int dim>
double difference(const States<dim> &a, const States<dim> &b)
{
  constexpr unsigned int n = States<dim>::n_components;
  double largest           = 0;
  for (unsigned int p = 0; p < a.increment.size(); ++p)
    {
      const double *x = &a.records[p * a.stride], *y = &b.records[p * a.stride];
      double size = 1;
      for (unsigned int c = 0; c < n; ++c)
        size = std::max(size, std::abs(x[n + c]));
      for (unsigned int c = 0; c < a.stride; ++c)
        {
          const double scale = c < n ? 1e-3 : c < 2 * n ? size : std::max(std::abs(x[c]), 1e-3);
          const double error = std::abs(x[c] - y[c]) / scale;
          require(std::isfinite(error), "not a number");
          largest = std::max(largest, error);
        }
    }
  return largest;
}


void compare_reports(const UpdateReport &one, const UpdateReport &batch, const std::string &name)
{
  const auto agree = [](const double a, const double b) { return std::abs(a - b) <= 1e-8 * (std::abs(a) + 1e-30); };
  require(one.n_updates == batch.n_updates && one.n_substeps == batch.n_substeps &&
              one.n_separated == batch.n_separated && one.n_vertices == batch.n_vertices &&
              one.n_fallbacks == batch.n_fallbacks && one.n_unresolved == batch.n_unresolved,
          name + ": counts differ");
  require(agree(one.largest_bulk_modulus, batch.largest_bulk_modulus) &&
              agree(one.largest_compression, batch.largest_compression) &&
              agree(one.plastic_dissipation, batch.plastic_dissipation) &&
              agree(one.elastic_energy, batch.elastic_energy),
          name + ": sums differ");
}


/// Batches of any size, in any order: bit by bit the same.
template <int dim>
void test_places(const Material<dim> &material,
                 const States<dim> &start,
                 const States<dim> &expected,
                 const std::string &name,
                 RandomNumbers &random)
{
  const unsigned int n = std::min<unsigned int>(start.increment.size(), 4000);
  std::vector<unsigned int> slots(n);
  std::iota(slots.begin(), slots.end(), 0);
  for (unsigned int p = 0; p < n; ++p)
    std::swap(slots[p], slots[static_cast<unsigned int>(random.uniform(0, n))]);
  States<dim> states = start;
  for (unsigned int first = 0, size = 1; first < n; first += size, size = size % 19 + 1)
    states.update(material, slots, first, std::min(size, n - first));
  require(std::equal(states.records.begin(), states.records.begin() + n * states.stride, expected.records.begin()),
          name + ": a point depends on its place");
}


template <int dim, typename Law>
void test(const Law &law, const Kind &kind, const unsigned int n, const double bound, RandomNumbers &random)
{
  const OnePointMaterial<dim, Law> one_by_one(law);
  const HenckyMaterial<dim, Law> in_batches(law);
  const std::string name = std::to_string(dim) + "D, " + kind.name;

  States<dim> start(n);
  set_random(start, one_by_one, kind, random);
  std::vector<unsigned int> slots(n);
  std::iota(slots.begin(), slots.end(), 0);
  States<dim> one = start, batch = start;
  compare_reports(one.update(one_by_one, slots, 0, n), batch.update(in_batches, slots, 0, n), name);
  const double error = difference(one, batch);
  expect(error, 0, bound, name + ": difference of batches");
  if (kind.is_independent)
    test_places(in_batches, start, batch, name, random);
}


template <int dim>
void test_laws(const unsigned int n, RandomNumbers &random)
{
  const LinearElastic elastic{ LinearElasticParameters() };
  test<dim>(elastic, { "elastic, small strain", 1e-9, 1e-3, 1e2, 1e5, 1, 1, 0 }, n, 1e-9, random);
  test<dim>(elastic, { "elastic, large strain", 1e-3, 0.3, 1e2, 1e6, 1, 1, 0 }, n, 1e-9, random);

  NorSandParameters parameters;
  const NorSand sand(parameters);
  test<dim>(sand, { "sand, inside the yield surface", 1e-9, 1e-6, 1e3, 1e5, 0.5, 3, 0 }, n, 1e-8, random);
  test<dim>(sand, { "sand, yielding", 1e-6, 9e-4, 1e3, 1e5, 1, 1, 0 }, n, 1e-8, random);
  test<dim>(sand, { "sand, mixed with sub-steps", 1e-7, 9e-4, 1e3, 1e5, 1, 1.5, 0.2 }, n, 1e-7, random);
  test<dim>(sand, { "sand, pulled apart and to the vertex", 1e-5, 9e-4, 1., 1e3, 0.5, 1, 0.05 }, n, 1e-7, random);
  parameters.potential_constant = parameters.yield_constant = 0;
  test<dim>(NorSand(parameters), { "N = 0", 1e-6, 9e-4, 1e3, 1e5, 0.5, 1, 0.05 }, n, 1e-7, random);
}


template <int dim>
void test_mohr_coulomb(const unsigned int n, RandomNumbers &random)
{
  const auto test_law = [&](const MohrCoulombParameters &parameters, const Kind &kind) {
    test<dim>(MohrCoulomb(parameters), kind, n, 1e-8, random);
  };
  MohrCoulombParameters parameters;
  test_law(parameters, { "Mohr-Coulomb, inside the yield surface", 1e-9, 1e-6, 1e4, 1e6, 0.3, 1, 0 });
  test_law(parameters, { "Mohr-Coulomb, faces, edges, pulled apart", 1e-5, 0.01, 1e2, 1e5, 0.8, 1, 0.1 });
  test_law(parameters, { "Mohr-Coulomb, nearly isotropic", 1e-12, 1e-3, 1e3, 1e5, 1e-9, 1, 0 });
  parameters.inertial_friction.grain_diameter = 1e-3;
  test_law(parameters, { "Mohr-Coulomb, inertial friction", 1e-5, 0.01, 1e2, 1e5, 0.8, 1, 0.1 });
  parameters.inertial_friction.grain_diameter = 0;
  parameters.dilation_angle                   = 15;
  parameters.cohesion                         = 1e3;
  test_law(parameters, { "Mohr-Coulomb, psi, c, no tension", 1e-5, 0.01, 1e2, 1e5, 0.8, 1, 0.1 });
  parameters.tension_cut_off = 500;
  test_law(parameters, { "Mohr-Coulomb, cut-off", 1e-6, 0.01, 1e2, 1e4, 0.8, 1, 0.1 });
  parameters.friction_angle = parameters.dilation_angle = 0;
  test_law(parameters, { "Mohr-Coulomb, no friction", 1e-6, 0.01, 1e2, 1e3, 1, 1, 0.1 });
}


template <int dim>
void test_jefferies_been(const unsigned int n, RandomNumbers &random)
{
  const auto test_law = [&](const JefferiesBeenParameters &parameters, const Kind &kind) {
    test<dim>(JefferiesBeen(parameters), kind, n, 1e-6, random);
  };
  JefferiesBeenParameters parameters;
  test_law(parameters, { "Jefferies-Been, inside the yield surface", 1e-9, 1e-6, 1e3, 1e6, 0.3, 3, 0 });
  test_law(parameters, { "Jefferies-Been, yielding", 1e-6, 4e-4, 1e3, 1e6, 0.7, 1, 0.1 });
  test_law(parameters, { "Jefferies-Been, pulled apart and to the vertex", 1e-5, 4e-4, 1., 1e3, 0.5, 1, 0.1 });
}


/// Softening soil, and clay and mud of any strength, that have sheared before.
template <int dim>
void test_falling_strength(const unsigned int n, RandomNumbers &random)
{
  MohrCoulombParameters soil = softening_clay();
  const auto has_softened    = [](double *internal, RandomNumbers &numbers) {
    internal[1] = numbers.uniform(0, 0.2);
    internal[2] = internal[1] + numbers.uniform(0, 0.05);
  };
  test<dim>(
      SofteningMohrCoulomb(soil), { "c 20 to 5 kPa", 1e-5, 0.02, 1e2, 1e4, 1, 1, 0.1, has_softened }, n, 1e-8, random);
  soil.friction_angle           = 35;
  soil.dilation_angle           = 10;
  soil.softening.friction_angle = 25;
  soil.softening.dilation_angle = 0;
  test<dim>(
      SofteningMohrCoulomb(soil), { "phi 35 to 25", 1e-5, 0.02, 1e2, 1e4, 1, 1, 0.1, has_softened }, n, 1e-8, random);

  MohrCoulombParameters place;
  place.cohesion_of_place     = "1e3";
  place.dilation_angle        = 10;
  const auto has_own_strength = [](double *internal, RandomNumbers &numbers) {
    internal[1] = std::max(0., numbers.uniform(-5e3, 2e4));
    internal[2] = numbers.uniform(0.2, 0.8);
  };
  test<dim>(VaryingMohrCoulomb(place),
            { "c and phi of the place", 1e-5, 0.02, 1e2, 1e4, 0.3, 1, 0.1, has_own_strength },
            n,
            1e-8,
            random);

  const auto has_strength = [](double *internal, RandomNumbers &numbers) {
    internal[2] = numbers.uniform(0, 0.5);
    internal[3] = numbers.uniform(1e4, 3e4);
  };
  TrescaParameters clay = sensitive_clay();
  clay.rate_increase    = 0.1;
  test<dim>(Tresca(clay), { "clay", 1e-5, 0.02, 1e2, 1e4, 0.5, 1, 0.1, has_strength, false }, n, 1e-8, random);
  clay.tension_cut_off = 2e3;
  test<dim>(
      Tresca(clay), { "clay with cut-off", 1e-5, 0.02, 1e2, 1e4, 0.5, 1, 0.1, has_strength, false }, n, 1e-8, random);
  HerschelBulkleyParameters mud;
  mud.strength    = 6e3;
  mud.consistency = 2e3;
  mud.index       = 0.5;
  test<dim>(Tresca(mud), { "mud", 1e-5, 0.02, 1e2, 1e4, 0.5, 1, 0.1, has_strength, false }, n, 1e-8, random);
}


/// The random volume ratio makes them dense grains or a suspension.
template <int dim>
void test_viscoinertial_grains(const unsigned int n, RandomNumbers &random)
{
  test<dim>(ViscoinertialGrains{ ViscoinertialGrainsParameters() },
            { "grains", 1e-6, 0.01, 1e1, 1e4, 0.6, 1, 0.1 },
            n,
            1e-8,
            random);
}


/// Denormal numbers, exact unity, and one point alone.
template <int dim, typename Law>
void test_odd(const Law &law)
{
  const OnePointMaterial<dim, Law> one_by_one(law);
  const HenckyMaterial<dim, Law> in_batches(law);
  States<dim> start(3);
  for (unsigned int p = 0; p < 3; ++p)
    {
      double stress[6] = { -1e3, -1e3, -1e3 }, *record = start.record(p);
      if (p == 2)
        stress[3] = 5e-324;
      one_by_one.initialise(stress, record, record + start.n_components, record + 2 * start.n_components);
      start.increment[p]       = unit_symmetric_tensor<dim>();
      start.increment[p][0][1] = p == 1 ? 5e-324 : 0.;
      start.volume_ratio[p] = start.reference_volume[p] = 1.;
    }
  States<dim> one = start, batch = start;
  const std::vector<unsigned int> slots = { 0, 1, 2 };
  one.update(one_by_one, slots, 0, 3);
  for (unsigned int p = 0; p < 3; ++p)
    batch.update(in_batches, slots, p, 1);
  require(difference(one, batch) < 1e-12, "odd states");
}


template <int dim>
void test_all()
{
  constexpr unsigned int n = 20000;
  RandomNumbers random;
  test_laws<dim>(n, random);
  test_mohr_coulomb<dim>(n, random);
  test_jefferies_been<dim>(n, random);
  test_falling_strength<dim>(n, random);
  test_viscoinertial_grains<dim>(n, random);
  test_odd<dim>(NorSand{ NorSandParameters() });
  test_odd<dim>(MohrCoulomb{ MohrCoulombParameters() });
  test_odd<dim>(JefferiesBeen{ JefferiesBeenParameters() });
}


const UnitTest registered("material_batches", [] {
  test_all<2>();
  test_all<3>();
});
} // namespace test_material_batches

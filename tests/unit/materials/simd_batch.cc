// SPDX-License-Identifier: LGPL-2.1-or-later
// Functions of a batch: to rounding, lane by lane whatever the other lanes hold, and as the C library's at odd input.
#include "../test.h"

#include <scree/simd/batch.h>

namespace test_simd_batch
{
/// Distance from the exact value in units of the last place.
double ulps(const double value, const long double exact)
{
  const double rounded = std::abs(static_cast<double>(exact));
  const double unit    = std::nextafter(rounded, std::numeric_limits<double>::infinity()) - rounded;
  return static_cast<double>(std::abs(static_cast<long double>(value) - exact) / unit);
}


template <typename Function, typename ScalarFunction, typename Exact>
void test_accuracy(const std::string &name,
                   const Function &function,
                   const ScalarFunction &scalar,
                   const Exact &exact,
                   const double bound,
                   const std::vector<double> &arguments)
{
  double worst = 0;
  for (std::size_t i = 0; i + batch_size <= arguments.size(); i += batch_size)
    {
      const Batch value = function(simd::load(&arguments[i]));
      for (unsigned int l = 0; l < batch_size; ++l)
        {
          const double x    = arguments[i + l];
          worst             = std::max({ worst, ulps(value[l], exact(x)), ulps(scalar(x), exact(x)) });
          const Batch alone = function(simd::broadcast<Batch>(x));
          require(alone[0] == value[l] && alone[batch_size - 1] == value[l], name + ": a lane depends on the others");
        }
    }
  require(worst < bound, name + " is wrong by " + std::to_string(worst) + " ulp");
}


/// Odd values beside a usual one, in turn in each lane: the same bits as the C library's, or not a number as there.
template <typename Function, typename Library>
void test_odd(const std::string &name,
              const Function &function,
              const Library &library,
              const double usual,
              const std::vector<double> &odd)
{
  for (const double x : odd)
    for (unsigned int l = 0; l < batch_size; ++l)
      {
        Batch batch       = simd::broadcast<Batch>(usual);
        batch[l]          = x;
        const Batch value = function(batch);
        require(std::isnan(library(x)) ? std::isnan(value[l]) : value[l] == library(x),
                name + " of " + std::to_string(x) + " is " + std::to_string(value[l]));
        for (unsigned int other = 0; other < batch_size; ++other)
          require(other == l || value[other] == function(simd::broadcast<Batch>(usual))[0],
                  name + ": an odd lane changes another one");
      }
}


template <typename Number>
struct OfNumbers
{
  Number value;
  simd::Mask<Number> mask;
};

/// What the laws do with numbers.
template <typename Number>
OfNumbers<Number> some_formula(const Number &x, const Number &y)
{
  Number z = -x * 2. + (3. - y) / (1. + simd::abs<Number>(x));
  z += simd::exp<Number>(0.5 * x) - simd::log<Number>(1. / simd::max<Number>(y * y, simd::broadcast<Number>(0.1)));
  z *= 1.5;
  const simd::Mask<Number> mask = ((x < y) & !(z >= 1.)) | (2. * x == y - 3.) | (x > 0.9) | (z <= -2.);
  return { simd::select<Number>(mask, z, simd::min<Number>(x, y - 0.5)), mask };
}


/// A pair of batches gives what each of them gives.
void test_pairs(RandomNumbers &random)
{
  for (unsigned int i = 0; i < 1000; ++i)
    {
      OfNumbers<Batch> x[2];
      for (auto &of_batch : x)
        {
          for (unsigned int l = 0; l < batch_size; ++l)
            of_batch.value[l] = random.uniform(-1, 1);
          of_batch.mask = of_batch.value > 0.;
        }
      const BatchPair x_of_two{ x[0].value, x[1].value };
      const auto of_two              = some_formula<BatchPair>(x_of_two, BatchPair{ x[1].value, x[0].value });
      const simd::BatchBits masks[2] = { of_two.mask.first, of_two.mask.second };
      unsigned int bits              = 0;
      for (unsigned int h = 0; h < 2; ++h)
        {
          const auto of_one = some_formula<Batch>(x[h].value, x[1 - h].value);
          bits |= simd::bits_of(of_one.mask) << h * batch_size;
          for (unsigned int l = 0; l < batch_size; ++l)
            require(std::abs(simd::half(of_two.value, h)[l] - of_one.value[l]) < 1e-14 &&
                        masks[h][l] == of_one.mask[l] &&
                        simd::lane(of_two.value, h * batch_size + l) == simd::half(of_two.value, h)[l],
                    "a pair is not its batches");
        }
      require(simd::bits_of(of_two.mask) == bits && simd::any(of_two.mask) == (bits != 0), "mask of a pair");
    }
}


const UnitTest registered("simd_batch", [] {
  RandomNumbers random;
  std::vector<double> exponents, positive, ratios;
  for (unsigned int i = 0; i < 200000; ++i)
    {
      exponents.push_back(i % 2 == 0 ? random.uniform(-707.9, 708.9) : random.uniform(-2, 2));
      positive.push_back(i % 2 == 0 ? random.log_uniform(1e-300, 1e300) : random.uniform(0.7, 1.4));
      ratios.push_back(i % 2 == 0 ? random.log_uniform(1e-3, 1e3) : random.uniform(0.9, 1.1));
    }
  const auto exp       = [](const auto &x) { return simd::exp(x); };
  const auto log       = [](const auto &x) { return simd::log(x); };
  const auto cube_root = [](const auto &x) { return simd::cube_root(x); };
  test_accuracy(
      "exp", exp, exp, [](const long double x) { return std::exp(x); }, 1.1, exponents);
  test_accuracy(
      "log", log, log, [](const long double x) { return std::log(x); }, 1., positive);
  test_accuracy(
      "cube root", cube_root, cube_root, [](const long double x) { return std::cbrt(x); }, 4., ratios);

  const double infinity = std::numeric_limits<double>::infinity(), nan = std::nan("");
  test_odd("exp",
           exp,
           [](const double x) { return std::exp(x); },
           0.3,
           { -708., -708.5, -745., -746., 709., 709.7, 710., 1e300, -1e300, infinity, -infinity, nan });
  test_odd("log",
           log,
           [](const double x) { return std::log(x); },
           0.3,
           { 0., -0., -1., 5e-324, 1e-310, 2.2e-308, infinity, -infinity, nan });
  test_odd("cube root", cube_root, [](const double x) { return std::cbrt(x); }, 1.01, { 0., -1., 1e-310, 1e300, nan });

  test_pairs(random);
});
} // namespace test_simd_batch

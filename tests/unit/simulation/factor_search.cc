// SPDX-License-Identifier: LGPL-2.1-or-later
// The search of a factor of safety, and the judgement of a trial from displacement and speed over time.
#include "../test.h"

#include <scree/input/input_error.h>
#include <scree/run/safety.h>

#include <sstream>

namespace test_factor_search
{
/// Of a slope that fails above `factor_of_safety`, and is stopped in the trial `n_trials`: the factors, and what
/// follows.
void search(const double tolerance,
            const double factor_of_safety,
            const std::string &factors,
            const std::string &expected,
            const unsigned int n_trials = 100)
{
  unsigned int n = 0;
  std::ostringstream tried, result;
  try
    {
      FactorBracket bracket;
      bracket.rests         = 0.25; // after settling
      const auto try_factor = [&](const double factor) {
        tried << (n == 0 ? "" : " ") << factor;
        const TrialEnd end = ++n == n_trials             ? TrialEnd::undecided
                             : factor > factor_of_safety ? TrialEnd::fails
                                                         : TrialEnd::rests;
        bracket.include(factor, end);
        return end;
      };
      result << (search_factor(tolerance, try_factor, bracket) ? "" : "stopped: ") << bracket.text() << ", "
             << bracket.n_left(tolerance) << " left";
    }
  catch (const EntryError &error)
    {
      result << error.what();
    }
  require(tried.str() == factors, "The factors are " + tried.str() + ", not " + factors);
  require(result.str() == expected, "It is said: " + result.str() + ", not " + expected);
}


/// Of soil that moves with a speed, m/s, which changes by the factor `growth` in a second: the end, and its time, s.
void judge(const double speed, const double growth, const TrialEnd expected, const double time)
{
  TrialJudge judge({ /* time_scale */ 1., /* speed */ 1e-3, /* displacement */ 0.2, /* maximum_time */ 40. });
  double displacement = 0.;
  TrialEnd end        = TrialEnd::undecided;
  unsigned int step   = 0;
  while (end == TrialEnd::undecided)
    {
      const double now = speed * std::pow(growth, 0.1 * ++step);
      displacement += 0.1 * now;
      end = judge.look(0.1 * step, displacement, now);
    }
  require(end == expected,
          "Another end of soil of " + std::to_string(speed) + " m/s, growing by " + std::to_string(growth));
  expect(0.1 * step, time, 1e-9, "time until a judgement, s");
}


const UnitTest registered("factor_search", [] {
  search(0.01, 1.374, "1 1.3 1.69 1.495 1.3975 1.34875 1.37312 1.38531 1.37922", "1.37312 to 1.37922, 0 left");
  search(0.01, 0.73, "1 0.625 0.8125 0.71875 0.765625 0.742188 0.730469 0.724609", "0.724609 to 0.730469, 0 left");
  search(0.01,
         3.83,
         "1 1.3 1.69 2.197 2.8561 3.71293 4.82681 4.26987 3.9914 3.85216 3.78255 3.81736 3.83476 3.82606",
         "3.82606 to 3.83476, 0 left");
  search(0.01, 1.374, "1 1.3", "stopped: above 1, 6 left", 2); // of 1.3, and log2(0.3/0.01) = 4.9
  search(0.01, 1.374, "1 1.3 1.69 1.495", "stopped: 1.3 to 1.69, 6 left", 4);
  search(0.1, 1.374, "1 1.3 1.69 1.495 1.3975", "1.3 to 1.3975, 0 left");
  search(50.,
         1e9,
         "1 1.3 1.69 2.197 2.8561 3.71293 4.82681 6.27485 8.15731 10.6045 13.7858 17.9216 23.2981 30.2875 39.3738 "
         "51.1859 66.5417 86.5042 112.455",
         "--safety: the soil still comes to rest with its strength divided by 112.455, so its own weight does not make "
         "it fail. Check that the \"Region\" of the bodies has a slope that no obstacle holds, and the direction of "
         "\"Gravity\".");

  judge(1e-3, 4., TrialEnd::fails, 4.1); // faster and faster
  judge(0.01, 1., TrialEnd::fails, 20.); // steady
  judge(2e-3, 1., TrialEnd::fails, 40.); // steady and too slow to come far
  judge(0.1, 0.4, TrialEnd::rests, 6.1); // slower and slower
  judge(0.5, 0.4, TrialEnd::fails, 0.6); // beyond the displacement before it rests
  judge(1e-4, 1., TrialEnd::rests, 1.1); // at rest
});
} // namespace test_factor_search

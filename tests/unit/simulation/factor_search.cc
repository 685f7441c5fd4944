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
void search(const SafetyParameters &safety,
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
      const auto try_factor = [&](const double factor) {
        tried << (n == 0 ? "" : " ") << factor;
        const TrialEnd end = ++n == n_trials             ? TrialEnd::undecided
                             : factor > factor_of_safety ? TrialEnd::fails
                                                         : TrialEnd::rests;
        bracket.include(factor, end);
        return end;
      };
      result << (search_factor(safety, try_factor, bracket) ? "" : "stopped: ") << bracket.text() << ", "
             << bracket.n_left(safety) << " left";
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
  SafetyParameters safety;
  const std::string larger = ": the slope still comes to rest with its strength divided by this. Write a larger one.";
  search(safety, 1.374, "0.5 1 1.3 1.69 1.495 1.3975 1.34875 1.37312 1.38531 1.37922", "1.37312 to 1.37922, 0 left");
  search(safety, 0.73, "0.5 1 0.75 0.625 0.6875 0.71875 0.734375 0.726562", "0.726562 to 0.734375, 0 left");
  const std::string up = "0.5 1 1.3 1.69 2.197 2.8561 3.71293 4.82681";
  search(safety, 3.83, up + " 4.26987 3.9914 3.85216 3.78255 3.81736 3.83476 3.82606", "3.82606 to 3.83476, 0 left");
  search(safety, 7., up + " 5", "subsection Safety, entry \"Upper factor\" = 5" + larger);
  search(safety, 1.374, "0.5 1 1.3", "stopped: above 1, 9 left", 3); // log2((5 - 1)/0.01) = 8.6
  search(safety, 1.374, "0.5 1 1.3 1.69 1.495", "stopped: 1.3 to 1.69, 6 left", 5);
  safety.lower     = 1.2;
  safety.upper     = 1.5;
  safety.tolerance = 0.1;
  search(safety, 1.374, "1.2 1.5 1.35 1.425", "1.35 to 1.425, 0 left");
  search(safety, 1.5, "1.2 1.5", "subsection Safety, entry \"Upper factor\" = 1.5" + larger);
  search(
      safety,
      1.1,
      "1.2",
      "subsection Safety, entry \"Lower factor\" = 1.2: the slope does not come to rest with its strength divided by "
      "this. Write a smaller one.");

  judge(1e-3, 4., TrialEnd::fails, 4.1); // faster and faster
  judge(0.01, 1., TrialEnd::fails, 20.); // steady
  judge(2e-3, 1., TrialEnd::fails, 40.); // steady and too slow to come far
  judge(0.1, 0.4, TrialEnd::rests, 6.1); // slower and slower
  judge(0.5, 0.4, TrialEnd::fails, 0.6); // beyond the displacement before it rests
  judge(1e-4, 1., TrialEnd::rests, 1.1); // at rest
});
} // namespace test_factor_search

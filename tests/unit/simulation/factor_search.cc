// SPDX-License-Identifier: LGPL-2.1-or-later

// The search of a factor of safety, and the judgement of a trial from displacement and speed over time.

#include <scree/input/input_error.h>
#include <scree/run/safety.h>

#include <cmath>
#include <iostream>

#include "../unit_test.h"

namespace test_factor_search
{
using namespace scree;

std::string text_of(const TrialEnd end)
{
  return end == TrialEnd::rests ? "rests" : end == TrialEnd::fails ? "fails" : "undecided";
}


/// Of a slope that fails above `factor_of_safety`, and is stopped in the trial `n_trials`.
void search(const SafetyParameters &safety, const double factor_of_safety, const unsigned int n_trials = 100)
{
  unsigned int n = 0;
  std::cout << "factor of safety " << factor_of_safety << ": ";
  try
    {
      const auto bracket = search_factor(safety, [&](const double factor) {
        std::cout << factor << ' ';
        return ++n == n_trials ? TrialEnd::undecided : factor > factor_of_safety ? TrialEnd::fails : TrialEnd::rests;
      });
      if (bracket)
        std::cout << "-> between " << bracket->rests << " and " << bracket->fails << '\n';
      else
        std::cout << "-> stopped\n";
    }
  catch (const EntryError &error)
    {
      std::cout << "\n  " << error.what() << '\n';
    }
}


/// Of soil that moves with a speed, m/s, which changes by the factor `growth` in a second.
void judge(const std::string &what, const double speed, const double growth)
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
  std::cout << what << ": " << text_of(end) << " after " << 0.1 * step << " s\n";
}


void run()
{
  SafetyParameters safety;
  search(safety, 1.374);
  search(safety, 0.73);
  search(safety, 3.83);
  search(safety, 7.);
  search(safety, 1.374, 4);
  safety.lower     = 1.2;
  safety.upper     = 1.5;
  safety.tolerance = 0.1;
  search(safety, 1.374);
  search(safety, 1.5);
  search(safety, 1.1);

  judge("faster and faster", 1e-3, 4.);
  judge("steady", 0.01, 1.);
  judge("steady and too slow to come far", 2e-3, 1.);
  judge("slower and slower", 0.1, 0.4);
  judge("beyond the displacement before it rests", 0.5, 0.4);
  judge("at rest", 1e-4, 1.);
}

const UnitTest registered("factor_search", run);
} // namespace test_factor_search

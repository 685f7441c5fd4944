// SPDX-License-Identifier: LGPL-2.1-or-later

// The search of a factor of safety, and the judgement of a trial from displacement and speed over time.
#include "../test.h"

#include <scree/input/input_error.h>
#include <scree/run/safety.h>

namespace test_factor_search
{
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


// clang-format off
// Output:
// factor of safety 1.374: 0.5 1 1.3 1.69 1.495 1.3975 1.34875 1.37312 1.38531 1.37922 -> between 1.37312 and 1.37922
// factor of safety 0.73: 0.5 1 0.75 0.625 0.6875 0.71875 0.734375 0.726562 -> between 0.726562 and 0.734375
// factor of safety 3.83: 0.5 1 1.3 1.69 2.197 2.8561 3.71293 4.82681 4.26987 3.9914 3.85216 3.78255 3.81736 3.83476 3.82606 -> between 3.82606 and 3.83476
// factor of safety 7: 0.5 1 1.3 1.69 2.197 2.8561 3.71293 4.82681 5 
//   subsection Safety, entry "Upper factor" = 5: the slope still comes to rest with its strength divided by this. Write a larger one.
// factor of safety 1.374: 0.5 1 1.3 1.69 -> stopped
// factor of safety 1.374: 1.2 1.5 1.35 1.425 -> between 1.35 and 1.425
// factor of safety 1.5: 1.2 1.5 
//   subsection Safety, entry "Upper factor" = 1.5: the slope still comes to rest with its strength divided by this. Write a larger one.
// factor of safety 1.1: 1.2 
//   subsection Safety, entry "Lower factor" = 1.2: the slope does not come to rest with its strength divided by this. Write a smaller one.
// faster and faster: fails after 4.1 s
// steady: fails after 20 s
// steady and too slow to come far: fails after 40 s
// slower and slower: rests after 6.1 s
// beyond the displacement before it rests: fails after 0.6 s
// at rest: rests after 1.1 s

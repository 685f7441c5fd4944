// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_advice_report_h
#define scree_advice_report_h

#include <scree/advice/cost.h>
#include <scree/advice/resolution.h>

#include <ostream>

namespace scree
{
  /// All that the text of an advice is made of.
  struct Advice
  {
    SceneNumbers scene;
    Observation seen;
    Schedule schedule;
    GridParameters grid;
    double accuracy      = 0;
    double settling_time = 0; ///< s, at most
    unsigned int n_ranks = 1;
    unsigned int coarser = 1; ///< how many times as wide the cells were in the first steps that were taken
    double pilot_coarser = 0; ///< and in the pilot; 0: there was none
    std::string pilot_fault;  ///< what kept it from its end
  };

  /// Writes groups, size, cost and recommendation, a line a number with its unit.
  void write_report(const Advice &advice, std::ostream &out);
} // namespace scree

#endif

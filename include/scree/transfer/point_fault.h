// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_transfer_point_fault_h
#define scree_transfer_point_fault_h

#include <stdexcept>
#include <string>

namespace scree
{
  /// A point that cannot follow its nodes in a step.
  class PointFault : public std::runtime_error
  {
  public:
    /// @param point body, number and place
    /// @param what what is wrong, and what to try
    PointFault(const std::string &point, const std::string &what)
        : std::runtime_error(point + ": " + what)
        , point(point)
        , fault(what)
    {
    }

    /// The whole message, with the time, s, in words.
    std::string text(const std::string &time) const
    {
      return point + ", t = " + time + " s: " + fault;
    }

  private:
    const std::string point, fault;
  };
} // namespace scree

#endif

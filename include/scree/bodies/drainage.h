// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_bodies_drainage_h
#define scree_bodies_drainage_h

namespace scree
{
  /// What the pore water does while the soil settles.
  enum class Drainage
  {
    undrained, ///< it moves, and its pressure follows from the motion
    drained    ///< it keeps its place and its pressure
  };
} // namespace scree

#endif

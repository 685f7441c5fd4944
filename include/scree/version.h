// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_version_h
#define scree_version_h

#include <string>

/// All of Scree: a material point code for landslides in soil and water.
namespace scree
{
  /// What this program is and what it was built with: lines such as
  ///   Scree 0.9.0 (commit 1a2b3c4-dirty)
  ///   deal.II 9.4.1, Trilinos 13.2.0, p4est 2.2.0
  ///   GNU 12.2.0, Release
  /// The commit is "unknown" if the sources were no git repository; "-dirty": files differed from the commit.
  std::string version_text();

  /// The compiler's flags but for warnings, such as -O3 -fno-math-errno -march=native.
  std::string compiler_flags();
} // namespace scree

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/version.h>

#include <deal.II/base/config.h>

#include <commit.h>
#include <sstream>

namespace scree
{
  std::string version_text()
  {
    std::ostringstream text;
    text << "Scree " SCREE_VERSION " (commit " << commit << ")\n"
         << "deal.II " DEAL_II_PACKAGE_VERSION ", Trilinos " //
         << DEAL_II_TRILINOS_VERSION_MAJOR << '.' << DEAL_II_TRILINOS_VERSION_MINOR << '.'
         << DEAL_II_TRILINOS_VERSION_SUBMINOR << ", p4est " //
         << DEAL_II_P4EST_VERSION_MAJOR << '.' << DEAL_II_P4EST_VERSION_MINOR << '.' << DEAL_II_P4EST_VERSION_SUBMINOR
         << ", GDAL " SCREE_GDAL "\n"
         << SCREE_COMPILER ", " SCREE_BUILD_TYPE "\n";
    return text.str();
  }


  std::string compiler_flags()
  {
    return SCREE_FLAGS;
  }
} // namespace scree

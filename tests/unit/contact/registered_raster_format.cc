// SPDX-License-Identifier: LGPL-2.1-or-later
// A format of rasters of one file: registered here, it reads files of its ending, which are text like an ASCII grid;
// other files are read as before.
#include "../unit_test.h"

#include <scree/geometry/raster_format.h>

#include <deal.II/base/exceptions.h>

#include <fstream>
#include <iostream>

namespace test_registered_raster_format
{
using namespace scree;

/// Heights along a line, in the north the same as in the south.
RasterClaim claim_heights(std::istream &, const std::string &file)
{
  const std::string ending = ".heights";
  const bool has_ending =
      file.size() > ending.size() && file.compare(file.size() - ending.size(), ending.size(), ending) == 0;
  return has_ending ? RasterClaim::ending : RasterClaim::none;
}

Raster read_heights(std::istream &in, const std::string &, const std::string &)
{
  Raster raster;
  raster.spacing = 10.;
  raster.n_rows  = 2;
  for (double height; in >> height; ++raster.n_columns)
    raster.values.push_back(height);
  raster.values.insert(raster.values.end(), raster.values.begin(), raster.values.begin() + raster.n_columns);
  return raster;
}

const RegisterRasterFormat registered("heights", claim_heights, read_heights);


void run()
{
  std::ofstream("line.heights") << "1 2 4 8\n";
  std::ofstream("grid.asc") << "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 2\n1 2\n3 4\n";
  for (const std::string file : { "line.heights", "grid.asc" })
    {
      const Raster raster = read_raster(file, "entry \"Raster\"", { 5., 0. });
      std::cout << raster.n_columns << " x " << raster.n_rows << " from " << raster.x << ' ' << raster.y
                << ", mean of four: " << raster.value_at(raster.x + raster.spacing / 2, raster.y + raster.spacing / 2)
                << '\n';
    }
}

const UnitTest registered_test("registered_raster_format", run);
} // namespace test_registered_raster_format

// SPDX-License-Identifier: LGPL-2.1-or-later
// Values of a raster that a text gives, after what GDAL lets a file say of them: NODATA that is rounded otherwise,
// scale, offset, unit, mask and alpha band; and a table of places from the south. (Rasters that are written and read
// again: cases/maps_geo_tiff.)
#include "../test.h"

#include <scree/geometry/raster.h>

#include <fstream>

namespace test_raster_files
{
/// The raster of a file is `raster`.
void expect_raster(const std::string &file, const Raster &raster)
{
  const Raster found = read_raster(file, "entry", { 0., 0. });
  require(found.n_columns == raster.n_columns && found.n_rows == raster.n_rows, file + ": another size");
  expect(std::abs(found.x - raster.x) + std::abs(found.y - raster.y) + std::abs(found.spacing - raster.spacing),
         0.,
         1e-8,
         file + ": error of the place");
  for (std::size_t i = 0; i < raster.values.size(); ++i)
    if (std::isnan(raster.values[i]))
      require(std::isnan(found.values[i]), file + ": a value that is missing");
    else
      expect(
          found.values[i], raster.values[i], 1e-15 * std::abs(raster.values[i]), file + ": value " + std::to_string(i));
}


const UnitTest registered_test("raster_files", [] {
  const std::string head = "ncols 4\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n";
  std::ofstream("rounded.asc") << head << "NODATA_value -3.4028234663852886e+38\n"
                               << "0.1 -3.40282346639e+38 1e31 nan\n100.123456789012 1 1 -9999\n";
  std::ofstream("values.asc") << head << "1 2 3 4\n5 6 7 8\n";
  std::ofstream("mask.asc") << head << "1 0 1 1\n1 1 1 0\n";
  std::ofstream("places.xyz") << "0 0 1\n1 0 2\n0 1 3\n1 1 4\n";
  const auto band = [](const int number, const std::string &file, const std::string &more) {
    return std::string("<VRTRasterBand dataType=\"") + (number == 1 ? "Float64" : "Byte") + "\" band=\"" +
           std::to_string(number) + "\">" + more + "<SimpleSource><SourceFilename relativeToVRT=\"1\">" + file +
           "</SourceFilename></SimpleSource></VRTRasterBand>";
  };
  const std::string begin = R"(<VRTDataset rasterXSize="4" rasterYSize="2"><GeoTransform>0,1,0,2,0,-1</GeoTransform>)",
                    end   = "</VRTDataset>";
  std::ofstream("alpha.vrt") << begin << band(1, "values.asc", "<UnitType>Metre</UnitType>")
                             << band(2, "mask.asc", "<ColorInterp>Alpha</ColorInterp>") << end;
  std::ofstream("mask.vrt") << begin << band(1, "values.asc", "<Offset>0.5</Offset><Scale>0.1</Scale>") << "<MaskBand>"
                            << band(1, "mask.asc", "") << "</MaskBand>" << end;
  const double none = std::numeric_limits<double>::quiet_NaN();
  Raster raster;
  raster.n_columns = 4;
  raster.n_rows    = 2;
  raster.spacing   = 1.;
  raster.x = raster.y = 0.5;
  raster.values       = { 100.123456789012, 1., 1., -9999., 0.1, none, none, none };
  expect_raster("rounded.asc", raster);
  raster.values = { 5., 6., 7., none, 1., none, 3., 4. };
  expect_raster("alpha.vrt", raster);
  for (double &value : raster.values)
    value = 0.5 + 0.1 * value;
  expect_raster("mask.vrt", raster);
  raster.n_columns = 2;
  raster.x = raster.y = 0.;
  raster.values       = { 1., 2., 3., 4. };
  expect_raster("places.xyz", raster);
});
} // namespace test_raster_files

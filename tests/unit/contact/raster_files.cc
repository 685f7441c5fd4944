// SPDX-License-Identifier: LGPL-2.1-or-later
// Rasters that are written and read again, in each format: values, place, missing values and coordinate system. Names
// of one system differ by program.
#include "../test.h"

#include <scree/geometry/raster.h>

#include <fstream>

namespace test_raster_files
{
Raster some_raster(const std::string &system)
{
  Raster raster;
  raster.n_columns = 3;
  raster.n_rows    = 2;
  raster.spacing   = 2.5;
  raster.x         = 2600001.25;
  raster.y         = 1200001.25;
  raster.system    = system;
  raster.values    = { 0., 0.5, std::numeric_limits<double>::quiet_NaN(), 4., -1.25, 1024. };
  return raster;
}


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
  require(raster.system.empty() || is_same_system(found.system, raster.system, { raster.x, raster.y }),
          file + ": another system");
}


/// Values that a text gives, after what GDAL lets a file say of them: NODATA that is rounded otherwise,
/// scale, offset, unit, mask and alpha band; and a table of places from the south.
void read_marked_values()
{
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
}


const UnitTest registered_test("raster_files", [] {
  const std::string system = R"(PROJCS["CH1903+_LV95",GEOGCS["GCS_CH1903+",DATUM["D_CH1903+",)"
                             R"(SPHEROID["Bessel_1841",6377397.155,299.1528128]],PRIMEM["Greenwich",0.0],)"
                             R"(UNIT["Degree",0.0174532925199433]],)"
                             R"(PROJECTION["Hotine_Oblique_Mercator_Azimuth_Center"],)"
                             R"(PARAMETER["False_Easting",2600000.0],PARAMETER["False_Northing",1200000.0],)"
                             R"(PARAMETER["Scale_Factor",1.0],PARAMETER["Azimuth",90.0],)"
                             R"(PARAMETER["Longitude_Of_Center",7.43958333333333],)"
                             R"(PARAMETER["Latitude_Of_Center",46.9524055555556],UNIT["Meter",1.0]])";
  const Raster raster      = some_raster(system);
  require(ascii_grid(raster) == "ncols 3\nnrows 2\nxllcorner 2600000\nyllcorner 1200000\ncellsize 2.5\n"
                                "NODATA_value -9999\n4 -1.25 1024\n0 0.5 -9999\n",
          "The ASCII grid is\n" + ascii_grid(raster));
  std::ofstream("map.asc") << ascii_grid(raster);
  std::ofstream("map.prj") << prj_text(system) << '\n';
  expect_raster("map.asc", raster);
  std::ofstream("map.tif", std::ios::binary) << geo_tiff(raster, "thickness", "m");
  expect_raster("map.tif", raster);
  std::ofstream("code.tif", std::ios::binary) << geo_tiff(some_raster("EPSG:31254"), "thickness", "m");
  const std::string lv95    = read_raster("map.tif", "entry", { 0., 0. }).system,
                    austria = read_raster_system("code.tif", "entry");
  require(lv95 == "EPSG:2056" && austria == "EPSG:31254", "systems of GeoTIFF: " + lv95 + ", " + austria);
  require(is_same_system(prj_text("EPSG:31254"), "EPSG:31254", { 0., 2e5 }) &&
              !is_same_system(system, "EPSG:31254", { 0., 2e5 }) &&
              is_same_system(system, R"(PROJCS["CH1903+ / LV95"])", { 0., 0. }) &&
              !is_same_system(system, R"(PROJCS["MGI_Austria_GK_West"])", { 0., 0. }),
          "systems under their names and codes");
  require(name_of_system(system) == "CH1903+_LV95" && name_of_system("EPSG:2056") == "EPSG:2056", "names of systems");
  read_marked_values();
});
} // namespace test_raster_files

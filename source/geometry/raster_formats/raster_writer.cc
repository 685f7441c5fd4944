// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/geometry/raster_formats/quiet_gdal.h>
#include <scree/geometry/raster_formats/raster_writer.h>

#include <deal.II/base/exceptions.h>

#include <cmath>
#include <cpl_vsi.h>
#include <gdal_priv.h>
#include <iomanip>
#include <memory>
#include <ogr_spatialref.h>
#include <sstream>

namespace scree
{
  std::string ascii_grid(const Raster &raster)
  {
    std::ostringstream text;
    text << std::setprecision(15) << "ncols " << raster.n_columns << "\nnrows " << raster.n_rows << "\nxllcorner "
         << raster.x - 0.5 * raster.spacing << "\nyllcorner " << raster.y - 0.5 * raster.spacing << "\ncellsize "
         << raster.spacing << "\nNODATA_value " << missing_value << '\n'
         << std::setprecision(9);
    for (unsigned int row = raster.n_rows; row-- > 0;) // from the north
      for (unsigned int column = 0; column < raster.n_columns; ++column)
        {
          const double value = raster(column, row);
          text << (std::isnan(value) ? missing_value : value) << (column + 1 < raster.n_columns ? ' ' : '\n');
        }
    return text.str();
  }


  namespace
  {
    /// The system of a raster, by its code if the EPSG has one for it, which other programs then read, too.
    OGRSpatialReference system_of(const Raster &raster)
    {
      constexpr int confident = 90; // %, of the match
      OGRSpatialReference system;
      if (system.SetFromUserInput(raster.system.c_str()) != OGRERR_NONE)
        return OGRSpatialReference();
      int n_matches = 0, *confidence = nullptr;
      OGRSpatialReferenceH *matches =
          system.GetAuthorityCode(nullptr) == nullptr ? system.FindMatches(nullptr, &n_matches, &confidence) : nullptr;
      if (n_matches > 0 && confidence[0] >= confident)
        system = *OGRSpatialReference::FromHandle(matches[0]);
      OSRFreeSRSArray(matches);
      CPLFree(confidence);
      return system;
    }
  } // namespace


  std::string geo_tiff(const Raster &raster, const std::string &name, const std::string &unit)
  {
    GDALAllRegister();
    const QuietGdal quiet;
    const char *const file = "/vsimem/scree_map.tif"; // in memory
    const char *options[]  = { "COMPRESS=DEFLATE", nullptr };
    std::unique_ptr<GDALDataset> data(GetGDALDriverManager()->GetDriverByName("GTiff")->Create(
        file, raster.n_columns, raster.n_rows, 1, GDT_Float32, const_cast<char **>(options)));
    AssertThrow(data, dealii::ExcMessage("GDAL cannot make a GeoTIFF: " + std::string(CPLGetLastErrorMsg())));
    double map[6] = {
      raster.x - 0.5 * raster.spacing, raster.spacing, 0., raster.last_y() + 0.5 * raster.spacing, 0., -raster.spacing
    };
    data->SetGeoTransform(map);
    if (!raster.system.empty())
      {
        const OGRSpatialReference system = system_of(raster);
        data->SetSpatialRef(&system);
      }
    GDALRasterBand &band = *data->GetRasterBand(1);
    band.SetNoDataValue(missing_value);
    band.SetDescription(name.c_str());
    band.SetUnitType(unit.c_str());
    std::vector<float> values(raster.n_columns);
    bool is_written = true;
    for (unsigned int row = 0; row < raster.n_rows; ++row) // from the north
      {
        for (unsigned int column = 0; column < raster.n_columns; ++column)
          {
            const double value = raster(column, raster.n_rows - 1 - row);
            values[column]     = static_cast<float>(std::isnan(value) ? missing_value : value);
          }
        is_written = band.RasterIO(GF_Write,
                                   0,
                                   row,
                                   raster.n_columns,
                                   1,
                                   values.data(),
                                   raster.n_columns,
                                   1,
                                   GDT_Float32,
                                   0,
                                   0,
                                   nullptr) == CE_None &&
                     is_written;
      }
    data.reset(); // completes the file
    vsi_l_offset size = 0;
    GByte *bytes      = VSIGetMemFileBuffer(file, &size, TRUE);
    const std::string content(reinterpret_cast<const char *>(bytes), bytes ? size : 0);
    VSIFree(bytes);
    AssertThrow(is_written && bytes, dealii::ExcMessage("GDAL has no room for a GeoTIFF."));
    return content;
  }
} // namespace scree

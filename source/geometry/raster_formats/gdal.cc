// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/geometry/raster_format.h>
#include <scree/geometry/raster_formats/coordinate_system.h>
#include <scree/input/input_error.h>

#include <cmath>
#include <limits>
#include <memory>

#ifdef SCREE_WITH_GDAL
#  include <scree/geometry/raster_formats/quiet_gdal.h>

#  include <gdal_priv.h>
#  include <ogr_spatialref.h>
#endif

namespace scree
{
  namespace
  {
#ifdef SCREE_WITH_GDAL
    void require_metres(const GDALDataset &data, const std::string &name)
    {
      const OGRSpatialReference *system = data.GetSpatialRef();
      if (system == nullptr)
        return;
      if (system->IsGeographic())
        throw EntryError(name +
                         "it is in degrees. Write one in a projected system of coordinates, in m: gdalwarp -t_srs "
                         "EPSG:number makes one.");
      const double unit = system->GetLinearUnits();
      if (std::abs(unit - 1.) > 1e-9)
        throw EntryError(name + "its unit of length is " + number_text(unit) +
                         " m. Write one in a system of coordinates in m: gdalwarp -t_srs EPSG:number makes one.");
    }


    std::unique_ptr<GDALDataset> open(const std::string &file, const std::string &name)
    {
      GDALAllRegister();
      std::unique_ptr<GDALDataset> data(
          GDALDataset::Open(file.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY, nullptr, nullptr, nullptr));
      if (!data || data->GetRasterCount() < 1)
        throw EntryError(name + "GDAL finds no raster in it: " + CPLGetLastErrorMsg());
      return data;
    }


    std::string system_of_gdal_raster(const std::string &file, const std::string &name)
    {
      const QuietGdal quiet;
      const auto data                   = open(file, name);
      const OGRSpatialReference *system = data->GetSpatialRef();
      return system == nullptr ? "" : text_of_system(*system);
    }


    /// Reads the first band of a raster in any format that GDAL knows, such as GeoTIFF. Throws EntryError if there is
    /// none, or if it is not in m along the axes of a projected system of coordinates.
    Raster read_gdal_raster(std::istream &, const std::string &file, const std::string &name)
    {
      const QuietGdal quiet;
      const auto data = open(file, name);
      require_metres(*data, name);
      double map[6]; // x = map[0] + map[1] column + map[2] row, y = map[3] + map[4] column + map[5] row
      if (data->GetGeoTransform(map) != CE_None)
        throw EntryError(name + "it does not say where it lies. Write one with coordinates: gdal_translate -a_ullr "
                                "x_min y_max x_max y_min sets them.");
      if (!(map[2] == 0. && map[4] == 0. && map[1] > 0. && std::abs(map[1] + map[5]) < 1e-9 * map[1]))
        throw EntryError(name +
                         "its cells must be squares along the axes, the first row in the north. gdalwarp -tr size "
                         "size makes one.");
      Raster raster;
      raster.n_columns = data->GetRasterXSize();
      raster.n_rows    = data->GetRasterYSize();
      if (raster.n_columns < 2 || raster.n_rows < 2)
        throw EntryError(name + "it must have 2 columns and 2 rows at least.");
      raster.spacing = map[1];
      raster.x       = map[0] + 0.5 * map[1];
      raster.y       = map[3] + (raster.n_rows - 0.5) * map[5];

      GDALRasterBand &band = *data->GetRasterBand(1);
      int has_missing;
      const double missing = band.GetNoDataValue(&has_missing), factor = band.GetScale(), offset = band.GetOffset();
      raster.values.resize(std::size_t(raster.n_columns) * raster.n_rows);
      for (unsigned int row = 0; row < raster.n_rows; ++row)
        {
          double *values = &raster.values[std::size_t(raster.n_rows - 1 - row) * raster.n_columns]; // from the north
          if (band.RasterIO(
                  GF_Read, 0, row, raster.n_columns, 1, values, raster.n_columns, 1, GDT_Float64, 0, 0, nullptr) !=
              CE_None)
            throw EntryError(name + "GDAL cannot read row " + std::to_string(row + 1) + ": " + CPLGetLastErrorMsg());
          for (unsigned int column = 0; column < raster.n_columns; ++column)
            values[column] = (has_missing && values[column] == missing) || !std::isfinite(values[column])
                                 ? std::numeric_limits<double>::quiet_NaN()
                                 : factor * values[column] + offset;
        }
      return raster;
    }

#else
    std::string system_of_gdal_raster(const std::string &, const std::string &)
    {
      return ""; // read_gdal_raster() tells why
    }


    Raster read_gdal_raster(std::istream &, const std::string &, const std::string &name)
    {
      throw EntryError(name + "it is no ESRI ASCII grid, and this program was built without GDAL, which reads others. "
                              "Convert it (gdal_translate -of AAIGrid IN OUT), or install libgdal-dev and build anew.");
    }
#endif


    RasterClaim claim_by_gdal(std::istream &, const std::string &)
    {
      return RasterClaim::any;
    }


    const RegisterRasterFormat registered_gdal("GDAL", claim_by_gdal, read_gdal_raster, system_of_gdal_raster);
  } // namespace
} // namespace scree

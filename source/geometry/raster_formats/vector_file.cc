// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/geometry/outline.h>
#include <scree/geometry/raster_formats/coordinate_system.h>
#include <scree/geometry/raster_formats/quiet_gdal.h>
#include <scree/input/input_error.h>
#include <scree/input/number_table.h>

#include <filesystem>
#include <gdal_priv.h>
#include <memory>
#include <ogr_spatialref.h>
#include <ogrsf_frmts.h>
#include <utility>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// Corners of closed lines, m on the map, the first one of each at its end again: of an area, the edge and the
    /// holes.
    using Rings = std::vector<std::vector<Point<2>>>;

    std::unique_ptr<GDALDataset> open(const std::string &file, const std::string &name)
    {
      GDALAllRegister();
      std::unique_ptr<GDALDataset> data(
          GDALDataset::Open(file.c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY, nullptr, nullptr, nullptr));
      if (!data)
        throw EntryError(name + "GDAL cannot read it: " + CPLGetLastErrorMsg());
      return data;
    }


    /// The one layer with geometry: a GeoPackage of QGIS has one of styles, too.
    OGRLayer &only_layer(GDALDataset &data, const std::string &name)
    {
      std::vector<OGRLayer *> layers;
      for (OGRLayer *layer : data.GetLayers())
        if (layer->GetGeomType() != wkbNone)
          layers.push_back(layer);
      if (layers.size() != 1)
        throw EntryError(name + "it has " + std::to_string(layers.size()) +
                         " layers with geometry. Write a file with one layer of polygons.");
      return *layers.front();
    }


    /// Adds the polygons of a geometry and of its parts.
    void collect(const OGRGeometry &geometry, const std::string &name, std::vector<Rings> &areas)
    {
      const OGRwkbGeometryType type = wkbFlatten(geometry.getGeometryType());
      if (type == wkbPolygon)
        {
          areas.emplace_back();
          for (const OGRLinearRing *ring : *geometry.toPolygon())
            {
              areas.back().emplace_back();
              for (int i = 0; i < ring->getNumPoints(); ++i)
                areas.back().back().emplace_back(ring->getX(i), ring->getY(i));
            }
        }
      else if (type == wkbMultiPolygon || type == wkbGeometryCollection)
        for (const OGRGeometry *part : *geometry.toGeometryCollection())
          collect(*part, name, areas);
      else
        throw EntryError(name + "it has geometry of type " + OGRGeometryTypeToName(type) +
                         ". Write polygons only: areas that the body occupies.");
    }


    /// Areas of a file in a vector format of GDAL, those of multi-polygons one by one. Throws EntryError if there is
    /// none or anything else.
    std::vector<Rings> read_polygons(const std::string &file, const std::string &name)
    {
      const QuietGdal quiet;
      const auto data = open(file, name);
      std::vector<Rings> areas;
      for (const auto &feature : only_layer(*data, name))
        if (const OGRGeometry *geometry = feature->GetGeometryRef(); geometry != nullptr && !geometry->IsEmpty())
          collect(*geometry, name, areas);
      if (areas.empty())
        throw EntryError(name + "it has no polygon. Draw the area that the body occupies.");
      return areas;
    }


    /// The coordinate system of such a file; empty if it has none.
    std::string system_of_vector_file(const std::string &file, const std::string &name)
    {
      const QuietGdal quiet;
      const auto data                   = open(file, name);
      OGRLayer &layer                   = only_layer(*data, name);
      const OGRSpatialReference *system = layer.GetSpatialRef();
      if (system == nullptr)
        return "";
      // GDAL takes a GeoJSON file that names no system for one in degrees, as its standard does; in m it cannot be.
      OGREnvelope box;
      const bool is_known = layer.GetExtent(&box) == OGRERR_NONE;
      if (system->IsGeographic() && is_known &&
          (box.MinX < -360. || box.MaxX > 360. || box.MinY < -90. || box.MaxY > 90.))
        return "";
      return text_of_system(*system);
    }


    /// Whether GDAL reads the file, or its name says so; else it is a text of corners, which may look like a CSV file.
    bool is_vector_file(const std::string &file)
    {
      GDALAllRegister();
      const QuietGdal quiet;
      const std::string ending = lower_case(std::filesystem::path(file).extension().string());
      const GDALDriverH driver = GDALIdentifyDriverEx(file.c_str(), GDAL_OF_VECTOR, nullptr, nullptr);
      return (driver != nullptr && GDALGetDriverShortName(driver) != std::string("CSV")) || ending == ".geojson" ||
             ending == ".json" || ending == ".shp" || ending == ".gpkg";
    }
  } // namespace


  Outline read_outline(const std::string &file, const std::string &where, const Point<2> &origin)
  {
    std::vector<std::vector<Polygon>> areas;
    if (!is_vector_file(file))
      {
        areas.push_back({ read_polygon(file, where, origin) });
        return Outline(std::move(areas));
      }
    const std::string name = where + " = " + file + ": ";
    open_file(file, name);
    for (const Rings &rings : read_polygons(file, name))
      {
        areas.emplace_back();
        for (auto corners : rings)
          {
            for (Point<2> &corner : corners)
              corner -= origin - Point<2>();
            areas.back().push_back(
                checked_polygon(std::move(corners), name + "polygon " + std::to_string(areas.size()) + ", "));
          }
      }
    return Outline(std::move(areas));
  }


  std::string read_outline_system(const std::string &file, const std::string &where)
  {
    const std::string name = where + " = " + file + ": ";
    if (!is_vector_file(file))
      return "";
    open_file(file, name);
    return system_of_vector_file(file, name);
  }
} // namespace scree

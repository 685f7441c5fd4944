// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/geometry/drawing.h>
#include <scree/geometry/raster.h>
#include <scree/input/input_file.h>
#include <scree/input/number_table.h>

#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// As areas, of which those that overlap or touch are one.
    std::shared_ptr<OGRMultiPolygon> united(const OGRMultiPolygon &areas)
    {
      return std::shared_ptr<OGRMultiPolygon>(
          OGRGeometryFactory::forceToMultiPolygon(areas.getNumGeometries() > 1 ? areas.UnionCascaded() : areas.clone())
              ->toMultiPolygon());
    }


    OGRPolygon polygon_of(const OGRLineString &edge)
    {
      OGRLinearRing ring;
      ring.addSubLineString(&edge);
      ring.closeRings();
      OGRPolygon polygon;
      polygon.addRing(&ring);
      return polygon;
    }


    /// Throws EntryError, which begins with `name`, if edges cross or touch, or corners are missing.
    void require_area(const OGRPolygon &area, const std::string &name)
    {
      const int n_corners = area.IsEmpty() ? 0 : area.getExteriorRing()->getNumPoints() - 1;
      if (n_corners < 3)
        throw EntryError(name + "it has " + std::to_string(n_corners) +
                         " corners. Write three or more, x, y in m, one a line, in their order around the place.");
      const CPLErrorHandlerPusher quiet(CPLQuietErrorHandler);
      if (area.IsValid())
        return;
      std::string reason       = CPLGetLastErrorMsg(); // "Self-intersection at or near point 1 2"
      const std::string before = " at or near point ";
      if (const auto place = reason.find(before); place != std::string::npos)
        {
          std::istringstream words(reason.substr(place + before.size()));
          Point<2> x;
          words >> x[0] >> x[1];
          reason = reason.substr(0, place) + " at " + number_text(x) + " m";
        }
      throw EntryError(name + "its edge is not that of an area: " + reason +
                       ". Draw the corners in their order around the place, without crossings.");
    }


    std::unique_ptr<GDALDataset> open(const std::string &file, const std::string &name)
    {
      GDALAllRegister();
      std::unique_ptr<GDALDataset> data(
          GDALDataset::Open(file.c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY, nullptr, nullptr, nullptr));
      if (!data)
        throw EntryError(name + "GDAL reads no shapes from it. " + CPLGetLastErrorMsg() +
                         " Write GeoJSON, GeoPackage, a shapefile, DXF or CSV.");
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


    /// Areas of a file in a vector format of GDAL, those of multi-polygons one by one, and the attribute `thickness` of
    /// each, m; no thickness if none has it. Throws EntryError if there is none or anything else.
    std::pair<OGRMultiPolygon, std::vector<double>> read_polygons(const std::string &file, const std::string &name)
    {
      const CPLErrorHandlerPusher quiet(CPLQuietErrorHandler);
      const auto data = open(file, name);
      OGRMultiPolygon areas;
      std::vector<double> thickness;
      bool is_known = false;
      for (const auto &feature : only_layer(*data, name))
        if (const OGRGeometry *geometry = feature->GetGeometryRef(); geometry != nullptr && !geometry->IsEmpty())
          {
            const std::unique_ptr<OGRGeometry> shape(
                OGRGeometryFactory::forceToMultiPolygon(geometry->getLinearGeometry()));
            if (wkbFlatten(shape->getGeometryType()) != wkbMultiPolygon)
              throw EntryError(name + "it has geometry of type " + OGRGeometryTypeToName(shape->getGeometryType()) +
                               ". Write polygons only: areas that the body occupies.");
            for (const OGRPolygon *area : *shape->toMultiPolygon())
              areas.addGeometry(area);
            const int field        = feature->GetFieldIndex("thickness"); // in any case of its letters
            const std::string text = field >= 0 ? feature->GetFieldAsString(field) : "";
            is_known               = is_known || !text.empty();
            thickness.resize(areas.getNumGeometries(), number_of(text));
          }
      if (areas.IsEmpty())
        throw EntryError(name + "it has no polygon. Draw the area that the body occupies.");
      for (std::size_t i = 0; is_known && i < thickness.size(); ++i)
        if (!(thickness[i] >= 0.))
          throw EntryError(name + "the attribute thickness of polygon " + std::to_string(i + 1) +
                           " is no number from 0 on, in m. Write it for all polygons, or remove the attribute.");
      return { areas, is_known ? thickness : std::vector<double>() };
    }


    /// The coordinate system of such a file; empty if it has none.
    std::string system_of_vector_file(const std::string &file, const std::string &name)
    {
      const CPLErrorHandlerPusher quiet(CPLQuietErrorHandler);
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
      const CPLErrorHandlerPusher quiet(CPLQuietErrorHandler);
      const std::string ending = lower_case(std::filesystem::path(file).extension().string());
      const GDALDriverH driver = GDALIdentifyDriverEx(file.c_str(), GDAL_OF_VECTOR, nullptr, nullptr);
      return (driver != nullptr && GDALGetDriverShortName(driver) != std::string("CSV")) || ending == ".geojson" ||
             ending == ".json" || ending == ".shp" || ending == ".gpkg";
    }
  } // namespace


  Outline::Area::Area(const OGRPolygon &polygon, const Point<2> &origin)
  {
    constexpr std::size_t most_bands = 1024;
    for (const OGRLinearRing *ring : polygon)
      for (int i = 1; i < ring->getNumPoints(); ++i)
        edges.emplace_back(Point<2>(ring->getX(i - 1) - origin[0], ring->getY(i - 1) - origin[1]),
                           Point<2>(ring->getX(i) - origin[0], ring->getY(i) - origin[1]));
    std::vector<Point<2>> corners;
    for (const auto &edge : edges)
      corners.push_back(edge.first);
    box = BoundingBox<2>(corners);
    bands.resize(std::min(edges.size(), most_bands));
    for (unsigned int e = 0; e < edges.size(); ++e)
      {
        const auto [lower, upper] = std::minmax(edges[e].first[1], edges[e].second[1]);
        for (std::size_t band = band_at(lower); band <= band_at(upper); ++band)
          bands[band].push_back(e);
      }
  }


  std::size_t Outline::Area::band_at(const double y) const
  {
    const double part = (y - box.lower_bound(1)) / box.side_length(1) * bands.size();
    return std::clamp<long>(part, 0, bands.size() - 1);
  }


  bool Outline::Area::contains(const Point<2> &x) const
  {
    if (!box.point_inside(x))
      return false;
    bool result = false; // a ray along x crosses an odd number of edges
    for (const unsigned int e : bands[band_at(x[1])])
      {
        const auto &[a, b] = edges[e];
        if ((a[1] > x[1]) != (b[1] > x[1]) && x[0] < a[0] + (x[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0]))
          result = !result;
      }
    return result;
  }


  Outline::Outline(const OGRMultiPolygon &areas, const Point<2> &origin, std::vector<double> thickness)
      : thickness(std::move(thickness))
      , sum_of_areas(areas.get_Area())
  {
    for (const OGRPolygon *area : areas)
      this->areas.emplace_back(*area, origin);
    box = this->areas.front().box;
    for (const Area &area : this->areas)
      box.merge_with(area.box);
  }


  double Outline::thickness_at(const Point<2> &x) const
  {
    double largest = -1.;
    for (std::size_t i = 0; i < areas.size(); ++i)
      if (const double of_area = thickness.empty() ? 0. : thickness[i]; of_area > largest && areas[i].contains(x))
        largest = of_area;
    return largest;
  }


  std::pair<double, double> Outline::range_of_thickness() const
  {
    if (thickness.empty())
      return { 0., 0. };
    const auto [least, largest] = std::minmax_element(thickness.begin(), thickness.end());
    return { *least, *largest };
  }


  Outline read_outline(const std::string &file, const std::string &where, const Point<2> &origin)
  {
    const std::string name = where + " = " + file + ": ";
    if (is_vector_file(file))
      {
        open_file(file, name);
        auto [areas, thickness] = read_polygons(file, name);
        for (int i = 0; i < areas.getNumGeometries(); ++i)
          require_area(*areas.getGeometryRef(i), name + "polygon " + std::to_string(i + 1) + ", ");
        return Outline(areas, origin, std::move(thickness));
      }
    OGRLineString corners;
    for (const auto &row : read_number_table(file, where, { "x (m)", "y (m)" }, FirstColumn::any))
      corners.addPoint(row[0], row[1]);
    OGRMultiPolygon areas;
    areas.addGeometryDirectly(polygon_of(corners).clone());
    require_area(*areas.getGeometryRef(0), name);
    return Outline(areas, origin);
  }


  std::string read_outline_system(const std::string &file, const std::string &where)
  {
    const std::string name = where + " = " + file + ": ";
    if (!is_vector_file(file))
      return "";
    open_file(file, name);
    return system_of_vector_file(file, name);
  }


  Drawing::Drawing(const std::string &file, const std::string &where)
      : name(where + " = " + file + ": ")
  {
    open_file(file, name);
    const CPLErrorHandlerPusher quiet(CPLQuietErrorHandler);
    const auto data = open(file, name);
    std::map<std::string, OGRLineString> corners; // of a table
    for (OGRLayer *layer : data->GetLayers())
      for (const auto &feature : *layer)
        {
          const auto text = [&](const char *field) {
            const int index = feature->GetFieldIndex(field);
            return std::string(index < 0 ? "" : feature->GetFieldAsString(index));
          };
          const std::string given = text("name").empty() ? text("Layer") : text("name");
          const std::string &key  = given.empty() ? layer->GetName() : given;
          if (const OGRGeometry *shape = feature->GetGeometryRef())
            add(key, *shape);
          else if (data->GetDriverName() == std::string("CSV"))
            {
              const double x = number_of(text("x")), y = number_of(text("y"));
              if (!std::isfinite(x + y))
                throw EntryError(name + "row " + std::to_string(feature->GetFID() + 1) +
                                 " is no corner. Write name, x, y in m in each row.");
              is_table           = true;
              OGRLineString &own = corners[key];
              if (own.getNumPoints() > 2 && own.get_IsClosed())
                add(key, own), own.empty();
              own.addPoint(x, y);
            }
        }
    for (const auto &[key, line] : corners)
      add(key, line);
    if (layers.empty())
      throw EntryError(name +
                       "it has no area and no line. Draw polygons with an attribute \"name\", closed polylines in "
                       "the layers of a DXF file, or write rows name, x, y.");
  }


  void Drawing::add(const std::string &layer, const OGRGeometry &shape)
  {
    OGREnvelope box;
    shape.getEnvelope(&box);
    if (!std::isfinite(box.MinX + box.MaxX + box.MinY + box.MaxY))
      throw EntryError(name + "a corner in layer " + scree::quoted(layer) + " is infinite. Write numbers in m.");
    if (OGR_GT_IsSubClassOf(wkbFlatten(shape.getGeometryType()), wkbGeometryCollection))
      for (const OGRGeometry *part : *shape.toGeometryCollection())
        add(layer, *part);
    else
      layers[layer].emplace_back(shape.getLinearGeometry());
  }


  const std::vector<std::shared_ptr<OGRGeometry>> &Drawing::layer(const EntryValue &entry) const
  {
    if (const auto found = layers.find(entry.value); found != layers.end())
      return found->second;
    std::vector<std::string> names;
    for (const auto &[name, shapes] : layers)
      names.push_back(name);
    const auto close = nearest(names, entry.value);
    throw EntryError(entry_message(entry,
                                   "the drawing has no such layer." +
                                       (close.empty() ? "" : " Did you mean " + scree::quoted(close.front()) + '?') +
                                       " It has: " + boost::algorithm::join(names, ", ") + '.'));
  }


  std::shared_ptr<OGRMultiPolygon> Drawing::polygons(const EntryValue &entry) const
  {
    OGRMultiPolygon areas;
    std::vector<OGRGeometry *> edges;
    for (const auto &shape : layer(entry))
      if (const OGRwkbGeometryType type = wkbFlatten(shape->getGeometryType()); type == wkbPolygon)
        {
          require_area(*shape->toPolygon(), entry_message(entry, ""));
          areas.addGeometry(shape.get());
        }
      else if (type == wkbLineString)
        {
          const OGRLineString &line = *shape->toLineString();
          OGRPoint first, last;
          line.StartPoint(&first);
          line.EndPoint(&last);
          if (!line.get_IsClosed() && !is_table)
            throw EntryError(entry_message(entry,
                                           "its line from " + number_text({ first.getX(), first.getY() }) + " to " +
                                               number_text({ last.getX(), last.getY() }) +
                                               " m is open. Join and close what encloses the area as one polyline."));
          const OGRPolygon area = polygon_of(line);
          require_area(area, entry_message(entry, ""));
          if (std::none_of(edges.begin(), edges.end(), [&](const auto *other) { return other->Equals(&area); }))
            edges.push_back(area.clone()); // A polyline that is drawn twice would be a hole in itself.
        }
    if (!edges.empty())
      {
        const std::unique_ptr<OGRGeometry> with_holes(OGRGeometryFactory::forceToMultiPolygon(
            OGRGeometryFactory::organizePolygons(edges.data(), edges.size(), nullptr, nullptr)));
        for (const OGRPolygon *area : *with_holes->toMultiPolygon())
          areas.addGeometry(area);
      }
    if (areas.IsEmpty())
      throw EntryError(entry_message(entry, "it has no area. Draw a polygon, or a closed polyline."));
    return united(areas);
  }


  Outline Drawing::areas(const EntryValue &entry) const
  {
    return Outline(*polygons(entry));
  }


  std::vector<Point<2>> Drawing::line(const EntryValue &entry) const
  {
    std::vector<std::vector<Point<2>>> lines;
    for (const auto &shape : layer(entry))
      if (wkbFlatten(shape->getGeometryType()) == wkbLineString)
        {
          lines.emplace_back();
          for (const OGRPoint &corner : *shape->toLineString())
            lines.back().emplace_back(corner.getX(), corner.getY());
        }
    if (lines.size() != 1 || lines.front().size() < 2)
      throw EntryError(entry_message(
          entry, "it has " + std::to_string(lines.size()) + " lines. Draw one polyline from the left to the right."));
    std::vector<Point<2>> line = lines.front();
    if (line.front()[0] > line.back()[0])
      std::reverse(line.begin(), line.end());
    line.erase(std::unique(line.begin(), line.end()), line.end());
    for (std::size_t i = 1; i < line.size(); ++i)
      if (!(line[i][0] > line[i - 1][0] && std::isfinite(line[i][1] + line[i - 1][1])))
        throw EntryError(entry_message(
            entry, "it is vertical or turns back at " + number_text(line[i]) + " m. Draw one elevation for each x."));
    return line;
  }


  std::vector<std::string> Drawing::check(const std::vector<EntryValue> &bodies,
                                          const std::vector<std::string> &others,
                                          const double cell_size) const
  {
    constexpr double largest_overlap = 0.01; // width, in cells
    constexpr double largest_gap     = 0.5;  // area, in cells
    using Geometry                   = std::unique_ptr<OGRGeometry>;
    const CPLErrorHandlerPusher quiet(CPLQuietErrorHandler);
    const auto area_of  = [](const Geometry &one) { return OGR_G_Area(OGRGeometry::ToHandle(one.get())); };
    const auto place_in = [](const Geometry &one) {
      const Geometry place(OGRGeometry::FromHandle(OGR_G_PointOnSurface(OGRGeometry::ToHandle(one.get()))));
      return number_text({ place->toPoint()->getX(), place->toPoint()->getY() }) + " m";
    };
    // The width is how far the edge can move inwards. Slivers beside a gap, at corners, are not in its wide part.
    const auto widest_part = [&](const Geometry &gap) {
      const double digit = 1e-3 * cell_size;
      double half_width  = 0.;
      for (double step = cell_size / 4; step > 0.1 * digit; step /= 2)
        if (const Geometry part(gap->Buffer(-half_width - step)); part && !part->IsEmpty())
          half_width += step;
      return number_text(digit * std::round(2 * half_width / digit)) + " m wide, for instance at " +
             place_in(Geometry(gap->Buffer(-0.9 * half_width)));
    };
    std::vector<std::string> remarks, used = others;
    std::vector<std::shared_ptr<OGRMultiPolygon>> drawn;
    Geometry all(new OGRMultiPolygon);
    for (const EntryValue &entry : bodies)
      {
        drawn.push_back(polygons(entry));
        used.push_back(entry.value);
        all.reset(all->Union(drawn.back().get()));
        for (std::size_t i = 0; i + 1 < drawn.size(); ++i)
          if (const Geometry common(drawn.back()->Intersection(drawn[i].get())),
              wide(common ? common->Buffer(-0.5 * largest_overlap * cell_size) : nullptr);
              wide && !wide->IsEmpty())
            throw EntryError(entry_message(entry,
                                           "it overlaps the layer " + scree::quoted(bodies[i].value) + " of " +
                                               bodies[i].subsection + " on " + number_text(area_of(common)) +
                                               " m^2, for instance at " + place_in(common) +
                                               ". Leave the place to one of them."));
      }
    // What is filled if all grow by half a cell and shrink again is a gap if two layers are at it, or else a corner.
    const Geometry grown(all->Buffer(cell_size / 2)), shrunk(grown->Buffer(-cell_size / 2));
    const Geometry gaps(OGRGeometryFactory::forceToMultiPolygon(shrunk->Difference(all.get())));
    for (const OGRPolygon *part : *gaps->toMultiPolygon())
      if (const Geometry gap(part->clone()); area_of(gap) > largest_gap * cell_size * cell_size &&
                                             std::count_if(drawn.begin(), drawn.end(), [&](const auto &layer) {
                                               return layer->Distance(gap.get()) < 1e-3 * cell_size;
                                             }) > 1)
        remarks.push_back("Unusual value: " + name + "a gap between its layers is up to " + widest_part(gap) +
                          ", and has " + number_text(area_of(gap)) +
                          " m^2. No body is there; draw the layers up to each other if that is not meant.");
    std::vector<std::string> areas, lines; // layers with them that are not used; texts do not count
    for (const auto &[layer, shapes] : layers)
      if (std::find(used.begin(), used.end(), layer) == used.end())
        {
          bool has_areas = false, has_lines = false;
          for (const auto &shape : shapes)
            if (wkbFlatten(shape->getGeometryType()) == wkbPolygon)
              has_areas = true;
            else if (wkbFlatten(shape->getGeometryType()) == wkbLineString)
              (shape->toLineString()->get_IsClosed() ? has_areas : has_lines) = true;
          if (has_areas || has_lines)
            (has_areas ? areas : lines).push_back(scree::quoted(layer));
        }
    for (const auto &[names, text] : { std::make_pair(areas, "no body is in the areas of its layers "),
                                       std::make_pair(lines, "the case does not use its layers ") })
      if (!names.empty())
        remarks.push_back("Unusual value: " + name + text + boost::algorithm::join(names, ", ") + '.');
    return remarks;
  }
} // namespace scree

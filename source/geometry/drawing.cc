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

namespace scree
{
  using namespace dealii;

  namespace
  {
    OGRPolygon polygon_of(const Rings &rings)
    {
      OGRPolygon polygon;
      for (const Line &ring : rings)
        {
          OGRLinearRing copy;
          for (const Point<2> &x : ring)
            copy.addPoint(x[0], x[1]);
          polygon.addRing(&copy);
        }
      return polygon;
    }


    /// Throws EntryError, which begins with `name`, if edges cross or touch, or corners are missing.
    void require_area(const Rings &rings, const std::string &name)
    {
      for (const Line &ring : rings)
        if (ring.size() < 4)
          throw EntryError(name + "it has " + std::to_string(std::max<std::size_t>(ring.size(), 1) - 1) +
                           " corners. Write three or more, x, y in m, one a line, in their order around the place.");
      const CPLErrorHandlerPusher quiet(CPLQuietErrorHandler);
      CPLErrorReset();
      if (const OGRPolygon polygon = polygon_of(rings); !polygon.IsValid() || !(polygon.get_Area() > 0.))
        throw EntryError(name + "its edge is not that of an area: " + CPLGetLastErrorMsg() +
                         " m. Draw the corners in their order around the place, without crossings.");
    }


    /// Closes a ring of corners, m on the map, and moves it; the last may repeat the first.
    /// @param origin of the case's coordinates
    Line closed_ring(Line corners, const Point<2> &origin = Point<2>())
    {
      for (Point<2> &corner : corners)
        corner -= origin - Point<2>();
      if (!corners.empty())
        corners.push_back(corners.front());
      corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
      return corners;
    }


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


    Line corners_of(const OGRSimpleCurve &curve)
    {
      Line corners;
      for (int i = 0; i < curve.getNumPoints(); ++i)
        corners.emplace_back(curve.getX(i), curve.getY(i));
      return corners;
    }


    /// Adds a geometry and its parts. Throws EntryError, which begins with `name`, at coordinates that are no numbers.
    void collect(const OGRGeometry &geometry, const std::string &name, DrawnShapes &shapes)
    {
      OGREnvelope box;
      geometry.getEnvelope(&box);
      if (!std::isfinite(box.MinX + box.MaxX + box.MinY + box.MaxY))
        throw EntryError(name + "a corner is not at a finite place. Write its coordinates in m.");
      const std::unique_ptr<OGRGeometry> straight(geometry.getLinearGeometry());
      const OGRwkbGeometryType type = wkbFlatten(straight->getGeometryType());
      if (type == wkbPolygon)
        {
          shapes.areas.emplace_back();
          for (const OGRLinearRing *ring : *straight->toPolygon())
            shapes.areas.back().push_back(closed_ring(corners_of(*ring)));
        }
      else if (OGR_GT_IsSubClassOf(type, wkbGeometryCollection))
        for (const OGRGeometry *part : *straight->toGeometryCollection())
          collect(*part, name, shapes);
      else
        {
          shapes.other_type = OGRGeometryTypeToName(type);
          if (type == wkbLineString)
            shapes.lines.push_back(corners_of(*straight->toLineString()));
        }
    }


    /// Areas of a file in a vector format of GDAL, those of multi-polygons one by one, and the attribute `thickness` of
    /// each, m; no thickness if none has it. Throws EntryError if there is none or anything else.
    std::pair<std::vector<Rings>, std::vector<double>> read_polygons(const std::string &file, const std::string &name)
    {
      const CPLErrorHandlerPusher quiet(CPLQuietErrorHandler);
      const auto data = open(file, name);
      DrawnShapes shapes;
      const std::vector<Rings> &areas = shapes.areas;
      std::vector<double> thickness;
      bool is_known = false;
      for (const auto &feature : only_layer(*data, name))
        if (const OGRGeometry *geometry = feature->GetGeometryRef(); geometry != nullptr && !geometry->IsEmpty())
          {
            collect(*geometry, name, shapes);
            if (!shapes.other_type.empty())
              throw EntryError(name + "it has geometry of type " + shapes.other_type +
                               ". Write polygons only: areas that the body occupies.");
            const int field        = feature->GetFieldIndex("thickness"); // in any case of its letters
            const std::string text = field >= 0 ? feature->GetFieldAsString(field) : "";
            is_known               = is_known || !text.empty();
            thickness.resize(areas.size(), number_of(text));
          }
      if (areas.empty())
        throw EntryError(name + "it has no polygon. Draw the area that the body occupies.");
      for (std::size_t i = 0; is_known && i < areas.size(); ++i)
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


  Outline::Area::Area(const Rings &rings)
      : box(rings.front())
      , bands(1)
  {
    constexpr std::size_t most_bands = 1024;
    for (const Line &ring : rings)
      for (std::size_t i = 1; i < ring.size(); ++i)
        edges.emplace_back(ring[i - 1], ring[i]);
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


  Outline::Outline(const std::vector<Rings> &areas, std::vector<double> thickness)
      : areas(areas.begin(), areas.end())
      , thickness(std::move(thickness))
      , box(this->areas.front().box)
  {
    for (std::size_t i = 0; i < areas.size(); ++i)
      {
        box.merge_with(this->areas[i].box);
        sum_of_areas += polygon_of(areas[i]).get_Area();
      }
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
    if (!is_vector_file(file))
      {
        Line corners;
        for (const auto &row : read_number_table(file, where, { "x (m)", "y (m)" }, FirstColumn::any))
          corners.emplace_back(row[0], row[1]);
        const Rings area{ closed_ring(std::move(corners), origin) };
        require_area(area, name);
        return Outline({ area });
      }
    open_file(file, name);
    auto [areas, thickness] = read_polygons(file, name);
    for (std::size_t i = 0; i < areas.size(); ++i)
      {
        for (Line &ring : areas[i])
          ring = closed_ring(std::move(ring), origin);
        require_area(areas[i], name + "polygon " + std::to_string(i + 1) + ", ");
      }
    return Outline(areas, std::move(thickness));
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
    for (OGRLayer *layer : data->GetLayers())
      read(*layer);
    if (layers.empty())
      throw EntryError(name +
                       "it has no area and no line. Draw polygons with an attribute \"name\", closed polylines in "
                       "the layers of a DXF file, or write rows name, x, y.");
  }


  void Drawing::read(OGRLayer &layer)
  {
    const auto &columns   = *layer.GetLayerDefn();
    const auto index      = [&](const char *field) { return columns.GetFieldIndex(field); };
    const int of_name     = index("name") >= 0 ? index("name") : index("Layer");
    const bool is_corners = layer.GetGeomType() == wkbNone && index("x") >= 0 && index("y") >= 0;
    unsigned int row      = 1; // that names the columns
    for (const auto &feature : layer)
      {
        ++row;
        std::string of_layer = of_name >= 0 ? feature->GetFieldAsString(of_name) : "";
        if (of_layer.empty())
          of_layer = layer.GetName();
        const OGRGeometry *geometry = feature->GetGeometryRef();
        if (geometry != nullptr && !geometry->IsEmpty())
          collect(*geometry, name + "layer " + scree::quoted(of_layer) + ": ", layers[of_layer]);
        if (!is_corners)
          continue;
        const Point<2> corner(number_of(feature->GetFieldAsString(index("x"))),
                              number_of(feature->GetFieldAsString(index("y"))));
        if (!std::isfinite(corner[0] + corner[1]))
          throw EntryError(name + "row " + std::to_string(row) + " is no corner. Write name, x, y in m in each row.");
        is_table    = true;
        auto &lines = layers[of_layer].lines;
        if (lines.empty() || (lines.back().size() > 2 && lines.back().front() == lines.back().back()))
          lines.emplace_back(); // the one before is closed
        lines.back().push_back(corner);
      }
  }


  const DrawnShapes &Drawing::layer(const EntryValue &entry) const
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


  namespace
  {
    /// Lines that end where another one begins or ends, as one.
    std::vector<Line> joined(std::vector<Line> lines)
    {
      const auto is_open = [](const Line &line) { return line.front() != line.back(); };
      for (std::size_t i = 0; i < lines.size(); ++i)
        for (std::size_t j = i + 1; j < lines.size() && is_open(lines[i]);)
          {
            Line &one = lines[i], &other = lines[j];
            if (one.front() == other.front() || one.front() == other.back())
              std::reverse(one.begin(), one.end());
            if (one.back() == other.back())
              std::reverse(other.begin(), other.end());
            if (!is_open(other) || one.back() != other.front())
              {
                ++j;
                continue;
              }
            one.insert(one.end(), other.begin() + 1, other.end());
            lines.erase(lines.begin() + j);
            j = i + 1;
          }
      return lines;
    }


    std::vector<Rings> areas_of(const OGRGeometry &geometry)
    {
      DrawnShapes shapes;
      collect(geometry, "", shapes);
      return shapes.areas;
    }


    /// As one geometry, without what they have in common twice.
    std::unique_ptr<OGRGeometry> united(const std::vector<Rings> &areas)
    {
      OGRMultiPolygon all;
      for (const Rings &rings : areas)
        {
          const OGRPolygon polygon = polygon_of(rings);
          all.addGeometry(&polygon);
        }
      return std::unique_ptr<OGRGeometry>(all.UnionCascaded());
    }


    double area_of(const OGRGeometry *geometry)
    {
      return geometry == nullptr ? 0. : OGR_G_Area(OGRGeometry::ToHandle(const_cast<OGRGeometry *>(geometry)));
    }


    /// Its area and a place in it, in words.
    std::string place_text(const OGRGeometry &geometry)
    {
      const std::unique_ptr<OGRGeometry> place(
          OGRGeometry::FromHandle(OGR_G_PointOnSurface(OGRGeometry::ToHandle(const_cast<OGRGeometry *>(&geometry)))));
      return number_text(area_of(&geometry)) + " m^2, for instance at " +
             number_text({ place->toPoint()->getX(), place->toPoint()->getY() }) + " m";
    }
  } // namespace


  std::vector<Rings> Drawing::areas(const EntryValue &entry) const
  {
    const DrawnShapes &shapes = layer(entry);
    std::vector<Rings> areas  = shapes.areas;
    std::vector<OGRGeometry *> edges;
    for (Line &line : joined(shapes.lines))
      {
        if (line.front() != line.back() && !is_table)
          throw EntryError(entry_message(
              entry,
              "its line from " + number_text(line.front()) + " to " + number_text(line.back()) +
                  " m is open: " + number_text(line.front().distance(line.back())) + " m are missing. Close it."));
        areas.push_back({ closed_ring(std::move(line)) });
      }
    for (const Rings &rings : areas)
      require_area(rings, entry_message(entry, ""));
    if (areas.empty())
      throw EntryError(entry_message(entry, "it has no area. Draw a polygon, or a closed polyline."));
    for (std::size_t i = shapes.areas.size(); i < areas.size(); ++i)
      edges.push_back(polygon_of(areas[i]).clone());
    areas.resize(shapes.areas.size());
    if (!edges.empty())
      {
        const std::unique_ptr<OGRGeometry> with_holes(
            OGRGeometryFactory::organizePolygons(edges.data(), edges.size(), nullptr, nullptr));
        const auto more = areas_of(*with_holes);
        areas.insert(areas.end(), more.begin(), more.end());
      }
    return areas.size() > 1 ? areas_of(*united(areas)) : areas;
  }


  Line Drawing::line(const EntryValue &entry) const
  {
    std::vector<Line> lines = joined(layer(entry).lines);
    if (lines.size() != 1)
      throw EntryError(entry_message(
          entry, "it has " + std::to_string(lines.size()) + " lines. Draw one polyline from the left to the right."));
    Line &line = lines.front();
    if (line.front()[0] > line.back()[0])
      std::reverse(line.begin(), line.end());
    line.erase(std::unique(line.begin(), line.end()), line.end());
    for (std::size_t i = 1; i < line.size(); ++i)
      if (!(line[i][0] > line[i - 1][0]))
        throw EntryError(entry_message(
            entry, "it is vertical or turns back at " + number_text(line[i]) + " m. Draw one elevation for each x."));
    if (line.size() < 2)
      throw EntryError(entry_message(entry, "it is a single point. Draw a polyline."));
    return line;
  }


  std::vector<std::string> Drawing::check(const std::vector<EntryValue> &bodies,
                                          const std::vector<std::string> &others,
                                          const double cell_size) const
  {
    constexpr double largest_overlap = 0.01, largest_gap = 0.5; // of a cell
    const double cell = cell_size * cell_size;
    const CPLErrorHandlerPusher quiet(CPLQuietErrorHandler);
    std::vector<std::unique_ptr<OGRGeometry>> drawn;
    std::vector<Rings> all;
    for (const EntryValue &entry : bodies)
      {
        const auto of_body = areas(entry);
        all.insert(all.end(), of_body.begin(), of_body.end());
        drawn.push_back(united(of_body));
        for (std::size_t i = 0; i + 1 < drawn.size(); ++i)
          if (const std::unique_ptr<OGRGeometry> common(drawn.back()->Intersection(drawn[i].get()));
              area_of(common.get()) > largest_overlap * cell)
            throw EntryError(entry_message(entry,
                                           "it overlaps the layer " + scree::quoted(bodies[i].value) + " of " +
                                               bodies[i].subsection + " on " + place_text(*common) +
                                               ". Leave the place to one of them."));
      }
    std::vector<std::string> remarks;
    // A gap is what disappears if all layers grow by half a cell and shrink again, and lies at two of them: the others
    // are corners of the ground.
    if (const auto one = all.empty() ? nullptr : united(all))
      {
        const std::unique_ptr<OGRGeometry> grown(one->Buffer(cell_size / 2));
        const std::unique_ptr<OGRGeometry> shrunk(grown->Buffer(-cell_size / 2));
        std::vector<Rings> outer = areas_of(*shrunk);
        for (Rings &rings : outer)
          rings.resize(1);
        const std::unique_ptr<OGRGeometry> gaps(united(outer)->Difference(one.get()));
        for (const Rings &rings : areas_of(*gaps))
          {
            const OGRPolygon gap = polygon_of(rings);
            const auto n_at      = std::count_if(drawn.begin(), drawn.end(), [&](const auto &layer) {
              return layer->Distance(&gap) < 1e-3 * cell_size;
            });
            if (n_at > 1 && gap.get_Area() > largest_gap * cell)
              remarks.push_back("Unusual value: " + name + "a gap between its layers has " + place_text(gap) +
                                ". No body is there; draw the layers up to each other if that is not meant.");
          }
      }
    std::vector<std::string> unused;
    for (const auto &[layer, shapes] : layers)
      if (std::find(others.begin(), others.end(), layer) == others.end() &&
          std::none_of(
              bodies.begin(), bodies.end(), [&, &layer = layer](const auto &body) { return body.value == layer; }))
        unused.push_back(scree::quoted(layer));
    if (!unused.empty())
      remarks.push_back("Unusual value: " + name + "the case does not use its layers " +
                        boost::algorithm::join(unused, ", ") + '.');
    return remarks;
  }
} // namespace scree

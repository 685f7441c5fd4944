// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_postprocess_maps_h
#define scree_postprocess_maps_h

#include <scree/io/output_parameters.h>
#include <scree/io/run_folder.h>
#include <scree/postprocess/measures.h>

namespace scree
{
  /// Where a map has the case's coordinates.
  struct MapFrame
  {
    dealii::Point<2> origin; ///< m; in 2D nothing reads it
    std::string system;      ///< of coordinates, see Raster::system; empty: none is known
  };

  /// Maps of the soil that can move, on the columns of the mesh's fine cells along the last axis: ESRI ASCII grids or
  /// GeoTIFF in the folder `maps` of a run, in 2D one table along x. All ranks hold all columns. Does nothing unless
  /// the case asks for maps.
  template <int dim>
  class Maps
  {
  public:
    /// Keeps references to grid and folder; sample() comes next.
    Maps(const MapParameters &parameters,
         const MapFrame &frame,
         const TimeLabel &time_label,
         const BackgroundGrid<dim> &grid,
         const RunFolder &folder)
        : parameters(parameters)
        , frame(frame)
        , time_label(time_label)
        , grid(grid)
        , folder(folder)
        , columns(grid)
    {
      if (!parameters.write)
        return;
      for (Map *map : { &thickness, &mass, &largest_thickness, &largest_speed, &largest_pressure })
        map->assign(columns.size(), 0.);
      arrival_time.assign(columns.size(), -1.);
    }

    /// Takes the state at `time`, s, into the maps. Collective.
    void sample(const std::list<SoilBody<dim>> &bodies, const double time);

    /// What writes all maps as of the last sample, and the thickness (in 2D the table) also under a name with its
    /// `time`, s; empty if there is nothing to write. The maps may change before it is called.
    std::function<void()> writing(const double time) const
    {
      if (!parameters.write || !folder.is_writer())
        return {};
      return [this, of_time = '_' + time_label(time), all = sheets()] { write(of_time, all); };
    }

    /// Saves or loads the maps as of the last sample (Boost).
    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &thickness &first_thickness &mass &largest_thickness &largest_speed &largest_pressure &arrival_time;
    }

  private:
    using Map = std::vector<double>; // by column, along x first

    /// A map as it is written.
    struct Sheet
    {
      std::string name, unit;
      Map values;
      Map soil; ///< where this is 0, there is no soil and in space no value
    };

    /// All maps as of the last sample. Arrival times are nan where there is none.
    std::vector<Sheet> sheets() const;

    void write(const std::string &of_time, const std::vector<Sheet> &all) const;

    /// A map in space, in each format that the case asks for.
    void add_map(const std::string &file, const Sheet &sheet, std::vector<FileContent> &files) const;

    /// All maps in the plane: a row a column of cells, with the x of its middle.
    std::string table(const std::vector<Sheet> &all) const
    {
      std::vector<std::string> heads{ "x (m)" };
      for (const Sheet &sheet : all)
        heads.push_back(sheet.name + " (" + sheet.unit + ')');
      std::string text = csv_head(heads);
      for (std::size_t c = 0; c < columns.size(); ++c)
        {
          std::vector<double> row{ columns.middle(c)[0] };
          for (const Sheet &sheet : all)
            row.push_back(sheet.values[c]);
          text += csv_row(row);
        }
      return text;
    }

    const MapParameters parameters;
    const MapFrame frame;
    const TimeLabel time_label;
    const BackgroundGrid<dim> &grid;
    const RunFolder &folder;
    const CellColumns<dim> columns;
    Map thickness, first_thickness; // m, now and in the first sample
    Map mass;                       // over area, now, kg/m^2
    Map largest_thickness;          // m
    Map largest_speed;              // of a column's momentum over its mass, m/s
    Map largest_pressure;           // momentum flux over thickness: bulk density times square of that speed, Pa
    Map arrival_time;               // s; negative: not yet
  };
} // namespace scree

#endif

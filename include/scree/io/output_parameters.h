// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_io_output_parameters_h
#define scree_io_output_parameters_h

#include <deal.II/base/parameter_handler.h>

#include <string>

namespace scree
{
  /// What a run prints on the screen.
  enum class Screen
  {
    progress,   ///< start, progress with time left, timings
    statistics, ///< the last row of the statistics only: numbers that do not depend on the machine
    nothing
  };

  /// The pictures a run writes.
  enum class Pictures
  {
    none,
    points,
    points_and_grid
  };

  /// Subsection Maps of subsection Output.
  struct MapParameters
  {
    bool write             = false;        ///< whether maps are written with each picture
    double least_thickness = 0;            ///< m, of soil that counts as having arrived
    std::string format     = "ASCII grid"; ///< ASCII grid | GeoTIFF | ASCII grid and GeoTIFF, in 3D

    /// Declares the subsection and its entries.
    void add_parameters(dealii::ParameterHandler &prm);

    /// Throws EntryError at maps of a scene that has none, and at formats that it or the program does not have.
    void check(const bool has_soil, const unsigned int dim) const;

    /// Whether maps in space are ESRI ASCII grids.
    bool writes_ascii_grid() const
    {
      return format != "GeoTIFF";
    }

    /// Whether maps in space are GeoTIFF.
    bool writes_geo_tiff() const
    {
      return format != "ASCII grid";
    }
  };

  /// Subsection Output.
  struct OutputParameters
  {
    double interval            = 0.1;               ///< s, of pictures
    double statistics_interval = 0;                 ///< s; 0: as pictures
    double checkpoint_interval = 0;                 ///< s; 0: none
    double wall_time_limit     = 0;                 ///< s of the clock on the wall; 0: none
    std::string graphics       = "points and grid"; ///< points and grid | points | none
    std::string screen         = "progress";        ///< progress | statistics | nothing
    MapParameters maps;                             ///< subsection Maps

    /// Declares the subsection and its entries.
    void add_parameters(dealii::ParameterHandler &prm);

    /// Throws EntryError at an interval that no run to `end_time`, s, can meet.
    void check(const double end_time) const;

    /// Entry `Screen` as an enum.
    Screen screen_kind() const;

    /// Entry `Graphics` as an enum.
    Pictures graphics_kind() const;

    /// Time between rows of statistics, s; that of pictures by default.
    double interval_of_statistics() const;
  };
} // namespace scree

#endif

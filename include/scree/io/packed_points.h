// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_io_packed_points_h
#define scree_io_packed_points_h

#include <scree/io/byte_reader.h>
#include <scree/particles/point_set.h>

#include <map>
#include <string>
#include <vector>

namespace scree
{
  /// This rank's points, cell by cell: for each set the numbers of properties and of points; for each cell its id and
  /// the number of its points; for each point its id, location, reference location and properties.
  template <int dim>
  std::string pack_points(const std::vector<PointSet<dim> *> &sets);

  /// Cells of this rank, by their ids.
  template <int dim>
  using OwnCells = std::map<dealii::CellId, typename dealii::Triangulation<dim>::active_cell_iterator>;

  /// Collects the cells of this rank, without ghosts.
  template <int dim>
  OwnCells<dim> own_cells(const dealii::Triangulation<dim> &mesh);

  /// Inserts the points of `cells` into the set; returns how many points the file has of it.
  template <int dim>
  std::uint64_t unpack_points(ByteReader &file, const OwnCells<dim> &cells, PointSet<dim> &points);
} // namespace scree

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/io/packed_points.h>

namespace scree
{
  using namespace dealii;

  template <int dim>
  std::string pack_points(const std::vector<PointSet<dim> *> &sets)
  {
    std::string buffer;
    for (const PointSet<dim> *points : sets)
      {
        const auto &handler           = points->handler();
        const std::uint64_t numbers[] = { points->stride(), handler.n_locally_owned_particles() };
        append_bytes(buffer, numbers, 2);
        for (auto point = handler.begin(); point != handler.end();)
          {
            const auto cell              = point->get_surrounding_cell();
            const auto id                = cell->id().template to_binary<dim>();
            const std::uint64_t n_points = handler.n_particles_in_cell(cell);
            append_bytes(buffer, id.data(), id.size());
            append_bytes(buffer, &n_points, 1);
            for (std::uint64_t p = 0; p < n_points; ++p, ++point)
              {
                const std::uint64_t number = point->get_id();
                append_bytes(buffer, &number, 1);
                append_bytes(buffer, &point->get_location()[0], dim);
                append_bytes(buffer, &point->get_reference_location()[0], dim);
                append_bytes(buffer, point->get_properties().data(), points->stride());
              }
          }
      }
    return buffer;
  }


  template <int dim>
  OwnCells<dim> own_cells(const Triangulation<dim> &mesh)
  {
    OwnCells<dim> cells;
    for (const auto &cell : mesh.active_cell_iterators())
      if (cell->is_locally_owned())
        cells.emplace(cell->id(), cell);
    return cells;
  }


  template <int dim>
  std::uint64_t unpack_points(ByteReader &file, const OwnCells<dim> &cells, PointSet<dim> &points)
  {
    AssertThrow(file.take() == points.stride(), ExcMessage("The points have other properties than the case's."));
    const std::uint64_t n_points = file.take();
    std::vector<double> properties(points.stride());
    for (std::uint64_t n = 0; n < n_points;)
      {
        CellId::binary_type id;
        file.take(id.data(), id.size());
        const auto cell               = cells.find(CellId(id));
        const std::uint64_t n_in_cell = file.take();
        for (std::uint64_t p = 0; p < n_in_cell; ++p, ++n)
          {
            const std::uint64_t number = file.take();
            Point<dim> location, reference_location;
            file.take(&location[0], dim);
            file.take(&reference_location[0], dim);
            file.take(properties.data(), properties.size());
            if (cell != cells.end())
              points.handler().insert_particle(location, reference_location, number, cell->second, properties);
          }
      }
    return n_points;
  }

  template std::string pack_points(const std::vector<PointSet<2> *> &);
  template OwnCells<2> own_cells(const Triangulation<2> &);
  template std::uint64_t unpack_points(ByteReader &, const OwnCells<2> &, PointSet<2> &);
  template std::string pack_points(const std::vector<PointSet<3> *> &);
  template OwnCells<3> own_cells(const Triangulation<3> &);
  template std::uint64_t unpack_points(ByteReader &, const OwnCells<3> &, PointSet<3> &);
} // namespace scree

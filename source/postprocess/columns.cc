// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/postprocess/cell_contents.h>
#include <scree/postprocess/columns.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace scree
{
  using namespace dealii;

  template <int dim>
  CellColumns<dim>::CellColumns(const BackgroundGrid<dim> &grid)
      : grid(grid)
  {
    for (unsigned int a = 0; a < dim; ++a)
      n[a] = std::lround((grid.upper_corner()[a] - grid.lower_corner()[a]) / grid.cell_size());
  }


  template <int dim>
  std::size_t CellColumns<dim>::size() const
  {
    return dim == 3 ? n[0] * n[1] : n[0];
  }


  template <int dim>
  double CellColumns<dim>::area() const
  {
    return Utilities::fixed_power<dim - 1>(grid.cell_size());
  }


  template <int dim>
  Point<dim> CellColumns<dim>::middle(const std::size_t column) const
  {
    Point<dim> x;
    std::size_t rest = column;
    for (unsigned int a = 0; a + 1 < dim; ++a, rest /= n[a - 1])
      x[a] = grid.lower_corner()[a] + (rest % n[a] + 0.5) * grid.cell_size();
    return x;
  }


  template <int dim>
  std::array<std::pair<std::size_t, double>, (1 << (dim - 1))> CellColumns<dim>::around(const Point<dim> &x) const
  {
    std::array<std::pair<std::size_t, double>, (1 << (dim - 1))> result;
    result.fill({ 0, 1. });
    for (unsigned int a = dim - 1; a-- > 0;)
      {
        // In cells from the middle of the first column.
        const double place = (x[a] - grid.lower_corner()[a]) / grid.cell_size() - 0.5, lower = std::floor(place);
        for (unsigned int i = 0; i < result.size(); ++i)
          {
            const unsigned int side = i >> a & 1;
            result[i].first =
                result[i].first * n[a] + static_cast<std::size_t>(std::clamp(lower + side, 0., n[a] - 1.));
            result[i].second *= side == 1 ? place - lower : 1. - (place - lower);
          }
      }
    return result;
  }


  template <int dim>
  std::vector<Lump<dim>> lumps_of(const std::list<SoilBody<dim>> &bodies)
  {
    std::vector<Lump<dim>> lumps;
    for (const auto &body : bodies)
      for_each_point(body.points, [&](const auto &point) {
        lumps.push_back({ point.location, point.properties[body.layout.volume] });
      });
    return lumps;
  }


  template <int dim>
  std::vector<Lump<dim>> lumps_of(const std::list<SoilBody<dim>> &bodies,
                                  const std::list<WaterPhase<dim>> &water,
                                  const BackgroundGrid<dim> &grid)
  {
    const std::vector<CellContents> contents = contents_of_cells(bodies, water, grid);
    std::vector<Lump<dim>> lumps;
    for (const auto &one : water)
      for_each_point(one.points(), [&](const auto &point) {
        const double porosity = contents[point.cell].porosity();
        lumps.push_back({ point.location, point.properties[one.layout.volume] / (porosity > 0 ? porosity : 1.) });
      });
    return lumps;
  }


  namespace
  {
    /// Integral over the box of 1 - |x - place|/width along an axis, m.
    double weight_in_box(const double place, const double lower, const double upper, const double width)
    {
      const auto side = [&](const double room) {
        const double s = std::min(1., room / width);
        return width * s * (1. - 0.5 * s);
      };
      return side(place - lower) + side(upper - place);
    }
  } // namespace


  template <int dim>
  std::vector<GroundColumn> ground_columns(const std::vector<Lump<dim>> &lumps,
                                           const std::vector<std::vector<double>> &places,
                                           const BackgroundGrid<dim> &grid)
  {
    constexpr unsigned int n_parts = 1 << (dim - 1);
    constexpr double nowhere       = std::numeric_limits<double>::lowest();
    const double width             = grid.cell_size();
    std::vector<double> volumes(places.size(), 0.), tops(places.size() * n_parts, nowhere);
    for (unsigned int i = 0; i < places.size(); ++i)
      for (const Lump<dim> &lump : lumps)
        {
          double weight     = 1.;
          bool is_close     = true;
          unsigned int part = 0;
          for (unsigned int a = 0; a + 1 < dim; ++a)
            {
              const double distance = (lump.location[a] - places[i][a]) / width;
              weight *= std::max(0., 1. - std::abs(distance));
              is_close = is_close && std::abs(distance) <= 0.5;
              part |= (distance > 0. ? 1u : 0u) << a;
            }
          volumes[i] += weight * lump.volume;
          const double side = std::min(std::pow(std::max(0., lump.volume), 1. / dim), width);
          if (is_close)
            tops[i * n_parts + part] = std::max(tops[i * n_parts + part], lump.location[dim - 1] + 0.5 * side);
        }
    Utilities::MPI::sum(volumes, grid.communicator(), volumes);
    Utilities::MPI::max(tops, grid.communicator(), tops);

    std::vector<GroundColumn> columns;
    for (unsigned int i = 0; i < places.size(); ++i)
      {
        double area = 1., sum = 0., n = 0.;
        for (unsigned int a = 0; a + 1 < dim; ++a)
          area *= weight_in_box(places[i][a], grid.lower_corner()[a], grid.upper_corner()[a], width);
        for (unsigned int part = 0; part < n_parts; ++part)
          if (const double top = tops[i * n_parts + part]; top > nowhere)
            {
              sum += top;
              n += 1.;
            }
        columns.push_back({ volumes[i] / area, n > 0. ? sum / n : std::numeric_limits<double>::quiet_NaN() });
      }
    return columns;
  }


  template <int dim>
  std::pair<double, double>
  rear_and_front(const std::vector<Lump<dim>> &lumps, const double threshold, const BackgroundGrid<dim> &grid)
  {
    const double width = grid.cell_size();
    const CellColumns<dim> columns(grid);
    std::array<int, dim> n;
    std::copy_n(columns.n_cells().begin(), dim, n.begin());
    const int n_rows = columns.size() / n[0];

    std::vector<double> thickness(n[0] * n_rows, 0.); // row by row along x
    for (const Lump<dim> &lump : lumps)
      {
        const auto number = [&](const unsigned int axis) {
          const double cell = std::floor((lump.location[axis] - grid.lower_corner()[axis]) / width);
          return std::clamp(static_cast<int>(cell), 0, n[axis] - 1);
        };
        thickness[(dim == 3 ? number(1) * n[0] : 0) + number(0)] += lump.volume / columns.area();
      }
    Utilities::MPI::sum(thickness, grid.communicator(), thickness);

    // Where, in cells from the centre of column i of a row, the thickness has fallen to the threshold at column j.
    const auto way = [&](const double *row, const int i, const int j) {
      return j < 0 || j >= n[0] ? 0.5 : (row[i] - threshold) / (row[i] - row[j]);
    };
    double first = std::numeric_limits<double>::infinity(), last = -first;
    for (int r = 0; r < n_rows; ++r)
      {
        const double *row = thickness.data() + r * n[0];
        for (int i = 0; i < n[0]; ++i)
          if (row[i] >= threshold)
            {
              const bool begins = i == 0 || row[i - 1] < threshold, ends = i + 1 == n[0] || row[i + 1] < threshold;
              if (begins)
                first = std::min(first, i + 0.5 - way(row, i, i - 1));
              if (ends)
                last = std::max(last, i + 0.5 + way(row, i, i + 1));
            }
      }
    if (last < first)
      return { std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN() };
    return { grid.lower_corner()[0] + first * width, grid.lower_corner()[0] + last * width };
  }

  template class CellColumns<2>;
  template class CellColumns<3>;
  template std::vector<Lump<2>> lumps_of(const std::list<SoilBody<2>> &);
  template std::vector<Lump<3>> lumps_of(const std::list<SoilBody<3>> &);
  template std::vector<Lump<2>>
  lumps_of(const std::list<SoilBody<2>> &, const std::list<WaterPhase<2>> &, const BackgroundGrid<2> &);
  template std::vector<Lump<3>>
  lumps_of(const std::list<SoilBody<3>> &, const std::list<WaterPhase<3>> &, const BackgroundGrid<3> &);
  template std::vector<GroundColumn>
  ground_columns(const std::vector<Lump<2>> &, const std::vector<std::vector<double>> &, const BackgroundGrid<2> &);
  template std::vector<GroundColumn>
  ground_columns(const std::vector<Lump<3>> &, const std::vector<std::vector<double>> &, const BackgroundGrid<3> &);
  template std::pair<double, double>
  rear_and_front(const std::vector<Lump<2>> &, const double, const BackgroundGrid<2> &);
  template std::pair<double, double>
  rear_and_front(const std::vector<Lump<3>> &, const double, const BackgroundGrid<3> &);
} // namespace scree

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/postprocess/measures.h>
#include <scree/tensor/invariants.h>

#include <deal.II/base/symmetric_tensor.h>

namespace scree
{
  using namespace dealii;


  template <int dim>
  std::vector<CellContents> contents_of_cells(const std::list<SoilBody<dim>> &bodies,
                                              const std::list<WaterPhase<dim>> &water,
                                              const BackgroundGrid<dim> &grid)
  {
    std::vector<CellContents> contents(grid.triangulation().n_active_cells());
    for (const auto &body : bodies)
      for_each_point(body.points, [&](const auto &point) {
        CellContents &sums       = contents[point.cell];
        const double *properties = point.properties;
        const double volume      = properties[body.layout.volume];
        ++sums.n_soil_points;
        sums.soil_mass += properties[body.layout.mass];
        sums.soil_volume += volume;
        sums.grain_volume += properties[body.layout.mass] / body.grain_density;
        sums.soil_pressure += volume * mean_effective_stress(properties + body.layout.stress);
      });
    for (const auto &one : water)
      for_each_point(one.points(), [&](const auto &point) {
        CellContents &sums = contents[point.cell];
        ++sums.n_water_points;
        sums.water_mass += point.properties[one.layout.mass];
        sums.water_volume += point.properties[one.layout.volume];
      });
    return contents;
  }

  template decltype(contents_of_cells<2>) contents_of_cells<2>;
  template decltype(contents_of_cells<3>) contents_of_cells<3>;


  /// Elastic energies of points, as many at a time as a batch has lanes.
  template <int dim>
  class PointSums<dim>::Energies
  {
  public:
    explicit Energies(const Material<dim> &material)
        : material(material)
    {
      for (unsigned int c = 0; c < n_components; ++c)
        states[c] = simd::broadcast<Batch>(c < 3 ? 1. : 0.);
    }

    /// A point of this volume at the start, m^3 (2D: per m); adds to the `sum`, J, if the batch is full.
    void add(const double volume, const double *left_cauchy_green, double &sum)
    {
      for (unsigned int c = 0; c < n_components; ++c)
        simd::set_lane(states[c], n, left_cauchy_green[c]);
      volumes[n] = volume;
      if (++n == batch_size)
        finish(sum);
    }

    /// Adds what is left.
    void finish(double &sum)
    {
      const Batch energies = material.elastic_energies(states);
      for (unsigned int lane = 0; lane < n; ++lane)
        sum += volumes[lane] * energies[lane];
      n = 0;
    }

  private:
    static constexpr unsigned int n_components = n_symmetric_components<dim>;

    const Material<dim> &material;
    Batch states[n_components];
    double volumes[batch_size];
    unsigned int n = 0;
  };


  template <int dim>
  PointSums<dim>::PointSums(const std::list<SoilBody<dim>> &bodies,
                            const std::list<WaterPhase<dim>> &water,
                            const Tensor<1, dim> &gravity,
                            const BackgroundGrid<dim> &grid)
      : height(std::numeric_limits<double>::lowest())
  {
    MotionSums<dim> soil, of_water;
    double stored = 0.;
    for (const auto &body : bodies)
      {
        Energies energies(*body.material);
        for_each_point(body.points, [&](const auto &point) {
          const double *properties = point.properties;
          const double mass        = properties[body.layout.mass];
          const double P           = mean_effective_stress(properties + body.layout.stress);
          soil_points += 1;
          soil_mass += mass;
          pressure += P;
          largest_pressure = std::max(largest_pressure, P);
          height           = std::max(height, point.location[dim - 1]);
          largest_porosity = std::max(largest_porosity, body.porosity(properties));
          energies.add(mass / body.density, properties + body.layout.left_cauchy_green, stored);
        });
        energies.finish(stored);
        if (!body.is_rigid)
          soil += motion_of_points(grid, body.points, body.layout, body.has_affine_energy);
      }
    for (const auto &part : water)
      of_water += motion_of_points(grid, part.points(), part.layout, part.has_affine_energy);
    static_cast<MovingSums<dim> &>(*this) = { soil, of_water, stored, gravity };
    NumbersOf sums(static_cast<MovingSums<dim> &>(*this));
    sums &soil_points &soil_mass &pressure;
    sums.sum_over_ranks(grid.communicator());

    std::vector<double> largest{ largest_pressure, height, largest_porosity };
    Utilities::MPI::max(largest, grid.communicator(), largest);
    largest_pressure = largest[0], height = largest[1], largest_porosity = largest[2];
  }

  template struct PointSums<2>;
  template struct PointSums<3>;


  template <int dim>
  std::array<std::pair<std::size_t, double>, (1 << (dim - 1))> CellColumns<dim>::around(const Point<dim> &x) const
  {
    std::array<std::pair<std::size_t, double>, (1 << (dim - 1))> result;
    result.fill({ 0, 1. });
    for (unsigned int a = dim - 1; a-- > 0;)
      {
        // In cells from the middle of the first column.
        const double place = (x[a] - box.lower[a]) / box.width - 0.5, lower = std::floor(place);
        for (unsigned int i = 0; i < result.size(); ++i)
          {
            const unsigned int side = i >> a & 1;
            result[i].first =
                result[i].first * box.n[a] + static_cast<std::size_t>(std::clamp(lower + side, 0., box.n[a] - 1.));
            result[i].second *= side == 1 ? place - lower : 1. - (place - lower);
          }
      }
    return result;
  }


  template <int dim>
  std::vector<PointVolume<dim>> point_volumes(const std::list<SoilBody<dim>> &bodies)
  {
    std::vector<PointVolume<dim>> lumps;
    for (const auto &body : bodies)
      for_each_point(body.points, [&](const auto &point) {
        lumps.push_back({ point.location, point.properties[body.layout.volume] });
      });
    return lumps;
  }


  template <int dim>
  std::vector<PointVolume<dim>> point_volumes(const std::list<SoilBody<dim>> &bodies,
                                              const std::list<WaterPhase<dim>> &water,
                                              const BackgroundGrid<dim> &grid)
  {
    const std::vector<CellContents> contents = contents_of_cells(bodies, water, grid);
    std::vector<PointVolume<dim>> lumps;
    for (const auto &one : water)
      for_each_point(one.points(), [&](const auto &point) {
        const double porosity = contents[point.cell].porosity();
        lumps.push_back({ point.location, point.properties[one.layout.volume] / (porosity > 0 ? porosity : 1.) });
      });
    return lumps;
  }


  template <int dim>
  std::vector<GroundColumn> ground_columns(const std::vector<PointVolume<dim>> &lumps,
                                           const std::vector<std::vector<double>> &places,
                                           const BackgroundGrid<dim> &grid)
  {
    constexpr unsigned int n_parts = 1 << (dim - 1);
    constexpr double nowhere       = std::numeric_limits<double>::lowest();
    const double width             = grid.cell_size();
    const auto half_of_weights     = [&](const double room) { // integral of 1 - |x|/width over x from 0 to `room`, m
      const double s = std::min(1., room / width);
      return width * s * (1. - 0.5 * s);
    };
    std::vector<double> volumes(places.size(), 0.), tops(places.size() * n_parts, nowhere);
    for (unsigned int i = 0; i < places.size(); ++i)
      for (const PointVolume<dim> &lump : lumps)
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
          const double side = std::min(edge_of_cube<dim>(std::max(0., lump.volume)), width);
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
          area *= half_of_weights(places[i][a] - grid.lower_corner()[a]) +
                  half_of_weights(grid.upper_corner()[a] - places[i][a]);
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
  rear_and_front(const std::vector<PointVolume<dim>> &lumps, const double threshold, const BackgroundGrid<dim> &grid)
  {
    const CellColumns<dim> columns(grid);
    const CellPlace<dim> &n = columns.box.n;
    const int n_rows        = columns.size() / n[0];

    std::vector<double> thickness(n[0] * n_rows, 0.); // row by row along x
    for (const PointVolume<dim> &lump : lumps)
      {
        const CellPlace<dim> place = columns.box.place_near(lump.location);
        thickness[(dim == 3 ? place[1] * n[0] : 0) + place[0]] += lump.volume / columns.area();
      }
    Utilities::MPI::sum(thickness, grid.communicator(), thickness);

    double first = std::numeric_limits<double>::infinity(), last = -first; // in cells
    for (int r = 0; r < n_rows; ++r)
      for (int i = -1; i < n[0]; ++i) // between columns i and i + 1
        {
          const double *row = thickness.data() + r * n[0];
          const bool left = i >= 0 && row[i] >= threshold, right = i + 1 < n[0] && row[i + 1] >= threshold;
          const bool at_edge = i < 0 || i + 1 == n[0];
          if (const double part = at_edge ? 0.5 : (row[i] - threshold) / (row[i] - row[i + 1]); left != right)
            {
              first = std::min(first, i + 0.5 + part);
              last  = std::max(last, i + 0.5 + part);
            }
        }
    if (last < first)
      return { std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN() };
    return { grid.lower_corner()[0] + first * grid.cell_size(), grid.lower_corner()[0] + last * grid.cell_size() };
  }

  template class CellColumns<2>;
  template class CellColumns<3>;
  template std::vector<PointVolume<2>> point_volumes(const std::list<SoilBody<2>> &);
  template std::vector<PointVolume<3>> point_volumes(const std::list<SoilBody<3>> &);
  template std::vector<PointVolume<2>>
  point_volumes(const std::list<SoilBody<2>> &, const std::list<WaterPhase<2>> &, const BackgroundGrid<2> &);
  template std::vector<PointVolume<3>>
  point_volumes(const std::list<SoilBody<3>> &, const std::list<WaterPhase<3>> &, const BackgroundGrid<3> &);
  template decltype(ground_columns<2>) ground_columns<2>;
  template decltype(ground_columns<3>) ground_columns<3>;
  template decltype(rear_and_front<2>) rear_and_front<2>;
  template decltype(rear_and_front<3>) rear_and_front<3>;


  std::vector<double> percentiles(const std::vector<PartOfMass> &parts,
                                  const double lower,
                                  const double upper,
                                  const std::vector<double> &fractions,
                                  const MPI_Comm communicator)
  {
    struct Search
    {
      double begin, end, wanted;     // mass between begin and the percentile
      std::vector<PartOfMass> parts; // between begin and end
    };
    double all = 0.;
    for (const PartOfMass &part : parts)
      all += part.mass;
    all = Utilities::MPI::sum(all, communicator);
    // Equal masses often add up to just the given part: rounding must not choose the point.
    std::vector<Search> searches;
    for (const double fraction : fractions)
      searches.push_back({ lower, upper, fraction * all * (1. - 1e-12), parts });

    constexpr unsigned int n_halvings = 50;
    for (unsigned int i = 0; i < n_halvings; ++i)
      {
        std::vector<double> masses; // below the middles
        std::vector<std::vector<PartOfMass>::iterator> middles;
        for (Search &search : searches)
          {
            middles.push_back(
                std::partition(search.parts.begin(), search.parts.end(), [&search](const PartOfMass &part) {
                  return part.place < 0.5 * (search.begin + search.end);
                }));
            masses.push_back(0.);
            for (auto part = search.parts.begin(); part != middles.back(); ++part)
              masses.back() += part->mass;
          }
        Utilities::MPI::sum(masses, communicator, masses);
        for (unsigned int s = 0; s < searches.size(); ++s)
          {
            auto &[begin, end, wanted, own] = searches[s];
            const bool is_above             = masses[s] < wanted;
            (is_above ? begin : end)        = 0.5 * (begin + end);
            wanted -= is_above ? masses[s] : 0.;
            own.erase(is_above ? own.begin() : middles[s], is_above ? middles[s] : own.end());
          }
      }
    std::vector<double> result;
    for (const Search &search : searches)
      result.push_back(0.5 * (search.begin + search.end));
    return result;
  }


  namespace
  {
    /// Gives ghost cells the values of their owners, by active cells. Collective.
    template <int dim, typename T>
    void update_ghosts(const BackgroundGrid<dim> &grid, std::vector<T> &values)
    {
      if (Utilities::MPI::n_mpi_processes(grid.communicator()) > 1)
        GridTools::exchange_cell_data_to_ghosts<T, parallel::distributed::Triangulation<dim>>(
            grid.triangulation(),
            [&](const auto &cell) { return std::make_optional(values[cell->active_cell_index()]); },
            [&](const auto &cell, const T &value) { values[cell->active_cell_index()] = value; });
    }


    /// Calls `act(index)` with the active cells of the 3^dim around one, and with FineCells::none for those of the box
    /// that are not fine.
    template <int dim, typename Act>
    void for_each_near(const FineCells<dim> &fine, const unsigned int cell, const Act &act)
    {
      for (unsigned int i = 0; i < Utilities::pow(3u, dim); ++i)
        {
          CellPlace<dim> place = fine.cells()[fine.of_index(cell)].place;
          for (unsigned int a = 0, rest = i; a < dim; ++a, rest /= 3)
            place[a] += static_cast<int>(rest % 3) - 1;
          if (const unsigned int near = fine.find(place); near != FineCells<dim>::none)
            act(fine.cells()[near].index);
          else if (fine.box().contains(place))
            act(FineCells<dim>::none);
        }
    }


    /// Calls `act(fill)` with the owned cells of free water that are at least half full, as all cells around them are.
    /// @param fills volume of grains and water over that of the active cell, negative with soil points. Collective.
    template <int dim, typename Act>
    void for_each_full_cell(std::vector<double> &fills, const BackgroundGrid<dim> &grid, const Act &act)
    {
      update_ghosts(grid, fills);
      for (const auto &cell : grid.triangulation().active_cell_iterators())
        if (const double fill = fills[cell->active_cell_index()]; cell->is_locally_owned() && fill >= 0.5)
          {
            bool is_full = true;
            for_each_near(grid.fine_cells(), cell->active_cell_index(), [&](const unsigned int near) {
              is_full = is_full && near != FineCells<dim>::none && std::abs(fills[near]) >= 0.5;
            });
            if (is_full)
              act(fill);
          }
    }
  } // namespace


  template <int dim>
  WaterMeasures measure_water(const std::list<SoilBody<dim>> &bodies,
                              const std::list<WaterPhase<dim>> &water,
                              const BackgroundGrid<dim> &grid)
  {
    const double cell_volume = Utilities::fixed_power<dim>(grid.cell_size());
    WaterMeasures measures;
    double volume = 0., overfull = 0.; // of grains and water
    const std::vector<CellContents> contents = contents_of_cells(bodies, water, grid);
    std::vector<double> fills; // of active cells; negative with soil points
    for (const CellContents &cell : contents)
      {
        const double filled = cell.grain_volume + cell.water_volume;
        fills.push_back((cell.n_soil_points > 0 ? -1. : 1.) * filled / cell_volume);
        measures.n_points += cell.n_water_points;
        measures.mass += cell.water_mass;
        measures.mass_outside_soil += cell.n_soil_points == 0 ? cell.water_mass : 0.;
        overfull += std::max(0., filled - cell_volume);
        volume += filled;
      }
    double free_cells = 0., free_water = 0.; // over that of a cell
    for_each_full_cell(fills, grid, [&](const double fill) {
      ++free_cells;
      free_water += fill;
    });
    NumbersOf{ &measures.n_points, &measures.mass, &measures.mass_outside_soil, &overfull, &volume,
               &free_cells,        &free_water }
        .sum_over_ranks(grid.communicator());

    std::vector<double> largest(3, -std::numeric_limits<double>::infinity()); // -p, p, x
    for (const auto &one : water)
      for_each_point(one.points(), [&](const auto &point) {
        const double pressure = point.properties[one.layout.pressure];
        largest[0]            = std::max(largest[0], -pressure);
        largest[1]            = std::max(largest[1], pressure);
        largest[2]            = std::max(largest[2], point.location[0]);
      });
    Utilities::MPI::max(largest, grid.communicator(), largest);

    const bool is_there        = measures.n_points > 0;
    measures.smallest_pressure = is_there ? -largest[0] : 0.;
    measures.largest_pressure  = is_there ? largest[1] : 0.;
    measures.tip               = is_there ? largest[2] : grid.lower_corner()[0];
    measures.volume_error      = volume > 0 ? overfull / volume : 0.;
    measures.void_share        = free_cells > 0 ? std::max(0., 1. - free_water / free_cells) : 0.;
    return measures;
  }

  template decltype(measure_water<2>) measure_water<2>;
  template decltype(measure_water<3>) measure_water<3>;


  namespace
  {
    /// Sums over a cell's points: the normal matrix of a linear fit, of 1 and x about a common origin, and the
    /// pressure's right-hand side.
    template <int dim>
    struct Moments
    {
      Tensor<2, dim + 1> matrix;
      Tensor<1, dim + 1> rhs;

      template <class Archive>
      void serialize(Archive &archive, const unsigned int)
      {
        archive &matrix &rhs;
      }
    };

    /// The linear fit to points, of which there is one at least: what 1 and x are multiplied by; slopes that they do
    /// not determine are 0.
    template <int dim>
    Tensor<1, dim + 1> fit(const Moments<dim> &moments)
    {
      // Centred normal matrix: 1/n x^T x - mean mean^T.
      const double n = moments.matrix[0][0];
      Tensor<1, dim> mean, slope, covariance;
      SymmetricTensor<2, dim> spread;
      for (unsigned int a = 0; a < dim; ++a)
        {
          mean[a]       = moments.matrix[0][a + 1] / n;
          covariance[a] = moments.rhs[a + 1] / n - mean[a] * moments.rhs[0] / n;
          for (unsigned int b = 0; b <= a; ++b)
            spread[a][b] = moments.matrix[b + 1][a + 1] / n - mean[a] * mean[b];
        }
      // Of a cell width squared: the points spread along an axis whose principal value is above.
      constexpr double least = 1e-6;
      if (determinant(spread) > least * Utilities::fixed_power<dim - 1>(trace(spread))) // no value is below
        slope = invert(spread) * covariance;
      else
        for (const auto &[value, axis] : eigenvectors(spread))
          if (value > least)
            slope += (covariance * axis) / value * axis;
      Tensor<1, dim + 1> coefficients;
      coefficients[0] = moments.rhs[0] / n - slope * mean;
      for (unsigned int a = 0; a < dim; ++a)
        coefficients[a + 1] = slope[a];
      return coefficients;
    }


    /// 1 and x, in cells from the lower corner.
    template <int dim>
    Tensor<1, dim + 1> monomials_at(const Point<dim> &x, const BackgroundGrid<dim> &grid)
    {
      Tensor<1, dim + 1> monomials;
      monomials[0] = 1.;
      for (unsigned int a = 0; a < dim; ++a)
        monomials[a + 1] = (x[a] - grid.lower_corner()[a]) / grid.cell_size();
      return monomials;
    }


    /// Root mean square of what is left of the pressure after the linear fits around the points' cells, over the mean
    /// of its magnitude. Collective.
    /// @param for_each_set calls its argument with each set of points and a function of properties that is P or p, Pa
    template <int dim, typename ForEachSet>
    double oscillation(const BackgroundGrid<dim> &grid, const ForEachSet &for_each_set)
    {
      std::vector<Moments<dim>> moments(grid.triangulation().n_active_cells());
      for_each_set([&](const PointSet<dim> &points, const auto &pressure_of) {
        for_each_point(points, [&](const auto &point) {
          const Tensor<1, dim + 1> monomials = monomials_at(point.location, grid);
          moments[point.cell].matrix += outer_product(monomials, monomials);
          moments[point.cell].rhs += pressure_of(point.properties) * monomials;
        });
      });
      update_ghosts(grid, moments);
      std::vector<double> sums{ 0, 0, 0 }; // points, magnitude of the pressure, squared residual
      for_each_set([&](const PointSet<dim> &points, const auto &pressure_of) {
        for (const auto &cell : points.cells())
          {
            Moments<dim> around;
            for_each_near(grid.fine_cells(), cell.cell, [&](const unsigned int near) {
              if (near != FineCells<dim>::none)
                {
                  around.matrix += moments[near].matrix;
                  around.rhs += moments[near].rhs;
                }
            });
            if (around.matrix[0][0] == 0.)
              continue;
            const Tensor<1, dim + 1> coefficients = fit(around);
            for_each_point(cell, [&](const auto &point) {
              const double pressure = pressure_of(point.properties);
              const double residual = pressure - coefficients * monomials_at(point.location, grid);
              sums                  = { sums[0] + 1, sums[1] + std::abs(pressure), sums[2] + residual * residual };
            });
          }
      });
      Utilities::MPI::sum(sums, grid.communicator(), sums);
      return sums[1] > 0 ? std::sqrt(sums[2] / sums[0]) / (sums[1] / sums[0]) : 0.;
    }
  } // namespace


  template <int dim>
  double stress_oscillation(const std::list<SoilBody<dim>> &bodies, const BackgroundGrid<dim> &grid)
  {
    return oscillation(grid, [&](const auto &act) {
      for (const auto &body : bodies)
        if (!body.is_rigid)
          act(body.points, [slot = body.layout.stress](const double *properties) {
            return mean_effective_stress(properties + slot);
          });
    });
  }


  template <int dim>
  double pressure_oscillation(const std::list<WaterPhase<dim>> &water, const BackgroundGrid<dim> &grid)
  {
    return oscillation(grid, [&](const auto &act) {
      for (const auto &one : water)
        act(one.points(), [slot = one.layout.pressure](const double *properties) { return properties[slot]; });
    });
  }

  template decltype(stress_oscillation<2>) stress_oscillation<2>;
  template decltype(stress_oscillation<3>) stress_oscillation<3>;
  template decltype(pressure_oscillation<2>) pressure_oscillation<2>;
  template decltype(pressure_oscillation<3>) pressure_oscillation<3>;
} // namespace scree

// SPDX-License-Identifier: LGPL-2.1-or-later
// Volume change and elastic volume strain in the space of linear functions: constants and linear fields, sums over the
// points, stored energy, rotation and points without stress, for points off their lattice, at surfaces and in cells
// that are filled in part.
#include "../soil.h"

#include <scree/transfer/volume_projection.h>

#include <deal.II/base/symmetric_tensor.h>

#include <functional>

namespace test_volume_projection
{
constexpr double cell_size = 0.1;

/// A point, with ln J_e and dF at the start and what the projection makes of dF.
template <int dim>
struct Averaged
{
  Point<dim> x;
  double volume, strain, own_change, change, stretch;
  Tensor<2, dim> own_increment, increment;
};


template <int dim>
struct Soil
{
  explicit Soil(const std::string &region)
      : body(grid, region, 3, 0.4)
  {
    shake(body.points);
  }

  /// Averages the motion of points with elastic volume strain and dF that are functions of their place, under stress
  /// where `is_loaded`.
  template <typename Strain, typename Increment, typename IsLoaded>
  std::vector<Averaged<dim>> average(const Strain &strain, const Increment &increment, const IsLoaded &is_loaded)
  {
    std::vector<Averaged<dim>> points;
    for_each_point(body.points, [&](const auto &point) {
      double *b = point.properties + body.layout.left_cauchy_green, *stress = point.properties + body.layout.stress;
      const double ln_J_e = strain(point.location);
      for (unsigned int c = 0; c < n_symmetric_components<dim>; ++c)
        {
          b[c]      = c < 3 ? std::exp(2. / 3. * ln_J_e) : 0.;
          stress[c] = c < 3 && is_loaded(point.location) ? ln_J_e - 1e-6 : 0.;
        }
      const Tensor<2, dim> dF = increment(point.location);
      points.push_back(
          { point.location, point.properties[body.layout.volume], ln_J_e, determinant(dF), 0., 0., dF, {} });
    });

    BlockMotion<dim> motion;
    motion.resize(points.size());
    projection.clear(points.size());
    const auto for_each_cell = [&](const auto &act) {
      unsigned int first = 0;
      for (const auto &cell : body.points.cells())
        {
          act(cell, first);
          first += cell.n_points;
        }
    };
    for_each_cell([&](const auto &cell, const unsigned int first) {
      for (unsigned int p = first; p < first + cell.n_points; ++p)
        {
          motion.volume[p]        = points[p].volume;
          motion.volume_change[p] = points[p].own_change;
          for (unsigned int c = 0; c < dim * dim; ++c)
            motion.deformation_increment[c * motion.pitch + p] = points[p].own_increment[c / dim][c % dim];
        }
      projection.add(body, { &cell, &cell + 1, first, cell.n_points }, motion);
    });
    projection.fit();
    for_each_cell([&](const auto &cell, const unsigned int first) { projection.apply(cell, first, motion); });
    for (unsigned int p = 0; p < points.size(); ++p)
      {
        points[p].change  = motion.volume_change[p];
        points[p].stretch = motion.out_of_plane_stretch[p];
        for (unsigned int c = 0; c < dim * dim; ++c)
          points[p].increment[c / dim][c % dim] = motion.deformation_increment[c * motion.pitch + p];
      }
    return points;
  }

  template <typename Strain, typename Increment>
  std::vector<Averaged<dim>> average(const Strain &strain, const Increment &increment)
  {
    return average(strain, increment, [](const Point<dim> &) { return true; });
  }

  BackgroundGrid<dim> grid{ grid_box<dim>(0., 0.8, cell_size), MPI_COMM_WORLD };
  ElasticSoil<dim> body;
  VolumeProjection<dim> projection{ grid };
};


template <int dim>
double sum_over(const std::vector<Averaged<dim>> &points, double (*quantity)(const Averaged<dim> &))
{
  double sum = 0.;
  for (const auto &point : points)
    sum += point.volume * quantity(point);
  return sum_of_ranks(sum);
}


template <int dim>
Tensor<2, dim> unit()
{
  return unit_symmetric_tensor<dim>();
}

/// A shear of 2 %.
template <int dim>
Tensor<2, dim> shear(const Point<dim> &)
{
  Tensor<2, dim> dF = unit<dim>();
  dF[0][1]          = 0.02;
  return dF;
}

/// Shear and volume change of up to 2 % that differ from point to point.
template <int dim>
Tensor<2, dim> random_increment(const Point<dim> &x)
{
  Tensor<2, dim> dF = unit<dim>();
  for (unsigned int i = 0; i < dim; ++i)
    for (unsigned int j = 0; j < dim; ++j)
      dF[i][j] += 0.02 * pattern(x + (1. + i + dim * j) * Point<dim>::unit_vector(0));
  return dF;
}

template <int dim>
double none(const Point<dim> &)
{
  return 0.;
}

template <int dim>
double random_strain(const Point<dim> &x)
{
  return 0.01 * pattern(x);
}


/// While soil shears, constant dJ passes, and linear functions pass but for a part of their difference over a cell:
/// nothing inside, little beside faces of the cells, and in cells that are filled in part less than the third that
/// means about vertices would take at a face.
template <int dim>
void test_fields(const std::string &name)
{
  const auto growth = [](const Point<dim> &) { return 1.01 * unit<dim>(); };
  const auto largest_rest =
      [&](Soil<dim> &soil, const unsigned int axis, const double from, const double to, const double low) {
        const auto linear = [&](const Point<dim> &x) { return 0.003 * (x[axis] / cell_size - 4.); };
        double largest    = 0.;
        unsigned int n    = 0;
        for (const auto &point : soil.average(linear, shear<dim>))
          {
            bool is_meant = point.x[0] > from && point.x[0] < to;
            for (unsigned int a = 1; a < dim; ++a)
              is_meant = is_meant && point.x[a] > low && point.x[a] < 0.8 - low;
            n += is_meant;
            if (is_meant)
              largest = std::max(largest, std::abs(std::log(point.change)) / 0.003);
          }
        require(sum_of_ranks(n) > 8, name + "hardly any points were looked at");
        return max_of_ranks(largest);
      };

  Soil<dim> block("x > 0.2 && x < 0.6 && y > 0.2 && y < 0.6" + std::string(dim == 3 ? " && z > 0.2 && z < 0.6" : ""));
  Soil<dim> oblique("x + 0.7 * y < 0.63");
  for (auto *soil : { &block, &oblique })
    {
      double error = 0.;
      for (const auto &point : soil->average(none<dim>, growth))
        error = std::max(error, std::abs(point.change / point.own_change - 1.));
      expect(max_of_ranks(error), 0, 1e-14, name + "change of a constant dJ");
    }
  for (unsigned int axis = 0; axis < dim; ++axis)
    {
      expect(largest_rest(block, axis, 0.3, 0.5, 0.3), 0, 1e-3, name + "relaxation inside");
      expect(largest_rest(block, axis, 0.2, 0.3, 0.3), 0, 0.02, name + "relaxation beside a face");
      expect(largest_rest(oblique, axis, 0., 0.8, 0.), 0, 1. / 3., name + "relaxation in cells filled in part");
    }
}


/// Sums over the points, the stored energy and dF.
template <int dim>
void test_sums(const std::string &region, const std::string &name)
{
  Soil<dim> soil(region);
  const auto unstrained = soil.average(none<dim>, random_increment<dim>);
  const double own      = sum_over<dim>(unstrained, [](const auto &point) { return point.own_change; });
  const double averaged = sum_over<dim>(unstrained, [](const auto &point) { return point.change; });
  expect(averaged / own, 1, 1e-13, name + "sum of V dJ over that before");

  // Of each point, of each cell, alternating from cell to cell, linear.
  const auto cell_of = [](const Point<dim> &x) {
    return point_of<dim>([&](const unsigned int a) { return std::floor(x[a] / cell_size); });
  };
  const std::vector<std::function<double(const Point<dim> &)>> states = {
    random_strain<dim>,
    [&](const auto &x) { return random_strain<dim>(cell_of(x)); },
    [&](const auto &x) { return static_cast<long>(cell_of(x)[0] + cell_of(x)[1]) % 2 == 0 ? 0.01 : -0.01; },
    [&](const auto &x) { return 0.01 * x[0] / cell_size; }
  };
  for (unsigned int state = 0; state < states.size(); ++state)
    {
      auto points = soil.average(states[state], random_increment<dim>);
      for (unsigned int p = 0; p < points.size(); ++p)
        {
          Averaged<dim> &point = points[p];
          expect(determinant(point.increment) * (dim == 2 ? point.stretch : 1.) / point.change,
                 1,
                 1e-13,
                 name + "det of dF over dJ");
          const Tensor<2, dim> error = point.increment - point.stretch * point.own_increment;
          expect(error.norm(), 0, 1e-15, name + "distortion of dF");
          point.change /= unstrained[p].change; // exp(-r)
        }
      const double rest   = sum_over<dim>(points, [](const auto &point) { return std::log(point.change); });
      const double size   = sum_over<dim>(points, [](const auto &point) { return std::abs(std::log(point.change)); });
      const double before = sum_over<dim>(points, [](const auto &point) { return point.strain * point.strain; });
      const double after =
          sum_over<dim>(points, [](const auto &point) { return std::pow(point.strain + std::log(point.change), 2); });
      const std::string of_state = name + "state " + std::to_string(state) + ": ";
      expect(rest / size, 0, 1e-11, of_state + "sum of V r over that of V |r|");
      require(after < before, of_state + "stored energy grows");
      if (state < 3)
        require(after < 0.7 * before, of_state + "hardly anything relaxes");
    }
}


/// Soil whose stress has grown with its volume change: the average takes work from the nodes, and no more than they do.
template <int dim>
void test_work(const std::string &region, const std::string &name)
{
  Soil<dim> soil(region);
  const auto growth = [](const Point<dim> &x) { return std::cbrt(1. + random_strain<dim>(x)) * unit<dim>(); };
  double work       = 0.;
  for (const auto &point : soil.average(random_strain<dim>, growth))
    work += point.volume * point.strain * (point.own_change - 1.);
  const double kept = sum_of_ranks(soil.projection.kept_work()) / sum_of_ranks(work);
  require(kept > 0.3 && kept < 1., name + "of the work on a volume change without order, too much or little is kept");
  soil.average(none<dim>, [](const Point<dim> &) { return 1.01 * unit<dim>(); });
  expect(soil.projection.kept_work(), 0, 1e-14, name + "kept work of a constant volume change");
}


/// A rotation of 0.1 rad is no shear.
template <int dim>
void test_rotation(const std::string &region, const std::string &name)
{
  Soil<dim> soil(region);
  const auto rotation = [](const Point<dim> &) {
    Tensor<2, dim> dF = unit<dim>();
    dF[0][0] = dF[1][1] = std::cos(0.1);
    dF[1][0]            = std::sin(0.1);
    dF[0][1]            = -dF[1][0];
    return dF;
  };
  double largest = 0.;
  for (const auto &point : soil.average(random_strain<dim>, rotation))
    largest = std::max(largest, std::abs(point.change - 1.));
  expect(max_of_ranks(largest), 0, 1e-14, name + "change of volume by a rotation");
}


/// Points without stress keep their motion, and what they do does not matter to others.
template <int dim>
void test_free_points(const std::string &region, const std::string &name)
{
  Soil<dim> soil(region);
  const auto is_loaded = [](const Point<dim> &x) { return pattern(3. * x) < 0.4; };
  const auto average   = [&](const double factor) {
    return soil.average([&](const auto &x) { return (is_loaded(x) ? 1. : factor) * random_strain<dim>(x); },
                        [&](const auto &x) { return (is_loaded(x) ? 1. : factor) * random_increment<dim>(x); },
                        is_loaded);
  };
  const auto one = average(1.), other = average(1.3);
  unsigned int n_free = 0;
  for (unsigned int p = 0; p < one.size(); ++p)
    if (is_loaded(one[p].x))
      expect(one[p].change, other[p].change, 0, name + "dJ of a point under stress, by those without");
    else
      {
        ++n_free;
        expect(other[p].change, other[p].own_change, 0, name + "dJ of a point without stress");
        expect(other[p].stretch, 1, 0, name + "stretch of a point without stress");
        expect((other[p].increment - other[p].own_increment).norm(), 0, 0, name + "error of dF without stress");
      }
  require(sum_of_ranks(n_free) > 20, name + "hardly any points are without stress");
}


template <int dim>
void test()
{
  const std::string name = std::to_string(dim) + "D: ", oblique = "x + 0.7 * y < 0.63";
  test_fields<dim>(name);
  test_sums<dim>(oblique, name);
  test_work<dim>(oblique, name);
  test_rotation<dim>(oblique, name);
  test_free_points<dim>(oblique, name);
}


const UnitTest registered("volume_projection", [] {
  test<2>();
  test<3>();
});
} // namespace test_volume_projection

// Runs with mpirun=1,2.

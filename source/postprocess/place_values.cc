// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/postprocess/place_values.h>
#include <scree/tensor/invariants.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/symmetric_tensor.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace scree
{
  using namespace dealii;

  /// For each place, in cell sizes from there: the number of points that are close; the moments of the weights, 1, x
  /// and x x^T; and of each quantity its sum and its moment.
  template <int dim>
  struct PlaceValues<dim>::Sums
  {
    static constexpr unsigned int n_monomials = dim + 1;
    static constexpr unsigned int first_value = 1 + n_monomials * n_monomials;

    const unsigned int n_values, stride;
    std::vector<double> all;

    Sums(const unsigned int n_places, const unsigned int n_values)
        : n_values(n_values)
        , stride(first_value + n_monomials * n_values)
        , all(n_places * stride, 0.)
    {
    }

    double *of(const unsigned int place)
    {
      return all.data() + place * stride;
    }
  };


  template <int dim>
  PlaceValues<dim>::PlaceValues(const BackgroundGrid<dim> &grid, const std::vector<Point<dim>> &places)
      : grid(grid)
      , place_list(places)
  {
    for (unsigned int i = 0; i < places.size(); ++i)
      for (unsigned int n = 0; n < Utilities::fixed_power<dim>(3u); ++n)
        {
          CellPlace cell;
          for (unsigned int a = 0, rest = n; a < dim; ++a, rest /= 3)
            cell[a] = static_cast<int>(std::floor((places[i][a] - grid.lower_corner()[a]) / grid.cell_size())) +
                      static_cast<int>(rest % 3) - 1;
          places_near_cell[cell].push_back(i);
        }
  }


  template <int dim>
  std::vector<std::string> PlaceValues<dim>::names_of_soil()
  {
    std::vector<std::string> names;
    for (unsigned int a = 0; a < dim; ++a)
      names.push_back(std::string("Velocity ") + "xyz"[a] + " (m/s)");
    for (const std::string component : { "xx", "yy", "zz", "xy", "xz", "yz" })
      if (dim == 3 || (component != "xz" && component != "yz"))
        names.push_back("Effective stress " + component + " (Pa)");
    names.push_back("Mean effective stress (Pa)");
    names.push_back("Porosity (-)");
    return names;
  }


  template <int dim>
  std::vector<std::string> PlaceValues<dim>::names_of_water()
  {
    std::vector<std::string> names{ "Pore pressure (Pa)" };
    for (unsigned int a = 0; a < dim; ++a)
      names.push_back(std::string("Water velocity ") + "xyz"[a] + " (m/s)");
    return names;
  }


  template <int dim>
  const std::vector<unsigned int> &PlaceValues<dim>::near(const ConstCellPoints<dim> &cell) const
  {
    static const std::vector<unsigned int> none;
    CellPlace key;
    for (unsigned int a = 0; a < dim; ++a)
      key[a] = static_cast<int>(std::lround((cell.location_of(0)[a] - grid.lower_corner()[a]) / grid.cell_size() -
                                            cell.reference_location_of(0)[a]));
    const auto found = places_near_cell.find(key);
    return found == places_near_cell.end() ? none : found->second;
  }


  template <int dim>
  void PlaceValues<dim>::add(Sums &sums,
                             const unsigned int place,
                             const Point<dim> &x,
                             const double mass,
                             const std::vector<double> &values) const
  {
    constexpr double half = 0.5 * (1 + 1e-6); // rounding must not decide about points on the edge
    const auto distance   = (x - place_list[place]) / grid.cell_size();
    double weight         = mass;
    bool is_close         = true;
    for (unsigned int a = 0; a < dim; ++a)
      {
        weight *= std::max(0., 1. - std::abs(distance[a]));
        is_close = is_close && std::abs(distance[a]) <= half;
      }
    if (weight <= 0.)
      return;
    std::array<double, dim + 1> monomials{ { 1. } };
    for (unsigned int a = 0; a < dim; ++a)
      monomials[a + 1] = distance[a];
    double *sum = sums.of(place);
    *sum++ += is_close;
    for (const double m : monomials)
      for (const double n : monomials)
        *sum++ += weight * m * n;
    for (const double value : values)
      for (const double m : monomials)
        *sum++ += weight * m * value;
  }


  template <int dim>
  std::vector<std::vector<double>> PlaceValues<dim>::fit(Sums &sums) const
  {
    // Of the weights along an axis, in cell sizes squared: below it, points lie too close together for a slope.
    constexpr double smallest_spread = 0.02;
    constexpr unsigned int n         = dim + 1;
    Utilities::MPI::sum(sums.all, grid.communicator(), sums.all);
    std::vector<std::vector<double>> table(
        place_list.size(), std::vector<double>(sums.n_values, std::numeric_limits<double>::quiet_NaN()));
    for (unsigned int i = 0; i < place_list.size(); ++i)
      {
        if (sums.of(i)[0] == 0.)
          continue;
        const double *matrix = sums.of(i) + 1, weight = matrix[0];
        Tensor<1, dim> mean;
        for (unsigned int a = 0; a < dim; ++a)
          mean[a] = matrix[a + 1] / weight;
        SymmetricTensor<2, dim> spread;
        for (unsigned int a = 0; a < dim; ++a)
          for (unsigned int b = a; b < dim; ++b)
            spread[a][b] = matrix[(a + 1) * n + b + 1] / weight - mean[a] * mean[b];
        // The fit at the place itself is the mean minus mean . spread^-1 . covariance.
        Tensor<1, dim> to_place;
        for (const auto &[value, axis] : eigenvectors(spread))
          if (value > smallest_spread)
            to_place -= (mean * axis) / value * axis;
        for (unsigned int v = 0; v < sums.n_values; ++v)
          {
            const double *moments = sums.of(i) + Sums::first_value + v * n;
            table[i][v]           = moments[0] / weight;
            for (unsigned int a = 0; a < dim; ++a)
              table[i][v] += to_place[a] * (moments[a + 1] / weight - mean[a] * moments[0] / weight);
          }
      }
    return table;
  }


  template <int dim>
  std::vector<std::vector<double>> PlaceValues<dim>::of_soil(const std::list<SoilBody<dim>> &bodies) const
  {
    std::vector<double> values(names_of_soil().size());
    Sums sums(place_list.size(), values.size());
    for (const auto &body : bodies)
      for (const auto &cell : body.points.cells())
        for (const unsigned int place : near(cell))
          for_each_point(cell, [&](const auto &point) {
            const double *properties = point.properties, *stress = properties + body.layout.stress;
            auto next = std::copy_n(properties + body.layout.velocity, dim, values.begin());
            next      = std::copy_n(stress, n_symmetric_components<dim>, next);
            *next++   = mean_effective_stress(stress);
            *next++   = body.porosity(properties);
            add(sums, place, point.location, properties[body.layout.mass], values);
          });
    return fit(sums);
  }


  template <int dim>
  std::vector<std::vector<double>> PlaceValues<dim>::of_water(const std::list<WaterPhase<dim>> &water) const
  {
    std::vector<double> values(names_of_water().size());
    Sums sums(place_list.size(), values.size());
    for (const auto &one : water)
      for (const auto &cell : one.points().cells())
        for (const unsigned int place : near(cell))
          for_each_point(cell, [&](const auto &point) {
            const double *properties = point.properties;
            values[0]                = properties[one.layout.pressure];
            std::copy_n(properties + one.layout.velocity, dim, values.begin() + 1);
            add(sums, place, point.location, properties[one.layout.mass], values);
          });
    return fit(sums);
  }

  template class PlaceValues<2>;
  template class PlaceValues<3>;
} // namespace scree

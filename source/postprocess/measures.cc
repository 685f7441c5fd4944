// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/postprocess/measures.h>

#include <scree/postprocess/cell_contents.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <utility>

namespace scree
{
  using namespace dealii;

  std::vector<double> percentiles(const std::vector<PartOfMass> &all,
                                  const double lower,
                                  const double upper,
                                  const std::vector<double> &fractions,
                                  const MPI_Comm communicator)
  {
    struct Search
    {
      double begin, end, below, wanted;
      std::vector<PartOfMass> parts; // all that may lie between begin and end
    };
    std::vector<Search> searches(fractions.size(), { lower, upper, 0., 0., {} });

    // Each pass finds the bin in which the given mass is reached and looks into it the next time.
    constexpr unsigned int n_bins = 1000, n_passes = 5;
    std::vector<double> bins;
    for (unsigned int pass = 0; pass < n_passes; ++pass)
      {
        bins.assign(n_bins * searches.size(), 0.);
        for (unsigned int s = 0; s < searches.size(); ++s)
          {
            const auto &[begin, end, below, wanted, parts] = searches[s];
            for (const PartOfMass &part : pass == 0 ? all : parts)
              if (const double position = (part.place - begin) / (end - begin) * n_bins;
                  position >= 0 && position < n_bins)
                bins[s * n_bins + static_cast<unsigned int>(position)] += part.mass;
          }
        Utilities::MPI::sum(bins, communicator, bins);
        for (unsigned int s = 0; s < searches.size(); ++s)
          {
            auto &[begin, end, below, wanted, parts] = searches[s];
            const double *bin_of_search              = bins.data() + s * n_bins;
            if (pass == 0)
              for (unsigned int bin = 0; bin < n_bins; ++bin)
                wanted += fractions[s] * bin_of_search[bin];
            // Equal masses often add up to just the given part: rounding must not choose the point.
            unsigned int bin = 0;
            while (bin + 1 < n_bins && below + bin_of_search[bin] < wanted * (1. - 1e-12))
              below += bin_of_search[bin++];
            const double width = (end - begin) / n_bins;
            begin += bin * width;
            end                = begin + width;
            const auto &before = pass == 0 ? all : parts;
            std::vector<PartOfMass> kept;
            // Rounding decides anew about the edges.
            std::copy_if(before.begin(),
                         before.end(),
                         std::back_inserter(kept),
                         [first = begin - width, last = end + width](const PartOfMass &part) {
                           return part.place >= first && part.place < last;
                         });
            parts = std::move(kept);
          }
      }
    std::vector<double> result;
    for (const Search &search : searches)
      result.push_back(0.5 * (search.begin + search.end));
    return result;
  }


  namespace
  {
    /// This rank's points of a set go to `parts`, by their coordinate along an axis.
    template <int dim>
    void append_parts(const PointSet<dim> &points,
                      const unsigned int mass_slot,
                      const unsigned int axis,
                      std::vector<PartOfMass> &parts)
    {
      for_each_point(points, [&](const auto &point) {
        parts.push_back({ point.location[axis], point.properties[mass_slot] });
      });
    }
  } // namespace


  template <int dim>
  std::vector<double> mass_percentiles(const std::list<SoilBody<dim>> &bodies,
                                       const BackgroundGrid<dim> &grid,
                                       const unsigned int axis,
                                       const std::vector<double> &fractions)
  {
    std::vector<PartOfMass> parts;
    for (const auto &body : bodies)
      if (!body.is_rigid)
        append_parts(body.points, body.layout.mass, axis, parts);
    return percentiles(parts, grid.lower_corner()[axis], grid.upper_corner()[axis], fractions, grid.communicator());
  }


  template <int dim>
  std::vector<double> mass_percentiles(const std::list<WaterPhase<dim>> &water,
                                       const BackgroundGrid<dim> &grid,
                                       const unsigned int axis,
                                       const std::vector<double> &fractions)
  {
    std::vector<PartOfMass> parts;
    for (const auto &one : water)
      append_parts(one.points(), one.layout.mass, axis, parts);
    return percentiles(parts, grid.lower_corner()[axis], grid.upper_corner()[axis], fractions, grid.communicator());
  }


  template <int dim>
  double least_distance(const std::list<SoilBody<dim>> &bodies,
                        const std::list<WaterPhase<dim>> &water,
                        const DiscreteLevelSet<dim> &surface,
                        const MPI_Comm communicator)
  {
    double least       = surface.reach();
    const auto include = [&](const PointSet<dim> &points) {
      for (const auto &cell : points.cells())
        if (surface.least_distance(cell.cell) < least)
          for_each_point(cell, [&](const auto &point) {
            least = std::min(
                least, surface.distance_of(point.cell, point.reference_location, point.location, std::min(0., least)));
          });
    };
    for (const auto &body : bodies)
      if (!body.is_rigid)
        include(body.points);
    for (const auto &part : water)
      if (part.carrier() == nullptr)
        include(part.points());
    return Utilities::MPI::min(least, communicator);
  }


  template <int dim>
  WaterMeasures measure_water(const std::list<SoilBody<dim>> &bodies,
                              const std::list<WaterPhase<dim>> &water,
                              const BackgroundGrid<dim> &grid)
  {
    const double cell_volume = Utilities::fixed_power<dim>(grid.cell_size());
    std::vector<double> sums(5, 0.); // water points, water mass, that outside soil, overfull volume, volume
    for (const CellContents &cell : contents_of_cells(bodies, water, grid))
      {
        const double volume = cell.grain_volume + cell.water_volume;
        sums[0] += cell.n_water_points;
        sums[1] += cell.water_mass;
        sums[2] += cell.n_soil_points == 0 ? cell.water_mass : 0.;
        sums[3] += std::max(0., volume - cell_volume);
        sums[4] += volume;
      }
    Utilities::MPI::sum(sums, grid.communicator(), sums);

    std::vector<double> largest(3, -std::numeric_limits<double>::infinity()); // -p, p, x
    for (const auto &one : water)
      for_each_point(one.points(), [&](const auto &point) {
        const double pressure = point.properties[one.layout.pressure];
        largest[0]            = std::max(largest[0], -pressure);
        largest[1]            = std::max(largest[1], pressure);
        largest[2]            = std::max(largest[2], point.location[0]);
      });
    Utilities::MPI::max(largest, grid.communicator(), largest);

    WaterMeasures measures;
    measures.n_points          = sums[0];
    measures.mass              = sums[1];
    measures.mass_outside_soil = sums[2];
    measures.smallest_pressure = sums[0] > 0 ? -largest[0] : 0.;
    measures.largest_pressure  = sums[0] > 0 ? largest[1] : 0.;
    measures.tip               = sums[0] > 0 ? largest[2] : grid.lower_corner()[0];
    measures.volume_error      = sums[4] > 0 ? sums[3] / sums[4] : 0.;
    return measures;
  }

  template std::vector<double> mass_percentiles(const std::list<SoilBody<2>> &,
                                                const BackgroundGrid<2> &,
                                                const unsigned int,
                                                const std::vector<double> &);
  template std::vector<double> mass_percentiles(const std::list<WaterPhase<2>> &,
                                                const BackgroundGrid<2> &,
                                                const unsigned int,
                                                const std::vector<double> &);
  template double least_distance(const std::list<SoilBody<2>> &,
                                 const std::list<WaterPhase<2>> &,
                                 const DiscreteLevelSet<2> &,
                                 const MPI_Comm);
  template double least_distance(const std::list<SoilBody<3>> &,
                                 const std::list<WaterPhase<3>> &,
                                 const DiscreteLevelSet<3> &,
                                 const MPI_Comm);
  template WaterMeasures
  measure_water(const std::list<SoilBody<2>> &, const std::list<WaterPhase<2>> &, const BackgroundGrid<2> &);

  template std::vector<double> mass_percentiles(const std::list<SoilBody<3>> &,
                                                const BackgroundGrid<3> &,
                                                const unsigned int,
                                                const std::vector<double> &);
  template std::vector<double> mass_percentiles(const std::list<WaterPhase<3>> &,
                                                const BackgroundGrid<3> &,
                                                const unsigned int,
                                                const std::vector<double> &);
  template WaterMeasures
  measure_water(const std::list<SoilBody<3>> &, const std::list<WaterPhase<3>> &, const BackgroundGrid<3> &);
} // namespace scree

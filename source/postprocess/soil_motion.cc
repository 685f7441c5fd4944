// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/boundary/boundary_conditions.h>
#include <scree/postprocess/soil_motion.h>
#include <scree/tensor/vector.h>

#include <deal.II/base/symmetric_tensor.h>

namespace scree
{
  using namespace dealii;

  namespace
  {
    constexpr double flow_part      = 0.1;  // of sqrt(g h): oscillations of soil at rest are slower
    constexpr double least_change   = 0.1;  // of the cell size: less is no deposit of a column
    constexpr double part_of_height = 0.01; // of all soil: what has moved by more, horizontally, has failed
    constexpr double part_of_mass   = 0.99; // of failed soil, behind the toe and in front of the scarp
    constexpr double steepest_wall  = 0.5;  // cosine of the slope: steeper ground is a wall beside the soil

    /// Length normal to the ground over that along the last axis.
    template <int dim, typename PointOfSet>
    double cosine_of_ground(const DiscreteLevelSet<dim> *bed, const PointOfSet &point)
    {
      if (bed == nullptr || !bed->is_near(point.cell))
        return 1.;
      const double cosine = std::abs(bed->view(point.cell, point.reference_location).normal[dim - 1]);
      return cosine > steepest_wall ? cosine : 1.;
    }


    /// The value that half of the sum of all values exceeds; 0 if there are none.
    double median_by_volume(std::vector<double> values)
    {
      std::sort(values.begin(), values.end());
      double all = 0., below = 0.;
      for (const double value : values)
        all += value;
      for (const double value : values)
        if ((below += value) >= 0.5 * all)
          return value;
      return 0.;
    }
  } // namespace


  template <int dim>
  MotionNumbers SoilMotion<dim>::look(const std::list<SoilBody<dim>> &bodies,
                                      const Tensor<1, 2 * dim> &lost_masses,
                                      const double time)
  {
    const std::size_t n = columns.size();
    std::vector<double> sums(2 * n + 2, 0.); // thickness, that of moving soil; mass, kinetic energy
    std::vector<PartOfMass> speeds;
    const bool is_start     = start_thickness.empty();
    const double flow_speed = flow_part * std::sqrt(gravity.norm() * grid.cell_size());
    for_each_moving_point(bodies, [&](const SoilBody<dim> &body, const auto &point) {
      const double mass   = point.properties[body.layout.mass];
      const double speed  = vector_of<dim>(point.properties + body.layout.velocity).norm();
      const double share  = point.properties[body.layout.volume] / columns.area();
      const double moving = is_start || speed > flow_speed ? share * cosine_of_ground(bed, point) : 0.;
      for (const auto &[column, weight] : columns.around(point.location))
        {
          sums[column] += weight * share;
          sums[n + column] += weight * moving;
        }
      sums[2 * n] += mass;
      sums[2 * n + 1] += 0.5 * mass * speed * speed;
      speeds.push_back({ speed, mass });
    });
    Utilities::MPI::sum(sums, grid.communicator(), sums);

    last           = path(bodies);
    last_time      = time;
    soil_mass      = sums[2 * n];
    lost           = lost_masses;
    last.speed     = percentile(speeds, 0.99, grid.communicator());
    last.thickness = median_by_volume({ sums.begin() + n, sums.begin() + 2 * n }) / grid.cell_size();
    if (last.speed > flow_speed && sums[2 * n + 1] > largest_kinetic)
      {
        largest_kinetic = sums[2 * n + 1];
        thickness_then  = last.thickness;
      }
    if (is_start)
      start_thickness.assign(sums.begin(), sums.begin() + n);
    for (std::size_t c = 0; c < n; ++c)
      if (const double gain = sums[c] - start_thickness[c]; gain > least_change * grid.cell_size())
        {
          last.area += columns.area();
          last.volume += gain * columns.area();
        }
    return last;
  }


  template <int dim>
  MotionNumbers SoilMotion<dim>::path(const std::list<SoilBody<dim>> &bodies) const
  {
    struct Piece
    {
      Tensor<1, dim> start, place, velocity; // m, m/s
      double mass;                           // kg
    };
    MotionNumbers result;
    if (gravity.norm() == 0.)
      return result;
    const MPI_Comm communicator = grid.communicator();
    const Tensor<1, dim> up     = -gravity / gravity.norm();
    const auto for_each_piece   = [&](const auto &act) {
      for_each_moving_point(bodies, [&](const SoilBody<dim> &body, const auto &point) {
        act(Piece{ vector_of<dim>(point.properties + body.layout.start),
                   Tensor<1, dim>(point.location),
                   vector_of<dim>(point.properties + body.layout.velocity),
                   point.properties[body.layout.mass] });
      });
    };
    std::vector<PartOfMass> ways;
    std::vector<double> ends(2, std::numeric_limits<double>::lowest()); // largest height, and minus the smallest, m
    for_each_piece([&](const Piece &piece) {
      ways.push_back({ (piece.place - piece.start).norm(), piece.mass });
      for (const double height : { up * piece.start, up * piece.place })
        ends = { std::max(ends[0], height), std::max(ends[1], -height) };
    });
    Utilities::MPI::max(ends, communicator, ends);
    result.height               = std::max(ends[0] + ends[1], grid.cell_size());
    result.largest_displacement = percentile(ways, 0.999, communicator);

    std::vector<Piece> failed;
    double mass = 0., impulse = 0., failed_impulse = 0.; // sums of mass, and of mass times speed
    SymmetricTensor<2, dim> spread;                      // of horizontal displacements, kg m^2
    Tensor<1, dim> way;                                  // sum of them, kg m
    for_each_piece([&](const Piece &piece) {
      const Tensor<1, dim> displacement = piece.place - piece.start, on_map = displacement - (displacement * up) * up;
      mass += piece.mass;
      impulse += piece.mass * piece.velocity.norm();
      if (on_map.norm() <= part_of_height * result.height)
        return;
      failed.push_back(piece);
      result.failed_mass += piece.mass;
      failed_impulse += piece.mass * piece.velocity.norm();
      spread += piece.mass * symmetrize(outer_product(on_map, on_map));
      way += piece.mass * on_map;
    });
    NumbersOf sums{ &mass, &impulse, &result.failed_mass, &failed_impulse };
    sums &way;
    sums.sum_over_ranks(communicator);
    spread            = Utilities::MPI::sum(spread, communicator);
    result.mean_speed = result.failed_mass > 0. ? failed_impulse / result.failed_mass : mass > 0. ? impulse / mass : 0.;
    if (result.failed_mass == 0.)
      return result;

    // Soil that spreads to both sides has no mean direction, but an axis.
    const Tensor<1, dim> axis = eigenvectors(spread)[0].second, forward = (axis * way < 0. ? -1. : 1.) * axis;
    std::vector<PartOfMass> heights, starts, places; // along gravity; along the motion
    for (const Piece &piece : failed)
      {
        heights.push_back({ up * piece.start, piece.mass });
        starts.push_back({ forward * piece.start, piece.mass });
        places.push_back({ forward * piece.place, piece.mass });
      }
    const double toe        = percentile(places, part_of_mass, communicator);
    result.length           = toe - percentile(starts, 1. - part_of_mass, communicator);
    result.toe_displacement = toe - percentile(starts, part_of_mass, communicator);
    double toe_mass = 0., toe_height = 0.; // kg, kg m
    for (const Piece &piece : failed)
      if (forward * piece.place >= toe - 1e-9 * grid.cell_size())
        {
          toe_mass += piece.mass;
          toe_height += piece.mass * (up * piece.place);
          result.toe_speed += piece.mass * (forward * piece.velocity);
        }
    NumbersOf{ &toe_mass, &toe_height, &result.toe_speed }.sum_over_ranks(communicator);
    result.toe_speed /= toe_mass;
    result.fall = percentile(heights, 0.999, communicator) - toe_height / toe_mass; // a single point is no scarp
    return result;
  }


  template <int dim>
  std::vector<CheckResult> SoilMotion<dim>::results() const
  {
    std::vector<CheckResult> list;
    if (largest_kinetic > 0. && gravity.norm() > 0.)
      list.push_back({ "thickness of the moving soil",
                       short_text(thickness_then) + " cells",
                       "at least " + short_text(least_cells),
                       thickness_then < least_cells,
                       "for thicknesses, use cells of at most " +
                           short_text(thickness_then * grid.cell_size() / least_cells) + " m; reach and area hold",
                       Finding::resolution });
    if (last.failed_mass > 0.)
      list.push_back({ "speed of failed soil at the end",
                       short_text(std::max(last.mean_speed, std::abs(last.toe_speed))) + " m/s",
                       short_text(rest_speed()) + " m/s",
                       !is_at_rest(),
                       "the run-out is not final: write a later \"End time\"",
                       Finding::resolution });
    return list;
  }


  template <int dim>
  std::string SoilMotion<dim>::text() const
  {
    if (!(soil_mass > 0.) || gravity.norm() == 0.)
      return "";
    std::string lines =
        in_lines("Motion",
                 std::string(is_at_rest() ? "at rest" : "not at rest") + " at the end, t = " + short_text(last_time) +
                     " s: " + (last.failed_mass > 0. ? "failed soil moves at " : "the soil moves at ") +
                     short_text(last.mean_speed) + " m/s in the mean, the toe at " + short_text(last.toe_speed) +
                     " m/s; at rest below " + short_text(rest_speed()) + " m/s (0.002 sqrt(g H))");
    if (last.failed_mass == 0.)
      return lines;
    lines +=
        '\n' + in_lines("Run-out",
                        (is_at_rest() ? "" : "so far: ") + ("H = " + short_text(last.fall)) +
                            " m, L = " + short_text(last.length) + " m, H/L = " + short_text(last.drop_ratio()) +
                            ", travel angle " + short_text(last.travel_angle()) + " degrees; the toe has moved " +
                            short_text(last.toe_displacement) + " m, the fastest soil " +
                            short_text(last.largest_displacement) + " m; deposit " + short_text(last.area) +
                            (dim == 2 ? " m, " : " m^2, ") + short_text(last.volume) + (dim == 2 ? " m^3/m" : " m^3"));
    double all        = 0.;
    unsigned int face = 0; // through which most has left
    for (unsigned int f = 0; f < 2 * dim; ++f)
      {
        all += lost[f];
        face = lost[f] > lost[face] ? f : face;
      }
    if (all > 0.)
      lines += '\n' + in_lines("",
                               "a lower bound: " + short_text(100. * all / (soil_mass + all)) +
                                   " % of the soil has left the box, most of it through " + wall_text(grid, face));
    return lines;
  }

  template class SoilMotion<2>;
  template class SoilMotion<3>;
} // namespace scree

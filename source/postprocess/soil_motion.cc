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
    constexpr double flow_part      = 0.1;    // of sqrt(g h): oscillations of soil at rest are slower
    constexpr double least_change   = 0.1;    // of the cell size: less is no deposit of a column
    constexpr double part_of_height = 0.0125; // of all soil: what has moved by more, horizontally, has failed
    constexpr double part_of_mass   = 0.99;   // of failed soil, behind the toe and in front of the scarp
    constexpr double least_run      = 0.1;    // of L, of the toe: after less, H/L is that before the motion
    constexpr double steepest_wall  = 0.5;    // cosine of the slope: steeper ground is a wall beside the soil

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
    std::vector<Piece> pieces;
    for_each_moving_point(bodies, [&](const SoilBody<dim> &body, const auto &point) {
      pieces.push_back({ vector_of<dim>(point.properties + body.layout.start),
                         Tensor<1, dim>(point.location),
                         vector_of<dim>(point.properties + body.layout.velocity),
                         point.properties[body.layout.mass] });
    });
    const auto below = [&](const double fraction, const auto &value) { // what a fraction of the pieces' mass is below
      std::vector<PartOfMass> parts;
      for (const Piece &piece : pieces)
        parts.push_back({ value(piece), piece.mass });
      return percentile(parts, fraction, communicator);
    };
    const auto on_map = [&](const Piece &piece) { // displacement, m
      return piece.place - piece.start - up * (piece.place - piece.start) * up;
    };
    result.height               = std::max(grid.cell_size(),
                             below(1., [&](const Piece &p) { return std::max(up * p.start, up * p.place); }) -
                                 below(0., [&](const Piece &p) { return std::min(up * p.start, up * p.place); }));
    result.largest_displacement = below(0.999, [](const Piece &p) { return (p.place - p.start).norm(); });

    std::vector<double> sums(3, 0.); // mass, and mass times speed, kg m/s, of all and of failed soil
    Tensor<1, dim> way;              // of failed soil, times mass, kg m
    SymmetricTensor<2, dim> spread;  // way times way times mass, kg m^2
    std::vector<Piece> failed;
    for (const Piece &piece : pieces)
      {
        // Along the way so far: elastic oscillations cancel each other.
        const Tensor<1, dim> displacement = piece.place - piece.start;
        const double speed =
            displacement.norm() > 0. ? piece.mass * (piece.velocity * displacement) / displacement.norm() : 0.;
        const bool fails = on_map(piece).norm() > part_of_height * result.height;
        sums             = { sums[0] + piece.mass, sums[1] + speed, sums[2] + fails * speed };
        if (fails)
          {
            failed.push_back(piece);
            result.failed_mass += piece.mass;
            way += piece.mass * on_map(piece);
            spread += piece.mass * symmetrize(outer_product(on_map(piece), on_map(piece)));
          }
      }
    Utilities::MPI::sum(sums, communicator, sums);
    result.failed_mass = Utilities::MPI::sum(result.failed_mass, communicator);
    if (result.failed_mass == 0.)
      {
        result.mean_speed = sums[0] > 0. ? sums[1] / sums[0] : 0.;
        return result;
      }
    pieces = failed;

    // Soil that spreads to both sides has no mean direction, but an axis.
    const Tensor<1, dim> axis    = eigenvectors(Utilities::MPI::sum(spread, communicator))[0].second;
    const Tensor<1, dim> forward = (axis * Utilities::MPI::sum(way, communicator) < 0. ? -1. : 1.) * axis;
    const auto start             = [&](const Piece &piece) { return forward * piece.start; };
    const double toe             = below(part_of_mass, [&](const Piece &piece) { return forward * piece.place; });
    result.mean_speed            = sums[2] / result.failed_mass;
    result.length                = toe - below(1. - part_of_mass, start);
    result.toe_displacement      = toe - below(part_of_mass, start);
    sums.assign(2, 0.); // mass of the toe, and times speed
    double toe_height = std::numeric_limits<double>::lowest();
    for (const Piece &piece : pieces)
      if (forward * piece.place >= toe - 1e-9 * grid.cell_size())
        {
          sums       = { sums[0] + piece.mass, sums[1] + piece.mass * (forward * piece.velocity) };
          toe_height = std::max(toe_height, up * piece.place);
        }
    Utilities::MPI::sum(sums, communicator, sums);
    result.toe_speed = sums[1] / sums[0];
    result.fall      = below(0.999, [&](const Piece &piece) { return up * piece.start; }) - // no single point
                  Utilities::MPI::max(toe_height, communicator);
    result.ratio        = result.length > 0. ? result.fall / result.length : 0.;
    result.travel_angle = std::atan(result.ratio) * 180. / numbers::PI;
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
                       "for thickness and stress, use cells of at most " +
                           short_text(thickness_then * grid.cell_size() / least_cells) +
                           " m; the toe of dry soil is known to " + short_text(toe_cells) + " cells, " +
                           short_text(toe_cells * grid.cell_size()) + " m",
                       Finding::resolution });
    if (last.failed_mass > 0.)
      list.push_back({ "speed of failed soil at the end",
                       short_text(std::max(std::abs(last.mean_speed), std::abs(last.toe_speed))) + " m/s",
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
                     " m/s; at rest below " + short_text(rest_speed()) + " m/s (0.004 sqrt(g H))");
    if (last.failed_mass == 0.)
      return lines;
    const bool has_run = last.toe_displacement >= least_run * last.length;
    lines +=
        '\n' + in_lines("Run-out",
                        (is_at_rest() ? "" : "so far: ") + ("H = " + short_text(last.fall)) +
                            " m, L = " + short_text(last.length) + " m, H/L = " + short_text(last.ratio) +
                            (has_run ? ", travel angle " + short_text(last.travel_angle) + " degrees"
                                     : " of the slope itself") +
                            "; the toe has moved " + short_text(last.toe_displacement) + " m, the soil at most " +
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

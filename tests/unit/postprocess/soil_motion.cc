// SPDX-License-Identifier: LGPL-2.1-or-later
// The path of a run-out of a block that is moved by hand: along each horizontal axis, to both sides of the box, with a
// crest that is not level. (Rest and lost soil: cases/verdict_slide, verdict_rest, screen.)
#include "../soil.h"

#include <scree/postprocess/statistics.h>

namespace test_soil_motion
{
/// Soil 0.4 m high, over 0 < x < 0.6 of a box from 0 to 1.2 m, where x is the distance along `axis` from one side.
template <int dim>
struct Bank
{
  SoilScene<dim> scene{ 0., 1.2 };
  const unsigned int axis;
  const bool is_mirrored;
  Tensor<1, dim> gravity;
  SoilMotion<dim> motion;

  Bank(const unsigned int axis, const bool is_mirrored, const double tilt = 0.)
      : axis(axis)
      , is_mirrored(is_mirrored)
      , gravity(-10. * Point<dim>::unit_vector(dim - 1))
      , motion(scene.grid, gravity, nullptr)
  {
    const std::string along = std::string(1, "xyz"[axis]), x = is_mirrored ? "(1.2 - " + along + ")" : along;
    scene.add_soil(x + " < 0.6 && " + "xyz"[dim - 1] + " < 0.4 + " + std::to_string(tilt) + "*" + x, 4);
  }

  /// Moves the soil between two distances by `way` forwards and `fall` downwards.
  void move(const double from, const double to, const double way, const double fall)
  {
    constexpr unsigned int n_steps = 10; // points may pass on to the next cell, or its rank
    const double sign              = is_mirrored ? -1. : 1.;
    for (auto &body : scene.bodies)
      for (unsigned int step = 0; step < n_steps; ++step)
        {
          for_each_point(body.points, [&](const auto &point) {
            const double start = point.properties[body.layout.start + axis], x = is_mirrored ? 1.2 - start : start;
            if (x < from || x > to)
              return;
            point.location[axis] += sign * way / n_steps;
            point.location[dim - 1] -= fall / n_steps;
          });
          body.points.hand_over();
        }
  }

  MotionNumbers look()
  {
    return motion.look(scene.bodies, Tensor<1, 2 * dim>(), 1.);
  }
};


/// The front half slides by 0.25 m; its rear has its scarp at 0.3 m, and 1 % of its mass is a third of a row of points.
template <int dim>
MotionNumbers slide(const unsigned int axis, const bool is_mirrored, const double tilt)
{
  Bank<dim> bank(axis, is_mirrored, tilt);
  const MotionNumbers start = bank.look();
  expect(start.length + start.failed_mass + start.largest_displacement, 0., 0., "path at the start");
  expect(start.thickness, 4., 1e-3, "thickness in cells");
  bank.move(0.3, 0.6, 0.25, 0.1);
  return bank.look();
}

template <int dim>
void test_path()
{
  const MotionNumbers first = slide<dim>(0, false, 0.);
  expect(first.length, 0.55, 0.026, "L from scarp to toe"); // half a distance of points at each end
  expect(first.toe_displacement, 0.25, 1e-9, "displacement of the toe");
  expect(first.largest_displacement, std::hypot(0.25, 0.1), 1e-9, "largest displacement");
  expect(first.fall, 0.1, 1e-9, "H"); // from surface to surface: the toe is a wall of soil
  expect(first.ratio, first.fall / first.length, 0., "H/L");
  expect(first.travel_angle, std::atan(first.ratio) * 180. / numbers::PI, 1e-12, "travel angle");
  for (unsigned int axis = 0; axis + 1 < dim; ++axis)
    for (const bool is_mirrored : { false, true })
      for (const double tilt : { -1e-3, 0., 1e-3 })
        {
          const MotionNumbers other = slide<dim>(axis, is_mirrored, tilt);
          const double allowed      = tilt == 0. ? 1e-9 : 0.02; // a crest that is cut by cells has other points
          expect(other.length / first.length, 1., allowed, "L of a bank turned, mirrored or tilted");
          expect(other.toe_displacement / first.toe_displacement, 1., allowed, "displacement of its toe");
          expect(other.fall / first.fall, 1., allowed, "its H");
        }
}


/// The log has a travel angle only where the toe has moved by a tenth of L.
template <int dim>
void test_text()
{
  for (const double way : { 0.02, 0.25 })
    {
      Bank<dim> bank(0, false);
      bank.look();
      bank.move(0.3, 0.6, way, 0.);
      bank.look();
      expect(bank.motion.text().find("angle") != std::string::npos, way > 0.1, 0., "travel angle in the log");
    }
}


/// Soil that spreads to both sides has its toe at the side where more of it moves.
template <int dim>
void test_spread()
{
  for (const bool is_mirrored : { false, true })
    {
      Bank<dim> spreads(0, is_mirrored);
      spreads.move(0., 0.6, 0.3, 0.); // away from the wall: the start
      for (auto &body : spreads.scene.bodies)
        for_each_point(body.points, [&](const auto &point) {
          std::copy_n(&point.location[0], dim, point.properties + body.layout.start);
        });
      spreads.look();
      spreads.move(0.3, 0.5, -0.1, 0.);
      spreads.move(0.6, 0.9, 0.2, 0.);
      const MotionNumbers spread = spreads.look();
      expect(spread.toe_displacement, 0.2, 1e-9, "displacement of the toe of soil that spreads");
      expect(spread.length, 0.8, 0.026, "L of soil that spreads");
    }
}


template <int dim>
void test()
{
  test_path<dim>();
  test_text<dim>();
  test_spread<dim>();
}


const UnitTest registered("soil_motion", [] {
  test<2>();
  test<3>();
});
} // namespace test_soil_motion

// Runs with mpirun=1,2.

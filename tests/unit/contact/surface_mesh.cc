// SPDX-License-Identifier: LGPL-2.1-or-later
// A body from the file of its surface, a block that is turned and pushed, in the coordinates of a map: distances and
// normals are those of the block at random places, at corners, edges and faces, inside and outside.
#include "../test.h"

#include <scree/geometry/bed_parameters.h>

#include <fstream>

namespace test_surface_mesh
{
const Tensor<1, 3> half({ 0.7, 0.4, 0.2 });
const Point<3> centre(0.3, -0.2, 0.5);
const Point<2> map_origin(1000., 2000.);

/// The axes of the block.
std::array<Tensor<1, 3>, 3> axes()
{
  const double c = std::cos(0.4), s = std::sin(0.4), d = std::cos(0.7), t = std::sin(0.7);
  return { { Tensor<1, 3>({ c, s * d, s * t }), Tensor<1, 3>({ -s, c * d, c * t }), Tensor<1, 3>({ 0., -t, d }) } };
}

/// Its file, with polygons of four corners.
void write(const std::string &file)
{
  std::ofstream out(file);
  out.precision(17);
  for (unsigned int corner = 0; corner < 8; ++corner)
    {
      Point<3> x = centre;
      for (unsigned int a = 0; a < 3; ++a)
        x += (corner >> a & 1 ? half[a] : -half[a]) * axes()[a];
      out << "v " << x[0] + map_origin[0] << ' ' << x[1] + map_origin[1] << ' ' << x[2] << '\n';
    }
  out << "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
}

const UnitTest registered("surface_mesh", [] {
  const std::string file = "block.obj";
  write(file);
  BedParameters bed;
  bed.type                   = "fixed";
  bed.shapes["Surface mesh"] = file;
  bed.map_origin             = map_origin;
  bed.check(3);
  const auto surface = make_bed<3>(bed, { -2., -2., -2. }, { 2., 2., 2. }, 0.1);
  RandomNumbers random;
  for (unsigned int i = 0; i < 2000; ++i)
    {
      const Point<3> x = random.point<3>(-1.5, 1.5);
      Tensor<1, 3> local, beyond; // in the axes of the block
      double depth = -std::numeric_limits<double>::infinity();
      for (unsigned int a = 0; a < 3; ++a)
        {
          local[a]  = (x - centre) * axes()[a];
          beyond[a] = std::max(std::abs(local[a]) - half[a], 0.) * (local[a] > 0. ? 1. : -1.);
          depth     = std::max(depth, std::abs(local[a]) - half[a]);
        }
      const bool is_open  = depth > 0.;
      const double wanted = is_open ? beyond.norm() : depth;
      require(surface->is_open(x) == is_open, "open or not");
      const SurfaceView<3> view = surface->view(x, 10.);
      expect(view.distance, wanted, 1e-11, "distance"); // of coordinates of some 1000 m
      if (is_open)
        for (unsigned int a = 0; a < 3; ++a)
          expect(view.normal * axes()[a], beyond[a] / wanted, 1e-8, "normal");
    }
  expect(surface->view(Point<3>(9., 0., 0.), 0.5).distance, 0.5, 0., "far away");
});
} // namespace test_surface_mesh

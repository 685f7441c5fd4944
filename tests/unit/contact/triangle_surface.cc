// SPDX-License-Identifier: LGPL-2.1-or-later

// Distances, normals and sides of solids of triangles: a box, from an STL file of text and a binary one, against the
// closed form; a sphere of more and more triangles; a spike whose corners are nearest to most places; a hollow box.

#include "../expect.h"
#include "../random_numbers.h"

#include <scree/geometry/triangle_surface.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <iostream>

#include "../unit_test.h"

namespace test_triangle_surface
{
using namespace dealii;
using namespace scree;

const double far = 100.;

/// Of a box between two corners, faces outwards.
std::vector<Triangle> box(const Point<3> &lower, const Point<3> &upper)
{
  const auto corner = [&](const unsigned int v) {
    return Point<3>(v & 1 ? upper[0] : lower[0], v & 2 ? upper[1] : lower[1], v & 4 ? upper[2] : lower[2]);
  };
  std::vector<Triangle> triangles;
  constexpr unsigned int faces[6][4] = { { 0, 2, 3, 1 }, { 4, 5, 7, 6 }, { 0, 1, 5, 4 },
                                         { 2, 6, 7, 3 }, { 0, 4, 6, 2 }, { 1, 3, 7, 5 } };
  for (const auto &[a, b, c, d] : faces)
    {
      triangles.push_back({ { corner(a), corner(b), corner(c) } });
      triangles.push_back({ { corner(a), corner(c), corner(d) } });
    }
  return triangles;
}


void write_text(const std::string &file, const std::vector<Triangle> &triangles)
{
  std::ofstream out(file);
  out << "solid box\n";
  for (const Triangle &triangle : triangles)
    {
      out << "  facet normal 0 0 0\n    outer loop\n";
      for (const Point<3> &corner : triangle)
        out << "      VERTEX " << corner << "\n";
      out << "    endloop\n  endfacet\n";
    }
  out << "endsolid box\n";
}


void write_binary(const std::string &file, const std::vector<Triangle> &triangles)
{
  std::ofstream out(file, std::ios::binary);
  const std::string head = "solid, but not of text" + std::string(58, ' ');
  out.write(head.data(), 80);
  const std::uint32_t n = triangles.size();
  out.write(reinterpret_cast<const char *>(&n), sizeof(n));
  for (const Triangle &triangle : triangles)
    {
      float numbers[12] = {};
      for (unsigned int i = 0; i < 9; ++i)
        numbers[3 + i] = triangle[i / 3][i % 3];
      out.write(reinterpret_cast<const char *>(numbers), sizeof(numbers));
      out.write("\0", 2);
    }
}


/// Distance from a box, and the unit vector away from it; none where several are as near.
std::pair<double, Tensor<1, 3>> view_of_box(const Point<3> &lower, const Point<3> &upper, const Point<3> &x)
{
  Tensor<1, 3> outside, normal;
  double least = far;
  for (unsigned int a = 0; a < 3; ++a)
    {
      outside[a] = x[a] - std::clamp(x[a], lower[a], upper[a]);
      for (const double side : { -1., 1. })
        if (const double inside = side < 0. ? x[a] - lower[a] : upper[a] - x[a]; inside < least)
          {
            least     = inside;
            normal    = Tensor<1, 3>();
            normal[a] = side;
          }
    }
  if (outside.norm() > 0.)
    return { outside.norm(), outside / outside.norm() };
  return { -least, normal };
}


void test_box(const bool is_binary)
{
  RandomNumbers random;
  const Point<3> lower(-1., -0.5, 0.25), upper(2., 0.5, 1.);
  const std::string file = is_binary ? "binary.stl" : "text.stl";
  (is_binary ? write_binary : write_text)(file, box(lower, upper));
  const auto surface = read_triangle_surface(file, "Surface");
  for (unsigned int k = 0; k < 5000; ++k)
    {
      const Point<3> x(random.uniform(-2., 3.), random.uniform(-1.5, 1.5), random.uniform(-0.75, 2.));
      const auto view               = surface->view(x, far);
      const auto [distance, normal] = view_of_box(lower, upper, x);
      expect(view.distance, distance, 1e-14, "distance from the box");
      expect((view.normal - normal).norm() * distance, 0., 1e-14, "foot on the box");
      AssertThrow(surface->is_open(x) == (distance > 0.), ExcMessage("side of the box"));
      expect(surface->view(x, 0.1).distance, std::clamp(distance, -0.1, 0.1), 1e-14, "distance within reach");
    }
  const Point<3> corner = upper, on_face(0.3, 0.1, 1.);
  expect(surface->view(on_face, far).normal[2], 1., 1e-14, "normal on a face");
  expect(surface->view(corner, far).normal * Tensor<1, 3>({ 1., 1., 1. }), std::sqrt(3.), 1e-14, "normal on a corner");
  std::cout << (is_binary ? "binary" : "text") << ": distances and normals of a box" << std::endl;
}


/// An octahedron whose triangles are divided into four and moved onto a sphere of radius 1.
std::vector<Triangle> sphere(const unsigned int n_divisions)
{
  std::vector<Triangle> triangles;
  for (const double x : { -1., 1. })
    for (const double y : { -1., 1. })
      for (const double z : { -1., 1. })
        {
          const Point<3> a(x, 0., 0.), b(0., y, 0.), c(0., 0., z);
          triangles.push_back(x * y * z > 0. ? Triangle{ { a, b, c } } : Triangle{ { a, c, b } });
        }
  for (unsigned int i = 0; i < n_divisions; ++i)
    {
      std::vector<Triangle> finer;
      for (const auto &[a, b, c] : triangles)
        {
          const auto middle = [](const Point<3> &p, const Point<3> &q) {
            const Tensor<1, 3> sum = p + Tensor<1, 3>(q);
            return Point<3>(sum / sum.norm());
          };
          const Point<3> ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
          for (const Triangle &one : { Triangle{ { a, ab, ca } },
                                       Triangle{ { ab, b, bc } },
                                       Triangle{ { ca, bc, c } },
                                       Triangle{ { ab, bc, ca } } })
            finer.push_back(one);
        }
      triangles = finer;
    }
  return triangles;
}


void test_sphere()
{
  double before = 0.;
  for (const unsigned int n : { 3, 4, 5 })
    {
      const TriangleSurface surface(sphere(n), "");
      RandomNumbers random;
      double worst = 0., worst_normal = 0.;
      for (unsigned int k = 0; k < 3000; ++k)
        {
          const Point<3> x(random.uniform(-1.5, 1.5), random.uniform(-1.5, 1.5), random.uniform(-1.5, 1.5));
          const double exact = x.norm() - 1.;
          if (x.norm() < 0.2)
            continue;
          const auto view = surface.view(x, far);
          AssertThrow(view.distance >= exact - 1e-12, ExcMessage("The triangles are inside the sphere."));
          worst        = std::max(worst, view.distance - exact);
          worst_normal = std::max(worst_normal, (view.normal - Tensor<1, 3>(x) / x.norm()).norm());
          // Only between the triangles and the sphere sides differ.
          AssertThrow(surface.is_open(x) == (exact > 0.) || std::abs(exact) < worst + 1e-12, ExcMessage("side"));
        }
      // What the circle around an acute triangle subtends tells the gap between the triangle and the sphere.
      double longest = 0.; // edge
      for (const Triangle &triangle : sphere(n))
        for (const unsigned int i : { 0, 1, 2 })
          longest = std::max(longest, triangle[i].distance(triangle[(i + 1) % 3]));
      const double half_angle = std::asin(longest / std::sqrt(3.));
      AssertThrow(worst <= 1. - std::cos(half_angle), ExcMessage("distance from the sphere"));
      AssertThrow(worst_normal < 1.5 * half_angle, ExcMessage("normal of the sphere"));
      AssertThrow(before == 0. || worst < 0.3 * before, ExcMessage("not of second order"));
      before = worst;
    }
  std::cout << "sphere: second order" << std::endl;
}


void test_spike()
{
  const std::array<Point<3>, 4> corners{ { { 0., 0., 0. }, { 1., 0., 0. }, { 0.5, 0.1, 0. }, { 3., 0.2, 0.15 } } };
  std::vector<Triangle> triangles;
  constexpr unsigned int faces[4][3] = { { 0, 2, 1 }, { 0, 1, 3 }, { 1, 2, 3 }, { 2, 0, 3 } };
  for (const auto &[a, b, c] : faces)
    triangles.push_back({ { corners[a], corners[b], corners[c] } });
  const TriangleSurface surface(triangles, "");
  RandomNumbers random;
  unsigned int n_inside = 0;
  for (unsigned int k = 0; k < 50000; ++k)
    {
      const Point<3> x(random.uniform(-0.2, 3.2), random.uniform(-0.1, 0.3), random.uniform(-0.1, 0.2));
      bool is_open = false;
      for (const Triangle &triangle : triangles)
        is_open = is_open || across(triangle) * (x - triangle[0]) > 0.;
      n_inside += !is_open;
      AssertThrow(surface.is_open(x) == is_open, ExcMessage("side of the spike"));
      AssertThrow((surface.view(x, far).distance > 0.) == is_open, ExcMessage("side of the spike"));
    }
  AssertThrow(n_inside > 100, ExcMessage("The test looks beside the spike."));
  std::cout << "spike: sides" << std::endl;
}


void test_hollow_box()
{
  auto triangles = box({ 0., 0., 0. }, { 3., 3., 3. });
  for (auto triangle : box({ 1., 1., 1. }, { 2., 2., 2. }))
    {
      std::swap(triangle[1], triangle[2]);
      triangles.push_back(triangle);
    }
  const TriangleSurface surface(triangles, "");
  expect(surface.view({ 1.5, 1.5, 1.6 }, far).distance, 0.4, 1e-14, "in the hole");
  expect(surface.view({ 1.5, 1.5, 0.8 }, far).distance, -0.2, 1e-14, "in the wall");
  expect(surface.view({ 1.5, 1.5, -0.2 }, far).distance, 0.2, 1e-14, "outside");
  AssertThrow(surface.is_open({ 1.1, 1.9, 1.5 }), ExcMessage("The hole is not open."));
  std::cout << "hollow box" << std::endl;
}


void run()
{
  test_box(false);
  test_box(true);
  test_sphere();
  test_spike();
  test_hollow_box();
}

const UnitTest registered("triangle_surface", run);
} // namespace test_triangle_surface

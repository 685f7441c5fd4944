// SPDX-License-Identifier: LGPL-2.1-or-later
// A shape of one file: registered here, it is an entry of subsections Bed and Obstacle, checked and made like those of
// source/geometry.
#include "../test.h"

#include <scree/geometry/bed_parameters.h>
#include <scree/input/input_error.h>

namespace test_registered_shape
{
template <int dim>
class Sphere : public LevelSet<dim>
{
public:
  explicit Sphere(const ShapeRequest &request)
  {
    const auto numbers = Utilities::string_to_double(Utilities::split_string_list(request.value));
    request.require(numbers.size() == dim + 1 && numbers.back() > 0.,
                    "write the centre, a number an axis, and the radius, all in m.");
    for (unsigned int a = 0; a < dim; ++a)
      centre[a] = numbers[a];
    radius = numbers.back();
  }
  bool is_open(const Point<dim> &x) const override
  {
    return x.distance(centre) > radius;
  }
  SurfaceView<dim> view(const Point<dim> &x, const double) const override
  {
    const double r = x.distance(centre);
    return { r - radius, r > 0. ? (x - centre) / r : Point<dim>::unit_vector(0) };
  }

private:
  Point<dim> centre;
  double radius;
};

template <int dim>
std::unique_ptr<LevelSet<dim>> make_sphere(const ShapeRequest &request)
{
  return std::make_unique<Sphere<dim>>(request);
}

const RegisterShape registered("Sphere",
                               { "In place of the expression: centre and radius of a sphere, in m, such as 0, 0, 0.5.",
                                 ShapeValue::text,
                                 "",
                                 make_sphere<2>,
                                 make_sphere<3> });


template <int dim>
std::unique_ptr<LevelSet<dim>> sphere_of(const std::string &entries)
{
  BedParameters bed;
  ParameterHandler prm;
  bed.add_parameters(prm);
  prm.parse_input_from_string("subsection Bed\n set Type = fixed\n" + entries + "\nend");
  bed.check(dim);
  return make_bed<dim>(bed, {}, {}, 0.1);
}


void run()
{
  const auto circle = sphere_of<2>("set Sphere = 1, 2, 0.5");
  expect(circle->view(Point<2>(1., 3.), 1.).distance, 0.5, 1e-15, "distance outside");
  require(circle->is_open(Point<2>(1., 3.)), "it is open outside");
  const auto sphere = sphere_of<3>("set Sphere = 1, 2, 3, 0.5");
  expect(sphere->view(Point<3>(1., 2., 3.25), 1.).distance, -0.25, 1e-15, "distance inside");
  require(!sphere->is_open(Point<3>(1., 2., 3.25)), "it is not open inside");
  const std::string entry = "subsection Bed, entry \"Sphere\" = 1, 2, 0.5: ";
  expect_refusal([] { sphere_of<3>("set Sphere = 1, 2, 0.5"); },
                 entry + "write the centre, a number an axis, and the radius, all in m.",
                 "too few numbers");
  expect_refusal([] { sphere_of<2>("set Sphere = 1, 2, 0.5\n set Level set expression = y"); },
                 entry + "it is given twice. Keep one of \"Level set expression\", \"Sphere\", \"Profile\" (2D), " +
                     "\"Raster\" (3D) and \"Surface mesh\" (3D).",
                 "two shapes");
}

const UnitTest registered_test("registered_shape", run);
} // namespace test_registered_shape

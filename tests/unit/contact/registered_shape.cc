// SPDX-License-Identifier: LGPL-2.1-or-later
// A shape of one file: registered here, it is an entry of subsections Bed and Obstacle, checked and made like those of
// source/geometry.
#include "../unit_test.h"

#include <scree/geometry/bed_parameters.h>
#include <scree/input/input_error.h>

#include <deal.II/base/utilities.h>

#include <iostream>

namespace test_registered_shape
{
using namespace dealii;
using namespace scree;

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
void print_distance(const std::string &entries, const Point<dim> &x)
{
  BedParameters bed;
  ParameterHandler prm;
  bed.add_parameters(prm);
  prm.parse_input_from_string("subsection Bed\n set Type = fixed\n" + entries + "\nend");
  try
    {
      bed.check(dim);
      const auto sphere = make_bed<dim>(bed, {}, {}, 0.1);
      std::cout << bed.geometry().second << ": " << sphere->view(x, 1.).distance << ' ' << sphere->is_open(x) << '\n';
    }
  catch (const EntryError &error)
    {
      std::cout << error.what() << '\n';
    }
}


void run()
{
  print_distance<2>("set Sphere = 1, 2, 0.5", Point<2>(1., 3.));
  print_distance<3>("set Sphere = 1, 2, 3, 0.5", Point<3>(1., 2., 3.25));
  print_distance<3>("set Sphere = 1, 2, 0.5", Point<3>());
  print_distance<2>("set Sphere = 1, 2, 0.5\n set Level set expression = y", Point<2>());
}

const UnitTest registered_test("registered_shape", run);
} // namespace test_registered_shape

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/boundary/boundary_conditions.h>

namespace scree
{
  using namespace dealii;

  namespace
  {
    constexpr char accepted_walls[] = "fixed | free slip | friction ANGLE (degrees, 0 to below 90) | open";

    /// Reads one wall, or throws with the words that are allowed.
    Wall wall_from_text(const std::string &name, const std::string &text)
    {
      if (text == "fixed")
        return { WallType::fixed, 0. };
      if (text == "free slip")
        return { WallType::free_slip, 0. };
      if (text == "open")
        return { WallType::open, 0. };
      if (text.rfind("friction ", 0) == 0)
        if (const double angle = number_of(Utilities::trim(text.substr(9))); angle >= 0. && angle < 90.)
          return { WallType::friction, std::tan(angle * numbers::PI / 180.) };
      throw EntryError(entry_name("Boundaries", name) + " = " + text + ": write one of: " + accepted_walls + '.');
    }
  } // namespace


  void BoundaryParameters::add_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Boundaries");
    FaceEntries::add_parameters(prm, std::string(" of the box: ") + accepted_walls + ".");
    prm.leave_subsection();
  }


  std::vector<Wall> BoundaryParameters::walls(const unsigned int dim) const
  {
    const auto faces = names(dim), entries = texts(dim);
    std::vector<Wall> result;
    for (unsigned int f = 0; f < faces.size(); ++f)
      result.push_back(wall_from_text(faces[f], entries[f]));
    return result;
  }


  template <int dim>
  std::vector<NodeConstraint<dim>> BoundaryConditions<dim>::constraints(const std::uint8_t faces) const
  {
    using Type = typename NodeConstraint<dim>::Type;
    std::vector<NodeConstraint<dim>> result;
    for (unsigned int f = 0; f < 2 * dim; ++f)
      if ((faces >> f) & 1)
        {
          const Tensor<1, dim> inward = (f % 2 == 0 ? 1. : -1.) * Point<dim>::unit_vector(f / 2);
          switch (wall_list[f].type)
            {
            case WallType::fixed:
              for (unsigned int a = 0; a < dim; ++a)
                result.push_back({ Point<dim>::unit_vector(a), Type::fixed, 0. });
              break;
            case WallType::free_slip:
              result.push_back({ inward, Type::fixed, 0. });
              break;
            case WallType::friction:
              result.push_back({ inward, Type::unilateral, wall_list[f].friction_coefficient });
              break;
            case WallType::open:
              break;
            }
        }
    return result;
  }


  template <int dim>
  unsigned int nearest_face(const BackgroundGrid<dim> &grid, const Point<dim> &location)
  {
    unsigned int nearest = 0;
    double largest       = -std::numeric_limits<double>::infinity();
    for (unsigned int f = 0; f < 2 * dim; ++f)
      {
        const double outside =
            f % 2 == 0 ? grid.lower_corner()[f / 2] - location[f / 2] : location[f / 2] - grid.upper_corner()[f / 2];
        if (outside > largest)
          {
            largest = outside;
            nearest = f;
          }
      }
    return nearest;
  }

  template class BoundaryConditions<2>;
  template class BoundaryConditions<3>;
  template unsigned int nearest_face(const BackgroundGrid<2> &, const Point<2> &);
  template unsigned int nearest_face(const BackgroundGrid<3> &, const Point<3> &);
} // namespace scree

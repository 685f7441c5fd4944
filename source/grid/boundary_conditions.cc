// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/grid/boundary_conditions.h>
#include <scree/input/input_error.h>

#include <cmath>

namespace scree
{
  using namespace dealii;

  namespace
  {
    constexpr char pattern_text[] = "fixed | free slip | friction ANGLE (degrees, 0 to below 90) | open";

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
        {
          std::size_t end = 0;
          double angle    = -1.;
          const auto rest = Utilities::trim(text.substr(9));
          try
            {
              angle = std::stod(rest, &end);
            }
          catch (const std::exception &)
            {
            }
          if (end == rest.size() && angle >= 0. && angle < 90.)
            return { WallType::friction, std::tan(angle * numbers::PI / 180.) };
        }
      throw EntryError(entry_name("Boundaries", name) + " = " + text + ": write one of: " + pattern_text + '.');
    }
  } // namespace


  BoundaryParameters::BoundaryParameters()
      : FaceEntries{ "free slip", "free slip", "free slip", "free slip", "fixed", "open" }
  {
  }


  void BoundaryParameters::add_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Boundaries");
    FaceEntries::add_parameters(prm, std::string(" of the box: ") + pattern_text + ".");
    prm.leave_subsection();
  }


  void BoundaryParameters::check(const unsigned int dim) const
  {
    walls(3);
    FaceEntries::check("Boundaries", dim, BoundaryParameters());
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
  BoundaryConditions<dim>::BoundaryConditions(const BackgroundGrid<dim> &grid, const BoundaryParameters &parameters)
      : grid(grid)
      , wall_list(parameters.walls(dim))
  {
  }


  template <int dim>
  void BoundaryConditions<dim>::apply(Tensor<1, dim> &velocity, const std::uint8_t faces) const
  {
    for (unsigned int f = 0; f < 2 * dim; ++f)
      if ((faces >> f) & 1)
        {
          const unsigned int axis = f / 2;
          switch (wall_list[f].type)
            {
            case WallType::fixed:
              velocity = 0.;
              return;
            case WallType::free_slip:
              velocity[axis] = 0.;
              break;
            case WallType::friction:
              {
                const double inward = (f % 2 == 0 ? 1. : -1.) * velocity[axis];
                if (inward >= 0.)
                  break;
                // The wall stops the normal motion; its impulse bounds the tangential one (Coulomb).
                velocity[axis]     = 0.;
                const double speed = velocity.norm();
                const double loss  = -wall_list[f].friction_coefficient * inward;
                velocity *= speed > loss ? 1. - loss / speed : 0.;
                break;
              }
            case WallType::open:
              break;
            }
        }
  }


  template <int dim>
  unsigned int BoundaryConditions<dim>::fixed_components(const std::uint8_t faces) const
  {
    unsigned int fixed = 0;
    for (unsigned int f = 0; f < 2 * dim; ++f)
      if ((faces >> f) & 1)
        {
          if (wall_list[f].type == WallType::fixed)
            fixed |= (1u << dim) - 1;
          else if (wall_list[f].type == WallType::free_slip)
            fixed |= 1u << (f / 2);
        }
    return fixed;
  }


  template <int dim>
  std::uint8_t BoundaryConditions<dim>::friction_faces(const std::uint8_t faces) const
  {
    std::uint8_t result = 0;
    for (unsigned int f = 0; f < 2 * dim; ++f)
      if (wall_list[f].type == WallType::friction)
        result |= faces & (1u << f);
    return result;
  }


  template <int dim>
  std::pair<std::string, bool> BoundaryConditions<dim>::face_crossed(const Point<dim> &location) const
  {
    const unsigned int face = nearest_face(grid, location);
    return { FaceEntries::names(dim)[face], wall_list[face].type == WallType::open };
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

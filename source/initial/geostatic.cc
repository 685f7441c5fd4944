// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/initial/geostatic.h>
#include <scree/input/input_error.h>
#include <scree/tensor/invariants.h>

#include <algorithm>
#include <cmath>

namespace scree
{
  using namespace dealii;

  template <int dim>
  Overburden<dim>::Overburden(const BackgroundGrid<dim> &grid,
                              std::vector<Layer> layers,
                              const Tensor<1, dim> &gravity,
                              const double spacing)
      : grid(grid)
      , layers(std::move(layers))
      , gravity(gravity.norm())
      , spacing(spacing)
      , axis(0)
  {
    for (unsigned int a = 1; a < dim; ++a)
      if (std::abs(gravity[a]) > std::abs(gravity[axis]))
        axis = a;
    up = gravity[axis] < 0 ? 1. : -1.;
    AssertThrow(this->gravity > 0 && std::abs(gravity[axis]) > (1. - 1e-12) * this->gravity,
                ExcMessage("A K0 start needs gravity along one axis."));
  }


  template <int dim>
  std::vector<typename Overburden<dim>::Piece> Overburden<dim>::pieces_above(const Point<dim> &x) const
  {
    const double bottom = up > 0 ? grid.lower_corner()[axis] : -grid.upper_corner()[axis];
    const double top    = up > 0 ? grid.upper_corner()[axis] : -grid.lower_corner()[axis];

    std::vector<Piece> pieces;
    for (const Layer &layer : layers)
      {
        const auto inside = [&](const double height) {
          Point<dim> y = x;
          y[axis]      = up * height;
          return std::any_of(layer.regions.begin(), layer.regions.end(), [&](const Region<dim> &region) {
            return region.contains(y);
          });
        };
        // A sample may fall on the surface: what was found there must not be asked for again, with other rounding.
        const auto boundary_between = [&](double a, double b, const bool inside_at_a) {
          while (b - a > 1e-12 * (top - bottom))
            (inside(0.5 * (a + b)) == inside_at_a ? a : b) = 0.5 * (a + b);
          return 0.5 * (a + b);
        };

        const unsigned int n_samples = static_cast<unsigned int>(std::ceil((top - bottom) / spacing));
        const double step            = (top - bottom) / n_samples;
        double begin                 = bottom;
        bool was_in                  = inside(bottom);
        for (unsigned int i = 1; i <= n_samples; ++i)
          {
            const double height = bottom + i * step;
            const bool is_in    = inside(height);
            if (is_in != was_in)
              {
                const double boundary = boundary_between(height - step, height, was_in);
                if (was_in)
                  pieces.push_back({ begin, boundary, layer.density * gravity });
                begin  = boundary;
                was_in = is_in;
              }
          }
        if (was_in)
          pieces.push_back({ begin, top, layer.density * gravity });
      }
    return pieces;
  }


  template <int dim>
  double Overburden<dim>::weight_above(const Point<dim> &x)
  {
    // Points of a lattice share their columns; the key is finer than any lattice.
    std::array<long, dim - 1> key;
    for (unsigned int a = 0, k = 0; a < dim; ++a)
      if (a != axis)
        key[k++] = std::lround(x[a] / (1e-4 * spacing));
    auto column = columns.find(key);
    if (column == columns.end())
      column = columns.emplace(key, pieces_above(x)).first;

    const double height = up * x[axis];
    double weight       = 0;
    for (const Piece &piece : column->second)
      weight += piece.unit_weight * std::max(0., piece.end - std::max(piece.begin, height));
    return weight;
  }


  namespace
  {
    /// Throws ValueError unless the elastic strain of a point at `x` is one that soil can have: a modulus that is too
    /// small for the stress shows here. It begins with `modulus`, or with `entry` of a stress that no soil has.
    /// @param stress that it starts from
    /// @param left_cauchy_green its first three components
    template <int dim>
    void require_bearable(const std::string &body,
                          const std::string &entry,
                          const std::string &modulus,
                          const Point<dim> &x,
                          const double *stress,
                          const double *left_cauchy_green)
    {
      constexpr double largest = 1, largest_stress = 1e9; // Pa
      for (unsigned int i = 0; i < 3; ++i)
        if (const double strain = 0.5 * std::log(left_cauchy_green[i]); !(std::abs(strain) <= largest))
          throw ValueError((std::abs(stress[i]) > largest_stress ? entry : modulus) + ": the initial stress at " +
                           number_text(x) + " m, " + number_text(stress[i]) +
                           " Pa, would strain the soil elastically by " +
                           (std::isfinite(strain) ? number_text(strain) : "a number beyond all bounds") +
                           ", and at most 1 is allowed. Write a larger modulus, in Pa (1 MPa = 1e6 Pa), or less stress "
                           "in subsection " +
                           body + "/Initial state.");
    }


    /// Gives each point the state with the stress components that `fill_stress(location, components)` writes. Throws
    /// EntryError, which begins with `entry` or `modulus`, if the law cannot carry one. Collective.
    template <int dim, typename Function>
    void set_stress(SoilBody<dim> &body,
                    const std::string &entry,
                    const std::string &modulus,
                    const MPI_Comm communicator,
                    const Function &fill_stress)
    {
      on_all_ranks(communicator, [&] {
        for_each_point(body.points, [&](const auto &point) {
          double stress[n_symmetric_components<dim>] = {};
          fill_stress(point.location, stress);
          double *strain = point.properties + body.layout.left_cauchy_green;
          try
            {
              body.material->initialise(stress,
                                        strain,
                                        point.properties + body.layout.stress,
                                        point.properties + body.layout.internal_variables);
            }
          catch (const ExceptionBase &error)
            {
              throw ValueError(entry + ": " + plain_text(error));
            }
          require_bearable(body.name, entry, modulus, point.location, stress, strain);
        });
      });
    }
  } // namespace


  template <int dim>
  void set_k0_stress(SoilBody<dim> &body,
                     Overburden<dim> &overburden,
                     const double k0,
                     const std::string &modulus,
                     const SuctionAbove<dim> &suction)
  {
    set_stress(body,
               entry_name(body.name + "/Initial state", "K0") + " = " + number_text(k0),
               modulus,
               overburden.communicator(),
               [&](const Point<dim> &x, double *stress) {
                 const double vertical = overburden.weight_above(x) + (suction ? suction(x) : 0.);
                 set_k0_components(vertical, k0, overburden.vertical_axis(), stress);
               });
  }


  template <int dim>
  void set_isotropic_stress(SoilBody<dim> &body,
                            const double pressure,
                            const std::string &modulus,
                            const MPI_Comm communicator)
  {
    set_stress(body,
               entry_name(body.name + "/Initial state", "Pressure") + " = " + number_text(pressure),
               modulus,
               communicator,
               [&](const Point<dim> &, double *stress) { std::fill_n(stress, 3, -pressure); });
  }

  template class Overburden<2>;
  template class Overburden<3>;
  template void
  set_k0_stress(SoilBody<2> &, Overburden<2> &, const double, const std::string &, const SuctionAbove<2> &);
  template void
  set_k0_stress(SoilBody<3> &, Overburden<3> &, const double, const std::string &, const SuctionAbove<3> &);
  template void set_isotropic_stress(SoilBody<2> &, const double, const std::string &, const MPI_Comm);
  template void set_isotropic_stress(SoilBody<3> &, const double, const std::string &, const MPI_Comm);
} // namespace scree

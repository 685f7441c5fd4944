// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/initial/geostatic.h>
#include <scree/seeding/seeding.h>
#include <scree/tensor/invariants.h>

namespace scree
{
  using namespace dealii;

  template <int dim>
  Overburden<dim>::Overburden(const BackgroundGrid<dim> &grid,
                              std::vector<Layer> layers,
                              const Tensor<1, dim> &gravity,
                              const double spacing)
      : grid(grid)
      , axis(0)
      , layers(std::move(layers))
      , gravity(gravity.norm())
      , spacing(spacing)
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
               overburden.grid.communicator(),
               [&](const Point<dim> &x, double *stress) {
                 const double vertical = overburden.weight_above(x) + (suction ? suction(x) : 0.);
                 set_k0_components(vertical, k0, overburden.axis, stress);
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
  template decltype(set_k0_stress<2>) set_k0_stress<2>;
  template decltype(set_k0_stress<3>) set_k0_stress<3>;
  template decltype(set_isotropic_stress<2>) set_isotropic_stress<2>;
  template decltype(set_isotropic_stress<3>) set_isotropic_stress<3>;


  template <int dim>
  std::vector<typename Overburden<dim>::Layer> effective_weight_layers(const std::vector<SoilRegion> &soil,
                                                                       const WaterParameters *water)
  {
    std::vector<typename Overburden<dim>::Layer> layers;
    for (const SoilRegion &body : soil)
      layers.emplace_back(body.template places<dim>(), body.bulk_density);
    if (!water || !water->starts_hydrostatic())
      return layers;
    const bool has_fringe = water->fringe > 0.;
    for (auto &part : water_parts<dim>(water->without_fringe(), soil))
      if (part.soil)
        layers.emplace_back(std::move(part.region), -(has_fringe ? 1. : 1. - part.porosity) * water->density);
    if (has_fringe)
      for (auto &part : water_parts<dim>(*water, soil))
        if (part.soil)
          layers.emplace_back(std::move(part.region), part.porosity * water->density);
    return layers;
  }


  template <int dim>
  std::vector<typename Overburden<dim>::Layer> water_layers(const WaterParameters &water,
                                                            const std::vector<SoilRegion> &soil)
  {
    // Inside and outside of the soil together: a surface between them adds nothing but its error.
    std::vector<typename Overburden<dim>::Layer> layers;
    if (water.has_levels())
      layers.emplace_back(water.density);
    if (!water.is_where_soil_is() && !water.has_levels())
      layers.emplace_back(Region<dim>(entry_name("Water", "Region"), water.region), water.density);
    else
      for (auto &part : water_parts<dim>(water.without_fringe(), soil))
        if (water.has_levels())
          layers.front().regions.push_back(std::move(part.region));
        else
          layers.emplace_back(std::move(part.region), water.density);
    return layers;
  }


  namespace
  {
    /// Suction of water at rest above the levels of the water, in the fringe; empty without one.
    template <int dim>
    SuctionAbove<dim> suction_above_table(const WaterParameters &water, const Tensor<1, dim> &gravity)
    {
      if (water.fringe == 0. || !water.starts_hydrostatic())
        return {};
      const auto [entry, elevation] = water.place();
      const auto line               = water.phreatic_line;
      const std::shared_ptr<const Expression<dim>> table =
          parse_expression<dim>(entry_name("Water", entry), line ? "0" : elevation, 1);
      const double unit_weight = water.density * gravity.norm(), fringe = water.fringe;
      return [table, line, unit_weight, fringe](const Point<dim> &x) {
        const double height = x[dim - 1] - (line ? line->height(x[0]) : table->value(x));
        return height > 0. && height <= fringe ? unit_weight * height : 0.; // Above it the soil is dry.
      };
    }
  } // namespace


  template <int dim>
  SuctionAbove<dim> suction_at_start(const WaterParameters *water,
                                     const std::shared_ptr<const SeepageField<dim>> &seepage,
                                     const BackgroundGrid<dim> &grid,
                                     const std::vector<SoilRegion> &soil,
                                     const Tensor<1, dim> &gravity)
  {
    if (water == nullptr)
      return {};
    if (!seepage)
      return suction_above_table<dim>(*water, gravity);
    const auto water_above =
        std::make_shared<Overburden<dim>>(grid, water_layers<dim>(*water, soil), gravity, grid.cell_size() / 4);
    return [water_above, seepage, unit_weight = water->density * gravity.norm()](const Point<dim> &x) {
      const double head = seepage->pressure_head(x).first;
      return std::isnan(head) ? 0. : water_above->weight_above(x) - unit_weight * std::max(0., head);
    };
  }


  namespace
  {
    /// Horizontal gradient, Pa/m, of the weight above a place with the weight `here`; one-sided beside a face, behind
    /// which there is no water.
    template <int dim>
    Tensor<1, dim> horizontal_gradient(const std::function<double(const Point<dim> &)> &weight_above,
                                       const unsigned int vertical_axis,
                                       const Point<dim> &x,
                                       const double here,
                                       const double reach)
    {
      Tensor<1, dim> gradient;
      for (unsigned int a = 0; a < dim; ++a)
        if (a != vertical_axis)
          {
            const Tensor<1, dim> way = reach * Point<dim>::unit_vector(a);
            const double before = weight_above(x - way), behind = weight_above(x + way);
            const double first = before > 0 ? before : here, last = behind > 0 ? behind : here;
            const int n_sides = (before > 0) + (behind > 0);
            gradient[a]       = n_sides > 0 ? (last - first) / (n_sides * reach) : 0.;
          }
      return gradient;
    }
  } // namespace


  template <int dim>
  void set_hydrostatic_pressure(WaterPhase<dim> &water,
                                Overburden<dim> &water_overburden,
                                const SuctionAbove<dim> &suction,
                                const double reach)
  {
    const Tensor<1, dim> weight = water.density * water_overburden.gravity_vector();
    const auto &layout          = water.layout;
    on_all_ranks(water_overburden.grid.communicator(), [&] {
      for_each_point(water.points(), [&](const auto &point) {
        const double pressure             = water_overburden.weight_above(point.location);
        point.properties[layout.pressure] = pressure;
        Tensor<1, dim> gradient           = weight;
        const unsigned int vertical       = water_overburden.axis;
        const double pull                 = suction ? suction(point.location) : 0.;
        if (reach > 0 && pull == 0.)
          gradient += horizontal_gradient<dim>([&](const Point<dim> &x) { return water_overburden.weight_above(x); },
                                               vertical,
                                               point.location,
                                               pressure,
                                               reach);
        else if (reach > 0)
          gradient -= horizontal_gradient<dim>(suction, vertical, point.location, pull, reach);
        point.properties[layout.pressure] -= pull;
        for (unsigned int a = 0; a < dim; ++a)
          point.properties[layout.pressure_gradient + a] = gradient[a];
      });
    });
  }


  template <int dim>
  void set_seepage_pressure(WaterPhase<dim> &water,
                            const SeepageField<dim> &field,
                            const SeepageSurvey<dim> &survey,
                            const double gravity,
                            const MPI_Comm communicator)
  {
    const double unit_weight = water.density * gravity;
    const auto &layout       = water.layout;
    const auto up            = Point<dim>::unit_vector(dim - 1);
    on_all_ranks(communicator, [&] {
      for_each_point(water.points(), [&](const auto &point) {
        const Point<dim> &x   = point.location;
        const double depth    = survey.level(x) - x[dim - 1];
        auto [head, gradient] = field.pressure_head(x);
        const bool is_free    = !survey.is_in_soil(x) && depth > 0.;
        if (is_free || std::isnan(head))
          {
            head     = std::isnan(depth) ? 0. : depth;
            gradient = -up;
          }
        point.properties[layout.pressure] = unit_weight * std::max(0., head);
        for (unsigned int a = 0; a < dim; ++a)
          point.properties[layout.pressure_gradient + a] = unit_weight * gradient[a];
      });
    });
  }

  template decltype(effective_weight_layers<2>) effective_weight_layers<2>;
  template decltype(effective_weight_layers<3>) effective_weight_layers<3>;
  template decltype(water_layers<2>) water_layers<2>;
  template decltype(water_layers<3>) water_layers<3>;
  template decltype(suction_at_start<2>) suction_at_start<2>;
  template decltype(suction_at_start<3>) suction_at_start<3>;
  template decltype(set_hydrostatic_pressure<2>) set_hydrostatic_pressure<2>;
  template decltype(set_hydrostatic_pressure<3>) set_hydrostatic_pressure<3>;
  template decltype(set_seepage_pressure<2>) set_seepage_pressure<2>;
  template decltype(set_seepage_pressure<3>) set_seepage_pressure<3>;
} // namespace scree

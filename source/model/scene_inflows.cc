// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/materials/table.h>
#include <scree/model/scene.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/geometry_info.h>

#include <algorithm>

namespace scree
{
  using namespace dealii;

  // What enters a scene.

  template <int dim>
  void Scene<dim>::let_in(const double time,
                          const double time_step,
                          const PressureOfCell<dim> &pressure,
                          RunTotals<dim> &totals)
  {
    for (const Inflow<dim> &inflow : inflows)
      if (inflow.water_share > 0.)
        totals.entered_energy += time_step * inflow.power_of_pressure(pressure);
    for (Inflow<dim> &inflow : inflows)
      if (const unsigned int n_layers = inflow.end_step(); n_layers > 0)
        {
          unsigned int n_points = 0;
          for (unsigned int back = n_layers; back-- > 0;)
            {
              if (inflow.brings_soil)
                n_points += add_soil(inflow, back, totals);
              if (inflow.water_share > 0.)
                n_points += add_water(inflow, back, pressure, totals);
            }
          const unsigned int n_sets = inflow.brings_soil + (inflow.water_share > 0.);
          AssertThrow(Utilities::MPI::sum(n_points, communicator) == n_sets * n_layers * inflow.places().size(),
                      ExcInternalError("Points entered beyond the cells of the section."));
        }
    if (rain)
      let_rain(time, time_step, pressure, totals);
  }


  template <int dim>
  RainedSoil Scene<dim>::rained_soil() const
  {
    RainedSoil soil{ parameters.grid.cell_size / points_per_cell().first, 1. };
    for (const SoilBody<dim> &body : bodies)
      if (const double porosity = parameters.find_body(body.name)->initial_porosity(); !body.is_rigid && body.drag)
        soil.porosity = std::min(soil.porosity, std::max(porosity, 0.1));
    return soil;
  }


  template <int dim>
  typename Rain<dim>::Columns Scene<dim>::columns_of_rain()
  {
    typename Rain<dim>::Columns columns = rain->no_columns();
    const PointSet<dim> &of_water       = water.front().points();
    for (const SoilBody<dim> &body : bodies)
      for_each_point(body.points, [&](const auto &point) { rain->find_top(point.location, columns.soil); });
    for_each_point(of_water, [&](const auto &point) { rain->find_top(point.location, columns.water); });
    Utilities::MPI::max(columns.soil, communicator, columns.soil);
    Utilities::MPI::max(columns.water, communicator, columns.water);

    for (const SoilBody<dim> &body : bodies)
      if (!body.is_rigid)
        for_each_point(body.points, [&](const auto &point) { rain->fill_with_soil(point.location, columns); });
    const unsigned int volume = water.front().layout.volume;
    for_each_point(
        of_water, [&](const auto &point) { rain->fill_with_water(point.location, point.properties[volume], columns); });
    Utilities::MPI::max(columns.has_soil, communicator, columns.has_soil);
    Utilities::MPI::sum(columns.filled, communicator, columns.filled);
    return columns;
  }


  template <int dim>
  void Scene<dim>::let_rain(const double time,
                            const double time_step,
                            const PressureOfCell<dim> &pressure,
                            RunTotals<dim> &totals)
  {
    if (!rain->count(time, time_step))
      return;
    const auto drops       = rain->drops(columns_of_rain());
    WaterPhase<dim> &phase = water.front();
    PointSet<dim> &points  = phase.points();
    std::vector<double> properties(points.stride());
    std::vector<int> has_cell(drops.size(), 0);
    for (unsigned int i = 0; i < drops.size(); ++i)
      if (const auto *cell = rain->cell_at(drops[i].location))
        {
          const Point<dim> &x      = drops[i].location;
          const unsigned int index = (*cell)->active_cell_index();
          std::fill(properties.begin(), properties.end(), 0.);
          fill_entrant(Entrant{ rain->volume(), x, index, Point<dim>((x - (*cell)->vertex(0)) / grid.cell_size()) },
                       phase,
                       pressure(index),
                       properties);
          const double mass = properties[phase.layout.mass];
          totals.entered_water_mass += mass;
          totals.entered_energy -= mass * (forcing.gravity() * (x - Point<dim>()));
          points.add(*cell, x, points.next_id + i, properties);
          has_cell[i] = 1;
        }
    points.next_id += drops.size();
    points.finish_adding();
    Utilities::MPI::max(has_cell, communicator, has_cell);
    for (unsigned int i = 0; i < drops.size(); ++i)
      if (!has_cell[i])
        rain->postpone(drops[i]);
  }


  template <int dim>
  template <typename Fill>
  unsigned int Scene<dim>::add_layer(const Inflow<dim> &inflow,
                                     const unsigned int back,
                                     PointSet<dim> &points,
                                     const unsigned int mass_slot,
                                     const Fill &fill,
                                     RunTotals<dim> &totals) const
  {
    std::vector<double> properties(points.stride());
    const Tensor<1, dim> &velocity = inflow.velocity();
    unsigned int n_points          = 0;
    for (unsigned int i = 0; i < inflow.places().size(); ++i)
      {
        const auto &place  = inflow.places()[i];
        const Point<dim> x = place.location + inflow.advance_of(back) * inflow.inward();
        const auto *cell   = inflow.cell_at(x);
        if (cell == nullptr)
          continue;
        std::fill(properties.begin(), properties.end(), 0.);
        fill(Entrant{ place.volume,
                      x,
                      (*cell)->active_cell_index(),
                      Point<dim>((x - (*cell)->vertex(0)) / grid.cell_size()) },
             properties);
        const double mass = properties[mass_slot];
        totals.entered_momentum += mass * velocity;
        totals.entered_energy += mass * (0.5 * velocity.norm_square() - forcing.gravity() * (x - Point<dim>()));
        points.add(*cell, x, points.next_id + i, properties);
        ++n_points;
      }
    points.next_id += inflow.places().size();
    points.finish_adding();
    return n_points;
  }


  template <int dim>
  unsigned int Scene<dim>::add_soil(const Inflow<dim> &inflow, const unsigned int back, RunTotals<dim> &totals)
  {
    SoilBody<dim> &body =
        *std::find_if(bodies.begin(), bodies.end(), [&](const SoilBody<dim> &one) { return one.name == inflow.body; });
    const auto surfaces = parameters.has_water ? std::vector<RigidSurface<dim>>() : rigid_surfaces();
    const auto &layout  = body.layout;
    std::unique_ptr<PlaceVariableValues<dim>> of_place; // what the law has from the place; null: nothing
    if (const PlaceVariable variable = body.material->place_variable(); !variable.expression.empty())
      of_place = std::make_unique<PlaceVariableValues<dim>>(variable,
                                                            parameters.find_body(body.name)->material.path(body.name));
    return add_layer(
        inflow,
        back,
        body.points,
        layout.mass,
        [&](const Entrant &entrant, std::vector<double> &properties) {
          if (of_place)
            of_place->set(entrant.location, 0., properties.data() + layout.internal_variables);
          fill_entrant(entrant, body, properties);
          std::copy_n(&inflow.velocity()[0], dim, properties.begin() + layout.velocity);
          set_touching_distances(body, surfaces, entrant.cell, entrant.place, properties.data());
          ++totals.n_entered;
          totals.entered_mass += properties[layout.mass];
          totals.entered_energy +=
              entrant.volume * body.material->elastic_energy(properties.data() + layout.left_cauchy_green);
        },
        totals);
  }


  template <int dim>
  unsigned int Scene<dim>::add_water(const Inflow<dim> &inflow,
                                     const unsigned int back,
                                     const PressureOfCell<dim> &pressure,
                                     RunTotals<dim> &totals)
  {
    WaterPhase<dim> &phase = water.front();
    return add_layer(
        inflow,
        back,
        phase.points(),
        phase.layout.mass,
        [&](Entrant entrant, std::vector<double> &properties) {
          entrant.volume *= inflow.water_share;
          fill_entrant(entrant, phase, pressure(entrant.cell), properties);
          std::copy_n(&inflow.velocity()[0], dim, properties.begin() + phase.layout.velocity);
          totals.entered_water_mass += properties[phase.layout.mass];
        },
        totals);
  }


  template <int dim>
  void
  Scene<dim>::fill_entrant(const Entrant &entrant, const SoilBody<dim> &body, std::vector<double> &properties) const
  {
    const auto &layout                  = body.layout;
    const InitialStateParameters &state = parameters.find_body(body.name)->initial_state;
    properties[layout.mass]             = body.density * entrant.volume;
    properties[layout.volume]           = entrant.volume;
    if (layout.has_start)
      std::copy_n(&entrant.location[0], dim, properties.begin() + layout.start);
    double stress[n_symmetric_components<dim>] = {};
    if (state.stress_kind() == InitialStress::isotropic)
      std::fill_n(stress, 3, -state.pressure);
    body.material->initialise(stress,
                              properties.data() + layout.left_cauchy_green,
                              properties.data() + layout.stress,
                              properties.data() + layout.internal_variables);
  }


  template <int dim>
  void Scene<dim>::fill_entrant(const Entrant &entrant,
                                const WaterPhase<dim> &phase,
                                const std::array<double, (1 << dim)> &pressure,
                                std::vector<double> &properties) const
  {
    const auto &layout        = phase.layout;
    properties[layout.mass]   = phase.density * entrant.volume;
    properties[layout.volume] = entrant.volume;
    for (unsigned int v = 0; v < pressure.size(); ++v)
      {
        properties[layout.pressure] += pressure[v] * GeometryInfo<dim>::d_linear_shape_function(entrant.place, v);
        const Tensor<1, dim> slope = GeometryInfo<dim>::d_linear_shape_function_gradient(entrant.place, v);
        for (unsigned int a = 0; a < dim; ++a)
          properties[layout.pressure_gradient + a] += pressure[v] * slope[a] / grid.cell_size();
      }
  }


  template <int dim>
  void Scene<dim>::hold_at_inflows()
  {
    if (inflows.empty())
      return;
    std::vector<unsigned int> inflow_of_node(grid.numbering().n_local(), Constraints<dim>::free);
    std::vector<typename Constraints<dim>::MovedByInflow> moved;
    for (const Inflow<dim> &inflow : inflows)
      {
        for (unsigned int node = 0; node < inflow_of_node.size(); ++node)
          if (inflow.is_open && inflow.moves(node))
            inflow_of_node[node] = moved.size();
        moved.push_back({ Tensor<1, dim>(), inflow.brings_soil });
      }
    constraints.set_inflows(inflow_of_node, moved);
  }


  template <int dim>
  void Scene<dim>::include_inflows(Speeds &speeds) const
  {
    for (const Inflow<dim> &inflow : inflows)
      if (inflow.is_open)
        {
          speeds.include_point(inflow.velocity().norm());
          for (const SoilBody<dim> &body : bodies)
            if (body.name == inflow.body)
              speeds.include_wave(body.wave_speed(body.material->initial_bulk_modulus(0.), 0.));
        }
  }


  template <int dim>
  std::vector<std::string> Scene<dim>::texts_of_inflows() const
  {
    std::vector<std::string> texts;
    for (const Inflow<dim> &inflow : inflows)
      texts.push_back("Inflow " + inflow.name + ": " + number_text(inflow.area()) + (dim == 2 ? " m" : " m^2") +
                      " are open; " + std::to_string(inflow.places().size()) + " points a layer of " + inflow.body);
    if (rain)
      texts.push_back("Rain: on " + number_text(rain->area()) + (dim == 2 ? " m" : " m^2") + ", in drops of " +
                      number_text(rain->volume()) + (dim == 2 ? " m^2" : " m^3"));
    return texts;
  }

  template class Scene<2>;
  template class Scene<3>;
} // namespace scree

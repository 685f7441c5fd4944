// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/contact/cut_cells/move_inside.h>
#include <scree/schemes/two_phase_scheme.h>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// The water with the density that resists acceleration.
    WaterParameters with_inertia(WaterParameters water, const double mass_scaling)
    {
      water.density *= mass_scaling;
      return water;
    }
  } // namespace


  template <int dim>
  TwoPhaseScheme<dim>::TwoPhaseScheme(const Model<dim> &model, TimerOutput &timer)
      : grid(model.grid)
      , forces(model.forces)
      , water(model.water)
      , faces_closed_to_soil(model.constraints[0]->faces_closed_to_soil())
      , faces_closed_to_water(model.water_walls->closed_faces())
      , inflows(model.inflows)
      , timer(timer)
      , soil(grid, model.transfer, model.stabilisation, model.bodies, model.loads)
      , transfer(grid, model.transfer, with_inertia(model.water_parameters, forces.mass_scaling()))
      , mixture(grid, model.soil_points, model.cut_cells)
      , nodes(grid, soil.field)
      , ground_gaps(grid, model.cut_cells, forces.fall().norm())
      , surface(grid, grid.vertices(), *model.water_walls, model.cut_cells, model.water_parameters.air_entry_pressure)
      , operators(grid, grid.vertices(), surface, model.cut_cells, ground_gaps)
      , pressure(grid, surface, operators, model.pressure_parameters, model.water_parameters, timer)
      , wall_gaps(grid, *model.constraints[0])
      , spacing(grid.cell_size() / std::min(model.soil_points, model.water_parameters.points_per_cell))
      , momentum(nodes, *model.constraints[0], wall_gaps, forces, model.water_parameters.density, timer)
      , viscosity(grid, model.water_parameters, water, timer)
      , contact(grid, model.ground, model.surfaces, model.cut_cells, ground_gaps, timer)
      , shifting(grid,
                 *model.constraints[0],
                 surface,
                 pressure,
                 forces.gravity(),
                 model.water_parameters.volume_correction_rate)
  {
    wall_gaps.add({ &nodes.soil, &nodes.water });
    momentum.reinit(grid.n_owned_nodes());
  }


  template <int dim>
  void TwoPhaseScheme<dim>::gather()
  {
    mixture.clear();
    nodes.clear();
    for (const auto &body : soil.all_bodies())
      transfer.soil_to_grid(body, mixture);
    surface.find_soil_depths(mixture);
    for (const auto &part : water)
      transfer.to_grid(part, mixture, nodes);
    for (const Inflow<dim> &inflow : inflows)
      if (inflow.water_share > 0.)
        inflow.add_to(mixture);
    mixture.scale_inertia(forces.mass_scaling());
  }


  template <int dim>
  void TwoPhaseScheme<dim>::to_grid(const double time)
  {
    soil.average(timer);
    const TimedPart part(timer, TimerSection::points_to_grid);
    soil.to_grid(time);
    gather();
    wall_gaps.clear();
    wall_gaps.add(mixture);
    ground_gaps.clear();
    for (const PointSet<dim> *points : point_sets())
      wall_gaps.add(*points, spacing);
    for (const auto &body : soil.all_bodies())
      ground_gaps.add(body.points, body.layout.velocity, spacing);
    for (auto &one : water)
      if (const PointSet<dim> *own = one.own_points())
        ground_gaps.add(*own, one.layout.velocity, spacing);
  }


  template <int dim>
  void TwoPhaseScheme<dim>::prepare_pressure(const double time_step)
  {
    const TimedPart part(timer, TimerSection::nodes);
    const auto bulk_volume = [&](const unsigned int node) {
      return nodes.water[node][NodalField<dim>::mass] / transfer.water_density() +
             nodes.pores[node][Pores::local_solid_volume];
    };
    const auto holds = [&](const unsigned int node, const unsigned int face) {
      return wall_gaps.is_closed_to_water(node, face);
    };
    pressure.locate(mixture);
    operators.integrate(mixture, bulk_volume, holds, time_step);
    momentum.find_flux_inertia(time_step); // n_i takes the place of the volume of grains, which integrate() reads
    momentum.add_pressure_forces(pressure.impulses(time_step), operators, time_step);
  }


  template <int dim>
  void TwoPhaseScheme<dim>::solve(const double time_step, StepReport<dim> &report)
  {
    Budget<dim> &budget = report.balance;
    sum_at_nodes(time_step);     // 1. masses, momenta and forces
    prepare_pressure(time_step); // 2. d, T, p^n and B; of 1 n_i and C_i, of 3 the force of p^n
    if (water_is_held)
      load_soil_with_water();
    momentum.predict(time_step, transfer.kept(time_step), budget); // 3. A v* = m v + dt (f + m g - B^T p^n)
    contact.begin_step(mixture, surface);
    if (!water_is_held)
      viscosity.apply(nodes, momentum, contact, time_step, budget);   // 4. (A + dt K) v** = A v*
    find_pressure(time_step, budget);                                 // 5. S dp = b, and t: B u = c, N v <= c
    momentum.correct(pressure.impulses_of_change(time_step), budget); // 6. v = v** - dt A^-1 (B^T dp + N^T t)
    end_step(time_step, budget);                                      // 7. p = p^n + dp; the points: to_points()
  }


  template <int dim>
  void TwoPhaseScheme<dim>::find_pressure(const double time_step, Budget<dim> &budget)
  {
    const auto block_at   = [this](const unsigned int node) { return momentum.pressed_block_at(node); };
    GroundRows<dim> *rows = contact.find_rows(nodes, mixture, surface, time_step);
    pressure.solve(mixture, nodes, block_at, rows, water_is_held, time_step, budget);
  }


  template <int dim>
  void TwoPhaseScheme<dim>::end_step(const double time_step, Budget<dim> &budget)
  {
    contact.count_rows(nodes, time_step, budget);
    if (surface.prescribes_values())
      momentum.count_pressure_work(pressure.prescribed_impulses(time_step), budget);
    if (water_is_held)
      return; // its points have the pressure
    {
      const TimedPart part(timer, TimerSection::nodes);
      viscosity.count_dissipation(nodes, budget);
      pressure.accept_change();
      // The predictor has counted the load among the forces.
      budget.load_impulse += soil.load_impulse(time_step);
      budget.pressure_impulse -= soil.load_impulse(time_step);
    }
    contact.count_pressure(mixture, pressure, time_step, budget);
  }


  template <int dim>
  void TwoPhaseScheme<dim>::load_soil_with_water()
  {
    using Field = NodalField<dim>;
    for (const unsigned int node : nodes.active())
      {
        double *of_soil = nodes.soil[node], *of_water = nodes.water[node];
        if (of_soil[Field::mass] > 0.)
          {
            const double ratio = 1. + of_water[Field::mass] / of_soil[Field::mass];
            of_soil[Field::mass] *= ratio;
            for (unsigned int c = 0; c < dim; ++c)
              {
                of_soil[Field::momentum + c] *= ratio;
                of_soil[Field::force + c] += of_water[Field::force + c];
              }
          }
        std::fill_n(of_water, Field::n_components, 0.);
      }
  }


  template <int dim>
  void TwoPhaseScheme<dim>::move_water(const double time_step, StepReport<dim> &report)
  {
    const TimedPart part(timer, TimerSection::water_points);
    for (auto &one : water)
      {
        report.speeds.include_point(transfer.to_points(
            one, nodes, mixture, [this](const unsigned int cell) { return pressure.pressure_of(cell); }, time_step));
        shifting.apply(one, mixture, nodes, time_step, report.balance);
        if (const PointSet<dim> *own = one.own_points())
          report.n_updates += own->n_points();
      }
  }


  template <int dim>
  void TwoPhaseScheme<dim>::project_to_boundary(const double time_step, StepReport<dim> &report)
  {
    const double largest_speed = report.speeds.points;
    for (auto &one : water)
      keep_off_walls(grid, faces_closed_to_water, forces.mass_scaling(), one, report.balance);
    for (auto &body : soil.all_bodies())
      if (!body.is_rigid)
        report.soil += contact.project_to_boundary({ body.points, body.layout, body.has_affine_energy, Phase::soil },
                                                   forces.mass_scaling(),
                                                   time_step,
                                                   largest_speed,
                                                   faces_closed_to_soil,
                                                   report.balance);
    for (auto &one : water)
      if (PointSet<dim> *own = one.own_points())
        contact.project_to_boundary({ *own, one.layout, one.has_affine_energy, Phase::water },
                                    forces.mass_scaling(),
                                    time_step,
                                    largest_speed,
                                    faces_closed_to_water,
                                    report.balance);
    for (const auto &one : water)
      report.water += motion_of_points(grid, one.points(), one.layout, one.has_affine_energy);
  }


  template <int dim>
  std::vector<PointSet<dim> *> TwoPhaseScheme<dim>::point_sets()
  {
    std::vector<PointSet<dim> *> sets;
    soil.append_point_sets(sets);
    for (auto &one : water)
      if (PointSet<dim> *own = one.own_points())
        sets.push_back(own);
    return sets;
  }


  template <int dim>
  std::unique_ptr<WaterView<dim>> TwoPhaseScheme<dim>::water_view() const
  {
    return std::make_unique<WaterView<dim>>(
        WaterView<dim>{ water, nodes.water, [this](const unsigned int cell) { return pressure.pressure_of(cell); } });
  }

  template class TwoPhaseScheme<2>;
  template class TwoPhaseScheme<3>;
} // namespace scree

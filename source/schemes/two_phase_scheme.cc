// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/boundary/clamp_to_box.h>
#include <scree/schemes/two_phase_scheme.h>

#include <algorithm>

namespace scree
{
  using namespace dealii;

  template <int dim>
  TwoPhaseScheme<dim>::TwoPhaseScheme(const BackgroundGrid<dim> &grid,
                                      Constraints<dim> &constraints,
                                      const WaterBoundaryConditions<dim> &water_walls,
                                      const BodyForces<dim> &forcing,
                                      const TransferParameters &transfer_parameters,
                                      const StabilisationParameters &stabilisation,
                                      const WaterParameters &water_parameters,
                                      const PressureParameters &pressure_parameters,
                                      std::list<SoilBody<dim>> &bodies,
                                      const unsigned int soil_points,
                                      std::list<WaterPhase<dim>> &water,
                                      std::list<SurfaceLoad<dim>> &loads,
                                      const CutCells<dim> *cut_cells,
                                      std::unique_ptr<CutCellContact<dim>> bed,
                                      const std::list<Inflow<dim>> &inflows,
                                      TimerOutput &timer)
      : grid(grid)
      , forcing(forcing)
      , water_density(water_parameters.density)
      , fluidisation_porosity(water_parameters.fluidisation_porosity)
      , water(water)
      // Without gravity nothing falls; where water is compressible, closing is strain; what soil gains would be water
      // if its points carry that.
      , limits_volumetric_strain(
            stabilisation.f_bar_kind() != FBar::none && forcing.gravity().norm() > 0. &&
            water_parameters.bulk_modulus == 0. &&
            std::all_of(water.begin(), water.end(), [](const auto &one) { return one.carrier() == nullptr; }))
      , faces_closed_to_soil(constraints.faces_closed_to_soil())
      , faces_closed_to_water(water_walls.closed_faces())
      , inflows(inflows)
      , timer(timer)
      , soil(grid, transfer_parameters, stabilisation, bodies, loads)
      , transfer(grid,
                 transfer_parameters,
                 water_parameters,
                 pressure_parameters.uses_pressure_gradient() ? 1. : 0.)
      , mixture(grid, soil_points, cut_cells)
      , pores(grid)
      , water_field(grid)
      , pressure(grid, water_walls, pressure_parameters, water_parameters, forcing.gravity(), cut_cells, timer)
      , wall_gaps(grid, constraints)
      , spacing(grid.cell_size() / std::min(soil_points, water_parameters.points_per_cell))
      , step(grid, constraints, wall_gaps, forcing, water_density)
      , bed(std::move(bed))
  {
    wall_gaps.add({ &soil.field, &water_field });
    for (const auto &body : bodies)
      shear_modulus = std::max(shear_modulus, body.material->shear_modulus());
    if (water_parameters.viscosity > 0)
      viscosity = std::make_unique<ViscousStep<dim>>(grid, water_parameters, bodies, water);
    if (water_parameters.volume_correction_rate > 0)
      volume_correction = std::make_unique<ParticleShifting<dim>>(
          grid, constraints, pressure, forcing.gravity(), water_parameters.volume_correction_rate);
  }


  template <int dim>
  void TwoPhaseScheme<dim>::reinit()
  {
    soil.reinit();
    mixture.reinit();
    pores.reinit();
    water_field.reinit();
    pressure.reinit();
    wall_gaps.reinit();
    step.reinit();
    if (viscosity)
      viscosity->reinit();
    if (bed)
      bed->reinit();
    if (volume_correction)
      volume_correction->reinit();
  }


  template <int dim>
  void TwoPhaseScheme<dim>::follow_ground()
  {
    pressure.follow_ground();
    bed->follow();
  }


  template <int dim>
  void TwoPhaseScheme<dim>::gather()
  {
    mixture.clear();
    pores.clear();
    water_field.clear();
    for (const auto &body : soil.all_bodies())
      transfer.soil_to_grid(body, mixture);
    for (const auto &part : water)
      transfer.to_grid(part, mixture, water_field, pores);
    for (const Inflow<dim> &inflow : inflows)
      if (inflow.water_share > 0.)
        inflow.add_to(mixture);
    mixture.finish();
  }


  template <int dim>
  void TwoPhaseScheme<dim>::complete_pores()
  {
    for (unsigned int record = 0; record < mixture.cells().size(); ++record)
      {
        const MixtureCell<dim> &cell = mixture.cells()[record];
        // An absent phase takes the other's velocity.
        soil.field.activate_cell(cell.cell);
        pores.activate_cell(cell.cell);
        water_field.activate_cell(cell.cell);
        if (cell.effective_saturation == 0 || cell.grain_volume == 0)
          continue;
        const unsigned int *nodes = grid.nodes(cell.cell);
        const unsigned int n = grid.n_nodes_1d(), n_rows = grid.n_nodes_per_cell() / n;
        const double drag      = cell.drag_share * cell.drag / cell.water_volume;
        const double inertial  = cell.drag_share * cell.inertial / cell.water_volume;
        const double wet_pores = cell.effective_saturation * cell.pore_volume / cell.grain_volume;
        for (unsigned int r = 0; r < n_rows; ++r)
          for (unsigned int i = 0; i < n; ++i)
            {
              const double grains = mixture.grain_volumes(record, r)[i];
              const double water  = mixture.water_volumes(record, r)[i];
              double *pore        = pores[nodes[r * n + i]];
              pore[PoreField<dim>::grain_volume] += cell.effective_saturation * grains;
              pore[PoreField<dim>::drag] += drag * water;
              pore[PoreField<dim>::inertial_drag] += inertial * water;
              pore[PoreField<dim>::wet_pores] += wet_pores * grains;
            }
      }
  }


  template <int dim>
  void TwoPhaseScheme<dim>::add_pressure_forces()
  {
    for (unsigned int record = 0; record < mixture.cells().size(); ++record)
      if (const unsigned int cell = mixture.cells()[record].cell; mixture.cells()[record].water_volume > 0)
        mixture.add_pressure_gradient(record,
                                      multilinear_of<dim>(pressure.pressure_of(cell)),
                                      -1.,
                                      soil.field,
                                      NodalField<dim>::force,
                                      water_field,
                                      NodalField<dim>::force);
  }


  template <int dim>
  void TwoPhaseScheme<dim>::read_points()
  {
    gather();
    complete_pores();
    pressure.locate(mixture);
    soil.field.clear();
    water_field.clear(); // sums, not velocities
  }


  template <int dim>
  void TwoPhaseScheme<dim>::to_grid(const double time)
  {
    const TimedPart part(timer, TimerSection::points_to_grid);
    soil.to_grid(time);
    gather();
    wall_gaps.clear();
    wall_gaps.add(mixture);
    for (const PointSet<dim> *points : point_sets())
      wall_gaps.add(*points, spacing);
  }


  template <int dim>
  void TwoPhaseScheme<dim>::solve(const double time_step, StepReport<dim> &report)
  {
    const MixtureNodes<dim> nodes{ soil.field, water_field, pores };
    {
      const TimedPart part(timer, TimerSection::nodes);
      complete_pores();
      pressure.locate(mixture);
      add_pressure_forces();
      soil.add_loads(time_step); // p is that of the end, and the load is what it bears.
      soil.field.add_contributions();
      water_field.add_contributions();
      pores.add_contributions();
      wall_gaps.release(forcing, time_step);
      step.predict(nodes, time_step, report.balance);
      soil.field.update_ghosts();
      water_field.update_ghosts();
      pores.update_ghosts();
    }
    if (bed)
      {
        const TimedPart part(timer, TimerSection::bed);
        bed->begin_step(mixture, pressure.free_surface());
      }
    if (viscosity)
      {
        const TimedPart part(timer, TimerSection::nodes);
        viscosity->apply(nodes, step, bed.get(), time_step, report.balance);
        soil.field.update_ghosts();
        water_field.update_ghosts();
      }
    if (bed)
      {
        const TimedPart part(timer, TimerSection::bed);
        bed->predict(nodes, mixture, step, time_step, report.balance);
        soil.field.update_ghosts();
        water_field.update_ghosts();
      }
    pressure.solve(mixture, soil.field, water_field, pores, time_step, shear_modulus, report.balance);
    {
      const TimedPart part(timer, TimerSection::nodes);
      step.correct(nodes, mixture, pressure, time_step, report.balance);
      soil.field.update_ghosts();
      water_field.update_ghosts();
    }
    if (bed)
      {
        const TimedPart part(timer, TimerSection::bed);
        bed->correct(nodes, mixture, step, pressure.free_surface(), time_step, report.balance);
        soil.field.update_ghosts();
        water_field.update_ghosts();
        bed->count(nodes, report.balance);
      }
    {
      const TimedPart part(timer, TimerSection::nodes);
      if (viscosity)
        viscosity->count_dissipation(nodes, report.balance);
      pressure.accept_change(mixture, soil.field, water_field, pores);
      if (limits_volumetric_strain)
        pressure.find_volume_factors(mixture, soil.field, water_field, pores, time_step);
      // The predictor has counted the load among the forces.
      report.balance.load_impulse += soil.load_impulse(time_step);
      report.balance.pressure_impulse -= soil.load_impulse(time_step);
    }
    if (bed)
      {
        const TimedPart part(timer, TimerSection::bed);
        bed->count_pressure(mixture, pressure, time_step, report.balance);
      }
  }


  template <int dim>
  void TwoPhaseScheme<dim>::fluidise()
  {
    if (fluidisation_porosity >= 1.)
      return;
    const double no_stress[n_symmetric_components<dim>] = {};
    for (auto &body : soil.all_bodies())
      {
        const auto &layout = body.layout;
        std::vector<double> scratch(layout.n_properties); // A state without stress must not reset internal variables.
        for_each_point(body.points, [&](const auto &point) {
          double *properties = point.properties;
          if (body.porosity(properties) > fluidisation_porosity)
            body.material->initialise(
                no_stress, properties + layout.left_cauchy_green, properties + layout.stress, scratch.data());
        });
      }
  }


  template <int dim>
  void TwoPhaseScheme<dim>::to_points(const double time_step, StepReport<dim> &report)
  {
    {
      const TimedPart part(timer, TimerSection::stress);
      soil.to_points(time_step, report, &mixture);
      fluidise();
    }
    {
      const TimedPart part(timer, TimerSection::water_points);
      for (auto &one : water)
        {
          report.speeds.include_point(transfer.to_points(
              one,
              { soil.field, water_field, pores },
              mixture,
              [this](const unsigned int cell) { return pressure.pressure_of(cell); },
              pressure.fades() ? [this](const unsigned int cell) { return pressure.forgotten_of(cell); }
                               : ForgottenOfCell<dim>(),
              time_step));
          if (volume_correction)
            volume_correction->apply(one, mixture, water_field, pores, time_step, report.balance);
          if (PointSet<dim> *own = one.own_points())
            {
              clamp_to_box(grid, faces_closed_to_water, *own);
              report.n_updates += own->n_points();
            }
        }
    }
    if (bed)
      {
        const TimedPart part(timer, TimerSection::bed);
        // Nodes may be faster than points, and volume correction shifts by a tenth of a cell along each axis.
        const double farthest = 0.25 * grid.cell_size() + 2. * time_step * report.speeds.points;
        std::vector<PointSet<dim> *> of_soil;
        soil.append_point_sets(of_soil);
        for (PointSet<dim> *points : of_soil)
          bed->project_to_boundary(*points, farthest, faces_closed_to_soil);
        for (auto &one : water)
          if (PointSet<dim> *own = one.own_points())
            bed->project_to_boundary(*own, farthest, faces_closed_to_water);
      }
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
  const NodalField<dim> &TwoPhaseScheme<dim>::soil_field()
  {
    return soil.field;
  }


  template <int dim>
  std::unique_ptr<WaterView<dim>> TwoPhaseScheme<dim>::water_view() const
  {
    return std::make_unique<WaterView<dim>>(
        WaterView<dim>{ water, water_field, [this](const unsigned int cell) { return pressure.pressure_of(cell); } });
  }

  template class TwoPhaseScheme<2>;
  template class TwoPhaseScheme<3>;
} // namespace scree

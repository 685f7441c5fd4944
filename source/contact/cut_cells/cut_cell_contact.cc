// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/contact/cut_cells/cut_cell_contact.h>
#include <scree/contact/cut_cells/clamp_to_box.h>
#include <scree/mixture/mixture.h>

#include <deal.II/base/geometry_info.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace scree
{
  using namespace dealii;

  template <int dim>
  CutCellContact<dim>::CutCellContact(const BackgroundGrid<dim> &grid,
                                      const RigidBoundary<dim> *ground,
                                      const std::vector<RigidSurface<dim>> &surfaces,
                                      const CutCells<dim> *cut_cells,
                                      const GroundGaps<dim> &gaps,
                                      const double relative_tolerance,
                                      TimerOutput &timer)
      : grid(grid)
      , ground(ground)
      , surfaces(surfaces)
      , n_obstacles(
            std::count_if(surfaces.begin(), surfaces.end(), [](const auto &s) { return s.obstacle != nullptr; }))
      , cut_cells(cut_cells)
      , gaps(gaps)
      , relative_tolerance(relative_tolerance)
      , timer(timer)
      , any_holds_water(
            std::any_of(surfaces.begin(), surfaces.end(), [](const auto &surface) { return surface.no_slip; }))
  {
    if (ground == nullptr)
      return;
    contacts.emplace(grid, *cut_cells);
    reinit();
  }


  template <int dim>
  unsigned int CutCellContact<dim>::find_surface(const CutFacet<dim> &segment) const
  {
    const GroundPart<dim> &part = ground->parts()[segment.part];
    unsigned int number         = 0;
    double nearest              = std::numeric_limits<double>::infinity();
    for (unsigned int i = 0; i < surfaces.size(); ++i)
      {
        const RigidSurface<dim> &surface = surfaces[i];
        if (surface.samples == part.samples)
          return i;
        if (!(surface.obstacle && surface.obstacle->is_moving) && surface.samples->is_near(segment.cell))
          if (const double distance = surface.samples->view(segment.cell, segment.middle).distance; distance < nearest)
            {
              nearest = distance;
              number  = i;
            }
      }
    return number;
  }


  template <int dim>
  void CutCellContact<dim>::find_surfaces()
  {
    const auto &segments = cut_cells->segments();
    surface_numbers.resize(segments.size());
    for (unsigned int s = 0; s < segments.size(); ++s)
      surface_numbers[s] = find_surface(segments[s]);
  }


  template <int dim>
  void CutCellContact<dim>::reinit()
  {
    if (!contacts)
      return;
    contacts->reinit();
    of_segments.assign(cut_cells->segments().size(), OfSegment()); // The next step begins its search from nothing.
    find_surfaces();
  }


  template <int dim>
  void CutCellContact<dim>::follow()
  {
    const std::vector<unsigned int> &numbers = cut_cells->numbers_before();
    std::vector<OfSegment> now(numbers.size());
    for (unsigned int s = 0; s < numbers.size(); ++s)
      if (numbers[s] != cut_cells->none)
        now[s] = of_segments[numbers[s]];
    of_segments = std::move(now);
    find_surfaces();
  }


  template <int dim>
  ObstacleBalance<dim> *CutCellContact<dim>::balance_of(const unsigned int segment, Budget<dim> &balance) const
  {
    const unsigned int first = surfaces.size() - n_obstacles;
    return surface_numbers[segment] < first ? nullptr : &balance.obstacles[surface_numbers[segment] - first];
  }


  template <int dim>
  Tensor<1, dim> CutCellContact<dim>::mean_velocity(const CutFacet<dim> &segment, const NodalField<dim> &field) const
  {
    const unsigned int *nodes     = grid.nodes(segment.cell);
    const unsigned int n_nodes_1d = grid.n_nodes_1d();
    static_assert(NodalField<dim>::velocity + 4 <= NodalField<dim>::n_components, "A row begins with the velocity.");
    NodeRow sums[3] = {}; // Several, as each addition would wait for the one before.
    for (unsigned int i = 0; i < segment.shapes.size(); i += n_nodes_1d)
      for (unsigned int j = 0; j < n_nodes_1d; ++j)
        sums[j] += segment.shapes[i + j] * load_row(field[nodes[i + j]] + NodalField<dim>::velocity);
    return to_vector<dim>(sums[0] + sums[1] + sums[2]);
  }


  template <int dim>
  void CutCellContact<dim>::add_contact(const unsigned int segment,
                                        const Phase phase,
                                        const bool is_unilateral,
                                        const MixtureNodes<dim> &nodes,
                                        const double time_step,
                                        const Tensor<1, dim> &base,
                                        const Tensor<1, dim> &first)
  {
    const CutFacet<dim> &of_ground = cut_cells->segments()[segment];
    GroundContact<dim> contact{};
    contact.segment       = segment;
    contact.phase         = phase;
    contact.is_unilateral = is_unilateral;
    if (phase == Phase::soil)
      contact.friction = surface_of(segment).friction_coefficient;
    else if (std::binary_search(holding.begin(), holding.end(), segment))
      contact.friction = std::numeric_limits<double>::infinity();
    contact.area   = of_ground.area;
    contact.normal = of_ground.normal;
    contact.speed =
        mean_velocity(of_ground, phase == Phase::soil ? nodes.soil : nodes.water) - cut_cells->velocity(of_ground);
    if (const double allowed = gaps.allowed_approach(segment, contact.speed * contact.normal, time_step); allowed > 0.)
      {
        contact.speed -= allowed * contact.normal;
        if (contact.speed * contact.normal <= 0.)
          return; // The gap does not close in this step.
      }
    // What neither presses nor comes near is left alone.
    if (is_unilateral && contact.speed * contact.normal <= 0. && !(base * contact.normal > 0.))
      return;
    contact.base    = base;
    contact.impulse = contact.part(contact.holds(), first);
    contacts->add(contact);
  }


  template <int dim>
  void CutCellContact<dim>::project(const MixtureNodes<dim> &nodes,
                                    const TwoPhaseMomentum<dim> &step,
                                    const double wanted,
                                    Budget<dim> &balance)
  {
    largest_flow = std::max(largest_flow, contacts->flow());
    if (largest_flow == 0.)
      return;
    contacts->find(nodes, step, wanted * largest_flow);
    for (const GroundContact<dim> &contact : contacts->contacts())
      {
        OfSegment &taken = of_segments[contact.segment];
        (contact.phase == Phase::soil ? taken.soil : taken.water) += contact.impulse;
      }
    contacts->take(nodes, step, balance);
  }

  template <int dim>
  void CutCellContact<dim>::begin_step(const Mixture<dim> &mixture, const FreeSurface<dim> &surface)
  {
    if (!contacts)
      return;
    const TimedPart part(timer, TimerSection::bed);
    contacts->begin_step();
    for (OfSegment &segment : of_segments)
      segment.soil = segment.water = Tensor<1, dim>();
    if (!any_holds_water)
      return;
    holding.clear();
    // Water in pores is stopped by the grains, and what goes through them does not feel the ground a cell away.
    for (const MixtureCell<dim> &cell : mixture.cells())
      if (cell.water_volume > 0. && cell.soil_mass <= 0. && surface.has_unknown(cell.cell))
        for_segments(cell.cell, [&](const unsigned int segment) {
          if (surface_of(segment).no_slip)
            holding.push_back(segment);
        });
    std::sort(holding.begin(), holding.end());
  }


  template <int dim>
  Tensor<1, dim> CutCellContact<dim>::viscous_force(const unsigned int s,
                                                    const NodalField<dim> &motion,
                                                    const double ground_share,
                                                    const double viscosity) const
  {
    const CutFacet<dim> &segment  = cut_cells->segments()[s];
    const Tensor<1, dim> velocity = mean_velocity(segment, motion) - ground_share * cut_cells->velocity(segment);
    return -viscosity * segment.area / (closures::slip_length * grid.cell_size()) * velocity;
  }


  template <int dim>
  void CutCellContact<dim>::add_viscous_force(const NodalField<dim> &motion,
                                              const double ground_share,
                                              const double viscosity,
                                              NodalField<dim> &force) const
  {
    for (const unsigned int s : holding)
      {
        const CutFacet<dim> &segment    = cut_cells->segments()[s];
        const Tensor<1, dim> of_segment = viscous_force(s, motion, ground_share, viscosity);
        const unsigned int *nodes       = grid.nodes(segment.cell);
        for (unsigned int i = 0; i < segment.shapes.size(); ++i)
          for (unsigned int c = 0; c < dim; ++c)
            force[nodes[i]][NodalField<dim>::force + c] += segment.shapes[i] * of_segment[c];
      }
  }


  template <int dim>
  void
  CutCellContact<dim>::take_viscous_force(const NodalField<dim> &motion, const double viscosity, const double time_step)
  {
    for (const unsigned int s : holding)
      of_segments[s].water -= time_step * viscous_force(s, motion, 1., viscosity);
  }


  template <int dim>
  void CutCellContact<dim>::predict(const MixtureNodes<dim> &nodes,
                                    const Mixture<dim> &mixture,
                                    const TwoPhaseMomentum<dim> &step,
                                    const double time_step,
                                    Budget<dim> &balance)
  {
    if (!contacts)
      return;
    const TimedPart part(timer, TimerSection::bed);
    contacts->clear();
    largest_flow = 0.;
    for (const MixtureCell<dim> &cell : mixture.cells())
      if (cell.soil_mass > 0. && !cell.is_rigid)
        for_segments(cell.cell, [&](const unsigned int segment) {
          const Tensor<1, dim> nothing, first = time_step * of_segments[segment].predicted_soil;
          add_contact(segment, Phase::soil, !is_fixed(segment), nodes, time_step, nothing, first);
        });
    project(nodes, step, relative_tolerance, balance);
    for (OfSegment &segment : of_segments)
      segment.predicted_soil = segment.soil / time_step;
    nodes.update_velocity_ghosts();
  }


  template <int dim>
  void CutCellContact<dim>::correct(const MixtureNodes<dim> &nodes,
                                    const Mixture<dim> &mixture,
                                    const TwoPhaseMomentum<dim> &step,
                                    const FreeSurface<dim> &surface,
                                    const double time_step,
                                    Budget<dim> &balance)
  {
    if (!contacts)
      return;
    const TimedPart part(timer, TimerSection::bed);
    contacts->clear();
    for (const MixtureCell<dim> &cell : mixture.cells())
      for_segments(cell.cell, [&](const unsigned int segment) {
        const OfSegment &known = of_segments[segment];
        if (cell.soil_mass > 0. && !cell.is_rigid)
          add_contact(
              segment, Phase::soil, !is_fixed(segment), nodes, time_step, known.soil, time_step * known.corrected_soil);
        const bool holds = std::binary_search(holding.begin(), holding.end(), segment);
        if (cell.water_volume > 0. && (holds || !surface.has_unknown(cell.cell)))
          add_contact(segment,
                      Phase::water,
                      !surface.has_unknown(cell.cell),
                      nodes,
                      time_step,
                      Tensor<1, dim>(),
                      time_step * known.corrected_water);
      });
    for (OfSegment &segment : of_segments)
      segment.corrected_soil = segment.corrected_water = Tensor<1, dim>();
    constexpr double coarser = 10.; // suffices: the next predictor removes the remainder
    project(nodes, step, coarser * relative_tolerance, balance);
    for (const GroundContact<dim> &contact : contacts->contacts())
      {
        OfSegment &found                                                              = of_segments[contact.segment];
        (contact.phase == Phase::soil ? found.corrected_soil : found.corrected_water) = contact.impulse / time_step;
      }
    nodes.update_velocity_ghosts();
    count(nodes, balance);
  }


  template <int dim>
  void CutCellContact<dim>::count(const MixtureNodes<dim> &nodes, Budget<dim> &balance) const
  {
    balance.obstacles.resize(n_obstacles);
    for (unsigned int s = 0; s < of_segments.size(); ++s)
      {
        const OfSegment &taken = of_segments[s];
        if (taken.soil.norm_square() + taken.water.norm_square() == 0.)
          continue;
        const CutFacet<dim> &segment = cut_cells->segments()[s];
        const unsigned int *of_cell  = grid.nodes(segment.cell);
        Tensor<1, dim> impulse;
        double dissipation = 0.;
        const auto add     = [&](const NodalField<dim> &field, const Tensor<1, dim> &of_phase) {
          if (of_phase.norm_square() == 0.)
            return;
          constexpr unsigned int last =
              NodalField<dim>::n_components - 4; // The change of velocity ends a node's values.
          double share = 0.;
          NodeRow motions{}, last_values{};
          for (unsigned int i = 0; i < segment.shapes.size(); ++i)
            {
              const double *values = field[of_cell[i]];
              const double shape   = values[NodalField<dim>::mass] > 0. ? segment.shapes[i] : 0.;
              share += shape;
              motions += shape * load_row(values + NodalField<dim>::velocity);
              last_values += shape * load_row(values + last);
            }
          Tensor<1, dim> velocity; // mean of the step's, with which an impulse does work
          for (unsigned int c = 0; c < dim; ++c)
            velocity[c] = motions[c] - 0.5 * last_values[NodalField<dim>::velocity_change - last + c];
          impulse -= share * of_phase;
          dissipation += of_phase * velocity;
        };
        add(nodes.soil, taken.soil);
        add(nodes.water, taken.water);
        if (ObstacleBalance<dim> *obstacle = balance_of(s, balance))
          {
            const double work = impulse * cut_cells->velocity(segment);
            obstacle->impulse += impulse;
            obstacle->add_moment(cut_cells->segments()[s].middle - surface_of(s).obstacle->pivot, impulse);
            obstacle->work += work;
            obstacle->dissipation += work + dissipation;
          }
        else
          {
            balance.bed_impulse += impulse;
            balance.bed_dissipation += dissipation;
          }
      }
  }


  template <int dim>
  void CutCellContact<dim>::count_pressure(const Mixture<dim> &mixture,
                                           const PorePressure<dim> &pressure,
                                           const double time_step,
                                           Budget<dim> &balance) const
  {
    if (!contacts || n_obstacles == 0)
      return;
    const TimedPart part(timer, TimerSection::bed);
    for (const MixtureCell<dim> &cell : mixture.cells())
      if (cell.water_volume > 0.)
        for_segments(cell.cell, [&](const unsigned int s) {
          ObstacleBalance<dim> *obstacle = balance_of(s, balance);
          if (obstacle == nullptr)
            return;
          const CutFacet<dim> &segment = cut_cells->segments()[s];
          const auto corners           = pressure.pressure_of(cell.cell);
          double mean                  = 0.;
          for (unsigned int v = 0; v < corners.size(); ++v)
            mean += segment.vertex_weights[v] * corners[v];
          const Tensor<1, dim> impulse = -time_step * mean * segment.area * segment.normal;
          obstacle->pressure_impulse += impulse;
          obstacle->add_moment(cut_cells->segments()[s].middle - surface_of(s).obstacle->pivot, impulse);
          obstacle->work += impulse * cut_cells->velocity(segment);
        });
  }


  template <int dim>
  void CutCellContact<dim>::project_to_boundary(PointSet<dim> &points,
                                                const double farthest,
                                                const std::uint8_t closed_faces) const
  {
    if (!contacts)
      return;
    const TimedPart part(timer, TimerSection::bed);
    move_out_of_ground(grid, *ground, farthest, closed_faces, points);
  }

  template class CutCellContact<2>;
  template class CutCellContact<3>;
} // namespace scree

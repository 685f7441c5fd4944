// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/contact/cut_cells/cut_cell_contact.h>
#include <scree/contact/cut_cells/move_inside.h>
#include <scree/mixture/mixture.h>
#include <scree/tensor/vector.h>

#include <deal.II/base/geometry_info.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// Of a node by the field that holds its velocity after a step, m/s.
    template <int dim>
    auto mean_velocity_in_step(const NodalField<dim> &field)
    {
      return [&field](const unsigned int node) {
        return vector_of<dim>(field[node] + NodalField<dim>::velocity) -
               0.5 * vector_of<dim>(field[node] + NodalField<dim>::velocity_change);
      };
    }
  } // namespace


  template <int dim>
  CutCellContact<dim>::CutCellContact(const BackgroundGrid<dim> &grid,
                                      const RigidBoundary<dim> *ground,
                                      const std::vector<RigidSurface<dim>> &surfaces,
                                      const CutCells<dim> *cut_cells,
                                      const GroundGaps<dim> &gaps,
                                      TimerOutput &timer)
      : grid(grid)
      , ground(ground)
      , surfaces(surfaces)
      , n_obstacles(
            std::count_if(surfaces.begin(), surfaces.end(), [](const auto &s) { return s.obstacle != nullptr; }))
      , cut_cells(cut_cells)
      , gaps(gaps)
      , rows(grid)
      , timer(timer)
      , any_no_slip(std::any_of(surfaces.begin(), surfaces.end(), [](const auto &surface) { return surface.no_slip; }))
  {
    reinit();
  }


  template <int dim>
  void CutCellContact<dim>::reinit()
  {
    if (ground == nullptr)
      return;
    const std::vector<FacetTractions<dim>> before = tractions();
    make_segments();
    set_tractions(before);
  }


  template <int dim>
  void CutCellContact<dim>::make_segments()
  {
    const auto &segments = cut_cells->segments();
    of_segments.assign(segments.size(), OfSegment());
    const FineCells<dim> &cells = grid.fine_cells();
    for (unsigned int s = 0; s < segments.size(); ++s)
      {
        of_segments[s].tractions.cell = cells.cells()[cells.of_index(segments[s].cell)].number;
        of_segments[s].tractions.part = segments[s].part;
        const Point<dim> lower        = cells.box().corner(cells.cells()[cells.of_index(segments[s].cell)].place);
        // Those of small segments of curved ground are up to .03 beside the surface's.
        of_segments[s].normal =
            -ground->parts()[segments[s].part]
                 .samples->view(segments[s].cell, Point<dim>((segments[s].middle - lower) / grid.cell_size()))
                 .normal;
      }
  }


  template <int dim>
  void CutCellContact<dim>::follow()
  {
    const std::vector<OfSegment> before = std::move(of_segments);
    make_segments();
    const std::vector<unsigned int> &numbers = cut_cells->numbers_before();
    for (unsigned int s = 0; s < numbers.size(); ++s)
      if (numbers[s] != cut_cells->none)
        {
          of_segments[s].tractions = before[numbers[s]].tractions;
          of_segments[s].viscous   = before[numbers[s]].viscous;
        }
  }


  template <int dim>
  std::vector<FacetTractions<dim>> CutCellContact<dim>::tractions() const
  {
    if (ground == nullptr)
      return {};
    std::vector<FacetTractions<dim>> own;
    for (const OfSegment &segment : of_segments)
      if (segment.tractions.soil.norm_square() + segment.tractions.water.norm_square() > 0.)
        own.push_back(segment.tractions);
    return join(grid.communicator(), own);
  }


  template <int dim>
  void CutCellContact<dim>::set_tractions(const std::vector<FacetTractions<dim>> &all)
  {
    std::map<std::pair<std::uint64_t, unsigned int>, const FacetTractions<dim> *> by_place;
    for (const FacetTractions<dim> &one : all)
      by_place[{ one.cell, one.part }] = &one;
    for (OfSegment &segment : of_segments)
      if (const auto found = by_place.find({ segment.tractions.cell, segment.tractions.part }); found != by_place.end())
        segment.tractions = *found->second;
  }


  template <int dim>
  ObstacleBalance<dim> *CutCellContact<dim>::balance_of(const unsigned int part, Budget<dim> &balance) const
  {
    const unsigned int first = surfaces.size() - n_obstacles;
    return part < first ? nullptr : &balance.obstacles[part - first];
  }


  template <int dim>
  void CutCellContact<dim>::book(const unsigned int part,
                                 const Point<dim> &place,
                                 const Tensor<1, dim> &impulse,
                                 const double lost,
                                 Budget<dim> &balance) const
  {
    if (ObstacleBalance<dim> *obstacle = balance_of(part, balance))
      {
        const double work = impulse * ground->velocity(part);
        obstacle->impulse += impulse;
        obstacle->add_moment(place - surfaces[part].obstacle->pivot, impulse);
        obstacle->work += work;
        obstacle->dissipation += work + lost;
      }
    else
      {
        balance.bed_impulse += impulse;
        balance.bed_dissipation += lost;
      }
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
  GroundRow<dim> CutCellContact<dim>::row_of(const unsigned int segment, const Phase phase) const
  {
    const OfSegment &last = of_segments[segment];
    GroundRow<dim> row{};
    row.segment  = segment;
    row.phase    = phase;
    row.area     = cut_cells->segments()[segment].area;
    row.normal   = last.normal;
    row.traction = phase == Phase::soil ? last.tractions.soil : last.tractions.water;
    if (phase == Phase::soil)
      row.friction = surface_of(segment).friction_coefficient;
    else if (std::binary_search(holding.begin(), holding.end(), segment))
      row.friction = std::numeric_limits<double>::infinity();
    return row;
  }


  template <int dim>
  Tensor<1, dim> CutCellContact<dim>::admissible_velocity(GroundRow<dim> &row,
                                                          const Tensor<1, dim> &velocity,
                                                          const double time_step) const
  {
    const Tensor<1, dim> of_ground = ground->velocity(cut_cells->segments()[row.segment].part);
    const double allowed = gaps.approach_of_material(row.segment, (velocity - of_ground) * row.normal, time_step);
    row.is_unilateral    = row.is_unilateral || allowed > 0.; // what has not arrived does not stick yet
    return of_ground + allowed * row.normal;
  }


  template <int dim>
  void CutCellContact<dim>::add_row(const unsigned int segment,
                                    const Phase phase,
                                    const bool is_unilateral,
                                    const double mass_of_cell,
                                    const WetNodes<dim> &nodes,
                                    const double time_step)
  {
    const CutFacet<dim> &facet      = cut_cells->segments()[segment];
    GroundRow<dim> row              = row_of(segment, phase);
    row.is_unilateral               = is_unilateral;
    const NodalField<dim> &field    = phase == Phase::soil ? nodes.soil : nodes.water;
    const Tensor<1, dim> admissible = admissible_velocity(row, mean_velocity(facet, field), time_step);
    rows.add(row, facet, closures::least_inertia * mass_of_cell, field, &nodes);
    rows.all.back().flow -= rows.weight_of_row(rows.all.size() - 1) * admissible;
  }


  template <int dim>
  GroundRows<dim> &CutCellContact<dim>::find_rows(const std::list<SoilBody<dim>> &bodies,
                                                  const unsigned int group,
                                                  const NodalField<dim> &field,
                                                  const double mass_scaling,
                                                  const double time_step)
  {
    rows.clear();
    const auto &segments = cut_cells->segments();
    double density       = 0.;
    is_covered.assign(segments.size(), false);
    for (const SoilBody<dim> &body : bodies)
      if (body.group == group && !body.is_rigid)
        {
          density = std::max(density, mass_scaling * body.density);
          for (const auto &cell : body.points.cells())
            for_segments(cell.cell, [this](const unsigned int segment) { is_covered[segment] = true; });
        }
    const double mass_of_cell      = density * Utilities::fixed_power<dim>(grid.cell_size());
    const unsigned int n_nodes     = grid.n_nodes_per_cell();
    const auto has_enough_at_nodes = [&](const CutFacet<dim> &segment) {
      const unsigned int *nodes = grid.nodes(segment.cell);
      if (field[nodes[n_nodes / 2]][NodalField<dim>::mass] <= 0.) // the largest there
        return false;
      double mass = 0.; // mean over the segment
      for (unsigned int i = 0; i < n_nodes; ++i)
        mass += segment.shapes[i] * field[nodes[i]][NodalField<dim>::mass];
      return mass > closures::least_cover * mass_of_cell;
    };
    for (unsigned int s = 0; s < segments.size(); ++s)
      {
        if (!is_covered[s] && !has_enough_at_nodes(segments[s]))
          continue;
        GroundRow<dim> row = row_of(s, Phase::soil);
        row.is_unilateral  = !is_fixed(s);
        rows.add(row, segments[s], closures::least_row_inertia * mass_of_cell, field);
        GroundRow<dim> &added = rows.all.back();
        const double area     = rows.weight_of_row(rows.all.size() - 1);
        if (area > 0.)
          added.flow -= area * admissible_velocity(added, added.flow / area, time_step);
      }
    return rows;
  }


  template <int dim>
  void CutCellContact<dim>::begin_step(const Mixture<dim> &mixture, const FreeSurface<dim> &surface)
  {
    if (ground == nullptr)
      return;
    const TimedPart part(timer, TimerSection::bed);
    for (OfSegment &segment : of_segments)
      segment.viscous = Tensor<1, dim>();
    if (!any_no_slip)
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
    const Tensor<1, dim> velocity = mean_velocity(segment, motion) - ground_share * ground->velocity(segment.part);
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
      of_segments[s].viscous -= time_step * viscous_force(s, motion, 1., viscosity);
  }


  template <int dim>
  GroundRows<dim> *CutCellContact<dim>::find_rows(const WetNodes<dim> &nodes,
                                                  const Mixture<dim> &mixture,
                                                  const FreeSurface<dim> &surface,
                                                  const double time_step)
  {
    if (ground == nullptr)
      return nullptr;
    const TimedPart part(timer, TimerSection::bed);
    rows.clear();
    for (const MixtureCell<dim> &cell : mixture.cells())
      for_segments(cell.cell, [&](const unsigned int segment) {
        if (cell.soil_mass > 0. && !cell.is_rigid)
          add_row(segment, Phase::soil, !is_fixed(segment), cell.soil_mass, nodes, time_step);
        const bool holds = std::binary_search(holding.begin(), holding.end(), segment);
        if (cell.water_volume > 0. && (holds || !surface.has_unknown(cell.cell)))
          add_row(segment, Phase::water, !surface.has_unknown(cell.cell), cell.water_mass, nodes, time_step);
      });
    return &rows;
  }


  template <int dim>
  void CutCellContact<dim>::count_rows(const WetNodes<dim> &nodes, const double time_step, Budget<dim> &balance)
  {
    if (ground == nullptr)
      return;
    const TimedPart part(timer, TimerSection::bed);
    balance.obstacles.resize(n_obstacles);
    for (OfSegment &segment : of_segments)
      segment.tractions.soil = segment.tractions.water = Tensor<1, dim>();
    for (unsigned int k = 0; k < rows.all.size(); ++k)
      {
        const GroundRow<dim> &row                    = rows.all[k];
        const bool of_soil                           = row.phase == Phase::soil;
        FacetTractions<dim> &tractions               = of_segments[row.segment].tractions;
        const unsigned int *of_cell                  = grid.nodes(cut_cells->segments()[row.segment].cell);
        const auto velocity                          = mean_velocity_in_step(of_soil ? nodes.soil : nodes.water);
        (of_soil ? tractions.soil : tractions.water) = row.traction;
        double of_momentum                           = 0.;
        Tensor<1, dim> working;
        for (unsigned int i = 0; i < grid.n_nodes_per_cell(); ++i)
          {
            const double weight = rows.weight(k, i);
            // Where both phases are light, a part of the force is of no mass.
            of_momentum += weight / nodes.pores[of_cell[i]][of_soil ? Pores::pressed_soil : Pores::pressed_water];
            working += weight * velocity(of_cell[i]);
          }
        balance.pressure_impulse += // The corrector has booked it there.
            count(row.segment, time_step * row.traction, of_momentum, working, balance);
      }
    for (const unsigned int s : holding)
      {
        const CutFacet<dim> &segment = cut_cells->segments()[s];
        const unsigned int *of_cell  = grid.nodes(segment.cell);
        double of_momentum           = 0.;
        Tensor<1, dim> working;
        for (unsigned int i = 0; i < segment.shapes.size(); ++i)
          if (nodes.has_water(of_cell[i]))
            {
              of_momentum += segment.shapes[i];
              working += segment.shapes[i] * mean_velocity_in_step(nodes.water)(of_cell[i]);
            }
        count(s, of_segments[s].viscous, of_momentum, working, balance);
      }
  }


  template <int dim>
  void CutCellContact<dim>::count_rows(const TractionSolver<dim> &solver, const double time_step, Budget<dim> &balance)
  {
    balance.obstacles.resize(n_obstacles);
    for (OfSegment &segment : of_segments)
      segment.tractions.soil = Tensor<1, dim>();
    for (unsigned int k = 0; k < rows.all.size(); ++k)
      {
        const GroundRow<dim> &row               = rows.all[k];
        of_segments[row.segment].tractions.soil = row.traction;
        count(row.segment, time_step * row.traction, rows.weight_of_row(k), solver.working_flow(rows, k), balance);
      }
  }


  template <int dim>
  Tensor<1, dim> CutCellContact<dim>::count(const unsigned int s,
                                            const Tensor<1, dim> &force,
                                            const double of_momentum,
                                            const Tensor<1, dim> &velocity,
                                            Budget<dim> &balance) const
  {
    if (force.norm_square() == 0.)
      return force;
    const CutFacet<dim> &segment = cut_cells->segments()[s];
    const Tensor<1, dim> given   = of_momentum * force;
    book(segment.part, segment.middle, -given, force * velocity, balance);
    return given;
  }


  template <int dim>
  void CutCellContact<dim>::count_pressure(const Mixture<dim> &mixture,
                                           const PorePressure<dim> &pressure,
                                           const double time_step,
                                           Budget<dim> &balance) const
  {
    if (ground == nullptr || n_obstacles == 0)
      return;
    const TimedPart part(timer, TimerSection::bed);
    for (const MixtureCell<dim> &cell : mixture.cells())
      if (cell.water_volume > 0.)
        for_segments(cell.cell, [&](const unsigned int s) {
          ObstacleBalance<dim> *obstacle = balance_of(cut_cells->segments()[s].part, balance);
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
          obstacle->work += impulse * ground->velocity(segment.part);
        });
  }


  template <int dim>
  MotionSums<dim> CutCellContact<dim>::project_to_boundary(const MovingPoints<dim> &moving,
                                                           const double mass_scaling,
                                                           const double time_step,
                                                           const double largest_speed,
                                                           const std::uint8_t closed_faces,
                                                           Budget<dim> &balance) const
  {
    MotionSums<dim> change;
    if (ground == nullptr)
      return change;
    const TimedPart timed(timer, TimerSection::bed);
    balance.obstacles.resize(n_obstacles);
    const auto stop = [&](const auto &point, const unsigned int part, const Tensor<1, dim> &normal) {
      double *own                   = point.properties + moving.velocity;
      const Tensor<1, dim> velocity = vector_of<dim>(own), relative = velocity - ground->velocity(part);
      const double into = -(relative * normal), mass = point.properties[moving.mass];
      if (into <= 0.)
        return;
      const Tensor<1, dim> along = relative + into * normal;
      const double friction      = moving.phase == Phase::soil ? surfaces[part].friction_coefficient * into : 0.,
                   speed         = along.norm();
      const Tensor<1, dim> given = into * normal - (speed > friction ? friction / speed : 1.) * along;
      for (unsigned int c = 0; c < dim; ++c)
        own[c] += given[c];
      double lost = -mass * (given * (velocity + 0.5 * given));
      if (moving.has_affine_energy)
        {
          double *affine    = point.properties + moving.affine;
          const auto energy = [&] {
            return with_nodes_1d(grid, [&](auto n) {
              return 0.5 * mass *
                     square_of_affine<dim, n, double>(
                         affine, point.reference_location, grid.open_knots(point.cell), grid.cell_size());
            });
          };
          lost += energy();
          for (unsigned int c = 0; c < dim; ++c)
            {
              const double slope = vector_of<dim>(affine + c * dim) * normal;
              for (unsigned int a = 0; a < dim; ++a)
                affine[c * dim + a] -= slope * normal[a];
            }
          lost -= energy();
        }
      book(part, point.location, mass_scaling * mass * given, mass_scaling * lost, balance);
      for (unsigned int c = 0; c < dim; ++c)
        change.momentum[c] += mass * given[c];
      change.kinetic -= lost;
    };
    // Nodes may be faster than points, and shifting moves by a tenth of a cell along each axis.
    const double farthest = 0.25 * grid.cell_size() + 2. * time_step * largest_speed;
    move_out_of_ground<dim>(grid, *ground, farthest, closed_faces, moving.points, stop);
    return change;
  }

  template class CutCellContact<2>;
  template class CutCellContact<3>;
} // namespace scree

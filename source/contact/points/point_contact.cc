// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/particles/point_set.h>
#include <scree/contact/points/point_contact.h>
#include <scree/tensor/vector.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace scree
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned int n_sweeps = 4;

    /// Overlap, cells, from which on a contact follows the rise of the interpolated distance.
    constexpr double overlap_with_full_rise = 0.08;

    /// Of a node by its values, m^2/s^2; 0 without soil.
    template <int dim>
    double square_of_speed(const double *values)
    {
      return values[NodalField<dim>::mass] > 0. ? vector_of<dim>(values + NodalField<dim>::velocity).norm_square() : 0.;
    }
  } // namespace


  template <int dim>
  PointContact<dim>::PointContact(const BackgroundGrid<dim> &grid,
                                  const Constraints<dim> &constraints,
                                  const std::vector<RigidSurface<dim>> &surfaces,
                                  const BodyForces<dim> &forces,
                                  std::list<SoilBody<dim>> &bodies,
                                  const unsigned int group,
                                  TimerOutput &timer)
      : grid(grid)
      , constraints(constraints)
      , surfaces(surfaces)
      , n_obstacles(
            std::count_if(surfaces.begin(), surfaces.end(), [](const auto &s) { return s.obstacle != nullptr; }))
      , slack(0.01 * grid.cell_size())
      , most_speed(0.03 * std::sqrt(forces.fall().norm() * grid.cell_size()))
      , mass_scaling(forces.mass_scaling())
      , bodies(bodies)
      , group(group)
      , timer(timer)
      , nodes(grid, constraints)
      , exchange(grid, nodes)
  {
  }


  template <int dim>
  void PointContact<dim>::reinit()
  {
    if (surfaces.empty())
      return;
    nodes.reinit();
    exchange.reinit();
  }


  template <int dim>
  double PointContact<dim>::least_approach(const double gap, const double dt) const
  {
    if (gap > slack)
      return -(gap - slack) / dt;
    if (gap >= -slack)
      return 0.;
    // Overlap is undone slowly: what is pushed out at once gains energy.
    return std::min(0.1 * (-gap - slack) / dt, most_speed);
  }


  template <int dim>
  void PointContact<dim>::add_contact(const SoilBody<dim> &body,
                                      const Candidate &candidate,
                                      const PointView<dim, double> &point,
                                      const double dt)
  {
    const RigidSurface<dim> &surface = surfaces[candidate.surface];
    // A point that keeps to the normal of its place leaves a curved surface, or gets below it, by v^2 dt^2 / (2 R) a
    // step; with that of half its way in the step it keeps its distance.
    const Tensor<1, dim> slip = vector_of<dim>(point.properties + PropertyLayout<dim>::velocity) - surface.velocity;
    const SurfaceView<dim> half_way =
        surface.samples->view(point.cell, point.reference_location + 0.5 * dt / grid.cell_size() * slip);
    const Tensor<1, dim> &normal = half_way.normal;
    // Distances and normals are interpolated separately, so that the distance also changes by motion across the normal,
    // m/s. At once, that would throw up what slides over ground that is rough within a cell; ignored, it would press it
    // deep into the ground.
    const double rise    = slip * normal - 2. / dt * (half_way.distance - candidate.distance);
    const double overlap = std::clamp((-candidate.gap - slack) / (overlap_with_full_rise * grid.cell_size()), 0., 1.);
    const double depth   = std::clamp(candidate.distance, 0., body.spacing);
    contacts.emplace_back();
    Contact &contact         = contacts.back();
    contact.force            = point.properties + body.layout.contact_force(candidate.surface);
    contact.surface          = candidate.surface;
    contact.friction         = surface.friction_coefficient;
    contact.place            = point.reference_location;
    contact.to_foot          = -depth / grid.cell_size() * normal;
    contact.foot             = point.location - depth * normal;
    contact.normal           = to_row<dim>(normal);
    contact.surface_velocity = to_row<dim>(surface.velocity);
    contact.approach         = least_approach(candidate.gap, dt) + overlap * rise;
    const Tensor<1, dim> J   = dt * vector_of<dim>(contact.force);
    const double across      = J * normal;
    contact.normal_impulse   = std::max(0., across);
    contact.tangent_impulse  = to_row<dim>(
        coulomb_friction<dim>(J - across * normal, available_friction(contact.friction, contact.normal_impulse))
            .impulse);
  }


  template <int dim>
  void PointContact<dim>::cut_cell(SoilBody<dim> &body, const CellPoints<dim> &points, const NodalField<dim> &field)
  {
    const unsigned int cell = points.cell;
    const auto &place       = grid.fine_cells().cells()[grid.fine_cells().of_index(cell)].place;
    unsigned int colour     = 0;
    for (unsigned int a = dim; a-- > 0;)
      colour = colours_1d * colour + place[a] % colours_1d;
    Cell entry{};
    entry.costs                 = &body.points.costs();
    entry.number                = cell;
    entry.n_points              = points.n_points;
    entry.part                  = 2 * colour;
    entry.first                 = contacts.size();
    entry.n                     = candidates.size();
    entry.nodes                 = nodes_of_cells.size();
    entry.most_mobility         = 2. / (mass_scaling * body.density * Utilities::fixed_power<dim>(grid.cell_size()));
    const unsigned int *of_cell = grid.nodes(cell);
    for (unsigned int i = 0; i < grid.n_nodes_per_cell(); ++i)
      {
        const unsigned int number = nodes.add(of_cell[i], field);
        nodes_of_cells.push_back(number);
        nodes.add_turn(number, colour);
        entry.is_held = entry.is_held || nodes.is_held(number);
      }
    cells.push_back(entry);
  }


  template <int dim>
  double PointContact<dim>::margin(const double speed, const RigidSurface<dim> &surface, const double dt) const
  {
    return slack + 1.5 * (speed + surface.velocity.norm()) * dt;
  }


  template <int dim>
  double PointContact<dim>::fastest_node(const NodalField<dim> &field) const
  {
    double square = 0.;
    for (const unsigned int node : field.active_nodes())
      square = std::max(square, square_of_speed<dim>(field[node]));
    for (unsigned int ghost = grid.n_owned_nodes(); ghost < grid.numbering().n_local(); ++ghost)
      square = std::max(square, square_of_speed<dim>(field[ghost]));
    return std::sqrt(square);
  }


  template <int dim>
  double PointContact<dim>::fastest_node(const NodalField<dim> &field, const unsigned int cell) const
  {
    double square             = 0.;
    const unsigned int *nodes = grid.nodes(cell);
    for (unsigned int i = 0; i < grid.n_nodes_per_cell(); ++i)
      square = std::max(square, square_of_speed<dim>(field[nodes[i]]));
    return std::sqrt(square);
  }


  template <int dim>
  void PointContact<dim>::find_near_surfaces(const SoilBody<dim> &body,
                                             const CellPoints<dim> &points,
                                             const double fastest,
                                             const double dt)
  {
    near.clear();
    for (unsigned int s = 0; s < surfaces.size(); ++s)
      {
        const RigidSurface<dim> &surface = surfaces[s];
        if (!surface.samples->is_near(points.cell))
          continue;
        const double of_surface = margin(fastest, surface, dt);
        if (surface.samples->least_distance(points.cell) <= body.spacing + of_surface)
          near.push_back({ s, of_surface });
        else if (surface.obstacle && surface.obstacle->is_moving)
          for_each_point(points, [&](const auto &point) { // It may have gone away from points that touched it.
            std::fill_n(point.properties + body.layout.contact_force(s), dim, 0.);
          });
      }
  }


  template <int dim>
  void PointContact<dim>::find_candidates(const SoilBody<dim> &body, const CellPoints<dim> &points)
  {
    candidates.clear();
    for_each_batch(points.n_points, [&](const BatchIndices &indices, const unsigned int n) {
      const BatchPointers<dim> pointers(points, indices);
      std::array<Batch, dim> places;
      simd::load_records<dim>(pointers.places, places.data());
      constexpr double irrational[3] = { 1., 0.7548776662466927, 0.5698402909980532 };
      Batch orders                   = irrational[0] * places[0];
      for (unsigned int a = 1; a < dim; ++a)
        orders += irrational[a] * places[a];
      for (const Near &one : near)
        {
          const DiscreteLevelSet<dim> &samples = *surfaces[one.surface].samples;
          const unsigned int touching          = body.layout.touching_distance(one.surface);
          Batch touching_distances;
          for (unsigned int l = 0; l < batch_size; ++l)
            touching_distances[l] = pointers.properties[l][touching];
          const Batch distances = samples.distances(points.cell, places), gaps = distances - touching_distances;
          const unsigned int far = simd::bits_of(gaps > one.margin);
          for (unsigned int l = 0; l < n; ++l)
            {
              if (far >> l & 1)
                {
                  std::fill_n(pointers.properties[l] + body.layout.contact_force(one.surface), dim, 0.);
                  continue;
                }
              const Candidate candidate{ orders[l], indices[l], one.surface, distances[l], gaps[l] };
              unsigned int place = candidates.size();
              candidates.emplace_back();
              for (; place > 0 && candidates[place - 1].order > candidate.order; --place)
                candidates[place] = candidates[place - 1];
              candidates[place] = candidate;
            }
        }
    });
  }


  template <int dim>
  void PointContact<dim>::add_cell(SoilBody<dim> &body,
                                   const CellPoints<dim> &points,
                                   const NodalField<dim> &field,
                                   const double dt)
  {
    find_near_surfaces(body, points, fastest_node(field, points.cell), dt);
    if (near.empty())
      return;
    find_candidates(body, points);
    if (candidates.empty())
      return;
    cut_cell(body, points, field);
    for (const Candidate &candidate : candidates)
      {
        const unsigned int p = candidate.point;
        add_contact(body,
                    candidate,
                    { points.cell, points.properties_of(p), points.location_of(p), points.reference_location_of(p) },
                    dt);
      }
  }


  template <int dim>
  void PointContact<dim>::find_contacts(const NodalField<dim> &field, const double time_step)
  {
    nodes.begin();
    cells.clear();
    nodes_of_cells.clear();
    contacts.clear();
    for (RigidSurface<dim> &surface : surfaces)
      if (surface.obstacle)
        surface.velocity = surface.obstacle->velocity();
    // Most cells near a surface are farther away than any node moves in the step.
    const double all_fastest = fastest_node(field);
    const auto may_touch     = [&](const SoilBody<dim> &body, const unsigned int cell) {
      for (const RigidSurface<dim> &surface : surfaces)
        if (surface.obstacle && surface.obstacle->is_moving
                    ? surface.samples->is_near(cell)
                    : surface.samples->least_distance(cell) <= body.spacing + margin(all_fastest, surface, time_step))
          return true;
      return false;
    };
    for (auto &body : bodies)
      if (body.group == group && !body.is_rigid)
        for (const auto &cell : body.points.cells())
          if (may_touch(body, cell.cell))
            add_cell(body, cell, field, time_step);
  }


  template <int dim>
  void PointContact<dim>::order_cells()
  {
    constexpr unsigned int n_parts = 2 * n_colours;
    first_of_part.assign(n_parts + 1, 0);
    for (Cell &cell : cells)
      {
        const auto first = nodes_of_cells.begin() + cell.nodes;
        cell.part += std::none_of(first, first + grid.n_nodes_per_cell(), [this](const unsigned int node) {
          return exchange.is_shared(node);
        });
        ++first_of_part[cell.part + 1];
      }
    for (unsigned int c = 0; c < n_parts; ++c)
      first_of_part[c + 1] += first_of_part[c];
    // Cells of two bodies may be the same one: those of a part stay in order.
    std::array<unsigned int, n_parts> next;
    std::copy_n(first_of_part.begin(), n_parts, next.begin());
    sequence.resize(cells.size());
    for (unsigned int b = 0; b < cells.size(); ++b)
      sequence[next[cells[b].part]++] = b;
  }


  template <int dim>
  void PointContact<dim>::add_costs(const double seconds)
  {
    for (const Cell &cell : cells)
      cell.costs->add_contacts(cell.number, cell.n_points, seconds * cell.n / contacts.size());
  }


  template <int dim>
  template <int n>
  void PointContact<dim>::solve(NodalField<dim> &field, const double time_step, Budget<dim> &balance)
  {
    const bool is_timed     = std::any_of(bodies.begin(), bodies.end(), [this](const auto &body) {
      return body.group == group && !body.is_rigid && body.points.costs().is_due();
    });
    const double start_time = is_timed ? thread_time() : 0.;
    double waited           = 0.;
    balance.obstacles.resize(n_obstacles);
    find_contacts(field, time_step);
    start<n>();
    exchange.begin(field, n_colours, n_sweeps, is_timed ? &waited : nullptr);
    order_cells();
    for (unsigned int s = 0; s < n_sweeps; ++s)
      sweep<n>(s);
    exchange.finish();
    nodes.write(field, balance);
    nodes.take_working_velocities(field);
    finish<n>(time_step, balance);
    if (is_timed)
      add_costs(thread_time() - start_time - waited);
  }


  template <int dim>
  void PointContact<dim>::solve(NodalField<dim> &field, const double time_step, Budget<dim> &balance)
  {
    if (surfaces.empty())
      return;
    const TimedPart part(timer, TimerSection::bed);
    if (grid.n_nodes_1d() == 2)
      solve<2>(field, time_step, balance);
    else
      solve<3>(field, time_step, balance);
  }

  template class PointContact<2>;
  template class PointContact<3>;
} // namespace scree

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/scheme/bed_projection.h>
#include <scree/tensor/vector.h>

#include <deal.II/base/geometry_info.h>
#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace scree
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    using Field = NodalField<dim>;

    /// Unit vectors along a surface.
    std::array<Tensor<1, 2>, 1> tangents(const Tensor<1, 2> &normal)
    {
      return { { cross_product_2d(normal) } };
    }
    std::array<Tensor<1, 3>, 2> tangents(const Tensor<1, 3> &normal)
    {
      unsigned int least = 0;
      for (unsigned int a = 1; a < 3; ++a)
        if (std::abs(normal[a]) < std::abs(normal[least]))
          least = a;
      Tensor<1, 3> axis;
      axis[least]              = 1.;
      const Tensor<1, 3> along = cross_product_3d(normal, axis), first = along / along.norm();
      return { { first, cross_product_3d(normal, first) } };
    }
  } // namespace


  template <int dim>
  BedProjection<dim>::BedProjection(const BackgroundGrid<dim> &grid,
                                    const RigidGround<dim> &ground,
                                    const std::vector<RigidSurface<dim>> &surfaces,
                                    const OpenCells<dim> &open_cells,
                                    const double relative_tolerance)
      : grid(grid)
      , ground(ground)
      , surfaces(surfaces)
      , n_obstacles(
            std::count_if(surfaces.begin(), surfaces.end(), [](const auto &s) { return s.obstacle != nullptr; }))
      , open_cells(open_cells)
      , relative_tolerance(relative_tolerance)
      , ground_response(grid, open_cells)
      , any_holds_water(
            std::any_of(surfaces.begin(), surfaces.end(), [](const auto &surface) { return surface.holds_water; }))
  {
    reinit();
  }


  template <int dim>
  unsigned int BedProjection<dim>::find_surface(const GroundSegment<dim> &segment, const Point<dim> &middle) const
  {
    const GroundPart<dim> &part = ground.parts()[segment.part];
    unsigned int number         = 0;
    double nearest              = std::numeric_limits<double>::infinity();
    for (unsigned int i = 0; i < surfaces.size(); ++i)
      {
        const RigidSurface<dim> &surface = surfaces[i];
        if (surface.samples == part.samples)
          return i;
        if (!(surface.obstacle && surface.obstacle->is_moving) && surface.samples->is_near(segment.cell))
          if (const double distance = surface.samples->view(segment.cell, middle).distance; distance < nearest)
            {
              nearest = distance;
              number  = i;
            }
      }
    return number;
  }


  template <int dim>
  void BedProjection<dim>::find_surfaces()
  {
    const auto &segments       = open_cells.segments();
    const FineCells<dim> &fine = grid.fine_cells();
    surface_numbers.resize(segments.size());
    middles.resize(segments.size());
    for (unsigned int s = 0; s < segments.size(); ++s)
      {
        Point<dim> middle; // in the unit cell
        for (unsigned int v = 0; v < CutCell<dim>::n_corners; ++v)
          middle += segments[s].ground_hats[v] * GeometryInfo<dim>::unit_cell_vertex(v);
        middles[s] = fine.box().corner(fine.cells()[fine.of_index(segments[s].cell)].place) + grid.cell_size() * middle;
        surface_numbers[s] = find_surface(segments[s], middle);
      }
  }


  template <int dim>
  void BedProjection<dim>::reinit()
  {
    ground_response.reinit();
    of_segments.assign(open_cells.segments().size(), Impulses()); // The next step begins its search from nothing.
    find_surfaces();
  }


  template <int dim>
  void BedProjection<dim>::follow()
  {
    const std::vector<unsigned int> &numbers = open_cells.numbers_before();
    std::vector<Impulses> now(numbers.size());
    for (unsigned int s = 0; s < numbers.size(); ++s)
      if (numbers[s] != open_cells.none)
        now[s] = of_segments[numbers[s]];
    of_segments = std::move(now);
    find_surfaces();
  }


  template <int dim>
  ObstacleBalance<dim> *BedProjection<dim>::balance_of(const unsigned int segment, StepBalance<dim> &balance) const
  {
    const unsigned int first = surfaces.size() - n_obstacles;
    return surface_numbers[segment] < first ? nullptr : &balance.obstacles[surface_numbers[segment] - first];
  }


  template <int dim>
  double BedProjection<dim>::sum(const double value) const
  {
    return Utilities::MPI::sum(value, grid.triangulation().get_communicator());
  }


  template <int dim>
  double BedProjection<dim>::max(const double value) const
  {
    return Utilities::MPI::max(value, grid.triangulation().get_communicator());
  }


  template <int dim>
  Tensor<1, dim> BedProjection<dim>::mean_velocity(const GroundSegment<dim> &segment,
                                                   const NodalField<dim> &field) const
  {
    const unsigned int *nodes = grid.nodes(segment.cell);
    Tensor<1, dim> velocity;
    for (unsigned int i = 0; i < segment.shapes.size(); ++i)
      velocity += segment.shapes[i] * vector_of<dim>(field[nodes[i]] + Field<dim>::velocity);
    return velocity;
  }


  template <int dim>
  double BedProjection<dim>::mobility_at(const GroundSegment<dim> &segment,
                                         const Phase phase,
                                         const MixtureNodes<dim> &nodes) const
  {
    // Without walls: ranks that do not own a node know its masses only.
    double mobility = 0.;
    for (unsigned int i = 0; i < segment.shapes.size(); ++i)
      {
        const unsigned int node    = grid.nodes(segment.cell)[i];
        const DragMobility of_node = drag_mobility(nodes.soil[node][Field<dim>::mass],
                                                   nodes.water[node][Field<dim>::mass],
                                                   nodes.pores[node][PoreField<dim>::drag]);
        mobility += segment.shapes[i] * segment.shapes[i] * (phase == Phase::soil ? of_node.soil : of_node.water);
      }
    return mobility;
  }


  template <int dim>
  void BedProjection<dim>::add_contact(const unsigned int segment,
                                       const Phase phase,
                                       const bool is_unilateral,
                                       const MixtureNodes<dim> &nodes)
  {
    const GroundSegment<dim> &of_ground = open_cells.segments()[segment];
    const NodalField<dim> &field        = phase == Phase::soil ? nodes.soil : nodes.water;
    const Tensor<1, dim> beside_ground  = mean_velocity(of_ground, field) - open_cells.velocity(of_ground);
    Contact contact{};
    contact.segment       = segment;
    contact.phase         = phase;
    contact.is_unilateral = is_unilateral;
    contact.rubs          = phase == Phase::soil && surface_of(segment).friction_coefficient > 0.;
    contact.first_row     = rows.size();
    const bool sticks     = phase == Phase::water && std::binary_search(holding.begin(), holding.end(), segment);
    contact.n_rows        = contact.rubs || sticks ? dim : 1;
    contacts.push_back(contact);
    const auto along      = tangents(of_ground.normal);
    const double mobility = mobility_at(of_ground, phase, nodes);
    for (unsigned int r = 0; r < contact.n_rows; ++r)
      {
        Row row;
        row.contact   = contacts.size() - 1;
        row.area      = of_ground.area;
        row.direction = r == 0 ? of_ground.normal : along[r - 1];
        row.mobility  = mobility;
        row.speed     = row.direction * beside_ground;
        rows.push_back(row);
      }
    // Unilateral soil that neither presses nor comes near is left alone.
    const Impulses &before = of_segments[segment];
    if (is_unilateral && rows[contact.first_row].speed <= 0. &&
        !((phase == Phase::soil ? before.soil : before.water) * of_ground.normal > 0.))
      {
        contacts.pop_back();
        rows.resize(contact.first_row);
        return;
      }
    ground_response.add(segment, phase);
  }


  template <int dim>
  const std::vector<Tensor<1, dim>> &BedProjection<dim>::by_contacts(const std::vector<double> &of_rows)
  {
    of_contacts.resize(contacts.size());
    for (unsigned int k = 0; k < contacts.size(); ++k)
      {
        of_contacts[k] = Tensor<1, dim>();
        for (unsigned int r = contacts[k].first_row; r < contacts[k].first_row + contacts[k].n_rows; ++r)
          of_contacts[k] += of_rows[r] * rows[r].direction;
      }
    return of_contacts;
  }


  template <int dim>
  void BedProjection<dim>::respond(const std::vector<double> &of_rows)
  {
    ground_response.apply(by_contacts(of_rows), velocities);
    response.resize(rows.size());
    for (unsigned int k = 0; k < rows.size(); ++k)
      response[k] = rows[k].direction * velocities[rows[k].contact];
  }


  template <int dim>
  void BedProjection<dim>::iterate()
  {
    constexpr unsigned int most_iterations = 100;
    const unsigned int n                   = rows.size();
    const auto scaled                      = [&](const unsigned int k) {
      return rows[k].is_free && rows[k].mobility > 0. ? residual[k] / rows[k].mobility : 0.;
    };
    double own_product = 0., own_square = 0.;
    const auto judge = [&] { // product of the residual with itself, scaled; its square over the ground
      own_product = own_square = 0.;
      for (unsigned int k = 0; k < n; ++k)
        if (rows[k].is_free && rows[k].mobility > 0.)
          {
            own_product += residual[k] * scaled(k);
            own_square += rows[k].area * residual[k] * residual[k];
          }
    };
    judge();
    double product = sum(own_product);
    direction.resize(n);
    for (unsigned int k = 0; k < n; ++k)
      direction[k] = scaled(k);
    for (unsigned int i = 0; i < most_iterations && sum(own_square) > tolerance * tolerance; ++i)
      {
        respond(direction);
        double curvature = 0.;
        for (unsigned int k = 0; k < n; ++k)
          curvature += direction[k] * response[k];
        curvature = sum(curvature);
        if (!(curvature > 0.))
          break; // Walls hold what is left.
        const double length = product / curvature;
        for (unsigned int k = 0; k < n; ++k)
          {
            rows[k].impulse += length * direction[k];
            residual[k] -= length * response[k];
          }
        judge();
        const double next = sum(own_product);
        for (unsigned int k = 0; k < n; ++k)
          direction[k] = scaled(k) + next / product * direction[k];
        product = next;
      }
  }


  template <int dim>
  bool BedProjection<dim>::find_states()
  {
    bool changed   = false;
    const auto set = [&](Row &row, const double impulse) {
      changed     = changed || std::abs(impulse - row.impulse) * row.mobility * std::sqrt(row.area) > tolerance;
      row.impulse = impulse;
    };
    for (Contact &contact : contacts)
      {
        if (!contact.is_unilateral || contact.is_off)
          continue;
        Row *of_contact = &rows[contact.first_row];
        if (of_contact[0].impulse + contact.base[0] <= 0.)
          {
            contact.is_off = true;
            for (unsigned int r = 0; r < contact.n_rows; ++r)
              {
                set(of_contact[r], -contact.base[r]);
                of_contact[r].is_free = false;
              }
            continue;
          }
        if (!contact.rubs)
          continue;
        Tensor<1, dim> needed; // along the ground
        for (unsigned int r = 1; r < contact.n_rows; ++r)
          needed[r] = of_contact[r].impulse + contact.base[r];
        const double available = available_friction(surface_of(contact.segment).friction_coefficient,
                                                    of_contact[0].impulse + contact.base[0]);
        if (!contact.slides && needed.norm() <= available)
          continue;
        contact.slides    = true;
        const double size = needed.norm();
        for (unsigned int r = 1; r < contact.n_rows; ++r)
          {
            set(of_contact[r], (size > 0. ? available / size * needed[r] : 0.) - contact.base[r]);
            of_contact[r].is_free = false;
          }
      }
    return max(double(changed)) > 0.;
  }


  template <int dim>
  void BedProjection<dim>::project(const MixtureNodes<dim> &nodes,
                                   const MixtureStep<dim> &step,
                                   const double wanted,
                                   StepBalance<dim> &balance)
  {
    constexpr unsigned int most_passes = 8;
    double own_square                  = 0.;
    for (const Row &row : rows)
      own_square += row.area * row.speed * row.speed;
    largest_flow = std::max(largest_flow, std::sqrt(sum(own_square)));
    tolerance    = wanted * largest_flow;
    if (tolerance == 0.)
      return;
    ground_response.start(nodes, step);

    std::vector<double> of_rows(rows.size());
    for (unsigned int pass = 0; pass < most_passes; ++pass)
      {
        for (unsigned int k = 0; k < rows.size(); ++k)
          of_rows[k] = rows[k].impulse;
        respond(of_rows);
        residual.resize(rows.size());
        for (unsigned int k = 0; k < rows.size(); ++k)
          residual[k] = rows[k].speed - response[k];
        iterate();
        if (!find_states())
          break;
      }

    for (unsigned int k = 0; k < rows.size(); ++k)
      {
        of_rows[k]             = rows[k].impulse;
        const Contact &contact = contacts[rows[k].contact];
        Impulses &given        = of_segments[contact.segment];
        (contact.phase == Phase::soil ? given.soil : given.water) += rows[k].impulse * rows[k].direction;
      }
    ground_response.take(by_contacts(of_rows), nodes, step, balance);
  }


  template <int dim>
  void BedProjection<dim>::begin_step(const Mixture<dim> &mixture, const FreeSurfaceLocator<dim> &surface)
  {
    for (Impulses &segment : of_segments)
      segment.soil = segment.water = Tensor<1, dim>();
    if (!any_holds_water)
      return;
    holding.clear();
    // Water in pores is stopped by the grains, and what goes through them does not feel the ground a cell away.
    for (const MixtureCell<dim> &cell : mixture.cells())
      if (cell.water_volume > 0. && cell.soil_mass <= 0. && surface.has_unknown(cell.cell))
        for_segments(cell.cell, [&](const unsigned int segment) {
          if (surface_of(segment).holds_water)
            holding.push_back(segment);
        });
    std::sort(holding.begin(), holding.end());
  }


  template <int dim>
  Tensor<1, dim> BedProjection<dim>::viscous_force(const unsigned int s,
                                                   const NodalField<dim> &motion,
                                                   const double ground_share,
                                                   const double viscosity) const
  {
    constexpr double slip_length      = 0.01; // cells
    const GroundSegment<dim> &segment = open_cells.segments()[s];
    const Tensor<1, dim> velocity     = mean_velocity(segment, motion) - ground_share * open_cells.velocity(segment);
    return -viscosity * segment.area / (slip_length * grid.cell_size()) * velocity;
  }


  template <int dim>
  void BedProjection<dim>::add_viscous_force(const NodalField<dim> &motion,
                                             const double ground_share,
                                             const double viscosity,
                                             NodalField<dim> &force) const
  {
    for (const unsigned int s : holding)
      {
        const GroundSegment<dim> &segment = open_cells.segments()[s];
        const Tensor<1, dim> of_segment   = viscous_force(s, motion, ground_share, viscosity);
        const unsigned int *nodes         = grid.nodes(segment.cell);
        for (unsigned int i = 0; i < segment.shapes.size(); ++i)
          for (unsigned int c = 0; c < dim; ++c)
            force[nodes[i]][Field<dim>::force + c] += segment.shapes[i] * of_segment[c];
      }
  }


  template <int dim>
  void
  BedProjection<dim>::take_viscous_force(const NodalField<dim> &motion, const double viscosity, const double time_step)
  {
    for (const unsigned int s : holding)
      of_segments[s].water -= time_step * viscous_force(s, motion, 1., viscosity);
  }


  template <int dim>
  void BedProjection<dim>::predict(const MixtureNodes<dim> &nodes,
                                   const Mixture<dim> &mixture,
                                   const MixtureStep<dim> &step,
                                   const double time_step,
                                   StepBalance<dim> &balance)
  {
    ground_response.clear();
    contacts.clear();
    rows.clear();
    largest_flow = 0.;
    for (const MixtureCell<dim> &cell : mixture.cells())
      if (cell.soil_mass > 0. && !cell.is_rigid)
        for_segments(cell.cell,
                     [&](const unsigned int segment) { add_contact(segment, Phase::soil, !is_fixed(segment), nodes); });
    for (Row &row : rows)
      row.impulse = time_step * (of_segments[contacts[row.contact].segment].force * row.direction);
    project(nodes, step, relative_tolerance, balance);
    for (Impulses &segment : of_segments)
      segment.force = segment.soil / time_step;
  }


  template <int dim>
  void BedProjection<dim>::correct(const MixtureNodes<dim> &nodes,
                                   const Mixture<dim> &mixture,
                                   const MixtureStep<dim> &step,
                                   const FreeSurfaceLocator<dim> &surface,
                                   StepBalance<dim> &balance)
  {
    ground_response.clear();
    contacts.clear();
    rows.clear();
    for (const MixtureCell<dim> &cell : mixture.cells())
      for_segments(cell.cell, [&](const unsigned int segment) {
        if (cell.soil_mass > 0. && !cell.is_rigid)
          add_contact(segment, Phase::soil, !is_fixed(segment), nodes);
        if (cell.water_volume > 0.)
          add_contact(segment, Phase::water, !surface.has_unknown(cell.cell), nodes);
      });
    for (Contact &contact : contacts)
      if (contact.phase == Phase::soil)
        for (unsigned int r = 0; r < contact.n_rows; ++r)
          contact.base[r] = of_segments[contact.segment].soil * rows[contact.first_row + r].direction;
    constexpr double coarser = 10.; // the next predictor finds what is left; nothing at rest or in motion is worse
    project(nodes, step, coarser * relative_tolerance, balance);
  }


  template <int dim>
  void BedProjection<dim>::count(const MixtureNodes<dim> &nodes, StepBalance<dim> &balance) const
  {
    // The work of an impulse is its product with the mean velocity.
    const auto mean = [](const double *values) {
      return vector_of<dim>(values + Field<dim>::velocity) - 0.5 * vector_of<dim>(values + Field<dim>::velocity_change);
    };
    balance.obstacles.resize(n_obstacles);
    for (unsigned int s = 0; s < of_segments.size(); ++s)
      {
        const Impulses &taken = of_segments[s];
        if (taken.soil.norm_square() + taken.water.norm_square() == 0.)
          continue;
        const GroundSegment<dim> &segment = open_cells.segments()[s];
        Tensor<1, dim> impulse;
        double dissipation = 0.;
        for (unsigned int i = 0; i < segment.shapes.size(); ++i)
          {
            const unsigned int node = grid.nodes(segment.cell)[i];
            const auto add          = [&](const double *values, const Tensor<1, dim> &of_phase) {
              if (values[Field<dim>::mass] <= 0.)
                return;
              impulse -= segment.shapes[i] * of_phase;
              dissipation += segment.shapes[i] * of_phase * mean(values);
            };
            add(nodes.soil[node], taken.soil);
            add(nodes.water[node], taken.water);
          }
        if (ObstacleBalance<dim> *obstacle = balance_of(s, balance))
          {
            const double work = impulse * open_cells.velocity(segment);
            obstacle->impulse += impulse;
            obstacle->add_moment(middles[s] - surface_of(s).obstacle->pivot, impulse);
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
  void BedProjection<dim>::count_pressure(const Mixture<dim> &mixture,
                                          const PorePressure<dim> &pressure,
                                          const double time_step,
                                          StepBalance<dim> &balance) const
  {
    if (n_obstacles == 0)
      return;
    for (const MixtureCell<dim> &cell : mixture.cells())
      if (cell.water_volume > 0.)
        for_segments(cell.cell, [&](const unsigned int s) {
          ObstacleBalance<dim> *obstacle = balance_of(s, balance);
          if (obstacle == nullptr)
            return;
          const GroundSegment<dim> &segment = open_cells.segments()[s];
          const auto corners                = pressure.pressure_of(cell.cell);
          double mean                       = 0.;
          for (unsigned int v = 0; v < corners.size(); ++v)
            mean += segment.ground_hats[v] * corners[v];
          const Tensor<1, dim> impulse = -time_step * std::max(mean, 0.) * segment.area * segment.normal;
          obstacle->pressure_impulse += impulse;
          obstacle->add_moment(middles[s] - surface_of(s).obstacle->pivot, impulse);
          obstacle->work += impulse * open_cells.velocity(segment);
        });
  }


  template <int dim>
  void BedProjection<dim>::put_back(PointSet<dim> &points) const
  {
    const double width         = grid.cell_size();
    const double inside        = 1e-6 * width; // where points are put
    const FineCells<dim> &fine = grid.fine_cells();
    for (const auto &cell : points.cells())
      {
        if (ground.least_distance(cell.cell) > width) // no point moves farther in a step
          continue;
        const Point<dim> lower = fine.box().corner(fine.cells()[fine.of_index(cell.cell)].place);
        for_each_point(cell, [&](const auto &point) {
          const SurfaceView<dim> view = ground.view(point.cell, Point<dim>((point.location - lower) / width));
          if (view.distance < 0.)
            point.location += (inside - view.distance) * view.normal;
        });
      }
  }

  template class BedProjection<2>;
  template class BedProjection<3>;
} // namespace scree

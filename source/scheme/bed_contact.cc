// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/scheme/bed_contact.h>
#include <scree/scheme/contact_row.h>
#include <scree/tensor/vector.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace scree
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned int n_sweeps = 4;

    /// Cells as far apart along an axis share no nodes.
    constexpr unsigned int colours_1d = 3;
  } // namespace


  template <int dim>
  BedContact<dim>::BedContact(const BackgroundGrid<dim> &grid,
                              const Constraints<dim> &constraints,
                              const std::vector<RigidSurface<dim>> &surfaces,
                              const double gravity,
                              std::list<SoilBody<dim>> &bodies,
                              const unsigned int group)
      : grid(grid)
      , constraints(constraints)
      , surfaces(surfaces)
      , n_obstacles(
            std::count_if(surfaces.begin(), surfaces.end(), [](const auto &s) { return s.obstacle != nullptr; }))
      , slack(0.01 * grid.cell_size())
      , most_speed(0.03 * std::sqrt(gravity * grid.cell_size()))
      , bodies(bodies)
      , group(group)
      , nodes(grid, constraints)
  {
  }


  template <int dim>
  void BedContact<dim>::reinit()
  {
    nodes.reinit();
  }


  template <int dim>
  double BedContact<dim>::fastest(const double time) const
  {
    double speed = 0.;
    for (const RigidSurface<dim> &surface : surfaces)
      if (surface.obstacle)
        speed = std::max(speed, surface.obstacle->velocity_at(time).norm());
    return speed;
  }


  template <int dim>
  double BedContact<dim>::least_approach(const double gap, const double dt) const
  {
    if (gap > slack)
      return -(gap - slack) / dt;
    if (gap >= -slack)
      return 0.;
    // Overlap is undone slowly: what is pushed out at once gains energy.
    return std::min(0.1 * (-gap - slack) / dt, most_speed);
  }


  template <int dim>
  template <int n>
  void BedContact<dim>::add_contact(const SoilBody<dim> &body,
                                    const unsigned int surface,
                                    const PointView<dim, double> &point,
                                    const SurfaceView<dim> &view,
                                    const double dt)
  {
    using Row        = ContactRow<dim, n>;
    const Cell &cell = cells.back();
    typename Row::OfNodes inverse_masses;
    for (unsigned int i = 0; i < Row::n_nodes; ++i)
      inverse_masses[i] = nodes[nodes_of_cells[cell.nodes + i]].inverse_mass;
    const double width         = grid.cell_size();
    const double depth         = std::clamp(view.distance, 0., body.spacing);
    const double most_mobility = 2. / (body.density * Utilities::fixed_power<dim>(width));
    const Row row(point.reference_location,
                  -depth / width * view.normal,
                  grid.open_knots(cell.number),
                  inverse_masses,
                  most_mobility);

    Contact contact;
    contact.force    = point.properties + body.layout.contact_force(surface);
    contact.surface  = surface;
    contact.friction = surfaces[surface].friction_at(point.location);
    contact.normal   = view.normal;
    contact.approach = least_approach(view.distance - point.properties[body.layout.touching_distance(surface)], dt);
    contact.inertia  = row.mobility > 0. ? 1. / row.mobility : 0.;
    const Tensor<1, dim> J = dt * vector_of<dim>(contact.force);
    const double normal    = J * view.normal;
    contact.normal_impulse = std::max(0., normal);
    contact.tangent_impulse =
        coulomb_friction<dim>(J - normal * view.normal, contact.available(contact.normal_impulse)).impulse;
    constexpr double irrational[3] = { 1., 0.7548776662466927, 0.5698402909980532 };
    contact.order                  = 0.;
    for (unsigned int a = 0; a < dim; ++a)
      contact.order += irrational[a] * point.reference_location[a];

    // In order among the cell's contacts.
    unsigned int place = contacts.size();
    while (place > cell.first && contacts[place - 1].order > contact.order)
      --place;
    contacts.insert(contacts.begin() + place, contact);
    if (n_obstacles > 0)
      feet.insert(feet.begin() + place, point.location - depth * view.normal);
    constexpr unsigned int n_doubles = OfCell<dim, n>::n_doubles;
    rows.insert(rows.begin() + std::size_t(place) * n_doubles, n_doubles, 0.);
    std::copy(row.shape.begin(), row.shape.end(), rows.begin() + std::size_t(place) * n_doubles);
    ++cells.back().n;
  }


  template <int dim>
  void BedContact<dim>::open_cell(const unsigned int cell, const NodalField<dim> &field)
  {
    const auto &place   = grid.fine_cells().cells()[grid.fine_cells().of_index(cell)].place;
    unsigned int colour = 0;
    for (unsigned int a = dim; a-- > 0;)
      colour = colours_1d * colour + place[a] % colours_1d;
    Cell entry{};
    entry.number = cell;
    entry.colour = colour;
    entry.first  = contacts.size();
    entry.nodes  = nodes_of_cells.size();
    for (unsigned int i = 0; i < grid.n_nodes_per_cell(); ++i)
      {
        nodes_of_cells.push_back(nodes.add(grid.nodes(cell)[i], field));
        entry.is_held = entry.is_held || nodes[nodes_of_cells.back()].held != nodes.free;
      }
    cells.push_back(entry);
  }


  template <int dim>
  void BedContact<dim>::find_near_surfaces(const SoilBody<dim> &body,
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
        const double margin = slack + 1.5 * (fastest + surface.velocity.norm()) * dt;
        if (surface.samples->least_distance(points.cell) <= body.spacing + margin)
          near.push_back({ s, margin });
        else if (surface.obstacle && surface.obstacle->is_moving)
          for_each_point(points, [&](const auto &point) { // It may have gone away from points that touched it.
            std::fill_n(point.properties + body.layout.contact_force(s), dim, 0.);
          });
      }
  }


  template <int dim>
  template <int n>
  void BedContact<dim>::add_cell(const SoilBody<dim> &body,
                                 const CellPoints<dim> &points,
                                 const NodalField<dim> &field,
                                 const double dt)
  {
    constexpr unsigned int n_nodes = CellBasis<dim, n>::n_nodes;
    const unsigned int *of_cell    = grid.nodes(points.cell);
    double fastest                 = 0.; // square of the speed
    for (unsigned int i = 0; i < n_nodes; ++i)
      if (const double *values = field[of_cell[i]]; values[NodalField<dim>::mass] > 0.)
        fastest = std::max(fastest, vector_of<dim>(values + NodalField<dim>::velocity).norm_square());
    find_near_surfaces(body, points, std::sqrt(fastest), dt);
    if (near.empty())
      return;

    bool is_new = true;
    for_each_point(points, [&](const auto &point) {
      for (const Near &one : near)
        {
          const SurfaceView<dim> view = surfaces[one.surface].samples->view(point.cell, point.reference_location);
          if (view.distance - point.properties[body.layout.touching_distance(one.surface)] > one.margin)
            {
              std::fill_n(point.properties + body.layout.contact_force(one.surface), dim, 0.);
              continue;
            }
          if (is_new)
            open_cell(points.cell, field);
          is_new = false;
          add_contact<n>(body, one.surface, point, view, dt);
        }
    });
  }


  template <int dim>
  template <int n>
  void BedContact<dim>::find_contacts(const NodalField<dim> &field, const double time_step)
  {
    nodes.begin(field);
    cells.clear();
    nodes_of_cells.clear();
    contacts.clear();
    rows.clear();
    feet.clear();
    for (RigidSurface<dim> &surface : surfaces)
      if (surface.obstacle)
        surface.velocity = surface.obstacle->velocity();
    const auto is_near = [this](const unsigned int cell) {
      for (const RigidSurface<dim> &surface : surfaces)
        if (surface.samples->is_near(cell))
          return true;
      return false;
    };
    for (auto &body : bodies)
      if (body.group == group && !body.is_rigid)
        for (const auto &cell : body.points.cells())
          if (is_near(cell.cell))
            add_cell<n>(body, cell, field, time_step);
  }


  template <int dim>
  void BedContact<dim>::colour_cells()
  {
    constexpr unsigned int n_colours = Utilities::pow(colours_1d, dim), any = n_colours;
    static_assert(any < 32, "A bit each.");
    std::stable_sort(cells.begin(), cells.end(), [](const Cell &a, const Cell &b) { return a.colour < b.colour; });
    first_of_colour.assign(n_colours + 1, 0);
    unsigned int own_bits = 0;
    for (const Cell &cell : cells)
      {
        ++first_of_colour[cell.colour + 1];
        own_bits |= 1u << any;
        for (unsigned int i = 0; i < grid.n_nodes_per_cell(); ++i)
          if (nodes.is_shared(grid.nodes(cell.number)[i]))
            own_bits |= 1u << cell.colour;
      }
    for (unsigned int c = 0; c < n_colours; ++c)
      first_of_colour[c + 1] += first_of_colour[c];
    unsigned int bits = 0;
    const int error =
        MPI_Allreduce(&own_bits, &bits, 1, MPI_UNSIGNED, MPI_BOR, grid.triangulation().get_communicator());
    AssertThrowMPI(error);
    any_contact = bits >> any & 1;
    is_colour_shared.resize(n_colours);
    for (unsigned int c = 0; c < n_colours; ++c)
      is_colour_shared[c] = bits >> c & 1;
  }


  template <int dim>
  template <int n>
  void BedContact<dim>::finish(const NodalField<dim> &field, const double time_step, StepBalance<dim> &balance)
  {
    constexpr unsigned int n_nodes = CellBasis<dim, n>::n_nodes;
    for (const Cell &cell : cells)
      for (unsigned int c = cell.first; c < cell.first + cell.n; ++c)
        {
          const Contact &contact       = contacts[c];
          const Tensor<1, dim> impulse = contact.normal_impulse * contact.normal + contact.tangent_impulse;
          for (unsigned int a = 0; a < dim; ++a)
            contact.force[a] = impulse[a] / time_step;
          Tensor<1, dim> mean_velocity;
          double sum = 0.;
          for (unsigned int i = 0; i < n_nodes; ++i)
            {
              const double shape   = rows[std::size_t(c) * OfCell<dim, n>::n_doubles + i];
              const auto &node     = nodes[nodes_of_cells[cell.nodes + i]];
              const double *values = field[node.node];
              sum += shape;
              for (unsigned int a = 0; a < dim && shape != 0.; ++a)
                mean_velocity[a] += shape * (values[NodalField<dim>::velocity + a] -
                                             0.5 * values[NodalField<dim>::velocity_change + a]);
              if (node.held != nodes.free)
                {
                  const Tensor<1, dim> reaction = -shape * nodes.held(node).held_part(impulse);
                  balance.wall_impulse += reaction;
                  balance.soil_walls.add(constraints.at(node.node)->soil_faces, reaction);
                }
            }
          const RigidSurface<dim> &surface = surfaces[contact.surface];
          if (surface.obstacle == nullptr)
            {
              balance.bed_impulse += sum * impulse;
              balance.bed_dissipation -= impulse * mean_velocity;
              continue;
            }
          ObstacleBalance<dim> &obstacle = balance.obstacles[contact.surface - (surfaces.size() - n_obstacles)];
          const double work              = sum * impulse * surface.velocity;
          obstacle.impulse += sum * impulse;
          obstacle.add_moment(feet[c] - surface.obstacle->pivot, sum * impulse);
          obstacle.work += work;
          obstacle.dissipation += work - impulse * mean_velocity;
        }
  }


  template <int dim>
  template <int n>
  void BedContact<dim>::solve(NodalField<dim> &field, const double time_step, StepBalance<dim> &balance)
  {
    balance.obstacles.resize(n_obstacles);
    find_contacts<n>(field, time_step);
    colour_cells();
    if (!any_contact)
      return;
    start<n>();
    for (unsigned int s = 0; s < n_sweeps; ++s)
      sweep<n>(s % 2 == 0);
    nodes.write(field, balance);
    finish<n>(field, time_step, balance);
  }


  template <int dim>
  void BedContact<dim>::solve(NodalField<dim> &field, const double time_step, StepBalance<dim> &balance)
  {
    if (grid.n_nodes_1d() == 2)
      solve<2>(field, time_step, balance);
    else
      solve<3>(field, time_step, balance);
  }

  template class BedContact<2>;
  template class BedContact<3>;
} // namespace scree

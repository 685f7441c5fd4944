// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/momentum/absorbing_walls.h>
#include <scree/tensor/elastic_strain.h>
#include <scree/tensor/vector.h>

namespace scree
{
  using namespace dealii;

  namespace
  {
    const RegisterWallType registered("Boundaries", { "absorbing", "", [](const double) {
                                                       return Wall{ Wall::Holds::normal, false, 0., 0., "", true };
                                                     } });

    /// Modulus of waves that run along one axis and move along another, Pa per reference volume: second derivative of
    /// the stored energy.
    template <int dim>
    double wave_modulus(const Material<dim> &material,
                        const double *left_cauchy_green,
                        const unsigned int motion,
                        const unsigned int way)
    {
      constexpr double strain = 1e-4;
      const auto energy       = [&](const double by) {
        double f[dim * dim] = {}, deformed[n_symmetric_components<dim>];
        for (unsigned int a = 0; a < dim; ++a)
          f[(dim + 1) * a] = 1.;
        f[dim * motion + way] += by;
        trial_left_cauchy_green<dim>(f, 1., left_cauchy_green, deformed);
        return material.elastic_energy(deformed);
      };
      return std::max(0., energy(strain) - 2. * energy(0.) + energy(-strain)) / (strain * strain);
    }
  } // namespace


  template <int dim>
  AbsorbingWalls<dim>::AbsorbingWalls(const BackgroundGrid<dim> &grid,
                                      Constraints<dim> &constraints,
                                      const BodyForces<dim> &forcing)
      : grid(grid)
      , constraints(constraints)
      , forcing(forcing)
      , faces(constraints.absorbing_faces())
  {
    for (unsigned int a = 0; a < dim; ++a)
      n_nodes[a] = grid.fine_cells().box().n[a] + grid.n_nodes_1d() - 1;
    first_place[0] = 0;
    for (unsigned int f = 0; f < 2 * dim; ++f)
      {
        unsigned int n = faces >> f & 1;
        for (unsigned int a = 0; a < dim; ++a)
          n *= a == f / 2 ? 1 : n_nodes[a];
        first_place[f + 1] = first_place[f] + n;
      }
    reinit();
  }


  template <int dim>
  unsigned int AbsorbingWalls<dim>::place_on(const unsigned int face, const CellPlace<dim> &node) const
  {
    unsigned int place = 0; // lines along the last axis are contiguous
    for (unsigned int a = 0; a < dim; ++a)
      if (a != face / 2)
        place = place * n_nodes[a] + node[a];
    return first_place[face] + place;
  }


  template <int dim>
  void AbsorbingWalls<dim>::reinit()
  {
    std::map<unsigned int, std::map<unsigned int, unsigned int>> places; // by node and face
    for (const auto &cell : grid.fine_cells().cells())
      if (const std::uint8_t open = faces & grid.open_knots(cell.index); open != 0 && grid.fine_cells().is_owned(cell))
        for (unsigned int i = 0; i < grid.n_nodes_per_cell(); ++i)
          {
            const unsigned int node = grid.nodes(cell.index)[i];
            CellPlace<dim> place    = cell.place;
            for (unsigned int a = 0, rest = i; a < dim; ++a, rest /= grid.n_nodes_1d())
              place[a] += rest % grid.n_nodes_1d();
            for (unsigned int f = 0; f < 2 * dim; ++f)
              if (open >> f & grid.node_faces(node) >> f & 1)
                places[node][f] = place_on(f, place);
          }
    wall_nodes.clear();
    for (const auto &[node, of_faces] : places)
      wall_nodes.push_back({ node, { of_faces.begin(), of_faces.end() }, false });
  }


  template <int dim>
  void AbsorbingWalls<dim>::release()
  {
    for (WallNode &wall : wall_nodes)
      {
        wall.is_free = constraints.has_walls_alone(wall.node) &&
                       std::all_of(wall.places.begin(), wall.places.end(), [&](const auto &face_and_place) {
                         return free_field.nodes.empty() || free_field.nodes[face_and_place.second].area > 0.;
                       });
        if (wall.is_free)
          constraints.release(wall.node, faces);
      }
  }


  template <int dim>
  template <int n>
  void AbsorbingWalls<dim>::add_impedances(const SoilBody<dim> &body, const ConstCellPoints<dim> &cell)
  {
    const OpenKnots open       = grid.open_knots(cell.cell);
    const FineCells<dim> &fine = grid.fine_cells();
    const CellPlace<dim> &base = fine.cells()[fine.of_index(cell.cell)].place;
    for_each_point(cell, [&](const auto &point) {
      const CellBasis<dim, n> basis(point.reference_location, open);
      const double *b     = point.properties + body.layout.left_cauchy_green;
      const double volume = point.properties[body.layout.volume], density = point.properties[body.layout.mass] / volume;
      for (unsigned int f = 0; f < 2 * dim; ++f)
        if (faces >> f & open >> f & 1)
          {
            const unsigned int normal = f / 2, side = f % 2 == 0 ? 0 : n - 1;
            const auto impedance = [&](const unsigned int motion) {
              return density * std::sqrt(wave_modulus(*body.material, b, motion, normal) / body.density);
            };
            const double pressure_wave = impedance(normal), shear_wave = impedance(normal < dim - 1 ? dim - 1 : 0);
            for (unsigned int i = 0; i < basis.n_nodes; ++i)
              {
                CellPlace<dim> place = base;
                double area          = volume / grid.cell_size() * std::abs(basis.derivative[normal][side]);
                for (unsigned int a = 0, rest = i; a < dim; ++a, rest /= n)
                  {
                    place[a] += rest % n;
                    area *= a != normal ? basis.value[a][rest % n] : double(rest % n == side);
                  }
                FreeFieldNode<dim> &node = free_field.nodes[place_on(f, place)];
                node.area += area;
                node.mass += density * area;
                node.pressure_wave += pressure_wave * area;
                node.shear_wave += shear_wave * area;
              }
          }
    });
  }


  template <int dim>
  void AbsorbingWalls<dim>::begin(const std::list<SoilBody<dim>> &bodies, const NodalField<dim> &field)
  {
    free_field = FreeField<dim>();
    free_field.nodes.resize(first_place.back());
    for (const SoilBody<dim> &body : bodies)
      if (!body.is_rigid)
        for (const auto &cell : body.points.cells())
          if (grid.open_knots(cell.cell) & faces)
            with_nodes_1d(grid, [&](auto n) { add_impedances<n>(body, cell); });
    for (const WallNode &wall : wall_nodes)
      if (wall.node < grid.n_owned_nodes() && wall.is_free)
        {
          const double *values = field[wall.node];
          const Tensor<1, dim> held =
              vector_of<dim>(values + NodalField<dim>::force) + values[NodalField<dim>::mass] * forcing.fall();
          for (unsigned int a = 0; a < dim; ++a)
            {
              const auto holds = [&](const auto &of) { return a == of.first / 2 || constraints.is_fixed(of.first); };
              const auto found = std::find_if(wall.places.begin(), wall.places.end(), holds);
              if (found != wall.places.end())
                free_field.nodes[found->second].force_at_rest[a] = -held[a];
            }
        }
    NumbersOf(free_field).sum_over_ranks(grid.communicator());
  }


  template <int dim>
  void AbsorbingWalls<dim>::move_column(const unsigned int face, const unsigned int first, const double time_step)
  {
    constexpr unsigned int up = dim - 1;
    const unsigned int n = n_nodes[up], normal = face / 2;
    FreeFieldNode<dim> *nodes = &free_field.nodes[first];
    unsigned int lowest = 0, highest = 0;
    while (lowest < n && nodes[lowest].area <= 0.)
      ++lowest;
    double width = 0.; // of the column, m (2D: 1)
    for (highest = lowest; highest < n && nodes[highest].area > 0.; ++highest)
      width = std::max(width, nodes[highest].area / grid.cell_size());
    if (width == 0.)
      return;
    const auto height = [&](const unsigned int k) { // as NodeNumbering::position()
      return grid.cell_size() * (grid.n_nodes_1d() == 2 ? k : std::clamp(k - 0.5, 0., n - 2.));
    };
    const auto modulus = [&](const unsigned int k, const unsigned int motion) {
      const double impedance = motion == up ? nodes[k].pressure_wave : nodes[k].shear_wave;
      return impedance * impedance / (nodes[k].mass * nodes[k].area);
    };
    for (unsigned int k = lowest; k < highest; ++k) // what the stress of the column does to the wall
      {
        const unsigned int below = std::max(k, lowest + 1) - 1, above = std::min(k + 1, highest - 1);
        const double outward = (face % 2 == 0 ? -1. : 1.) * nodes[k].area;
        const Tensor<1, dim> gradient =
            (nodes[above].displacement - nodes[below].displacement) / std::max(height(above) - height(below), 1e-99);
        force[first + k][normal] += outward * (modulus(k, up) - 2. * modulus(k, normal)) * gradient[up];
        force[first + k][up] += outward * modulus(k, normal) * gradient[normal];
        velocity[first + k] = Tensor<1, dim>();
      }
    const bool is_compliant        = faces >> 2 * up & 1 && lowest == 0;
    constexpr unsigned int n_parts = 2; // of the step: springs are stable up to a Courant number of 0.63
    const double part              = time_step / n_parts;
    std::vector<Tensor<1, dim>> sums(n); // of forces
    for (unsigned int p = 0; p < n_parts; ++p)
      {
        for (unsigned int k = lowest; k < highest; ++k)
          sums[k] = nodes[k].mass * forcing.shaking();
        for (unsigned int k = lowest; k + 1 < highest; ++k)
          {
            const double length        = height(k + 1) - height(k);
            const double filled        = std::min({ length * width, 2. * nodes[k].area, 2. * nodes[k + 1].area });
            const Tensor<1, dim> shift = nodes[k + 1].displacement - nodes[k].displacement;
            for (unsigned int a = 0; a < dim; ++a)
              {
                const double spring = 0.5 * (modulus(k, a) + modulus(k + 1, a)) * filled / (length * length) * shift[a];
                sums[k][a] += spring;
                sums[k + 1][a] -= spring;
              }
          }
        for (unsigned int k = lowest; k < highest; ++k)
          {
            FreeFieldNode<dim> &node = nodes[k];
            for (unsigned int a = 0; a < dim && (k > lowest || is_compliant); ++a)
              {
                const double impedance =
                    k > lowest ? 0. : width / node.area * (a == up ? node.pressure_wave : node.shear_wave);
                const double rate = (sums[k][a] + impedance * (base_velocity[a] - node.velocity[a])) /
                                    (node.mass + 0.5 * part * impedance);
                velocity[first + k][a] += (node.velocity[a] + 0.5 * part * rate) / n_parts;
                node.velocity[a] += part * rate;
              }
            node.displacement += part * node.velocity;
          }
      }
  }


  template <int dim>
  void AbsorbingWalls<dim>::add_forces(const std::list<SoilBody<dim>> &bodies,
                                       NodalField<dim> &field,
                                       const double time_step,
                                       Budget<dim> &budget)
  {
    using Field = NodalField<dim>;
    if (free_field.nodes.size() != first_place.back())
      begin(bodies, field);
    base_velocity = free_field.base_velocity - 0.5 * time_step * forcing.shaking();
    free_field.base_velocity -= time_step * forcing.shaking();
    velocity.assign(first_place.back(), base_velocity);
    force.clear();
    for (const FreeFieldNode<dim> &node : free_field.nodes)
      force.push_back(node.force_at_rest);
    for (unsigned int f = 0; f < 2 * (dim - 1); ++f) // the sides
      for (unsigned int first = first_place[f]; first < first_place[f + 1]; first += n_nodes[dim - 1])
        move_column(f, first, time_step);
    for (const WallNode &wall : wall_nodes)
      {
        double *values    = field[wall.node];
        const double mass = wall.node < grid.n_owned_nodes() ? values[Field::mass] : 0.;
        if (!wall.is_free || mass <= 0.)
          continue;
        ConstrainedDirections<dim> held; // by other walls
        if (const NodeConstraints<dim> *others = constraints.at(wall.node))
          for (const NodeConstraint<dim> &other : others->soil)
            held.hold(other.normal);
        for (unsigned int a = 0; a < dim; ++a)
          {
            if (held.held_part(Point<dim>::unit_vector(a))[a] > 0.5)
              continue;
            const auto impedance = [&](const unsigned int face, const unsigned int place) {
              return a == face / 2 ? free_field.nodes[place].pressure_wave : free_field.nodes[place].shear_wave;
            };
            double given = values[Field::force + a] + mass * (forcing.fall() + forcing.shaking())[a], dashpots = 0.;
            const double before = values[Field::momentum + a] / mass;
            for (const auto &[face, place] : wall.places)
              {
                given += force[place][a] + impedance(face, place) * (velocity[place][a] - before);
                dashpots += impedance(face, place);
              }
            const double mean = before + 0.5 * time_step * given / (mass + 0.5 * time_step * dashpots);
            for (const auto &[face, place] : wall.places)
              {
                const double closing = velocity[place][a] - mean;
                const double added   = force[place][a] + impedance(face, place) * closing;
                const double lost    = time_step * impedance(face, place) * closing * closing;
                values[Field::force + a] += added;
                budget.wall_impulse[a] += time_step * added;
                budget.soil_walls.of_face[face][a] += time_step * added;
                budget.wall_dissipation += lost;
                budget.dashpot_dissipation += lost;
                budget.load_work += time_step * added * mean + lost;
              }
          }
      }
  }


  template <int dim>
  void AbsorbingWalls<dim>::keep_inside(std::list<SoilBody<dim>> &bodies) const
  {
    const double inside = 1e-6 * grid.cell_size();
    for (SoilBody<dim> &body : bodies)
      if (!body.is_rigid)
        for (const auto &cell : body.points.cells())
          if (const unsigned int open = grid.open_knots(cell.cell) & faces; open != 0)
            for_each_point(cell, [&](const auto &point) {
              for (unsigned int f = 0; f < 2 * dim; ++f)
                if (double &x = point.location[f / 2]; open >> f & 1)
                  x = f % 2 == 0 ? std::max(x, grid.lower_corner()[f / 2] + inside)
                                 : std::min(x, grid.upper_corner()[f / 2] - inside);
            });
  }

  template class AbsorbingWalls<2>;
  template class AbsorbingWalls<3>;
} // namespace scree

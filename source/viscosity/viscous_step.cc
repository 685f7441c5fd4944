// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/tensor/vector.h>
#include <scree/viscosity/viscous_step.h>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// 2 dev(sym grad v), 1/s: incompressible beside the pressure.
    template <int dim>
    DEAL_II_ALWAYS_INLINE inline Tensor<2, dim> twice_deviatoric_rate(const Tensor<2, dim> &gradient)
    {
      const double mean = 2. / 3. * trace(gradient);
      Tensor<2, dim> rate;
      for (unsigned int c = 0; c < dim; ++c)
        for (unsigned int a = 0; a < dim; ++a)
          rate[c][a] = gradient[c][a] + gradient[a][c] - (a == c ? mean : 0.);
      return rate;
    }

    /// sum |grad phi_i|^2/phi_i, per square of the cell's width: a sum over the axes, as the others' functions add up
    /// to one. Of splines at most 6 an axis, which is taken for all points away from walls.
    template <int dim, int n>
    double stiffness(const Point<dim> &x, const OpenKnots open)
    {
      if (n == 3 && open == 0)
        return 6. * dim;
      const CellBasis<dim, n> basis(x, open);
      double sum = 0;
      for (unsigned int a = 0; a < dim; ++a)
        for (unsigned int i = 0; i < n; ++i)
          if (const double slope = basis.derivative[a][i]; slope != 0.)
            sum += slope * slope / basis.value[a][i];
      return sum;
    }
  } // namespace


  template <int dim>
  void ViscousForce<dim>::add(const WaterPhase<dim> &water, const NodalField<dim> &motion, NodalField<dim> &field) const
  {
    with_nodes_1d(grid, [&](auto n) {
      for (const auto &cell : water.points().cells())
        {
          const OpenKnots open      = grid.open_knots(cell.cell);
          const unsigned int *nodes = grid.nodes(cell.cell);
          const CellVelocity<dim, n> velocity(nodes, motion, grid.cell_size());
          CellSums<dim, n> sums(grid.cell_size());
          for_each_batch(cell.n_points, [&](const BatchIndices &indices, const unsigned int n_used) {
            RecordPointers<const double> places;
            for (unsigned int l = 0; l < batch_size; ++l)
              places[l] = &cell.reference_location_of(indices[l])[0];
            const auto at_points = velocity.template at<TransferMethod::tpic, true>(BatchShape<dim, n>(places, open));
            for (unsigned int l = 0; l < n_used; ++l)
              {
                const PointShape<dim, n> shape(cell.reference_location_of(indices[l]), open);
                Tensor<2, dim> gradient;
                for (unsigned int c = 0; c < dim; ++c)
                  for (unsigned int d = 0; d < dim; ++d)
                    gradient[c][d] = at_points.gradient[c * dim + d][l];
                sums.add_force(shape,
                               viscosity * cell.properties_of(indices[l])[water.layout.volume],
                               twice_deviatoric_rate(gradient));
              }
          });
          field.activate_cell(cell.cell);
          sums.scatter(nodes, field);
        }
    });
  }

  template <int dim>
  double ViscousForce<dim>::largest_rate(const WaterPhase<dim> &water) const
  {
    return with_nodes_1d(grid, [&](auto n) {
      double largest = 0;
      for (const auto &cell : water.points().cells())
        for_each_point(cell, [&, open = grid.open_knots(cell.cell)](const auto &point) {
          if (const double product = viscosity * point.properties[water.layout.volume]; product > 0.)
            largest = std::max(largest,
                               product / point.properties[water.layout.mass] *
                                   stiffness<dim, n>(point.reference_location, open));
        });
      return 2. * largest / (grid.cell_size() * grid.cell_size());
    });
  }


  template class ViscousForce<2>;
  template class ViscousForce<3>;


  template <int dim>
  ViscousStep<dim>::ViscousStep(const BackgroundGrid<dim> &grid,
                                const WaterParameters &parameters,
                                const std::list<WaterPhase<dim>> &water,
                                TimerOutput &timer)
      : grid(grid)
      , water(water)
      , water_viscosity(parameters.viscosity)
      , timer(timer)
      , force(grid, parameters.viscosity)
  {
    if (water_viscosity > 0.)
      for (std::optional<NodalField<dim>> *field : { &motion, &impulses })
        field->emplace(grid);
  }


  template <int dim>
  void ViscousStep<dim>::reinit()
  {
    for (std::optional<NodalField<dim>> *field : { &motion, &impulses })
      if (*field)
        (*field)->reinit();
  }


  template <int dim>
  double ViscousStep<dim>::largest_rate() const
  {
    double largest = 0;
    for (const auto &part : water)
      largest = std::max(largest, force.largest_rate(part));
    return Utilities::MPI::max(largest, grid.communicator());
  }


  template <int dim>
  void ViscousStep<dim>::find_impulses(const NodalField<dim> &velocity,
                                       const CutCellContact<dim> *bed,
                                       const double ground_share,
                                       const double time_step)
  {
    impulses->clear();
    for (const auto &part : water)
      force.add(part, velocity, *impulses);
    if (bed)
      bed->add_viscous_force(velocity, ground_share, water_viscosity, *impulses);
    impulses->add_contributions();
    for (const unsigned int node : active)
      for (unsigned int c = 0; c < dim; ++c)
        (*impulses)[node][NodalField<dim>::force + c] *= time_step;
  }


  template <int dim>
  void ViscousStep<dim>::set_motion(const Vector &velocity)
  {
    for (unsigned int i = 0; i < active.size(); ++i)
      for (unsigned int c = 0; c < dim; ++c)
        (*motion)[active[i]][NodalField<dim>::velocity + c] = velocity[i].water[c];
    motion->update_ghosts();
  }


  template <int dim>
  SoilAndWater<dim> ViscousStep<dim>::impulses_at(const unsigned int node) const
  {
    return { Tensor<1, dim>(), vector_of<dim>((*impulses)[node] + NodalField<dim>::force) };
  }


  template <int dim>
  unsigned int ViscousStep<dim>::solve(Vector &velocity, const CutCellContact<dim> *bed, const double time_step)
  {
    constexpr double tolerance             = 1e-9; // of the residual, in the norm of its kinetic energy
    constexpr unsigned int most_iterations = 5000;

    Vector residual(active.size()), scaled(active.size());
    for (unsigned int i = 0; i < active.size(); ++i)
      {
        residual[i] = impulses_at(active[i]);
        scaled[i]   = pairs[i].solve(residual[i]);
      }
    Vector direction       = scaled;
    double energy          = product(residual, scaled);
    const double target    = tolerance * tolerance * energy;
    unsigned int iteration = 0;
    for (; energy > target; ++iteration)
      {
        AssertThrow(iteration < most_iterations,
                    ExcMessage("The viscous stress of a step was not found in 5000 iterations. Remedies: a smaller "
                               "'Viscosity' in subsection Water, or a smaller 'Maximum time step'."));
        set_motion(direction);
        find_impulses(*motion, bed, 0., time_step);
        Vector image(active.size()); // (A + dt K) direction
        for (unsigned int i = 0; i < active.size(); ++i)
          image[i] = pairs[i].impulses(direction[i]) - pairs[i].free_part(impulses_at(active[i]));
        const double length = energy / product(direction, image);
        for (unsigned int i = 0; i < active.size(); ++i)
          {
            velocity[i] += length * direction[i];
            residual[i] += -length * image[i];
            scaled[i] = pairs[i].solve(residual[i]);
          }
        const double before = energy;
        energy              = product(residual, scaled);
        for (unsigned int i = 0; i < active.size(); ++i)
          direction[i] = scaled[i] + energy / before * direction[i];
      }
    return iteration;
  }


  template <int dim>
  void ViscousStep<dim>::apply(WetNodes<dim> &nodes,
                               TwoPhaseMomentum<dim> &step,
                               CutCellContact<dim> &bed,
                               const double time_step,
                               Budget<dim> &balance)
  {
    if (water_viscosity == 0.)
      return;
    const TimedPart part(timer, TimerSection::nodes);
    active = nodes.active();
    pairs.clear();
    for (const unsigned int node : active)
      pairs.push_back(step.drag_block_at(node));
    constexpr double stable = 2.; // beyond, an explicit step turns the fastest motion round and makes it grow
    const bool is_long      = time_step * largest_rate() > stable;
    find_impulses(nodes.water, is_long ? &bed : nullptr, 1., time_step);
    if (is_long)
      {
        Vector velocity;
        for (const unsigned int node : active)
          velocity.push_back(nodes.velocities(node));
        const unsigned int n_iterations = solve(velocity, &bed, time_step);
        if (Utilities::MPI::this_mpi_process(grid.communicator()) == 0)
          balance.n_viscous_iterations += n_iterations;
        // What the solve leaves would not add up to nothing.
        set_motion(velocity);
        find_impulses(*motion, &bed, 1., time_step);
        bed.take_viscous_force(*motion, water_viscosity, time_step);
      }
    for (const unsigned int node : active)
      step.push(node, impulses_at(node), balance);
    nodes.update_velocity_ghosts();
    if (is_long && bed.no_slip()) // which counts its own impulses
      find_impulses(*motion, nullptr, 1., time_step);
  }


  template <int dim>
  void ViscousStep<dim>::count_dissipation(const WetNodes<dim> &nodes, Budget<dim> &balance) const
  {
    for (const unsigned int node : active)
      {
        const Tensor<1, dim> impulse      = vector_of<dim>((*impulses)[node] + NodalField<dim>::force);
        const Tensor<1, dim> after        = vector_of<dim>(nodes.water[node] + NodalField<dim>::velocity);
        const Tensor<1, dim> water_change = vector_of<dim>(nodes.water[node] + NodalField<dim>::velocity_change);
        // The work of an impulse is its product with the mean velocity.
        balance.viscous_dissipation -= impulse * (after - 0.5 * water_change);
      }
  }

  template class ViscousStep<2>;
  template class ViscousStep<3>;
} // namespace scree

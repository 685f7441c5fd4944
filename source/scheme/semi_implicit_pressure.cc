// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/scheme/semi_implicit_scheme.h>

#include <algorithm>

namespace scree
{
  using namespace dealii;

  template <int dim>
  void SemiImplicitScheme<dim>::find_pressure()
  {
    const bool keeps = previous_pressure == PreviousPressure::grid && has_grid_pressure;
    if (keeps)
      kept_pressure = pressure;
    surface.locate(mixture, pressure);
    if (keeps || previous_pressure == PreviousPressure::dropped)
      for (const unsigned int corner : surface.wet_corners())
        if (surface.kind(corner) == CornerKind::unknown)
          pressure.local_element(corner) = keeps ? kept_pressure.local_element(corner) : 0.;
    has_grid_pressure = true;
    pressure.update_ghost_values();
    surface.extrapolate(mixture, pressure);
  }


  template <int dim>
  void SemiImplicitScheme<dim>::read_pressure(const std::list<SoilBody<dim>> &soil,
                                              const std::list<WaterPhase<dim>> &water)
  {
    gather(soil, water);
    complete_pores();
    find_pressure();
    water_nodes.clear(); // sums, not velocities
  }


  template <int dim>
  std::array<double, (1 << dim)> SemiImplicitScheme<dim>::at_corners(const CornerVector &values,
                                                                     const unsigned int cell) const
  {
    std::array<double, (1 << dim)> result;
    for (unsigned int v = 0; v < result.size(); ++v)
      result[v] = values.local_element(corners.nodes(cell)[v]);
    return result;
  }


  template <int dim>
  std::array<double, (1 << dim)> SemiImplicitScheme<dim>::corner_pressure(const unsigned int cell) const
  {
    return at_corners(pressure, cell);
  }


  template <int dim>
  void SemiImplicitScheme<dim>::set_mobilities(const double time_step)
  {
    const double cell_volume = Utilities::fixed_power<dim>(grid.cell_size());
    for (MixtureCell<dim> &cell : mixture.cells())
      if (cell.water_volume > 0)
        {
          const double V_s = cell.effective_saturation * cell.grain_volume, V_w = cell.water_volume;
          const double a = cell.soil_mass, b = cell.water_mass;
          double mobility = V_w * V_w / b;
          if (a > 0.)
            {
              const double C = splitting == Splitting::classical
                                   ? 0.
                                   : drag_share(cell.water_volume, cell.pore_volume) * cell.drag * time_step;
              mobility       = (V_s * V_s * (b + C) + 2. * V_s * V_w * C + V_w * V_w * (a + C)) / (a * b + C * (a + b));
            }
          cell.mobility = mobility / (cell_volume * std::min(cell.fill, 1.));
        }
  }


  template <int dim>
  void SemiImplicitScheme<dim>::solve_pressure(NodalField<dim> &soil,
                                               const double time_step,
                                               const double shear_modulus,
                                               TimerOutput &timer,
                                               StepBalance<dim> &balance)
  {
    {
      TimerOutput::Scope part(timer, "pressure: system");
      divergence.integrate(mixture, soil, water_nodes, pores, source);
      set_mobilities(time_step);
      const double storage = bulk_modulus > 0 ? 1. / (bulk_modulus * time_step) : 0.;
      const double tau     = projection > 0 && shear_modulus > 0 ? projection / (2. * shear_modulus * time_step) : 0.;
      solver.assemble(
          mixture,
          surface,
          time_step,
          [&](const unsigned int corner) { return storage * surface.water_volume(corner); },
          tau);
    }
    TimerOutput::Scope part(timer, "pressure: solve");
    const SolveReport report = solver.solve(source, pressure, change);
    solver.judge_preconditioner(report);
    count(report, balance);
    change.update_ghost_values();
    surface.extrapolate(mixture, change);
  }


  template <int dim>
  void SemiImplicitScheme<dim>::count(const SolveReport &report, StepBalance<dim> &balance) const
  {
    if (Utilities::MPI::this_mpi_process(grid.triangulation().get_communicator()) != 0)
      return; // All ranks took part; one tells.
    balance.n_iterations += report.n_iterations;
    balance.n_preconditioners += report.made_preconditioner;
  }

  template void SemiImplicitScheme<2>::find_pressure();
  template void SemiImplicitScheme<2>::read_pressure(const std::list<SoilBody<2>> &, const std::list<WaterPhase<2>> &);
  template std::array<double, 4> SemiImplicitScheme<2>::at_corners(const CornerVector &, const unsigned int) const;
  template std::array<double, 4> SemiImplicitScheme<2>::corner_pressure(const unsigned int) const;
  template void
  SemiImplicitScheme<2>::solve_pressure(NodalField<2> &, const double, const double, TimerOutput &, StepBalance<2> &);
  template void SemiImplicitScheme<2>::count(const SolveReport &, StepBalance<2> &) const;
  template void SemiImplicitScheme<3>::find_pressure();
  template void SemiImplicitScheme<3>::read_pressure(const std::list<SoilBody<3>> &, const std::list<WaterPhase<3>> &);
  template std::array<double, 8> SemiImplicitScheme<3>::at_corners(const CornerVector &, const unsigned int) const;
  template std::array<double, 8> SemiImplicitScheme<3>::corner_pressure(const unsigned int) const;
  template void
  SemiImplicitScheme<3>::solve_pressure(NodalField<3> &, const double, const double, TimerOutput &, StepBalance<3> &);
  template void SemiImplicitScheme<3>::count(const SolveReport &, StepBalance<3> &) const;
} // namespace scree

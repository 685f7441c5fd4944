// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/postprocess/checks.h>
#include <scree/tensor/invariants.h>
#include <scree/tensor/vector.h>

#include <boost/algorithm/string/replace.hpp>

namespace scree
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned long long steps_between = 20; // of a channel

    /// What is said of a check, with numbers of its Suspect in place of FOUND and VALUE.
    struct Words
    {
      double bound;                     // of a sound run; doc/output.md derives those of volume and stress
      const char *name, *value,         // of any run
          *fault,                       // of the point, where the bound is exceeded
          *remedy;                      // then
      Finding finding = Finding::fault; // then
    };
    constexpr char move_corner[] =
        "move the corner, or write \"Wall forces = true\" in subsection Probes if the wall is a "
        "structure or a plane of symmetry";
    constexpr Words words[] = { // by Check
      { 1.5,
        "fastest point",
        "VALUE times the speed that 0.1 % of the points, ten at most, exceed",
        "it moves at FOUND m/s",
        "look at this place in the pictures; halve \"Courant number\"" },
      { 0.1,
        "deepest point",
        "FOUND m below the bed",
        "it is VALUE of a cell below the bed",
        "smaller cells, or a smoother bed at this place" },
      { 1. / 0.6,
        "smallest V/V_0",
        "FOUND",
        "it is compressed by so much",
        "write a larger Young's modulus, or halve \"Courant number\"" },
      { 1.5,
        "largest V/V_0 in contact",
        "FOUND",
        "soil in contact has dilated by so much",
        "write a smaller dilation angle, a larger tension cut-off, or a law with a critical state" },
      { 2.,
        "largest stress",
        "VALUE of rho g H",
        "p' and the vertical stress of 0.1 % of the volume are larger, most at this point",
        "look at this place in the pictures; halve \"Courant number\", or write a smaller stiffness" },
      { std::numeric_limits<double>::infinity(), "largest stress of a single point", "VALUE of rho g H", "", "" },
      { 0.,
        "soil that has come to a wall of the box",
        "FOUND m",
        "it has come to this wall or up it, which cuts off the run-out",
        move_corner,
        Finding::resolution },
      { 0.,
        "soil that has moved along a wall of the box",
        "FOUND m",
        "it stood at this wall and has moved along it, so that the wall cuts off the slide",
        move_corner,
        Finding::resolution },
      { 0.,
        "points of soil lost",
        "FOUND",
        "they left the box",
        "the run-out is a lower bound: move the corner of the box that the soil has left through",
        Finding::resolution },
      { 0.01,
        "water with suction that has lost half of it at once",
        "VALUE of its volume",
        "it has lost FOUND Pa of its suction",
        "count on less strength there: suction holds only where dry soil lies behind the water; write a lower "
        "\"Phreatic surface\" or \"Air entry pressure\", or ground that ends between faces of the cells",
        Finding::resolution }
    };

    /// Normal stress, Pa, tension positive, on planes with the unit normal `axis`.
    template <int dim>
    double along(const Tensor<1, dim> &axis, const double *stress)
    {
      double normal = 0.;
      for (unsigned int a = 0; a < dim; ++a)
        {
          normal += axis[a] * axis[a] * stress[a];
          for (unsigned int b = a + 1; b < dim; ++b)
            normal += 2. * axis[a] * axis[b] * stress[2 + a + b];
        }
      return normal;
    }

    /// Calls `look(phase, point, name)` with the points of a set, where name() is that of the point.
    template <typename Phase, int dim, typename Look>
    void for_each_named(const Phase &phase, const std::string &set, const PointSet<dim> &points, const Look &look)
    {
      const auto &cells = points.cells();
      for (unsigned int c = 0; c < cells.size(); ++c)
        {
          unsigned int p = 0;
          for_each_point(cells[c], [&](const auto &point) {
            look(phase, point, [&] {
              return set + ", point " + std::to_string(points.ids(c)[p]) + " at (" + number_text(point.location) +
                     ") m";
            });
            ++p;
          });
        }
    }

    /// Calls `look(point, id)` with the points of a set.
    template <int dim, typename Look>
    void for_each_with_id(const PointSet<dim> &points, const Look &look)
    {
      for (unsigned int c = 0; c < points.cells().size(); ++c)
        {
          const auto ids = points.ids(c);
          auto id        = ids.begin();
          for_each_point(points.cells()[c], [&](const auto &point) { look(point, *id++); });
        }
    }

    /// The same with the bodies that can move.
    template <int dim, typename Look>
    void for_each_named(const std::list<SoilBody<dim>> &bodies, const Look &look)
    {
      for (const SoilBody<dim> &body : bodies)
        if (!body.is_rigid)
          for_each_named(body, body.name, body.points, look);
    }

    /// The same with water that has points of its own.
    template <int dim, typename Look>
    void for_each_named(const std::list<WaterPhase<dim>> &water, const Look &look)
    {
      for (const WaterPhase<dim> &part : water)
        if (part.carrier() == nullptr)
          for_each_named(part, "Water", part.points(), look);
    }
  } // namespace


  template <int dim>
  void RunChecks<dim>::look(const std::list<SoilBody<dim>> &bodies,
                            const std::list<WaterPhase<dim>> &water,
                            const double n_lost,
                            const double time,
                            const unsigned long long step,
                            const unsigned int least_age)
  {
    if (has_looked && step < last_step + least_age)
      return;
    last_step = step;
    now       = Suspects();
    has_soil  = std::any_of(bodies.begin(), bodies.end(), [](const auto &body) { return !body.is_rigid; });
    look_at_speeds(bodies, usual_speed_of_soil);
    look_at_speeds(water, usual_speed_of_water);
    look_at_places(bodies, water);
    if (has_looked)
      look_at_suction(water);
    else
      keep_suction(water);
    const double n_all = Utilities::MPI::sum(n_lost, grid.communicator());
    suspect(lost, n_all, n_all, [] { return std::string(); });
    for (Suspect &suspect : now)
      suspect.time = time;
    const auto of_ranks = Utilities::MPI::gather(grid.communicator(), now);
    for (const Suspects &of_rank : of_ranks) // none but on the rank that writes
      for (unsigned int c = 0; c < n_checks; ++c)
        if (of_rank[c].value > worst[c].value)
          worst[c] = of_rank[c];
    for (unsigned int c = 0; c < n_checks && !of_ranks.empty(); ++c)
      if (!is_told[c] && worst[c].value > words[c].bound)
        {
          is_told[c]              = true;
          const CheckResult found = result(c);
          folder.log("Check: " + found.name + ' ' + found.value + "; " + found.where + ".");
        }
    has_looked = true;
  }


  template <int dim>
  template <class Name>
  void RunChecks<dim>::suspect(const Check check, const double value, const double found, const Name &name)
  {
    Suspect &so_far = now[check];
    if (!(value <= so_far.value)) // what is no number is worst
      so_far = { std::isnan(value) ? std::numeric_limits<double>::infinity() : value, found, name(), 0. };
  }


  template <int dim>
  template <class Phases>
  void RunChecks<dim>::look_at_speeds(const Phases &phases, double &usual)
  {
    const double fall = std::sqrt(2. * gravity.norm() * grid.cell_size()); // slower points do not harm
    std::vector<PartOfMass> speeds;                                        // each point counts as one
    double largest = 0.;
    for_each_named(phases, [&](const auto &phase, const auto &point, const auto &) {
      speeds.push_back({ vector_of<dim>(point.properties + phase.layout.velocity).norm(), 1. });
      largest = std::max(largest, speeds.back().place);
    });
    largest = Utilities::MPI::max(largest, grid.communicator());
    if (!(largest > fall))
      return;
    if (!std::isinf(largest))
      usual = std::max(
          usual,
          percentile(speeds,
                     std::max(0.999, 1. - 10. / Utilities::MPI::sum(double(speeds.size()), grid.communicator())),
                     grid.communicator()));
    auto found = speeds.begin();
    for_each_named(phases, [&](const auto &, const auto &, const auto &name) {
      if (found->place > std::max(usual, fall))
        suspect(speed, found->place / std::max(usual, fall), found->place, name);
      ++found;
    });
  }


  template <int dim>
  void RunChecks<dim>::look_at_places(const std::list<SoilBody<dim>> &bodies, const std::list<WaterPhase<dim>> &water)
  {
    const double g = gravity.norm();
    std::vector<double> ends(2, std::numeric_limits<double>::lowest()); // heights: highest, minus lowest
    if (g > 0.)
      for_each_moving_point(bodies, [&](const auto &, const auto &point) {
        const double height = -(gravity * (point.location - Point<dim>())) / g;
        ends                = { std::max(ends[0], height), std::max(ends[1], -height) };
      });
    Utilities::MPI::max(ends, grid.communicator(), ends);
    const double height      = ends[0] + ends[1] + grid.cell_size();
    const auto look_at_depth = [&](const auto &, const auto &point, const auto &name) {
      const double deepest = -grid.cell_size() * now[depth].value;
      if (bed == nullptr || bed->least_distance(point.cell) >= deepest)
        return;
      const double distance = bed->distance_of(point.cell, point.reference_location, point.location, deepest);
      if (distance < 0.)
        suspect(depth, -distance / grid.cell_size(), -distance, name);
    };
    for_each_named(water, look_at_depth);
    std::vector<PartOfMass> stresses; // over rho g H, and volumes
    for_each_named(bodies, [&](const auto &body, const auto &point, const auto &name) {
      const double ratio  = body.density * point.properties[body.layout.volume] / point.properties[body.layout.mass];
      const double *sigma = point.properties + body.layout.stress;
      // Passive pressure raises p' alone, and arching the vertical stress alone.
      const double both = std::min(mean_effective_stress(sigma), g > 0. ? -along(gravity / g, sigma) : 0.);
      suspect(shrinkage, 1. / ratio, ratio, name);
      if (g > 0.)
        {
          stresses.push_back({ both / (body.density * g * height), point.properties[body.layout.volume] });
          suspect(peak, stresses.back().place, both, name);
        }
      look_at_depth(body, point, name);
    });
    // Impacts of single points raise their stress by rho c v.
    const double quantile = percentile(stresses, 0.999, grid.communicator());
    const double of_ranks = Utilities::MPI::max(now[peak].value, grid.communicator());
    if (now[peak].value == of_ranks)
      suspect(stress, quantile, quantile, [this] { return now[peak].point; });
    for (const SoilBody<dim> &body : bodies)
      if (!body.is_rigid)
        look_at_dilation(body);
    if (g > 0. && walls != nullptr)
      look_at_walls(bodies);
  }


  template <int dim>
  void RunChecks<dim>::look_at_walls(const std::list<SoilBody<dim>> &bodies)
  {
    unsigned int upward = dim - 1;
    for (unsigned int a = 0; a < dim; ++a)
      if (std::abs(gravity[a]) > std::abs(gravity[upward]))
        upward = a;
    const double h = grid.cell_size();
    for_each_named(bodies, [&](const auto &body, const auto &point, const auto &name) {
      const Tensor<1, dim> start = vector_of<dim>(point.properties + body.layout.start);
      const Tensor<1, dim> way   = point.location - Point<dim>(start);
      if (way.norm() > h)
        for (unsigned int face = 0; face < 2 * dim; ++face)
          if (face / 2 != upward && !walls->is_open(face))
            {
              const double place    = (face % 2 == 0 ? grid.lower_corner() : grid.upper_corner())[face / 2];
              const double distance = std::abs(point.location[face / 2] - place);
              const double before   = std::abs(start[face / 2] - place);
              const bool has_come   = before - distance > h;
              // Soil that stands at a wall slides down along it; that it goes up shows that the wall stops it.
              const bool is_stopped = has_come || -(gravity * way) > h * gravity.norm();
              if (distance < h && (has_come || (before < h && inflow_faces.count(face) == 0)))
                suspect(is_stopped ? wall : slide, way.norm(), way.norm(), [&] {
                  return name() + ", at " + wall_text(grid, face);
                });
            }
    });
  }


  template <int dim>
  void RunChecks<dim>::look_at_dilation(const SoilBody<dim> &body)
  {
    for (const auto &cell : body.points.cells())
      {
        double volume = 0., volume_at_start = 0.;
        Point<dim> place;
        for_each_point(cell, [&](const auto &point) {
          if (mean_effective_stress(point.properties + body.layout.stress) <= 0.)
            return; // The volume of loose points is not that of the law.
          volume += point.properties[body.layout.volume];
          volume_at_start += point.properties[body.layout.mass] / body.density;
          place = point.location;
        });
        if (const double ratio = volume / volume_at_start; volume_at_start > 0.)
          suspect(dilation, ratio, ratio, [&] { return body.name + ", cell at (" + number_text(place) + ") m"; });
      }
  }


  template <int dim>
  void RunChecks<dim>::keep_suction(const std::list<WaterPhase<dim>> &water)
  {
    double largest = 0., of_a_cell = 0.; // Pa
    for (const WaterPhase<dim> &part : water)
      {
        of_a_cell = std::max(of_a_cell, part.density * gravity.norm() * grid.cell_size());
        for_each_point(part.points(), [&](const auto &point) {
          largest = std::max(largest, -point.properties[part.layout.pressure]);
        });
      }
    largest = Utilities::MPI::max(largest, grid.communicator());
    if (largest > of_a_cell)
      for (const WaterPhase<dim> &part : water)
        {
          auto &pressures = pressures_at_start.emplace_back();
          for_each_with_id(part.points(), [&](const auto &point, const auto id) {
            if (const double p = point.properties[part.layout.pressure]; p < -0.25 * largest)
              pressures[id] = p;
          });
        }
  }


  template <int dim>
  void RunChecks<dim>::look_at_suction(const std::list<WaterPhase<dim>> &water)
  {
    if (pressures_at_start.empty())
      return;
    double all = 0., without = 0., largest = 0.; // volumes; loss, Pa
    Point<dim> place;
    auto pressures = pressures_at_start.begin();
    for (const WaterPhase<dim> &part : water)
      {
        for_each_with_id(part.points(), [&](const auto &point, const auto id) {
          const auto start = pressures->find(id);
          if (start == pressures->end())
            return;
          const double volume = point.properties[part.layout.volume];
          const double loss   = point.properties[part.layout.pressure] - start->second;
          all += volume;
          without += loss > -0.5 * start->second ? volume : 0.;
          if (loss > largest)
            {
              largest = loss;
              place   = point.location;
            }
        });
        ++pressures;
      }
    pressures_at_start.clear();
    NumbersOf{ &all, &without }.sum_over_ranks(grid.communicator());
    if (largest > 0. && largest == Utilities::MPI::max(largest, grid.communicator()))
      suspect(suction, without / all, largest, [&] { return "Water at (" + number_text(place) + ") m"; });
  }


  template <int dim>
  CheckResult RunChecks<dim>::result(const unsigned int check) const
  {
    const Suspect &at     = worst[check];
    const double bound    = words[check].bound;
    const bool has_weight = has_soil && gravity.norm() > 0.;
    const bool has_walls  = has_weight && walls;
    const bool applies[]  = { true,       bed != nullptr, has_soil,  at.value > 1., has_weight,
                              has_weight, has_walls,      has_walls, has_soil,      at.value > 0. };
    if (!applies[check])
      return {};
    const std::string found = short_text(check == shrinkage && at.value <= 0. ? 1. : at.found),
                      value = short_text(check == speed ? std::max(1., at.value) : at.value);
    const auto in_words     = [&](const std::string &text) {
      using boost::algorithm::replace_all_copy;
      return replace_all_copy(replace_all_copy(text, "FOUND", found), "VALUE", value);
    };
    const Words &of_check = words[check];
    CheckResult result{
      of_check.name, in_words(of_check.value), "", at.value > bound, of_check.remedy, of_check.finding
    };
    if (!std::isinf(bound))
      result.bound = check == depth ? short_text(bound * grid.cell_size()) + " m"
                                    : short_text(check == shrinkage ? 1. / bound : bound);
    if (result.is_exceeded)
      result.where =
          at.point + (at.point.empty() ? "" : ", ") + "t = " + short_text(at.time) + " s: " + in_words(of_check.fault);
    return result;
  }


  template <int dim>
  std::vector<CheckResult> RunChecks<dim>::results() const
  {
    std::vector<CheckResult> list;
    for (const Check check : { depth, lost, wall, slide, speed, shrinkage, dilation, stress, peak, suction })
      if (const CheckResult found = result(check); has_looked && !found.name.empty())
        list.push_back(found);
    return list;
  }

  template class RunChecks<2>;
  template class RunChecks<3>;


  namespace
  {
    // Rounding stays far below the first two; doc/studies has the last.
    constexpr double bound_of_mass = 1e-6, bound_of_momentum = 1e-6, bound_of_gain = 0.005;

    constexpr double bound_of_motion = 1e-3; // doc/theory/single_phase.md

    /// Takes a value if it is larger than the worst so far, with its time, s; what is no number is largest.
    /// @return whether it was
    bool take_worse(const double value, const double time, double &worst, double &time_of_worst)
    {
      if (value <= worst)
        return false;
      worst         = std::isnan(value) ? std::numeric_limits<double>::infinity() : value;
      time_of_worst = time;
      return true;
    }
  } // namespace


  template <int dim>
  void BalanceChecks<dim>::look(const BalanceState<dim> &now)
  {
    const RunBalance<dim> &totals = now.totals;
    const Budget<dim> &balance    = totals.balance;
    const double kinetic          = mass_scaling * now.sums.kinetic;
    const double own_potential    = now.sums.potential + totals.lost_energy - totals.entered_energy;
    if (!has_start)
      {
        has_start       = true;
        soil_mass       = now.sums.moving_mass + totals.lost_mass - totals.entered_mass;
        water_mass      = now.sums.water_mass + totals.lost_water_mass - totals.entered_water_mass;
        start_kinetic   = kinetic;
        start_potential = least_potential = own_potential;
        start_elastic                     = now.sums.elastic;
        start_time = last_time = now.time;
      }
    const auto look_at_mass = [&](const double start, const double mass, const double lost, const double entered) {
      if (const double all = start + entered; all > 0.)
        take_worse(std::abs(mass + lost - entered - start) / all, now.time, mass_error, mass_time);
    };
    look_at_mass(soil_mass, now.sums.moving_mass, totals.lost_mass, totals.entered_mass);
    look_at_mass(water_mass, now.sums.water_mass, totals.lost_water_mass, totals.entered_water_mass);

    take_worse(now.momentum_residual(), now.time, momentum_residual, momentum_time);
    const double inertia = mass_scaling * (now.sums.moving_mass + now.sums.water_mass); // kg
    momentum_scale       = std::max({ momentum_scale, balance.body_impulse.norm(), std::sqrt(2. * inertia * kinetic) });

    least_potential = std::min(least_potential, own_potential);
    largest_work    = std::max(
        largest_work,
        std::abs(balance.load_work + balance.correction_work + balance.pressure_work + balance.obstacle_energy()));
    dissipation         = now.numerical_dissipation();
    largest_dissipation = std::max(largest_dissipation, dissipation);
    take_worse(largest_dissipation - dissipation, now.time, gain, gain_time);
    // Impulses of one step act at the mean of its velocities, so that only the sum over some steps is of a channel.
    if (n_looks++ % steps_between == 0)
      look_at_channels(totals, now.time);

    const double work_now = start_potential - own_potential + balance.load_work + balance.obstacle_energy();
    work_in_time += 0.5 * (work + work_now) * (now.time - last_time);
    work      = work_now;
    last_time = now.time;
    motion    = balance.motion;
  }


  template <int dim>
  void BalanceChecks<dim>::look_at_channels(const RunBalance<dim> &totals, const double time)
  {
    // What a channel gives back is a gain, too: the numerical dissipation does not show it. Plastic dissipation is
    // left out: with hardening it can fall. So are walls with an inflow: they push what enters.
    const Budget<dim> &balance = totals.balance;
    const bool has_entered     = totals.entered_mass + totals.entered_water_mass > 0.;
    std::vector<std::pair<std::string, double>> channels{ { "the walls", has_entered ? 0. : balance.wall_dissipation },
                                                          { "the bed", balance.bed_dissipation },
                                                          { "contact", balance.contact_dissipation },
                                                          { "drag", balance.drag_dissipation },
                                                          { "viscosity", balance.viscous_dissipation } };
    for (unsigned int o = 0; o < balance.obstacles.size(); ++o)
      channels.emplace_back("obstacle " + std::to_string(o + 1), balance.obstacles[o].dissipation);
    largest_of_channels.resize(channels.size(), -std::numeric_limits<double>::infinity());
    for (unsigned int c = 0; c < channels.size(); ++c)
      {
        const auto &[channel, value] = channels[c];
        largest_of_channels[c]       = std::max(largest_of_channels[c], value);
        if (take_worse(largest_of_channels[c] - value, time, channel_gain, channel_time))
          worst_channel = channel;
      }
  }


  template <int dim>
  std::vector<CheckResult> BalanceChecks<dim>::results() const
  {
    std::vector<CheckResult> list;
    if (!has_start)
      return list;
    const auto add = [&](const std::string &name, const double error, const double bound, const double time) {
      list.push_back({ name,
                       short_text(error) + (error > bound ? ", t = " + short_text(time) + " s" : ""),
                       short_text(bound),
                       error > bound,
                       "report the case as a fault of Scree: no entry should do this" });
    };
    add("mass balance", mass_error, bound_of_mass, mass_time);
    if (momentum_scale > 0.)
      add("momentum balance", momentum_residual / momentum_scale, bound_of_momentum, momentum_time);
    if (const double released = released_energy(); energy_is_closed && released > 0.)
      {
        const auto add_gain = [&](const std::string &name, const double found, const double time) {
          list.push_back(
              { name,
                short_text(100. * found / released) + " %" + (found > 0. ? ", t = " + short_text(time) + " s" : ""),
                short_text(100. * bound_of_gain) + " %",
                found > bound_of_gain * released,
                "use the default transfer and F-bar, and halve \"Courant number\"" });
        };
        add_gain("largest energy gain", gain, gain_time);
        if (channel_gain > 0.)
          add_gain("largest energy gain of " + worst_channel, channel_gain, channel_time);
        list.push_back(
            { "numerical dissipation", short_text(100. * dissipation / released) + " % of the released energy" });
      }
    const double waited = std::abs(work * (last_time - start_time) - work_in_time), share = motion / waited; // J s, -
    if (mass_scaling > 1. && (!(std::abs(work) > least_energy()) || waited == 0.))
      list.push_back({ "mean kinetic energy", "with \"Mass scaling\" not judged: hardly any work" });
    else if (mass_scaling > 1.)
      list.push_back({ "mean kinetic energy",
                       short_text(100. * share) + " % of the work, with masses times " + short_text(mass_scaling) +
                           "; " + short_text(100. * share / mass_scaling) + " % with true ones",
                       short_text(100. * bound_of_motion) + " %",
                       !(share <= bound_of_motion),
                       "use a smaller \"Mass scaling\"" });
    return list;
  }

  template class BalanceChecks<2>;
  template class BalanceChecks<3>;
} // namespace scree

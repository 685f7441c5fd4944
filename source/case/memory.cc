// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/case/case_checks.h>
#include <scree/io/progress.h>
#include <scree/seeding/seeding.h>

#include <sys/resource.h>

#include <sstream>

namespace scree
{
  using namespace dealii;

  namespace
  {
    // Measured in 2D and 3D: peaks of runs on one rank, over their numbers of cells and points, and of runs whose fine
    // cells follow their points, for which deal.II copies all of them (tests/cases/memory.py).
    constexpr double bytes_of_cell[2]          = { 1200, 1900 };
    constexpr double bytes_of_wet_cell[2]      = { 0, 5000 };  // beside that: matrix and multigrid of the pressure
    constexpr double bytes_of_pair_at_cell[2]  = { 270, 400 }; // of bodies that slide: numbers of its nodes
    constexpr double bytes_of_soil_point[2]    = { 550, 1000 };
    constexpr double bytes_of_water_point[2]   = { 400, 600 };
    constexpr double bytes_of_soil_picture[2]  = { 900, 1000 }; // of a point, in pictures that wait for the disk
    constexpr double bytes_of_water_picture[2] = { 600, 500 };
    constexpr double bytes_of_coarse_cell      = 300;
    constexpr double bytes_of_program          = 1.7e8;
    constexpr double bytes_of_solver           = 2.5e7; // for water
    constexpr double bytes_of_writer           = 1.8e7; // for pictures


    template <int dim>
    constexpr unsigned int samples_of_axis = dim == 2 ? 200 : 40;

    /// Whether a region holds the samples of the box, x first.
    /// @param plane axis and coordinate, m, to which the samples are moved; none: they stay
    template <int dim>
    std::vector<char> samples_in(const Region<dim> &region,
                                 const GridParameters &grid,
                                 const std::optional<std::pair<unsigned int, double>> &plane = {})
    {
      constexpr unsigned int n = samples_of_axis<dim>;
      std::vector<char> is_inside(Utilities::pow(n, dim));
      for (unsigned int i = 0; i < is_inside.size(); ++i)
        {
          Point<dim> x;
          for (unsigned int a = 0, rest = i; a < dim; ++a, rest /= n)
            x[a] = grid.lower_corner[a] + (grid.upper_corner[a] - grid.lower_corner[a]) * (rest % n + 0.5) / double(n);
          if (plane)
            x[plane->first] = plane->second;
          is_inside[i] = region.contains(x);
        }
      return is_inside;
    }


    /// Cells of the mesh that the samples inside stand for.
    double cells_of(const std::vector<char> &is_inside, const GridParameters &grid)
    {
      return grid.n_cells() * (std::count(is_inside.begin(), is_inside.end(), 1) / double(is_inside.size()));
    }


    /// The same with the cells of the margin around them: at most all of the box.
    template <int dim>
    double cells_around(const std::vector<char> &is_inside, const GridParameters &grid)
    {
      constexpr unsigned int n     = samples_of_axis<dim>;
      const double cells_of_sample = grid.n_cells() / is_inside.size();
      double cells                 = cells_of(is_inside, grid);
      for (unsigned int a = 0, stride = 1; a < dim; ++a, stride *= n)
        {
          const double cells_of_axis = (grid.upper_corner[a] - grid.lower_corner[a]) / grid.cell_size;
          for (unsigned int i = 0; i < is_inside.size(); ++i)
            if (i / stride % n + 1 < n && is_inside[i] != is_inside[i + stride]) // a face of the regions
              cells += (GridParameters::margin + 1) * cells_of_sample * n / cells_of_axis;
        }
      return cells > GridParameters::most_of_box * grid.n_cells() ? grid.n_cells() : cells;
    }


    /// What an inflow brings until the end of the run, m^3 (2D: per m).
    template <int dim>
    double entering_volume(const InflowParameters &inflow, const Parameters &parameters)
    {
      const Hydrograph hydrograph(inflow);
      const double end = inflow.end_time < 0 ? parameters.end_time : std::min(inflow.end_time, parameters.end_time);
      constexpr unsigned int n_parts = 200; // of the time
      double integral                = 0;
      for (unsigned int i = 0; i < n_parts; ++i)
        integral += hydrograph.integral(end * i / n_parts, end * (i + 1) / n_parts);
      if (inflow.tells_discharge())
        return integral;
      // The open area, by samples.
      const GridParameters &grid = parameters.grid;
      const Region<dim> region(entry_name(inflow.subsection, "Region"), inflow.region);
      const unsigned int axis = inflow.face_number(dim) / 2;
      const auto is_inside    = samples_in(region, grid, std::make_pair(axis, inflow.place(grid)));
      double area             = std::count(is_inside.begin(), is_inside.end(), 1) / double(is_inside.size());
      for (unsigned int a = 0; a < dim; ++a)
        area *= a == axis ? 1. : grid.upper_corner[a] - grid.lower_corner[a];
      const unsigned int sign = inflow.face_number(dim) % 2;
      return integral * area * inflow.unit_direction(dim)[axis] * (sign == 0 ? 1. : -1.);
    }


    /// The number in a file; infinity if there is none, such as "max".
    double number_in(const std::string &file)
    {
      std::ifstream in(file);
      double number = 0;
      return in >> number ? number : std::numeric_limits<double>::infinity();
    }


    /// The number after a word in a file, in the unit of the file; 0 if the word is not there.
    double number_after(const std::string &word, const std::string &file)
    {
      std::ifstream in(file);
      std::string line, name;
      while (std::getline(in, line))
        {
          std::istringstream words(line);
          double number = 0;
          if (words >> name >> number && name == word)
            return number;
        }
      return 0;
    }


    /// What a control group of either version leaves, in bytes; files that the kernel keeps in memory can go.
    double left_by_group(const std::string &folder)
    {
      const double limit   = std::min(number_in(folder + "/memory.max"), number_in(folder + "/memory.limit_in_bytes"));
      const double version = std::isfinite(number_in(folder + "/memory.current")) ? 2 : 1;
      const double used    = number_in(folder + (version == 2 ? "/memory.current" : "/memory.usage_in_bytes"));
      if (!std::isfinite(limit) || !std::isfinite(used))
        return std::numeric_limits<double>::infinity();
      const std::string kept = version == 2 ? "" : "total_";
      return limit - used + number_after(kept + "inactive_file", folder + "/memory.stat") +
             number_after(kept + "active_file", folder + "/memory.stat");
    }


    /// The least that the control groups of this process leave, in bytes.
    double left_by_groups()
    {
      double left = std::numeric_limits<double>::infinity();
      std::ifstream in("/proc/self/cgroup"); // lines such as 4:memory:/jobs/7, or 0::/jobs/7 in version 2
      std::string line;
      while (std::getline(in, line))
        {
          const auto parts = Utilities::split_string_list(line, ':');
          if (parts.size() != 3 || !(parts[1].empty() || parts[1] == "memory"))
            continue;
          const std::string root = std::string("/sys/fs/cgroup") + (parts[1].empty() ? "" : "/memory");
          std::string path       = parts[2] == "/" ? "" : parts[2];
          for (;; path.erase(path.rfind('/'))) // the limits of the groups around this one hold, too
            {
              left = std::min(left, left_by_group(root + path));
              if (path.rfind('/') == std::string::npos)
                break;
            }
        }
      return left;
    }


    /// What `ulimit -v` leaves, in bytes.
    double left_by_limit()
    {
      rlimit limit;
      if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY)
        return std::numeric_limits<double>::infinity();
      return double(limit.rlim_cur) - 1024 * number_after("VmSize:", "/proc/self/status");
    }


    /// The entry that most of the memory is for, with its subsection and value.
    std::tuple<std::string, std::string, double> largest_part(const Parameters &parameters,
                                                              const MemoryEstimate &estimate)
    {
      if (estimate.bytes_of_cells >= estimate.bytes_of_points)
        return { "Mesh", "Cell size", parameters.grid.cell_size };
      if (estimate.n_water_points > estimate.n_soil_points)
        return { "Water", "Points per cell", parameters.water.points_per_cell };
      const auto densest =
          std::max_element(parameters.bodies.begin(), parameters.bodies.end(), [](const auto &a, const auto &b) {
            return a.seeding.points_per_cell < b.seeding.points_per_cell;
          });
      return { densest->name, "Points per cell", densest->seeding.points_per_cell };
    }
  } // namespace


  template <int dim>
  MemoryEstimate estimate_memory(const Parameters &parameters)
  {
    const GridParameters &grid = parameters.grid;
    MemoryEstimate estimate;
    const double n_cells    = grid.n_cells();
    unsigned int n_halvings = 31;
    for (unsigned int a = 0; a < dim; ++a)
      while (grid.n_cells_along(a) % (1l << n_halvings) != 0)
        --n_halvings;
    const double n_coarse_cells = grid.is_adaptive() ? 0. : n_cells / std::pow(1l << n_halvings, dim);

    std::vector<char> is_inside(Utilities::pow(samples_of_axis<dim>, dim)); // any of the regions
    const auto cells_in = [&](const Region<dim> &region) {
      const std::vector<char> is_inside_this = samples_in(region, grid);
      std::transform(
          is_inside.begin(), is_inside.end(), is_inside_this.begin(), is_inside.begin(), std::logical_or<char>());
      return cells_of(is_inside_this, grid);
    };
    const auto soil = parameters.soil_regions();
    for (unsigned int i = 0; i < soil.size(); ++i)
      estimate.n_soil_points +=
          cells_in(soil[i].template places<dim>()) * std::pow(parameters.bodies[i].seeding.points_per_cell, dim);
    double n_wet_cells = 0, n_entered_water = 0;
    if (parameters.has_water)
      for (const auto &part : water_parts<dim>(parameters.water, soil))
        n_wet_cells += cells_in(part.region);
    double n_entered_cells = 0; // full of what enters
    for (const InflowParameters &inflow : parameters.inflows)
      {
        const double n_filled = entering_volume<dim>(inflow, parameters) / std::pow(grid.cell_size, dim);
        const double n_points = n_filled * std::pow(parameters.points_per_cell(inflow), dim);
        n_entered_cells += n_filled;
        n_entered_water += inflow.is_water() || inflow.is_saturated ? n_points : 0.;
        estimate.n_soil_points += inflow.is_water() ? 0. : n_points;
      }
    estimate.n_cells =
        grid.is_adaptive() ? std::min(cells_around<dim>(is_inside, grid) + n_entered_cells, n_cells) : n_cells;
    if (parameters.water.point_sets_kind() == PointSets::double_point)
      estimate.n_water_points = n_wet_cells * std::pow(parameters.water.points_per_cell, dim) + n_entered_water;

    const double n_ahead     = std::max(GridParameters::least_ahead, GridParameters::most_ahead * estimate.n_cells);
    const double n_cells_met = grid.is_adaptive() ? std::min(n_ahead, n_cells) : n_cells;
    const double n_pairs     = parameters.contact_groups().pairs.size();
    const bool has_pictures  = parameters.output.graphics_kind() != Pictures::none;
    const auto points        = [&](const double n, const double *bytes, const double *bytes_of_picture) {
      return n * (bytes[dim - 2] + (has_pictures ? bytes_of_picture[dim - 2] : 0.));
    };
    estimate.bytes_of_cells = (bytes_of_cell[dim - 2] + n_pairs * bytes_of_pair_at_cell[dim - 2]) * n_cells_met +
                              bytes_of_wet_cell[dim - 2] * n_wet_cells;
    estimate.bytes_of_points = points(estimate.n_soil_points, bytes_of_soil_point, bytes_of_soil_picture) +
                               points(estimate.n_water_points, bytes_of_water_point, bytes_of_water_picture);
    estimate.bytes_of_rank = bytes_of_program + (parameters.has_water ? bytes_of_solver : 0.) +
                             (has_pictures ? bytes_of_writer : 0.) + bytes_of_coarse_cell * n_coarse_cells;
    return estimate;
  }


  namespace
  {
    /// Bytes that this host still has for this process: what is free, and what its control groups and limits let it
    /// take.
    double available_memory()
    {
      const double free = 1024 * number_after("MemAvailable:", "/proc/meminfo");
      return std::min({ free > 0 ? free : std::numeric_limits<double>::infinity(), left_by_groups(), left_by_limit() });
    }
  } // namespace


  template <int dim>
  MemoryEstimate require_memory(const Parameters &parameters, const MPI_Comm communicator)
  {
    MemoryEstimate estimate;
    on_all_ranks(communicator, [&] { estimate = estimate_memory<dim>(parameters); });

    MPI_Comm host;
    MPI_Comm_split_type(communicator, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &host);
    const double ranks_of_host = Utilities::MPI::n_mpi_processes(host);
    MPI_Comm_free(&host);
    const double share = ranks_of_host / Utilities::MPI::n_mpi_processes(communicator);
    const double needed =
        share * (estimate.bytes_of_cells + estimate.bytes_of_points) + ranks_of_host * estimate.bytes_of_rank;
    const double available = available_memory();
    std::string fault;
    if (needed > available)
      {
        const auto [subsection, entry, value] = largest_part(parameters, estimate);
        fault                                 = entry_message({ subsection, entry, number_text(value) },
                              "the run would need about " + formatted("%.2g GB", needed / 1e9) + " of memory, for " +
                                  number_text(estimate.n_cells) + " cells and about " +
                                  number_text(estimate.n_soil_points + estimate.n_water_points) + " points, but only " +
                                  formatted("%.2g GB", available / 1e9) + " are available" +
                                  (share < 1 ? " on a host" : "") +
                                  ". Write larger cells or fewer points per cell, or use more hosts.");
      }
    throw_on_all_ranks(fault, communicator);
    return estimate;
  }

  template MemoryEstimate estimate_memory<2>(const Parameters &);
  template MemoryEstimate estimate_memory<3>(const Parameters &);
  template decltype(require_memory<2>) require_memory<2>;
  template decltype(require_memory<3>) require_memory<3>;
} // namespace scree

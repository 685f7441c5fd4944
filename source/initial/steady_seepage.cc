// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/boundary/face_entries.h>
#include <scree/initial/steady_seepage.h>
#include <scree/input/input_error.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/trilinos_precondition.h>
#include <deal.II/lac/trilinos_sparsity_pattern.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace scree
{
  using namespace dealii;

  namespace
  {
    constexpr double no_head = std::numeric_limits<double>::quiet_NaN();

    /// Coordinates of a number in a lattice of n^dim.
    template <int dim>
    std::array<unsigned int, dim> place_in_lattice(unsigned int number, const unsigned int n)
    {
      std::array<unsigned int, dim> place;
      for (unsigned int a = 0; a < dim; ++a, number /= n)
        place[a] = number % n;
      return place;
    }


    /// The head at each face of the box, m, in deal.II's numbering; NaN where none is given. Throws EntryError
    /// if there is no such face.
    std::vector<double> heads_at_faces(const SeepageStart &start, const unsigned int dim)
    {
      const std::vector<std::string> names = FaceEntries::names(dim);
      std::string list;
      for (const std::string &name : names)
        list += (list.empty() ? "" : ", ") + name;
      std::vector<double> heads(names.size(), no_head);
      for (const auto &[name, head] : start.heads())
        {
          const auto face = std::find(names.begin(), names.end(), name);
          require_entry(face != names.end() && std::isnan(heads[face - names.begin()]),
                        "Water",
                        "Heads at walls",
                        start.wall_heads,
                        "write each wall once. The walls are " + list + '.');
          heads[face - names.begin()] = head;
        }
      return heads;
    }
  } // namespace


  template <int dim>
  SeepageSurvey<dim>::SeepageSurvey(const BackgroundGrid<dim> &grid,
                                    const SeepageSoil &soil,
                                    const WaterParameters &water,
                                    const WaterBoundaryConditions<dim> &walls,
                                    const double unit_weight,
                                    const LevelSet<dim> *ground)
      : grid(grid)
      , walls(walls)
      , ground(ground)
      , unit_weight(unit_weight)
      , heads(heads_at_faces(water.seepage_start, dim))
      , conductivities(soil.conductivities)
      , reservoir_text(water.reservoir_level)
  {
    for (const SoilRegion &body : soil.bodies)
      regions.push_back(body.template places<dim>());
    if (!reservoir_text.empty())
      reservoir = parse_expression<dim>(entry_name("Water", "Reservoir level"), reservoir_text, 1);
  }


  template <int dim>
  double SeepageSurvey<dim>::level(const Point<dim> &x) const
  {
    return reservoir ? reservoir->value(x) : no_head;
  }


  template <int dim>
  int SeepageSurvey<dim>::kind(const Point<dim> &x) const
  {
    if (ground != nullptr && !ground->is_open(x))
      return closed;
    for (unsigned int i = 0; i < regions.size(); ++i)
      if (regions[i].contains(x))
        return conductivities[i] > 0. ? int(i) : closed;
    return air;
  }


  template <int dim>
  bool SeepageSurvey<dim>::is_beyond(const Point<dim> &x, const unsigned int face) const
  {
    const unsigned int a = face / 2;
    return face % 2 == 0 ? x[a] < grid.lower_corner()[a] : x[a] > grid.upper_corner()[a];
  }


  template <int dim>
  bool SeepageSurvey<dim>::look_at(const Point<dim> &corner, std::array<int, n_around> &kinds) const
  {
    const double width   = grid.cell_size() / Cell::n_1d;
    const auto centre_of = [&](const unsigned int part) {
      Point<dim> x = corner;
      for (unsigned int a = 0; a < dim; ++a)
        x[a] += width * (place_in_lattice<dim>(part, n_wide)[a] - 0.5);
      return x;
    };
    const auto kind_of = [&](const unsigned int part) {
      const Point<dim> x = centre_of(part);
      bool is_in_box     = true;
      for (unsigned int f = 0; f < 2 * dim; ++f)
        is_in_box = is_in_box && !is_beyond(x, f);
      return is_in_box ? kind(x) : closed; // Walls are looked at apart.
    };
    // In space, where there are many parts, a cell with the same kind at its corners and in the middle is not
    // divided.
    if constexpr (dim == 3)
      {
        const int middle = kind_of(n_around / 2);
        bool is_one      = true;
        for (unsigned int v = 0; v < (1 << dim) && is_one; ++v)
          {
            unsigned int part = 0;
            for (unsigned int a = 0, step = 1; a < dim; ++a, step *= n_wide)
              part += (v >> a & 1) * (n_wide - 1) * step;
            is_one = kind_of(part) == middle;
          }
        if (is_one)
          {
            kinds.fill(middle);
            return middle >= 0;
          }
      }
    bool has_soil = false;
    for (unsigned int part = 0; part < n_around; ++part)
      {
        kinds[part]      = kind_of(part);
        const auto place = place_in_lattice<dim>(part, n_wide);
        has_soil         = has_soil || (kinds[part] >= 0 && std::all_of(place.begin(), place.end(), [](const auto i) {
                                  return i > 0 && i <= Cell::n_1d;
                                }));
      }
    return has_soil;
  }


  template <int dim>
  void SeepageSurvey<dim>::find(std::vector<SeepageCell<dim>> &cells, std::vector<SeepageFace<dim>> &faces) const
  {
    std::array<int, n_around> kinds;
    for (const auto &fine : grid.fine_cells().cells())
      {
        const Point<dim> corner = grid.fine_cells().box().corner(fine.place);
        if (!grid.fine_cells().is_owned(fine) || !look_at(corner, kinds))
          continue;
        Cell cell{ fine.index, corner, {} };
        for (unsigned int q = 0; q < Cell::n_parts; ++q)
          {
            unsigned int part = 0;
            for (unsigned int a = 0, step = 1; a < dim; ++a, step *= n_wide)
              part += (place_in_lattice<dim>(q, Cell::n_1d)[a] + 1) * step;
            cell.conductivity[q] = kinds[part] >= 0 ? conductivities[kinds[part]] : 0.;
          }
        add_free_faces(kinds, corner, cells.size(), faces);
        add_faces_at_walls(kinds, corner, cells.size(), faces);
        cells.push_back(cell);
      }
  }


  namespace
  {
    /// Calls visit(part, axis, side, neighbour) for the parts of a cell with soil and the parts beside them.
    template <int dim, typename Kinds, typename Visit>
    void for_sides_of_soil(const Kinds &kinds, const Visit &visit)
    {
      constexpr unsigned int n_1d = SeepageCell<dim>::n_1d, n_wide = n_1d + 2;
      for (unsigned int part = 0; part < kinds.size(); ++part)
        {
          const auto place   = place_in_lattice<dim>(part, n_wide);
          const bool is_cell = std::all_of(place.begin(), place.end(), [](const auto i) { return i > 0 && i <= n_1d; });
          if (!is_cell || kinds[part] < 0)
            continue;
          for (unsigned int a = 0, step = 1; a < dim; ++a, step *= n_wide)
            for (unsigned int side = 0; side < 2; ++side)
              visit(place, kinds[part], a, side, side == 0 ? part - step : part + step);
        }
    }

    template <int dim>
    Point<dim> place_in_cell(const Point<dim> &x, const Point<dim> &corner, const double width)
    {
      Point<dim> place;
      for (unsigned int a = 0; a < dim; ++a)
        place[a] = std::clamp((x[a] - corner[a]) / width, 0., 1.);
      return place;
    }

    /// Middle of a side of a part, m.
    template <int dim>
    Point<dim> side_of_part(const std::array<unsigned int, dim> &place,
                            const unsigned int axis,
                            const unsigned int side,
                            const Point<dim> &corner,
                            const double width)
    {
      Point<dim> x = corner;
      for (unsigned int a = 0; a < dim; ++a)
        x[a] += width * (place[a] - (a == axis ? 1. - side : 0.5));
      return x;
    }
  } // namespace


  template <int dim>
  void SeepageSurvey<dim>::add_free_faces(const std::array<int, n_around> &kinds,
                                          const Point<dim> &corner,
                                          const unsigned int cell,
                                          std::vector<SeepageFace<dim>> &faces) const
  {
    constexpr double least_flatness = 0.6; // area of the plane over that of the steps, of one plane at most sqrt(dim)
    struct Step
    {
      Point<dim> x;
      unsigned int axis;
      double conductivity;
    };
    const double width = grid.cell_size() / Cell::n_1d;
    std::vector<Step> steps;
    Tensor<1, dim> normal, sum;
    for_sides_of_soil<dim>(
        kinds,
        [&](const auto &place, const int body, const unsigned int a, const unsigned int side, const unsigned int next) {
          if (kinds[next] != air)
            return;
          steps.push_back({ side_of_part<dim>(place, a, side, corner, width), a, conductivities[body] });
          normal[a] += side == 0 ? -1. : 1.;
          sum += steps.back().x - corner;
        });
    if (steps.empty())
      return;
    // The steps of an oblique face lie around a plane: their faces go there.
    const bool is_plane = normal.norm() > least_flatness * steps.size();
    if (is_plane)
      normal /= normal.norm();
    const Point<dim> middle = corner + sum / double(steps.size());
    const double area = Utilities::fixed_power<dim - 1>(width), top = grid.upper_corner()[dim - 1];
    for (const Step &step : steps)
      {
        const double share = is_plane ? std::abs(normal[step.axis]) : 1.;
        const Point<dim> x = is_plane ? step.x - ((step.x - middle) * normal) * normal : step.x;
        const double water = level(x);
        if (water > top + 1e-6 * width)
          throw ValueError(entry_message("Water",
                                         "Reservoir level",
                                         reservoir_text,
                                         "it is above the box of subsection Mesh at " + number_text(x) +
                                             " m. Write a larger box, or a level up to " + number_text(top) + " m."));
        faces.push_back({ cell,
                          x,
                          place_in_cell(x, corner, grid.cell_size()),
                          area * share,
                          step.conductivity,
                          x[dim - 1] < water ? water : no_head });
      }
  }


  template <int dim>
  std::optional<double> SeepageSurvey<dim>::head_of_wall(const unsigned int face, const double height) const
  {
    const bool has_head = !std::isnan(heads[face]);
    if (has_head && height < heads[face])
      return heads[face];
    if (!walls.is_drained(face))
      return {};
    if (has_head)
      return no_head; // Above it water may leave.
    const double pressure = walls.pressure(1u << face);
    return pressure == 0. ? no_head : height + pressure / unit_weight;
  }


  template <int dim>
  void SeepageSurvey<dim>::add_faces_at_walls(const std::array<int, n_around> &kinds,
                                              const Point<dim> &corner,
                                              const unsigned int cell,
                                              std::vector<SeepageFace<dim>> &faces) const
  {
    const double width = grid.cell_size() / Cell::n_1d, area = Utilities::fixed_power<dim - 1>(width);
    for_sides_of_soil<dim>(
        kinds,
        [&](const auto &place, const int body, const unsigned int a, const unsigned int side, const unsigned int) {
          const Point<dim> x = side_of_part<dim>(place, a, side, corner, width);
          Point<dim> beyond  = x;
          beyond[a] += side == 0 ? -width / 2 : width / 2;
          if (!is_beyond(beyond, 2 * a + side))
            return;
          if (const auto head = head_of_wall(2 * a + side, x[dim - 1]))
            faces.push_back({ cell, x, place_in_cell(x, corner, grid.cell_size()), area, conductivities[body], *head });
        });
  }

  template class SeepageSurvey<2>;
  template class SeepageSurvey<3>;


  std::string SeepageReport::text(const unsigned int dim) const
  {
    const std::string unit = dim == 2 ? " m^2/s" : " m^3/s";
    return "Steady seepage: " + number_text(inflow) + unit + " in, " + number_text(outflow_in_air) +
           " out through faces in air" + (std::isnan(exit_height) ? "" : " up to " + number_text(exit_height) + " m") +
           ", " + number_text(outflow_below) + " out below given heads; " + std::to_string(n_iterations) +
           " iterations" + (has_converged ? "" : ", not converged. Use the pressure with care");
  }


  template <int dim>
  SeepageField<dim>::SeepageField(const CellsOfBox<dim> &box,
                                  const CellPlace<dim> &first,
                                  const CellPlace<dim> &n,
                                  std::vector<double> values,
                                  const SeepageReport &report)
      : report(report)
      , box(box)
      , first(first)
      , n(n)
      , values(std::move(values))
  {
  }


  template <int dim>
  std::pair<double, Tensor<1, dim>> SeepageField<dim>::pressure_head(const Point<dim> &x) const
  {
    const CellPlace<dim> cell = box.place_near(x);
    const Point<dim> corner   = box.corner(cell);
    std::pair<double, Tensor<1, dim>> result;
    for (unsigned int v = 0; v < (1 << dim); ++v)
      {
        std::size_t number = 0, step = 1;
        double shape = 1.;
        Tensor<1, dim> gradient;
        for (unsigned int a = 0; a < dim; ++a)
          gradient[a] = 1. / box.width;
        for (unsigned int a = 0; a < dim; ++a)
          {
            const bool is_upper = v >> a & 1;
            const int place     = cell[a] + is_upper - first[a];
            if (place < 0 || place >= n[a])
              return { std::numeric_limits<double>::quiet_NaN(), {} };
            number += place * step;
            step *= n[a];
            const double part = std::clamp((x[a] - corner[a]) / box.width, 0., 1.);
            const double hat  = is_upper ? part : 1. - part;
            shape *= hat;
            for (unsigned int b = 0; b < dim; ++b)
              gradient[b] *= b != a ? hat : is_upper ? 1. : -1.;
          }
        result.first += shape * values[number];
        result.second += values[number] * gradient;
      }
    return result;
  }


  template <int dim>
  bool SeepageField<dim>::is_open(const Point<dim> &x) const
  {
    return !(pressure_head(x).first >= 0.);
  }


  template <int dim>
  SurfaceView<dim> SeepageField<dim>::view(const Point<dim> &x, const double reach) const
  {
    const auto [head, gradient] = pressure_head(x);
    const double slope          = gradient.norm();
    if (std::isnan(head) || !(slope > 0.))
      return { std::isnan(head) || head < 0. ? reach : -reach, Point<dim>::unit_vector(dim - 1) };
    return { std::clamp(-head / slope, -reach, reach), -gradient / slope };
  }

  template class SeepageField<2>;
  template class SeepageField<3>;


  namespace
  {
    constexpr double normal_gravity   = 9.81; // m/s^2, of the conductivities
    constexpr double dry_conductivity = 1e-3; // over that of full pores
    constexpr double width_of_surface = 1.;   // cells over which the conductivity falls, about pressure 0
    constexpr double face_conductance = 20.;  // of a face over that of a cell: how sharply a head is prescribed
    constexpr double closed_share   = 1e-11; // of the smallest one, where water does not leave: for soil without a head
    constexpr double largest_change = 1e-4;  // of the head at the end, over the cell's width
    constexpr unsigned int most_solves = 500;
  } // namespace


  template <int dim>
  SteadySeepage<dim>::SteadySeepage(const BackgroundGrid<dim> &grid, const SeepageSurvey<dim> &survey)
      : grid(grid)
      , vertices(Basis::linear)
  {
    on_all_ranks(grid.communicator(), [&] { survey.find(cells, faces); });
    double highest = -std::numeric_limits<double>::infinity();
    for (const SeepageFace<dim> &face : faces)
      if (!std::isnan(face.head))
        highest = std::max(highest, face.head);
    highest = Utilities::MPI::max(highest, grid.communicator());
    require_entry(std::isfinite(highest),
                  "Water",
                  "Steady seepage",
                  "true",
                  "no soil lies beside a given head. Look at \"Reservoir level\", \"Heads at walls\" and the regions.");
    for (const SeepageFace<dim> &face : faces)
      smallest_conductivity = std::min(smallest_conductivity, face.conductivity);
    smallest_conductivity = Utilities::MPI::min(smallest_conductivity, grid.communicator());
    vertices.distribute(grid.fine_cells());
    heads.reinit(vertices.partitioner());
    scales.reinit(vertices.partitioner());
    heads = highest;
    relative.resize(cells.size());
    for (auto &parts : relative)
      parts.fill(1.);
    is_leaving.assign(faces.size(), false);

    integrate_parts();
    number_rows();
    make_pattern();
  }


  template <int dim>
  typename SteadySeepage<dim>::Shape SteadySeepage<dim>::hats(const Point<dim> &place)
  {
    Shape shape;
    for (unsigned int v = 0; v < n_vertices; ++v)
      {
        shape[v] = 1.;
        for (unsigned int a = 0; a < dim; ++a)
          shape[v] *= v >> a & 1 ? place[a] : 1. - place[a];
      }
    return shape;
  }


  template <int dim>
  void SteadySeepage<dim>::integrate_parts()
  {
    const double volume = Utilities::fixed_power<dim>(grid.cell_size()) / Cell::n_parts;
    for (unsigned int q = 0; q < Cell::n_parts; ++q)
      {
        Point<dim> x;
        for (unsigned int a = 0, rest = q; a < dim; ++a, rest /= Cell::n_1d)
          x[a] = (rest % Cell::n_1d + 0.5) / Cell::n_1d;
        shapes[q] = hats(x);
        std::array<Tensor<1, dim>, n_vertices> gradients;
        for (unsigned int a = 0; a < dim; ++a)
          {
            Point<dim> lower = x, upper = x;
            lower[a]           = 0.;
            upper[a]           = 1.;
            const Shape before = hats(lower), behind = hats(upper);
            for (unsigned int v = 0; v < n_vertices; ++v)
              gradients[v][a] = (behind[v] - before[v]) / grid.cell_size();
          }
        for (unsigned int v = 0; v < n_vertices; ++v)
          for (unsigned int w = 0; w < n_vertices; ++w)
            laplacian[q][v][w] = volume * (gradients[v] * gradients[w]);
      }
  }


  template <int dim>
  void SteadySeepage<dim>::number_rows()
  {
    const MPI_Comm communicator = grid.communicator();
    rows.reinit(vertices.partitioner());
    for (const Cell &cell : cells)
      for (unsigned int v = 0; v < n_vertices; ++v)
        rows.local_element(vertices.nodes(cell.index)[v]) += 1.;
    rows.compress(VectorOperation::add);
    const auto begin = rows.begin(), end = begin + vertices.n_owned();
    const auto is_marked = [](const double mark) { return mark > 0.; };
    // Trilinos needs a row of every rank.
    AssertThrow(vertices.n_owned() > 0, ExcMessage("A rank has no nodes. Use fewer ranks."));
    has_no_soil = std::none_of(begin, end, is_marked);
    if (has_no_soil)
      *begin = 1.;
    const IndexSet owned = Utilities::MPI::create_ascending_partitioning(
        communicator, std::count_if(begin, end, is_marked))[Utilities::MPI::this_mpi_process(communicator)];
    auto next = owned.begin();
    for (auto mark = begin; mark != end; ++mark)
      *mark = is_marked(*mark) ? double(*next++) : -1.;
    rows.update_ghost_values();
    source.reinit(owned, communicator);
    solution.reinit(owned, communicator);
  }


  template <int dim>
  void SteadySeepage<dim>::make_pattern()
  {
    const IndexSet owned = source.locally_owned_elements();
    TrilinosWrappers::SparsityPattern pattern(owned, grid.communicator(), Utilities::pow(3, dim));
    for (const auto row : owned)
      pattern.add(row, row);
    for (const Cell &cell : cells)
      for (unsigned int v = 0; v < n_vertices; ++v)
        for (unsigned int w = 0; w < n_vertices; ++w)
          pattern.add(row(vertices.nodes(cell.index)[v]), row(vertices.nodes(cell.index)[w]));
    pattern.compress();
    matrix.reinit(pattern);
  }


  template <int dim>
  double SteadySeepage<dim>::head_at(const SeepageFace<dim> &face) const
  {
    const Shape shape         = hats(face.place);
    const unsigned int *nodes = vertices.nodes(cells[face.cell].index);
    double head               = 0.;
    for (unsigned int v = 0; v < n_vertices; ++v)
      head += shape[v] * heads.local_element(nodes[v]);
    return head;
  }


  template <int dim>
  double SteadySeepage<dim>::head_beyond(const SeepageFace<dim> &face)
  {
    return std::isnan(face.head) ? face.location[dim - 1] : face.head;
  }


  template <int dim>
  double SteadySeepage<dim>::conductance(const unsigned int face) const
  {
    const bool is_open = !std::isnan(faces[face].head) || is_leaving[face];
    return face_conductance / grid.cell_size() * faces[face].area *
           (is_open ? faces[face].conductivity : closed_share * smallest_conductivity);
  }


  template <int dim>
  void SteadySeepage<dim>::assemble()
  {
    std::vector<CellMatrix> own(cells.size());
    for (unsigned int c = 0; c < cells.size(); ++c)
      for (unsigned int q = 0; q < Cell::n_parts; ++q)
        for (unsigned int v = 0; v < n_vertices; ++v)
          for (unsigned int w = 0; w < n_vertices; ++w)
            own[c][v][w] += cells[c].conductivity[q] * relative[c][q] * laplacian[q][v][w];
    VertexVector sources(vertices.partitioner());
    for (unsigned int f = 0; f < faces.size(); ++f)
      {
        const SeepageFace<dim> &face = faces[f];
        const Shape shape            = hats(face.place);
        const unsigned int *nodes    = vertices.nodes(cells[face.cell].index);
        for (unsigned int v = 0; v < n_vertices; ++v)
          {
            sources.local_element(nodes[v]) += conductance(f) * shape[v] * head_beyond(face);
            for (unsigned int w = 0; w < n_vertices; ++w)
              own[face.cell][v][w] += conductance(f) * shape[v] * shape[w];
          }
      }
    sources.compress(VectorOperation::add);

    // Rows are scaled, so that soil of low conductivity counts as much as the other.
    scales = 0.;
    for (unsigned int c = 0; c < cells.size(); ++c)
      for (unsigned int v = 0; v < n_vertices; ++v)
        scales.local_element(vertices.nodes(cells[c].index)[v]) += own[c][v][v];
    scales.compress(VectorOperation::add);
    for (double &scale : scales)
      scale = scale > 0. ? 1. / std::sqrt(scale) : 1.;
    scales.update_ghost_values();

    matrix = 0.;
    for (unsigned int c = 0; c < cells.size(); ++c)
      {
        const unsigned int *nodes = vertices.nodes(cells[c].index);
        for (unsigned int v = 0; v < n_vertices; ++v)
          for (unsigned int w = 0; w < n_vertices; ++w)
            matrix.add(row(nodes[v]),
                       row(nodes[w]),
                       scales.local_element(nodes[v]) * scales.local_element(nodes[w]) * own[c][v][w]);
      }
    if (has_no_soil)
      matrix.add(row(0), row(0), 1.);
    matrix.compress(VectorOperation::add);
    unsigned int next = 0; // rows are in the order of the vertices
    for (unsigned int vertex = 0; vertex < vertices.n_owned(); ++vertex)
      if (rows.local_element(vertex) >= 0.)
        {
          const double scale = scales.local_element(vertex);
          source.local_element(next) =
              has_no_soil ? heads.local_element(vertex) : scale * sources.local_element(vertex);
          solution.local_element(next++) = heads.local_element(vertex) / scale;
        }
  }


  template <int dim>
  double SteadySeepage<dim>::solve_system()
  {
    assemble();
    TrilinosWrappers::PreconditionAMG multigrid;
    multigrid.initialize(matrix);
    constexpr unsigned int most_iterations = 2000;
    constexpr double tolerance             = 1e-10;
    SolverControl control(most_iterations, tolerance * source.l2_norm());
    try
      {
        SolverCG<VertexVector>(control).solve(matrix, solution, source, multigrid);
      }
    catch (const SolverControl::NoConvergence &)
      {
        require_entry(false,
                      "Water",
                      "Steady seepage",
                      "true",
                      "the flow has not been found in " + std::to_string(most_iterations) +
                          " iterations. Look at the conductivities of the bodies, or write a \"Phreatic surface\".");
      }

    heads.zero_out_ghost_values();
    double change     = 0.;
    unsigned int next = 0;
    for (unsigned int vertex = 0; vertex < vertices.n_owned(); ++vertex)
      if (rows.local_element(vertex) >= 0.)
        {
          const double head           = scales.local_element(vertex) * solution.local_element(next++);
          change                      = std::max(change, std::abs(head - heads.local_element(vertex)));
          heads.local_element(vertex) = head;
        }
    heads.update_ghost_values();
    return Utilities::MPI::max(change, grid.communicator());
  }


  template <int dim>
  void SteadySeepage<dim>::update_conductivities(const double share)
  {
    const double width = width_of_surface * grid.cell_size();
    for (unsigned int c = 0; c < cells.size(); ++c)
      {
        const unsigned int *nodes = vertices.nodes(cells[c].index);
        for (unsigned int q = 0; q < Cell::n_parts; ++q)
          {
            double pressure_head = 0.;
            for (unsigned int v = 0; v < n_vertices; ++v)
              pressure_head += shapes[q][v] * (heads.local_element(nodes[v]) - vertices.position(nodes[v])[dim - 1]);
            const double filled = std::clamp(0.5 + pressure_head / width, 0., 1.);
            const double wanted = dry_conductivity + (1. - dry_conductivity) * filled;
            relative[c][q] *= std::pow(wanted / relative[c][q], share);
          }
      }
  }


  template <int dim>
  bool SteadySeepage<dim>::update_faces()
  {
    bool has_changed = false;
    for (unsigned int f = 0; f < faces.size(); ++f)
      if (std::isnan(faces[f].head))
        {
          const char leaves = head_at(faces[f]) > faces[f].location[dim - 1];
          has_changed       = has_changed || leaves != is_leaving[f];
          is_leaving[f]     = leaves;
        }
    return Utilities::MPI::max(int(has_changed), grid.communicator()) == 1;
  }


  template <int dim>
  std::shared_ptr<const SeepageField<dim>> SteadySeepage<dim>::solve(const double gravity)
  {
    constexpr unsigned int fewest = 4;
    unsigned int n                = 0;
    bool has_converged            = false;
    SeepageDamping damping;
    while (!has_converged && n < most_solves)
      {
        const double change = solve_system();
        const bool turned   = update_faces();
        has_converged       = ++n >= fewest && !turned && change < largest_change * grid.cell_size();
        if (n == 1)
          update_conductivities(1.);
        else if (!has_converged)
          update_conductivities(damping.share(change));
      }
    SeepageReport result               = report(gravity / normal_gravity);
    result.n_iterations                = n;
    constexpr double largest_imbalance = 0.01; // of the inflow
    result.has_converged = has_converged && std::abs(result.inflow - result.outflow_in_air - result.outflow_below) <=
                                                largest_imbalance * result.inflow;
    return field(result);
  }


  template <int dim>
  SeepageReport SteadySeepage<dim>::report(const double scale) const
  {
    const double resolution = 1e-3 * grid.cell_size(); // of heads that count as one: that of one reservoir
    SeepageReport report;
    std::map<long, double> out_to; // flow by heads
    double highest = -std::numeric_limits<double>::infinity();
    for (unsigned int f = 0; f < faces.size(); ++f)
      {
        const double flow = scale * conductance(f) * (head_at(faces[f]) - head_beyond(faces[f]));
        if (!std::isnan(faces[f].head))
          out_to[std::lround(faces[f].head / resolution)] += flow;
        else if (is_leaving[f])
          {
            report.outflow_in_air += flow;
            highest = std::max(highest, faces[f].location[dim - 1]);
          }
      }
    std::map<long, double> of_all;
    for (const auto &of_rank : Utilities::MPI::all_gather(grid.communicator(), out_to))
      for (const auto &[head, flow] : of_rank)
        of_all[head] += flow;
    for (const auto &[head, flow] : of_all)
      (flow > 0. ? report.outflow_below : report.inflow) += std::abs(flow);
    report.outflow_in_air = Utilities::MPI::sum(report.outflow_in_air, grid.communicator());
    highest               = Utilities::MPI::max(highest, grid.communicator());
    report.exit_height    = std::isfinite(highest) ? highest : std::numeric_limits<double>::quiet_NaN();
    return report;
  }


  template <int dim>
  std::shared_ptr<const SeepageField<dim>> SteadySeepage<dim>::field(const SeepageReport &report) const
  {
    const MPI_Comm communicator = grid.communicator();
    const CellsOfBox<dim> &box  = grid.fine_cells().box();
    std::vector<int> lower(dim, std::numeric_limits<int>::max()), upper(dim, 0); // of the cells; MPI reduces no arrays
    for (const Cell &cell : cells)
      for (unsigned int a = 0; a < dim; ++a)
        {
          const int place = box.place_of_corner(cell.corner)[a];
          lower[a]        = std::min(lower[a], place);
          upper[a]        = std::max(upper[a], place);
        }
    Utilities::MPI::min(lower, communicator, lower);
    Utilities::MPI::max(upper, communicator, upper);
    CellPlace<dim> first, n;
    std::size_t n_all = 1;
    for (unsigned int a = 0; a < dim; ++a)
      {
        first[a] = lower[a];
        n[a]     = upper[a] - lower[a] + 2;
        n_all *= n[a];
      }
    std::vector<double> values(n_all, 0.), counts(n_all, 0.);
    for (unsigned int vertex = 0; vertex < vertices.n_owned() && !has_no_soil; ++vertex)
      if (rows.local_element(vertex) >= 0.)
        {
          const Point<dim> &x        = vertices.position(vertex);
          const CellPlace<dim> place = box.place_of_corner(x);
          std::size_t number = 0, step = 1;
          for (unsigned int a = 0; a < dim; ++a, step *= n[a - 1])
            number += (place[a] - first[a]) * step;
          values[number] = heads.local_element(vertex) - x[dim - 1];
          counts[number] = 1.;
        }
    Utilities::MPI::sum(values, communicator, values);
    Utilities::MPI::sum(counts, communicator, counts);
    for (std::size_t i = 0; i < n_all; ++i)
      if (counts[i] == 0.)
        values[i] = std::numeric_limits<double>::quiet_NaN();
    return std::make_shared<const SeepageField<dim>>(box, first, n, std::move(values), report);
  }

  template class SteadySeepage<2>;
  template class SteadySeepage<3>;
} // namespace scree

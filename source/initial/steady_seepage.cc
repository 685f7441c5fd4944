// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/initial/seepage_damping.h>
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

  template class SteadySeepage<2>;
  template class SteadySeepage<3>;
} // namespace scree

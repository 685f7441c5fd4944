// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/initial/steady_seepage.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/la_parallel_vector.h>
#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/trilinos_precondition.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_sparsity_pattern.h>

namespace scree
{
  using namespace dealii;

  namespace
  {
    constexpr double no_head          = std::numeric_limits<double>::quiet_NaN();
    constexpr double normal_gravity   = 9.81; // m/s^2, of the conductivities
    constexpr double dry_conductivity = 1e-3; // over that of full pores
    constexpr double width_of_surface = 1.;   // cells over which the conductivity falls, about pressure 0
    constexpr double face_conductance = 20.;  // of a face over that of a cell: how sharply a head is prescribed
    constexpr double closed_share   = 1e-11; // of the smallest one, where water does not leave: for soil without a head
    constexpr double largest_change = 1e-4;  // of the head at the end, over the cell's width
    constexpr unsigned int most_solves = 500;


    /// The head at each face of the box, m, in deal.II's numbering; NaN where none is given. Throws EntryError
    /// if there is no such face.
    std::vector<double> heads_at_faces(const WaterParameters &water, const unsigned int dim)
    {
      const std::vector<std::string> names = FaceEntries::names(dim);
      std::vector<double> heads(names.size(), no_head);
      for (const auto &[name, head] : water.heads_at_walls())
        {
          const auto face = std::find(names.begin(), names.end(), name);
          require_entry(face != names.end() && std::isnan(heads[face - names.begin()]),
                        { "Water", "Heads at walls", water.wall_heads },
                        "write each wall once. The walls are " + boost::algorithm::join(names, ", ") + '.');
          heads[face - names.begin()] = head;
        }
      return heads;
    }


    /// How far the conductivity follows the pressure in an iteration: less and less while the changes of the head do
    /// not fall. Soil that water crosses without filling it needs that.
    class Damping
    {
    public:
      /// The share of the way after an iteration with the largest change of the head, m.
      double share(const double change)
      {
        constexpr double progress = 0.9, factor = 0.7, least = 0.005;
        constexpr unsigned int patience = 5; // iterations without progress
        n_without                       = change < progress * best ? 0 : n_without + 1;
        if (n_without == 0 || n_without == patience)
          best = change;
        if (n_without == patience)
          {
            current   = std::max(least, factor * current);
            n_without = 0;
          }
        return current;
      }

    private:
      double current         = 0.5;
      double best            = std::numeric_limits<double>::max(); // m
      unsigned int n_without = 0;
    };


    /// Steady flow of water through soil, div(k_r k grad phi) = 0 with the head phi, by bilinear elements on the cells
    /// with soil. Above the free surface the conductivity falls to next to nothing (@source{bathe1979}); at faces in
    /// air water leaves where its pressure would be positive, and does not enter. Both are found by iterations.
    template <int dim>
    class SteadySeepage
    {
    public:
      /// Takes the soil from the survey. Collective; throws EntryError if no soil touches a given head.
      explicit SteadySeepage(const SeepageSurvey<dim> &survey)
          : survey(survey)
          , grid(survey.grid)
          , communicator(grid.communicator())
          , element(1)
          , dofs(grid.triangulation())
          , parts(QMidpoint<1>(), n_1d)
      {
        dofs.distribute_dofs(element);
        on_all_ranks(communicator, [&] { find_soil(); });
        double highest = -std::numeric_limits<double>::infinity();
        for (const Face &face : faces)
          {
            smallest_conductivity = std::min(smallest_conductivity, face.conductivity);
            if (!std::isnan(face.head))
              highest = std::max(highest, face.head);
          }
        highest               = Utilities::MPI::max(highest, communicator);
        smallest_conductivity = Utilities::MPI::min(smallest_conductivity, communicator);
        require_entry(std::isfinite(highest),
                      { "Water", "Steady seepage", "true" },
                      "no soil lies beside a given head. Look at \"Reservoir level\", \"Heads at walls\" and the "
                      "regions.");
        make_system();
        heads = highest;
      }

      /// Iterates until nothing changes. Collective.
      std::shared_ptr<const SeepageField<dim>> solve(const double gravity)
      {
        constexpr unsigned int fewest = 4;
        unsigned int n                = 0;
        bool has_converged            = false;
        Damping damping;
        while (!has_converged && n < most_solves)
          {
            assemble();
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
        result.has_converged               = has_converged && std::abs(result.inflow - result.outflow_in_air -
                                                         result.outflow_below) <= largest_imbalance * result.inflow;
        return field(result);
      }

    private:
      using Vector                             = LinearAlgebra::distributed::Vector<double>;
      static constexpr unsigned int n_vertices = 1 << dim;
      static constexpr unsigned int n_1d       = dim == 2 ? 4 : 3; // parts of a cell along an axis
      static constexpr unsigned int n_parts    = Utilities::pow(n_1d, dim);

      /// A cell with soil, divided into equal parts.
      struct Cell
      {
        Point<dim> corner; // lower one, m
        std::vector<types::global_dof_index> dofs;
        std::array<double, n_parts> conductivity; // m/s; 0 outside the soil
        std::array<double, n_parts> relative;     // conductivity over that of full pores
      };

      /// A piece of the soil's surface that water can cross.
      struct Face
      {
        unsigned int cell;   // in the list of cells
        Point<dim> location; // m
        double area;         // m^2 (2D: m)
        double conductivity; // of the soil, m/s
        double head;         // that is given, m; NaN in air, where water only leaves
        bool is_leaving = false;
      };

      static std::array<int, dim> place_in_lattice(unsigned int part)
      {
        std::array<int, dim> place;
        for (unsigned int a = 0; a < dim; ++a, part /= n_1d)
          place[a] = part % n_1d;
        return place;
      }

      /// The middle of a part of the cell with this lower corner, or of one beside the cell.
      Point<dim> middle_of(const Point<dim> &corner, const std::array<int, dim> &part) const
      {
        Point<dim> x = corner;
        for (unsigned int a = 0; a < dim; ++a)
          x[a] += grid.cell_size() / n_1d * (part[a] + 0.5);
        return x;
      }

      /// Whether a cell is not to be divided: in space, where there are many parts, that with the same kind in the
      /// middle and at the corners of the parts around it.
      bool is_uniform(const Point<dim> &corner) const
      {
        if (dim == 2)
          return false;
        const int middle = survey.kind(middle_of(corner, place_in_lattice(n_parts / 2)));
        std::array<int, dim> part;
        for (unsigned int v = 0; v < n_vertices; ++v)
          {
            for (unsigned int a = 0; a < dim; ++a)
              part[a] = v >> a & 1 ? n_1d : -1;
            if (survey.kind(middle_of(corner, part)) != middle)
              return false;
          }
        return true;
      }

      /// Lists the cells of this rank with soil, by the centres of their parts, and their faces.
      void find_soil()
      {
        const auto &box = grid.fine_cells().box();
        std::array<int, n_parts> kinds;
        for (const auto &of_mesh : dofs.active_cell_iterators())
          if (of_mesh->is_locally_owned() && holds_nodes(of_mesh))
            {
              Cell cell{ box.corner(box.place_of_corner(of_mesh->vertex(0))), {}, {}, {} };
              const bool is_whole = is_uniform(cell.corner);
              for (unsigned int q = 0; q < n_parts; ++q)
                kinds[q] = survey.kind(middle_of(cell.corner, place_in_lattice(is_whole ? n_parts / 2 : q)));
              if (*std::max_element(kinds.begin(), kinds.end()) < 0)
                continue;
              cell.dofs.resize(n_vertices);
              of_mesh->get_dof_indices(cell.dofs);
              cell.relative.fill(1.);
              std::transform(kinds.begin(), kinds.end(), cell.conductivity.begin(), [&](const int kind) {
                return conductivity(kind);
              });
              if (!is_whole)
                add_faces(kinds, cell.corner);
              cells.push_back(cell);
            }
      }

      double conductivity(const int kind) const
      {
        return kind >= 0 ? survey.soil.conductivities[kind] : 0.;
      }

      /// Appends the faces of a cell in air, and those at walls of the box with a head, or drained.
      void add_faces(const std::array<int, n_parts> &kinds, const Point<dim> &corner)
      {
        constexpr double least_flatness =
            0.6; // area of the plane over that of the steps, of one plane at most sqrt(dim)
        const double width = grid.cell_size() / n_1d, area = Utilities::fixed_power<dim - 1>(width);
        const double top = grid.upper_corner()[dim - 1];
        std::vector<std::pair<Face, unsigned int>> steps; // in air, with their axes
        Tensor<1, dim> normal, sum;
        for (unsigned int q = 0; q < n_parts; ++q)
          if (kinds[q] >= 0)
            for (unsigned int a = 0; a < dim; ++a)
              for (const int side : { 0, 1 })
                {
                  const auto place = place_in_lattice(q);
                  auto neighbour   = place;
                  neighbour[a] += side == 0 ? -1 : 1;
                  Point<dim> x            = middle_of(corner, place);
                  x[a]                    = corner[a] + width * (place[a] + side);
                  const Point<dim> beyond = middle_of(corner, neighbour);
                  Face face{ unsigned(cells.size()), x, area, conductivity(kinds[q]), no_head };
                  if (survey.is_beyond(beyond, 2 * a + side))
                    {
                      if (const auto head = survey.head_of_wall(2 * a + side, x[dim - 1]))
                        {
                          face.head = *head;
                          faces.push_back(face);
                        }
                    }
                  else if (survey.kind(beyond) == SeepageSurvey<dim>::air)
                    {
                      steps.emplace_back(face, a);
                      normal[a] += side == 0 ? -1. : 1.;
                      sum += x - corner;
                    }
                }
        // The steps of an oblique face lie around a plane: their faces go there.
        const bool is_plane = normal.norm() > least_flatness * steps.size();
        if (is_plane)
          normal /= normal.norm();
        for (auto &[step, axis] : steps)
          {
            if (is_plane)
              {
                step.location -= ((step.location - (corner + sum / double(steps.size()))) * normal) * normal;
                step.area *= std::abs(normal[axis]);
              }
            const double water = survey.level(step.location);
            if (water > top + 1e-6 * width)
              throw ValueError(entry_message({ "Water", "Reservoir level", survey.reservoir_text },
                                             "it is above the box of subsection Mesh at " + number_text(step.location) +
                                                 " m. Write a larger box, or a level up to " + number_text(top) +
                                                 " m."));
            if (step.location[dim - 1] < water)
              step.head = water;
            faces.push_back(step);
          }
      }

      /// Makes room for matrix and vectors. Rows without soil are those of the identity.
      void make_system()
      {
        const IndexSet &owned = dofs.locally_owned_dofs();
        IndexSet relevant;
        DoFTools::extract_locally_relevant_dofs(dofs, relevant);
        heads.reinit(owned, relevant, communicator);
        scales.reinit(owned, relevant, communicator);
        source.reinit(owned, relevant, communicator);
        solution.reinit(owned, communicator);
        TrilinosWrappers::SparsityPattern pattern(owned, communicator, Utilities::pow(3, dim));
        for (const auto row : owned)
          pattern.add(row, row);
        for (const Cell &cell : cells)
          for (const auto row : cell.dofs)
            pattern.add_entries(row, cell.dofs.begin(), cell.dofs.end());
        pattern.compress();
        matrix.reinit(pattern);
        for (unsigned int q = 0; q < n_parts; ++q)
          {
            laplacian[q].reinit(n_vertices, n_vertices);
            for (unsigned int v = 0; v < n_vertices; ++v)
              for (unsigned int w = 0; w < n_vertices; ++w)
                laplacian[q](v, w) = Utilities::fixed_power<dim>(grid.cell_size()) * parts.weight(q) *
                                     (element.shape_grad(v, parts.point(q)) * element.shape_grad(w, parts.point(q))) /
                                     (grid.cell_size() * grid.cell_size());
          }
      }

      /// Values of the hat functions of its cell at a face.
      std::array<double, n_vertices> shape_at(const Face &face) const
      {
        Point<dim> place;
        for (unsigned int a = 0; a < dim; ++a)
          place[a] = std::clamp((face.location[a] - cells[face.cell].corner[a]) / grid.cell_size(), 0., 1.);
        std::array<double, n_vertices> shape;
        for (unsigned int v = 0; v < n_vertices; ++v)
          shape[v] = element.shape_value(v, place);
        return shape;
      }

      /// Head at a face, m.
      double head_at(const Face &face) const
      {
        const auto shape = shape_at(face);
        double head      = 0.;
        for (unsigned int v = 0; v < n_vertices; ++v)
          head += shape[v] * heads(cells[face.cell].dofs[v]);
        return head;
      }

      /// Head beyond a face, m: in air without pressure.
      static double head_beyond(const Face &face)
      {
        return std::isnan(face.head) ? face.location[dim - 1] : face.head;
      }

      /// Flow through a face over the difference of heads, m^(dim-1)/s.
      double conductance(const Face &face) const
      {
        const bool is_open = !std::isnan(face.head) || face.is_leaving;
        return face_conductance / grid.cell_size() * face.area *
               (is_open ? face.conductivity : closed_share * smallest_conductivity);
      }

      /// Sets matrix and right-hand side of the conductivities and faces as they are.
      void assemble()
      {
        std::vector<FullMatrix<double>> own(cells.size(), FullMatrix<double>(n_vertices, n_vertices));
        for (unsigned int c = 0; c < cells.size(); ++c)
          for (unsigned int q = 0; q < n_parts; ++q)
            own[c].add(cells[c].conductivity[q] * cells[c].relative[q], laplacian[q]);
        source.zero_out_ghost_values();
        source = 0.;
        for (const Face &face : faces)
          {
            const auto shape = shape_at(face);
            for (unsigned int v = 0; v < n_vertices; ++v)
              {
                source(cells[face.cell].dofs[v]) += conductance(face) * shape[v] * head_beyond(face);
                for (unsigned int w = 0; w < n_vertices; ++w)
                  own[face.cell](v, w) += conductance(face) * shape[v] * shape[w];
              }
          }
        source.compress(VectorOperation::add);
        // Rows are scaled, so that soil of low conductivity counts as much as the other.
        scales.zero_out_ghost_values();
        scales = 0.;
        for (unsigned int c = 0; c < cells.size(); ++c)
          for (unsigned int v = 0; v < n_vertices; ++v)
            scales(cells[c].dofs[v]) += own[c](v, v);
        scales.compress(VectorOperation::add);
        matrix = 0.;
        for (const auto row : scales.locally_owned_elements())
          {
            const double diagonal = scales(row);
            scales(row)           = diagonal > 0. ? 1. / std::sqrt(diagonal) : 1.;
            solution(row)         = diagonal > 0. ? heads(row) / scales(row) : 0.;
            source(row) *= scales(row);
            if (!(diagonal > 0.))
              matrix.add(row, row, 1.);
          }
        scales.update_ghost_values();
        for (unsigned int c = 0; c < cells.size(); ++c)
          {
            for (unsigned int v = 0; v < n_vertices; ++v)
              for (unsigned int w = 0; w < n_vertices; ++w)
                own[c](v, w) *= scales(cells[c].dofs[v]) * scales(cells[c].dofs[w]);
            matrix.add(cells[c].dofs, own[c]);
          }
        matrix.compress(VectorOperation::add);
      }

      /// Solves for the heads; returns the largest change, m. Collective.
      double solve_system()
      {
        TrilinosWrappers::PreconditionAMG multigrid;
        multigrid.initialize(matrix);
        constexpr unsigned int most_iterations = 2000;
        constexpr double tolerance             = 1e-10;
        SolverControl control(most_iterations, tolerance * source.l2_norm());
        try
          {
            SolverCG<Vector>(control).solve(matrix, solution, source, multigrid);
          }
        catch (const SolverControl::NoConvergence &)
          {
            require_entry(false,
                          { "Water", "Steady seepage", "true" },
                          "the flow has not been found in " + std::to_string(most_iterations) +
                              " iterations. Look at the conductivities of the bodies, or write a \"Phreatic "
                              "surface\".");
          }
        heads.zero_out_ghost_values();
        solution.scale(scales);
        double change = 0.;
        for (const auto row : heads.locally_owned_elements())
          {
            change     = std::max(change, std::abs(solution(row) - heads(row)));
            heads(row) = solution(row);
          }
        heads.update_ghost_values();
        return Utilities::MPI::max(change, communicator);
      }

      /// Follows the heads with the conductivities; `share` of the way.
      void update_conductivities(const double share)
      {
        const double width = width_of_surface * grid.cell_size();
        for (Cell &cell : cells)
          for (unsigned int q = 0; q < n_parts; ++q)
            {
              double pressure_head = -cell.corner[dim - 1] - parts.point(q)[dim - 1] * grid.cell_size();
              for (unsigned int v = 0; v < n_vertices; ++v)
                pressure_head += element.shape_value(v, parts.point(q)) * heads(cell.dofs[v]);
              const double filled = std::clamp(0.5 + pressure_head / width, 0., 1.);
              const double wanted = dry_conductivity + (1. - dry_conductivity) * filled;
              cell.relative[q] *= std::pow(wanted / cell.relative[q], share);
            }
      }

      /// Follows the heads at the faces in air; returns whether any has changed. Collective.
      bool update_faces()
      {
        bool has_changed = false;
        for (Face &face : faces)
          if (std::isnan(face.head))
            {
              const bool leaves = head_at(face) > face.location[dim - 1];
              has_changed       = has_changed || leaves != face.is_leaving;
              face.is_leaving   = leaves;
            }
        return Utilities::MPI::max(int(has_changed), communicator) == 1;
      }

      /// What went through the faces.
      /// @param scale of the flow, for gravity
      SeepageReport report(const double scale) const
      {
        const double resolution = 1e-3 * grid.cell_size(); // of heads that count as one: that of one reservoir
        SeepageReport report;
        std::map<long, double> out_to, of_all; // flow by heads
        double highest = -std::numeric_limits<double>::infinity();
        for (const Face &face : faces)
          {
            const double flow = scale * conductance(face) * (head_at(face) - head_beyond(face));
            if (!std::isnan(face.head))
              out_to[std::lround(face.head / resolution)] += flow;
            else if (face.is_leaving)
              {
                report.outflow_in_air += flow;
                highest = std::max(highest, face.location[dim - 1]);
              }
          }
        for (const auto &of_rank : Utilities::MPI::all_gather(communicator, out_to))
          for (const auto &[head, flow] : of_rank)
            of_all[head] += flow;
        for (const auto &[head, flow] : of_all)
          (flow > 0. ? report.outflow_below : report.inflow) += std::abs(flow);
        report.outflow_in_air = Utilities::MPI::sum(report.outflow_in_air, communicator);
        highest               = Utilities::MPI::max(highest, communicator);
        report.exit_height    = std::isfinite(highest) ? highest : std::numeric_limits<double>::quiet_NaN();
        return report;
      }

      std::shared_ptr<const SeepageField<dim>> field(const SeepageReport &report) const
      {
        constexpr double none      = std::numeric_limits<double>::lowest();
        const CellsOfBox<dim> &box = grid.fine_cells().box();
        std::vector<int> ends(2 * dim, std::numeric_limits<int>::lowest()); // of the cells: -first, last
        for (const Cell &cell : cells)
          for (unsigned int a = 0; a < dim; ++a)
            {
              ends[a]       = std::max(ends[a], -box.place_of_corner(cell.corner)[a]);
              ends[dim + a] = std::max(ends[dim + a], box.place_of_corner(cell.corner)[a]);
            }
        Utilities::MPI::max(ends, communicator, ends);
        CellPlace<dim> first;
        TableIndices<dim> n;
        for (unsigned int a = 0; a < dim; ++a)
          {
            first[a] = -ends[a];
            n[a]     = ends[dim + a] - first[a] + 2;
          }
        Table<dim, double> table;
        table.reinit(n);
        std::vector<double> values(table.n_elements(), none); // along the last axis first
        for (const Cell &cell : cells)
          for (unsigned int v = 0; v < n_vertices; ++v)
            {
              std::size_t number = 0;
              for (unsigned int a = 0; a < dim; ++a)
                number = number * n[a] + box.place_of_corner(cell.corner)[a] - first[a] + (v >> a & 1);
              values[number] = heads(cell.dofs[v]) - cell.corner[dim - 1] - (v >> (dim - 1) & 1) * grid.cell_size();
            }
        Utilities::MPI::max(values, communicator, values);
        std::replace(values.begin(), values.end(), none, no_head);
        table.fill(values.begin());
        return std::make_shared<const SeepageField<dim>>(box, first, table, report);
      }

      const SeepageSurvey<dim> &survey;
      const BackgroundGrid<dim> &grid;
      const MPI_Comm communicator;
      const FE_Q<dim> element;
      DoFHandler<dim> dofs;
      const QIterated<dim> parts; // their middles
      std::vector<Cell> cells;
      std::vector<Face> faces;
      std::array<FullMatrix<double>, n_parts> laplacian;                 // of a part
      double smallest_conductivity = std::numeric_limits<double>::max(); // at a face, m/s
      TrilinosWrappers::SparseMatrix matrix;
      Vector heads, scales, source, solution;
    };
  } // namespace


  template <int dim>
  SeepageSurvey<dim>::SeepageSurvey(const BackgroundGrid<dim> &grid,
                                    const SeepageSoil &soil,
                                    const WaterParameters &water,
                                    const BoundaryConditions<dim> &walls,
                                    const double unit_weight,
                                    const LevelSet<dim> *ground)
      : grid(grid)
      , soil(soil)
      , reservoir_text(water.reservoir_level)
      , walls(walls)
      , ground(ground)
      , unit_weight(unit_weight)
      , heads(heads_at_faces(water, dim))
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
    for (unsigned int face = 0; face < 2 * dim; ++face)
      if (is_beyond(x, face))
        return closed;
    if (ground != nullptr && !ground->is_open(x))
      return closed;
    for (unsigned int i = 0; i < regions.size(); ++i)
      if (regions[i].contains(x))
        return soil.conductivities[i] > 0. ? int(i) : closed;
    return air;
  }


  template <int dim>
  std::optional<double> SeepageSurvey<dim>::head_of_wall(const unsigned int face, const double height) const
  {
    const bool has_head = !std::isnan(heads[face]);
    if (has_head && height < heads[face])
      return heads[face];
    if (!walls.is_open(face))
      return {};
    if (has_head)
      return no_head; // Above it water may leave.
    const double pressure = walls.pressure(1u << face, height);
    return pressure == 0. ? no_head : height + pressure / unit_weight;
  }


  template <int dim>
  SeepageField<dim>::SeepageField(const CellsOfBox<dim> &box,
                                  const CellPlace<dim> &first,
                                  const Table<dim, double> &values,
                                  const SeepageReport &report)
      : report(report)
      , box(box)
      , first(first)
  {
    std::array<std::pair<double, double>, dim> ends;
    std::array<unsigned int, dim> n_cells;
    for (unsigned int a = 0; a < dim; ++a)
      {
        n[a] = n_cells[a] = values.size(a) - 1;
        ends[a]           = { box.corner(first)[a], box.corner(first)[a] + n[a] * box.width };
      }
    heads = std::make_unique<const Functions::InterpolatedUniformGridData<dim>>(ends, n_cells, values);
  }


  template <int dim>
  std::pair<double, Tensor<1, dim>> SeepageField<dim>::pressure_head(const Point<dim> &x) const
  {
    const CellPlace<dim> cell = box.place_near(x);
    for (unsigned int a = 0; a < dim; ++a)
      if (cell[a] < first[a] || cell[a] >= first[a] + n[a])
        return { no_head, {} };
    return { heads->value(x), heads->gradient(x) };
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


  template <int dim>
  std::shared_ptr<const SeepageField<dim>> solve_seepage(const SeepageSurvey<dim> &survey, const double gravity)
  {
    return SteadySeepage<dim>(survey).solve(gravity);
  }

  template class SeepageSurvey<2>;
  template class SeepageSurvey<3>;
  template class SeepageField<2>;
  template class SeepageField<3>;
  template decltype(solve_seepage<2>) solve_seepage<2>;
  template decltype(solve_seepage<3>) solve_seepage<3>;
} // namespace scree

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/output/graphics.h>

#include <scree/output/measures.h>

#include <deal.II/base/data_out_base.h>
#include <deal.II/base/geometry_info.h>

#include <algorithm>
#include <fstream>
#include <map>

namespace scree
{
  using namespace dealii;

  namespace
  {
    using Range =
        std::tuple<unsigned int, unsigned int, std::string, DataComponentInterpretation::DataComponentInterpretation>;

    /// Patches with their names, as deal.II's writers want them.
    template <int patch_dim, int dim>
    class PatchOutput : public DataOutInterface<patch_dim, dim>
    {
    public:
      std::vector<DataOutBase::Patch<patch_dim, dim>> patches;
      std::vector<std::string> names;
      std::vector<Range> ranges;

      void add_name(const std::string &name)
      {
        names.push_back(name);
      }

      void add_vector(const std::string &name)
      {
        ranges.emplace_back(
            names.size(), names.size() + dim - 1, name, DataComponentInterpretation::component_is_part_of_vector);
        names.insert(names.end(), dim, name);
      }

      void add_tensor(const std::string &name)
      {
        ranges.emplace_back(
            names.size(), names.size() + 8, name, DataComponentInterpretation::component_is_part_of_tensor);
        names.insert(names.end(), 9, name);
      }

      /// Writes `<folder>/<name>_<number>.pvtu` and a `.vtu` a rank; returns the name of the former.
      std::string
      write(const std::string &folder, const std::string &name, const unsigned int number, const MPI_Comm communicator)
      {
        DataOutBase::VtkFlags flags;
        flags.compression_level = DataOutBase::VtkFlags::best_speed;
        this->set_flags(flags);
        return this->write_vtu_with_pvtu_record(folder, name, number, communicator, 5);
      }

    private:
      const std::vector<DataOutBase::Patch<patch_dim, dim>> &get_patches() const override
      {
        return patches;
      }
      std::vector<std::string> get_dataset_names() const override
      {
        return names;
      }
      std::vector<Range> get_nonscalar_data_ranges() const override
      {
        return ranges;
      }
    };

    /// Internal variables and derived fields of all bodies, each name once.
    template <int dim>
    std::vector<std::string> law_fields(const std::list<Phase<dim>> &phases)
    {
      std::vector<std::string> fields;
      for (const auto &phase : phases)
        for (const auto &names : { phase.material->internal_variable_names(), phase.material->output_names() })
          for (const auto &name : names)
            if (std::find(fields.begin(), fields.end(), name) == fields.end())
              fields.push_back(name);
      return fields;
    }
  } // namespace


  template <int dim>
  Graphics<dim>::Graphics(const BackgroundGrid<dim> &grid,
                          const OutputParameters &parameters,
                          const std::string &run_folder)
      : grid(grid)
      , graphics(parameters.graphics)
      , folder(run_folder + "/solution/")
  {
  }


  template <int dim>
  void Graphics<dim>::write(const std::list<Phase<dim>> &phases, const NodalField<dim> &field, const double time)
  {
    if (graphics == "none")
      return;
    write_points(phases, time);
    if (graphics == "points and grid")
      write_grid(phases, field, time);
  }


  template <int dim>
  void Graphics<dim>::write_points(const std::list<Phase<dim>> &phases, const double time)
  {
    PatchOutput<0, dim> output;
    output.add_vector("velocity");
    output.add_tensor("stress");
    for (const std::string name :
         { "mean_effective_stress", "deviatoric_stress", "stress_ratio", "mass", "volume", "body" })
      output.add_name(name);
    const auto fields              = law_fields(phases);
    const unsigned int first_field = output.names.size();
    output.names.insert(output.names.end(), fields.begin(), fields.end());

    unsigned int body = 0;
    for (const auto &phase : phases)
      {
        const auto internal = phase.material->internal_variable_names(), derived = phase.material->output_names();
        std::vector<unsigned int> columns;
        for (const auto &names : { internal, derived })
          for (const auto &name : names)
            columns.push_back(first_field + (std::find(fields.begin(), fields.end(), name) - fields.begin()));
        std::vector<double> values(derived.size());

        for (const auto &cell : phase.points.cells())
          for (unsigned int p = 0; p < cell.n_points; ++p)
            {
              const double *properties = cell.properties + p * phase.points.stride();
              const double *stress     = properties + phase.layout.stress;
              const double *internals  = properties + phase.layout.internal_variables;

              DataOutBase::Patch<0, dim> patch;
              patch.vertices[0] = cell.location[p];
              patch.patch_index = output.patches.size();
              patch.data.reinit(output.names.size(), 1);
              unsigned int row = 0;
              const auto put   = [&](const double value) { patch.data(row++, 0) = value; };

              for (unsigned int a = 0; a < dim; ++a)
                put(properties[phase.layout.velocity + a]);
              // plane strain: no out-of-plane shear
              const double xy = stress[3], xz = dim == 3 ? stress[dim + 1] : 0., yz = dim == 3 ? stress[dim + 2] : 0.;
              for (const double value : { stress[0], xy, xz, xy, stress[1], yz, xz, yz, stress[2] })
                put(value);
              const double P = mean_effective_stress(stress), q = deviatoric_stress<dim>(stress);
              put(P);
              put(q);
              put(P > 0 ? q / P : 0.);
              put(properties[phase.layout.mass]);
              put(properties[phase.layout.volume]);
              put(body);

              phase.material->output(properties + phase.layout.left_cauchy_green,
                                     stress,
                                     internals,
                                     properties[phase.layout.volume] * phase.density / properties[phase.layout.mass],
                                     values.data());
              for (unsigned int i = 0; i < internal.size(); ++i)
                patch.data(columns[i], 0) = internals[i];
              for (unsigned int i = 0; i < derived.size(); ++i)
                patch.data(columns[internal.size() + i], 0) = values[i];
              output.patches.push_back(patch);
            }
        ++body;
      }
    const auto file = output.write(folder, "points", point_files.size(), grid.triangulation().get_communicator());
    point_files.emplace_back(time, file);
    write_pvd("points", point_files);
  }


  namespace
  {
    /// Velocity of the field at a place of a cell, m/s.
    template <int dim, int n>
    Tensor<1, dim> velocity_at(const Point<dim> &x,
                               const BackgroundGrid<dim> &grid,
                               const unsigned int cell,
                               const NodalField<dim> &field)
    {
      const CellBasis<dim, n> basis(x, grid.open_knots(cell));
      Tensor<1, dim> velocity;
      for (unsigned int i = 0; i < CellBasis<dim, n>::n_nodes; ++i)
        {
          double value = 1.;
          for (unsigned int a = 0, rest = i; a < dim; ++a, rest /= n)
            value *= basis.value[a][rest % n];
          const double *node = field[grid.nodes(cell)[i]];
          for (unsigned int c = 0; c < dim; ++c)
            velocity[c] += value * node[NodalField<dim>::velocity + c];
        }
      return velocity;
    }
  } // namespace


  template <int dim>
  void Graphics<dim>::write_grid(const std::list<Phase<dim>> &phases, const NodalField<dim> &field, const double time)
  {
    struct CellMean
    {
      double mass = 0, volume = 0, pressure = 0;
    };
    std::map<unsigned int, CellMean> means;
    for (const auto &phase : phases)
      for (const auto &cell : phase.points.cells())
        for (unsigned int p = 0; p < cell.n_points; ++p)
          {
            const double *properties = cell.properties + p * phase.points.stride();
            const double volume      = properties[phase.layout.volume];
            CellMean &mean           = means[cell.cell];
            mean.mass += properties[phase.layout.mass];
            mean.volume += volume;
            mean.pressure += volume * mean_effective_stress(properties + phase.layout.stress);
          }

    PatchOutput<dim, dim> output;
    output.add_vector("velocity");
    output.add_name("density");
    output.add_name("mean_effective_stress");
    const double cell_volume = Utilities::fixed_power<dim>(grid.cell_size());
    for (const auto &cell : grid.triangulation().active_cell_iterators())
      if (const auto mean = means.find(cell->active_cell_index()); mean != means.end())
        {
          DataOutBase::Patch<dim, dim> patch;
          patch.patch_index    = output.patches.size();
          patch.n_subdivisions = 1;
          patch.reference_cell = ReferenceCells::get_hypercube<dim>();
          patch.data.reinit(output.names.size(), GeometryInfo<dim>::vertices_per_cell);
          for (const unsigned int v : cell->vertex_indices())
            {
              patch.vertices[v]   = cell->vertex(v);
              const auto corner   = GeometryInfo<dim>::unit_cell_vertex(v);
              const auto velocity = grid.n_nodes_1d() == 3 ? velocity_at<dim, 3>(corner, grid, mean->first, field)
                                                           : velocity_at<dim, 2>(corner, grid, mean->first, field);
              for (unsigned int c = 0; c < dim; ++c)
                patch.data(c, v) = velocity[c];
              patch.data(dim, v)     = mean->second.mass / cell_volume;
              patch.data(dim + 1, v) = mean->second.pressure / mean->second.volume;
            }
          output.patches.push_back(patch);
        }
    const auto file = output.write(folder, "grid", grid_files.size(), grid.triangulation().get_communicator());
    grid_files.emplace_back(time, file);
    write_pvd("grid", grid_files);
  }


  template <int dim>
  void Graphics<dim>::write_pvd(const std::string &name, const std::vector<TimeAndFile> &files) const
  {
    if (Utilities::MPI::this_mpi_process(grid.triangulation().get_communicator()) != 0)
      return;
    std::ofstream out(folder + name + ".pvd");
    DataOutBase::write_pvd_record(out, files);
  }

  template class Graphics<2>;
  template class Graphics<3>;
} // namespace scree

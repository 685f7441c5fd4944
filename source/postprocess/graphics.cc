// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/postprocess/graphics.h>
#include <scree/tensor/invariants.h>
#include <scree/tensor/vector.h>

namespace scree
{
  using namespace dealii;

  template <int dim>
  Tensor<1, dim> velocity_at(const Point<dim> &x,
                             const BackgroundGrid<dim> &grid,
                             const unsigned int cell,
                             const NodalField<dim> &field)
  {
    Tensor<1, dim> velocity;
    visit_nodes(grid, cell, x, [&](const unsigned int node, const double shape) {
      for (unsigned int c = 0; c < dim; ++c)
        velocity[c] += shape * field[node][NodalField<dim>::velocity + c];
    });
    return velocity;
  }


  template <int dim>
  Tensor<1, dim> relative_velocity_at(const Point<dim> &x,
                                      const BackgroundGrid<dim> &grid,
                                      const unsigned int cell,
                                      const NodalField<dim> &soil,
                                      const NodalField<dim> &water)
  {
    using Field = NodalField<dim>;
    Tensor<1, dim> velocity;
    visit_nodes(grid, cell, x, [&](const unsigned int node, const double shape) {
      // A node without mass has no velocity of its own.
      if (soil[node][Field::mass] > 0 && water[node][Field::mass] > 0)
        for (unsigned int c = 0; c < dim; ++c)
          velocity[c] += shape * (water[node][Field::velocity + c] - soil[node][Field::velocity + c]);
    });
    return velocity;
  }

  template decltype(velocity_at<2>) velocity_at<2>;
  template decltype(velocity_at<3>) velocity_at<3>;
  template decltype(relative_velocity_at<2>) relative_velocity_at<2>;
  template decltype(relative_velocity_at<3>) relative_velocity_at<3>;


  namespace
  {
    /// A new point of the output; put() fills its rows one after the other.
    template <int dim>
    class Rows
    {
    public:
      Rows(PatchOutput<0, dim> &output, const Point<dim> &location)
          : values(output.values)
          , begin(values.size())
      {
        output.points.push_back(location);
        values.resize(begin + output.names.size());
      }

      void put(const double value)
      {
        values[begin + row++] = value;
      }
      void put(const Tensor<1, dim> &vector)
      {
        for (unsigned int a = 0; a < dim; ++a)
          put(vector[a]);
      }
      void set(const unsigned int any_row, const double value)
      {
        values[begin + any_row] = value;
      }

    private:
      std::vector<float> &values;
      const std::size_t begin;
      unsigned int row = 0;
    };

    template <int dim>
    void put_state(Rows<dim> &rows, const SoilBody<dim> &body, const double *properties, const unsigned int number)
    {
      const double *stress = properties + body.layout.stress;
      rows.put(vector_of<dim>(properties + body.layout.velocity));
      // plane strain: no out-of-plane shear
      const double xy = stress[3], xz = dim == 3 ? stress[dim + 1] : 0., yz = dim == 3 ? stress[dim + 2] : 0.;
      for (const double value : { stress[0], xy, xz, xy, stress[1], yz, xz, yz, stress[2] })
        rows.put(value);
      rows.put(mean_effective_stress(stress));
      rows.put(deviatoric_stress<dim>(stress));
      rows.put(stress_ratio<dim>(stress));
      rows.put(properties[body.layout.mass]);
      rows.put(properties[body.layout.volume]);
      rows.put(number);
    }

    /// The law's internal variables and derived fields of all bodies: each name has one row, whichever body's it is.
    template <int dim>
    class LawFields
    {
    public:
      LawFields(const std::list<SoilBody<dim>> &bodies, PatchOutput<0, dim> &output)
          : names(output.names)
          , first_row(names.size())
      {
        for (const auto &body : bodies)
          for (const auto &fields : { body.material->internal_quantities, body.material->output_quantities })
            for (const Quantity &field : fields)
              if (std::find(names.begin() + first_row, names.end(), label_of(field)) == names.end())
                output.add({ field.name, field.unit });
      }

      /// Prepares put() for the points of a body.
      void begin(const SoilBody<dim> &body)
      {
        internal = rows_of(body.material->internal_quantities);
        derived  = rows_of(body.material->output_quantities);
        values.resize(derived.size());
      }

      void put(Rows<dim> &rows, const SoilBody<dim> &body, const double *properties)
      {
        const double *internals = properties + body.layout.internal_variables;
        body.material->output(properties + body.layout.left_cauchy_green,
                              internals,
                              properties[body.layout.volume] * body.density / properties[body.layout.mass],
                              values.data());
        for (unsigned int i = 0; i < internal.size(); ++i)
          rows.set(internal[i], internals[i]);
        for (unsigned int i = 0; i < derived.size(); ++i)
          rows.set(derived[i], values[i]);
      }

    private:
      static std::string label_of(const Quantity &quantity)
      {
        return OutputField{ quantity.name, quantity.unit }.label();
      }

      std::vector<unsigned int> rows_of(const std::vector<Quantity> &fields) const
      {
        std::vector<unsigned int> rows;
        for (const Quantity &field : fields)
          rows.push_back(std::find(names.begin() + first_row, names.end(), label_of(field)) - names.begin());
        return rows;
      }

      const std::vector<std::string> &names;
      const unsigned int first_row;
      std::vector<unsigned int> internal, derived; // rows
      std::vector<double> values;
    };


    /// The points of soil.
    template <int dim>
    std::shared_ptr<Picture> picture_of_soil(const std::list<SoilBody<dim>> &bodies,
                                             const BackgroundGrid<dim> &grid,
                                             const NodalField<dim> &field,
                                             const WaterView<dim> *view)
    {
      const auto picture          = std::make_shared<PatchOutput<0, dim>>();
      PatchOutput<0, dim> &output = *picture;
      output.add({ "velocity", "m/s", FieldKind::vector });
      output.add({ "stress", "Pa", FieldKind::tensor });
      output.add({ "mean_effective_stress", "Pa" });
      output.add({ "deviatoric_stress", "Pa" });
      output.add({ "stress_ratio", "-" });
      output.add({ "mass", "kg" });
      output.add({ "volume", "m^3" });
      output.add({ "body", "-" });
      if (view)
        {
          output.add({ "porosity", "-" });
          output.add({ "pore_pressure", "Pa" });
          output.add({ "seepage_velocity", "m/s", FieldKind::vector });
        }
      output.add({ "id", "-" });
      const bool has_displacement = !bodies.empty() && bodies.front().layout.has_start;
      if (has_displacement)
        output.add({ "displacement", "m", FieldKind::vector });
      LawFields<dim> law_fields(bodies, output);

      unsigned int number = 0;
      for (const auto &body : bodies)
        {
          law_fields.begin(body);
          for (unsigned int c = 0; c < body.points.cells().size(); ++c)
            {
              const auto &cell = body.points.cells()[c];
              const auto ids   = body.points.ids(c);
              auto id          = ids.begin();
              std::array<double, (1 << dim)> pressure;
              if (view)
                pressure = view->pressure_of_cell(cell.cell);
              for_each_point(cell, [&](const auto &point) {
                const double *properties = point.properties;
                Rows<dim> rows(output, point.location);
                put_state(rows, body, properties, number);
                if (view)
                  {
                    const Point<dim> &x = point.reference_location;
                    const double n      = body.porosity(properties);
                    rows.put(n);
                    rows.put(pressure_at<dim>(x, pressure));
                    rows.put(n * relative_velocity_at(x, grid, cell.cell, field, view->field));
                  }
                rows.put(static_cast<double>(*id++));
                if (has_displacement)
                  rows.put(point.location - Point<dim>(vector_of<dim>(properties + body.layout.start)));
                law_fields.put(rows, body, properties);
              });
            }
          ++number;
        }
      return picture;
    }


    /// The points of water, or of soil as carriers of water.
    template <int dim>
    std::shared_ptr<Picture> picture_of_water(const BackgroundGrid<dim> &grid,
                                              const NodalField<dim> &soil_field,
                                              const WaterView<dim> &view,
                                              const std::vector<CellContents> &contents)
    {
      const auto picture          = std::make_shared<PatchOutput<0, dim>>();
      PatchOutput<0, dim> &output = *picture;
      output.add({ "velocity", "m/s", FieldKind::vector });
      output.add({ "pressure", "Pa" });
      output.add({ "mass", "kg" });
      output.add({ "volume", "m^3" });
      output.add({ "porosity", "-" });
      output.add({ "inside_soil", "-" });
      output.add({ "seepage_velocity", "m/s", FieldKind::vector });

      for (const auto &water : view.water)
        for (const auto &cell : water.points().cells())
          {
            const bool inside_soil = contents[cell.cell].n_soil_points > 0;
            const double n         = contents[cell.cell].porosity();
            for_each_point(cell, [&](const auto &point) {
              const double *properties = point.properties;
              Rows<dim> rows(output, point.location);
              rows.put(vector_of<dim>(properties + water.layout.velocity));
              rows.put(properties[water.layout.pressure]);
              rows.put(properties[water.layout.mass]);
              rows.put(properties[water.layout.volume]);
              rows.put(n);
              rows.put(inside_soil);
              rows.put(inside_soil
                           ? n * relative_velocity_at(point.reference_location, grid, cell.cell, soil_field, view.field)
                           : Tensor<1, dim>());
            });
          }
      return picture;
    }


    /// The cells that hold points.
    template <int dim>
    std::shared_ptr<Picture> picture_of_grid(const BackgroundGrid<dim> &grid,
                                             const NodalField<dim> &field,
                                             const WaterView<dim> *view,
                                             const std::vector<CellContents> &contents)
    {
      const auto picture            = std::make_shared<PatchOutput<dim, dim>>();
      PatchOutput<dim, dim> &output = *picture;
      output.add({ "velocity", "m/s", FieldKind::vector });
      output.add({ "density", "kg/m^3" });
      output.add({ "mean_effective_stress", "Pa" });
      if (view)
        {
          output.add({ "water_velocity", "m/s", FieldKind::vector });
          output.add({ "pressure", "Pa" });
          output.add({ "porosity", "-" });
          output.add({ "saturation", "-" });
        }

      const double cell_volume = Utilities::fixed_power<dim>(grid.cell_size());
      for (const auto &cell : grid.triangulation().active_cell_iterators())
        {
          const unsigned int index = cell->active_cell_index();
          const CellContents &sums = contents[index];
          if (sums.is_empty() || !holds_nodes(cell))
            continue;
          typename PatchOutput<dim, dim>::Patch patch;
          patch.patch_index    = output.patches.size();
          patch.n_subdivisions = 1;
          patch.reference_cell = ReferenceCells::get_hypercube<dim>();
          patch.data.reinit(output.names.size(), GeometryInfo<dim>::vertices_per_cell);
          for (const unsigned int v : cell->vertex_indices())
            {
              patch.vertices[v]       = cell->vertex(v);
              unsigned int row        = 0;
              const auto put          = [&](const double value) { patch.data(row++, v) = value; };
              const auto put_velocity = [&](const NodalField<dim> &of) {
                const auto velocity = velocity_at(GeometryInfo<dim>::unit_cell_vertex(v), grid, index, of);
                for (unsigned int c = 0; c < dim; ++c)
                  put(velocity[c]);
              };
              put_velocity(field);
              put(sums.soil_mass / cell_volume);
              put(sums.soil_volume > 0 ? sums.soil_pressure / sums.soil_volume : 0.);
              if (!view)
                continue;
              put_velocity(view->field);
              put(view->pressure_of_cell(index)[v]);
              put(sums.porosity());
              put(sums.saturation(cell_volume));
            }
          output.patches.push_back(patch);
        }
      return picture;
    }
  } // namespace


  template <int dim>
  FileJob Graphics<dim>::write(const std::list<SoilBody<dim>> &bodies,
                               const NodalField<dim> &field,
                               const double time,
                               const WaterView<dim> *view)
  {
    FileJob job;
    if (pictures == Pictures::none)
      return job;
    Files files;
    const bool with_grid = pictures == Pictures::points_and_grid;

    std::vector<CellContents> contents; // by active cell index
    const std::list<WaterPhase<dim>> no_water;
    if (with_grid || view)
      contents = contents_of_cells(bodies, view ? view->water : no_water, grid);
    if (!bodies.empty())
      add("points", point_files, time, picture_of_soil(bodies, grid, field, view), files);
    if (view)
      add("water", water_files, time, picture_of_water(grid, field, *view, contents), files);
    if (with_grid)
      add("grid", grid_files, time, picture_of_grid(grid, field, view, contents), files);
    const auto piece_of = [](const std::string &path, const unsigned int rank) {
      return path + '.' + std::to_string(rank) + ".vtu";
    };
    job.stages.resize(2);
    job.stages[0] = [=, rank = rank] {
      std::vector<FileContent> pieces;
      for (const auto &[path, picture] : files.pictures)
        pieces.emplace_back(piece_of(path, rank), picture->piece());
      write_whole_files(pieces);
    };
    if (rank == 0)
      job.stages[1] = [=, n_ranks = n_ranks] {
        std::vector<FileContent> records;
        for (const auto &[path, picture] : files.pictures)
          {
            std::vector<std::string> pieces;
            for (unsigned int rank = 0; rank < n_ranks; ++rank)
              pieces.push_back(piece_of(path.substr(path.rfind('/') + 1), rank));
            records.emplace_back(path + ".pvtu", picture->record(pieces));
          }
        records.insert(records.end(), files.series.begin(), files.series.end());
        write_whole_files(records);
      };
    return job;
  }


  template class Graphics<2>;
  template class Graphics<3>;
} // namespace scree

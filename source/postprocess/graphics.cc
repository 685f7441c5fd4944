// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/postprocess/graphics.h>
#include <scree/tensor/invariants.h>
#include <scree/tensor/vector.h>

#include <zlib.h>

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
    /// A picture: fields at one time that have been gathered to be written. Patches with their names, as deal.II's
    /// writers take them: points are patches of dimension 0.
    template <int patch_dim, int dim>
    class Picture : public DataOutInterface<patch_dim, dim>
    {
      using Interpretation = DataComponentInterpretation::DataComponentInterpretation;
      using Range          = std::tuple<unsigned int, unsigned int, std::string, Interpretation>;

    public:
      using Patch = DataOutBase::Patch<patch_dim, dim>; ///< geometry and data of a point or cell

      static constexpr Interpretation vector =
          DataComponentInterpretation::component_is_part_of_vector; ///< components X, Y, Z
      static constexpr Interpretation tensor =
          DataComponentInterpretation::component_is_part_of_tensor; ///< components XX, XY, XZ, YX, ...

      std::vector<Patch> patches;     ///< patches to be written
      std::vector<std::string> names; ///< labels of the rows of a patch's data
      std::vector<Point<dim>> points; ///< points to be written, of which piece() makes patches
      std::vector<float> values;      ///< the rows of the points' data, one point after the other

      /// The name of a field in the files, `pore_pressure [Pa]`; with the unit "-" it is `porosity`.
      /// @param name words joined by `_`
      static std::string label(const std::string &name, const std::string &unit)
      {
        return unit == "-" ? name : name + " [" + unit + ']';
      }

      /// Adds a field: of the rows of the patches' data one for a scalar, `dim` for a vector, nine for a tensor.
      void add(const std::string &name,
               const std::string &unit,
               const Interpretation kind = DataComponentInterpretation::component_is_scalar)
      {
        const unsigned int n_rows = kind == vector ? dim : kind == tensor ? 9 : 1;
        if (n_rows > 1)
          ranges.emplace_back(names.size(), names.size() + n_rows - 1, label(name, unit), kind);
        names.insert(names.end(), n_rows, label(name, unit));
      }

      /// Adds a value to the last point.
      void put(const double value)
      {
        values.push_back(value);
      }
      /// Adds a vector.
      void put(const Tensor<1, dim> &value)
      {
        for (unsigned int a = 0; a < dim; ++a)
          put(value[a]);
      }

      /// Text of this rank's `.vtu`.
      std::string piece()
      {
        DataOutBase::VtkFlags flags;
        flags.compression_level = decltype(flags.compression_level)::best_speed; // the enumeration moved in deal.II 9.5
        this->set_flags(flags);
        patches.reserve(patches.size() + points.size());
        auto value = values.begin();
        for (const auto &point : points)
          {
            Patch &patch      = patches.emplace_back();
            patch.patch_index = patches.size() - 1;
            patch.vertices[0] = point;
            patch.data.reinit(names.size(), 1);
            for (unsigned int row = 0; row < names.size(); ++row)
              patch.data(row, 0) = *value++;
          }
        std::ostringstream text;
        this->write_vtu(text);
        std::string vtu = with_exact_places(with_component_names(text.str()));
        if (patches.empty()) // deal.II writes no element Points then, but VTK asks for one.
          vtu.insert(vtu.find("<Cells>"), R"(<Points><DataArray type="Float32" NumberOfComponents="3"/></Points>)");
        return vtu;
      }

      /// Text of the `.pvtu` that names the `pieces` of all ranks.
      std::string record(const std::vector<std::string> &pieces) const
      {
        std::ostringstream text;
        this->write_pvtu_record(text, pieces);
        std::string pvtu        = with_component_names(text.str());
        const std::string exact = "\"Float64\"";
        if (const auto places = pvtu.find("<PPoints>"); places != std::string::npos)
          pvtu.replace(pvtu.find("\"Float32\"", places), exact.size(), exact);
        return pvtu;
      }

    private:
      /// The text of a `.vtu` with places as 64-bit numbers, compressed in one block: deal.II writes 32 bits, which
      /// round coordinates of maps to decimetres.
      std::string with_exact_places(std::string text) const
      {
        const std::string begin = "<Points>", end = "</Points>";
        const auto first = text.find(begin), last = text.find(end);
        if (first == std::string::npos || text.find("vtkZLibDataCompressor") == std::string::npos)
          return text;
        std::vector<double> places;
        for (const Patch &patch : patches)
          for (unsigned int v = 0; v < GeometryInfo<patch_dim>::vertices_per_cell; ++v)
            for (unsigned int a = 0; a < 3; ++a)
              places.push_back(a < dim ? patch.vertices[v][a] : 0.);
        const uLong size      = places.size() * sizeof(double);
        uLongf compressed     = compressBound(size);
        const auto characters = [](const auto *data, const std::size_t n_bytes) {
          const auto *bytes = reinterpret_cast<const unsigned char *>(data);
          return Utilities::encode_base64({ bytes, bytes + n_bytes });
        };
        std::vector<unsigned char> bytes(compressed);
        AssertThrow(compress2(bytes.data(),
                              &compressed,
                              reinterpret_cast<const unsigned char *>(places.data()),
                              size,
                              Z_BEST_SPEED) == Z_OK,
                    ExcInternalError());
        const std::array<std::uint32_t, 4> head{
          { 1, std::uint32_t(size), std::uint32_t(size), std::uint32_t(compressed) }
        };
        return text.substr(0, first + begin.size()) +
               "\n<DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"binary\">\n" +
               characters(head.data(), sizeof head) + characters(bytes.data(), compressed) + "\n</DataArray>\n" +
               text.substr(last);
      }

      /// VTK's text with names for the components of vectors and tensors, which deal.II does not write.
      std::string with_component_names(std::string text) const
      {
        for (const auto &[first, last, label, interpretation] : ranges)
          {
            const bool is_vector    = interpretation == vector;
            const std::string array = "Name=\"" + label + "\" NumberOfComponents=\"" + (is_vector ? '3' : '9') + '"';
            std::string attributes;
            for (unsigned int i = 0; i < (is_vector ? 3 : 9); ++i)
              attributes += " ComponentName" + std::to_string(i) + "=\"" +
                            (is_vector ? std::string() : std::string(1, "XYZ"[i / 3])) + "XYZ"[i % 3] + '"';
            if (const auto found = text.find(array); found != std::string::npos)
              text.insert(found + array.size(), attributes);
          }
        return text;
      }

      const std::vector<Patch> &get_patches() const override
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

      std::vector<Range> ranges;
    };

    /// The points of soil or water in a picture.
    template <int dim>
    using PointPicture = std::shared_ptr<Picture<0, dim>>;

    template <int dim>
    void put_state(Picture<0, dim> &output, const SoilBody<dim> &body, const double *properties)
    {
      const double *stress = properties + body.layout.stress;
      output.put(vector_of<dim>(properties + body.layout.velocity));
      // plane strain: no out-of-plane shear
      const double xy = stress[3], xz = dim == 3 ? stress[dim + 1] : 0., yz = dim == 3 ? stress[dim + 2] : 0.;
      for (const double value : { stress[0], xy, xz, xy, stress[1], yz, xz, yz, stress[2] })
        output.put(value);
      output.put(mean_effective_stress(stress));
      output.put(deviatoric_stress<dim>(stress));
      output.put(stress_ratio<dim>(stress));
      output.put(properties[body.layout.mass]);
      output.put(properties[body.layout.volume]);
    }

    /// Adds the laws' internal variables and derived fields: each name has one row, whichever body's it is.
    /// @return the rows of each body's internal variables, and then of its derived fields
    template <int dim>
    std::vector<std::vector<unsigned int>> add_law_fields(Picture<0, dim> &output,
                                                          const std::list<SoilBody<dim>> &bodies)
    {
      const unsigned int n_others = output.names.size();
      std::vector<std::vector<unsigned int>> rows;
      for (const auto &body : bodies)
        {
          rows.emplace_back();
          for (const auto &fields : { body.material->internal_quantities, body.material->output_quantities })
            for (const Quantity &field : fields)
              {
                const auto row = std::find(
                    output.names.begin() + n_others, output.names.end(), output.label(field.name, field.unit));
                rows.back().push_back(row - output.names.begin());
                if (row == output.names.end())
                  output.add(field.name, field.unit);
              }
        }
      return rows;
    }

    /// Adds the fields of a point's law; those of other laws are 0.
    /// @param values memory that is used again from point to point
    template <int dim>
    void put_law_fields(Picture<0, dim> &output,
                        const SoilBody<dim> &body,
                        const double *properties,
                        const std::vector<unsigned int> &rows,
                        std::vector<double> &values)
    {
      const double *internals       = properties + body.layout.internal_variables;
      const unsigned int n_internal = body.material->internal_quantities.size();
      values.assign(internals, internals + n_internal);
      values.resize(rows.size());
      body.material->output(properties + body.layout.left_cauchy_green,
                            internals,
                            properties[body.layout.volume] * body.density / properties[body.layout.mass],
                            values.data() + n_internal);
      output.values.resize(output.points.size() * output.names.size());
      for (unsigned int i = 0; i < rows.size(); ++i)
        output.values[output.values.size() - output.names.size() + rows[i]] = values[i];
    }


    /// The points of soil.
    template <int dim>
    PointPicture<dim> picture_of_soil(const std::list<SoilBody<dim>> &bodies,
                                      const BackgroundGrid<dim> &grid,
                                      const NodalField<dim> &field,
                                      const WaterView<dim> *view)
    {
      const auto picture      = std::make_shared<Picture<0, dim>>();
      Picture<0, dim> &output = *picture;
      output.add("velocity", "m/s", output.vector);
      output.add("stress", "Pa", output.tensor);
      output.add("mean_effective_stress", "Pa");
      output.add("deviatoric_stress", "Pa");
      output.add("stress_ratio", "-");
      output.add("mass", "kg");
      output.add("volume", "m^3");
      output.add("body", "-");
      if (view)
        {
          output.add("porosity", "-");
          output.add("pore_pressure", "Pa");
          output.add("seepage_velocity", "m/s", output.vector);
        }
      output.add("id", "-");
      output.add("displacement", "m", output.vector);
      const auto rows_of_laws = add_law_fields(output, bodies);
      std::vector<double> values_of_law;

      unsigned int number = 0;
      for (const auto &body : bodies)
        {
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
                output.points.push_back(point.location);
                put_state(output, body, properties);
                output.put(number);
                if (view)
                  {
                    const Point<dim> &x = point.reference_location;
                    const double n      = body.porosity(properties);
                    output.put(n);
                    output.put(pressure_at<dim>(x, pressure));
                    output.put(n * relative_velocity_at(x, grid, cell.cell, field, view->field));
                  }
                output.put(static_cast<double>(*id++));
                output.put(point.location - Point<dim>(vector_of<dim>(properties + body.layout.start)));
                put_law_fields(output, body, properties, rows_of_laws[number], values_of_law);
              });
            }
          ++number;
        }
      return picture;
    }


    /// The points of water, or of soil as carriers of water.
    template <int dim>
    PointPicture<dim> picture_of_water(const BackgroundGrid<dim> &grid,
                                       const NodalField<dim> &soil_field,
                                       const WaterView<dim> &view,
                                       const std::vector<CellContents> &contents)
    {
      const auto picture      = std::make_shared<Picture<0, dim>>();
      Picture<0, dim> &output = *picture;
      output.add("velocity", "m/s", output.vector);
      output.add("pressure", "Pa");
      output.add("mass", "kg");
      output.add("volume", "m^3");
      output.add("porosity", "-");
      output.add("inside_soil", "-");
      output.add("seepage_velocity", "m/s", output.vector);

      for (const auto &water : view.water)
        for_each_point(water.points(), [&](const auto &point) {
          const double *properties = point.properties;
          const CellContents &cell = contents[point.cell];
          const bool inside_soil   = cell.n_soil_points > 0;
          output.points.push_back(point.location);
          output.put(vector_of<dim>(properties + water.layout.velocity));
          output.put(properties[water.layout.pressure]);
          output.put(properties[water.layout.mass]);
          output.put(properties[water.layout.volume]);
          output.put(cell.porosity());
          output.put(inside_soil);
          output.put(inside_soil
                         ? cell.porosity() *
                               relative_velocity_at(point.reference_location, grid, point.cell, soil_field, view.field)
                         : Tensor<1, dim>());
        });
      return picture;
    }


    /// The cells that hold points.
    template <int dim>
    std::shared_ptr<Picture<dim, dim>> picture_of_grid(const BackgroundGrid<dim> &grid,
                                                       const NodalField<dim> &field,
                                                       const WaterView<dim> *view,
                                                       const std::vector<CellContents> &contents)
    {
      const auto picture        = std::make_shared<Picture<dim, dim>>();
      Picture<dim, dim> &output = *picture;
      output.add("velocity", "m/s", output.vector);
      output.add("density", "kg/m^3");
      output.add("mean_effective_stress", "Pa");
      if (view)
        {
          output.add("water_velocity", "m/s", output.vector);
          output.add("pressure", "Pa");
          output.add("porosity", "-");
          output.add("saturation", "-");
        }

      const double cell_volume = Utilities::fixed_power<dim>(grid.cell_size());
      for (const auto &cell : grid.triangulation().active_cell_iterators())
        {
          const unsigned int index = cell->active_cell_index();
          const CellContents &sums = contents[index];
          if (sums.n_soil_points + sums.n_water_points == 0 || !holds_nodes(cell))
            continue;
          auto &patch          = output.patches.emplace_back();
          patch.patch_index    = output.patches.size() - 1;
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
    using Contents = std::vector<std::function<FileContent()>>; // made when they are written
    Contents pieces, records, lists;                            // the last two on the first rank
    const auto add = [&](const std::string &name, const auto &picture) {
      TimesAndFiles &list    = series[name];
      const std::string file = name + '_' + Utilities::int_to_string(list.size(), 5);
      const auto piece_of    = [file](const unsigned int r) { return file + '.' + std::to_string(r) + ".vtu"; };
      list.emplace_back(time, file + ".pvtu");
      pieces.push_back([=, path = folder + piece_of(rank)] { return FileContent(path, picture->piece()); });
      if (rank > 0)
        return;
      records.push_back([=, path = folder + file + ".pvtu", n_ranks = n_ranks] {
        std::vector<std::string> names;
        for (unsigned int r = 0; r < n_ranks; ++r)
          names.push_back(piece_of(r));
        return FileContent(path, picture->record(names));
      });
      lists.push_back([content = series_file(name, list)] { return content; });
    };

    const bool with_grid = pictures == Pictures::points_and_grid;
    std::vector<CellContents> contents; // by active cell index
    const std::list<WaterPhase<dim>> no_water;
    if (with_grid || view)
      contents = contents_of_cells(bodies, view ? view->water : no_water, grid);
    if (!bodies.empty())
      add("points", picture_of_soil(bodies, grid, field, view));
    if (view)
      add("water", picture_of_water(grid, field, *view, contents));
    if (with_grid)
      add("grid", picture_of_grid(grid, field, view, contents));
    records.insert(records.end(), lists.begin(), lists.end());
    for (const Contents &files : { pieces, records })
      job.stages.push_back([files] {
        std::vector<FileContent> all;
        for (const auto &content : files)
          all.push_back(content());
        write_whole_files(all);
      });
    return job;
  }


  template class Graphics<2>;
  template class Graphics<3>;
} // namespace scree

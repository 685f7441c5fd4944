// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_postprocess_graphics_h
#define scree_postprocess_graphics_h

#include <scree/io/files.h>
#include <scree/io/output_parameters.h>
#include <scree/postprocess/measures.h>
#include <scree/transfer/water_transfer.h>

#include <deal.II/base/data_out_base.h>
#include <deal.II/base/geometry_info.h>

#include <sstream>

namespace scree
{
  /// Values of a field at a point.
  enum class FieldKind
  {
    scalar,
    vector, ///< components X, Y, Z
    tensor  ///< components XX, XY, XZ, YX, ...
  };

  /// A field of the files for ParaView.
  struct OutputField
  {
    std::string name;                   ///< words joined by `_`
    std::string unit;                   ///< "-": none
    FieldKind kind = FieldKind::scalar; ///< values at a point

    /// The name in the files, `pore_pressure [Pa]`; without a unit `porosity`.
    std::string label() const
    {
      return unit == "-" ? name : name + " [" + unit + ']';
    }
  };

  /// Fields at one time that have been gathered to be written.
  class Picture
  {
  public:
    virtual ~Picture() = default;

    /// Text of this rank's `.vtu`.
    virtual std::string piece() = 0;

    /// Text of the `.pvtu` that names the `pieces` of all ranks.
    virtual std::string record(const std::vector<std::string> &pieces) const = 0;
  };

  /// Patches with their names, as deal.II's writers take them: points are patches of dimension 0.
  template <int patch_dim, int dim>
  class PatchOutput : public Picture, public dealii::DataOutInterface<patch_dim, dim>
  {
    using Interpretation = dealii::DataComponentInterpretation::DataComponentInterpretation;
    using Range          = std::tuple<unsigned int, unsigned int, std::string, Interpretation>;

  public:
    using Patch = dealii::DataOutBase::Patch<patch_dim, dim>; ///< geometry and data of a point or cell

    std::vector<Patch> patches;             ///< patches to be written
    std::vector<std::string> names;         ///< labels of the rows of a patch's data
    std::vector<dealii::Point<dim>> points; ///< points to be written, of which piece() makes patches
    std::vector<float> values;              ///< the rows of the points' data, one point after the other

    /// A field: of the rows of the patches' data one for a scalar, `dim` for a vector, nine for a tensor.
    void add(const OutputField &field)
    {
      if (field.kind == FieldKind::vector)
        add_range(field.label(), dim, dealii::DataComponentInterpretation::component_is_part_of_vector);
      else if (field.kind == FieldKind::tensor)
        add_range(field.label(), 9, dealii::DataComponentInterpretation::component_is_part_of_tensor);
      else
        names.push_back(field.label());
    }

    /// See Picture.
    std::string piece() override
    {
      dealii::DataOutBase::VtkFlags flags;
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
      std::string vtu = with_component_names(text.str());
      if (patches.empty()) // deal.II writes no element Points then, but VTK asks for one.
        vtu.insert(vtu.find("<Cells>"), R"(<Points><DataArray type="Float32" NumberOfComponents="3"/></Points>)");
      return vtu;
    }

    /// See Picture.
    std::string record(const std::vector<std::string> &pieces) const override
    {
      std::ostringstream text;
      this->write_pvtu_record(text, pieces);
      return with_component_names(text.str());
    }

  private:
    void add_range(const std::string &name, const unsigned int n_rows, const Interpretation interpretation)
    {
      ranges.emplace_back(names.size(), names.size() + n_rows - 1, name, interpretation);
      names.insert(names.end(), n_rows, name);
    }

    /// VTK's text with names for the components of vectors and tensors, which deal.II does not write.
    std::string with_component_names(std::string text) const
    {
      for (const auto &[first, last, label, interpretation] : ranges)
        {
          const bool is_vector    = interpretation == dealii::DataComponentInterpretation::component_is_part_of_vector;
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

  /// Velocity of a solved field, m/s, at the place `x` (in cell widths from the lower corner) of a cell of this rank.
  template <int dim>
  dealii::Tensor<1, dim> velocity_at(const dealii::Point<dim> &x,
                                     const BackgroundGrid<dim> &grid,
                                     const unsigned int cell,
                                     const NodalField<dim> &field);

  /// Velocity of the water relative to the soil, m/s, at the place `x` of a cell; nodes that only one of them reaches
  /// do not count.
  template <int dim>
  dealii::Tensor<1, dim> relative_velocity_at(const dealii::Point<dim> &x,
                                              const BackgroundGrid<dim> &grid,
                                              const unsigned int cell,
                                              const NodalField<dim> &soil,
                                              const NodalField<dim> &water);

  /// The pressure, Pa, at the place `x` (in cell widths from the lower corner) of a cell with the given values at its
  /// corners: linear along each axis.
  template <int dim>
  double pressure_at(const dealii::Point<dim> &x, const std::array<double, (1 << dim)> &corners)
  {
    double pressure = 0;
    for (unsigned int corner = 0; corner < corners.size(); ++corner)
      pressure += corners[corner] * dealii::GeometryInfo<dim>::d_linear_shape_function(x, corner);
    return pressure;
  }

  /// The folder `solution` of a run: `.pvtu` files of points, of water points and of grid cells that hold points, and a
  /// `.pvd` of each.
  template <int dim>
  class Graphics
  {
  public:
    /// Begins with empty lists of files.
    /// @param run_folder path
    Graphics(const BackgroundGrid<dim> &grid, const OutputParameters &parameters, const std::string &run_folder)
        : grid(grid)
        , pictures(parameters.graphics_kind())
        , folder(run_folder + "/solution/")
        , rank(dealii::Utilities::MPI::this_mpi_process(grid.communicator()))
        , n_ranks(dealii::Utilities::MPI::n_mpi_processes(grid.communicator()))
    {
    }

    /// Gathers the state at `time` under the next number; the job writes it, a `.pvd` last. doc/output.md has the
    /// fields of soil points, water points and grid cells.
    /// @param field the soil's, solved: its mass and velocity are read
    /// @param view null in a dry run; soil points that carry water are water points, too
    FileJob write(const std::list<SoilBody<dim>> &bodies,
                  const NodalField<dim> &field,
                  const double time,
                  const WaterView<dim> *view = nullptr);

    /// After the state has been read from a checkpoint: takes the pictures that were written after it off the lists.
    void cut() const
    {
      std::vector<FileContent> files;
      // Named, since GCC 13 takes a list in the loop for a dangling reference.
      const auto all = { std::make_pair("points", &point_files), { "water", &water_files }, { "grid", &grid_files } };
      for (const auto &[series, pictures] : all)
        if (rank == 0 && !pictures->empty())
          files.push_back(series_file(series, *pictures));
      write_whole_files(files);
    }

    /// Saves or loads the lists of files (Boost).
    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &point_files &water_files &grid_files;
    }

  private:
    using TimeAndFile = std::pair<double, std::string>;

    /// What is gathered at a time: paths without what follows a picture's name, and the `.pvd` of each series.
    struct Files
    {
      std::vector<std::pair<std::string, std::shared_ptr<Picture>>> pictures;
      std::vector<FileContent> series;
    };

    /// Adds a picture to a series.
    void add(const std::string &series,
             std::vector<TimeAndFile> &pictures,
             const double time,
             const std::shared_ptr<Picture> &picture,
             Files &files) const
    {
      const std::string name = series + '_' + dealii::Utilities::int_to_string(pictures.size(), 5);
      pictures.emplace_back(time, name + ".pvtu");
      files.pictures.emplace_back(folder + name, picture);
      if (rank == 0) // It alone writes them.
        files.series.push_back(series_file(series, pictures));
    }

    /// The `.pvd` of a series.
    FileContent series_file(const std::string &series, const std::vector<TimeAndFile> &pictures) const
    {
      std::ostringstream text;
      dealii::DataOutBase::write_pvd_record(text, pictures);
      return { folder + series + ".pvd", text.str() };
    }

    const BackgroundGrid<dim> &grid;
    const Pictures pictures;
    const std::string folder;
    const unsigned int rank, n_ranks;
    std::vector<TimeAndFile> point_files, water_files, grid_files;
  };
} // namespace scree

#endif

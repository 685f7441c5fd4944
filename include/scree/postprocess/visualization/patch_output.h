// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_postprocess_visualization_patch_output_h
#define scree_postprocess_visualization_patch_output_h

#include <scree/postprocess/visualization/output_field.h>

#include <deal.II/base/data_out_base.h>

#include <sstream>
#include <string>
#include <tuple>
#include <vector>

namespace scree
{
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
} // namespace scree

#endif

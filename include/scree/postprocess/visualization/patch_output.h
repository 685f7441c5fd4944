// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_postprocess_visualization_patch_output_h
#define scree_postprocess_visualization_patch_output_h

#include <scree/input/input_error.h>
#include <scree/io/whole_file.h>

#include <deal.II/base/data_out_base.h>
#include <deal.II/base/mpi.h>

#include <sstream>
#include <string>
#include <tuple>
#include <vector>

namespace scree
{
  /// Patches with their names, as deal.II's writers want them: points are patches of dimension 0.
  template <int patch_dim, int dim>
  class PatchOutput : public dealii::DataOutInterface<patch_dim, dim>
  {
    using Interpretation = dealii::DataComponentInterpretation::DataComponentInterpretation;
    using Range          = std::tuple<unsigned int, unsigned int, std::string, Interpretation>;

  public:
    using Patch = dealii::DataOutBase::Patch<patch_dim, dim>; ///< geometry and data of a point or cell

    std::vector<Patch> patches;     ///< patches to be written
    std::vector<std::string> names; ///< of the rows of a patch's data

    /// A scalar: one row of the patches' data.
    void add_name(const std::string &name)
    {
      names.push_back(name);
    }

    /// `dim` rows.
    void add_vector(const std::string &name)
    {
      add_range(name, dim, dealii::DataComponentInterpretation::component_is_part_of_vector);
    }

    /// Nine rows, a 3 x 3 matrix.
    void add_tensor(const std::string &name)
    {
      add_range(name, 9, dealii::DataComponentInterpretation::component_is_part_of_tensor);
    }

    /// Writes `<folder>/<name>_<number>.pvtu` and a `.vtu` a rank; returns the name of the former. Collective; throws
    /// EntryError on all ranks if a file cannot be written.
    std::string
    write(const std::string &folder, const std::string &name, const unsigned int number, const MPI_Comm communicator)
    {
      namespace MPI = dealii::Utilities::MPI;
      dealii::DataOutBase::VtkFlags flags;
      flags.compression_level = dealii::DataOutBase::VtkFlags::best_speed;
      this->set_flags(flags);

      const std::string picture = name + '_' + dealii::Utilities::int_to_string(number, 5);
      std::vector<std::string> pieces;
      for (unsigned int rank = 0; rank < MPI::n_mpi_processes(communicator); ++rank)
        pieces.push_back(picture + '.' + std::to_string(rank) + ".vtu");
      std::string fault;
      try
        {
          const unsigned int rank = MPI::this_mpi_process(communicator);
          std::ostringstream piece, record;
          this->write_vtu(piece);
          write_whole_file(folder + pieces[rank], piece.str());
          if (rank == 0)
            {
              this->write_pvtu_record(record, pieces);
              write_whole_file(folder + picture + ".pvtu", record.str());
            }
        }
      catch (const FileError &error)
        {
          fault = error.what();
        }
      throw_on_all_ranks(fault, communicator);
      return picture + ".pvtu";
    }

  private:
    void add_range(const std::string &name, const unsigned int n_rows, const Interpretation interpretation)
    {
      ranges.emplace_back(names.size(), names.size() + n_rows - 1, name, interpretation);
      names.insert(names.end(), n_rows, name);
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

// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef scree_element_element_parameters_h
#define scree_element_element_parameters_h

#include <scree/materials/table.h>

namespace scree
{
  /// What a `.prm` of scree-element says.
  struct ElementParameters
  {
    /// See entry "Path".
    enum class Path
    {
      drained_triaxial,
      undrained_triaxial,
      isotropic_compression,
      oedometer,
      simple_shear
    };

    std::string path_name        = "drained triaxial"; ///< entry Path
    double confining_pressure    = 1e5;                ///< vertical compressive stress at the start, Pa
    double K0                    = 1;                  ///< lateral over vertical stress at the start
    double final_strain          = 0.5;                ///< prescribed, logarithmic, compression positive, or shear
    unsigned int n_steps         = 2000;               ///< equal increments of the strain
    std::string output_directory = "results/element";  ///< where table and entries are written
    MaterialParameters material;                       ///< law and its entries

    /// Declare all entries.
    void add_parameters(dealii::ParameterHandler &prm);

    /// Throws EntryError if a combination is impossible.
    void check() const;

    /// Entry `Path` as an enum.
    Path path() const;
  };
} // namespace scree

#endif

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

    std::string path_name        = "drained triaxial";
    double confining_pressure    = 1e5;
    double K0                    = 1;
    double final_strain          = 0.5;
    unsigned int n_steps         = 2000;
    std::string output_directory = "results/element";
    MaterialParameters material;

    /// Declare all entries.
    void add_parameters(dealii::ParameterHandler &prm);

    /// Throws EntryError if a combination is impossible.
    void check() const;

    Path path() const;
  };
} // namespace scree

#endif

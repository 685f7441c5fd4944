// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/element/element_parameters.h>

using namespace dealii;

namespace scree
{
  namespace
  {
    using Path = ElementParameters::Path;

    const std::vector<std::pair<std::string, Path>> paths = { { "drained triaxial", Path::drained_triaxial },
                                                              { "undrained triaxial", Path::undrained_triaxial },
                                                              { "isotropic compression", Path::isotropic_compression },
                                                              { "oedometer", Path::oedometer },
                                                              { "simple shear", Path::simple_shear } };
  } // namespace


  void ElementParameters::add_parameters(ParameterHandler &prm)
  {
    std::string names;
    for (const auto &path : paths)
      names += (names.empty() ? "" : "|") + path.first;
    prm.add_parameter("Path",
                      path_name,
                      "Loading path of the point: drained triaxial (constant lateral stress), undrained triaxial "
                      "(constant volume), isotropic compression, oedometer (no lateral strain), or simple shear (plane "
                      "strain, constant vertical stress).",
                      Patterns::Selection(names));
    prm.add_parameter("Initial confining pressure",
                      confining_pressure,
                      "Pa; vertical compressive stress at the start.",
                      Patterns::Double(0));
    prm.add_parameter("K0", K0, "Ratio of lateral to vertical stress at the start.", Patterns::Double(0));
    prm.add_parameter("Final strain",
                      final_strain,
                      "Vertical logarithmic strain at the end, compression positive, or shear strain.",
                      Patterns::Double(0, 5));
    prm.add_parameter("Number of steps", n_steps, "Number of equal strain increments.", Patterns::Integer(1));
    prm.add_parameter("Output directory", output_directory, "Folder for table.txt, original.prm and parameters.prm.");
    material.add_parameters(prm);
  }


  void ElementParameters::check() const
  {
    require_entry(confining_pressure > 0,
                  { "", "Initial confining pressure", confining_pressure },
                  "it must be positive, the paths start from compression.");
    require_entry(K0 > 0, { "", "K0", K0 }, "it must be positive, the paths start from compression.");
    material.check("");
    require_entry(
        !material.is_rigid(), { "", "Material", material.law }, "a rigid point has no path. Write a law that deforms.");
  }


  ElementParameters::Path ElementParameters::path() const
  {
    for (const auto &path : paths)
      if (path.first == path_name)
        return path.second;
    AssertThrow(false, ExcMessage("There is no path \"" + path_name + "\"."));
    return Path::drained_triaxial;
  }
} // namespace scree

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_postprocess_probe_parameters_h
#define scree_postprocess_probe_parameters_h

#include <scree/mesh/background_grid.h>

#include <deal.II/base/parameter_handler.h>

#include <string>
#include <vector>

namespace scree
{
  /// A place, a line or a vertical of a case: its name, which is that of its file, and its one or two points, m.
  struct NamedPlace
  {
    std::string name;                        ///< as the case has it
    std::vector<std::vector<double>> points; ///< coordinates, m: one point, or both ends of a line
  };

  /// Subsection Probes: what is written of places, lines, verticals, the front and the walls.
  struct ProbeParameters
  {
    std::string places,                 ///< NAME: x, y; ...
        lines,                          ///< NAME: x, y to x, y; ...
        verticals;                      ///< NAME: x; ..., in 3D NAME: x, y; ...
    unsigned int places_a_line = 51;    ///< number of places on each line
    double front_thickness     = 0;     ///< m; 0: no front
    bool wall_forces           = false; ///< whether forces on the faces of the box are written
    bool displacement          = false; ///< of the points of the pictures

    /// Declares the subsection and its entries.
    void add_parameters(dealii::ParameterHandler &prm);

    /// Throws EntryError at what does not read, lies outside the box or has no name of its own.
    void check(const GridParameters &grid, const unsigned int dim, const bool has_soil) const;

    /// What the entries list. Throw EntryError at what does not read.
    std::vector<NamedPlace> list_of_places(const unsigned int dim) const;

    /// The same of the lines.
    std::vector<NamedPlace> list_of_lines(const unsigned int dim) const;

    /// The same of the verticals; their points have dim - 1 coordinates.
    std::vector<NamedPlace> list_of_verticals(const unsigned int dim) const;
  };
} // namespace scree

#endif

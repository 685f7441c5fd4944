// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_geometry_bed_parameters_h
#define scree_geometry_bed_parameters_h

#include <scree/geometry/level_set.h>
#include <scree/geometry/raster.h>

#include <deal.II/base/parameter_handler.h>

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace scree
{
  /// What a rigid surface does to soil that presses on it.
  enum class BedType
  {
    none,  ///< there is no such surface
    fixed, ///< no slip
    free_slip,
    friction ///< Coulomb's
  };

  /// Subsection Bed: rigid ground that need not follow the mesh. Obstacles have its entries, too.
  struct BedParameters
  {
    std::string subsection = "Bed"; ///< Bed, or Obstacle NAME

    std::string type      = "none";            ///< none | fixed | free slip | friction
    std::string for_water = "impermeable";     ///< impermeable | no slip
    double friction_angle = 0;                 ///< degrees
    std::map<std::string, std::string> shapes; ///< values by entries, see rigid_shapes(); empty: not given
    double turbulent_friction = 0;             ///< xi of Voellmy's law, m/s^2; 0: none; of the bed only

    /// Declares the subsection and its entries.
    void add_parameters(dealii::ParameterHandler &prm);

    /// Where the map has the origin of the case's coordinates, m; set once the case is read.
    dealii::Point<2> map_origin;

    /// Declares the entries in the subsection that the handler is in.
    void add_entries(dealii::ParameterHandler &prm);

    /// Throws EntryError at impossible combinations.
    void check(const unsigned int dim) const;

    /// Entry `Type` as an enum.
    BedType type_kind() const;

    /// Whether free water does not slip along it.
    bool no_slip() const
    {
      return for_water == "no slip";
    }

    /// Whether there is such a surface.
    bool is_set() const
    {
      return type_kind() != BedType::none;
    }

    /// Largest tangential over normal force; infinite if the bed is fixed.
    double friction_coefficient() const;

    /// Entry and value of the shape; empty if none is given.
    std::pair<std::string, std::string> geometry() const;

    /// File of the ground's heights; empty without one.
    std::string raster() const;
  };

  /// The surface; null if there is none. Reads its file; throws EntryError if that is no ground for the box.
  /// @param lower, upper corners of the box, m
  /// @param cell_size of the mesh, m
  template <int dim>
  std::unique_ptr<LevelSet<dim>> make_bed(const BedParameters &parameters,
                                          const std::vector<double> &lower,
                                          const std::vector<double> &upper,
                                          const double cell_size);
} // namespace scree

#endif

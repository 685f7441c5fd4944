// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_transfer_water_view_h
#define scree_transfer_water_view_h

#include <scree/mesh/nodal_field.h>
#include <scree/bodies/water_phase.h>
#include <scree/mixture/mixture.h>

#include <list>

namespace scree
{
  /// What the pictures of a coupled run show beside the soil.
  template <int dim>
  struct WaterView
  {
    const std::list<WaterPhase<dim>> &water; ///< points of the water
    const NodalField<dim> &field;            ///< the water's, solved: its mass and velocity are read
    /// Asked for the cells of this rank that hold points; 0 where there is no pressure.
    PressureOfCell<dim> pressure_of_cell;
  };
} // namespace scree

#endif

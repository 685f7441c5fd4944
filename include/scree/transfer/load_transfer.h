// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_transfer_load_transfer_h
#define scree_transfer_load_transfer_h

#include <scree/grid/nodal_field.h>
#include <scree/transfer/surface_load.h>

namespace scree
{
  /// Activates the nodes of the markers' cells and adds traction times area times phi_i to their force. Returns the sum
  /// of this rank's forces, N (2D: per m); a node without soil drops its part in the solve.
  template <int dim>
  dealii::Tensor<1, dim>
  add_load(const SurfaceLoad<dim> &load, const double time, const BackgroundGrid<dim> &grid, NodalField<dim> &field);

  /// Moves the markers with the soil, at most to the faces of the box, after the solve of the step that began at
  /// `time`. The markers are not sorted yet. Returns the load's work over the step, J (2D: per m): that of add_load()'s
  /// force with the nodes' mean velocity.
  template <int dim>
  double move_load(SurfaceLoad<dim> &load,
                   const double time,
                   const BackgroundGrid<dim> &grid,
                   const NodalField<dim> &field,
                   const double time_step);
} // namespace scree

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef scree_tensor_components_h
#define scree_tensor_components_h

namespace scree
{
  /// Stored components of a symmetric tensor of a body in three dimensions: plane strain (dim = 2) keeps xx, yy, zz,
  /// xy; dim = 3 keeps xx, yy, zz, xy, xz, yz.
  template <int dim>
  constexpr unsigned int n_symmetric_components = dim == 2 ? 4 : 6;
} // namespace scree

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_boundary_wall_impulses_h
#define scree_boundary_wall_impulses_h

#include <deal.II/base/tensor.h>

#include <array>
#include <cstdint>

namespace scree
{
  /// For each axis, the face of the box (in deal.II's numbering) that takes the impulses of walls along it; `none`
  /// where no wall does. At edges a component belongs to the wall across it.
  template <int dim>
  struct BearingFaces
  {
    static constexpr unsigned int none = 2 * dim; ///< stands for no face

    std::array<unsigned int, dim> of_axis; ///< by axis: the face that takes it, in deal.II's numbering

    BearingFaces()
    {
      of_axis.fill(none);
    }

    /// @param faces the node's, bit f: face f
    /// @param is_closed whether a face holds the motion along its normal
    /// @param is_rough whether it acts on the motion along itself
    template <typename IsClosed, typename IsRough>
    BearingFaces(const std::uint8_t faces, const IsClosed &is_closed, const IsRough &is_rough)
        : BearingFaces()
    {
      for (unsigned int a = 0; a < dim; ++a)
        for (unsigned int f = 0; f < 2 * dim; ++f)
          if ((faces >> f) & 1)
            {
              if (f / 2 == a && is_closed(f))
                of_axis[a] = f;
              else if (f / 2 != a && is_rough(f) && of_axis[a] == none)
                of_axis[a] = f;
            }
    }
  };

  /// What each face of the box gave to soil or water, N s (2D: per m).
  template <int dim>
  struct WallImpulses
  {
    std::array<dealii::Tensor<1, dim>, 2 * dim> of_face; ///< by face, in deal.II's numbering

    /// Adds an impulse on soil or water at a node, N s, each component to the face that takes it.
    void add(const BearingFaces<dim> &faces, const dealii::Tensor<1, dim> &impulse)
    {
      for (unsigned int a = 0; a < dim; ++a)
        if (faces.of_axis[a] != BearingFaces<dim>::none)
          of_face[faces.of_axis[a]][a] += impulse[a];
    }

    /// Saves or loads the impulses (Boost).
    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      for (auto &impulse : of_face)
        archive &impulse;
    }
  };
} // namespace scree

#endif

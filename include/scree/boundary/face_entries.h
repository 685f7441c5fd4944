// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_boundary_face_entries_h
#define scree_boundary_face_entries_h

#include <deal.II/base/parameter_handler.h>

#include <string>
#include <vector>

namespace scree
{
  /// One entry a face of the box, in a subsection of walls.
  struct FaceEntries
  {
    std::string left, ///< face at the lower end of x
        right,        ///< upper end of x
        front,        ///< lower end of y, 3D
        back,         ///< upper end of y, 3D
        bottom,       ///< lower end of y in 2D, of z in 3D
        top;          ///< upper end of y in 2D, of z in 3D

    /// Names of the faces in deal.II's numbering: lower and upper face of each axis.
    static std::vector<std::string> names(const unsigned int dim);

    /// The entries in the same order.
    std::vector<std::string> texts(const unsigned int dim) const;

    /// Declares the entries in the subsection that is open; `what` goes on after the name of the face.
    void add_parameters(dealii::ParameterHandler &prm, const std::string &what);

    /// Throws EntryError if an entry of a wall that is not there differs from the default.
    void check(const std::string &subsection, const unsigned int dim, const FaceEntries &defaults) const;
  };
} // namespace scree

#endif

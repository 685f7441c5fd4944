// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_geometry_triangle_surface_h
#define scree_geometry_triangle_surface_h

#include <scree/geometry/box_tree.h>
#include <scree/geometry/level_set.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace scree
{
  /// The surface of a solid, made of triangles; the open is outside. Distances are exact. On which side a place is
  /// tells the normal of the nearest face, edge or corner, the last as the mean of its faces' weighted by their angles
  /// (@source{baerentzen2005}).
  class TriangleSurface : public LevelSet<3>
  {
  public:
    /// Corners nearer to each other than a 1e-7th of the surface's size are one. Throws EntryError, with a place, if a
    /// triangle has no area, if an edge has not two triangles with opposite directions, if triangles cross, or if the
    /// solid is inside out.
    /// @param triangles with corners counter-clockwise seen from the open, m
    /// @param name of entry and file, for messages
    TriangleSurface(const std::vector<Triangle> &triangles, const std::string &name);

    // The tree refers to the boxes.
    TriangleSurface(const TriangleSurface &)            = delete;
    TriangleSurface &operator=(const TriangleSurface &) = delete;

    /// See LevelSet::is_open().
    bool is_open(const dealii::Point<3> &x) const override;

    /// See LevelSet::view().
    SurfaceView<3> view(const dealii::Point<3> &x, const double reach) const override;

    /// Around all of it, m.
    const Box &bounds() const
    {
      return tree.box();
    }

  private:
    using Numbers = std::array<unsigned int, 3>;

    /// Places of a triangle's corners.
    Triangle vertices_of(const unsigned int triangle) const;

    /// Numbers the corners.
    void join_corners(const std::vector<Triangle> &triangles);

    /// Find neighbours, normals and what surrounds the triangles; throw EntryError at faults.
    void find_neighbours(const std::string &name);
    void find_normals(const std::string &name);
    void require_no_crossing(const std::string &name) const;
    void require_outward(const std::string &name) const;

    /// The places of the surface nearest to `x`: a triangle's number and the place.
    std::pair<unsigned int, PlaceOfTriangle> nearest(const dealii::Point<3> &x) const;

    /// What tells sides at a part of a triangle; unit but for corners where that is not possible.
    dealii::Tensor<1, 3> normal_at(const unsigned int triangle, const unsigned int part) const;

    double size = 0; // m, diagonal
    std::vector<dealii::Point<3>> corners;
    std::vector<Numbers> triangles;  // their corners
    std::vector<Numbers> neighbours; // of each triangle, at the edge from its corner to the next one
    std::vector<dealii::Tensor<1, 3>> face_normals, corner_normals;
    BoxTree tree;
  };

  /// Reads an STL file. Throws EntryError, which begins with `where` (see entry_name()), if it is none, or no closed
  /// surface.
  std::unique_ptr<TriangleSurface> read_triangle_surface(const std::string &file, const std::string &where);
} // namespace scree

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/geometry/bed_parameters.h>
#include <scree/input/input_error.h>

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/IO/polygon_soup_io.h>
#include <CGAL/Polygon_mesh_processing/bbox.h>
#include <CGAL/Polygon_mesh_processing/compute_normal.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>

namespace scree
{
  using namespace dealii;

  namespace
  {
    using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
    using Mesh   = CGAL::Surface_mesh<Kernel::Point_3>;
    using Tree   = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, CGAL::AABB_face_graph_triangle_primitive<Mesh>>>;

    Kernel::Point_3 to_cgal(const Point<3> &x)
    {
      return { x[0], x[1], x[2] };
    }

    Point<3> from_cgal(const Kernel::Point_3 &x)
    {
      return { x[0], x[1], x[2] };
    }


    /// A rigid body whose closed surface a file describes. Distances are exact.
    class SurfaceMesh : public LevelSet<3>
    {
    public:
      /// Reads the file; the coordinates are those of the map.
      explicit SurfaceMesh(const ShapeRequest &request)
      {
        namespace polygons = CGAL::Polygon_mesh_processing;
        std::vector<Kernel::Point_3> corners;
        std::vector<std::vector<std::size_t>> faces_of_file;
        bool is_surface = CGAL::IO::read_polygon_soup(request.value, corners, faces_of_file);
        for (const auto &face : faces_of_file)
          for (const std::size_t corner : face)
            is_surface = is_surface && corner < corners.size(); // not looked at by CGAL
        if (is_surface)
          {
            polygons::repair_polygon_soup(corners, faces_of_file);
            is_surface = !faces_of_file.empty() && polygons::orient_polygon_soup(corners, faces_of_file) &&
                         polygons::is_polygon_soup_a_polygon_mesh(faces_of_file);
          }
        request.require(is_surface,
                        "it cannot be read as a surface of polygons. Write the path of a file in STL, OBJ or PLY in "
                        "which each edge is that of two polygons.");
        polygons::polygon_soup_to_polygon_mesh(corners, faces_of_file, mesh);
        for (const auto vertex : mesh.vertices())
          mesh.point(vertex) -= Kernel::Vector_3(request.map_origin[0], request.map_origin[1], 0.);
        for (const auto edge : mesh.halfedges())
          request.require(!mesh.is_border(edge),
                          "the surface is open at " + number_text(from_cgal(mesh.point(mesh.target(edge)))) +
                              " m, so that nothing is inside. Close its holes.");
        polygons::triangulate_faces(mesh);
        std::vector<std::pair<Mesh::Face_index, Mesh::Face_index>> crossing;
        polygons::self_intersections(mesh, std::back_inserter(crossing));
        request.require(crossing.empty(),
                        crossing.empty() ? ""
                                         : "its polygons cross at " +
                                               number_text(from_cgal(
                                                   mesh.point(mesh.target(mesh.halfedge(crossing.front().first))))) +
                                               " m. Unite bodies that overlap, or write an obstacle for each.");
        polygons::orient_to_bound_a_volume(mesh);
        tree.insert(faces(mesh).first, faces(mesh).second, mesh);
        tree.accelerate_distance_queries();
        box  = polygons::bbox(mesh);
        side = std::make_unique<CGAL::Side_of_triangle_mesh<Mesh, Kernel>>(tree);
      }

      bool is_open(const Point<3> &x) const override
      {
        return (*side)(to_cgal(x)) == CGAL::ON_UNBOUNDED_SIDE;
      }

      SurfaceView<3> view(const Point<3> &x, const double reach) const override
      {
        Tensor<1, 3> to_box;
        for (unsigned int a = 0; a < 3; ++a)
          to_box[a] = std::max({ box.min(a) - x[a], x[a] - box.max(a), 0. });
        if (to_box.norm() > reach)
          return { reach, Point<3>::unit_vector(2) };
        const auto [foot, face] = tree.closest_point_and_primitive(to_cgal(x));
        const Tensor<1, 3> way  = x - from_cgal(foot);
        const double distance = way.norm(), sign = is_open(x) ? 1. : -1.;
        if (distance > 1e-10 * (box.xmax() - box.xmin()))
          return { sign * distance, sign / distance * way };
        // On the surface itself the open side is that of the triangle.
        const auto normal = CGAL::Polygon_mesh_processing::compute_face_normal(face, mesh);
        return { sign * distance, Tensor<1, 3>({ normal[0], normal[1], normal[2] }) };
      }

    private:
      Mesh mesh;
      Tree tree;
      CGAL::Bbox_3 box;
      std::unique_ptr<const CGAL::Side_of_triangle_mesh<Mesh, Kernel>> side; // of the tree
    };


    const RegisterShape registered(
        "Surface mesh",
        { "m; 3D. File of the closed surface of a body (STL, OBJ or PLY) in the coordinates of maps; alternative "
          "to \"Level set expression\".",
          ShapeValue::file,
          "a surface mesh is for scenes in space. Write a \"Level set expression\".",
          nullptr,
          [](const ShapeRequest &request) { return std::make_unique<SurfaceMesh>(request); } });
  } // namespace
} // namespace scree

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/geometry/stl_file.h>
#include <scree/geometry/rigid_shape.h>
#include <scree/geometry/triangle_surface.h>
#include <scree/input/input_error.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

namespace scree
{
  using namespace dealii;

  namespace
  {
    constexpr double same_place = 1e-7; // over the surface's size

    std::string place_text(const Point<3> &x)
    {
      return number_text(x) + " m";
    }


    /// Gives places numbers; what is within a tolerance of an earlier one along each axis gets its number.
    class PlaceNumbers
    {
    public:
      explicit PlaceNumbers(const double tolerance)
          : tolerance(tolerance)
      {
      }

      unsigned int operator()(const Point<3> &x, std::vector<Point<3>> &places)
      {
        for (unsigned int side = 0; side < 8; ++side) // the parts of a grid that may hold it
          {
            Point<3> moved = x;
            for (unsigned int a = 0; a < 3; ++a)
              moved[a] += side >> a & 1 ? tolerance : -tolerance;
            const auto [begin, end] = numbers.equal_range(key(moved));
            for (auto entry = begin; entry != end; ++entry)
              if (Tensor<1, 3> way = places[entry->second] - x;
                  std::max({ std::abs(way[0]), std::abs(way[1]), std::abs(way[2]) }) <= tolerance)
                return entry->second;
          }
        numbers.emplace(key(x), places.size());
        places.push_back(x);
        return places.size() - 1;
      }

    private:
      std::array<double, 3> key(const Point<3> &x) const
      {
        return { { std::floor(x[0] / (2. * tolerance)),
                   std::floor(x[1] / (2. * tolerance)),
                   std::floor(x[2] / (2. * tolerance)) } };
      }

      const double tolerance;
      std::multimap<std::array<double, 3>, unsigned int> numbers;
    };


    /// Six times the volume of a tetrahedron, m^3.
    double volume(const Point<3> &a, const Point<3> &b, const Point<3> &c, const Point<3> &d)
    {
      return (b - a) * cross_product_3d(c - a, d - a);
    }


    /// Whether a segment meets a triangle within a tolerance, m; not if it lies in its plane.
    bool meets(const Point<3> &from, const Point<3> &to, const Triangle &triangle, const double tolerance)
    {
      const Tensor<1, 3> normal = across(triangle) / across(triangle).norm();
      const double begin = normal * (from - triangle[0]), end = normal * (to - triangle[0]);
      if (std::max(begin, end) < -tolerance || std::min(begin, end) > tolerance ||
          std::max(std::abs(begin), std::abs(end)) <= tolerance)
        return false;
      const Point<3> crossing = from + std::clamp(begin / (begin - end), 0., 1.) * (to - from);
      return crossing.distance(nearest_place(crossing, triangle).place) <= tolerance;
    }


    /// Part of the sphere around `x` that a triangle covers, over the whole (van Oosterom & Strackee 1983).
    double covered_part(const Point<3> &x, const Triangle &corners)
    {
      const Tensor<1, 3> a = corners[0] - x, b = corners[1] - x, c = corners[2] - x;
      const double la = a.norm(), lb = b.norm(), lc = c.norm();
      return std::atan2(a * cross_product_3d(b, c), la * lb * lc + (a * b) * lc + (b * c) * la + (c * a) * lb) /
             (2. * numbers::PI);
    }
  } // namespace


  TriangleSurface::TriangleSurface(const std::vector<Triangle> &triangles, const std::string &name)
  {
    if (triangles.empty())
      throw EntryError(name + "it has no triangles. Export the surface anew.");
    join_corners(triangles);
    find_neighbours(name);
    find_normals(name);
    std::vector<Triangle> joined;
    for (unsigned int t = 0; t < this->triangles.size(); ++t)
      joined.push_back(vertices_of(t));
    tree = BoxTree(joined);
    require_no_crossing(name);
    require_outward(name);
  }


  Triangle TriangleSurface::vertices_of(const unsigned int triangle) const
  {
    const Numbers &numbers = triangles[triangle];
    return { { corners[numbers[0]], corners[numbers[1]], corners[numbers[2]] } };
  }


  void TriangleSurface::join_corners(const std::vector<Triangle> &of_triangles)
  {
    const Box around = box_around(of_triangles);
    size             = around.lower.distance(around.upper);
    PlaceNumbers number(std::max(same_place * size, std::numeric_limits<double>::min()));
    triangles.reserve(of_triangles.size());
    for (const Triangle &triangle : of_triangles)
      triangles.push_back(
          { { number(triangle[0], corners), number(triangle[1], corners), number(triangle[2], corners) } });
  }


  void TriangleSurface::find_neighbours(const std::string &name)
  {
    struct Side
    {
      unsigned int triangle, edge;
      bool is_forward; // from the corner of the lower number
    };
    std::map<std::pair<unsigned int, unsigned int>, std::vector<Side>> edges;
    for (unsigned int t = 0; t < triangles.size(); ++t)
      {
        const Triangle of_triangle = vertices_of(t);
        double longest             = 0.;
        for (unsigned int i = 0; i < 3; ++i)
          longest = std::max(longest, of_triangle[i].distance(of_triangle[(i + 1) % 3]));
        if (!(across(of_triangle).norm() > same_place * size * longest))
          throw EntryError(name + "triangle " + std::to_string(t + 1) + ", at " + place_text(of_triangle[0]) +
                           ", has no area. Remove such triangles: programs for surfaces call them degenerate.");
        for (unsigned int i = 0; i < 3; ++i)
          {
            const unsigned int from = triangles[t][i], to = triangles[t][(i + 1) % 3];
            edges[std::minmax(from, to)].push_back({ t, i, from < to });
          }
      }
    neighbours.resize(triangles.size());
    for (const auto &[ends, sides] : edges)
      {
        const auto require = [&, &ends = ends, &sides = sides](const bool possible, const std::string &remedy) {
          if (!possible)
            throw EntryError(name + "the edge from " + place_text(corners[ends.first]) + " to " +
                             place_text(corners[ends.second]) + ", of triangle " +
                             std::to_string(sides[0].triangle + 1) + ", " + remedy);
        };
        require(sides.size() > 1,
                "has no other triangle: the surface is not closed. Close its holes, and let triangles meet at whole "
                "edges.");
        require(sides.size() == 2,
                "has " + std::to_string(sides.size()) +
                    " triangles and may have two. Let solids that touch there be one, or keep them apart.");
        require(sides[0].is_forward != sides[1].is_forward,
                "has triangles that face different sides. Turn some, so that all corners go counter-clockwise seen "
                "from outside.");
        for (const unsigned int s : { 0, 1 })
          neighbours[sides[s].triangle][sides[s].edge] = sides[1 - s].triangle;
      }
  }


  void TriangleSurface::find_normals(const std::string &name)
  {
    corner_normals.resize(corners.size());
    for (unsigned int t = 0; t < triangles.size(); ++t)
      {
        const Triangle of_triangle = vertices_of(t);
        face_normals.push_back(across(of_triangle) / across(of_triangle).norm());
        for (unsigned int i = 0; i < 3; ++i)
          {
            const Tensor<1, 3> next = of_triangle[(i + 1) % 3] - of_triangle[i],
                               last = of_triangle[(i + 2) % 3] - of_triangle[i];
            corner_normals[triangles[t][i]] +=
                std::atan2(cross_product_3d(next, last).norm(), next * last) * face_normals[t];
          }
      }
    constexpr double folded = 1e-12;
    for (unsigned int t = 0; t < triangles.size(); ++t)
      for (unsigned int i = 0; i < 3; ++i)
        if ((face_normals[t] + face_normals[neighbours[t][i]]).norm_square() < folded)
          throw EntryError(name + "triangles " + std::to_string(t + 1) + " and " +
                           std::to_string(neighbours[t][i] + 1) + ", at " + place_text(corners[triangles[t][i]]) +
                           ", lie on each other. Remove what has no thickness.");
  }


  void TriangleSurface::require_no_crossing(const std::string &name) const
  {
    const double tolerance = same_place * size;
    for (unsigned int t = 0; t < triangles.size(); ++t)
      {
        const Triangle of_t = vertices_of(t);
        const Numbers &own  = triangles[t];
        // Each looks with its edges at all others; what two have at a common corner is left out.
        tree.visit_touching(box_around({ of_t }), [&](const unsigned int other) {
          const auto is_common = [&of_other = triangles[other]](const unsigned int corner) {
            return std::find(of_other.begin(), of_other.end(), corner) != of_other.end();
          };
          if (std::count_if(own.begin(), own.end(), is_common) > 1)
            return;
          const Triangle of_other = vertices_of(other);
          for (unsigned int i = 0; i < 3; ++i)
            if (const unsigned int next = (i + 1) % 3;
                !is_common(own[i]) && !is_common(own[next]) && meets(of_t[i], of_t[next], of_other, tolerance))
              throw EntryError(name + "triangles " + std::to_string(std::min(t, other) + 1) + " and " +
                               std::to_string(std::max(t, other) + 1) + ", at " + place_text(of_t[i]) +
                               ", cross or touch each other. Let the surface not cross itself: unite its parts.");
        });
      }
  }


  void TriangleSurface::require_outward(const std::string &name) const
  {
    // Parts that hang together by edges: a solid each, or a hole in one.
    constexpr unsigned int none = numbers::invalid_unsigned_int;
    std::vector<unsigned int> part_of(triangles.size(), none), waiting;
    std::vector<double> volumes;
    std::vector<unsigned int> first_of_part;
    for (unsigned int t = 0; t < triangles.size(); ++t)
      {
        if (part_of[t] != none)
          continue;
        const unsigned int part = volumes.size();
        volumes.push_back(0.);
        first_of_part.push_back(t);
        waiting    = { t };
        part_of[t] = part;
        while (!waiting.empty())
          {
            const unsigned int one = waiting.back();
            waiting.pop_back();
            const Triangle of_one = vertices_of(one);
            volumes[part] += volume(bounds().lower, of_one[0], of_one[1], of_one[2]);
            for (const unsigned int next : neighbours[one])
              if (part_of[next] == none)
                {
                  part_of[next] = part;
                  waiting.push_back(next);
                }
          }
      }
    for (unsigned int part = 0; part < volumes.size(); ++part)
      {
        const Point<3> &place = corners[triangles[first_of_part[part]][0]];
        double n_around       = 0.; // other parts
        for (unsigned int t = 0; t < triangles.size() && volumes.size() > 1; ++t)
          if (part_of[t] != part)
            n_around += covered_part(place, vertices_of(t));
        const bool is_hole = volumes[part] < 0.;
        if (std::lround(n_around) != (is_hole ? 1 : 0))
          throw EntryError(name + "its part at " + place_text(place) +
                           (is_hole ? " is inside out: its normals point inwards. Turn its triangles around."
                                    : " lies inside another. Remove it, or turn its triangles around if it is a "
                                      "hole."));
      }
  }


  std::pair<unsigned int, PlaceOfTriangle> TriangleSurface::nearest(const Point<3> &x) const
  {
    std::pair<unsigned int, PlaceOfTriangle> best{ 0, {} };
    double smallest = std::numeric_limits<double>::infinity(); // square of the distance
    tree.visit_nearer(x, smallest, [&](const unsigned int triangle) {
      const PlaceOfTriangle place = nearest_place(x, vertices_of(triangle));
      if (const double square = place.place.distance_square(x); square < smallest)
        {
          smallest = square;
          best     = { triangle, place };
        }
    });
    return best;
  }


  Tensor<1, 3> TriangleSurface::normal_at(const unsigned int triangle, const unsigned int part) const
  {
    Tensor<1, 3> normal = face_normals[triangle];
    if (part > 3)
      normal = corner_normals[triangles[triangle][part - 4]];
    else if (part > 0)
      normal += face_normals[neighbours[triangle][part - 1]];
    return normal / std::max(normal.norm(), std::numeric_limits<double>::min());
  }


  bool TriangleSurface::is_open(const Point<3> &x) const
  {
    if (bounds().distance_square(x) > 0.)
      return true;
    const auto [triangle, place] = nearest(x);
    return (x - place.place) * normal_at(triangle, place.part) > 0.;
  }


  SurfaceView<3> TriangleSurface::view(const Point<3> &x, const double reach) const
  {
    const auto [triangle, place] = nearest(x);
    const Tensor<1, 3> way = x - place.place, normal = normal_at(triangle, place.part);
    const double distance = way.norm(), side = way * normal > 0. ? 1. : -1.;
    // On the surface itself only the triangle tells where the open is.
    return { side * std::min(distance, reach), distance > 1e-10 * size ? side / distance * way : normal };
  }


  std::unique_ptr<TriangleSurface> read_triangle_surface(const std::string &file, const std::string &where)
  {
    const std::string name = where + " = " + file + ": ";
    return std::make_unique<TriangleSurface>(read_stl(file, name), name);
  }


  namespace
  {
    std::unique_ptr<LevelSet<3>> make_triangle_surface(const ShapeRequest &request)
    {
      auto surface              = read_triangle_surface(request.value, request.where());
      const auto &[first, last] = surface->bounds();
      bool is_in_box            = true;
      for (unsigned int a = 0; a < 3; ++a)
        is_in_box = is_in_box && first[a] < request.upper[a] && last[a] > request.lower[a];
      request.require(is_in_box,
                      "it reaches from " + number_text(first) + " to " + number_text(last) +
                          " m and lies outside the box of subsection Mesh. Look at its unit of length and its origin.");
      return surface;
    }


    const RegisterShape registered_triangle_surface(
        "Closed surface",
        { "m; 3D. STL file of the surface of a solid; alternative to \"Level set expression\".",
          ShapeValue::file,
          "solids of triangles are for scenes in space. Write a \"Profile\" or a \"Level set expression\".",
          nullptr,
          make_triangle_surface });
  } // namespace
} // namespace scree

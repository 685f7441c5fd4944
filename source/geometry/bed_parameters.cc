// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/geometry/bed_parameters.h>
#include <scree/input/number_table.h>

#include <limits>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// Made at the first call, whichever source file registers first.
    auto &shapes()
    {
      static std::vector<std::pair<std::string, RigidShape>> all;
      return all;
    }


    /// 0: all, 1: plane ones, 2: those in space.
    int scenes_of(const RigidShape &shape)
    {
      return !shape.make_3d ? 1 : !shape.make_2d ? 2 : 0;
    }
  } // namespace


  const std::vector<std::pair<std::string, RigidShape>> &rigid_shapes()
  {
    return shapes();
  }


  std::string names_of_shapes()
  {
    const std::string scenes[] = { "", " (2D)", " (3D)" };
    std::string names;
    for (const auto &one : shapes())
      names += (&one == &shapes().front()  ? ""
                : &one == &shapes().back() ? " and "
                                           : ", ") +
               quoted(one.first) + scenes[scenes_of(one.second)];
    return names;
  }


  RegisterShape::RegisterShape(const std::string &entry, RigidShape shape)
  {
    shapes().emplace_back(entry, std::move(shape));
    std::sort(shapes().begin(), shapes().end(), [](const auto &a, const auto &b) {
      return std::make_pair(scenes_of(a.second), a.first) < std::make_pair(scenes_of(b.second), b.first);
    });
  }


  void BedParameters::add_entries(ParameterHandler &prm)
  {
    prm.add_parameter("Type",
                      type,
                      "Condition for soil that presses on the rigid surface: fixed (no slip), free slip or friction. "
                      "none: no surface. The surface may cut cells at any position and angle.",
                      Patterns::Selection("none|fixed|free slip|friction"));
    prm.add_parameter("Type for water",
                      for_water,
                      "Condition for free water along the surface: impermeable (free slip), or no slip, which needs "
                      "\"Viscosity\" in subsection Water.",
                      Patterns::Selection("impermeable|no slip"));
    prm.add_parameter("Friction angle",
                      friction_angle,
                      "degrees; friction angle of \"Type = friction\", above 0 and below 90.",
                      Patterns::Double(0, 89.99));
    for (const auto &[entry, shape] : rigid_shapes())
      if (shape.value == ShapeValue::file)
        add_file_entry(prm, entry, shapes[entry], shape.documentation);
      else
        prm.add_parameter(entry, shapes[entry], shape.documentation);
  }


  namespace
  {
    template <int dim>
    std::unique_ptr<LevelSet<dim>> make_shape(const BedParameters &parameters,
                                              const std::vector<double> &lower,
                                              const std::vector<double> &upper,
                                              const double cell_size)
    {
      const auto [given, value] = parameters.geometry();
      for (const auto &[entry, shape] : rigid_shapes())
        if (entry == given)
          return shape.template make<dim>()(
              { parameters.subsection, entry, value, parameters.map_origin, lower, upper, cell_size });
      return nullptr;
    }
  } // namespace


  void BedParameters::check(const unsigned int dim) const
  {
    const auto require =
        [this](const bool possible, const std::string &entry, const auto &value, const std::string &remedy) {
          require_entry(possible, { subsection, entry, value }, remedy);
        };
    const auto given    = geometry();
    const bool is_rough = type_kind() == BedType::friction;
    const auto n_given =
        std::count_if(shapes.begin(), shapes.end(), [](const auto &shape) { return !shape.second.empty(); });
    const std::string no_friction = "this entry has no effect. Remove it, or write \"Type = friction\".",
                      no_type = "\"Type = none\" does not take this entry. Choose another type, or remove the entry.";
    require(is_rough || friction_angle == 0., "Friction angle", friction_angle, no_friction);
    require(!is_rough || friction_angle > 0.,
            "Friction angle",
            friction_angle,
            "write an angle above 0, in degrees, or \"Type = free slip\".");
    require(is_rough || turbulent_friction == 0., "Turbulent friction", turbulent_friction, no_friction);
    require(is_set() || n_given == 0, given.first, given.second, no_type);
    require(is_set() || !no_slip(), "Type for water", for_water, no_type);
    if (!is_set())
      return;
    require(n_given > 0, "Type", type, "the surface has no geometry. Write one of " + names_of_shapes() + '.');
    require(n_given < 2, given.first, given.second, "it is given twice. Keep one of " + names_of_shapes() + '.');
    for (const auto &[entry, shape] : rigid_shapes())
      if (entry == given.first)
        {
          require(dim == 2 ? bool(shape.make_2d) : bool(shape.make_3d), entry, given.second, shape.remedy);
          if (shape.value == ShapeValue::text)
            dim == 2 ? void(make_shape<2>(*this, {}, {}, 1.)) : void(make_shape<3>(*this, {}, {}, 1.));
        }
  }


  template <int dim>
  std::unique_ptr<LevelSet<dim>> make_bed(const BedParameters &parameters,
                                          const std::vector<double> &lower,
                                          const std::vector<double> &upper,
                                          const double cell_size)
  {
    return parameters.is_set() ? make_shape<dim>(parameters, lower, upper, cell_size) : nullptr;
  }

  template decltype(make_bed<2>) make_bed<2>;
  template decltype(make_bed<3>) make_bed<3>;


  const std::string ObstacleParameters::prefix = "Obstacle ";


  namespace
  {
    /// How thick a body is behind a place of its surface, m: `width` if that much or more, or if the surface on the
    /// other side is oblique to this one, as beside an edge.
    template <int dim>
    double thickness_behind(const LevelSet<dim> &surface,
                            const Point<dim> &place,
                            const Tensor<1, dim> &normal,
                            const double width)
    {
      constexpr double rounding = 1e-3, oblique = -0.9; // of the width; of the product of the normals
      constexpr unsigned int n_halvings = 30;
      double inside = rounding * width, outside = (1. - rounding) * width;
      const auto is_inside = [&](const double depth) { return !surface.is_open(place - depth * normal); };
      if (is_inside(-inside) || !is_inside(inside) || is_inside(outside))
        return width;
      for (unsigned int i = 0; i < n_halvings; ++i)
        {
          const double middle                    = 0.5 * (inside + outside);
          (is_inside(middle) ? inside : outside) = middle;
        }
      const Point<dim> behind = place - outside * normal;
      return surface.view(behind, width).normal * normal < oblique ? outside : width;
    }
  } // namespace


  template <int dim>
  void BedParameters::check_place(const std::vector<double> &lower,
                                  const std::vector<double> &upper,
                                  const double cell_size,
                                  const bool has_to_be_in_box) const
  {
    constexpr double most_places = 1e5;
    const auto shape             = make_bed<dim>(*this, lower, upper, cell_size);
    std::array<unsigned int, dim> n{};
    double spacing = cell_size, n_places = 0;
    for (;; spacing *= 2.)
      {
        n_places = 1;
        for (unsigned int a = 0; a < dim; ++a)
          n_places *= n[a] = 1 + static_cast<unsigned int>(std::ceil((upper[a] - lower[a]) / spacing - 1e-6));
        if (n_places <= most_places)
          break;
      }
    // Between the places, half a diagonal away from one at most, the obstacle may be thin.
    const double half_diagonal = 0.5 * std::sqrt(dim) * spacing;
    bool is_in_box             = false;
    double thinnest            = cell_size;
    Point<dim> where;
    for (unsigned int i = 0; i < n_places; ++i)
      {
        Point<dim> x;
        for (unsigned int a = 0, rest = i; a < dim; rest /= n[a], ++a)
          x[a] = lower[a] + std::min(rest % n[a] * spacing, upper[a] - lower[a]);
        const SurfaceView<dim> view = shape->view(x, 2. * half_diagonal);
        is_in_box                   = is_in_box || view.distance <= half_diagonal;
        const Point<dim> foot       = x - view.distance * view.normal;
        bool is_far                 = std::abs(view.distance) > 1.9 * half_diagonal;
        for (unsigned int a = 0; a < dim; ++a)
          is_far = is_far || foot[a] < lower[a] || foot[a] > upper[a];
        if (is_far)
          continue;
        if (const double thickness = thickness_behind(*shape, foot, view.normal, cell_size); thickness < thinnest)
          {
            thinnest = thickness;
            where    = foot;
          }
      }
    const auto [entry, value] = geometry();
    require_entry(is_in_box || !has_to_be_in_box,
                  { subsection, entry, value },
                  "no part of the obstacle lies in the box of subsection Mesh. Move it (it is where the expression is "
                  "negative), or make the box larger.");
    require_entry(thinnest == cell_size,
                  { subsection, entry, value },
                  "at " + number_text(where) + " m it is " + number_text(thinnest) + " m thick, less than a cell of " +
                      number_text(cell_size) +
                      " m, and soil passes through it. Write a thicker one, of three cells for a good load on it, or "
                      "smaller cells.");
  }

  template void BedParameters::check_place<2>(const std::vector<double> &,
                                              const std::vector<double> &,
                                              const double,
                                              const bool) const;
  template void BedParameters::check_place<3>(const std::vector<double> &,
                                              const std::vector<double> &,
                                              const double,
                                              const bool) const;


  template <int dim>
  bool ExpressionSurface<dim>::is_open(const Point<dim> &x) const
  {
    return function->value(x) > 0.;
  }


  template <int dim>
  Tensor<1, dim> ExpressionSurface<dim>::gradient(const Point<dim> &x) const
  {
    const double step = 1e-4 * length;
    Tensor<1, dim> result;
    for (unsigned int a = 0; a < dim; ++a)
      {
        const Tensor<1, dim> along = step * Point<dim>::unit_vector(a);
        result[a]                  = (function->value(x + along) - function->value(x - along)) / (2. * step);
      }
    return result;
  }


  template <int dim>
  SurfaceView<dim> ExpressionSurface<dim>::view(const Point<dim> &x, const double reach) const
  {
    double value           = function->value(x);
    Tensor<1, dim> slope   = gradient(x);
    double size            = slope.norm();
    const double far       = std::copysign(reach, value);
    const double estimate  = size > 0. ? value / size : far;
    SurfaceView<dim> first = { estimate, size > 0. ? slope / size : Point<dim>::unit_vector(dim - 1) };
    if (size == 0. || std::abs(estimate) > 2. * reach)
      return { far, first.normal };

    constexpr unsigned int most_steps = 30;
    Point<dim> foot                   = x;
    for (unsigned int k = 0; k < most_steps && size > 0.; ++k)
      {
        const Tensor<1, dim> normal = slope / size, way = x - foot;
        const Tensor<1, dim> step = way - (way * normal + value / size) * normal;
        foot += step;
        value = function->value(foot);
        slope = gradient(foot);
        size  = slope.norm();
        if (step.norm() < 1e-10 * length && size > 0.)
          return { (x - foot) * (slope / size), slope / size };
      }
    return first;
  }

  template class ExpressionSurface<2>;
  template class ExpressionSurface<3>;


  namespace
  {
    template <int dim>
    std::unique_ptr<LevelSet<dim>> make_expression(const ShapeRequest &request)
    {
      return std::make_unique<ExpressionSurface<dim>>(request.where(), request.value, request.cell_size);
    }


    const RegisterShape registered_expression_surface(
        "Level set expression",
        { "m; expression of x, y (z): positive in the open, 0 on the surface. A signed distance is best, "
          "such as (y - 0.2*x)/sqrt(1.04).",
          ShapeValue::text,
          "",
          make_expression<2>,
          make_expression<3> });
  } // namespace


  unsigned int Profile::segment_at(const double x) const
  {
    const auto behind =
        std::upper_bound(points.begin(), points.end(), x, [](const double a, const Point<2> &b) { return a < b[0]; });
    const auto n = behind - points.begin();
    return std::clamp<int>(n - 1, 0, int(points.size()) - 2);
  }


  double Profile::height(const double x) const
  {
    const unsigned int s = segment_at(x);
    const Point<2> &a = points[s], &b = points[s + 1];
    const double part = std::clamp((x - a[0]) / (b[0] - a[0]), 0., 1.);
    return a[1] + part * (b[1] - a[1]);
  }


  bool Profile::is_open(const Point<2> &x) const
  {
    return x[1] > height(x[0]);
  }


  SurfaceView<2> Profile::view(const Point<2> &x, const double reach) const
  {
    const double above = x[1] - height(x[0]), side = above > 0. ? 1. : -1.;
    double shortest = std::min(reach, std::abs(above));
    SurfaceView<2> best{ side * shortest, Tensor<1, 2>({ 0., 1. }) };
    const auto look_at = [&](const unsigned int s) {
      const Tensor<1, 2> along = points[s + 1] - points[s];
      const double part        = std::clamp((x - points[s]) * along / along.norm_square(), 0., 1.);
      const Tensor<1, 2> way   = x - (points[s] + part * along);
      const double distance    = way.norm();
      if (distance > shortest)
        return;
      shortest      = distance;
      best.distance = side * distance;
      // On the ground itself the open side is that of the segment.
      best.normal = distance > 1e-10 * along.norm() ? side / distance * way
                                                    : Tensor<1, 2>({ -along[1], along[0] }) / along.norm();
    };
    const int middle = segment_at(x[0]), n = points.size() - 1;
    look_at(middle);
    for (int s = middle - 1; s >= 0 && x[0] - points[s + 1][0] < shortest; --s)
      look_at(s);
    for (int s = middle + 1; s < n && points[s][0] - x[0] < shortest; ++s)
      look_at(s);
    return best;
  }


  namespace
  {
    /// Reads the points "x, y", m.
    std::unique_ptr<LevelSet<2>> make_profile(const ShapeRequest &request)
    {
      std::vector<Point<2>> points;
      for (const auto &row : read_number_table(request.value, request.where(), { "x (m)", "y (m)" }))
        points.emplace_back(row[0], row[1]);
      request.require_cover(0, points.front()[0], points.back()[0], 0.);
      return std::make_unique<Profile>(std::move(points));
    }


    const RegisterShape registered_profile(
        "Profile",
        { "m; 2D. File of ground points x, y, one per line, with ascending x; alternative to \"Level set expression\".",
          ShapeValue::file,
          "a profile is ground of plane scenes. Write a \"Raster\" or a \"Level set expression\".",
          make_profile,
          nullptr });
  } // namespace


  double HeightSurface::height(const double x, const double y) const
  {
    const double u = (x - raster.x) / raster.spacing, v = (y - raster.y) / raster.spacing;
    const int i    = std::clamp(static_cast<int>(std::floor(u)), 0, int(raster.n_columns) - 2);
    const int j    = std::clamp(static_cast<int>(std::floor(v)), 0, int(raster.n_rows) - 2);
    const double s = std::clamp(u - i, 0., 1.), t = std::clamp(v - j, 0., 1.);
    const double a = raster(i, j), b = raster(i + 1, j), c = raster(i, j + 1), d = raster(i + 1, j + 1);
    if (!has_ground(i, j))
      return std::numeric_limits<double>::quiet_NaN();
    // The diagonal goes from b to c.
    return s + t <= 1. ? a + s * (b - a) + t * (c - a) : d + (1. - s) * (c - d) + (1. - t) * (b - d);
  }


  bool HeightSurface::is_open(const Point<3> &x) const
  {
    return !(x[2] <= height(x[0], x[1]));
  }


  SurfaceView<3> HeightSurface::view(const Point<3> &x, const double reach) const
  {
    const double above = x[2] - height(x[0], x[1]), side = above <= 0. ? -1. : 1.;
    double shortest = std::isnan(above) ? reach : std::min(reach, std::abs(above));
    SurfaceView<3> best{ side * shortest, Tensor<1, 3>({ 0., 0., 1. }) };
    const auto look_at = [&](const Triangle &corners) {
      const Tensor<1, 3> way = x - nearest_place(x, corners).place;
      const double distance  = way.norm();
      if (distance > shortest)
        return;
      shortest                  = distance;
      const Tensor<1, 3> normal = across(corners);
      // On the ground itself the open side is that of the triangle.
      best = { side * distance, distance > 1e-10 * raster.spacing ? side / distance * way : normal / normal.norm() };
    };
    const auto range = [&](const double place, const double first, const unsigned int n) {
      const auto number = [&](const double at) {
        return static_cast<int>(std::clamp(std::floor((at - first) / raster.spacing), 0., n - 2.));
      };
      return std::make_pair(number(place - shortest), number(place + shortest));
    };
    const auto look_at_ground = [&](const int i, const int j) {
      const Point<3> a = node(i, j), b = node(i + 1, j), c = node(i, j + 1), d = node(i + 1, j + 1);
      // No place of this square is nearer than its box.
      const auto [low, high] = std::minmax({ a[2], b[2], c[2], d[2] });
      const Tensor<1, 3> beyond({ std::max({ a[0] - x[0], x[0] - d[0], 0. }),
                                  std::max({ a[1] - x[1], x[1] - d[1], 0. }),
                                  std::max({ low - x[2], x[2] - high, 0. }) });
      if (beyond.norm() * (1. - 1e-12) > shortest)
        return;
      look_at({ { a, b, c } });
      look_at({ { d, c, b } });
    };
    const auto [first_column, last_column] = range(x[0], raster.x, raster.n_columns);
    const auto [first_row, last_row]       = range(x[1], raster.y, raster.n_rows);
    if (const int i = (first_column + last_column) / 2, j = (first_row + last_row) / 2; has_ground(i, j))
      look_at_ground(i, j); // near at once, so that the others are left out
    for (int j = first_row; j <= last_row; ++j)
      for (int i = first_column; i <= last_column; ++i)
        {
          if (!has_ground(i, j))
            continue;
          look_at_ground(i, j);
          const Point<3> a = node(i, j), b = node(i + 1, j), c = node(i, j + 1), d = node(i + 1, j + 1);
          // The ground ends beside missing heights in a vertical wall; its normal points to them.
          const auto look_at_wall = [&](const int column, const int row, const Point<3> &left, const Point<3> &right) {
            if (column < 0 || row < 0 || column + 1 == int(raster.n_columns) || row + 1 == int(raster.n_rows) ||
                has_ground(column, row))
              return;
            Point<3> below_left = left, below_right = right;
            below_left[2] = below_right[2] = std::min({ left[2], right[2], x[2] }) - reach;
            look_at({ { left, below_left, right } });
            look_at({ { below_right, right, below_left } });
          };
          look_at_wall(i, j - 1, a, b);
          look_at_wall(i + 1, j, b, d);
          look_at_wall(i, j + 1, d, c);
          look_at_wall(i - 1, j, c, a);
        }
    return best;
  }


  namespace
  {
    std::unique_ptr<LevelSet<3>> make_height_surface(const ShapeRequest &request)
    {
      Raster raster         = read_raster(request.value, request.where(), request.map_origin);
      const double rounding = 1e-6 * raster.spacing;
      request.require_cover(0, raster.x, raster.last_x(), rounding);
      request.require_cover(1, raster.y, raster.last_y(), rounding);
      return std::make_unique<HeightSurface>(std::move(raster));
    }


    const RegisterShape registered_height_surface(
        "Raster",
        { "m; 3D. Raster (ESRI ASCII grid or GeoTIFF) of the ground heights; alternative to \"Level set expression\".",
          ShapeValue::file,
          "a raster is ground of scenes in space. Write a \"Profile\" or a \"Level set expression\".",
          nullptr,
          make_height_surface });
  } // namespace
} // namespace scree

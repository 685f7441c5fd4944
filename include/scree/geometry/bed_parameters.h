// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_geometry_bed_parameters_h
#define scree_geometry_bed_parameters_h

#include <scree/geometry/level_set.h>
#include <scree/geometry/raster.h>
#include <scree/input/case_entries.h>
#include <scree/input/expression.h>

#include <deal.II/base/utilities.h>

#include <functional>
#include <limits>
#include <map>

namespace scree
{
  /// Place of a rigid surface, and the entry of its shape.
  struct ShapeRequest
  {
    std::string subsection;      ///< Bed, or Obstacle NAME
    std::string entry;           ///< such as Profile
    std::string value;           ///< of the entry; of a file its path from the working folder
    dealii::Point<2> map_origin; ///< where the map has the origin of the case's coordinates, m
    std::vector<double> lower;   ///< corner of the box, m
    std::vector<double> upper;   ///< corner of the box, m
    double cell_size;            ///< of the mesh, m

    /// entry_name(), for messages.
    std::string where() const
    {
      return entry_name(subsection, entry);
    }

    /// Throws EntryError that names entry and value unless the shape is `possible`.
    void require(const bool possible, const std::string &remedy) const
    {
      require_entry(possible, { subsection, entry, value }, remedy);
    }

    /// The same unless ground from `first` to `last` along an axis, but for `rounding`, covers the box; m.
    void require_cover(const unsigned int axis, const double first, const double last, const double rounding) const
    {
      require(first <= lower[axis] + rounding && last >= upper[axis] - rounding,
              std::string("the ground reaches from ") + "xyz"[axis] + " = " + coordinate_text(first) + " to " +
                  coordinate_text(last) +
                  " m only and does not cover the box of subsection Mesh. Write a longer ground or a smaller box.");
    }
  };

  /// Makes the surface; throws EntryError if the value of the entry or its file is wrong.
  template <int dim>
  using MakeShape = std::function<std::unique_ptr<LevelSet<dim>>(const ShapeRequest &)>;

  /// What the value of an entry is.
  enum class ShapeValue
  {
    text, ///< made once without a box when the case is checked, so that its faults show then
    file
  };

  /// A shape of rigid surfaces: an entry of subsections Bed and Obstacle.
  struct RigidShape
  {
    std::string documentation; ///< of the entry
    ShapeValue value;          ///< what the value of the entry is
    std::string remedy;        ///< for scenes of the dimension that it is not for; empty: it is for both
    MakeShape<2> make_2d;      ///< null: it is for scenes in space only
    MakeShape<3> make_3d;      ///< null: it is for plane scenes only

    /// make_2d or make_3d.
    template <int dim>
    const MakeShape<dim> &make() const
    {
      if constexpr (dim == 2)
        return make_2d;
      else
        return make_3d;
    }
  };

  /// All shapes by their entries: those for all scenes come first, then those of plane ones.
  const std::vector<std::pair<std::string, RigidShape>> &rigid_shapes();

  /// Their entries, for messages.
  std::string names_of_shapes();

  /// Adds a shape; its source file has one as a static constant.
  class RegisterShape
  {
  public:
    /// @param entry its name in subsections Bed and Obstacle
    RegisterShape(const std::string &entry, RigidShape shape);
  };

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
    void add_parameters(dealii::ParameterHandler &prm)
    {
      prm.enter_subsection(subsection);
      add_entries(prm);
      prm.add_parameter(
          "Turbulent friction",
          turbulent_friction,
          "m/s^2; coefficient xi of the friction of Voellmy, rho g v^2/xi beside that of the angle. 0: none. "
          "Dry scenes.",
          dealii::Patterns::Double(0));
      prm.leave_subsection();
    }

    /// Where the map has the origin of the case's coordinates, m; set once the case is read.
    dealii::Point<2> map_origin;

    /// Declares the entries in the subsection that the handler is in.
    void add_entries(dealii::ParameterHandler &prm);

    /// Throws EntryError at impossible combinations.
    void check(const unsigned int dim) const;

    /// Throws EntryError if the body behind the surface is thinner than a cell anywhere in the box, where soil passes
    /// through it, or if it has to be in the box and is not.
    /// @param lower, upper corners of the box, m
    /// @param cell_size of the mesh, m
    template <int dim>
    void check_place(const std::vector<double> &lower,
                     const std::vector<double> &upper,
                     const double cell_size,
                     const bool has_to_be_in_box) const;

    /// Entry `Type` as an enum.
    BedType type_kind() const
    {
      if (type == "fixed")
        return BedType::fixed;
      if (type == "free slip")
        return BedType::free_slip;
      return type == "friction" ? BedType::friction : BedType::none;
    }

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
    double friction_coefficient() const
    {
      switch (type_kind())
        {
        case BedType::fixed:
          return std::numeric_limits<double>::infinity();
        case BedType::friction:
          return std::tan(friction_angle * dealii::numbers::PI / 180.);
        default:
          return 0.;
        }
    }

    /// Entry and value of the shape; empty if none is given.
    std::pair<std::string, std::string> geometry() const
    {
      std::pair<std::string, std::string> last;
      for (const auto &[entry, shape] : rigid_shapes())
        if (const auto value = shapes.find(entry); value != shapes.end() && !value->second.empty())
          last = *value;
      return last;
    }

    /// File of the ground's heights; empty without one.
    std::string raster() const
    {
      const auto value = shapes.find("Raster");
      return value == shapes.end() ? "" : value->second;
    }
  };

  /// The surface; null if there is none. Reads its file; throws EntryError if that is no ground for the box.
  /// @param lower, upper corners of the box, m
  /// @param cell_size of the mesh, m
  template <int dim>
  std::unique_ptr<LevelSet<dim>> make_bed(const BedParameters &parameters,
                                          const std::vector<double> &lower,
                                          const std::vector<double> &upper,
                                          const double cell_size);

  /// Subsection Obstacle NAME: a rigid body that soil and water meet, at rest or moved without turning.
  struct ObstacleParameters
  {
    /// What the names of the subsections begin with.
    static const std::string prefix;

    BedParameters surface; ///< of the start
    std::string velocity;  ///< m/s, of t, one expression an axis; empty: at rest
    std::string pivot;     ///< of the moment, m, one number an axis; empty: the middle of the box's floor

    /// @param subsection prefix and name
    explicit ObstacleParameters(const std::string &subsection)
    {
      surface.subsection = subsection;
    }

    /// Declares the subsection and its entries.
    void add_parameters(dealii::ParameterHandler &prm)
    {
      prm.enter_subsection(surface.subsection);
      surface.add_entries(prm);
      prm.add_parameter(
          "Velocity",
          velocity,
          "m/s; velocity from t = 0 on: one expression of t per axis, separated by semicolons, such as 0; "
          "if(t < 1, 0.5, 0). The obstacle translates without rotation. Empty: at rest.");
      prm.add_parameter("Moment about",
                        pivot,
                        "m; place about which the moment on the obstacle is computed, one coordinate per axis. Empty: "
                        "the middle of the floor of the box.",
                        dealii::Patterns::List(dealii::Patterns::Double(), 0, 3));
      prm.leave_subsection();
    }

    /// Throws EntryError at impossible combinations.
    void check(const unsigned int dim) const
    {
      surface.check(dim);
      if (!velocity.empty())
        parse_expression<1>(entry_name(surface.subsection, "Velocity"), velocity, dim);
      require_entry(pivot.empty() || dealii::Utilities::split_string_list(pivot).size() == dim,
                    { surface.subsection, "Moment about", pivot },
                    "write " + std::to_string(dim) + " numbers in m, separated by commas.");
    }

    /// Without the prefix.
    std::string name() const
    {
      return surface.subsection.substr(prefix.size());
    }

    /// Whether a velocity is given.
    bool is_moving() const
    {
      return !velocity.empty();
    }
  };

  /// The surface on which an expression of the coordinates is 0; the open is where it is positive.
  ///
  /// It need not be a distance: the foot y of a place x on the surface is found from f(y) = 0 and x - y along grad f(y)
  /// (@source{chopp2001}). Where that fails, at an edge, the distance is f/|grad f| at x.
  template <int dim>
  class ExpressionSurface : public LevelSet<dim>
  {
  public:
    /// @param where entry_name(), for messages
    /// @param length of what the mesh resolves, m
    ExpressionSurface(const std::string &where, const std::string &expression, const double length)
        : function(parse_expression<dim>(where, expression, 1, "", dim == 2 ? "y - 0.2*x" : "z - 0.2*x"))
        , length(length)
    {
    }

    /// Both throw ValueError if the expression is no number there.
    bool is_open(const dealii::Point<dim> &x) const override;
    SurfaceView<dim> view(const dealii::Point<dim> &x, const double reach) const override;

  private:
    /// By central differences.
    dealii::Tensor<1, dim> gradient(const dealii::Point<dim> &x) const;

    std::unique_ptr<Expression<dim>> function;
    const double length;
  };

  /// The ground of a plane scene: a line through points with ascending x; the open is above it. Distances are exact.
  class Profile : public LevelSet<2>
  {
  public:
    /// @param points at least two, x strictly ascending, m; beyond them the ground goes on level
    explicit Profile(std::vector<dealii::Point<2>> points)
        : points(std::move(points))
    {
      Assert(this->points.size() >= 2, dealii::ExcInternalError());
    }

    /// See LevelSet::is_open().
    bool is_open(const dealii::Point<2> &x) const override;

    /// See LevelSet::view().
    SurfaceView<2> view(const dealii::Point<2> &x, const double reach) const override;

    /// The elevation at a place along x, m.
    double height(const double x) const;

    /// The same line higher up by `height`, m.
    Profile raised(const double height) const
    {
      std::vector<dealii::Point<2>> raised = points;
      for (dealii::Point<2> &point : raised)
        point[1] += height;
      return Profile(std::move(raised));
    }

  private:
    /// The segment at a place along x: that between points s and s + 1.
    unsigned int segment_at(const double x) const;

    std::vector<dealii::Point<2>> points;
  };

  /// The ground of a scene in space: the heights of a raster, joined by two triangles for each four of them. The open
  /// is above it, and where a height is missing; the ground ends there in vertical walls. Distances are exact.
  class HeightSurface : public LevelSet<3>
  {
  public:
    /// @param raster heights, m, at least 2 x 2
    explicit HeightSurface(Raster raster)
        : raster(std::move(raster))
    {
    }

    /// See LevelSet::is_open().
    bool is_open(const dealii::Point<3> &x) const override;

    /// See LevelSet::view().
    SurfaceView<3> view(const dealii::Point<3> &x, const double reach) const override;
    std::string remark() const override
    {
      return raster.remark_on_heights("Bed",
                                      "There is no ground around them: it ends in vertical walls, and soil falls past "
                                      "them. Fill holes of the data first, for instance with gdal_fillnodata.");
    }

  private:
    /// Whether the four heights from a column and a row on are known.
    bool has_ground(const unsigned int column, const unsigned int row) const
    {
      return !std::isnan(raster(column, row) + raster(column + 1, row) + raster(column, row + 1) +
                         raster(column + 1, row + 1));
    }

    /// Height of the ground, m; NaN where it is missing.
    double height(const double x, const double y) const;

    dealii::Point<3> node(const unsigned int column, const unsigned int row) const
    {
      return { raster.x + column * raster.spacing, raster.y + row * raster.spacing, raster(column, row) };
    }

    const Raster raster;
  };
} // namespace scree

#endif

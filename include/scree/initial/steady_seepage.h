// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_initial_steady_seepage_h
#define scree_initial_steady_seepage_h

#include <scree/boundary/boundary_conditions.h>
#include <scree/seeding/seeding.h>

#include <deal.II/base/function_lib.h>

namespace scree
{
  /// Properties of the soil that the flow depends on.
  struct SeepageSoil
  {
    std::vector<SoilRegion> bodies;     ///< where they are
    std::vector<double> conductivities; ///< of each, m/s; 0: no flow
  };

  /// What is at a place before the flow is known: soil, ground, air or free water, and the heads at the walls.
  template <int dim>
  class SeepageSurvey
  {
  public:
    static constexpr int air = -1,    ///< see kind()
        closed               = -2;    ///< ground and soil without flow, see kind()
    const BackgroundGrid<dim> &grid;  ///< the mesh
    const SeepageSoil soil;           ///< the bodies
    const std::string reservoir_text; ///< of the entry, for messages

    /// @param ground only its open holds soil; null: all
    SeepageSurvey(const BackgroundGrid<dim> &grid,
                  const SeepageSoil &soil,
                  const WaterParameters &water,
                  const BoundaryConditions<dim> &walls,
                  const double unit_weight,
                  const LevelSet<dim> *ground);

    /// Elevation of free water at a place, m; NaN without a reservoir.
    double level(const dealii::Point<dim> &x) const;

    /// Number of the body at a place, or air, or closed, as all is beyond the box.
    int kind(const dealii::Point<dim> &x) const;

    /// Whether a body with flow is there.
    bool is_in_soil(const dealii::Point<dim> &x) const
    {
      return kind(x) >= 0;
    }

    /// Whether a place is beyond this face of the box.
    bool is_beyond(const dealii::Point<dim> &x, const unsigned int face) const
    {
      const unsigned int a = face / 2;
      return face % 2 == 0 ? x[a] < grid.lower_corner()[a] : x[a] > grid.upper_corner()[a];
    }

    /// The head of a wall at a height of it, m: NaN where water only leaves, nothing if it is closed there.
    std::optional<double> head_of_wall(const unsigned int face, const double height) const;

  private:
    const BoundaryConditions<dim> &walls;
    const LevelSet<dim> *ground;
    const double unit_weight; // of water, N/m^3
    const std::vector<double> heads;
    std::vector<Region<dim>> regions;
    std::unique_ptr<Expression<dim>> reservoir;
  };

  /// What steady seepage came to.
  struct SeepageReport
  {
    unsigned int n_iterations = 0;     ///< solves
    bool has_converged        = false; ///< whether the last one changed nothing
    double inflow             = 0;     ///< m^3/s (2D: m^2/s)
    double outflow_in_air     = 0;     ///< through faces in air, m^3/s
    double outflow_below      = 0;     ///< to where a head is given, m^3/s
    double exit_height        = 0;     ///< elevation of the highest face in air where water leaves, m; NaN: nowhere

    /// A line for the log.
    std::string text(const unsigned int dim) const
    {
      const std::string unit = dim == 2 ? " m^2/s" : " m^3/s";
      return "Steady seepage: " + number_text(inflow) + unit + " in, " + number_text(outflow_in_air) +
             " out through faces in air" +
             (std::isnan(exit_height) ? "" : " up to " + number_text(exit_height) + " m") + ", " +
             number_text(outflow_below) + " out below given heads; " + std::to_string(n_iterations) + " iterations" +
             (has_converged ? "" : ", not converged. Use the pressure with care");
    }
  };

  /// The pressure head of steady seepage at the corners of the cells with soil, on every rank. As a level set its open
  /// is dry.
  template <int dim>
  class SeepageField : public LevelSet<dim>
  {
  public:
    /// @param box of the mesh
    /// @param first corner of the box's cells that has a value, by its numbers along the axes
    /// @param values of the pressure head, m; NaN where no soil is near
    SeepageField(const CellsOfBox<dim> &box,
                 const CellPlace<dim> &first,
                 const dealii::Table<dim, double> &values,
                 const SeepageReport &report);

    /// Pressure head, m, and its gradient; NaN where no soil is near.
    std::pair<double, dealii::Tensor<1, dim>> pressure_head(const dealii::Point<dim> &x) const;

    /// See LevelSet::is_open(): whether the pressure is negative or unknown.
    bool is_open(const dealii::Point<dim> &x) const override
    {
      return !(pressure_head(x).first >= 0.);
    }

    /// See LevelSet::view(): of the surface without pressure, to first order.
    SurfaceView<dim> view(const dealii::Point<dim> &x, const double reach) const override;

    const SeepageReport report; ///< how it was found

  private:
    const CellsOfBox<dim> box;
    CellPlace<dim> first, n; // of the cells with values
    std::unique_ptr<const dealii::Functions::InterpolatedUniformGridData<dim>> heads;
  };

  /// Steady flow of water through the soil. Collective; throws EntryError if no soil touches a given head, or if a
  /// reservoir is higher than the box.
  /// @param gravity m/s^2; conductivities hold at 9.81
  template <int dim>
  std::shared_ptr<const SeepageField<dim>> solve_seepage(const SeepageSurvey<dim> &survey, const double gravity);
} // namespace scree

#endif

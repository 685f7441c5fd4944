// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_scheme_bed_contact_h
#define scree_scheme_bed_contact_h

#include <scree/grid/sampled_surface.h>
#include <scree/points/soil_body.h>
#include <scree/scheme/contact_lanes.h>
#include <scree/scheme/obstacle.h>

#include <array>
#include <list>
#include <vector>

namespace scree
{
  /// A rigid surface and how soil rubs on it. What it refers to must live on.
  template <int dim>
  struct RigidSurface
  {
    const SampledSurface<dim> *samples;
    double friction_coefficient;               ///< infinite: soil that presses does not slip
    const Raster *friction_map      = nullptr; ///< coefficients in place of it; null: the same everywhere
    bool holds_water                = false;   ///< whether free water does not slip
    const Obstacle<dim> *obstacle   = nullptr; ///< whose surface it is; null: the bed
    dealii::Tensor<1, dim> velocity = {};      ///< in the current step, m/s

    double friction_at(const dealii::Point<dim> &x) const
    {
      return friction_map ? friction_map->value_at(x[0], x[1]) : friction_coefficient;
    }
  };

  /// Contact of points of dry soil with rigid surfaces, the bed and obstacles, by impulses on the nodes between their
  /// own step and the points'.
  ///
  /// Each point near a surface has a touching distance, about that of its start. A point that would come nearer in the
  /// step gets an impulse along the surface's normal, and by Coulomb's law one along the surface, from its velocity
  /// relative to the surface's. Both act at the point's foot on the surface, through the shape functions of the point's
  /// own cell; so neighbours share impulses, which are found by sweeps over the points in turn (projected
  /// Gauss-Seidel), from those of the step before.
  ///
  /// The order of the sweeps does not depend on how cells are spread over ranks: cells that share no nodes have the
  /// same colour, one colour follows the other, and ranks exchange what they have changed between two colours.
  template <int dim>
  class BedContact
  {
  public:
    /// @param surfaces in the order of the points' slots
    /// @param gravity m/s^2
    /// @param bodies of all groups
    /// @param group of the bodies whose points these are
    BedContact(const BackgroundGrid<dim> &grid,
               const Constraints<dim> &constraints,
               const std::vector<RigidSurface<dim>> &surfaces,
               const double gravity,
               std::list<SoilBody<dim>> &bodies,
               const unsigned int group = 0);

    /// Fits the nodes to the grid's current partition. Collective.
    void reinit();

    /// Corrects the nodes' velocities, which the step of `time_step` s has found and ranks have exchanged, and
    /// exchanges them anew. Collective.
    void solve(NodalField<dim> &field, const double time_step, StepBalance<dim> &balance);

  private:
    /// A point that may touch a surface.
    struct Contact
    {
      double *force; ///< the point's slots
      unsigned int surface;
      double friction;                ///< coefficient
      dealii::Point<dim> place;       ///< of the point in its cell
      dealii::Tensor<1, dim> to_foot; ///< from there, cell widths
      dealii::Point<dim> foot;        ///< m
      dealii::Tensor<1, dim> normal;
      double approach;                        ///< least velocity along the normal from the surface, m/s
      double normal_impulse;                  ///< N s, not negative
      dealii::Tensor<1, dim> tangent_impulse; ///< N s
      double order;                           ///< of the points in a cell, the same on any rank
    };

    /// The contacts of a body's points in a cell; its nodes lie behind each other.
    struct Cell
    {
      unsigned int number; ///< active cell index
      unsigned int colour;
      unsigned int body;
      unsigned int first, n; ///< contacts
      unsigned int nodes;    ///< first of its nodes
      bool is_held;          ///< whether walls hold one of its nodes
      bool is_shared;        ///< whether other ranks know one
      double most_mobility;  ///< of a contact with the foot's own shape functions, 1/kg
    };

    /// Cells that share no nodes, a lane each. Without enough of them the last one is repeated.
    struct CellLanes
    {
      unsigned int n_cells;                       ///< that count
      std::array<unsigned int, batch_size> cells; ///< numbers in the list
      unsigned int first, n;                      ///< contacts in lanes, as many as the cell with the most has
      bool is_held;                               ///< whether walls hold nodes of any
    };

    /// The gap, m, up to which points beside nodes as fast, m/s, may touch a surface in the step.
    double margin(const double speed, const RigidSurface<dim> &surface, const double dt) const;

    /// The speed of the fastest node that this rank knows, m/s.
    double fastest_node(const NodalField<dim> &field) const;

    /// Finds the surfaces that points of the cell may touch, with their margins.
    void
    find_near_surfaces(const SoilBody<dim> &body, const CellPoints<dim> &points, const double fastest, const double dt);

    /// Lists the contacts.
    void find_contacts(const NodalField<dim> &field, const double time_step);
    void open_cell(const SoilBody<dim> &body, const unsigned int cell, const NodalField<dim> &field);
    void
    add_cell(const SoilBody<dim> &body, const CellPoints<dim> &points, const NodalField<dim> &field, const double dt);
    void add_contact(const SoilBody<dim> &body,
                     const unsigned int surface,
                     const PointView<dim, double> &point,
                     const double distance,
                     const double dt);

    /// The velocity along the normal that a point with this gap, m, must have at least.
    double least_approach(const double gap, const double dt) const;

    /// Puts cells of a colour together in lanes, and tells which colours concern several ranks. Collective.
    void join_cells();

    /// Numbers of the nodes of the cells in lanes.
    std::array<const unsigned int *, batch_size> nodes_of(const CellLanes &lanes) const;

    /// Puts the contacts into lanes and gives the nodes the impulses of the step before.
    template <int n>
    void start();
    template <int n>
    void start(const CellLanes &lanes);

    /// Copies a contact of each cell.
    void fill_lanes(const CellLanes &lanes, const unsigned int k, ContactLanes<dim> &contact) const;

    template <int n>
    void sweep(const bool is_forward);
    template <int n>
    void sweep(const CellLanes &lanes, const bool is_forward);

    /// Stores the forces in the points and adds up what the surfaces did.
    template <int n>
    void finish(const double time_step, StepBalance<dim> &balance);

    /// Adds what walls bear of the impulses on the nodes that they hold.
    template <int n>
    void add_reactions(const CellLanes &lanes, StepBalance<dim> &balance);

    template <int n>
    void solve(NodalField<dim> &field, const double time_step, StepBalance<dim> &balance);

    const BackgroundGrid<dim> &grid;
    const Constraints<dim> &constraints;
    std::vector<RigidSurface<dim>> surfaces;
    const unsigned int n_obstacles; // the last of the surfaces
    const double slack;             // m, gap that counts as touching
    const double most_speed;        // m/s, at which overlap is undone
    std::list<SoilBody<dim>> &bodies;
    const unsigned int group;
    ContactNodes<dim> nodes;
    /// A surface that a cell's points may touch, and the largest gap of those that may, m.
    struct Near
    {
      unsigned int surface;
      double margin;
    };
    std::vector<Near> near; // of the current cell
    std::vector<Cell> cells;
    std::vector<unsigned int> nodes_of_cells; // numbers in `nodes`
    std::vector<Contact> contacts;
    std::vector<CellLanes> cell_lanes;
    std::vector<ContactLanes<dim>> contact_lanes; // room for those of the step with the most
    std::vector<unsigned int> first_of_colour;    // in lanes
    std::vector<char> is_colour_shared;           // by ranks
    bool any_contact = false;                     // on any rank
  };
} // namespace scree

#endif

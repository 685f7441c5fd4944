// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_contact_points_point_contact_h
#define scree_contact_points_point_contact_h

#include <scree/boundary/body_forces.h>
#include <scree/mesh/discrete_level_set.h>
#include <scree/bodies/soil_body.h>
#include <scree/contact/points/contact_exchange.h>
#include <scree/boundary/obstacle.h>
#include <scree/step/step_report.h>

#include <list>
#include <vector>

namespace scree
{
  /// A rigid surface and how soil rubs on it. What it refers to must live on.
  template <int dim>
  struct RigidSurface
  {
    const DiscreteLevelSet<dim> *samples;      ///< the surface, sampled on the mesh
    double friction_coefficient;               ///< infinite: soil that presses does not slip
    bool no_slip                    = false;   ///< whether free water does not slip
    const Obstacle<dim> *obstacle   = nullptr; ///< whose surface it is; null: the bed
    dealii::Tensor<1, dim> velocity = {};      ///< in the current step, m/s
    double turbulent_friction       = 0;       ///< xi of TurbulentFriction, m/s^2; 0: none
  };

  /// Contact of points of dry soil with rigid surfaces, the bed and obstacles, by impulses on the nodes between their
  /// own step and the points'.
  ///
  /// Each point near a surface has a touching distance, about that of its start. A point that would come nearer in the
  /// step gets an impulse along the surface's normal, and by Coulomb's law one along the surface, from its velocity
  /// relative to the surface's. Both act at the point's foot on the surface, through the shape functions of the point's
  /// own cell; so neighbours share impulses, which are found by sweeps over the points in turn (projected
  /// Gauss-Seidel, @source{jourdan1998}), from those of the step before.
  ///
  /// The order of the sweeps does not depend on how cells are spread over ranks: cells that share no nodes have the
  /// same colour, one colour follows the other, and ranks tell each other what they have changed before another reads
  /// it. Of a colour, cells at the border of ranks come first, unless what they read is still on its way.
  template <int dim>
  class PointContact
  {
  public:
    /// @param surfaces in the order of the points' slots; none: all calls return at once
    /// @param bodies of all groups
    /// @param group of the bodies whose points these are
    PointContact(const BackgroundGrid<dim> &grid,
                 const Constraints<dim> &constraints,
                 const std::vector<RigidSurface<dim>> &surfaces,
                 const BodyForces<dim> &forces,
                 std::list<SoilBody<dim>> &bodies,
                 const unsigned int group,
                 dealii::TimerOutput &timer);

    /// Fits the nodes to the grid's current partition. Collective.
    void reinit();

    /// Corrects the nodes' velocities, which the step of `time_step` s has found and ranks have exchanged, and
    /// exchanges them anew. Collective.
    void solve(NodalField<dim> &field, const double time_step, Budget<dim> &balance);

  private:
    /// A point of the current cell that may touch a surface.
    struct Candidate
    {
      double order; ///< of the points in a cell, the same on any rank
      unsigned int point;
      unsigned int surface;
      double distance; ///< m
      double gap;      ///< m: how much that is more than its touching distance
    };

    /// A point that may touch a surface, and what it has felt of it. Vectors have 0 beside them.
    struct Contact
    {
      NodeRow normal;           ///< of the surface, unit, into the open
      NodeRow surface_velocity; ///< m/s
      NodeRow tangent_impulse;  ///< N s
      NodeRow mobility;         ///< sum A_i^2/m_i over the nodes that are free along an axis; beside: over all, 1/kg
      double normal_impulse;    ///< N s, not negative
      double normal_inertia;    ///< 1 over the mobility along the normal, kg; 0 where walls hold it
      double inertia;           ///< 1 over that without walls, kg; 0 where nothing can move
      double approach;          ///< least velocity along the normal from the surface, m/s
      double friction;          ///< coefficient
      double *force;            ///< the point's slots
      unsigned int surface;
      dealii::Point<dim> place;       ///< of the point in its cell
      dealii::Tensor<1, dim> to_foot; ///< from there, cell widths
      dealii::Point<dim> foot;        ///< m
    };

    /// The contacts of a body's points in a cell; its nodes lie behind each other.
    struct Cell
    {
      CellCosts *costs;    ///< of the body's points
      unsigned int number; ///< active cell index
      unsigned int n_points;
      unsigned int part;     ///< of the sweeps
      unsigned int first, n; ///< contacts
      unsigned int nodes;    ///< first of its nodes
      bool is_held;          ///< whether walls hold one of its nodes
      double most_mobility;  ///< of a contact with the foot's own shape functions, 1/kg
    };

    /// The gap, m, up to which points beside nodes as fast, m/s, may touch a surface in the step.
    double margin(const double speed, const RigidSurface<dim> &surface, const double dt) const;

    /// The speed of the fastest node that this rank knows, m/s.
    double fastest_node(const NodalField<dim> &field) const;

    /// The same among the nodes of a cell.
    double fastest_node(const NodalField<dim> &field, const unsigned int cell) const;

    /// Lists the contacts.
    void find_contacts(const NodalField<dim> &field, const double time_step);

    /// Lists the surfaces that points of the cell may touch beside nodes as fast, m/s.
    void
    find_near_surfaces(const SoilBody<dim> &body, const CellPoints<dim> &points, const double fastest, const double dt);

    /// Lists the points of the cell that may touch them, in order.
    void find_candidates(const SoilBody<dim> &body, const CellPoints<dim> &points);

    void add_cell(SoilBody<dim> &body, const CellPoints<dim> &points, const NodalField<dim> &field, const double dt);

    /// Adds a cell for the contacts of the candidates.
    void cut_cell(SoilBody<dim> &body, const CellPoints<dim> &points, const NodalField<dim> &field);
    void add_contact(const SoilBody<dim> &body,
                     const Candidate &candidate,
                     const PointView<dim, double> &point,
                     const double dt);

    /// The velocity along the normal that a point with this gap, m, must have at least.
    double least_approach(const double gap, const double dt) const;

    /// Puts the cells into the sequence of the sweeps.
    void order_cells();

    /// Shares out the time that contacts took, s, among the cells' costs.
    void add_costs(const double seconds);

    /// Finds the contacts' shape functions and mobilities, and gives the nodes the impulses of the step before.
    template <int n>
    void start();

    /// Sets the shape functions A_i at the contact's foot, and its mobility.
    ///
    /// They are the functions of the point's own cell, also where the foot is outside: A_i = phi_i(x - d n). Beside
    /// light nodes these would let a small impulse do much; then A_i = phi_i(x) - d n . grad phi_i(x).
    template <int n>
    void set_shapes(const Cell &cell, Contact &contact, double *shape) const;

    static constexpr unsigned int colours_1d = 3; // cells as far apart along an axis share no nodes
    static constexpr unsigned int n_colours  = dealii::Utilities::pow(colours_1d, dim);

    /// @param s of all sweeps
    template <int n>
    void sweep(const unsigned int s);
    template <int n>
    void sweep_part(const unsigned int part, const bool is_forward);
    template <int n>
    void sweep(const Cell &cell, const bool is_forward);

    /// Stores the forces in the points and adds up what the surfaces did.
    template <int n>
    void finish(const double time_step, Budget<dim> &balance);

    /// Adds what walls bear of the impulses on the nodes that they hold.
    template <int n>
    void add_reactions(const Cell &cell, Budget<dim> &balance);

    template <int n>
    void solve(NodalField<dim> &field, const double time_step, Budget<dim> &balance);

    const BackgroundGrid<dim> &grid;
    const Constraints<dim> &constraints;
    std::vector<RigidSurface<dim>> surfaces;
    const unsigned int n_obstacles; // the last of the surfaces
    const double slack;             // m, gap that counts as touching
    const double most_speed;        // m/s, at which overlap is undone
    const double mass_scaling;      // of the nodes
    std::list<SoilBody<dim>> &bodies;
    const unsigned int group;
    dealii::TimerOutput &timer;
    ContactDofs<dim> nodes;
    ContactExchange<dim> exchange;
    /// A surface that a cell's points may touch, and the largest gap of those that may, m.
    struct Near
    {
      unsigned int surface;
      double margin;
    };
    std::vector<Near> near;            // of the current cell
    std::vector<Candidate> candidates; // of the current cell
    std::vector<Contact> contacts;
    std::vector<double> shapes; // A_i of each contact; room for those of the step with the most
    std::vector<Cell> cells;
    std::vector<unsigned int> nodes_of_cells; // numbers in `nodes`
    std::vector<unsigned int> sequence;       // of the cells in a sweep
    std::vector<unsigned int> first_of_part;  // in it: of each colour, cells with shared nodes and then the others
  };
} // namespace scree

#endif

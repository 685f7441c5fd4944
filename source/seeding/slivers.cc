// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/seeding/slivers.h>
#include <scree/deal_ii_versions.h>

#include <deal.II/base/mpi.h>

#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <map>
#include <optional>
#include <tuple>

namespace scree
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    using CellOf = typename Triangulation<dim>::active_cell_iterator;


    /// The order of two places, whatever the rank.
    template <int dim>
    bool is_before(const Point<dim> &a, const Point<dim> &b)
    {
      return std::lexicographical_compare(&a[0], &a[0] + dim, &b[0], &b[0] + dim);
    }


    /// What a seed may be to a sliver beside it, the best last.
    enum class Role : int
    {
      none,     ///< it may not be joined
      largest,  ///< a sliver that fills most of its surroundings
      anchored, ///< a sliver beside a full seed
      full
    };


    /// A seed as other ranks see it.
    template <int dim>
    struct SeedView
    {
      Point<dim> location; ///< m
      double filled;       ///< see Seed
      Role role;

      bool fills_more_than(const SeedView &other) const
      {
        return filled != other.filled ? filled > other.filled : is_before(location, other.location);
      }

      template <typename Archive>
      void serialize(Archive &archive, const unsigned int)
      {
        archive &location &filled &role;
      }
    };


    /// A sliver and the seed of another cell that it joins.
    template <int dim>
    struct Joining
    {
      Point<dim> target;   ///< where that seed stands, m
      Point<dim> location; ///< of the sliver, m
      double volume;       ///< m^3
      double filled;       ///< see Seed

      template <typename Archive>
      void serialize(Archive &archive, const unsigned int)
      {
        archive &target &location &volume &filled;
      }
    };


    /// Visits the cells around one that hold nodes.
    template <int dim, typename Visit>
    void for_cells_around(const CellOf<dim> &cell, const Visit &visit)
    {
      std::vector<CellOf<dim>> around{ cell };
      for (unsigned int a = 0; a < dim; ++a)
        for (unsigned int i = 0, n = around.size(); i < n; ++i)
          for (const unsigned int face : { 2 * a, 2 * a + 1 })
            if (const CellOf<dim> near = around[i]; !near->at_boundary(face) && near->neighbor(face)->is_active())
              if (const CellOf<dim> next = near->neighbor(face); !next->is_artificial() && holds_nodes(next))
                around.push_back(next);
      for (unsigned int i = 1; i < around.size(); ++i)
        visit(around[i]);
    }


    /// The slivers of a rank and what is around them.
    template <int dim>
    class Slivers
    {
    public:
      Slivers(const Triangulation<dim> &triangulation, const LevelSet<dim> *ground, std::vector<Seed<dim>> &seeds)
          : triangulation(triangulation)
          , ground(ground)
          , seeds(seeds)
      {
      }

      /// Lets slivers join seeds with at least one of these roles, but for those that have a full one beside them.
      /// Returns whether any did, on any rank.
      bool gather()
      {
        find_roles();
        return join([](const Role own, const Role other) { return own < Role::anchored && other > own; });
      }

      /// Lets slivers join full seeds.
      void finish()
      {
        find_roles();
        join([](const Role own, const Role other) { return own == Role::anchored && other == Role::full; });
      }

    private:
      using Views = std::vector<SeedView<dim>>;

      static bool may_join(const Seed<dim> &seed)
      {
        return seed.is_sliver() && !seed.stays;
      }

      /// The first seed of a cell: they are in the order of the cells.
      auto first_of(const unsigned int cell) const
      {
        return std::partition_point(
            seeds.begin(), seeds.end(), [&](const auto &seed) { return seed.cell->active_cell_index() < cell; });
      }

      /// Takes the views of this rank's cells and the ghosts. Collective.
      void exchange(std::map<unsigned int, Views> own)
      {
        of_cells = std::move(own);
        GridTools::exchange_cell_data_to_ghosts<Views, Triangulation<dim>>(
            triangulation,
            [&](const CellOf<dim> &cell) {
              const auto found = of_cells.find(cell->active_cell_index());
              return found == of_cells.end() ? std::optional<Views>() : found->second;
            },
            [&](const CellOf<dim> &cell, const Views &views) { of_cells[cell->active_cell_index()] = views; });
      }

      template <typename Visit>
      void for_views_around(const CellOf<dim> &cell, const Visit &visit) const
      {
        for_cells_around<dim>(cell, [&](const CellOf<dim> &near) {
          if (const auto found = of_cells.find(near->active_cell_index()); found != of_cells.end())
            for (const SeedView<dim> &view : found->second)
              visit(view);
        });
      }

      void find_roles()
      {
        std::map<unsigned int, Views> own;
        for (const Seed<dim> &seed : seeds)
          if (!seed.is_sliver() || may_join(seed))
            own[seed.cell->active_cell_index()].push_back(
                { seed.location, seed.filled, seed.is_sliver() ? Role::none : Role::full });
        exchange(own);
        for (const Seed<dim> &seed : seeds)
          if (may_join(seed))
            {
              SeedView<dim> &sliver = own[seed.cell->active_cell_index()].front(); // alone in its cell
              sliver.role           = Role::largest;
              for_views_around(seed.cell, [&](const SeedView<dim> &other) {
                if (other.role == Role::full)
                  sliver.role = Role::anchored;
                else if (sliver.role == Role::largest && other.fills_more_than(sliver))
                  sliver.role = Role::none;
              });
            }
        exchange(std::move(own));
      }

      template <typename May>
      bool join(const May &may)
      {
        joinings.clear();
        for (Seed<dim> &seed : seeds)
          if (may_join(seed))
            {
              const SeedView<dim> own = of_cells.at(seed.cell->active_cell_index()).front();
              std::optional<SeedView<dim>> best;
              for_views_around(seed.cell, [&](const SeedView<dim> &other) {
                const auto rank = [&](const SeedView<dim> &view) {
                  return std::make_pair(-static_cast<int>(view.role), view.location.distance_square(seed.location));
                };
                if (may(own.role, other.role) && (!best || rank(other) < rank(*best)))
                  best = other;
              });
              if (best)
                joinings[seed.cell] = { best->location, seed.location, seed.volume, seed.filled };
            }
        const bool any = Utilities::MPI::max(joinings.empty() ? 0u : 1u, communicator_of(triangulation)) > 0;
        if (any)
          take_in();
        return any;
      }

      /// Gives slivers to the seeds that they join, in an order that is the same on any number of ranks.
      void take_in()
      {
        seeds.erase(std::remove_if(seeds.begin(),
                                   seeds.end(),
                                   [&](const Seed<dim> &seed) { return joinings.find(seed.cell) != joinings.end(); }),
                    seeds.end());
        GridTools::exchange_cell_data_to_ghosts<Joining<dim>, Triangulation<dim>>(
            triangulation,
            [&](const CellOf<dim> &cell) {
              const auto joining = joinings.find(cell);
              return joining == joinings.end() ? std::optional<Joining<dim>>() : joining->second;
            },
            [&](const CellOf<dim> &cell, const Joining<dim> &joining) { joinings[cell] = joining; });
        std::vector<std::pair<Joining<dim>, Seed<dim> *>> due;
        for (const auto &[cell, joining] : joinings)
          for_cells_around<dim>(cell, [&, &joining = joining](const CellOf<dim> &near) {
            const auto end = first_of(near->active_cell_index() + 1);
            for (auto seed = first_of(near->active_cell_index()); seed != end; ++seed)
              if (seed->location == joining.target)
                due.emplace_back(joining, &*seed);
          });
        std::sort(due.begin(), due.end(), [](const auto &a, const auto &b) {
          return is_before(a.first.location, b.first.location);
        });
        for (const auto &[joining, seed] : due)
          take_in(joining, *seed);
      }

      void take_in(const Joining<dim> &joining, Seed<dim> &seed) const
      {
        constexpr double margin = 0.01; // of a cell
        const double width = seed.cell->extent_in_direction(0), reach = 2. * seed.cell->diameter();
        const auto distance = [&](const Point<dim> &x) { return ground->view(x, reach).distance; };
        const double least  = ground ? std::min(distance(seed.location), distance(joining.location)) : 0.;
        seed.take_in(joining.location, joining.volume, joining.filled);
        if (ground)
          if (const auto view = ground->view(seed.location, reach); view.distance < least)
            seed.location += (least - view.distance) * view.normal;
        for (unsigned int a = 0; a < dim; ++a)
          {
            const double lower = seed.cell->vertex(0)[a];
            seed.location[a]   = std::clamp(seed.location[a], lower + margin * width, lower + (1. - margin) * width);
          }
      }

      const Triangulation<dim> &triangulation;
      const LevelSet<dim> *ground;
      std::vector<Seed<dim>> &seeds;
      std::map<unsigned int, Views> of_cells;       // by active cell, with the ghosts
      std::map<CellOf<dim>, Joining<dim>> joinings; // by the sliver's cell
    };
  } // namespace


  template <int dim>
  void keep_slivers_at(const LevelSet<dim> *ground, std::vector<Seed<dim>> &seeds)
  {
    for (Seed<dim> &seed : seeds)
      if (ground != nullptr && seed.is_sliver())
        {
          const double reach = seed.cell->diameter();
          seed.stays         = seed.stays || ground->view(seed.location, reach).distance < reach;
        }
  }


  template <int dim>
  void join_slivers(const Triangulation<dim> &triangulation, const LevelSet<dim> *ground, std::vector<Seed<dim>> &seeds)
  {
    Slivers<dim> slivers(triangulation, ground, seeds);
    while (slivers.gather())
      ;
    slivers.finish();
  }

  template void keep_slivers_at(const LevelSet<2> *, std::vector<Seed<2>> &);
  template void keep_slivers_at(const LevelSet<3> *, std::vector<Seed<3>> &);
  template void join_slivers(const Triangulation<2> &, const LevelSet<2> *, std::vector<Seed<2>> &);
  template void join_slivers(const Triangulation<3> &, const LevelSet<3> *, std::vector<Seed<3>> &);
} // namespace scree

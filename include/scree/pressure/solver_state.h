// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_pressure_solver_state_h
#define scree_pressure_solver_state_h

#include <scree/mesh/background_grid.h>
#include <scree/pressure/ground_rows.h>

#include <boost/serialization/utility.hpp>
#include <boost/serialization/vector.hpp>

#include <map>

namespace scree
{
  /// Numbers at vertices or cells by their places in the box (curve_number()), which no partition changes.
  using NumbersByPlace = std::vector<std::pair<std::uint64_t, double>>;

  /// The place of a vertex.
  template <int dim>
  std::uint64_t
  place_of_vertex(const BackgroundGrid<dim> &grid, const NodeNumbering<dim> &vertices, const unsigned int vertex)
  {
    return curve_number<dim>(grid.fine_cells().box().place_of_corner(vertices.position(vertex)));
  }

  /// The owned vertices by these places.
  template <int dim>
  std::map<std::uint64_t, unsigned int> vertices_by_place(const BackgroundGrid<dim> &grid,
                                                          const NodeNumbering<dim> &vertices)
  {
    std::map<std::uint64_t, unsigned int> result;
    for (unsigned int vertex = 0; vertex < vertices.n_owned(); ++vertex)
      result[place_of_vertex(grid, vertices, vertex)] = vertex;
    return result;
  }

  /// The lists of all ranks behind each other. Collective.
  template <typename List>
  List join(const MPI_Comm communicator, const List &own)
  {
    List result;
    for (const List &of_rank : dealii::Utilities::MPI::all_gather(communicator, own))
      result.insert(result.end(), of_rank.begin(), of_rank.end());
    return result;
  }

  /// What a preconditioner that is kept over steps was made from (PressurePreconditioner), and how it has done since.
  struct PreconditionerState
  {
    NumbersByPlace conductances;             ///< of the cells that held water, m^dim/(Pa s)
    NumbersByPlace diagonal;                 ///< what was added to it at the unknown vertices, m^dim/(Pa s)
    unsigned int iterations_when_new = 0;    ///< of the first solve
    unsigned int surplus_iterations  = 0;    ///< over this, of all solves since
    bool is_worn                     = true; ///< the next solve makes another one

    /// Saves or loads it (Boost).
    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &conductances &diagonal &iterations_when_new &surplus_iterations &is_worn;
    }
  };

  /// The ground beyond an absorbing wall at one of the wall's nodes.
  template <int dim>
  struct FreeFieldNode
  {
    double area          = 0;             ///< of the wall, m^2 (2D: m)
    double mass          = 0;             ///< density times area, kg/m
    double pressure_wave = 0;             ///< impedance times area: rho c_p A, N s/m
    double shear_wave    = 0;             ///< rho c_s A, N s/m
    dealii::Tensor<1, dim> force_at_rest; ///< on the soil, N
    dealii::Tensor<1, dim> displacement,  ///< of the free field since the release, relative to the box, m
        velocity;                         ///< relative to the box, m/s

    /// Saves or loads it (Boost).
    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &area &mass &pressure_wave &shear_wave &force_at_rest &displacement &velocity;
    }
  };

  /// The ground beyond all absorbing walls, on every rank.
  template <int dim>
  struct FreeField
  {
    std::vector<FreeFieldNode<dim>> nodes; ///< face by face; empty before the release
    dealii::Tensor<1, dim> base_velocity;  ///< of the base since the release, m/s

    /// Saves or loads it (Boost).
    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &nodes &base_velocity;
    }
  };

  /// What the solves of a step begin with beside the points, of all ranks: from it a run goes on as if it had not
  /// stopped.
  template <int dim>
  struct SolverState
  {
    std::vector<FacetTractions<dim>> tractions; ///< of the ground in the last step
    NumbersByPlace change;                      ///< of the pressure in the last step, Pa
    NumbersByPlace potential;                   ///< of the last shift of water's points, Pa
    PreconditionerState preconditioner;         ///< of the pressure
    FreeField<dim> free_field;                  ///< beyond absorbing walls

    /// Saves or loads it (Boost).
    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &tractions &change &potential &preconditioner &free_field;
    }
  };
} // namespace scree

#endif

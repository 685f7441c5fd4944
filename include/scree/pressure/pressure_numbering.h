// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_pressure_pressure_numbering_h
#define scree_pressure_pressure_numbering_h

#include <scree/pressure/free_surface.h>

#include <memory>
#include <vector>

namespace scree
{
  /// Numbers of the vertices at which the pressure may be unknown: those of the wet cells and of the cells next to
  /// them, so that one numbering serves many steps.
  template <int dim>
  class PressureNumbering
  {
  public:
    /// Keeps references to both; no vertex has a number yet.
    PressureNumbering(const BackgroundGrid<dim> &grid, const NodeNumbering<dim> &vertices);

    /// Forgets what belongs to another partition of the mesh.
    void reinit();

    /// Hands out new numbers if a wet cell has a vertex without one. Collective.
    /// @return whether it did
    bool update(const Mixture<dim> &mixture);

    /// Of the numbers: the owned ones first.
    const std::shared_ptr<const dealii::Utilities::MPI::Partitioner> &partitioner() const
    {
      return numbers_of_ranks;
    }

    /// The local number of a vertex of a wet cell.
    unsigned int number(const unsigned int vertex) const
    {
      return number_of_corner[vertex];
    }

    /// Vertex of a local number.
    unsigned int vertex(const unsigned int number) const
    {
      return corner_of_number[number];
    }

    /// How many numbers this rank knows, ghosts included.
    unsigned int n_local() const
    {
      return corner_of_number.size();
    }

  private:
    static constexpr unsigned int n_vertices = 1 << dim;

    /// Whether all vertices of wet cells of all ranks have numbers. Collective.
    bool numbers_serve(const Mixture<dim> &mixture) const;

    /// Marks the vertices of wet cells and of those around them, `margin` cells deep, on owned vertices and ghosts;
    /// returns this rank's cells whose vertices are marked. Collective.
    std::vector<unsigned int> mark_corners(const Mixture<dim> &mixture, VertexVector &marks) const;

    /// Turns the marks of owned vertices into global numbers, -1 elsewhere; returns the range of this rank. Collective.
    dealii::IndexSet number_marked(VertexVector &marks) const;

    const BackgroundGrid<dim> &grid;
    const NodeNumbering<dim> &vertices;
    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> numbers_of_ranks;
    std::vector<unsigned int> number_of_corner, corner_of_number; // local indices; owned numbers first
  };
} // namespace scree

#endif

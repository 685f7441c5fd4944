// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_points_point_set_h
#define scree_points_point_set_h

#include <deal.II/base/point.h>
#include <deal.II/fe/mapping.h>
#include <deal.II/particles/particle_handler.h>

#include <vector>

namespace scree
{
  /// The points of one cell, contiguous in memory. Pointers are to the first point.
  template <int dim>
  struct CellPoints
  {
    unsigned int cell; ///< active cell index
    unsigned int n_points;
    double *properties;           ///< the set's stride() doubles a point
    dealii::Point<dim> *location; ///< m
    const dealii::Point<dim> *reference_location;
  };

  /// A point that lay outside the mesh when the set was sorted.
  template <int dim>
  struct LostPoint
  {
    dealii::Point<dim> location; ///< m
    std::vector<double> properties;
  };

  /// A set of material points on a distributed mesh: a ParticleHandler, seen cell by cell.
  template <int dim>
  class PointSet
  {
  public:
    PointSet(const dealii::Triangulation<dim> &triangulation,
             const dealii::Mapping<dim> &mapping,
             const unsigned int n_properties);

    /// Hands every point to the cell and rank it lies in now; cheap while no point of any rank has left its cell.
    /// Collective. Points outside the mesh leave the set and are appended to lost().
    void sort();

    /// Refreshes cells(): after points were inserted or unpacked.
    void update_cells();

    /// This rank's cells that hold points. Valid until the next sort().
    const std::vector<CellPoints<dim>> &cells() const
    {
      return cell_list;
    }

    /// This rank's points that left the mesh since the list was last cleared.
    std::vector<LostPoint<dim>> &lost()
    {
      return lost_points;
    }

    /// Doubles from one point's properties to the next one's.
    unsigned int stride() const
    {
      return n_properties;
    }

    dealii::Particles::ParticleHandler<dim> &handler()
    {
      return particle_handler;
    }
    const dealii::Particles::ParticleHandler<dim> &handler() const
    {
      return particle_handler;
    }

  private:
    const MPI_Comm communicator;
    const unsigned int n_properties;
    dealii::Particles::ParticleHandler<dim> particle_handler;
    std::vector<CellPoints<dim>> cell_list;
    std::vector<LostPoint<dim>> lost_points;
  };
} // namespace scree

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_scheme_friction_memory_h
#define scree_scheme_friction_memory_h

#include <deal.II/base/mpi.h>
#include <deal.II/base/point.h>

#include <array>
#include <cmath>
#include <map>
#include <vector>

namespace scree
{
  /// Friction with a normal force N' filtered in time (Prakash & Clifton 1993): dN'_f/dt = (N' - N'_f)/T, implicit.
  ///
  /// With the current N', an elastic skeleton full of incompressible water is unstable: stretching raises N', friction
  /// follows at once, and waves as long as the layer is thick grow at up to mu c_s/(2 H).
  struct FrictionFilter
  {
    double memory_time = 0.; ///< T, s; 0: friction follows at once
    double time_step   = 1.; ///< s

    /// By how much the filtered force comes nearer to the current one in a step, 0 to 1.
    double share() const
    {
      return time_step / (memory_time + time_step);
    }

    /// Filtered force, N, from that of the last step, negative: none, and the current one.
    double follow(const double remembered, const double now) const
    {
      return remembered < 0. ? now : remembered + share() * (now - remembered);
    }
  };


  /// Where rigid ground or a wall remembers a force: position in 1024ths of a cell, then the number of the surface.
  using ForcePlace = std::array<double, 4>;

  /// Remembered forces, N, by their places: what outlives a partition and a run.
  using ForceRecords = std::map<ForcePlace, double>;

  /// @param surface number of a surface; walls of the box have -1
  template <int dim>
  ForcePlace force_place(const dealii::Point<dim> &position, const double cell_size, const double surface)
  {
    ForcePlace place{};
    for (unsigned int a = 0; a < dim; ++a)
      place[a] = std::round(1024. * position[a] / cell_size);
    place[3] = surface;
    return place;
  }

  /// As numbers, five a record, for archives and messages.
  inline std::vector<double> numbers_of(const ForceRecords &records)
  {
    std::vector<double> numbers;
    for (const auto &[place, force] : records)
      {
        numbers.insert(numbers.end(), place.begin(), place.end());
        numbers.push_back(force);
      }
    return numbers;
  }

  inline void add_numbers(const std::vector<double> &numbers, ForceRecords &records)
  {
    for (std::size_t i = 0; i + 5 <= numbers.size(); i += 5)
      records[ForcePlace{ { numbers[i], numbers[i + 1], numbers[i + 2], numbers[i + 3] } }] = numbers[i + 4];
  }

  /// Those of all ranks. Collective.
  inline ForceRecords gather_records(const ForceRecords &own, const MPI_Comm communicator)
  {
    ForceRecords all;
    for (const std::vector<double> &numbers : dealii::Utilities::MPI::all_gather(communicator, numbers_of(own)))
      add_numbers(numbers, all);
    return all;
  }
} // namespace scree

#endif

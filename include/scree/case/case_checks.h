// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_case_case_checks_h
#define scree_case_case_checks_h

#include <scree/case/parameters.h>
#include <scree/io/checkpoint.h>

namespace scree
{
  /// Throws EntryError at impossible entries of a case, and at entries that do not fit each other.
  void check_case(const Parameters &parameters);

  /// Adds lines for the log on values that are hardly meant: in units other than SI, regions that the box cuts off or
  /// that fill an outline far above the bed, free water beside dry ground. Collective.
  /// @param ground the bed; null without it
  template <int dim>
  void add_unusual_values(const Parameters &parameters,
                          const std::list<SoilBody<dim>> &bodies,
                          const std::list<WaterPhase<dim>> &water,
                          const LevelSet<dim> *ground,
                          const MPI_Comm communicator,
                          std::vector<std::string> &remarks);

  /// Lines for the log on entries that are possible, but without the effect that they suggest: those of
  /// add_unusual_values(), bases stronger than the soil, shear bands that the cells do not resolve, laws that no body
  /// has, cohesion without tensile strength in water, a water table above all soil. Collective.
  template <int dim>
  std::vector<std::string> remarks_on(const Parameters &parameters,
                                      const std::list<SoilBody<dim>> &bodies,
                                      const std::list<WaterPhase<dim>> &water,
                                      const LevelSet<dim> *ground,
                                      const MPI_Comm communicator);

  /// Compares the entries of a case with those of the checkpoint it is to go on from. Returns a line for the log for
  /// each change that the results will show; throws EntryError at changes that the state in the checkpoint does not
  /// bear.
  /// @param begins_stage at the start of a stage walls, friction and strength may change, too
  std::vector<std::string>
  notes_on_changes(const Checkpoint &checkpoint, const CaseEntries &now, const bool begins_stage);

  /// What a case will take of memory, from its entries alone.
  struct MemoryEstimate
  {
    double n_cells        = 0; ///< fine ones, at the start
    double n_soil_points  = 0, ///< at the start, of all bodies
        n_water_points    = 0; ///< at the start; 0 if the soil's points carry the water
    double bytes_of_cells = 0, ///< of all ranks
        bytes_of_points   = 0; ///< of all ranks
    double bytes_of_rank  = 0; ///< of each rank beside its share of the cells

    /// Of so many ranks that share the case.
    double bytes(const unsigned int n_ranks) const
    {
      return bytes_of_cells + bytes_of_points + n_ranks * bytes_of_rank;
    }
  };

  /// Numbers of cells and points of a case; regions are sampled. Throws ValueError if one is no number at a sample.
  template <int dim>
  MemoryEstimate estimate_memory(const Parameters &parameters);

  /// The estimate; throws EntryError, with it, if the hosts of the ranks have not enough memory for the case.
  /// Collective.
  template <int dim>
  MemoryEstimate require_memory(const Parameters &parameters, const MPI_Comm communicator);
} // namespace scree

#endif

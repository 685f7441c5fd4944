// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_case_case_checks_h
#define scree_case_case_checks_h

#include <scree/case/parameters.h>
#include <scree/io/checkpoint.h>

namespace scree
{
  /// Throws EntryError at impossible entries of a case, and at entries that do not fit each other.
  void check_case(const Parameters &parameters);

  /// Lines for the log on entries that are possible, but without the effect that they suggest: bases stronger than the
  /// soil, shear bands that the cells do not resolve, laws that no body has, cohesion without tensile strength in
  /// water, water in other units, a water table above all soil. Collective.
  template <int dim>
  std::vector<std::string>
  remarks_on(const Parameters &parameters, const std::list<SoilBody<dim>> &bodies, const MPI_Comm communicator);

  /// Compares the entries of a case with those of the checkpoint it is to go on from. Returns a line for the log for
  /// each change that the results will show; throws EntryError at changes that the state in the checkpoint does not
  /// bear.
  std::vector<std::string> notes_on_changes(const Checkpoint &checkpoint, const CaseEntries &entries);

  /// What to write instead of an entry or subsection, or of a value, that earlier versions had; empty if there was
  /// none.
  std::string removed_entry_remedy(const std::string &subsection, const std::string &entry, const std::string &value);
} // namespace scree

#endif

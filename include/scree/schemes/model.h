// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_schemes_model_h
#define scree_schemes_model_h

#include <scree/bodies/water_parameters.h>
#include <scree/bodies/water_phase.h>
#include <scree/boundary/inflow/inflow.h>
#include <scree/contact/contact_parameters.h>
#include <scree/contact/points/point_contact.h>
#include <scree/mesh/cut_cells.h>
#include <scree/momentum/surface_load.h>
#include <scree/transfer/transfer_parameters.h>

namespace scree
{
  /// What a case has built, as the schemes see it. All that it refers to must outlive them.
  template <int dim>
  struct Model
  {
    const BackgroundGrid<dim> &grid;              ///< mesh and nodes of the velocity
    const BodyForces<dim> &forces;                ///< accelerations of the nodes
    const TransferParameters &transfer;           ///< entries of subsection Transfer
    const StabilisationParameters &stabilisation; ///< entries of subsection Stabilisation
    std::list<SoilBody<dim>> &bodies;             ///< bodies of soil
    std::list<SurfaceLoad<dim>> &loads;           ///< loads on the surface of the soil
    std::vector<RigidSurface<dim>> surfaces;      ///< the bed and the obstacles
    std::vector<Constraints<dim> *> constraints;  ///< of each group of bodies that stick to each other; with water one
    std::vector<ContactPair> contacts;            ///< of these groups

    std::list<WaterPhase<dim>> &water;               ///< empty in a dry scene
    const WaterParameters &water_parameters;         ///< entries of subsection Water
    const PressureParameters &pressure_parameters;   ///< entries of subsection Pressure
    const WaterBoundaryConditions<dim> *water_walls; ///< null in a dry scene
    const std::list<Inflow<dim>> &inflows;           ///< inflows of soil and water
    const RigidBoundary<dim> *ground;                ///< what water meets; null if there is nothing
    const CutCells<dim> *cut_cells;                  ///< what this leaves of the cells; null: all
    unsigned int soil_points;                        ///< fewest of a body in a cell, along an axis
  };
} // namespace scree

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef scree_materials_laws_rigid_h
#define scree_materials_laws_rigid_h

#include <scree/materials/material.h>

namespace scree
{
  /// Soil that does not move: a filter, a rockfill dam, an obstacle. It carries any stress, which is not computed and
  /// reads 0; no wave runs in it. Its points are not updated, so that update() must not be called.
  template <int dim>
  class Rigid : public Material<dim>
  {
  public:
    void
    update(const MaterialPoints<dim> &points, const MaterialMotion<dim> &motion, UpdateReport &report) const override;
    double shear_modulus() const override;
    double initial_bulk_modulus(const double pressure) const override;
    double elastic_energy(const double *left_cauchy_green) const override;
    Batch elastic_energies(const Batch *left_cauchy_green) const override;
    void initialise(const double *wanted_stress,
                    double *left_cauchy_green,
                    double *stress,
                    double *internal_variables) const override;
    double initial_porosity() const override;
    bool is_elastic() const override;
    std::vector<Quantity> internal_quantities() const override;
    std::vector<Quantity> output_quantities() const override;
    void output(const double *left_cauchy_green,
                const double *stress,
                const double *internal_variables,
                const double volume_ratio,
                double *values) const override;
  };
} // namespace scree

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef scree_materials_hencky_material_h
#define scree_materials_hencky_material_h

#include <scree/materials/law.h>
#include <scree/tensor/hencky.h>

#include <deal.II/base/exceptions.h>

namespace scree
{
  /// Kinematics around a law in principal values (@source{simo1992}): trial b_e, logarithmic strain, the law's return
  /// map, exponential map, sigma = tau/J. The law is inlined in the loop over points; nothing allocates.
  ///
  /// A step is cut into n parts of a straight path, F_k = I + k/n (dF - I) and f_k = F_k F_{k-1}^{-1}, such that no
  /// component of F_k - F_{k-1} is beyond the law's sub-step strain: backward Euler has several roots if it is.
  template <int dim, typename Law>
  class HenckyMaterial : public Material<dim>
  {
  public:
    /// Copies the law.
    explicit HenckyMaterial(const Law &law);

    void
    update(const MaterialPoints<dim> &points, const MaterialMotion<dim> &motion, UpdateReport &report) const override;

    double shear_modulus() const override
    {
      return law.shear_modulus();
    }
    double initial_bulk_modulus(const double pressure) const override
    {
      return law.bulk_modulus(pressure);
    }
    double elastic_energy(const double *left_cauchy_green) const override;
    Batch elastic_energies(const Batch *left_cauchy_green) const override;
    void initialise(const double *wanted_stress,
                    double *left_cauchy_green,
                    double *stress,
                    double *internal_variables) const override;
    double initial_porosity() const override
    {
      return law.initial_porosity();
    }
    bool is_elastic() const override;
    double plane_friction() const override;
    double grain_diameter() const override;
    NonlocalVariable nonlocal_variable() const override;
    PlaceVariable place_variable() const override
    {
      return place_variable_of(law);
    }
    std::vector<Quantity> internal_quantities() const override;
    std::vector<Quantity> output_quantities() const override;
    void output(const double *left_cauchy_green,
                const double *stress,
                const double *internal_variables,
                const double volume_ratio,
                double *values) const override;

  protected:
    /// The update of one of the points.
    void update_point(const unsigned int p,
                      const MaterialPoints<dim> &points,
                      const MaterialMotion<dim> &motion,
                      UpdateReport &report) const;

  private:
    static constexpr unsigned int n_components = n_symmetric_components<dim>;

    /// What friction that depends on the rate keeps of a return from `trial`; `internal_variables` are those after it.
    void keep_part(const PrincipalValues &trial,
                   const double *internal_variables_before,
                   const double time_step,
                   const double grain_density,
                   PrincipalValues &strain,
                   double *internal_variables,
                   PrincipalValues &stress) const;

    /// One increment f of a point; returns the dissipation per reference volume, J/m^3. Writes the stress if `stress`.
    double advance(const dealii::Tensor<2, dim> &f,
                   const double out_of_plane_stretch,
                   const double volume_ratio,
                   const double time_step,
                   const double grain_density,
                   double *left_cauchy_green,
                   double *internal_variables,
                   double *stress,
                   UpdateReport &report) const;

    /// All sub-steps of a point; returns the dissipation per reference volume, J/m^3.
    double advance_in_substeps(const dealii::Tensor<2, dim> &deformation_increment,
                               const double out_of_plane_stretch,
                               const double volume_ratio,
                               const double time_step,
                               const double grain_density,
                               double *left_cauchy_green,
                               double *internal_variables,
                               double *stress,
                               UpdateReport &report) const;

    const Law law;
  };


  template <int dim, typename Law>
  HenckyMaterial<dim, Law>::HenckyMaterial(const Law &law)
      : law(law)
  {
  }


  template <int dim, typename Law>
  void HenckyMaterial<dim, Law>::keep_part(const PrincipalValues &trial,
                                           const double *internal_variables_before,
                                           const double time_step,
                                           const double grain_density,
                                           PrincipalValues &strain,
                                           double *internal_variables,
                                           PrincipalValues &stress) const
  {
    PrincipalValues change;
    double volume = 0, square = 0;
    for (unsigned int i = 0; i < 3; ++i)
      {
        change[i] = trial[i] - strain[i];
        volume += change[i];
      }
    for (const double value : change)
      square += (value - volume / 3) * (value - volume / 3);
    const double part = law.inertial_friction.template kept_part<double>(
        std::sqrt(2 * square), law.shear_modulus(), law.friction_pressure(stress), grain_density, time_step);
    if (part == 0)
      return;
    for (unsigned int i = 0; i < 3; ++i)
      strain[i] += part * change[i];
    for (unsigned int i = 0; i < Law::n_internal_variables; ++i)
      internal_variables[i] += part * (internal_variables_before[i] - internal_variables[i]);
    stress = law.stress_of(strain);
  }


  template <int dim, typename Law>
  inline double HenckyMaterial<dim, Law>::advance(const dealii::Tensor<2, dim> &f,
                                                  const double out_of_plane_stretch,
                                                  const double volume_ratio,
                                                  const double time_step,
                                                  const double grain_density,
                                                  double *left_cauchy_green,
                                                  double *internal_variables,
                                                  double *stress,
                                                  UpdateReport &report) const
  {
    double trial[n_components];
    trial_left_cauchy_green<dim>(&f[0][0], out_of_plane_stretch, left_cauchy_green, trial);
    const PrincipalFrame<dim> frame(trial);
    const PrincipalValues trial_strain = log_strain(frame.values());
    AssertThrow(std::isfinite(trial_strain[0] + trial_strain[1] + trial_strain[2]),
                dealii::ExcMessage("A material point's elastic strain is not a number. Remedy: a smaller time step."));

    PrincipalValues strain = trial_strain;
    PrincipalValues kirchhoff_stress;
    double dissipation = 0;
    double internal_variables_before[Law::n_internal_variables + 1];
    std::copy_n(internal_variables, Law::n_internal_variables, internal_variables_before);
    const double largest_modulus = report.largest_bulk_modulus;
    ++report.n_substeps;
    const Response response =
        return_map_of(law, time_step, strain, internal_variables, volume_ratio, kirchhoff_stress, report);
    if (response == Response::elastic)
      std::copy(trial, trial + n_components, left_cauchy_green);
    else
      {
        if constexpr (HasInertialFriction<Law>())
          if (law.inertial_friction.is_active())
            {
              keep_part(trial_strain,
                        internal_variables_before,
                        time_step,
                        grain_density,
                        strain,
                        internal_variables,
                        kirchhoff_stress);
              const double pressure       = -(kirchhoff_stress[0] + kirchhoff_stress[1] + kirchhoff_stress[2]) / 3;
              report.largest_bulk_modulus = std::max(largest_modulus, law.bulk_modulus(pressure));
            }
        left_cauchy_green_of(frame, strain, left_cauchy_green);
        for (unsigned int i = 0; i < 3; ++i)
          dissipation += kirchhoff_stress[i] * (trial_strain[i] - strain[i]);
      }

    report.largest_compression =
        std::max({ report.largest_compression, -kirchhoff_stress[0], -kirchhoff_stress[1], -kirchhoff_stress[2] });
    if (stress != nullptr)
      {
        const double factor = 1 / volume_ratio;
        frame.compose({ { factor * kirchhoff_stress[0], factor * kirchhoff_stress[1], factor * kirchhoff_stress[2] } },
                      stress);
      }
    return dissipation;
  }


  template <int dim, typename Law>
  inline double HenckyMaterial<dim, Law>::advance_in_substeps(const dealii::Tensor<2, dim> &deformation_increment,
                                                              const double out_of_plane_stretch,
                                                              const double volume_ratio,
                                                              const double time_step,
                                                              const double grain_density,
                                                              double *left_cauchy_green,
                                                              double *internal_variables,
                                                              double *stress,
                                                              UpdateReport &report) const
  {
    constexpr double largest_number_of_substeps = 1000;

    dealii::Tensor<2, dim> change = deformation_increment; // dF - I
    double largest_change         = dim == 2 ? std::abs(out_of_plane_stretch - 1) : 0;
    for (unsigned int i = 0; i < dim; ++i)
      {
        change[i][i] -= 1;
        for (unsigned int j = 0; j < dim; ++j)
          largest_change = std::max(largest_change, std::abs(change[i][j]));
      }
    const double wanted_substeps = std::ceil(largest_change / law.substep_strain());
    // Written such that not-a-number throws, too.
    AssertThrow(determinant(deformation_increment) > 0 && volume_ratio > 0 &&
                    wanted_substeps <= largest_number_of_substeps && (dim == 3 || out_of_plane_stretch > 0),
                dealii::ExcMessage("A material point cannot follow its deformation increment: largest |dF - I| is " +
                                   std::to_string(largest_change) + ", det dF " +
                                   std::to_string(determinant(deformation_increment)) + ", J " +
                                   std::to_string(volume_ratio) +
                                   ". Remedy: a smaller time step, or mend the unstable motion."));
    if (wanted_substeps <= 1)
      return advance(deformation_increment,
                     out_of_plane_stretch,
                     volume_ratio,
                     time_step,
                     grain_density,
                     left_cauchy_green,
                     internal_variables,
                     stress,
                     report);

    const unsigned int n_substeps = static_cast<unsigned int>(wanted_substeps);
    const double part             = 1. / n_substeps;
    const auto n_separated        = report.n_separated;
    double dissipation            = 0;
    for (unsigned int k = 0; k < n_substeps; ++k)
      {
        report.n_separated            = n_separated;         // A point counts once, by its state in the end.
        dealii::Tensor<2, dim> before = (k * part) * change; // F_{k-1}
        for (unsigned int i = 0; i < dim; ++i)
          before[i][i] += 1;
        dealii::Tensor<2, dim> f = part * change * invert(before);
        for (unsigned int i = 0; i < dim; ++i)
          f[i][i] += 1;
        const double stretch_change = part * (out_of_plane_stretch - 1);
        dissipation += advance(f,
                               1 + stretch_change / (1 + k * stretch_change),
                               volume_ratio,
                               part * time_step,
                               grain_density,
                               left_cauchy_green,
                               internal_variables,
                               k + 1 == n_substeps ? stress : nullptr,
                               report);
      }
    return dissipation;
  }


  template <int dim, typename Law>
  void HenckyMaterial<dim, Law>::update(const MaterialPoints<dim> &points,
                                        const MaterialMotion<dim> &motion,
                                        UpdateReport &report) const
  {
    UpdateReport own; // The compiler keeps what nothing else points to in registers.
    for (unsigned int p = 0; p < points.n_points; ++p)
      update_point(p, points, motion, own);
    own.n_updates = points.n_points;
    report.add(own);
  }


  template <int dim, typename Law>
  inline void HenckyMaterial<dim, Law>::update_point(const unsigned int p,
                                                     const MaterialPoints<dim> &points,
                                                     const MaterialMotion<dim> &motion,
                                                     UpdateReport &report) const
  {
    report.plastic_dissipation +=
        motion.reference_volume[p] * advance_in_substeps(motion.deformation_increment_of(p),
                                                         dim == 2 ? motion.out_of_plane_stretch[p] : 1,
                                                         motion.volume_ratio[p],
                                                         motion.time_step,
                                                         motion.grain_density,
                                                         points.left_cauchy_green + points.offset(p),
                                                         points.internal_variables + points.offset(p),
                                                         points.stress + points.offset(p),
                                                         report);
  }


  template <int dim, typename Law>
  double HenckyMaterial<dim, Law>::elastic_energy(const double *left_cauchy_green) const
  {
    return law.energy(log_strain(PrincipalFrame<dim>(left_cauchy_green).values()));
  }


  template <int dim, typename Law>
  Batch HenckyMaterial<dim, Law>::elastic_energies(const Batch *left_cauchy_green) const
  {
    const PrincipalNumbers<Batch> strain = log_strain(PrincipalFrame<dim, Batch>(left_cauchy_green).values());
    Batch energies;
    for (unsigned int lane = 0; lane < batch_size; ++lane)
      energies[lane] = law.energy({ { strain[0][lane], strain[1][lane], strain[2][lane] } });
    return energies;
  }


  template <int dim, typename Law>
  void HenckyMaterial<dim, Law>::initialise(const double *wanted_stress,
                                            double *left_cauchy_green,
                                            double *stress,
                                            double *internal_variables) const
  {
    const PrincipalFrame<dim> frame(wanted_stress);
    PrincipalValues strain, principal_stress;
    law.initialise(frame.values(), strain, principal_stress, internal_variables);
    left_cauchy_green_of(frame, strain, left_cauchy_green);
    frame.compose(principal_stress, stress);
  }


  template <int dim, typename Law>
  bool HenckyMaterial<dim, Law>::is_elastic() const
  {
    return Law::is_elastic;
  }


  template <int dim, typename Law>
  double HenckyMaterial<dim, Law>::plane_friction() const
  {
    if constexpr (HasPlaneFriction<Law>())
      return law.plane_friction();
    else
      return Material<dim>::plane_friction();
  }


  template <int dim, typename Law>
  double HenckyMaterial<dim, Law>::grain_diameter() const
  {
    if constexpr (HasInertialFriction<Law>())
      return law.inertial_friction.is_active() ? law.inertial_friction.diameter() : 0;
    else
      return 0;
  }


  template <int dim, typename Law>
  NonlocalVariable HenckyMaterial<dim, Law>::nonlocal_variable() const
  {
    if constexpr (HasNonlocalVariable<Law>())
      return law.nonlocal_variable();
    else
      return {};
  }


  template <int dim, typename Law>
  std::vector<Quantity> HenckyMaterial<dim, Law>::internal_quantities() const
  {
    return Law::internal_quantities();
  }


  template <int dim, typename Law>
  std::vector<Quantity> HenckyMaterial<dim, Law>::output_quantities() const
  {
    return Law::output_quantities();
  }


  template <int dim, typename Law>
  void HenckyMaterial<dim, Law>::output(const double *left_cauchy_green,
                                        const double *,
                                        const double *internal_variables,
                                        const double volume_ratio,
                                        double *values) const
  {
    law.output(log_strain(PrincipalFrame<dim>(left_cauchy_green).values()), internal_variables, volume_ratio, values);
  }
} // namespace scree

#endif

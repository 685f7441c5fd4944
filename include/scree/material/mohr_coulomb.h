// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef scree_material_mohr_coulomb_h
#define scree_material_mohr_coulomb_h

#include <scree/material/linear_elastic.h>

namespace scree
{
  /// Entries of subsection "Mohr-Coulomb"; angles in degrees.
  struct MohrCoulombParameters
  {
    double young_modulus   = 1e6;
    double poisson_ratio   = 0.3;
    double friction_angle  = 30;
    double dilation_angle  = 0;
    double cohesion        = 0;
    double tension_cut_off = 0;

    void add_parameters(dealii::ParameterHandler &prm);

    /// Throws EntryError if a combination is impossible.
    void check(const std::string &subsection) const;
  };


  /// Perfectly plastic Mohr-Coulomb with tension cut-off on Hencky elasticity (de Souza Neto, Peric & Owen 2008, 8.2).
  ///
  /// With sorted principal Kirchhoff stresses, f_ij = (1 + sin phi) tau_i - (1 - sin phi) tau_j - 2 c cos phi <= 0,
  /// flow along (1 + sin psi) n_i - (1 - sin psi) n_j, and tau_i <= cut-off with associated flow. The return finds
  /// the face, edge or corner by trying the sets of surfaces a sorted stress can meet; each is a small linear system.
  ///
  /// Pulled apart beyond the vertex (all tau_i at the smaller of cut-off and c cot phi), b_e becomes isotropic and
  /// keeps eps_v as a gap to be closed, as in NorSand: forgetting it would let loose grains gain volume at every
  /// bounce. Without cohesion, grains with a gap do not dilate: eps_v > 0 means no stress.
  class MohrCoulomb
  {
  public:
    static constexpr bool is_elastic                       = false;
    static constexpr bool has_pressure_dependent_stiffness = false;

    explicit MohrCoulomb(const MohrCoulombParameters &parameters);

    /// No limit: the equations of a return are linear and have one root.
    double substep_strain() const;

    /// Pa.
    double shear_modulus() const;

    /// Pa.
    double bulk_modulus(const double pressure) const;

    /// J per m^3 of reference volume; a gap stores none.
    double energy(const PrincipalValues &strain) const;

    /// Zero: the law knows no pores.
    double initial_porosity() const;

    /// From trial to returned `strain` and internal variables; sets `stress`, counts in `report`.
    Response return_map(PrincipalValues &strain,
                        double *internal_variables,
                        const double volume_ratio,
                        PrincipalValues &stress,
                        UpdateReport &report) const;

    /// See Material::initialise(). Throws if the stress is outside the yield surface.
    void initialise(const PrincipalValues &wanted_stress,
                    PrincipalValues &strain,
                    PrincipalValues &stress,
                    double *internal_variables) const;

    static std::vector<Quantity> internal_quantities();
    static std::vector<Quantity> output_quantities();
    void output(const PrincipalValues &strain,
                const double *internal_variables,
                const double volume_ratio,
                double *values) const;

    /// Largest of all yield functions, Pa; negative inside.
    double yield(const PrincipalValues &stress) const;

  private:
    /// A plane of the yield surface, normal . tau <= limit, and its flow direction.
    struct Surface
    {
      PrincipalValues normal, flow, relaxation; // relaxation: elastic stiffness times flow, Pa
      double limit;                             // Pa
    };

    /// Surfaces met together, and the inverse of normal_a . relaxation_b.
    struct ActiveSet
    {
      std::vector<unsigned int> surfaces;
      dealii::Tensor<2, 3> inverse;
    };

    void add_surface(const PrincipalValues &normal, const PrincipalValues &flow, const double limit);
    void add_active_set(const std::vector<unsigned int> &surfaces);
    bool return_to(const ActiveSet &set, const PrincipalValues &trial, PrincipalValues &stress) const;
    Response plastic_return(const PrincipalValues &trial,
                            PrincipalValues &strain,
                            double *internal_variables,
                            PrincipalValues &stress,
                            UpdateReport &report) const;

    const LinearElastic elastic;
    const double bulk;   // Pa
    const double vertex; // tau of the vertex, Pa
    const bool cohesionless;
    double largest_principal_stress; // of the cut-off, Pa
    std::vector<Surface> surfaces;   // of sorted stresses: 13, 12, 23, then cut-off 1, 2, 3
    std::vector<ActiveSet> active_sets;
  };


  inline double MohrCoulomb::substep_strain() const
  {
    return std::numeric_limits<double>::infinity();
  }


  inline double MohrCoulomb::yield(const PrincipalValues &stress) const
  {
    const double largest  = std::max(stress[0], std::max(stress[1], stress[2]));
    const double smallest = std::min(stress[0], std::min(stress[1], stress[2]));
    const Surface &shear  = surfaces[0];
    return std::max(shear.normal[0] * largest + shear.normal[2] * smallest - shear.limit,
                    largest - largest_principal_stress);
  }


  inline Response MohrCoulomb::return_map(PrincipalValues &strain,
                                          double *internal_variables,
                                          const double volume_ratio,
                                          PrincipalValues &stress,
                                          UpdateReport &report) const
  {
    PrincipalValues trial;
    elastic.return_map(strain, nullptr, volume_ratio, trial, report);
    if (yield(trial) > 0)
      return plastic_return(trial, strain, internal_variables, stress, report);
    stress = trial;
    return Response::elastic;
  }
} // namespace scree

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef scree_materials_laws_mohr_coulomb_h
#define scree_materials_laws_mohr_coulomb_h

#include <scree/materials/friction_angle.h>
#include <scree/materials/inertial_friction.h>
#include <scree/materials/laws/linear_elastic.h>
#include <scree/materials/softening.h>

namespace scree
{
  /// Entries of subsection "Mohr-Coulomb"; angles in degrees.
  struct MohrCoulombParameters
  {
    double young_modulus   = 1e6;                 ///< E, Pa
    double poisson_ratio   = 0.3;                 ///< nu, -
    double friction_angle  = 30;                  ///< phi, degrees
    double dilation_angle  = 0;                   ///< psi, degrees
    double cohesion        = 0;                   ///< c, Pa
    double tension_cut_off = 0;                   ///< largest principal stress, Pa; at most c cot(phi)
    std::string angle_kind = "triaxial";          ///< what phi was measured in
    InertialFrictionParameters inertial_friction; ///< of grains that flow
    SofteningParameters softening;                ///< strength that falls with plastic shear

    /// sin(phi) of the law.
    double sine() const;

    /// The same soil with residual strength from the start.
    MohrCoulombParameters residual() const;

    /// Declares the entries in the subsection that is open.
    void add_parameters(dealii::ParameterHandler &prm);

    /// Throws EntryError if a combination is impossible.
    void check(const std::string &subsection) const;

    /// See LawEntries.
    LawEntry modulus() const;

    /// See LawEntries. Divides tan(phi), c and the tension cut-off; psi stays, but is at most phi.
    void divide_strength(const double factor);

  private:
    void check_softening(const std::string &subsection) const;
  };


  /// Perfectly plastic Mohr-Coulomb with tension cut-off on Hencky elasticity (@source{desouzaneto2008}, 8.2).
  ///
  /// With sorted principal Kirchhoff stresses, f_ij = (1 + sin phi) tau_i - (1 - sin phi) tau_j - 2 c cos phi <= 0,
  /// flow along (1 + sin psi) n_i - (1 - sin psi) n_j, and tau_i <= cut-off with associated flow. The return finds
  /// the face, edge or corner by trying the sets of surfaces a sorted stress can meet; each is a small linear system.
  ///
  /// The strain of the cut-offs is no plastic strain: b_e keeps it as an opening along the principal axes, and the
  /// stress stays at the cut-off until the opening has closed. So the cut-offs alone are an elastic law, whose stress
  /// is the derivative of energy(). Soil is apart beyond the vertex (all tau_i at the smaller of cut-off and c cot
  /// phi), without cohesion at eps_v >= 0, with cohesion at openings above `largest_opening`: b_e becomes isotropic,
  /// keeps eps_v as a gap to be closed, as in NorSand, and does not dilate.
  class MohrCoulomb
  {
  public:
    static constexpr unsigned int n_internal_variables = 1;     ///< plastic shear strain
    static constexpr bool is_elastic                   = false; ///< the law has plastic strain
    static constexpr double largest_opening            = 0.05;  ///< volume strain beyond which cohesive soil is apart

    /// Builds the yield surfaces, and the sets of them that a return can meet.
    explicit MohrCoulomb(const MohrCoulombParameters &parameters);

    /// No limit: the equations of a return are linear and have one root.
    double substep_strain() const;

    /// Pa.
    double shear_modulus() const;

    /// Pa.
    double bulk_modulus(const double pressure) const;

    /// J per m^3 of reference volume: elastic energy, and the work of the cut-off in what is open.
    double energy(const PrincipalValues &strain) const;

    /// Zero: the law has no pores.
    double initial_porosity() const;

    /// tau/sigma on a plane of shear, sin(phi) cos(psi)/(1 - sin(phi) sin(psi)); infinite with cohesion.
    double plane_friction() const;

    /// Half the sum of the largest and the smallest compression, Pa.
    template <typename Number>
    Number friction_pressure(const PrincipalNumbers<Number> &stress) const;

    /// Elastic principal stress, Pa.
    template <typename Number>
    PrincipalNumbers<Number> stress_of(const PrincipalNumbers<Number> &strain) const;

    /// From trial to returned `strain` and internal variables; sets `stress`, counts in `report`.
    Response return_map(PrincipalValues &strain,
                        double *internal_variables,
                        const double volume_ratio,
                        PrincipalValues &stress,
                        UpdateReport &report) const;

    /// The same of a point or of a Batch of them; see law.h.
    template <typename Number>
    PrincipalResponse<Number>
    respond(PrincipalNumbers<Number> &strain, Number *internal_variables, PrincipalNumbers<Number> &stress) const;

    /// See Material::initialise(). Throws if the stress is outside the yield surface.
    void initialise(const PrincipalValues &wanted_stress,
                    PrincipalValues &strain,
                    PrincipalValues &stress,
                    double *internal_variables) const;

    /// Plastic shear strain, -.
    static std::vector<Quantity> internal_quantities();

    /// No derived fields.
    static std::vector<Quantity> output_quantities();

    /// Writes nothing, see output_quantities().
    void output(const PrincipalValues &strain,
                const double *internal_variables,
                const double volume_ratio,
                double *values) const;

    /// Largest of all yield functions, Pa; negative inside.
    template <typename Number>
    Number yield(const PrincipalNumbers<Number> &stress) const;

    const InertialFriction inertial_friction; ///< friction that grows with the rate of shear

  protected:
    /// Sorts the stress of the points that yield, returns it by `return_sorted(stress, plastic, todo)`, which adds the
    /// plastic strain and leaves in `todo` those that go to the vertex, and sets strain and stress. Returns the
    /// deviator of the plastic strain, 0 at the vertex.
    /// @param cohesionless points whose grains are apart without any opening
    template <typename Number, typename ReturnSorted>
    PrincipalNumbers<Number> plastic_return(PrincipalNumbers<Number> &strain,
                                            PrincipalNumbers<Number> &stress,
                                            PrincipalResponse<Number> &response,
                                            const simd::Mask<Number> &cohesionless,
                                            const ReturnSorted &return_sorted) const;

    /// Counts a point in the report.
    Response count(const PrincipalResponse<double> &response, UpdateReport &report) const;

    const LinearElastic elastic;           ///< the law without plastic strain
    const double shear;                    ///< modulus, Pa
    const double bulk;                     ///< modulus, Pa
    const double vertex;                   ///< tau of the vertex, Pa
    const double on_plane;                 ///< tau/sigma on a plane of shear, without cohesion
    const bool cohesionless;               ///< whether the vertex of friction and cohesion is at 0
    const double largest_principal_stress; ///< of the cut-off, Pa

  private:
    /// A plane of the yield surface, normal . tau <= limit.
    struct Surface
    {
      PrincipalValues normal, flow, relaxation; // relaxation: elastic stiffness times flow direction, Pa
      double limit;                             // Pa
    };

    /// Surfaces met together, and the inverse of normal_a . relaxation_b.
    struct ActiveSet
    {
      std::vector<unsigned int> surfaces;
      dealii::Tensor<2, 3> inverse;
    };

    void add_active_set(const std::vector<unsigned int> &surfaces);

    /// Returns a sorted stress of the points `todo` and sets their plastic strain; those that meet no set of surfaces
    /// stay in it.
    template <typename Number>
    void
    return_sorted(PrincipalNumbers<Number> &stress, PrincipalNumbers<Number> &plastic, simd::Mask<Number> &todo) const;

    /// The return of the points that yield, from trial strain and stress.
    template <typename Number>
    void plastic_return(PrincipalNumbers<Number> &strain,
                        Number *internal_variables,
                        PrincipalNumbers<Number> &stress,
                        PrincipalResponse<Number> &response) const;

    std::vector<Surface> surfaces; // of sorted stresses: 13, 12, 23, then cut-off 1, 2, 3
    std::vector<ActiveSet> active_sets;
  };


  inline double MohrCoulomb::substep_strain() const
  {
    return std::numeric_limits<double>::infinity();
  }


  template <typename Number>
  DEAL_II_ALWAYS_INLINE inline Number MohrCoulomb::yield(const PrincipalNumbers<Number> &stress) const
  {
    const Number largest  = simd::max<Number>(stress[0], simd::max<Number>(stress[1], stress[2]));
    const Number smallest = simd::min<Number>(stress[0], simd::min<Number>(stress[1], stress[2]));
    const Surface &shear  = surfaces[0];
    return simd::max<Number>(shear.normal[0] * largest + shear.normal[2] * smallest - shear.limit,
                             largest - largest_principal_stress);
  }


  template <typename Number>
  DEAL_II_ALWAYS_INLINE inline Number MohrCoulomb::friction_pressure(const PrincipalNumbers<Number> &stress) const
  {
    const Number largest  = simd::max<Number>(stress[0], simd::max<Number>(stress[1], stress[2]));
    const Number smallest = simd::min<Number>(stress[0], simd::min<Number>(stress[1], stress[2]));
    return -0.5 * (largest + smallest);
  }


  template <typename Number>
  DEAL_II_ALWAYS_INLINE inline PrincipalNumbers<Number>
  MohrCoulomb::stress_of(const PrincipalNumbers<Number> &strain) const
  {
    const Number volume_part = (bulk - 2. / 3. * shear) * (strain[0] + strain[1] + strain[2]);
    return {
      { volume_part + 2 * shear * strain[0], volume_part + 2 * shear * strain[1], volume_part + 2 * shear * strain[2] }
    };
  }


  template <typename Number>
  DEAL_II_ALWAYS_INLINE inline PrincipalResponse<Number> MohrCoulomb::respond(PrincipalNumbers<Number> &strain,
                                                                              Number *internal_variables,
                                                                              PrincipalNumbers<Number> &stress) const
  {
    stress = stress_of<Number>(strain);

    PrincipalResponse<Number> response{};
    response.is_plastic = yield<Number>(stress) > 0.;
    if (simd::any(response.is_plastic))
      plastic_return(strain, internal_variables, stress, response);
    return response;
  }
} // namespace scree

#endif

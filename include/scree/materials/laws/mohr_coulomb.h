// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef scree_materials_laws_mohr_coulomb_h
#define scree_materials_laws_mohr_coulomb_h

#include <scree/materials/laws/linear_elastic.h>

#include <tuple>

namespace scree
{
  /// The angle whose tangent is that of `degrees` over `factor`, degrees.
  double divided_angle(const double degrees, const double factor);


  /// Entries of a law with friction that grows with the rate of shear.
  struct InertialFrictionParameters
  {
    double grain_diameter    = 0;    ///< d, m; 0: friction does not depend on the rate
    double reference_number  = 0.3;  ///< I_0 of glass beads, -
    double friction_increase = 0.26; ///< Delta mu of glass beads, -; less where the strength is divided

    /// Declares the entries in the subsection that is open.
    void add_parameters(dealii::ParameterHandler &prm);
  };


  /// Friction of grains that flow: tau/p = mu_s + Delta mu/(1 + I_0/I) with the inertial number
  /// I = gamma_dot d sqrt(rho_s/p) (@source{jop2006}), where mu_s is the friction of the law without a rate.
  ///
  /// The overstress is that of Duvaut & Lions (@source{simo1998}, 2.7): of the change that a return map makes to
  /// elastic strain and internal variables, a part x is taken back. With tau_o = G gamma, the overstress before the
  /// part is taken, and I_1, the inertial number if the whole gamma flows in the step,
  ///   x tau_o = Delta mu p/(1 + I_0/((1 - x) I_1)),
  /// a quadratic equation, of which the smaller root lies between 0 and 1.
  class InertialFriction
  {
  public:
    /// Friction that does not depend on the rate if the diameter or the increase is 0.
    explicit InertialFriction(const InertialFrictionParameters &parameters)
        : grain_diameter(parameters.friction_increase > 0 ? parameters.grain_diameter : 0)
        , reference_number(parameters.reference_number)
        , friction_increase(parameters.friction_increase)
    {
    }

    /// Whether friction depends on the rate.
    bool is_active() const
    {
      return grain_diameter > 0;
    }

    /// Grain diameter d, m.
    double diameter() const
    {
      return grain_diameter;
    }

    /// The part x; 0 where there is no pressure.
    /// @param plastic_shear gamma = sqrt(2 e : e) of the change e of the elastic deviator
    /// @param shear_modulus G, Pa
    /// @param pressure p after the return, Pa
    /// @param grain_density kg/m^3
    /// @param time_step s; infinite: slow
    template <typename Number>
    Number kept_part(const Number &plastic_shear,
                     const double shear_modulus,
                     const Number &pressure,
                     const double grain_density,
                     const double time_step) const
    {
      constexpr double smallest_pressure = 1e-3; // Pa; I is not defined without pressure
      const Number p                     = simd::max<Number>(pressure, simd::broadcast<Number>(smallest_pressure));
      const Number over                  = shear_modulus * plastic_shear;
      const Number whole =
          plastic_shear * grain_diameter * std::sqrt(grain_density) / (time_step * simd::sqrt<Number>(p));
      const Number limit  = friction_increase * p * whole;
      const Number middle = over * (reference_number + whole) + limit;
      const Number root   = simd::sqrt<Number>(
          simd::max<Number>(middle * middle - 4. * over * whole * limit, simd::broadcast<Number>(0.)));
      const Number part = 2. * limit / simd::max<Number>(middle + root, simd::broadcast<Number>(1e-300));
      return simd::select<Number>(pressure > smallest_pressure, part, simd::broadcast<Number>(0.));
    }

    /// Takes a part of the change from `trial` to `strain` back, where the points are plastic; returns it.
    /// @param pressure p after the return, Pa
    template <typename Number>
    Number take_back(const PrincipalNumbers<Number> &trial,
                     const double shear_modulus,
                     const Number &pressure,
                     const simd::Mask<Number> &is_plastic,
                     const LawStep<Number> &step,
                     PrincipalNumbers<Number> &strain) const
    {
      PrincipalNumbers<Number> change;
      for (unsigned int i = 0; i < 3; ++i)
        change[i] = trial[i] - strain[i];
      PrincipalNumbers<Number> deviator = change;
      const Number square               = take_invariants<Number>(deviator).square;
      const Number part                 = kept_part<Number>(
          simd::sqrt<Number>(2. * square), shear_modulus, pressure, step.grain_density, step.time_step);
      const Number taken = simd::select<Number>(is_plastic, part, simd::broadcast<Number>(0.));
      for (unsigned int i = 0; i < 3; ++i)
        strain[i] += taken * change[i];
      return taken;
    }

  private:
    const double grain_diameter;    // m
    const double reference_number;  // I_0
    const double friction_increase; // Delta mu
  };


  /// Entries of a law whose strength falls from a peak to a residual value with plastic shear.
  struct SofteningParameters
  {
    double strain          = 0;  ///< kappa at which 1/e of the fall is left, -; 0: strength stays at the peak
    double cohesion        = -1; ///< residual, Pa; -1: that of the peak
    double friction_angle  = -1; ///< residual, degrees; -1: that of the peak
    double dilation_angle  = -1; ///< residual, degrees; -1: that of the peak
    double nonlocal_length = 0;  ///< l, m; 0: the strain of the point itself

    /// Whether strength depends on strain.
    bool is_active() const
    {
      return strain > 0;
    }

    /// The value after much strain of an entry with this value at the peak.
    static double residual(const double entry, const double peak)
    {
      return entry == as_peak ? peak : entry;
    }

    /// Declares the entries in the subsection that is open.
    void add_parameters(dealii::ParameterHandler &prm);

    /// Throws EntryError at entries without effect.
    void check(const std::string &subsection) const;

  private:
    static constexpr double as_peak = -1;
  };


  /// Entries of subsection "Mohr-Coulomb"; angles in degrees.
  struct MohrCoulombParameters : LinearElasticParameters
  {
    double friction_angle = 30;                   ///< phi, degrees, unless there is
    std::string friction_angle_of_place;          ///< phi of a place at the start, see PlaceVariable
    double dilation_angle = 0;                    ///< psi, degrees
    double cohesion       = 0;                    ///< c, Pa, unless there is
    std::string cohesion_of_place;                ///< c of a place at the start
    double reduction       = 1;                   ///< factor that divides what points have from their place
    std::string cut_off    = "auto";              ///< entry "Tension cut-off": a number in Pa, or auto
    double tension_cut_off = 0;                   ///< largest principal stress, Pa; at most c cot(phi)
    std::string angle_kind = "triaxial";          ///< what phi was measured in
    InertialFrictionParameters inertial_friction; ///< of grains that flow
    SofteningParameters softening;                ///< strength that falls with plastic shear

    /// sin(phi) of the law, which has one angle in triaxial compression and in plane strain. On a plane that shears
    /// without strain along it, tau/sigma = sin(phi) cos(psi)/(1 - sin(phi) sin(psi)) (@source{davis1968}), which is
    /// solved for sin(phi).
    double sine() const;

    /// Isotropic tension that friction and cohesion allow, c cot(phi), Pa.
    double apex() const;

    /// Whether points have their strength from their place.
    bool varies() const
    {
      return !friction_angle_of_place.empty() || !cohesion_of_place.empty();
    }

    /// The same soil with residual strength from the start.
    MohrCoulombParameters residual() const;

    void add_parameters(dealii::ParameterHandler &prm) override;
    void check(const std::string &subsection) const override;

    /// Finds the tension cut-off from its entry; auto: the cohesion, as far as its strength, also the residual one,
    /// allows it, in water, else 0. Throws EntryError if the entry is neither auto nor a number from 0 on.
    void complete(const std::string &subsection, const bool in_water) override;

    /// Divides tan(phi), c and the tension cut-off; psi stays, but is at most phi. The cut-off of a strength that
    /// differs from place to place does not grow.
    bool divide_strength(const double factor) override;
    std::optional<double> sine_of_friction() const override
    {
      return sine();
    }

  private:
    void check_varying(const std::string &subsection) const;
    void check_softening(const std::string &subsection) const;
  };


  /// Three numbers in falling order, and what it takes to bring others of their places back.
  template <typename Number>
  struct Sorted
  {
    /// Sorts the numbers.
    DEAL_II_ALWAYS_INLINE inline explicit Sorted(const PrincipalNumbers<Number> &numbers)
        : numbers(numbers)
    {
      exchanged[0] = exchange(this->numbers, 0, this->numbers[0] < this->numbers[1]);
      exchanged[1] = exchange(this->numbers, 1, this->numbers[1] < this->numbers[2]);
      exchanged[2] = exchange(this->numbers, 0, this->numbers[0] < this->numbers[1]);
    }

    /// In the order before, for sorted `result`.
    DEAL_II_ALWAYS_INLINE inline PrincipalNumbers<Number> unsorted(PrincipalNumbers<Number> result) const
    {
      exchange(result, 0, exchanged[2]);
      exchange(result, 1, exchanged[1]);
      exchange(result, 0, exchanged[0]);
      return result;
    }

    PrincipalNumbers<Number> numbers; ///< in falling order

  private:
    DEAL_II_ALWAYS_INLINE inline static simd::Mask<Number>
    exchange(PrincipalNumbers<Number> &numbers, const unsigned int i, const simd::Mask<Number> &condition)
    {
      const Number first = numbers[i], second = numbers[i + 1];
      numbers[i]     = simd::select<Number>(condition, second, first);
      numbers[i + 1] = simd::select<Number>(condition, first, second);
      return condition;
    }

    simd::Mask<Number> exchanged[3];
  };


  /// Mohr-Coulomb's strength, of all points (double) or of each point of a Batch.
  template <typename S>
  struct MohrCoulombStrength
  {
    S sine;          ///< sin(phi)
    S dilation_sine; ///< sin(psi)
    S limit;         ///< 2 c cos(phi), Pa
  };


  /// The planes that bound sorted stresses, tau_1 >= tau_2 >= tau_3: friction of each pair, then the cut-off of each;
  /// and the return to those of them that a sorted stress can meet together, each set a small linear system.
  template <typename S>
  class MohrCoulombSurfaces
  {
  public:
    /// @param strength of all points, or of each
    /// @param cut_off largest principal stress, Pa, at most that of the apex of each point
    /// @param bulk modulus, Pa
    /// @param shear modulus, Pa
    /// @param has_cut_off whether the cut-off is met but at the apex
    DEAL_II_ALWAYS_INLINE inline MohrCoulombSurfaces(const MohrCoulombStrength<S> &strength,
                                                     const double cut_off,
                                                     const double bulk,
                                                     const double shear,
                                                     const bool has_cut_off)
        : shear(shear)
        , has_cut_off(has_cut_off)
    {
      for (unsigned int s = 0; s < n_surfaces; ++s)
        {
          Surface &surface    = surfaces[s];
          surface.normal      = direction(s, strength.sine);
          surface.flow        = direction(s, strength.dilation_sine);
          const auto &flow    = surface.flow;
          const S volume_part = (bulk - 2. / 3. * shear) * (flow[0] + flow[1] + flow[2]);
          for (unsigned int i = 0; i < 3; ++i)
            surface.relaxation[i] = volume_part + 2 * shear * flow[i];
          surface.limit = s < cut_1 ? strength.limit : simd::broadcast<S>(cut_off);
        }
      if constexpr (is_constant)
        for_each_set([&](const unsigned int number, const auto &set) { systems[number] = system_of(set); });
    }

    /// Returns a sorted stress of the points `todo` and sets their plastic strain; those that meet no set of surfaces
    /// stay in it. The strain of cut-offs is no plastic strain.
    template <typename Number>
    DEAL_II_ALWAYS_INLINE inline void
    return_sorted(PrincipalNumbers<Number> &stress, PrincipalNumbers<Number> &plastic, simd::Mask<Number> &todo) const
    {
      const PrincipalNumbers<Number> trial = stress;
      const Number zero                    = simd::broadcast<Number>(0.);
      const Number tolerance =
          1e-12 * simd::max<Number>(surfaces[f13].limit + zero,
                                    simd::max<Number>(simd::abs<Number>(trial[0]), simd::abs<Number>(trial[2])));
      for_each_set([&](const unsigned int number, const auto &set) {
        if (!simd::any(todo))
          return;
        constexpr unsigned int n = std::tuple_size_v<std::decay_t<decltype(set)>>;
        System of_points;
        if constexpr (!is_constant)
          of_points = system_of(set);
        const System &system = is_constant ? systems[number] : of_points;
        Number multiplier[n];
        for (unsigned int a = 0; a < n; ++a)
          {
            multiplier[a] = excess<Number>(surfaces[set[a]], trial);
            for (unsigned int b = 0; b < a; ++b)
              multiplier[a] -= system.factors[a][b] * multiplier[b];
          }
        for (unsigned int a = n; a-- > 0;)
          {
            for (unsigned int b = a + 1; b < n; ++b)
              multiplier[a] -= system.factors[a][b] * multiplier[b];
            multiplier[a] = multiplier[a] * system.factors[a][a];
          }

        simd::Mask<Number> is_found       = todo;
        PrincipalNumbers<Number> returned = trial, flowed;
        flowed.fill(zero);
        for (unsigned int a = 0; a < n; ++a)
          {
            const Surface &surface = surfaces[set[a]];
            is_found               = is_found & (multiplier[a] * shear >= -1. * tolerance);
            for (unsigned int i = 0; i < 3; ++i)
              {
                returned[i] -= multiplier[a] * surface.relaxation[i];
                if (set[a] < cut_1)
                  flowed[i] += multiplier[a] * surface.flow[i];
              }
          }
        for (const Surface &surface : surfaces)
          is_found = is_found & (excess<Number>(surface, returned) <= tolerance);
        for (unsigned int i = 0; i < 3; ++i)
          {
            stress[i]  = simd::select<Number>(is_found, returned[i], stress[i]);
            plastic[i] = simd::select<Number>(is_found, flowed[i], plastic[i]);
          }
        todo = todo & !is_found;
      });
    }

  private:
    /// Friction of the largest and the smallest stress, of the larger two and of the smaller two; cut-off of the
    /// largest and the middle one, which that of the smallest follows.
    static constexpr unsigned int f13 = 0, f12 = 1, f23 = 2, cut_1 = 3, cut_2 = 4, n_surfaces = 6, n_sets = 9;
    static constexpr bool is_constant = std::is_same_v<S, double>; // systems are solved once

    /// A plane normal . tau <= limit; relaxation: elastic stiffness times flow direction, Pa.
    struct Surface
    {
      PrincipalNumbers<S> normal, flow, relaxation;
      S limit;
    };

    /// Surfaces that are met together.
    template <std::size_t n>
    using Set = std::array<unsigned int, n>;

    /// The factors of normal_a . relaxation_b, with inverse pivots.
    struct System
    {
      S factors[3][3];
    };

    /// Calls `act(number, set)` for the sets in the order in which they are tried.
    template <typename Act>
    DEAL_II_ALWAYS_INLINE inline void for_each_set(const Act &act) const
    {
      act(0, Set<1>{ { f13 } });
      act(1, Set<2>{ { f13, f12 } });
      act(2, Set<2>{ { f13, f23 } });
      if (!has_cut_off)
        return;
      act(3, Set<1>{ { cut_1 } });
      act(4, Set<2>{ { cut_1, cut_2 } });
      act(5, Set<2>{ { f13, cut_1 } });
      act(6, Set<3>{ { f13, f12, cut_1 } });
      // The edge where four surfaces meet, as two cones.
      act(7, Set<3>{ { f13, cut_1, cut_2 } });
      act(8, Set<3>{ { f13, f23, cut_1 } });
      // The three cut-offs meet at the vertex, which needs no system.
    }

    /// Normal, or flow direction, of a friction plane with this sine of phi, or of psi; of a cut-off, whatever the
    /// sine.
    static PrincipalNumbers<S> direction(const unsigned int surface, const S &sine)
    {
      constexpr unsigned int largest[3] = { 0, 0, 1 }, smallest[3] = { 2, 1, 2 };
      PrincipalNumbers<S> result;
      result.fill(simd::broadcast<S>(0.));
      if (surface >= cut_1)
        result[surface - cut_1] = simd::broadcast<S>(1.);
      else
        {
          result[largest[surface]]  = 1. + sine;
          result[smallest[surface]] = sine - 1.;
        }
      return result;
    }

    /// Elimination needs no pivots: principal minors are positive for sin(psi) <= sin(phi) < 1.
    template <std::size_t n>
    DEAL_II_ALWAYS_INLINE inline System system_of(const Set<n> &set) const
    {
      System system;
      auto &m = system.factors;
      for (unsigned int a = 0; a < n; ++a)
        for (unsigned int b = 0; b < n; ++b)
          {
            const auto &normal = surfaces[set[a]].normal, &relaxation = surfaces[set[b]].relaxation;
            m[a][b] = normal[0] * relaxation[0] + normal[1] * relaxation[1] + normal[2] * relaxation[2];
          }
      for (unsigned int a = 0; a < n; ++a)
        {
          m[a][a] = 1. / m[a][a];
          for (unsigned int b = a + 1; b < n; ++b)
            {
              m[b][a] = m[b][a] * m[a][a];
              for (unsigned int c = a + 1; c < n; ++c)
                m[b][c] -= m[b][a] * m[a][c];
            }
        }
      return system;
    }

    /// How far a stress is beyond a surface, Pa.
    template <typename Number>
    DEAL_II_ALWAYS_INLINE inline static Number excess(const Surface &surface, const PrincipalNumbers<Number> &stress)
    {
      return surface.normal[0] * stress[0] + surface.normal[1] * stress[1] + surface.normal[2] * stress[2] -
             surface.limit;
    }

    const double shear; // modulus, Pa
    const bool has_cut_off;
    Surface surfaces[n_surfaces];
    System systems[is_constant ? n_sets : 1];
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
  class MohrCoulomb : public ConstitutiveLaw
  {
  public:
    static constexpr unsigned int n_internal_variables = 1;    ///< plastic shear strain
    static constexpr double largest_opening            = 0.05; ///< volume strain beyond which cohesive soil is apart

    /// Builds the yield surfaces, and the sets of them that a return can meet.
    explicit MohrCoulomb(const MohrCoulombParameters &parameters);

    /// Pa, at any pressure.
    double bulk_modulus(const double) const
    {
      return bulk;
    }

    /// J per m^3 of reference volume: elastic energy, and the work of the cut-off in what is open.
    template <typename Number>
    Number energy(const PrincipalNumbers<Number> &strain) const
    {
      const Number limit = simd::broadcast<Number>(largest_principal_stress);
      const double lame = bulk - 2. / 3. * shear_modulus, twice = 2. * shear_modulus;
      const Number larger = simd::max<Number>(strain[0], strain[1]), smaller = simd::min<Number>(strain[0], strain[1]);
      const Number e[]   = { simd::max<Number>(larger, strain[2]),
                             simd::max<Number>(smaller, simd::min<Number>(larger, strain[2])),
                             simd::min<Number>(smaller, strain[2]) }; // from the largest on
      const Number sum   = e[0] + e[1] + e[2];
      const auto is_open = lame * sum + twice * e[0] > limit;
      PrincipalNumbers<Number> closed{ { e[0], e[1], e[2] } };
      if (simd::any(is_open)) // closes one axis after the other
        {
          const Number one  = (limit - lame * (e[1] + e[2])) * (1. / (lame + twice));
          const Number two  = (limit - lame * e[2]) * (1. / (2. * lame + twice));
          const auto second = is_open & (lame * (one + e[1] + e[2]) + twice * e[1] > limit);
          const auto third  = second & (lame * (2. * two + e[2]) + twice * e[2] > limit);
          const Number all  = limit * (1. / (3. * lame + twice));
          closed[0]         = simd::select<Number>(is_open, simd::select<Number>(second, two, one), closed[0]);
          closed[1]         = simd::select<Number>(second, two, closed[1]);
          for (Number &value : closed)
            value = simd::select<Number>(third, all, value);
        }
      const Number rest = sum - (closed[0] + closed[1] + closed[2]);
      return elastic.energy(take_invariants<Number>(closed)) + limit * rest;
    }

    /// See ConstitutiveLaw.
    template <typename Number>
    DEAL_II_ALWAYS_INLINE inline LawResponse<Number> respond(const LawStep<Number> &step,
                                                             PrincipalNumbers<Number> &strain,
                                                             Number *internal_variables,
                                                             PrincipalNumbers<Number> &stress) const
    {
      stress = stress_of(strain);
      LawResponse<Number> response{};
      response.bulk_modulus     = simd::broadcast<Number>(bulk);
      response.is_plastic       = yield(stress, own_strength) > 0.;
      const auto plastic_return = [&]() __attribute__((noinline)) // elastic points have short code
      {
        // Grains with a gap do not dilate.
        const auto cohesionless_points = cohesionless ? response.is_plastic : simd::Mask<Number>{};
        return_to<1, Number>(surfaces, cohesionless_points, step, strain, internal_variables, stress, response);
      };
      if (simd::any(response.is_plastic))
        plastic_return();
      return response;
    }

    /// See Material::initialise(). Throws if the stress is outside the yield surface.
    void initialise(const PrincipalValues &wanted_stress,
                    PrincipalValues &strain,
                    PrincipalValues &stress,
                    double *internal_variables) const
    {
      initialise_inside(own_strength, wanted_stress, strain, stress, internal_variables);
    }

    /// Largest of all yield functions, Pa; negative inside.
    /// @param strength of all points, or of each
    template <typename Number, typename S>
    Number yield(const PrincipalNumbers<Number> &stress, const MohrCoulombStrength<S> &strength) const
    {
      const Number largest = largest_of(stress), smallest = smallest_of(stress);
      return simd::max<Number>((1. + strength.sine) * largest - (1. - strength.sine) * smallest - strength.limit,
                               largest - largest_principal_stress);
    }

    const MohrCoulombStrength<double> own_strength; ///< at the peak

  protected:
    /// The largest of three numbers.
    template <typename Number>
    DEAL_II_ALWAYS_INLINE inline static Number largest_of(const PrincipalNumbers<Number> &numbers)
    {
      return simd::max<Number>(numbers[0], simd::max<Number>(numbers[1], numbers[2]));
    }

    /// The smallest of three numbers.
    template <typename Number>
    DEAL_II_ALWAYS_INLINE inline static Number smallest_of(const PrincipalNumbers<Number> &numbers)
    {
      return simd::min<Number>(numbers[0], simd::min<Number>(numbers[1], numbers[2]));
    }

    /// Elastic principal stress, Pa.
    template <typename Number>
    DEAL_II_ALWAYS_INLINE inline PrincipalNumbers<Number> stress_of(const PrincipalNumbers<Number> &strain) const
    {
      const Number volume_part = (bulk - 2. / 3. * shear_modulus) * (strain[0] + strain[1] + strain[2]);
      return { { volume_part + 2 * shear_modulus * strain[0],
                 volume_part + 2 * shear_modulus * strain[1],
                 volume_part + 2 * shear_modulus * strain[2] } };
    }

    /// The return of the points that are plastic, from trial strain and stress. Sets internal variables: plastic shear
    /// strain sqrt(2/3 e:e), and kappa = e_1 - e_3 of the plane that shears, twice, if there are three of them.
    /// @param cohesionless points whose grains are apart without any opening
    template <unsigned int n_variables, typename Number, typename S>
    DEAL_II_ALWAYS_INLINE inline void return_to(const MohrCoulombSurfaces<S> &surfaces,
                                                const simd::Mask<Number> &cohesionless,
                                                const LawStep<Number> &step,
                                                PrincipalNumbers<Number> &strain,
                                                Number *internal_variables,
                                                PrincipalNumbers<Number> &stress,
                                                LawResponse<Number> &response) const
    {
      const PrincipalNumbers<Number> trial = strain;
      const Number volume_strain = strain[0] + strain[1] + strain[2], zero = simd::broadcast<Number>(0.);
      const Number of_apart =
          simd::select<Number>(cohesionless, zero, simd::broadcast<Number>(vertex / bulk + largest_opening));
      const simd::Mask<Number> is_kept_apart = response.is_plastic & (volume_strain >= of_apart);

      Sorted<Number> sorted(stress);
      simd::Mask<Number> left = response.is_plastic & !is_kept_apart;
      PrincipalNumbers<Number> plastic;
      plastic.fill(zero);
      surfaces.return_sorted(sorted.numbers, plastic, left);
      stress  = sorted.unsorted(sorted.numbers);
      plastic = sorted.unsorted(plastic);

      const simd::Mask<Number> at_vertex = left | is_kept_apart;
      const Number corner = simd::max<Number>(volume_strain, simd::broadcast<Number>(vertex / bulk)) * (1. / 3.);
      const Number mean   = (plastic[0] + plastic[1] + plastic[2]) * (1. / 3.);
      Number square       = zero;
      for (unsigned int i = 0; i < 3; ++i)
        {
          strain[i] = simd::select<Number>(at_vertex, corner, strain[i] - plastic[i]);
          stress[i] = simd::select<Number>(at_vertex, simd::broadcast<Number>(vertex), stress[i]);
          plastic[i] -= mean; // 0 at the vertex
          square += plastic[i] * plastic[i];
        }
      response.is_unresolved = at_vertex & (volume_strain < vertex / bulk * (1 - 1e-10));
      (vertex > 0 ? response.is_vertex : response.is_separated) = at_vertex & !response.is_unresolved;

      Number increments[] = { simd::sqrt<Number>(2. / 3. * square), largest_of(plastic) - smallest_of(plastic) };
      if (inertial_friction.is_active())
        {
          const Number part                   = inertial_friction.take_back<Number>(trial,
                                                                  shear_modulus,
                                                                  -0.5 * (largest_of(stress) + smallest_of(stress)),
                                                                  response.is_plastic,
                                                                  step,
                                                                  strain);
          const PrincipalNumbers<Number> kept = stress_of(strain);
          for (unsigned int i = 0; i < 3; ++i)
            stress[i] = simd::select<Number>(part > 0., kept[i], stress[i]);
          for (Number &increment : increments)
            increment *= 1. - part;
        }
      for (unsigned int i = 0; i < n_variables; ++i)
        internal_variables[i] += increments[i > 0];
    }

    /// The response with a strength of each point; see return_to().
    /// @param least_limit 2 c cos(phi) of grains without cohesion, Pa
    template <unsigned int n_variables, typename Number>
    DEAL_II_ALWAYS_INLINE inline LawResponse<Number> respond_with(const MohrCoulombStrength<Number> &strength,
                                                                  const double least_limit,
                                                                  const LawStep<Number> &step,
                                                                  PrincipalNumbers<Number> &strain,
                                                                  Number *internal_variables,
                                                                  PrincipalNumbers<Number> &stress) const
    {
      stress = stress_of(strain);
      LawResponse<Number> response{};
      response.bulk_modulus     = simd::broadcast<Number>(bulk);
      response.is_plastic       = yield(stress, strength) > 0.;
      const auto plastic_return = [&]() __attribute__((noinline))
      {
        const MohrCoulombSurfaces<Number> surfaces(strength, largest_principal_stress, bulk, shear_modulus, true);
        return_to<n_variables, Number>(
            surfaces, strength.limit <= least_limit, step, strain, internal_variables, stress, response);
      };
      if (simd::any(response.is_plastic))
        plastic_return();
      return response;
    }

    /// The strength with these tan(phi), tan(psi) and c, Pa.
    template <typename Number>
    DEAL_II_ALWAYS_INLINE inline static MohrCoulombStrength<Number>
    strength_of_tangents(const Number &tan_phi, const Number &tan_psi, const Number &cohesion)
    {
      const Number cos_phi = 1. / simd::sqrt<Number>(1. + tan_phi * tan_phi);
      const Number cos_psi = 1. / simd::sqrt<Number>(1. + tan_psi * tan_psi);
      return { tan_phi * cos_phi, tan_psi * cos_psi, 2. * cohesion * cos_phi };
    }

    /// See Material::initialise(). Throws if the stress is outside the yield surface of this strength.
    void initialise_inside(const MohrCoulombStrength<double> &strength,
                           const PrincipalValues &wanted_stress,
                           PrincipalValues &strain,
                           PrincipalValues &stress,
                           double *internal_variables) const;

    const LinearElastic elastic;           ///< the law without plastic strain
    const double bulk;                     ///< modulus, Pa
    const double vertex;                   ///< tau of the vertex, Pa
    const double largest_principal_stress; ///< of the cut-off, Pa

  private:
    const bool cohesionless; // whether the vertex of friction and cohesion is at 0
    const InertialFriction inertial_friction;
    const MohrCoulombSurfaces<double> surfaces;
  };


  /// MohrCoulomb whose cohesion and tan(phi) are those of the place of a point at the start, over a factor; psi is at
  /// most phi. The apex of each point is beyond the cut-off.
  class VaryingMohrCoulomb : public MohrCoulomb
  {
  public:
    /// Plastic shear strain sqrt(2/3 e:e), c, Pa, and tan(phi).
    static constexpr unsigned int n_internal_variables = 3;

    /// With cohesion and friction angle of each point.
    explicit VaryingMohrCoulomb(const MohrCoulombParameters &parameters);

    /// See ConstitutiveLaw.
    template <typename Number>
    DEAL_II_ALWAYS_INLINE inline LawResponse<Number> respond(const LawStep<Number> &step,
                                                             PrincipalNumbers<Number> &strain,
                                                             Number *internal_variables,
                                                             PrincipalNumbers<Number> &stress) const
    {
      return respond_with<1, Number>(
          strength<Number>(internal_variables), 0., step, strain, internal_variables, stress);
    }

    /// See Material::initialise(). Throws if the stress is outside the yield surface of the point.
    void initialise(const PrincipalValues &wanted_stress,
                    PrincipalValues &strain,
                    PrincipalValues &stress,
                    double *internal_variables) const
    {
      initialise_inside(strength(internal_variables), wanted_stress, strain, stress, internal_variables);
    }

    /// The strength of these variables.
    template <typename Number>
    DEAL_II_ALWAYS_INLINE inline MohrCoulombStrength<Number> strength(const Number *internal_variables) const
    {
      const Number tan_phi = scale * internal_variables[tangent];
      return strength_of_tangents<Number>(tan_phi,
                                          simd::min<Number>(tan_phi, simd::broadcast<Number>(dilation_tangent)),
                                          scale * internal_variables[cohesion]);
    }

  private:
    static constexpr unsigned int cohesion = 1, tangent = 2; // internal variables

    const double scale;            // of the strength, 1 unless reduced
    const double dilation_tangent; // tan(psi)
  };


  /// MohrCoulomb whose cohesion, tan(phi) and tan(psi) fall from peak to residual with the plastic shear strain of the
  /// plane of shear, kappa = sum of (d eps_1^p - d eps_3^p), which is gamma^p in simple shear:
  ///   value = residual + (peak - residual) exp(-kappa/softening strain).
  ///
  /// Strength is that of kappa before the step, so that a return is perfectly plastic: the error is of first order in
  /// the strain of a step. kappa does not grow while grains are apart. Where the law has a length, the strain that sets
  /// the strength is averaged over space between two steps, see NonlocalAverage.
  class SofteningMohrCoulomb : public MohrCoulomb
  {
  public:
    /// Plastic shear strain sqrt(2/3 e:e), kappa, and the kappa that sets the strength.
    static constexpr unsigned int n_internal_variables = 3;

    /// Strength between that of the parameters and of their residual().
    explicit SofteningMohrCoulomb(const MohrCoulombParameters &parameters);

    /// See ConstitutiveLaw.
    template <typename Number>
    DEAL_II_ALWAYS_INLINE inline LawResponse<Number> respond(const LawStep<Number> &step,
                                                             PrincipalNumbers<Number> &strain,
                                                             Number *internal_variables,
                                                             PrincipalNumbers<Number> &stress) const
    {
      return respond_with<3, Number>(
          strength<Number>(internal_variables[acting_kappa]), least_limit, step, strain, internal_variables, stress);
    }

    /// See Material::initialise(). Throws if the stress is outside the yield surface of the peak.
    void initialise(const PrincipalValues &wanted_stress,
                    PrincipalValues &strain,
                    PrincipalValues &stress,
                    double *internal_variables) const
    {
      MohrCoulomb::initialise(wanted_stress, strain, stress, internal_variables);
      internal_variables[own_kappa] = internal_variables[acting_kappa] = 0;
    }

    /// The strength at this kappa.
    template <typename Number>
    DEAL_II_ALWAYS_INLINE inline MohrCoulombStrength<Number> strength(const Number &kappa) const
    {
      const Number positive  = simd::max<Number>(kappa, simd::broadcast<Number>(0.));
      const Number remaining = simd::exp<Number>(positive * (-1. / softening_strain));
      const auto at          = [&](const Falling &value) { return value.residual + value.fall * remaining; };
      return strength_of_tangents<Number>(at(tangent), at(dilation_tangent), at(cohesion));
    }

  private:
    /// A strength that falls with kappa.
    struct Falling
    {
      double residual, fall;
    };

    static constexpr unsigned int own_kappa = 1, acting_kappa = 2; // internal variables

    const double softening_strain;
    Falling tangent, dilation_tangent, cohesion; // tan(phi), tan(psi), c, Pa
    const double least_limit;                    // 2 c cos(phi) of grains without cohesion, Pa
  };
} // namespace scree

#endif

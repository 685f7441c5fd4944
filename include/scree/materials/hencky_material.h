// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_materials_hencky_material_h
#define scree_materials_hencky_material_h

#include <scree/input/input_error.h>
#include <scree/materials/law.h>
#include <scree/simd/records.h>
#include <scree/tensor/elastic_strain.h>

#include <deal.II/base/exceptions.h>

#include <utility>

namespace scree
{
  /// Trial strain of points in principal values, and what a law makes of it.
  template <int dim, typename Number>
  class PrincipalState
  {
  public:
    /// @param b components of the trial b_e
    DEAL_II_ALWAYS_INLINE inline explicit PrincipalState(const Number *b)
        : frame(b)
        , trial(log_strain(frame.values()))
        , strain(trial)
    {
      is_valid = simd::abs<Number>(trial[0] + trial[1] + trial[2]) <=
                 simd::broadcast<Number>(largest_number); // else not finite
    }

    /// Sets strain, stress and internal variables.
    template <typename Law>
    DEAL_II_ALWAYS_INLINE inline LawResponse<Number>
    respond(const Law &law, const LawStep<Number> &step, Number *internal_variables)
    {
      return scree::respond(law, step, strain, internal_variables, stress);
    }

    /// Components of b_e.
    DEAL_II_ALWAYS_INLINE inline void left_cauchy_green(Number *b) const
    {
      left_cauchy_green_of(frame, strain, b);
    }

    /// Components of the Kirchhoff stress times `factor`.
    DEAL_II_ALWAYS_INLINE inline void compose_stress(const Number &factor, Number *components) const
    {
      frame.compose({ { factor * stress[0], factor * stress[1], factor * stress[2] } }, components);
    }

    /// Stored energy, J per m^3 of reference volume.
    template <typename Law>
    DEAL_II_ALWAYS_INLINE inline Number energy(const Law &law, const simd::Mask<Number> &) const
    {
      return energy_of<Number>(law, strain);
    }

    /// Kirchhoff stress times the change of strain, J per m^3 of reference volume.
    Number dissipation() const
    {
      return stress[0] * (trial[0] - strain[0]) + stress[1] * (trial[1] - strain[1]) +
             stress[2] * (trial[2] - strain[2]);
    }

    /// Largest compressive principal stress, Pa.
    Number compression() const
    {
      return -1. * simd::min<Number>(stress[0], simd::min<Number>(stress[1], stress[2]));
    }

    /// The same, or more than it, cheap.
    Number bound_of_compression() const
    {
      return compression();
    }

    simd::Mask<Number> is_valid; ///< whether the strain can be computed

  private:
    static constexpr double largest_number = std::numeric_limits<double>::max();

    PrincipalFrame<dim, Number> frame;
    PrincipalNumbers<Number> trial, strain, stress;
  };


  /// The same in invariants, see InvariantResponse; in three dimensions.
  template <typename Number>
  class InvariantState : public ElasticStrain<Number>
  {
  public:
    /// @param b components of the trial b_e
    DEAL_II_ALWAYS_INLINE inline explicit InvariantState(const Number *b)
        : ElasticStrain<Number>(b)
    {
    }

    /// Sets the response and internal variables.
    template <typename Law>
    DEAL_II_ALWAYS_INLINE inline LawResponse<Number>
    respond(const Law &law, const LawStep<Number> &step, Number *internal_variables)
    {
      found =
          law.respond(step, StrainInvariants<Number>{ this->volume, this->square, this->third() }, internal_variables);
      return found;
    }

    /// Components of b_e.
    DEAL_II_ALWAYS_INLINE inline void left_cauchy_green(Number *b) const
    {
      this->compose(found.volume_strain, found.deviator_factor, b);
    }

    /// Components of the Kirchhoff stress times `factor`.
    DEAL_II_ALWAYS_INLINE inline void compose_stress(const Number &factor, Number *components) const
    {
      const Number mean = factor * found.mean_stress, slope = factor * found.stress_factor;
      for (unsigned int c = 0; c < 6; ++c)
        components[c] = c < 3 ? mean + slope * this->deviator[c] : slope * this->deviator[c];
    }

    /// Stored energy, J per m^3 of reference volume.
    /// @param is_plastic where the strain has been returned
    template <typename Law>
    DEAL_II_ALWAYS_INLINE inline Number energy(const Law &law, const simd::Mask<Number> &is_plastic) const
    {
      const Number square = found.deviator_factor * found.deviator_factor * this->square;
      return law.energy(StrainInvariants<Number>{ simd::select<Number>(is_plastic, found.volume_strain, this->volume),
                                                  simd::select<Number>(is_plastic, square, this->square),
                                                  simd::broadcast<Number>(0.) });
    }

    /// Kirchhoff stress times the change of strain, J per m^3 of reference volume.
    Number dissipation() const
    {
      return found.mean_stress * (this->volume - found.volume_strain) +
             found.stress_factor * (1. - found.deviator_factor) * this->square;
    }

    /// Largest compressive principal stress, Pa.
    Number compression() const
    {
      return -1. * (found.mean_stress + found.stress_factor * this->least_deviator());
    }

    /// The same, or more than it, cheap.
    Number bound_of_compression() const
    {
      return -1. * (found.mean_stress + found.stress_factor * this->bound_of_deviator());
    }

  private:
    InvariantResponse<Number> found;
  };


  /// Kinematics around a law (@source{simo1992}): trial b_e, logarithmic strain, the law's return map, exponential map,
  /// sigma = tau/J. The law is inlined in the loop over points; nothing allocates.
  ///
  /// A step is cut into n parts of a straight path, F_k = I + k/n (dF - I) and f_k = F_k F_{k-1}^{-1}, such that no
  /// component of F_k - F_{k-1} is beyond the law's sub-step strain.
  ///
  /// Points go through advance() side by side. Those that need sub-steps, and those whose return a law leaves, are
  /// gathered, so that the lanes of further rounds are full; in three dimensions strain far from a sphere is left to
  /// a last one in principal values. Which way a point goes, and what comes out, does not depend on its neighbours.
  template <int dim, typename Law>
  class HenckyMaterial : public Material<dim>
  {
  public:
    /// Copies the law.
    explicit HenckyMaterial(const Law &law)
        : Material<dim>(law)
        , law(law)
    {
      Assert(this->internal_quantities.size() == n_internal, dealii::ExcMessage("A law has two numbers of variables."));
    }

    void
    update(const MaterialPoints<dim> &points, const MaterialMotion<dim> &motion, UpdateReport &report) const override
    {
      UpdateReport own;                                       // The compiler keeps it in registers.
      own.largest_bulk_modulus = report.largest_bulk_modulus; // so that few batches have larger ones
      own.largest_compression  = report.largest_compression;
      Batch energies           = simd::broadcast<Batch>(0.);
      for (unsigned int first = 0; first < points.n_points; first += List::capacity)
        {
          List returns, cut, others;
          for_each_batch(std::min(points.n_points - first, List::capacity), [&](auto indices, const unsigned int n) {
            for (unsigned int &index : indices)
              index += first;
            const Left left = advance<State<Batch>, Batch, false>(indices, n, points, motion, own, energies);
            if (left.all == 0)
              return;
            returns.append(indices, left.all & ~left.cut);
            cut.append(indices, left.cut);
          });
          if constexpr (Law::leaves_returns)
            advance_list<State<Gathered>>(returns, others, points, motion, own, energies);
          advance_list<State<Gathered>>(cut, others, points, motion, own, energies);
          if constexpr (Law::in_invariants && dim == 3)
            {
              const List far = std::exchange(others, List());
              advance_list<PrincipalState<dim, Gathered>>(far, others, points, motion, own, energies);
            }
          if (others.size > 0)
            throw_refusal(others.points[0], motion);
        }
      own.n_updates = points.n_points;
      for (unsigned int lane = 0; lane < batch_size; ++lane)
        own.elastic_energy += energies[lane];
      report.add(own);
    }

    double initial_bulk_modulus(const double pressure) const override
    {
      return law.bulk_modulus(pressure);
    }
    double elastic_energy(const double *left_cauchy_green) const override
    {
      return energy_of<double>(law, strain_of(left_cauchy_green));
    }
    Batch elastic_energies(const Batch *left_cauchy_green) const override
    {
      return energy_of<Batch>(law, log_strain(PrincipalFrame<dim, Batch>(left_cauchy_green).values()));
    }
    void initialise(const double *wanted_stress,
                    double *left_cauchy_green,
                    double *stress,
                    double *internal_variables) const override
    {
      const PrincipalFrame<dim> frame(wanted_stress);
      PrincipalValues strain, principal_stress;
      law.initialise(frame.values(), strain, principal_stress, internal_variables);
      left_cauchy_green_of(frame, strain, left_cauchy_green);
      frame.compose(principal_stress, stress);
    }
    void output(const double *left_cauchy_green,
                const double *internal_variables,
                const double volume_ratio,
                double *values) const override
    {
      law.output(strain_of(left_cauchy_green), internal_variables, volume_ratio, values);
    }

  private:
    static constexpr unsigned int n_components = n_symmetric_components<dim>, n_internal = Law::n_internal_variables;
    static constexpr double largest_number_of_parts = 1000;

    /// The state that suits the law.
    template <typename Number>
    using State =
        std::conditional_t<Law::in_invariants && dim == 3, InvariantState<Number>, PrincipalState<dim, Number>>;

    /// A Newton iteration waits for the one before: pairs of batches fill the time.
    using Gathered = std::conditional_t<Law::leaves_returns, BatchPair, Batch>;

    /// Numbers of points that are advanced later.
    struct List
    {
      static constexpr unsigned int capacity = 128;
      unsigned int size                      = 0;
      std::array<unsigned int, capacity> points;

      /// The points of the lanes whose bits are set.
      template <typename Indices>
      void append(const Indices &indices, unsigned int bits)
      {
        for (; bits != 0; bits &= bits - 1)
          points[size++] = indices[__builtin_ctz(bits)];
      }
    };

    /// State and motion of points side by side.
    template <typename Number>
    struct Lanes
    {
      Number left_cauchy_green[n_components], internal_variables[n_internal + 1]; // an array of 0 is not allowed
      Number increment[dim * dim], stretch;                                       // dF; dF_zz
      Number volume_ratio, reference_volume;
    };

    /// Reads points; `n` of them that lie in a row, or any points if n = 0.
    template <typename Number, typename Indices>
    DEAL_II_ALWAYS_INLINE static inline Lanes<Number> read(const Indices &indices,
                                                           const unsigned int n,
                                                           const MaterialPoints<dim> &points,
                                                           const MaterialMotion<dim> &motion)
    {
      constexpr unsigned int n_lanes = simd::n_lanes<Number>;
      Lanes<Number> lanes;
      for (unsigned int h = 0; h < n_lanes / batch_size; ++h)
        {
          RecordPointers<const double> b, internal;
          for (unsigned int l = 0; l < batch_size; ++l)
            {
              const std::size_t offset = points.offset(indices[h * batch_size + l]);
              b[l]                     = apart(points.left_cauchy_green + offset);
              internal[l]              = apart(points.internal_variables + offset);
            }
          if constexpr (n_lanes == batch_size)
            {
              simd::load_records<n_components>(b, lanes.left_cauchy_green);
              simd::load_records<n_internal>(internal, lanes.internal_variables);
            }
          else
            {
              Batch components[n_components], variables[n_internal + 1];
              simd::load_records<n_components>(b, components);
              simd::load_records<n_internal>(internal, variables);
              for (unsigned int c = 0; c < n_components; ++c)
                simd::half(lanes.left_cauchy_green[c], h) = components[c];
              for (unsigned int i = 0; i < n_internal; ++i)
                simd::half(lanes.internal_variables[i], h) = variables[i];
            }
        }

      const auto list = [&](const double *numbers) {
        Number result;
        for (unsigned int h = 0; h < n_lanes / batch_size; ++h)
          if (Batch &batch = simd::half(result, h); n == n_lanes)
            batch = simd::load(numbers + indices[h * batch_size]);
          else
            for (unsigned int l = 0; l < batch_size; ++l)
              batch[l] = numbers[indices[h * batch_size + l]];
        return result;
      };
      for (unsigned int c = 0; c < dim * dim; ++c)
        lanes.increment[c] = list(motion.deformation_increment + c * motion.pitch);
      lanes.volume_ratio     = list(motion.volume_ratio);
      lanes.reference_volume = list(motion.reference_volume);
      lanes.stretch          = dim == 2 ? list(motion.out_of_plane_stretch) : simd::broadcast<Number>(1.);
      return lanes;
    }

    /// Writes `n_values` Numbers into the records of the lanes whose bits are set.
    template <unsigned int n_values, typename Number, typename Indices>
    DEAL_II_ALWAYS_INLINE static inline void write(const Number *values,
                                                   const Indices &indices,
                                                   const unsigned int bits,
                                                   const MaterialPoints<dim> &points,
                                                   double *of_record_0)
    {
      if constexpr (n_values > 0)
        for (unsigned int h = 0; h < simd::n_lanes<Number> / batch_size; ++h)
          {
            double nothing[n_values];
            RecordPointers<double> records;
            for (unsigned int l = 0; l < batch_size; ++l)
              {
                const unsigned int lane = h * batch_size + l;
                records[l] = apart(bits >> lane & 1 ? of_record_0 + points.offset(indices[lane]) : nothing);
              }
            if constexpr (simd::n_lanes<Number> == batch_size)
              simd::store_records<n_values>(values, records);
            else
              {
                Batch batches[n_values];
                for (unsigned int c = 0; c < n_values; ++c)
                  batches[c] = simd::half(values[c], h);
                simd::store_records<n_values>(batches, records);
              }
          }
    }

    /// Trial b_e of part `k` from the b_e that the part before has left.
    template <typename Number>
    DEAL_II_ALWAYS_INLINE static inline void
    set_trial(const double k, const Number &part, const Number *change, const Lanes<Number> &lanes, Number *result)
    {
      Number before[dim * dim], inverse[dim * dim], f[dim * dim];
      for (unsigned int i = 0; i < dim * dim; ++i)
        before[i] = (k * part) * change[i] + (i % (dim + 1) == 0 ? 1. : 0.);
      invert_rows<dim>(before, inverse);
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          {
            f[i * dim + j] = simd::broadcast<Number>(i == j ? 1. : 0.);
            for (unsigned int m = 0; m < dim; ++m)
              f[i * dim + j] += part * change[i * dim + m] * inverse[m * dim + j];
          }
      const Number stretch_change = part * (lanes.stretch - 1.);
      trial_left_cauchy_green<dim, Number>(
          f, 1. + stretch_change / (1. + k * stretch_change), lanes.left_cauchy_green, result);
    }

    /// The bits of lanes that a round has left.
    struct Left
    {
      unsigned int all, cut; // cut: those that need sub-steps
    };

    /// Advances points of a list in parts, one at least; those that it leaves are added to `rest`, their elastic
    /// energies of the middle of the step, J, to `energies`, lane by lane.
    template <typename PointState>
    DEAL_II_ALWAYS_INLINE inline void advance_list(const List &list,
                                                   List &rest,
                                                   const MaterialPoints<dim> &points,
                                                   const MaterialMotion<dim> &motion,
                                                   UpdateReport &report,
                                                   Batch &energies) const
    {
      for_each_group<simd::n_lanes<Gathered>>(list.size, [&](auto places, const unsigned int n) {
        for (unsigned int &place : places)
          place = list.points[place];
        rest.append(places, advance<PointState, Gathered, true>(places, n, points, motion, report, energies).all);
      });
    }

    /// Advances the first `n` of these points by the step: all parts of it, or points in a row that need no sub-steps.
    template <typename PointState, typename Number, bool in_parts, typename Indices>
    DEAL_II_ALWAYS_INLINE inline Left advance(const Indices &indices,
                                              const unsigned int n,
                                              const MaterialPoints<dim> &points,
                                              const MaterialMotion<dim> &motion,
                                              UpdateReport &report,
                                              Batch &energies) const
    {
      using Mask             = simd::Mask<Number>;
      constexpr bool returns = n_internal > 0 && (in_parts || !Law::leaves_returns);
      const Number zero = simd::broadcast<Number>(0.), one = simd::broadcast<Number>(1.);
      const unsigned int used        = (1u << n) - 1;
      Lanes<Number> lanes            = read<Number>(indices, in_parts ? 0 : n, points, motion);
      const LawStep<Number> law_step = { lanes.volume_ratio, motion.time_step, motion.grain_density, !returns };

      Number change[dim * dim], largest_change = dim == 2 ? simd::abs<Number>(lanes.stretch - 1.) : zero; // dF - I
      for (unsigned int i = 0; i < dim * dim; ++i)
        {
          change[i]      = i % (dim + 1) == 0 ? lanes.increment[i] - 1. : lanes.increment[i];
          largest_change = simd::max<Number>(largest_change, simd::abs<Number>(change[i]));
        }
      const Number n_wanted = largest_change * (1. / law.substep_strain);
      // Written such that not-a-number is not served.
      const Mask is_cut = n_wanted > 1.;
      Mask is_served    = (determinant_of_rows<dim>(lanes.increment) > 0.) & (lanes.volume_ratio > 0.) &
                       (lanes.stretch > 0.) & (in_parts ? n_wanted <= largest_number_of_parts : !is_cut);
      Number n_parts = one;
      if constexpr (in_parts)
        {
          const Number rounded = (n_wanted + 0x1p52) - 0x1p52;
          n_parts = simd::max<Number>(simd::select<Number>(rounded < n_wanted, rounded + 1., rounded), one);
        }
      const Number part = 1. / n_parts, inverse_ratio = 1. / lanes.volume_ratio;

      const auto count = [&](const Mask &mask) { return __builtin_popcount(simd::bits_of(mask) & used); };
      Number stress[n_components], dissipation = zero, energy = zero;
      Mask is_separated{}, was_plastic{};
      for (unsigned int k = 0; k == 0 || (in_parts && simd::any(is_served & (n_parts > double(k)))); ++k)
        {
          Number b[n_components], variables[n_internal + 1];
          if constexpr (in_parts)
            set_trial<Number>(k, part, change, lanes, b);
          else
            trial_left_cauchy_green<dim, Number>(lanes.increment, lanes.stretch, lanes.left_cauchy_green, b);
          PointState state(b);
          std::copy_n(lanes.internal_variables, n_internal, variables);
          const LawResponse<Number> response = state.respond(law, law_step, variables);
          Mask is_active                     = is_served & state.is_valid & !response.is_left;
          if constexpr (in_parts)
            {
              const Mask is_in_part = n_parts > double(k);
              is_served             = is_active | (is_served & !is_in_part);
              is_active             = is_active & is_in_part;
            }
          else
            is_served = is_active;
          if (const Mask is_returned = is_active & response.is_plastic; returns && simd::any(is_returned))
            {
              Number returned[n_components];
              state.left_cauchy_green(returned);
              for (unsigned int c = 0; c < n_components; ++c)
                b[c] = simd::select<Number>(is_returned, returned[c], b[c]);
              for (unsigned int i = 0; i < n_internal; ++i)
                lanes.internal_variables[i] =
                    simd::select<Number>(is_returned, variables[i], lanes.internal_variables[i]);
              dissipation += simd::select<Number>(is_returned, state.dissipation(), zero);
              was_plastic = was_plastic | is_returned;
              report.n_vertices += count(is_active & response.is_vertex);
              report.n_fallbacks += count(is_active & response.is_searched);
              report.n_unresolved += count(is_active & response.is_unresolved);
            }
          if (!in_parts || k == 0)
            {
              state.compose_stress(inverse_ratio, stress);
              energy = state.energy(law, response.is_plastic);
              std::copy_n(b, n_components, lanes.left_cauchy_green);
            }
          else
            {
              Number now[n_components];
              state.compose_stress(inverse_ratio, now);
              energy = simd::select<Number>(is_active, state.energy(law, response.is_plastic), energy);
              for (unsigned int c = 0; c < n_components; ++c)
                {
                  lanes.left_cauchy_green[c] = simd::select<Number>(is_active, b[c], lanes.left_cauchy_green[c]);
                  stress[c]                  = simd::select<Number>(is_active, now[c], stress[c]);
                }
            }
          is_separated = (is_active & response.is_separated) | (is_separated & !is_active);

          // Larger values than before are rarely in a batch.
          const Mask is_stiffer = is_active & (response.bulk_modulus > report.largest_bulk_modulus);
          if (simd::any(is_stiffer))
            report.largest_bulk_modulus =
                simd::largest_lane<Number>(simd::select<Number>(is_stiffer, response.bulk_modulus, zero));
          const Mask is_pressed = is_active & (state.bound_of_compression() > report.largest_compression);
          if (simd::any(is_pressed))
            report.largest_compression =
                std::max(report.largest_compression,
                         simd::largest_lane<Number>(simd::select<Number>(is_pressed, state.compression(), zero)));
        }

      const unsigned int stored = simd::bits_of(is_served) & used, left = used & ~stored;
      if (stored != 0)
        {
          write<n_components>(lanes.left_cauchy_green, indices, stored, points, points.left_cauchy_green);
          write<n_components>(stress, indices, stored, points, points.stress);
          Number work = dim == 2 ? stress[2] * (lanes.stretch - 1.) : zero;
          for (unsigned int i = 0, c = 3; i < dim; ++i)
            {
              work += stress[i] * change[i * (dim + 1)];
              for (unsigned int j = i + 1; j < dim; ++j)
                work += stress[c++] * (change[i * dim + j] + change[j * dim + i]);
            }
          energy = lanes.reference_volume * (energy - 0.5 * lanes.volume_ratio * work);
          for (unsigned int h = 0; h < simd::n_lanes<Number> / batch_size; ++h)
            if (const unsigned int all = (1u << batch_size) - 1, own = stored >> h * batch_size & all; own == all)
              energies += simd::half(energy, h);
            else
              for (unsigned int bits = own; bits != 0; bits &= bits - 1)
                energies[__builtin_ctz(bits)] += simd::half(energy, h)[__builtin_ctz(bits)];
        }
      report.n_substeps += __builtin_popcount(stored);
      if constexpr (in_parts)
        for (unsigned int bits = stored; bits != 0; bits &= bits - 1)
          report.n_substeps += static_cast<unsigned int>(simd::lane(n_parts, __builtin_ctz(bits))) - 1;
      if (const unsigned int changed = simd::bits_of(was_plastic) & stored; returns && changed != 0)
        {
          write<n_internal>(lanes.internal_variables, indices, changed, points, points.internal_variables);
          report.n_separated += count(is_served & is_separated);
          const Number lost = lanes.reference_volume * dissipation;
          for (unsigned int bits = changed; bits != 0; bits &= bits - 1)
            report.plastic_dissipation += simd::lane(lost, __builtin_ctz(bits));
        }
      return { left, left == 0 ? 0 : left & (simd::bits_of(is_cut) | (Law::leaves_returns ? 0 : used)) };
    }

    /// Why a point was left by all rounds.
    [[noreturn]] void throw_refusal(const unsigned int p, const MaterialMotion<dim> &motion) const
    {
      const dealii::Tensor<2, dim> increment = motion.deformation_increment_of(p);
      const double stretch = dim == 2 ? motion.out_of_plane_stretch[p] : 1, J = motion.volume_ratio[p];
      double largest = std::abs(stretch - 1);
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          {
            const double change = std::abs(increment[i][j] - (i == j ? 1. : 0.));
            largest             = change <= largest ? largest : change; // NaN counts
          }
      const bool can_follow =
          determinant(increment) > 0 && J > 0 && stretch > 0 && largest <= largest_number_of_parts * law.substep_strain;
      throw PointFault(
          p,
          std::string("the point ") +
              (can_follow ? "has an elastic strain that is not a number" : "cannot follow its deformation") +
              ": largest |dF - I| " + number_text(largest) + ", det dF " + number_text(determinant(increment)) +
              ", V/V_0 " + number_text(J) +
              ". Take smaller steps ('Courant number', 'Advection number' or 'Maximum time step' in "
              "subsection Time step; 'Number of steps' of an element test). If that does not help, look at "
              "the picture before: the motion is unstable there.");
    }

    static PrincipalValues strain_of(const double *left_cauchy_green)
    {
      return log_strain(PrincipalFrame<dim>(left_cauchy_green).values());
    }

    const Law law;
  };
} // namespace scree

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_materials_material_h
#define scree_materials_material_h

#include <scree/simd/batch.h>
#include <scree/tensor/components.h>

#include <deal.II/base/tensor.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace scree
{
  /// A quantity of a point, in the field's words, and its unit.
  struct Quantity
  {
    std::string name; ///< name in tables and pictures
    std::string unit; ///< "-" without
  };

  /// Where a law finds the state of points: records `stride` doubles apart, of which `slots` says which ones;
  /// each pointer is into record 0. Tensors are stored as in tensor/components.h.
  template <int dim>
  struct MaterialPoints
  {
    unsigned int n_points      = 0;       ///< number of points
    std::size_t stride         = 0;       ///< doubles from one record to the next
    double *left_cauchy_green  = nullptr; ///< Elastic b_e, n_symmetric_components<dim>
    double *stress             = nullptr; ///< Cauchy stress, Pa, tension positive, n_symmetric_components<dim>
    double *internal_variables = nullptr; ///< As named by LawProperties::internal_quantities
    const unsigned int *slots  = nullptr; ///< Records of the points; null: one behind the other

    /// From record 0 to the one of point `p`, doubles.
    std::size_t offset(const unsigned int p) const
    {
      return stride * (slots != nullptr ? slots[p] : p);
    }
  };

  /// The motion of points over a step; arrays of MaterialPoints::n_points.
  template <int dim>
  struct MaterialMotion
  {
    /// dF of the step, after F-bar, in-plane part: dim x dim arrays, row-major, `pitch` doubles apart. (Of one point:
    /// its components one behind the other.)
    const double *deformation_increment = nullptr;
    const double *out_of_plane_stretch  = nullptr; ///< dF_zz after F-bar, which scales all three axes; read if dim = 2
    const double *volume_ratio          = nullptr; ///< J = V/V_0 at the end of the step
    const double *reference_volume      = nullptr; ///< V_0, m^3 (dim = 2: per metre of depth)
    std::size_t pitch                   = 1;       ///< doubles from one component of dF to the next
    double time_step                    = std::numeric_limits<double>::infinity(); ///< s; infinite: slow
    double grain_density                = 0; ///< kg/m^3; read if friction depends on the rate

    /// dF of a point.
    dealii::Tensor<2, dim> deformation_increment_of(const unsigned int p) const
    {
      dealii::Tensor<2, dim> increment;
      for (unsigned int c = 0; c < dim * dim; ++c)
        increment[c / dim][c % dim] = deformation_increment[c * pitch + p];
      return increment;
    }
  };

  /// A point that cannot follow its motion over a step.
  struct PointFault : std::runtime_error
  {
    /// @param point its number in MaterialPoints
    /// @param what what is wrong, and what to try
    PointFault(const unsigned int point, const std::string &what)
        : std::runtime_error(what)
        , point(point)
    {
    }

    unsigned int point; ///< its number in MaterialPoints
    std::string name;   ///< body, number and place, as far as they are known
  };

  /// What came out of a step's updates. The reports of cells and ranks add up.
  struct UpdateReport
  {
    double largest_bulk_modulus = 0; ///< Tangent of the elastic law, Pa
    double largest_compression  = 0; ///< Compressive principal Kirchhoff stress, or a bound on it, Pa
    double plastic_dissipation  = 0; ///< Sum of V_0 tau : (trial - returned elastic strain), J
    double elastic_energy       = 0; ///< At the middle of the step: sum of V_0 psi - V sigma : (dF - I)/2, J
    double averaging_work       = 0; ///< See VolumeProjection::take_kept_work(), J

    // Counts; doubles hold them exactly and travel like the rest.
    double n_updates    = 0; ///< Points
    double n_substeps   = 0; ///< Return maps, at least one a point
    double n_fallbacks  = 0; ///< Newton gave up, the bracketed search found the root
    double n_vertices   = 0; ///< Returned to the vertex of the yield surface that is under stress
    double n_separated  = 0; ///< Pulled apart: no stress, the gap is kept as elastic volume strain
    double n_unresolved = 0; ///< Returned to an admissible state that is not the root; expected to stay 0

    /// Adds sums and counts of another report, and takes the larger of the largest values.
    void add(const UpdateReport &other)
    {
      largest_bulk_modulus = std::max(largest_bulk_modulus, other.largest_bulk_modulus);
      largest_compression  = std::max(largest_compression, other.largest_compression);
      plastic_dissipation += other.plastic_dissipation;
      elastic_energy += other.elastic_energy;
      averaging_work += other.averaging_work;
      n_updates += other.n_updates;
      n_substeps += other.n_substeps;
      n_fallbacks += other.n_fallbacks;
      n_vertices += other.n_vertices;
      n_separated += other.n_separated;
      n_unresolved += other.n_unresolved;
    }
  };

  /// An internal variable that is averaged over space between two steps, see NonlocalAverage.
  struct NonlocalVariable
  {
    double length         = 0; ///< m; 0: there is none
    unsigned int own      = 0; ///< number of the variable that each point has made by itself
    unsigned int averaged = 0; ///< number of the one that is set
  };

  /// An internal variable that each point has from its place at the start.
  struct PlaceVariable
  {
    std::string entry;                                         ///< name of the entry, see add_place_entry()
    std::string unit;                                          ///< of the entry
    double constant = 0;                                       ///< value of the entry everywhere, unless
    std::string of_place;                                      ///< is its text; empty: it is constant
    unsigned int number = 0;                                   ///< of the variable
    std::function<double(double)> stored;                      ///< the variable from the value; null: the same
    std::function<std::string(const double *variables)> fault; ///< of the variables of a point, and what to do; empty:
                                                               ///< the law can follow them
  };

  /// What a law says of itself, whatever the state of a point. A law sets in its constructor what differs.
  struct LawProperties
  {
    double shear_modulus    = 0;                                       ///< Pa
    double initial_porosity = 0;                                       ///< if the law fixes it (Nor-Sand: 1 - 1/v_0)
    double plane_friction   = std::numeric_limits<double>::infinity(); ///< tau/sigma on a plane that shears steadily;
                                                                       ///< infinite without yield or with cohesion
    double grain_diameter = 0;                  ///< of a friction that grows with the rate of shear, m; 0: it does not
    NonlocalVariable nonlocal_variable;         ///< what is averaged over space
    std::vector<PlaceVariable> place_variables; ///< what each point has from its place, before initialise()
    std::vector<Quantity> internal_quantities;  ///< a point's internal variables in storage order
    std::vector<Quantity> output_quantities;    ///< derived fields, in the order of Material::output()

    /// Whether the law has no plastic strain, as it has no internal variables.
    bool is_elastic() const
    {
      return internal_quantities.empty();
    }
  };


  /// A constitutive law of a point in finite strain: logarithmic elastic strain, Kirchhoff stress tau = J sigma.
  ///
  /// One virtual call serves the points of several cells. A law holds no state of points, so threads may share it.
  template <int dim>
  class Material : public LawProperties
  {
  public:
    /// Copies the properties.
    explicit Material(const LawProperties &properties)
        : LawProperties(properties)
    {
    }

    virtual ~Material() = default;

    /// Advance stress, elastic state and internal variables of the points over a step. Throws PointFault if an
    /// increment is not a number, turns a point inside out or is beyond 1000 sub-steps.
    virtual void
    update(const MaterialPoints<dim> &points, const MaterialMotion<dim> &motion, UpdateReport &report) const = 0;

    /// Tangent bulk modulus, Pa, at the mean compressive stress `pressure`, Pa.
    virtual double initial_bulk_modulus(const double pressure) const = 0;

    /// Modulus of waves for a bulk modulus, both in Pa.
    double wave_modulus(const double bulk_modulus) const
    {
      return bulk_modulus + 4. / 3. * shear_modulus;
    }

    /// Speed c of pressure waves in space, m/s; 0 where there is no stiffness. With the stretch lambda along an axis
    /// and tau = M ln(lambda), c^2 = lambda^2/rho_0 d(tau/lambda)/d(lambda) = (M - tau)/rho_0: compression makes it
    /// faster.
    /// @param bulk_modulus Pa
    /// @param compression largest compressive principal Kirchhoff stress, Pa
    /// @param density at J = 1, kg/m^3
    double wave_speed(const double bulk_modulus, const double compression, const double density) const
    {
      return std::sqrt((wave_modulus(bulk_modulus) + compression) / density);
    }

    /// Stored energy, J per m^3 of reference volume, of the state `left_cauchy_green`.
    virtual double elastic_energy(const double *left_cauchy_green) const = 0;

    /// The same of as many states as a batch has lanes, from their components.
    virtual Batch elastic_energies(const Batch *left_cauchy_green) const = 0;

    /// State of one point that has the Cauchy stress `wanted_stress` (Pa, components) at J = 1: fills
    /// `left_cauchy_green`, `stress` and `internal_variables`, of which those of place_variables are set before.
    /// `stress` may be `wanted_stress`, and equals it but where the law holds it for separated (no stress). Throws
    /// dealii::ExcMessage if the law cannot carry the stress.
    virtual void initialise(const double *wanted_stress,
                            double *left_cauchy_green,
                            double *stress,
                            double *internal_variables) const = 0;

    /// Derived fields of one point at J = `volume_ratio`; `values` has the size of output_quantities.
    virtual void output(const double *left_cauchy_green,
                        const double *internal_variables,
                        const double volume_ratio,
                        double *values) const = 0;
  };
} // namespace scree

#endif

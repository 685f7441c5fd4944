// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_material_mohr_coulomb_opening_h
#define scree_material_mohr_coulomb_opening_h

#include <scree/material/material.h>
#include <scree/material/mohr_coulomb_return.h>
#include <scree/material/table.h>

#include <memory>

namespace scree
{
  /// Mohr-Coulomb with cohesion whose openings at the tension cut-off close before the soil bears again.
  ///
  /// The return to a face of the cut-off turns the opening into plastic strain. In pores full of water that is a
  /// ratchet: each stretching wave leaves volume, and the soil stays pressed against the sucking water. The opening is
  /// a state of its own here: part of the trial strain of the next step, along its largest principal strain, and what
  /// the return to the cut-off takes from the volume strain. At the vertex the strain itself keeps the gap.
  class MohrCoulombWithOpening : public MohrCoulomb
  {
  public:
    static constexpr unsigned int n_internal_variables = 2; // plastic shear strain, opening

    explicit MohrCoulombWithOpening(const MohrCoulombParameters &parameters);

    /// See MohrCoulomb; the second internal variable is the opening, a volume strain.
    template <typename Number>
    PrincipalResponse<Number>
    respond(PrincipalNumbers<Number> &strain, Number *internal_variables, PrincipalNumbers<Number> &stress) const;

    Response return_map(PrincipalValues &strain,
                        double *internal_variables,
                        const double volume_ratio,
                        PrincipalValues &stress,
                        UpdateReport &report) const;

    void initialise(const PrincipalValues &wanted_stress,
                    PrincipalValues &strain,
                    PrincipalValues &stress,
                    double *internal_variables) const;

    static std::vector<Quantity> internal_quantities();

  private:
    const double cut_off; // Pa, less what a return may err by
  };


  /// The law that `parameters` name for soil in water: Mohr-Coulomb with cohesion keeps its openings.
  template <int dim>
  std::unique_ptr<Material<dim>> make_material_in_water(const MaterialParameters &parameters);


  template <typename Number>
  DEAL_II_ALWAYS_INLINE inline PrincipalResponse<Number> MohrCoulombWithOpening::respond(
      PrincipalNumbers<Number> &strain, Number *internal_variables, PrincipalNumbers<Number> &stress) const
  {
    const Number none = simd::broadcast<Number>(0.), before = internal_variables[1];
    const Number largest = simd::max<Number>(strain[0], simd::max<Number>(strain[1], strain[2]));
    Number left          = before;
    for (Number &value : strain)
      {
        const simd::Mask<Number> is_here = value >= largest;
        value += simd::select<Number>(is_here, left, none);
        left = simd::select<Number>(is_here, none, left);
      }
    const Number volume                = strain[0] + strain[1] + strain[2];
    PrincipalResponse<Number> response = MohrCoulomb::respond<Number>(strain, internal_variables, stress);
    // Dilation of a return to the shear faces alone is no opening.
    const simd::Mask<Number> is_open = response.is_plastic & (simd::max<Number>(stress[0], simd::max<Number>(stress[1], stress[2])) >= cut_off);
    const Number opening             = simd::max<Number>(none, volume - (strain[0] + strain[1] + strain[2]));
    internal_variables[1]            = simd::select<Number>(is_open, opening, none);
    response.is_plastic              = response.is_plastic | (before > 0.); // The state changes.
    return response;
  }
} // namespace scree

#endif

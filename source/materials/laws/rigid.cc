// SPDX-License-Identifier: LGPL-2.1-or-later

#include <scree/materials/law_entries.h>
#include <scree/materials/laws/rigid.h>

#include <algorithm>
#include <limits>

using namespace dealii;

namespace scree
{
  namespace
  {
    class RigidEntries : public LawEntries
    {
    public:
      std::unique_ptr<LawEntries> clone() const override
      {
        return std::make_unique<RigidEntries>();
      }
      void add_parameters(ParameterHandler &) override
      {
      }
      void check(const std::string &) const override
      {
      }
      LawEntry modulus() const override
      {
        return { "Material", 0. };
      }
      std::unique_ptr<Material<2>> make_2d() const override
      {
        return std::make_unique<Rigid<2>>();
      }
      std::unique_ptr<Material<3>> make_3d() const override
      {
        return std::make_unique<Rigid<3>>();
      }
    };

    const RegisterLaw registered_rigid("rigid", "", std::make_unique<RigidEntries>());
  } // namespace


  template <int dim>
  void Rigid<dim>::update(const MaterialPoints<dim> &, const MaterialMotion<dim> &, UpdateReport &) const
  {
    Assert(false, ExcMessage("Rigid soil does not move."));
  }


  template <int dim>
  double Rigid<dim>::shear_modulus() const
  {
    return 0.;
  }


  template <int dim>
  double Rigid<dim>::initial_bulk_modulus(const double) const
  {
    return 0.;
  }


  template <int dim>
  double Rigid<dim>::elastic_energy(const double *) const
  {
    return 0.;
  }


  template <int dim>
  Batch Rigid<dim>::elastic_energies(const Batch *) const
  {
    return simd::broadcast<Batch>(0.);
  }


  template <int dim>
  void Rigid<dim>::initialise(const double *, double *left_cauchy_green, double *stress, double *) const
  {
    std::fill_n(left_cauchy_green, n_symmetric_components<dim>, 0.);
    std::fill_n(left_cauchy_green, 3, 1.); // the diagonal comes first
    std::fill_n(stress, n_symmetric_components<dim>, 0.);
  }


  template <int dim>
  double Rigid<dim>::initial_porosity() const
  {
    return 0.;
  }


  template <int dim>
  bool Rigid<dim>::is_elastic() const
  {
    return true;
  }


  template <int dim>
  std::vector<Quantity> Rigid<dim>::internal_quantities() const
  {
    return {};
  }


  template <int dim>
  std::vector<Quantity> Rigid<dim>::output_quantities() const
  {
    return {};
  }


  template <int dim>
  void Rigid<dim>::output(const double *, const double *, const double *, const double, double *) const
  {
  }

  template class Rigid<2>;
  template class Rigid<3>;
} // namespace scree

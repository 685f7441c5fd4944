// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/postprocess/point_sums.h>

#include <scree/postprocess/cell_contents.h>
#include <scree/tensor/invariants.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <limits>

namespace scree
{
  using namespace dealii;

  /// Elastic energies of points, as many at a time as a batch has lanes.
  template <int dim>
  class PointSums<dim>::Energies
  {
  public:
    explicit Energies(const Material<dim> &material)
        : material(material)
    {
      for (unsigned int c = 0; c < n_components; ++c)
        states[c] = simd::broadcast<Batch>(c < 3 ? 1. : 0.);
    }

    /// A point of this volume at the start, m^3 (2D: per m); adds to the `sum`, J, if the batch is full.
    void add(const double volume, const double *left_cauchy_green, double &sum)
    {
      for (unsigned int c = 0; c < n_components; ++c)
        simd::set_lane(states[c], n, left_cauchy_green[c]);
      volumes[n] = volume;
      if (++n == batch_size)
        finish(sum);
    }

    /// Adds what is left.
    void finish(double &sum)
    {
      const Batch energies = material.elastic_energies(states);
      for (unsigned int lane = 0; lane < n; ++lane)
        sum += volumes[lane] * energies[lane];
      n = 0;
    }

  private:
    static constexpr unsigned int n_components = n_symmetric_components<dim>;

    const Material<dim> &material;
    Batch states[n_components];
    double volumes[batch_size];
    unsigned int n = 0;
  };


  template <int dim>
  PointSums<dim>::PointSums(const std::list<SoilBody<dim>> &bodies,
                            const std::list<WaterPhase<dim>> &water,
                            const Tensor<1, dim> &gravity,
                            const MPI_Comm communicator)
      : height(std::numeric_limits<double>::lowest())
  {
    for (const auto &body : bodies)
      {
        Energies energies(*body.material);
        for_each_point(body.points, [&](const auto &point) {
          add(body, point.location, point.properties, gravity);
          energies.add(point.properties[body.layout.mass] / body.density,
                       point.properties + body.layout.left_cauchy_green,
                       elastic);
        });
        energies.finish(elastic);
      }
    for (const auto &one : water)
      for_each_point(one.points(), [&](const auto &point) {
        add_motion(one.layout, one.affine_inertia, point.properties, point.location, gravity);
      });

    std::vector<double> sums{ soil_points, soil_mass, kinetic, potential, elastic, pressure };
    for (unsigned int a = 0; a < dim; ++a)
      sums.push_back(momentum[a]);
    Utilities::MPI::sum(sums, communicator, sums);
    soil_points = sums[0], soil_mass = sums[1], kinetic = sums[2], potential = sums[3], elastic = sums[4];
    pressure = sums[5];
    for (unsigned int a = 0; a < dim; ++a)
      momentum[a] = sums[6 + a];

    std::vector<double> largest{ largest_pressure, height, largest_porosity };
    Utilities::MPI::max(largest, communicator, largest);
    largest_pressure = largest[0], height = largest[1], largest_porosity = largest[2];
  }


  template <int dim>
  void PointSums<dim>::add(const SoilBody<dim> &body,
                           const Point<dim> &x,
                           const double *properties,
                           const Tensor<1, dim> &gravity)
  {
    const double mass = properties[body.layout.mass];
    const double P    = mean_effective_stress(properties + body.layout.stress);
    soil_points += 1;
    soil_mass += mass;
    add_motion(body.layout, body.affine_inertia, properties, x, gravity);
    pressure += P;
    largest_pressure = std::max(largest_pressure, P);
    height           = std::max(height, x[dim - 1]);
    largest_porosity = std::max(largest_porosity, body.porosity(properties));
  }


  template <int dim>
  template <typename Layout>
  void PointSums<dim>::add_motion(const Layout &layout,
                                  const double affine_inertia,
                                  const double *properties,
                                  const Point<dim> &x,
                                  const Tensor<1, dim> &gravity)
  {
    const double mass         = properties[layout.mass];
    const double *velocity    = properties + layout.velocity;
    double square_of_velocity = 0.;
    for (unsigned int a = 0; a < dim; ++a)
      {
        momentum[a] += mass * velocity[a];
        square_of_velocity += velocity[a] * velocity[a];
      }
    if (affine_inertia > 0.)
      for (unsigned int c = 0; c < dim * dim; ++c)
        square_of_velocity += affine_inertia * properties[layout.affine + c] * properties[layout.affine + c];
    kinetic += 0.5 * mass * square_of_velocity;
    potential -= mass * (gravity * (x - Point<dim>()));
  }

  template struct PointSums<2>;
  template struct PointSums<3>;
} // namespace scree

// SPDX-License-Identifier: LGPL-2.1-or-later

// Impulses of soil that slides or lifts off, of soil that sticks, and of water at oblique ground: each contact obeys
// its law with the motion that all of them leave; the same on 1 and 2 ranks, and from wherever the search begins.

#include "../expect.h"
#include "../scattered_mixture.h"

#include <scree/contact/cut_cells/contact_solver.h>

#include <deal.II/base/mpi.h>

#include <array>
#include <iomanip>
#include <iostream>
#include <limits>

#include "../unit_test.h"

namespace test_ground_contacts
{
using namespace dealii;
using namespace scree;

constexpr double tolerance = 1e-9; // of the flow


/// The contacts of all segments: a third of the soil sticks, the rest rubs or slips, as little water as may leave.
template <int dim>
void add_contacts(const ScatteredMixture<dim> &mixture, const double first, ContactSolver<dim> &contacts)
{
  const auto &segments = mixture.cut_cells.segments();
  for (unsigned int s = 0; s < segments.size(); ++s)
    for (const Phase phase : { Phase::soil, Phase::water })
      {
        const Point<dim> x = mixture.place_of(segments[s]);
        const double kind  = number_at(x, 40 + unsigned(phase));
        GroundContact<dim> contact{};
        contact.segment       = s;
        contact.phase         = phase;
        contact.is_unilateral = phase == Phase::soil ? kind > 0.3 : kind > 0.8;
        if (phase == Phase::soil)
          contact.friction = kind > 0.9 ? 0. : kind > 0.3 ? 0.2 : std::numeric_limits<double>::infinity();
        contact.area    = segments[s].area;
        contact.normal  = segments[s].normal;
        contact.speed   = vector_at(x, 50 + 3 * unsigned(phase)) + 0.3 * contact.normal;
        contact.impulse = contact.part(contact.holds(), first * vector_at(x, 60 + 3 * unsigned(phase)));
        contacts.add(contact);
      }
}


template <int dim>
void test(const std::string &ground_expression, std::ostream &out)
{
  ScatteredMixture<dim> mixture(ground_expression);
  ContactSolver<dim> contacts(mixture.grid, mixture.cut_cells);
  DelassusOperator<dim> response(mixture.grid, mixture.cut_cells);
  std::array<double, 2> products;
  for (const double first : { 0., 0.2 })
    {
      contacts.begin_step();
      response.begin_step();
      add_contacts(mixture, first, contacts);
      const double flow = contacts.flow();
      contacts.find(mixture.nodes, mixture.step, tolerance * flow);

      std::vector<Tensor<1, dim>> impulses, velocities;
      for (const GroundContact<dim> &contact : contacts.contacts())
        {
          response.add(contact.segment, contact.phase);
          impulses.push_back(contact.impulse);
        }
      response.start(mixture.nodes, mixture.step);
      response.apply(impulses, velocities);
      std::array<double, 4> numbers{}; // that stick, slide, lift off; product of impulses and speeds
      double law = 0., friction = 0.;
      for (unsigned int k = 0; k < impulses.size(); ++k)
        {
          const GroundContact<dim> &contact = contacts.contacts()[k];
          const double mobility             = response.mobility_at(k);
          if (mobility == 0.)
            continue;
          const Tensor<1, dim> left  = contact.speed - velocities[k],
                               along = left - (left * contact.normal) * contact.normal;
          const double pressing      = contact.impulse * contact.normal;
          numbers[3] += contact.impulse * contact.speed;
          if (contact.is_unilateral && pressing <= 0.)
            {
              ++numbers[2];
              law = std::max({ law, contact.impulse.norm() * mobility, left * contact.normal });
              continue;
            }
          law = std::max(law, std::abs(left * contact.normal));
          if (contact.friction == 0.)
            continue;
          const Tensor<1, dim> rubbing = contact.impulse - pressing * contact.normal;
          if (std::isinf(contact.friction) || rubbing.norm() < (1. - 1e-6) * contact.friction * pressing)
            {
              ++numbers[0];
              law = std::max(law, along.norm());
              continue;
            }
          ++numbers[1];
          // Friction is against what is left of the motion, and no larger than it may be.
          friction = std::max(friction, rubbing.norm() - contact.friction * pressing);
          law      = std::max(law, (along - (along * rubbing / rubbing.norm_square()) * rubbing).norm());
          law      = std::max(law, -(along * rubbing) / rubbing.norm());
        }
      for (double &number : numbers)
        number = Utilities::MPI::sum(number, MPI_COMM_WORLD);
      expect(Utilities::MPI::max(law, MPI_COMM_WORLD), 0., 100. * tolerance * flow, "motion against the law");
      expect(Utilities::MPI::max(friction, MPI_COMM_WORLD), 0., 1e-12, "friction beyond what is available");
      products[first > 0.] = numbers[3];
      out << dim << "D: " << numbers[0] << " contacts stick, " << numbers[1] << " slide, " << numbers[2]
          << " lift off; impulses times speeds " << std::setprecision(7) << numbers[3] << std::endl;
    }
  expect(products[1], products[0], 1e-6 * products[0], "impulses times speeds from another beginning");
}


void run()
{
  std::ostream silent(nullptr);
  std::ostream &out = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0 ? std::cout : silent;
  test<2>("0.8*y - 0.6*x - 0.05", out);
  test<3>("0.7*z - 0.6*x - 0.38*y - 0.05", out);
}

const UnitTest registered("ground_contacts", run);
} // namespace test_ground_contacts

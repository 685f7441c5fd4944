// SPDX-License-Identifier: LGPL-2.1-or-later
// Two masses in contact at a node: what is pulled apart is let go, nothing approaches faster than the gap allows,
// friction obeys Coulomb's law and only slows down; momentum is kept, energy is not made; limits are right.
#include "../test.h"

#include <scree/contact/node_contact.h>

namespace test_node_contact
{
template <int dim>
void random_pairs()
{
  RandomNumbers random;
  unsigned int n_apart = 0, n_stuck = 0, n_sliding = 0;
  const auto random_vector = [&]() -> Tensor<1, dim> { return random.point<dim>(-1., 1.); };
  for (unsigned int trial = 0; trial < 10000; ++trial)
    {
      // Every tenth time the first one cannot be moved.
      const MovingMass<dim> first{ trial % 10 == 0 ? 0. : random.log_uniform(1e-6, 1e6), random_vector() };
      const MovingMass<dim> second{ random.log_uniform(1e-6, 1e6), random_vector() };
      Tensor<1, dim> normal = random_vector();
      normal /= normal.norm();
      const double approach = trial % 3 == 0 ? random.uniform(0., 1.) : 0.;
      const double friction = trial % 7 == 0 ? 0. : random.uniform(0., 4.);

      const Tensor<1, dim> impulse = contact_impulse(first, second, normal, approach, friction);
      const Tensor<1, dim> before  = second.velocity - first.velocity,
                           change = (first.inverse_mass + second.inverse_mass) * impulse, after = before + change;
      if (before * normal >= -approach)
        {
          ++n_apart;
          expect(impulse.norm(), 0., 0., "impulse of what moves apart");
          continue;
        }
      const double pressing        = change * normal;
      const Tensor<1, dim> rubbing = change - pressing * normal;
      const Tensor<1, dim> along   = after - (after * normal) * normal;
      const bool sticks            = along.norm() < 1e-12;
      (sticks ? n_stuck : n_sliding) += 1;
      expect(after * normal, -approach, 1e-12, "approach");
      require(rubbing.norm() - friction * pressing <= 1e-12, "friction beyond the cone");
      if (!sticks) // All of the friction there is, against what is left of the motion.
        expect((rubbing + friction * pressing * along / along.norm()).norm(), 0., 1e-12, "friction along the motion");
      require(impulse * (before + after) <= 0., "energy is made");
    }
  require(n_apart > 1000 && n_stuck > 1000 && n_sliding > 1000, "some apart, stuck and sliding");
}


const UnitTest registered("node_contact", [] {
  random_pairs<2>();
  random_pairs<3>();

  const Tensor<1, 2> up({ 0., 1. });
  expect(
      contact_impulse<2>({ 0., {} }, { 0., -2. * up }, up, 0., 2.).norm(), 0., 0., "impulse on two that nothing moves");
});
} // namespace test_node_contact

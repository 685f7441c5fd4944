// SPDX-License-Identifier: LGPL-2.1-or-later
// Two masses in contact at a node: what is pulled apart is let go, nothing approaches faster than the gap allows,
// friction obeys Coulomb's law and only slows down; momentum is kept, energy is not made; limits are right.
#include <scree/contact/node_contact.h>

#include <cmath>
#include <iostream>

#include "../random_numbers.h"

#include "../unit_test.h"

namespace test_node_contact
{
using namespace dealii;
using namespace scree;

template <int dim>
void random_pairs()
{
  RandomNumbers random;
  double let_go = 0, approach_error = 0, cone = 0, along_error = 0, gained = 0;
  unsigned int n_apart = 0, n_stuck = 0, n_sliding = 0;
  const auto random_vector = [&] {
    Tensor<1, dim> v;
    for (unsigned int a = 0; a < dim; ++a)
      v[a] = random.uniform(-1., 1.);
    return v;
  };
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
          let_go = std::max(let_go, impulse.norm());
          continue;
        }
      const double pressing        = change * normal;
      const Tensor<1, dim> rubbing = change - pressing * normal;
      const Tensor<1, dim> along   = after - (after * normal) * normal;
      const bool sticks            = along.norm() < 1e-12;
      (sticks ? n_stuck : n_sliding) += 1;
      approach_error = std::max(approach_error, std::abs(after * normal + approach));
      cone           = std::max(cone, rubbing.norm() - friction * pressing);
      if (!sticks) // All of the friction there is, against what is left of the motion.
        along_error = std::max(along_error, (rubbing + friction * pressing * along / along.norm()).norm());
      gained = std::max(gained, impulse * (before + after));
    }
  std::cout << dim << "D, 10000 random pairs: some apart, stuck and sliding: "
            << (n_apart > 1000 && n_stuck > 1000 && n_sliding > 1000 ? "yes" : "NO")
            << ", let go: " << (let_go == 0. ? "yes" : "NO")
            << ", approach as allowed: " << (approach_error < 1e-12 ? "yes" : "NO")
            << ", within the cone: " << (cone < 1e-12 ? "yes" : "NO")
            << ", against the motion: " << (along_error < 1e-12 ? "yes" : "NO")
            << ", no energy made: " << (gained <= 0. ? "yes" : "NO") << std::endl;
}

void run()
{
  random_pairs<2>();
  random_pairs<3>();

  const Tensor<1, 2> up({ 0., 1. }), right({ 1., 0. });
  const MovingMass<2> ground{ 0., {} }, block{ 0.5, 3. * right - 2. * up };
  Tensor<1, 2> impulse = contact_impulse(ground, block, up, 0., 0.);
  std::cout << "smooth ground: " << impulse << std::endl;
  impulse = contact_impulse(ground, block, up, 0., 0.5);
  std::cout << "friction of 0.5: " << impulse << std::endl;
  impulse = contact_impulse(ground, block, up, 0., 2.);
  std::cout << "friction of 2: " << impulse << std::endl;
  impulse = contact_impulse(ground, block, up, 1.5, 2.);
  std::cout << "the same with a gap: " << impulse << std::endl;
  impulse = contact_impulse({ 1., right }, { 1., -1. * right }, right, 0., 0.3);
  std::cout << "head on: " << impulse << std::endl;
  impulse = contact_impulse(ground, { 0., block.velocity }, up, 0., 2.);
  std::cout << "two that nothing moves: " << impulse << std::endl;
}

const UnitTest registered("node_contact", run);
} // namespace test_node_contact

// SPDX-License-Identifier: LGPL-2.1-or-later
// A body force of one file: registered here, its entries are declared with the others, and it acts on the nodes.
#include "../test.h"

#include <scree/boundary/body_forces.h>

namespace test_registered_body_force
{
/// A centrifuge that turns about the origin: rate^2 x.
template <int dim>
class Centrifuge : public BodyForce<dim>
{
public:
  explicit Centrifuge(const double rate)
      : rate(rate)
  {
  }
  void set_step(const double, const double) override
  {
    now = rate;
  }
  void set_start() override
  {
    now = 0.;
  }
  bool is_uniform() const override
  {
    return false;
  }
  Tensor<1, dim> at(const Point<dim> &x) const override
  {
    return now * now * x;
  }

private:
  const double rate; // 1/s
  double now = 0.;
};

class CentrifugeEntries : public BodyForceEntries
{
public:
  void add_parameters(ParameterHandler &prm) override
  {
    prm.enter_subsection("Centrifuge");
    prm.add_parameter("Rate", rate, "Rate at which the box turns about the origin, 1/s.", Patterns::Double(0));
    prm.leave_subsection();
  }
  bool is_set() const override
  {
    return rate > 0.;
  }
  std::unique_ptr<BodyForce<2>> make_2d() const override
  {
    return std::make_unique<Centrifuge<2>>(rate);
  }
  std::unique_ptr<BodyForce<3>> make_3d() const override
  {
    return std::make_unique<Centrifuge<3>>(rate);
  }

private:
  double rate = 0.;
};

const RegisterBodyForce<CentrifugeEntries> registered("Centrifuge");


void run()
{
  const BackgroundGrid<2> grid(grid_box<2>(0., 0.4), MPI_COMM_WORLD);
  BodyForceParameters parameters;
  ParameterHandler prm;
  parameters.add_parameters(prm);
  require(!parameters.is_set(), "No body force is set.");
  prm.parse_input_from_string("set Body force = x; t\nsubsection Centrifuge\n set Rate = 3\nend");
  parameters.check(2);
  require(parameters.is_set(), "Two body forces are set.");
  BodyForces<2> forces(grid, { 0., -10. }, parameters);
  for (const bool is_released : { false, true })
    {
      is_released ? forces.set_step(2., 0.1) : forces.set_start();
      for (unsigned int node = 0; node < grid.n_owned_nodes(); ++node)
        {
          const Point<2> x            = grid.node_position(node);
          const Tensor<1, 2> expected = is_released ? Point<2>(10. * x[0], 9. * x[1] - 8.) : Point<2>(x[0], -10.);
          expect((forces.acceleration(node) - expected).norm(), 0., 1e-13, "error of the acceleration");
        }
    }
}

const UnitTest registered_test("registered_body_force", run);
} // namespace test_registered_body_force

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/boundary/body_forces.h>
#include <scree/input/expression.h>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// An acceleration by expressions, for verification.
    template <int dim>
    class ExpressionForce : public BodyForce<dim>
    {
    public:
      explicit ExpressionForce(const std::string &text)
          : function(parse_expression<dim>(entry_name("", "Body force"), text, dim, true))
      {
      }

      /// The acceleration of a step is that of its start.
      void set_step(const double time, const double) override
      {
        function->set_time(time);
      }
      void set_start() override
      {
        function->set_time(0.);
      }
      bool is_uniform() const override
      {
        return false;
      }
      Tensor<1, dim> at(const Point<dim> &x) const override
      {
        Tensor<1, dim> value;
        for (unsigned int c = 0; c < dim; ++c)
          value[c] = function->value(x, c);
        return value;
      }

    private:
      const std::unique_ptr<Expression<dim>> function;
    };


    class ExpressionForceEntries : public BodyForceText<ExpressionForce>
    {
    public:
      void add_parameters(ParameterHandler &prm) override
      {
        prm.add_parameter(
            "Body force",
            text,
            "m/s^2; acceleration in addition to gravity, for verification. One expression of x, y (z) and t "
            "per axis, separated by semicolons; empty: none.");
      }
    };

    const RegisterBodyForce<ExpressionForceEntries> registered_expression("Body force");
  } // namespace
} // namespace scree

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/boundary/body_forces.h>
#include <scree/input/case_entries.h>
#include <scree/input/expression.h>
#include <scree/input/number_table.h>

#include <deal.II/base/array_view.h>

#include <map>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// Made at the first call, whichever source file registers first.
    auto &kinds_of_body_force()
    {
      static std::map<std::string, std::unique_ptr<BodyForceEntries> (*)()> all;
      return all;
    }
  } // namespace


  void register_body_force(const std::string &name, std::unique_ptr<BodyForceEntries> (*make)())
  {
    kinds_of_body_force()[name] = make;
  }


  BodyForceParameters::BodyForceParameters()
  {
    for (const auto &[name, make] : kinds_of_body_force())
      kinds.push_back(make());
  }


  namespace
  {
    /// The motion of the box with all its walls. What is in it is described relative to the box, in whose frame the
    /// negative acceleration acts on all masses.
    template <int dim>
    class BaseMotion : public BodyForce<dim>
    {
    public:
      /// Reads the record; throws EntryError if that fails.
      BaseMotion(const std::string &record)
      {
        std::vector<std::string> columns{ "time (s)", "acceleration along x", "along y", "along z" };
        columns.resize(1 + dim);
        for (const auto &numbers : read_number_table(record, entry_name("Base motion", "Acceleration record"), columns))
          acceleration.add(numbers[0], Tensor<1, dim>(make_array_view(numbers.begin() + 1, numbers.end())));
      }

      /// The box's velocity, the integral of the record, linear between its rows, is met in each step, however long.
      void set_step(const double time, const double time_step) override
      {
        mean = (acceleration.integral(time + time_step) - acceleration.integral(time)) / time_step;
      }
      void set_start() override
      {
        mean = Tensor<1, dim>();
      }
      bool is_uniform() const override
      {
        return true;
      }
      Tensor<1, dim> at(const Point<dim> &) const override
      {
        return -mean;
      }
      std::string text() const override
      {
        const auto &rows = acceleration.rows();
        double largest   = 0;
        for (const auto &row : rows)
          largest = std::max(largest, row.value.norm());
        return "Base motion: " + std::to_string(rows.size()) + " rows from " + number_text(rows.front().time) + " to " +
               number_text(rows.back().time) + " s, at most " + number_text(largest) +
               " m/s^2; the base's velocity after it is " + number_text(rows.back().integral.norm()) + " m/s";
      }

    private:
      TimeRecord<Tensor<1, dim>> acceleration; // m/s^2
      Tensor<1, dim> mean;                     // of the step
    };


    /// Subsection Base motion: an earthquake.
    class BaseMotionEntries : public BodyForceText<BaseMotion>
    {
    public:
      void add_parameters(ParameterHandler &prm) override
      {
        prm.enter_subsection("Base motion");
        add_file_entry(
            prm,
            "Acceleration record",
            text,
            "File of the acceleration of the box with all its walls; empty: at rest. Each line has the time (s) "
            "and one component per axis (m/s^2), separated by commas. Values are linear between lines and 0 outside "
            "the "
            "record. Results are relative to the box.");
        prm.leave_subsection();
      }
    };

    const RegisterBodyForce<BaseMotionEntries> registered_base_motion("Base motion");


    /// An acceleration by expressions, for verification.
    template <int dim>
    class ExpressionForce : public BodyForce<dim>
    {
    public:
      explicit ExpressionForce(const std::string &text)
          : function(parse_expression<dim>(entry_name("", "Body force"), text, dim, "t"))
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

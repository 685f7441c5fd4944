// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/postprocess/visualization/graphics.h>
#include <scree/postprocess/visualization/patch_output.h>
#include <scree/tensor/invariants.h>
#include <scree/tensor/vector.h>

#include <algorithm>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// A new point of the output; put() fills its rows one after the other.
    template <int dim>
    class Rows
    {
    public:
      Rows(PatchOutput<0, dim> &output, const Point<dim> &location)
          : values(output.values)
          , begin(values.size())
      {
        output.points.push_back(location);
        values.resize(begin + output.names.size());
      }

      void put(const double value)
      {
        values[begin + row++] = value;
      }
      void put(const Tensor<1, dim> &vector)
      {
        for (unsigned int a = 0; a < dim; ++a)
          put(vector[a]);
      }
      void set(const unsigned int any_row, const double value)
      {
        values[begin + any_row] = value;
      }

    private:
      std::vector<float> &values;
      const std::size_t begin;
      unsigned int row = 0;
    };

    template <int dim>
    void put_state(Rows<dim> &rows, const SoilBody<dim> &body, const double *properties, const unsigned int number)
    {
      const double *stress = properties + body.layout.stress;
      rows.put(vector_of<dim>(properties + body.layout.velocity));
      // plane strain: no out-of-plane shear
      const double xy = stress[3], xz = dim == 3 ? stress[dim + 1] : 0., yz = dim == 3 ? stress[dim + 2] : 0.;
      for (const double value : { stress[0], xy, xz, xy, stress[1], yz, xz, yz, stress[2] })
        rows.put(value);
      rows.put(mean_effective_stress(stress));
      rows.put(deviatoric_stress<dim>(stress));
      rows.put(stress_ratio<dim>(stress));
      rows.put(properties[body.layout.mass]);
      rows.put(properties[body.layout.volume]);
      rows.put(number);
    }

    /// The law's internal variables and derived fields of all bodies: each name has one row, whichever body's it is.
    template <int dim>
    class LawFields
    {
    public:
      LawFields(const std::list<SoilBody<dim>> &bodies, PatchOutput<0, dim> &output)
          : names(output.names)
          , first_row(names.size())
      {
        for (const auto &body : bodies)
          for (const auto &fields : { body.material->internal_quantities(), body.material->output_quantities() })
            for (const Quantity &field : fields)
              if (std::find(names.begin() + first_row, names.end(), label_of(field)) == names.end())
                output.add({ field.name, field.unit });
      }

      /// Prepares put() for the points of a body.
      void begin(const SoilBody<dim> &body)
      {
        internal = rows_of(body.material->internal_quantities());
        derived  = rows_of(body.material->output_quantities());
        values.resize(derived.size());
      }

      void put(Rows<dim> &rows, const SoilBody<dim> &body, const double *properties)
      {
        const double *internals = properties + body.layout.internal_variables;
        body.material->output(properties + body.layout.left_cauchy_green,
                              properties + body.layout.stress,
                              internals,
                              properties[body.layout.volume] * body.density / properties[body.layout.mass],
                              values.data());
        for (unsigned int i = 0; i < internal.size(); ++i)
          rows.set(internal[i], internals[i]);
        for (unsigned int i = 0; i < derived.size(); ++i)
          rows.set(derived[i], values[i]);
      }

    private:
      static std::string label_of(const Quantity &quantity)
      {
        return OutputField{ quantity.name, quantity.unit }.label();
      }

      std::vector<unsigned int> rows_of(const std::vector<Quantity> &fields) const
      {
        std::vector<unsigned int> rows;
        for (const Quantity &field : fields)
          rows.push_back(std::find(names.begin() + first_row, names.end(), label_of(field)) - names.begin());
        return rows;
      }

      const std::vector<std::string> &names;
      const unsigned int first_row;
      std::vector<unsigned int> internal, derived; // rows
      std::vector<double> values;
    };
  } // namespace


  template <int dim>
  void Graphics<dim>::add_points(const std::list<SoilBody<dim>> &bodies,
                                 const NodalField<dim> &field,
                                 const double time,
                                 const WaterView<dim> *view,
                                 Files &files)
  {
    const auto picture          = std::make_shared<PatchOutput<0, dim>>();
    PatchOutput<0, dim> &output = *picture;
    for (const OutputField &field : { fields::velocity,
                                      fields::stress,
                                      fields::mean_effective_stress,
                                      fields::deviatoric_stress,
                                      fields::stress_ratio,
                                      fields::mass,
                                      fields::volume,
                                      fields::body })
      output.add(field);
    if (view)
      for (const OutputField &field : { fields::porosity, fields::pore_pressure, fields::seepage_velocity })
        output.add(field);
    output.add(fields::id);
    const bool with_displacement = bodies.front().layout.has_start; // all bodies have it, or none
    if (with_displacement)
      output.add(fields::displacement);
    LawFields<dim> law_fields(bodies, output);

    unsigned int number = 0;
    for (const auto &body : bodies)
      {
        law_fields.begin(body);
        for (unsigned int c = 0; c < body.points.cells().size(); ++c)
          {
            const auto &cell = body.points.cells()[c];
            const auto ids   = body.points.ids(c);
            auto id          = ids.begin();
            std::array<double, (1 << dim)> pressure;
            if (view)
              pressure = view->pressure_of_cell(cell.cell);
            for_each_point(cell, [&](const auto &point) {
              const double *properties = point.properties;
              Rows<dim> rows(output, point.location);
              put_state(rows, body, properties, number);
              if (view)
                {
                  const Point<dim> &x = point.reference_location;
                  const double n      = body.porosity(properties);
                  rows.put(n);
                  rows.put(pressure_at<dim>(x, pressure));
                  rows.put(n * relative_velocity_at(x, grid, cell.cell, field, view->field));
                }
              rows.put(static_cast<double>(*id++));
              if (with_displacement)
                rows.put(point.location - Point<dim>(vector_of<dim>(properties + body.layout.start)));
              law_fields.put(rows, body, properties);
            });
          }
        ++number;
      }
    add("points", point_files, time, picture, files);
  }


  template <int dim>
  void Graphics<dim>::add_water(const NodalField<dim> &soil_field,
                                const double time,
                                const WaterView<dim> &view,
                                const Cells &contents,
                                Files &files)
  {
    const auto picture          = std::make_shared<PatchOutput<0, dim>>();
    PatchOutput<0, dim> &output = *picture;
    for (const OutputField &field : { fields::velocity,
                                      fields::pressure,
                                      fields::mass,
                                      fields::volume,
                                      fields::porosity,
                                      fields::inside_soil,
                                      fields::seepage_velocity })
      output.add(field);

    for (const auto &water : view.water)
      for (const auto &cell : water.points().cells())
        {
          const bool inside_soil = contents[cell.cell].n_soil_points > 0;
          const double n         = contents[cell.cell].porosity();
          for_each_point(cell, [&](const auto &point) {
            const double *properties = point.properties;
            Rows<dim> rows(output, point.location);
            rows.put(vector_of<dim>(properties + water.layout.velocity));
            rows.put(properties[water.layout.pressure]);
            rows.put(properties[water.layout.mass]);
            rows.put(properties[water.layout.volume]);
            rows.put(n);
            rows.put(inside_soil);
            rows.put(inside_soil
                         ? n * relative_velocity_at(point.reference_location, grid, cell.cell, soil_field, view.field)
                         : Tensor<1, dim>());
          });
        }
    add("water", water_files, time, picture, files);
  }

  template void Graphics<2>::add_points(const std::list<SoilBody<2>> &,
                                        const NodalField<2> &,
                                        const double,
                                        const WaterView<2> *,
                                        Files &);
  template void Graphics<3>::add_points(const std::list<SoilBody<3>> &,
                                        const NodalField<3> &,
                                        const double,
                                        const WaterView<3> *,
                                        Files &);
  template void
  Graphics<2>::add_water(const NodalField<2> &, const double, const WaterView<2> &, const Cells &, Files &);
  template void
  Graphics<3>::add_water(const NodalField<3> &, const double, const WaterView<3> &, const Cells &, Files &);
} // namespace scree

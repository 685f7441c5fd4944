// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_geometry_expression_surface_h
#define scree_geometry_expression_surface_h

#include <scree/geometry/level_set.h>
#include <scree/input/expression.h>

#include <memory>
#include <string>

namespace scree
{
  /// The surface on which an expression of the coordinates is 0; the open is where it is positive.
  ///
  /// It need not be a distance: the foot y of a place x on the surface is found from f(y) = 0 and x - y along grad f(y)
  /// (@source{chopp2001}). Where that fails, at an edge, the distance is f/|grad f| at x.
  template <int dim>
  class ExpressionSurface : public LevelSet<dim>
  {
  public:
    /// @param where entry_name(), for messages
    /// @param length of what the mesh resolves, m
    ExpressionSurface(const std::string &where, const std::string &expression, const double length);

    /// Both throw ValueError if the expression is no number there.
    bool is_open(const dealii::Point<dim> &x) const override;
    SurfaceView<dim> view(const dealii::Point<dim> &x, const double reach) const override;

  private:
    /// By central differences.
    dealii::Tensor<1, dim> gradient(const dealii::Point<dim> &x) const;

    std::unique_ptr<Expression<dim>> function;
    const double length;
  };
} // namespace scree

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_step_numbers_of_h
#define scree_step_numbers_of_h

#include <deal.II/base/tensor.h>

#include <vector>

namespace scree
{
  /// An archive that lists where the numbers of an object are, in the order of its serialize().
  class NumbersOf
  {
  public:
    /// @param object outlives the list
    template <class T>
    explicit NumbersOf(T &object)
    {
      object.serialize(*this, 0);
    }

    /// @{
    /// Appends a number, those of a vector or of a list, or all that an object has.
    NumbersOf &operator&(double &number)
    {
      list.push_back(&number);
      return *this;
    }
    template <int dim>
    NumbersOf &operator&(dealii::Tensor<1, dim> &vector)
    {
      for (unsigned int a = 0; a < dim; ++a)
        list.push_back(&vector[a]);
      return *this;
    }
    template <class T>
    NumbersOf &operator&(std::vector<T> &objects)
    {
      for (T &object : objects)
        *this &object;
      return *this;
    }
    template <class T>
    NumbersOf &operator&(T &object)
    {
      object.serialize(*this, 0);
      return *this;
    }
    /// @}

    std::vector<double *> list; ///< where they are
  };
} // namespace scree

#endif

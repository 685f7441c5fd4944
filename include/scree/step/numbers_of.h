// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_step_numbers_of_h
#define scree_step_numbers_of_h

#include <deal.II/base/tensor.h>

#include <vector>

namespace scree
{
  /// An archive that lists where all numbers of an object are, in the order of its serialize().
  struct NumbersOf
  {
    std::vector<double *> list; ///< valid as long as the object

    /// Lists those of an object.
    template <class T>
    explicit NumbersOf(T &object)
    {
      object.serialize(*this, 0);
    }

    /// Appends the numbers of an object.
    template <class T>
    NumbersOf &operator&(T &object)
    {
      object.serialize(*this, 0);
      return *this;
    }
    /// Appends a number.
    NumbersOf &operator&(double &number)
    {
      list.push_back(&number);
      return *this;
    }
    /// Appends the components of a vector.
    template <int dim>
    NumbersOf &operator&(dealii::Tensor<1, dim> &vector)
    {
      for (unsigned int a = 0; a < dim; ++a)
        list.push_back(&vector[a]);
      return *this;
    }
    /// Appends what is in a list.
    template <class T>
    NumbersOf &operator&(std::vector<T> &objects)
    {
      for (T &object : objects)
        *this &object;
      return *this;
    }
  };
} // namespace scree

#endif

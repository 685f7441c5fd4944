// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_step_values_of_h
#define scree_step_values_of_h

#include <deal.II/base/tensor.h>

#include <type_traits>
#include <utility>
#include <vector>

namespace scree
{
  /// Archive (Boost) that collects the addresses of all numbers of an object: its `serialize` is the list of members.
  struct ValueAddresses
  {
    template <class T>
    ValueAddresses &operator&(T &member)
    {
      if constexpr (std::is_same_v<T, double>)
        list.push_back(&member);
      else
        add(member);
      return *this;
    }

    std::vector<double *> list; ///< valid as long as the object

  private:
    template <class T>
    void add(T &object)
    {
      object.serialize(*this, 0);
    }
    template <int dim>
    void add(dealii::Tensor<1, dim> &vector)
    {
      for (unsigned int c = 0; c < dim; ++c)
        list.push_back(&vector[c]);
    }
    template <class T>
    void add(std::vector<T> &objects)
    {
      for (T &object : objects)
        *this &object;
    }
  };

  /// All numbers of an object, in the order in which it saves them.
  template <class T>
  std::vector<double *> values_of(T &object)
  {
    ValueAddresses addresses;
    addresses &object;
    return std::move(addresses.list);
  }
} // namespace scree

#endif

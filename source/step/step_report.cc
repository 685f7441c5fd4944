// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/step/step_report.h>

#include <algorithm>

namespace scree
{
  namespace
  {
    /// Of messages whose first number is how many numbers behind it are to be the largest; the others are summed.
    void take_largest_and_add(void *of_other, void *of_rank, int *n_messages, MPI_Datatype *type)
    {
      int bytes;
      MPI_Type_size(*type, &bytes);
      const int n         = bytes / sizeof(double);
      const double *other = static_cast<const double *>(of_other);
      double *own         = static_cast<double *>(of_rank);
      for (int m = 0; m < *n_messages; ++m, other += n, own += n)
        {
          const int first_sum = 1 + static_cast<int>(own[0]);
          for (int i = 1; i < n; ++i)
            own[i] = i < first_sum ? std::max(own[i], other[i]) : own[i] + other[i];
        }
    }
  } // namespace


  void NumbersOf::sum_over_ranks(const MPI_Comm communicator, std::vector<double> &largest) const
  {
    if (dealii::Utilities::MPI::n_mpi_processes(communicator) == 1)
      return;
    std::vector<double> message{ static_cast<double>(largest.size()) };
    message.insert(message.end(), largest.begin(), largest.end());
    for (const double *number : list)
      message.push_back(*number);
    MPI_Datatype type; // one for all numbers, so that they are not taken apart
    MPI_Op operation;
    MPI_Type_contiguous(message.size(), MPI_DOUBLE, &type);
    MPI_Type_commit(&type);
    MPI_Op_create(take_largest_and_add, /* commutes */ 1, &operation);
    MPI_Allreduce(MPI_IN_PLACE, message.data(), 1, type, operation, communicator);
    MPI_Op_free(&operation);
    MPI_Type_free(&type);
    const double *found = message.data() + 1;
    for (double &value : largest)
      value = *found++;
    for (double *number : list)
      *number = *found++;
  }
} // namespace scree

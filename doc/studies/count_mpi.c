/* SPDX-License-Identifier: LGPL-2.1-or-later
 * Counts what a program sends by MPI, through the standard's profiling interface. At MPI_Finalize rank 0 writes to standard error:
 *
 *   mpi: ranks N messages SUM MOST bytes SUM MOST collectives MOST
 *
 * SUM is over ranks, MOST that of the busiest one. Messages are point-to-point sends; bytes are theirs, without those of collectives.
 *
 *   mpicc -shared -fPIC -O2 -o count_mpi.so count_mpi.c && LD_PRELOAD=./count_mpi.so mpirun -np 4 PROGRAM
 */
#include <mpi.h>
#include <stdio.h>

enum { messages, bytes, collectives, n_counts };
static unsigned long long counts[n_counts];

static void count_message(const int count, const MPI_Datatype type)
{
  int size = 0;
  PMPI_Type_size(type, &size);
  ++counts[messages];
  counts[bytes] += (unsigned long long)count * size;
}

#define SEND(name)                                                                                                 \
  int MPI_##name(const void *data, int count, MPI_Datatype type, int to, int tag, MPI_Comm communicator)           \
  {                                                                                                                \
    count_message(count, type);                                                                                    \
    return PMPI_##name(data, count, type, to, tag, communicator);                                                  \
  }
SEND(Send)
SEND(Ssend)
SEND(Rsend)
SEND(Bsend)

#define SEND_LATER(name)                                                                                           \
  int MPI_##name(                                                                                                  \
    const void *data, int count, MPI_Datatype type, int to, int tag, MPI_Comm communicator, MPI_Request *request)  \
  {                                                                                                                \
    count_message(count, type);                                                                                    \
    return PMPI_##name(data, count, type, to, tag, communicator, request);                                         \
  }
SEND_LATER(Isend)
SEND_LATER(Issend)
SEND_LATER(Irsend)

#define COLLECTIVE(name, parameters, arguments)                                                                    \
  int MPI_##name parameters                                                                                        \
  {                                                                                                                \
    ++counts[collectives];                                                                                         \
    return PMPI_##name arguments;                                                                                  \
  }
COLLECTIVE(Barrier, (MPI_Comm c), (c))
COLLECTIVE(Ibarrier, (MPI_Comm c, MPI_Request *r), (c, r))
COLLECTIVE(Bcast, (void *x, int n, MPI_Datatype t, int root, MPI_Comm c), (x, n, t, root, c))
COLLECTIVE(Reduce, (const void *x, void *y, int n, MPI_Datatype t, MPI_Op o, int root, MPI_Comm c), (x, y, n, t, o, root, c))
COLLECTIVE(Allreduce, (const void *x, void *y, int n, MPI_Datatype t, MPI_Op o, MPI_Comm c), (x, y, n, t, o, c))
COLLECTIVE(Iallreduce,
           (const void *x, void *y, int n, MPI_Datatype t, MPI_Op o, MPI_Comm c, MPI_Request *r),
           (x, y, n, t, o, c, r))
COLLECTIVE(Scan, (const void *x, void *y, int n, MPI_Datatype t, MPI_Op o, MPI_Comm c), (x, y, n, t, o, c))
COLLECTIVE(Exscan, (const void *x, void *y, int n, MPI_Datatype t, MPI_Op o, MPI_Comm c), (x, y, n, t, o, c))
COLLECTIVE(Gather,
           (const void *x, int n, MPI_Datatype t, void *y, int m, MPI_Datatype u, int root, MPI_Comm c),
           (x, n, t, y, m, u, root, c))
COLLECTIVE(Allgather,
           (const void *x, int n, MPI_Datatype t, void *y, int m, MPI_Datatype u, MPI_Comm c),
           (x, n, t, y, m, u, c))
COLLECTIVE(Allgatherv,
           (const void *x, int n, MPI_Datatype t, void *y, const int *m, const int *d, MPI_Datatype u, MPI_Comm c),
           (x, n, t, y, m, d, u, c))
COLLECTIVE(Alltoall,
           (const void *x, int n, MPI_Datatype t, void *y, int m, MPI_Datatype u, MPI_Comm c),
           (x, n, t, y, m, u, c))

int MPI_Finalize(void)
{
  unsigned long long sum[n_counts], most[n_counts];
  int rank = 0, n_ranks = 1;
  PMPI_Comm_rank(MPI_COMM_WORLD, &rank);
  PMPI_Comm_size(MPI_COMM_WORLD, &n_ranks);
  PMPI_Reduce(counts, sum, n_counts, MPI_UNSIGNED_LONG_LONG, MPI_SUM, 0, MPI_COMM_WORLD);
  PMPI_Reduce(counts, most, n_counts, MPI_UNSIGNED_LONG_LONG, MPI_MAX, 0, MPI_COMM_WORLD);
  if (rank == 0)
    fprintf(stderr,
            "mpi: ranks %d messages %llu %llu bytes %llu %llu collectives %llu\n",
            n_ranks,
            sum[messages],
            most[messages],
            sum[bytes],
            most[bytes],
            most[collectives]);
  return PMPI_Finalize();
}

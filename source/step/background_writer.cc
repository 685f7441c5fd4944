// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/input/input_error.h>
#include <scree/step/background_writer.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <exception>
#include <iterator>
#include <utility>

namespace scree
{
  using namespace dealii;

  namespace
  {
    std::string fault_of_stages(const std::vector<std::function<void()>> &stages)
    {
      return fault_of([&] {
        for (const auto &write : stages)
          if (write)
            write();
      });
    }
  } // namespace


  std::string fault_of(const std::function<void()> &action)
  {
    try
      {
        action();
      }
    catch (const ExceptionBase &error)
      {
        return plain_text(error);
      }
    catch (const std::exception &error)
      {
        return error.what();
      }
    return "";
  }


  BackgroundWriter::BackgroundWriter(const MPI_Comm communicator)
      : communicator(communicator)
      , n_ranks(Utilities::MPI::n_mpi_processes(communicator))
  {
  }


  BackgroundWriter::~BackgroundWriter()
  {
    if (running.valid())
      running.wait();
    if (n_ranks == 1)
      for (unsigned int j = 1; j < jobs.size(); ++j)
        fault_of_stages(jobs[j].stages);
  }


  void BackgroundWriter::start(FileJob job)
  {
    while (jobs.size() > 1)
      end_stage();
    jobs.push_back(std::move(job));
    if (jobs.size() == 1)
      begin_job();
  }


  void BackgroundWriter::look()
  {
    while (!jobs.empty())
      {
        const int is_ready = running.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
        if ((n_ranks > 1 ? Utilities::MPI::min(is_ready, communicator) : is_ready) == 0)
          return;
        end_stage();
      }
  }


  void BackgroundWriter::finish()
  {
    while (!jobs.empty())
      end_stage();
  }


  void BackgroundWriter::begin_job()
  {
    begin = std::chrono::steady_clock::now();
    stage = 0;
    begin_stage();
  }


  void BackgroundWriter::begin_stage()
  {
    // A single rank does not wait between the stages.
    auto &all       = jobs.front().stages;
    const auto next = all.begin() + stage;
    stage           = n_ranks == 1 ? all.size() : std::min<std::size_t>(stage + 1, all.size());
    std::vector<std::function<void()>> stages;
    std::move(next, all.begin() + stage, std::back_inserter(stages));
    running = std::async(std::launch::async, [stages = std::move(stages)]() mutable {
      const auto freed_here = std::move(stages);
      return fault_of_stages(freed_here);
    });
  }


  void BackgroundWriter::end_stage()
  {
    std::string fault = running.get();
    if (n_ranks > 1)
      {
        const unsigned int rank  = Utilities::MPI::this_mpi_process(communicator);
        const unsigned int first = Utilities::MPI::min(fault.empty() ? n_ranks : rank, communicator);
        fault                    = first < n_ranks ? Utilities::MPI::broadcast(communicator, fault, first) : "";
      }
    if (fault.empty() && stage < jobs.front().stages.size())
      begin_stage();
    else
      end_job(fault);
  }


  void BackgroundWriter::end_job(const std::string &fault)
  {
    const FileJob job = std::move(jobs.front());
    jobs.pop_front();
    longest_job =
        std::max(longest_job, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
    try
      {
        if (!fault.empty())
          {
            AssertThrow(job.failed, ExcMessage(fault));
            job.failed(fault);
          }
        else if (job.done)
          job.done();
      }
    catch (...)
      {
        jobs.clear(); // The run ends.
        throw;
      }
    if (!jobs.empty())
      begin_job();
  }
} // namespace scree

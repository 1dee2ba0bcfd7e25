#include "tilepack/batch/job_queue.h"

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <set>
#include <thread>

namespace tilepack {
namespace {

class Queue {
public:
  Queue(const std::vector<QueuedJob>& all, const QueueLimits& given,
        const std::function<void(std::size_t, std::exception_ptr)>& on_failure,
        const std::function<void(std::size_t)>& on_skip)
      : jobs(all), limits(given), failed(on_failure), skipped(on_skip), states(all.size(), State::waiting),
        needs(all.size(), -1) {
    if (limits.threads < 1) limits.threads = allowed;
  }

  std::vector<JobEnd> run() {
    const std::size_t workers = std::min(jobs.size(), static_cast<std::size_t>(limits.threads));
    std::vector<std::thread> threads;
    for (std::size_t i = 0; i < workers; ++i) threads.emplace_back([this] { work(); });
    for (std::thread& thread : threads) thread.join();
    if (fatal) std::rethrow_exception(fatal);
    std::vector<JobEnd> ends;
    for (const State state : states)
      ends.push_back(state == State::done     ? JobEnd::done
                     : state == State::failed ? JobEnd::failed
                                              : JobEnd::skipped);
    return ends;
  }

private:
  enum class State { waiting, running, done, failed, skipped };

  void work() {
    std::unique_lock lock(mutex);
    while (!fatal) {
      const Choice choice = next();
      if (choice.none_left) return;
      if (choice.job == jobs.size()) {
        changed.wait(lock);
        continue;
      }
      if (choice.skip) {
        end(choice.job, State::skipped);
        tell(lock, [&] { skipped(choice.job); });
        continue;
      }
      if (needs[choice.job] < 0) { // to be chosen again with that known
        needs[choice.job] = 0;
        ask(lock, choice.job);
        continue;
      }
      start(lock, choice.job);
    }
  }

  struct Choice {
    std::size_t job;
    bool skip = false;
    bool none_left = false;
  };

  // The first job that may begin; the number of jobs if all that are left must wait.
  Choice next() {
    bool left = false;
    while (first < jobs.size() && states[first] != State::waiting) ++first;
    for (std::size_t j = first; j < jobs.size(); ++j) {
      if (states[j] != State::waiting || asking.contains(j)) {
        left |= states[j] == State::waiting || states[j] == State::running;
        continue;
      }
      left = true;
      const auto& after = jobs[j].after;
      if (std::any_of(after.begin(), after.end(), [&](std::size_t other) {
            return states[other] == State::failed || states[other] == State::skipped;
          }))
        return {j, true, false};
      if (std::any_of(after.begin(), after.end(),
                      [&](std::size_t other) { return states[other] != State::done; }))
        continue;
      if (used_threads >= limits.threads) break;
      if (needs[j] > 0 && limits.memory > 0 && running > 0 && used_memory + needs[j] > limits.memory)
        continue;
      return {j, false, false};
    }
    return {jobs.size(), false, !left};
  }

  void ask(std::unique_lock<std::mutex>& lock, std::size_t job) {
    asking.insert(job);
    lock.unlock();
    std::int64_t bytes = 0;
    std::exception_ptr fault;
    try {
      if (limits.memory > 0 && jobs[job].memory) bytes = jobs[job].memory();
    } catch (...) {
      fault = std::current_exception();
    }
    lock.lock();
    asking.erase(job);
    needs[job] = std::max<std::int64_t>(bytes, 1);
    if (fault) {
      end(job, State::failed);
      tell(lock, [&] { failed(job, fault); });
    }
    changed.notify_all();
  }

  // The share of the threads: all of them among those that could run now.
  int share(std::size_t job) const {
    int ready = 0;
    for (std::size_t j = first; j < jobs.size() && ready < limits.threads; ++j)
      ready += j != job && states[j] == State::waiting ? 1 : 0;
    const int free = limits.threads - used_threads;
    return std::max(1, free / (1 + std::min(ready, free - 1)));
  }

  void start(std::unique_lock<std::mutex>& lock, std::size_t job) {
    const int threads = share(job);
    states[job] = State::running;
    used_threads += threads;
    used_memory += needs[job];
    ++running;
    lock.unlock();
    std::exception_ptr fault;
    try {
      tbb::task_arena arena(std::min(threads, allowed));
      arena.execute([&] { jobs[job].run(threads); });
    } catch (...) {
      fault = std::current_exception();
    }
    lock.lock();
    used_threads -= threads;
    used_memory -= needs[job];
    --running;
    end(job, fault ? State::failed : State::done);
    if (fault) tell(lock, [&] { failed(job, fault); });
  }

  void end(std::size_t job, State state) {
    states[job] = state;
    changed.notify_all();
  }

  template <typename Call>
  void tell(std::unique_lock<std::mutex>& lock, Call call) {
    lock.unlock();
    std::exception_ptr fault;
    try {
      call();
    } catch (...) {
      fault = std::current_exception();
    }
    lock.lock();
    if (fault && !fatal) fatal = fault;
    changed.notify_all();
  }

  const std::vector<QueuedJob>& jobs;
  QueueLimits limits;
  const int allowed =
      static_cast<int>(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
  const std::function<void(std::size_t, std::exception_ptr)>& failed;
  const std::function<void(std::size_t)>& skipped;
  std::vector<State> states;
  std::vector<std::int64_t> needs; // bytes; -1: not asked yet
  std::set<std::size_t> asking;
  std::size_t first = 0; // all before it have begun
  int used_threads = 0;
  std::int64_t used_memory = 0;
  int running = 0;
  std::exception_ptr fatal;
  std::mutex mutex;
  std::condition_variable changed;
};

} // namespace

std::vector<JobEnd> run_all(const std::vector<QueuedJob>& jobs, const QueueLimits& limits,
                            const std::function<void(std::size_t job, std::exception_ptr fault)>& failed,
                            const std::function<void(std::size_t job)>& skipped) {
  if (jobs.empty()) return {}; // without waking the pool of threads
  return Queue(jobs, limits, failed, skipped).run();
}

} // namespace tilepack

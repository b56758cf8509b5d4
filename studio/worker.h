// What:   one thread that does jobs one after the other, in the order they came.
// Source: ours.
// Differs: nothing.
// Cost:   a thread.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>

namespace inkgrid::studio {

class Worker {
 public:
  using Job = std::function<void()>;  // throws nothing

  Worker() : thread_([this](const std::stop_token& stop) { work(stop); }) {}

  void add(Job job) {
    const std::lock_guard lock(mutex_);
    jobs_.push_back(std::move(job));
    changed_.notify_one();
  }

 private:
  void work(const std::stop_token& stop) {
    while (true) {
      std::unique_lock lock(mutex_);
      if (!changed_.wait(lock, stop, [this] { return !jobs_.empty(); })) return;
      const Job job = std::move(jobs_.front());
      jobs_.pop_front();
      lock.unlock();
      job();
    }
  }

  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::deque<Job> jobs_;
  std::jthread thread_;  // last: it ends before what it uses
};

}  // namespace inkgrid::studio

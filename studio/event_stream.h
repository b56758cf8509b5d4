// What:   what a job tells those who wait for it, as server-sent events.
// Source: HTML standard, "Server-sent events".
// Differs: progress that nobody has read yet is replaced by newer progress.
// Cost:   none.
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>

namespace inkgrid::studio {

// A job's voice and its stop button; shared by the worker, who tells, and a connection, which listens.
class EventStream {
 public:
  // Progress of a stage; `data` is JSON on one line.
  void progress(const std::string& data);
  // The last event: "done", "failed" or "cancelled".  Only the first call counts.
  void finish(const char* event, const std::string& data);

  // The next events as text, or a comment where there is none within the time; nothing after the last one.
  std::optional<std::string> next(std::chrono::milliseconds patience);

  std::stop_source stop;

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::string progress_;
  std::string last_;
  bool finished_ = false;
  bool told_ = false;
};

}  // namespace inkgrid::studio

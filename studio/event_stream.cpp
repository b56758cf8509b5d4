#include "event_stream.h"

namespace inkgrid::studio {
namespace {

std::string event_text(const char* event, const std::string& data) {
  return std::string("event: ") + event + "\ndata: " + data + "\n\n";
}

}  // namespace

void EventStream::progress(const std::string& data) {
  const std::lock_guard lock(mutex_);
  progress_ = event_text("progress", data);
  changed_.notify_all();
}

void EventStream::finish(const char* event, const std::string& data) {
  const std::lock_guard lock(mutex_);
  if (finished_) return;
  finished_ = true;
  last_ = event_text(event, data);
  changed_.notify_all();
}

std::optional<std::string> EventStream::next(std::chrono::milliseconds patience) {
  std::unique_lock lock(mutex_);
  if (told_) return std::nullopt;
  changed_.wait_for(lock, patience, [this] { return finished_ || !progress_.empty(); });
  told_ = finished_;
  const std::string text = std::move(progress_) + last_;
  progress_.clear();
  return text.empty() ? ":\n\n" : text;
}

}  // namespace inkgrid::studio

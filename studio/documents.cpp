#include "documents.h"

#include <algorithm>

#include "guard.h"
#include "images/image_format.h"
#include "images/image_io.h"

namespace inkgrid::studio {
namespace {

constexpr std::size_t kMostOpen = 6;
constexpr long kMostPixels = 64'000'000;

// Before anything is decoded.
void check_size(const ImageFile& file) {
  const auto format = format_of(file.bytes);
  if (!format) return;
  const ImageHeader header = header_of(*format, file.bytes);
  if (header.width > 0 && header.height > kMostPixels / header.width)
    throw Error(ErrorCode::file, "'" + file.name + "' has " + std::to_string(header.width) + " x " +
                                     std::to_string(header.height) + " pixels, which is too much for the studio");
}

void stop_job(Document& document) {
  const std::lock_guard lock(document.mutex);
  if (document.job) document.job->stop.request_stop();
}

}  // namespace

void take_over(Document& document, const std::string& revision, const std::shared_ptr<EventStream>& job) {
  const std::lock_guard lock(document.mutex);
  if (document.job) document.job->stop.request_stop();
  document.revision = revision;
  document.job = job;
}

void stop_job(Document& document, const std::string& revision) {
  const std::lock_guard lock(document.mutex);
  if (document.job && document.revision == revision) document.job->stop.request_stop();
}

std::shared_ptr<const Solved> last_solved(Document& document) {
  const std::lock_guard lock(document.mutex);
  return document.solved;
}

std::shared_ptr<Document> Documents::open(ImageFile file) {
  check_size(file);
  auto document = std::make_shared<Document>();
  document->id = random_token();
  document->image = decode_image(file.bytes, file.name);
  document->file = std::move(file);
  const std::lock_guard lock(mutex_);
  recent_.push_front(document);
  if (recent_.size() > kMostOpen) {
    stop_job(*recent_.back());
    recent_.pop_back();
  }
  return document;
}

std::shared_ptr<Document> Documents::find(const std::string& id) {
  const std::lock_guard lock(mutex_);
  const auto found = std::find_if(recent_.begin(), recent_.end(), [&](const auto& document) { return document->id == id; });
  if (found == recent_.end()) return nullptr;
  recent_.splice(recent_.begin(), recent_, found);
  return recent_.front();
}

void Documents::close(const std::string& id) {
  const std::lock_guard lock(mutex_);
  recent_.remove_if([&](const auto& document) {
    if (document->id != id) return false;
    stop_job(*document);
    return true;
  });
}

}  // namespace inkgrid::studio

// What:   the drawings that are open, and what was found in each.
// Source: ours.
// Differs: nothing.
// Cost:   what the stages of a drawing hold, for a few drawings at most.
#pragma once

#include <list>
#include <memory>
#include <mutex>
#include <string>

#include "event_stream.h"
#include "project/project.h"

namespace inkgrid::studio {

// Curves that are shown and exported; never changed once made.
struct Solved {
  std::string revision;  // the page's name for the state it asked about
  Options options;
  Drawing drawing;
  Report report;
};

struct Document {
  std::string id;
  ImageFile file;
  Image image;

  std::mutex stages_mutex;  // held as long as a job runs
  Stages stages;            // before hand edits

  std::mutex mutex;  // of what follows
  std::shared_ptr<const Solved> solved;
  std::string revision;              // that the last job is asked for
  std::shared_ptr<EventStream> job;  // the last one
};

// Asks the job before it to stop.
void take_over(Document& document, const std::string& revision, const std::shared_ptr<EventStream>& job);

// Does nothing where a later job has taken over.
void stop_job(Document& document, const std::string& revision);

std::shared_ptr<const Solved> last_solved(Document& document);

class Documents {
 public:
  // The drawing of the project, decoded.  The one that nobody asked about for longest is closed where there are too many.
  // Throws Error{file}.
  std::shared_ptr<Document> open(ImageFile file);
  // Null where there is none, or no longer.
  std::shared_ptr<Document> find(const std::string& id);
  void close(const std::string& id);

 private:
  std::mutex mutex_;
  std::list<std::shared_ptr<Document>> recent_;  // the one asked about last is first
};

}  // namespace inkgrid::studio

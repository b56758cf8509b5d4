// A drawing that is worked on: runs again only what a change of options or scribbles touches.
#pragma once

#include <memory>

#include "inkgrid/inkgrid.h"

namespace inkgrid {

class Session {
 public:
  explicit Session(Image image);
  ~Session();
  Session(Session&&) noexcept;
  Session& operator=(Session&&) noexcept;

  // What vectorize makes of the image, to the last digit; Report::seconds names the stages that ran.  Curves that a change leaves
  // alone keep their Curve::id.  After an exception (a stop, say) the session is as it was.
  Result run(const Options& options = {}, const Control& control = {});

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace inkgrid

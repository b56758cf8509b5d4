#include "inkgrid/session.h"

#include "pipeline.h"

namespace inkgrid {

struct Session::State {
  Image image;
  Stages stages;
};

Session::Session(Image image) : state_(new State{std::move(image), {}}) {}
Session::~Session() = default;
Session::Session(Session&&) noexcept = default;
Session& Session::operator=(Session&&) noexcept = default;

Result Session::run(const Options& options, const Control& control) {
  rerun_stages(state_->stages, state_->image, options, control);
  return {state_->stages.drawing, state_->stages.report};
}

}  // namespace inkgrid

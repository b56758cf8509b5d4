#include "solve.h"

#include <nlohmann/json.hpp>

#include "answers.h"

namespace inkgrid::studio {
namespace {

using Json = nlohmann::json;

Control control_of(EventStream& events, const std::optional<ScaleMask>& mask) {
  Control control;
  control.mask = mask ? &*mask : nullptr;
  control.stop = events.stop.get_token();
  control.progress = [&events](const char* stage, double fraction) {
    events.progress(Json{{"stage", stage}, {"fraction", fraction}}.dump());
  };
  return control;
}

std::string answer_of(Document& document, const Project& state, const std::string& revision, EventStream& events) {
  const std::lock_guard running(document.stages_mutex);
  const std::optional<ScaleMask> mask = project_mask(state, document.image);
  rerun_stages(document.stages, document.image, state.options, control_of(events, mask));
  auto solved = std::make_shared<Solved>(Solved{revision, state.options, document.stages.drawing, document.stages.report});
  apply_hand_edits(state.edits, solved->drawing, solved->report);
  const std::lock_guard publishing(document.mutex);
  document.solved = solved;
  return solved_json(*solved);
}

}  // namespace

void solve(Document& document, const Project& state, const std::string& revision, EventStream& events) {
  try {
    if (events.stop.stop_requested()) throw Error(ErrorCode::cancelled, "cancelled");
    events.finish("done", answer_of(document, state, revision, events));
  } catch (const Error& error) {
    const bool cancelled = error.code() == ErrorCode::cancelled;
    events.finish(cancelled ? "cancelled" : "failed", Json{{"sentence", error.what()}}.dump());
  } catch (const std::bad_alloc&) {
    events.finish("failed", Json{{"sentence", "there is not enough memory for this drawing"}}.dump());
  } catch (const std::exception& error) {
    events.finish("failed", Json{{"sentence", error.what()}}.dump());
  }
}

}  // namespace inkgrid::studio

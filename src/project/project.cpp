#include "project/project.h"

#include "images/image_io.h"
#include "run_report.h"

namespace inkgrid {
namespace {

// A sentence about the edits that did nothing.
std::string missed_text(std::size_t count) {
  return std::to_string(count) + (count == 1 ? " hand edit" : " hand edits") + " found no curve at the place it is meant for";
}

template <class Run>
auto run_masked(const Project& project, const Image& image, const Control& control, Run run) {
  const std::optional<ScaleMask> mask = project_mask(project, image);
  Control masked = control;
  masked.mask = mask ? &*mask : nullptr;
  return run(image, project.options, masked);
}

}  // namespace

Image project_image(const Project& project) {
  return decode_image(project.drawing.bytes, project.drawing.name);
}

std::optional<ScaleMask> project_mask(const Project& project, const Image& image) {
  std::optional<ScaleMask> mask;
  if (project.mask) mask = decode_mask(project.mask->bytes, project.mask->name);
  if (project.scribbles.empty()) return mask;
  if (!mask) mask = ScaleMask{image.width, image.height, std::vector<float>(image.grey.size(), 1.0f)};
  paint_scribbles(*mask, project.scribbles);
  return mask;
}

void apply_hand_edits(std::span<const Edit> edits, Drawing& drawing, Report& report) {
  if (edits.empty()) return;
  Edited edited = apply_edits(std::move(drawing), edits);
  drawing = std::move(edited.drawing);
  if (!edited.missed.empty()) report.warnings.push_back(missed_text(edited.missed.size()));
  count_curves(drawing, report);
}

Stages run_project(const Project& project, const Image& image, const Control& control) {
  Stages stages = run_masked(project, image, control, run_stages);
  apply_hand_edits(project.edits, stages.drawing, stages.report);
  return stages;
}

Result solve_project(const Project& project, const Image& image, const Control& control) {
  Result result = run_masked(project, image, control, vectorize);
  apply_hand_edits(project.edits, result.drawing, result.report);
  return result;
}

}  // namespace inkgrid

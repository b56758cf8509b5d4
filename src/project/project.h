// What:   a drawing with what was asked of it: the image file, scribbles, options and hand edits, as one JSON file.
// Source: ours; docs/FORMATS.md, "Project".
// Differs: nothing.
// Cost:   that of the method.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline.h"
#include "project/edits.h"
#include "scribbles/scribbles.h"

namespace inkgrid {

// An image file as it was given, so that it can be decoded again.
struct ImageFile {
  std::string name;  // for messages, and to name results after
  std::string bytes;
};

struct Project {
  ImageFile drawing;
  std::optional<ImageFile> mask;  // a mask image, under the scribbles
  Options options;
  std::vector<Scribble> scribbles;
  std::vector<Edit> edits;
};

// The same project gives the same text; options that have their default are left out.
std::string project_text(const Project& project);

// `name` is only for messages.  Throws Error{file} with one sentence where the text is no project, or holds what can't be.
Project parse_project(std::string_view text, const std::string& name);

Image project_image(const Project& project);

// The mask image, or paper, with the scribbles painted over it; nothing where there is neither.
std::optional<ScaleMask> project_mask(const Project& project, const Image& image);

// Edits that found no curve are a warning in the report.
void apply_hand_edits(std::span<const Edit> edits, Drawing& drawing, Report& report);

// run_stages on the drawing under its mask, then the hand edits.
// `image` is project_image(project); the mask of `control` is not used.
Stages run_project(const Project& project, const Image& image, const Control& control);

// The same result in less memory.
Result solve_project(const Project& project, const Image& image, const Control& control);

}  // namespace inkgrid

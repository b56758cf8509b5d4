// What:   what the page is told, as JSON on one line.
// Source: the tables of options and formats; the results of a run.
// Differs: nothing.
// Cost:   linear in what is told.
#pragma once

#include <string>

#include "documents.h"

namespace inkgrid::studio {

// The options with their ranges, the export formats, the samples, and the document that is open from the start ("" for none).
std::string about_json(const std::string& opened);

// Its id, name, size and the project that the page begins with.
std::string document_json(const Document& document, const Project& project);

// The curves and what was measured.
std::string solved_json(const Solved& solved);

// The points that edits of a curve are best named by.
std::string anchors_json(const Drawing& drawing, int curve);

}  // namespace inkgrid::studio

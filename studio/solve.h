// What:   a job: from what the page asks for to curves, told as events.
// Source: the stages are those of the library; nothing of the method is here.
// Differs: nothing.
// Cost:   that of the stages that the change touches.
#pragma once

#include <memory>
#include <string>

#include "documents.h"

namespace inkgrid::studio {

// `state` is a project without the bytes of its drawing, which are the document's.  Tells the end, whatever it is; throws
// nothing.
void solve(Document& document, const Project& state, const std::string& revision, EventStream& events);

}  // namespace inkgrid::studio

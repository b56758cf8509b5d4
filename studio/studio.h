// What:   the studio: a server on this machine, and the page it serves.
// Source: ours.
// Differs: nothing.
// Cost:   a few threads; what the open drawings hold.
#pragma once

namespace inkgrid::studio {

// Until the program is ended.  `words` begins with "studio".  Throws Error.
void run(int count, const char* const* words);

}  // namespace inkgrid::studio

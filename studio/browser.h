// What:   shows an address in the person's browser.
// Source: xdg-open of the desktop.
// Differs: nothing.
// Cost:   a process.
#pragma once

#include <string>

namespace inkgrid::studio {

// Does nothing where there is no screen or nothing to open it with.
void open_browser(const std::string& address);

}  // namespace inkgrid::studio

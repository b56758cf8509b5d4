#include "studio.h"

#include <cstdio>

#include "arguments.h"
#include "browser.h"
#include "images/image_io.h"
#include "inkgrid/inkgrid.h"
#include "server.h"

namespace inkgrid::studio {
namespace {

void print(const std::string& text) {
  std::fputs(text.c_str(), stdout);
  std::fflush(stdout);
}

ImageFile read_file(const std::string& path) {
  return {path, read_bytes(path)};
}

}  // namespace

void run(int count, const char* const* words) {
  const Arguments arguments = parse_arguments(count, words);
  if (arguments.help) return print(help_text());
  Server server(arguments.host, arguments.port);
  if (!arguments.file.empty()) server.open(read_file(arguments.file));
  print(server.address() + "\n");
  if (arguments.browser) open_browser(server.address());
  server.listen();
}

}  // namespace inkgrid::studio

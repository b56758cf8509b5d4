#include "arguments.h"

#include <CLI/CLI.hpp>

#include "inkgrid/inkgrid.h"

namespace inkgrid::studio {
namespace {

void describe(CLI::App& app, Arguments& arguments) {
  app.description("A page in the browser: see the method, paint where it should simplify, watch the curves answer.");
  app.name("inkgrid studio");
  app.add_option("FILE", arguments.file, "a drawing or a project to begin with")->type_name("");
  app.add_option("--port", arguments.port, "listen on this port, 0 to 65535; 0 for any free one")
      ->type_name("NUMBER")
      ->check(CLI::Range(0, 65535).description(""))
      ->capture_default_str();
  app.add_option("--host", arguments.host, "listen on this address; others than the default can be reached from other machines")
      ->type_name("ADDRESS")
      ->capture_default_str();
  app.add_flag_callback(
      "--no-browser", [&arguments] { arguments.browser = false; }, "print the address, and open no browser");
}

}  // namespace

Arguments parse_arguments(int count, const char* const* words) {
  Arguments arguments;
  CLI::App app;
  describe(app, arguments);
  app.set_help_flag();
  app.add_flag("-h,--help", arguments.help);
  try {
    app.parse(count, words);
  } catch (const CLI::ParseError& error) {
    throw Error(ErrorCode::usage, std::string(error.what()) + " (see inkgrid studio --help)");
  }
  return arguments;
}

std::string help_text() {
  Arguments arguments;
  CLI::App app;
  describe(app, arguments);
  return app.help();
}

}  // namespace inkgrid::studio
